/* Rows that hold patches: hands of the walker at q = 0 at (0.4, 1.22, -+0.25) m, x forward, y up.
 */
#include "contact/bounded.h"
#include "contact/patch_rows.h"
#include "support/patched_walker.h"
#include "support/row_fixture.h"

/* a rail that is held from above, and a wall ahead that is pushed */
static const ambulo_contact contacts[] = {
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.0, 0.1}},
    OF_PATCH(HAND_R, 0.0, 0.5, {0.41, -0.27, 1.2}),
    {.foot = -1,
     .mode = AMBULO_CONTACT_PATCH,
     .patch = HAND_L,
     .from = 0.5,
     .to = 1.0,
     .place = {0.43, 0.25, 1.2},
     .normal = {-1.0, 0.0, 0.0}}};

static void prepare(row_fixture *f, int planar, double tolerance) {
  row_fixture_open(f, planar);
  ambulo_model_free(f->model);
  f->model = patched_walker(planar);
  f->definition.model = f->model;
  f->context.model = f->model;
  f->context.channels.points = f->model->point_count;
  f->definition.contacts = contacts;
  f->definition.contact_count = 3;
  f->definition.contact_tolerance = tolerance;
  int count = ambulo__channel_count(&f->context.channels);
  free(f->channel);
  f->channel = calloc((size_t)(ROW_NODES * count), sizeof(double));
  for (int k = 0; k < ROW_NODES; k++)
    for (int p = 0; p < f->model->point_count; p++)
      ambulo__neutral_point(f->model, p,
                            row_channel(f, k, ambulo__channel_point(&f->context.channels, p, 0)));
}

static void expect(row_fixture *f, const char *subject, const char *detail, double time,
                   ambulo_relation relation, double value) {
  int row = row_find(f, "contact", subject, detail, time);
  assert_int_equal(f->table.rows[row].relation, relation);
  if (fabs(row_value(f, row) - value) > 1e-12)
    print_error("%s %s at %g s\n", subject, detail, time);
  assert_close(row_value(f, row), value, 1e-12);
}

static void patches_stay_on_their_places_within_the_tolerance(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0, 0.002);
  ambulo__patch_rows(&f.context, &f.table);
  for (int k = 0; k < 2; k++) {
    double t = 0.25 * k;
    expect(&f, "hand_r", "behind", t, AMBULO_NOT_NEGATIVE, 0.002 - 0.01);
    expect(&f, "hand_r", "ahead", t, AMBULO_NOT_NEGATIVE, 0.002 + 0.01);
    expect(&f, "hand_r", "below", t, AMBULO_NOT_NEGATIVE, 0.002 + 0.02);
    expect(&f, "hand_r", "above", t, AMBULO_NOT_NEGATIVE, 0.002 - 0.02);
    expect(&f, "hand_r", "to the left", t, AMBULO_NOT_NEGATIVE, 0.002 - 0.02);
    expect(&f, "hand_r", "to the right", t, AMBULO_NOT_NEGATIVE, 0.002 + 0.02);
  }
  /* a node at 0.5 s of a uniform grid belongs to what begins there */
  assert_int_equal(f.table.row_count, 5 * 6);
  row_fixture_close(&f);
}

/* facing the wall, its normal is backward and its forward is up */
static void a_wall_has_its_own_axes(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0, 0.002);
  ambulo__patch_rows(&f.context, &f.table);
  expect(&f, "hand_l", "above", 0.75, AMBULO_NOT_NEGATIVE, 0.002 - 0.03);
  expect(&f, "hand_l", "below", 0.75, AMBULO_NOT_NEGATIVE, 0.002 + 0.03);
  expect(&f, "hand_l", "ahead", 0.75, AMBULO_NOT_NEGATIVE, 0.002 - 0.02);
  expect(&f, "hand_l", "to the left", 0.75, AMBULO_NOT_NEGATIVE, 0.002);
  row_fixture_close(&f);
}

static void without_a_tolerance_they_are_equations(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0, 0.0);
  ambulo__patch_rows(&f.context, &f.table);
  expect(&f, "hand_r", "ahead", 0.25, AMBULO_EQUAL, -0.01);
  expect(&f, "hand_r", "above", 0.25, AMBULO_EQUAL, 0.02);
  expect(&f, "hand_r", "to the left", 0.25, AMBULO_EQUAL, 0.02);
  assert_int_equal(f.table.row_count, 5 * 3);
  row_fixture_close(&f);
}

static void planar_bodies_have_none_to_the_side(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 1, 0.0);
  ambulo__patch_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "contact", "hand_r", "to the left", 0.25), 0);
  assert_int_equal(f.table.row_count, 5 * 2);
  row_fixture_close(&f);
}

/* on a grid on events the node at 0.5 s belongs to the hand that leaves and to the one that comes;
 * one that goes on at the same place is held once, and twice where it moves on */
static void events_hold_both(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0, 0.002);
  row_event(&f, 2, WALKER_LEFT, 0);
  ambulo__patch_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "contact", "hand_r", "ahead", 0.5), 1);
  assert_int_equal(row_count(&f, "contact", "hand_l", "ahead", 0.5), 1);
  assert_true(f.table.rows[row_find(&f, "contact", "hand_r", "ahead", 0.5)].before);
  assert_false(f.table.rows[row_find(&f, "contact", "hand_l", "ahead", 0.5)].before);
  assert_int_equal(row_count(&f, "contact", "hand_r", "ahead", 0.75), 0);
  for (int moved = 0; moved < 2; moved++) {
    ambulo_contact one[] = {contacts[1], contacts[1]};
    one[1].from = 0.5;
    one[1].to = 1.0;
    one[1].place[0] += 0.1 * moved;
    f.definition.contacts = one;
    f.definition.contact_count = 2;
    f.table.row_count = 0;
    ambulo__patch_rows(&f.context, &f.table);
    assert_int_equal(row_count(&f, "contact", "hand_r", "ahead", 0.5), 1 + moved);
  }
  row_fixture_close(&f);
}

/* the last node of a motion that repeats is the first one again */
static void ends_that_match_are_held_once(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0, 0.002);
  ambulo_contact through = contacts[1];
  through.to = 1.0;
  f.definition.contacts = &through;
  f.definition.contact_count = 1;
  f.definition.ends = AMBULO_ENDS_PERIODIC;
  ambulo__patch_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "contact", "hand_r", "ahead", 0.75), 1);
  assert_int_equal(row_count(&f, "contact", "hand_r", "ahead", 1.0), 0);
  /* one that ends at T is held there, on events: the first node does not know of it */
  through.from = 0.25;
  row_event(&f, 4, WALKER_LEFT, -1);
  f.table.row_count = 0;
  ambulo__patch_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "contact", "hand_r", "ahead", 1.0), 1);
  /* mirrored, the left hand goes on where the right one ends: the first node has it */
  ambulo_contact both[] = {through, through};
  both[1].patch = HAND_L;
  both[1].from = 0.0;
  both[1].to = 0.25;
  f.definition.contacts = both;
  f.definition.contact_count = 2;
  f.definition.ends = AMBULO_ENDS_MIRRORED;
  f.table.row_count = 0;
  ambulo__patch_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "contact", "hand_r", "ahead", 1.0), 0);
  assert_int_equal(row_count(&f, "contact", "hand_l", "ahead", 0.0), 1);
  row_fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(patches_stay_on_their_places_within_the_tolerance),
      cmocka_unit_test(a_wall_has_its_own_axes),
      cmocka_unit_test(without_a_tolerance_they_are_equations),
      cmocka_unit_test(planar_bodies_have_none_to_the_side),
      cmocka_unit_test(events_hold_both),
      cmocka_unit_test(ends_that_match_are_held_once)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
