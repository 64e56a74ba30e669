/* A foot in the air passes beside the other. The walker's feet are 0.18 m apart at q = 0, each
 * 0.08 m wide; nodes every 0.25 s up to 1 s, so that 0.0625 m are added for what happens between.
 */
#include "contact/gait.h"
#include "support/row_fixture.h"

static const double gap = 0.05, kept = 0.08 + 0.05 + 0.0625;
static const char near[] = "near the other foot";

static const ambulo_contact contacts[] = {
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.25, .place = {0.0, -0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.3, 0.1}},
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.75, 1.0, .place = {0.6, -0.1}}};

/* the right foot in the air from 0.25 to 0.75 s */
static void open_with(row_fixture *f, int planar) {
  row_fixture_open(f, planar);
  f->definition.contacts = contacts;
  f->definition.contact_count = 3;
  f->definition.clearance.height = 0.02;
  f->definition.clearance.feet = gap;
  for (int k = 0; k < ROW_NODES; k++) f->active[2 * k + WALKER_LEFT] = 1;
  f->active[WALKER_RIGHT] = 0;
  f->active[2 * 3 + WALKER_RIGHT] = f->active[2 * 4 + WALKER_RIGHT] = 2;
}

static double of_distance(double d) {
  return (d * d - kept * kept) / (2.0 * kept);
}

static void expect(row_fixture *f, const char *subject, double time, double value) {
  int row = row_find(f, "clearance", subject, near, time);
  assert_int_equal(f->table.rows[row].relation, AMBULO_NOT_NEGATIVE);
  assert_close(row_value(f, row), value, 1e-12);
}

static void the_four_ends_keep_the_gap(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 0);
  ambulo__feet_apart_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, 2 * 4); /* at 0.25 and 0.5 s, when it is in the air */
  static const char *const ends[] = {"r_heel", "r_toe", "l_heel", "l_toe"};
  for (int i = 0; i < 4; i++) expect(&f, ends[i], 0.5, of_distance(0.18));
  /* the right heel moves beyond the left toe, 0.22 m ahead of the heel, and 0.1 m up */
  double *heel = row_channel(
      &f, 2,
      ambulo__channel_point(&f.context.channels, f.model->feet[WALKER_RIGHT].heel_center, 0));
  heel[0] += 0.25;
  heel[1] += 0.1;
  expect(&f, "r_heel", 0.5, of_distance(hypot(0.03, 0.18)));
  row_fixture_close(&f);
}

/* where it leaves the ground and where it comes down; either foot */
static void swings_hold_at_both_their_ends(void **state) {
  (void)state;
  for (int foot = 0; foot < 2; foot++) {
    row_fixture f;
    open_with(&f, 0);
    for (int k = 0; foot && k < ROW_NODES; k++) {
      f.active[2 * k + WALKER_LEFT] = f.active[2 * k + WALKER_RIGHT];
      f.active[2 * k + WALKER_RIGHT] = 1;
    }
    row_event(&f, 1, foot ? WALKER_LEFT : WALKER_RIGHT, 0);
    row_event(&f, 3, foot ? WALKER_LEFT : WALKER_RIGHT, -1);
    ambulo__feet_apart_rows(&f.context, &f.table);
    assert_int_equal(f.table.row_count, 3 * 4);
    for (int r = 0; r < f.table.row_count; r++) {
      const ambulo__table_row *row = &f.table.rows[r];
      assert_true(row->node >= 1 && row->node <= 3);
      if (row->node != 2) assert_int_equal(row->before, row->node == 3);
    }
    assert_int_equal(f.table.before, 0);
    row_fixture_close(&f);
  }
}

/* asked for nothing, on the ground, or in one plane */
static void others_have_none(void **state) {
  (void)state;
  for (int which = 0; which < 3; which++) {
    row_fixture f;
    open_with(&f, which == 0);
    if (which == 1) f.definition.clearance.feet = AMBULO_OFF;
    if (which == 2) f.active[2 + WALKER_RIGHT] = f.active[4 + WALKER_RIGHT] = 0;
    ambulo__feet_apart_rows(&f.context, &f.table);
    assert_int_equal(f.table.row_count, 0);
    row_fixture_close(&f);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_four_ends_keep_the_gap),
                                     cmocka_unit_test(swings_hold_at_both_their_ends),
                                     cmocka_unit_test(others_have_none)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
