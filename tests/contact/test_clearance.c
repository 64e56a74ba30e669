/* Clearance of the right foot in the air from 0.1 to 0.9 s; nodes at 0.25, 0.5, 0.75 s:
 * s = 0.1875, 0.5, 0.8125. At q = 0 its sole is on the ground, its heel at 0.09 m to the right. */
#include "contact/row_families.h"
#include "support/row_fixture.h"

static const ambulo_contact contacts[] = {
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.1, .place = {0.0, -0.08}},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.3, 0.1}},
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.9, 1.0, .place = {0.6, -0.1}}};

static void open_with(row_fixture *f, int planar) {
  row_fixture_open(f, planar);
  f->definition.contacts = contacts;
  f->definition.contact_count = 3;
  f->definition.clearance.height = 0.02;
  for (int k = 0; k < ROW_NODES; k++) f->active[2 * k + WALKER_LEFT] = 1;
  f->active[WALKER_RIGHT] = 0;
  f->active[2 * (ROW_NODES - 1) + WALKER_RIGHT] = 2;
  f->model->feet[WALKER_RIGHT].has_tip = 1;
  f->model->feet[WALKER_RIGHT].tip = f->model->feet[WALKER_RIGHT].toe[0];
  ambulo__clearance_rows(&f->context, &f->table);
}

static void expect(row_fixture *f, const char *subject, const char *detail, double time,
                   double value) {
  int row = row_find(f, "clearance", subject, detail, time);
  assert_int_equal(f->table.rows[row].relation, AMBULO_NOT_NEGATIVE);
  assert_close(row_value(f, row), value, 1e-12);
}

static void heights_follow_the_swing(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 0);
  expect(&f, "r_toe", "low", 0.25, -0.02 * 4.0 * 0.1875);
  expect(&f, "r_heel", "low", 0.25, -0.01 * 4.0 * 0.1875);
  expect(&f, "r_toe", "low", 0.5, -0.02);
  expect(&f, "r_toe", "low", 0.75, -0.02); /* 6 (1 - s) is still above 1 */
  expect(&f, "r_toe", "high", 0.5, 0.35);
  expect(&f, "r_toe_in", "low", 0.5, -0.02);
  /* not the tip before s = 0.3; 3 rows pairs of height, yaw, roll, track, and the tip twice */
  assert_int_equal(f.table.row_count, 3 * 2 * 5 + 2 * 2);
  row_fixture_close(&f);
}

/* a foot that comes down on its toes: its tip may be lower on the way down, as far as it is ahead
 * of the ball once it is there */
static void a_tip_that_lands_may_be_low(void **state) {
  (void)state;
  static const ambulo_contact landing[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.1, .place = {0.0, -0.08}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.3, 0.1}},
      {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.8, 1.0, .place = {0.6, -0.1}}};
  row_fixture f;
  open_with(&f, 0);
  double ahead = 0.0, tip[3], ball[3]; /* swing: 0.1 to 0.8 s */
  ambulo__neutral_point(f.model, f.model->feet[WALKER_RIGHT].tip, tip);
  ambulo__neutral_point(f.model, f.model->feet[WALKER_RIGHT].toe_center, ball);
  for (int i = 0; i < 3; i++) ahead = hypot(ahead, tip[i] - ball[i]);
  double part = 6.0 * (0.8 - 0.75) / 0.7;
  f.definition.contacts = landing;
  f.table.row_count = 0;
  ambulo__clearance_rows(&f.context, &f.table);
  assert_true(ahead > 0.01 && part < 1.0);
  expect(&f, "r_toe_in", "low", 0.5, -0.02);
  expect(&f, "r_toe_in", "low", 0.75, -(0.02 * part - ahead * (1.0 - part)));
  expect(&f, "r_toe", "low", 0.75, -0.02 * part);
  /* not on its heel, nor on the way up, nor on a step */
  static const ambulo_contact_mode mode[] = {AMBULO_CONTACT_HEEL, AMBULO_CONTACT_TOE};
  for (int k = 0; k < 2; k++) {
    ambulo_contact others[3] = {landing[0], landing[1], landing[2]};
    others[2].mode = mode[k];
    if (k == 1) others[2].place[2] = 0.1;
    f.definition.contacts = others;
    assert_close(ambulo__tip_drop(&f.definition, WALKER_RIGHT, 0.75, 0.65 / 0.7), 0.0, 0.0);
  }
  f.definition.contacts = landing;
  assert_close(ambulo__tip_drop(&f.definition, WALKER_RIGHT, 0.15, 0.05 / 0.7), 0.0, 0.0);
  assert_close(ambulo__tip_drop(&f.definition, WALKER_RIGHT, 0.75, 0.65 / 0.7), ahead, 1e-15);
  row_fixture_close(&f);
}

/* at 0.25 s the foot has just left (s = 0.1875 all the same), at 0.75 s it comes down */
static void swings_hold_at_both_their_ends(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.contacts = (const ambulo_contact[]){
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.25, .place = {0.0, -0.08}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.3, 0.1}},
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.75, 1.0, .place = {0.6, -0.1}}};
  f.definition.contact_count = 3;
  f.definition.clearance.height = 0.02;
  f.definition.clearance.tip_from = 0.5;
  f.model->feet[WALKER_RIGHT].has_tip = 1;
  f.model->feet[WALKER_RIGHT].tip = f.model->feet[WALKER_RIGHT].toe[0];
  for (int k = 0; k < ROW_NODES; k++) f.active[2 * k + WALKER_LEFT] = 1;
  f.active[WALKER_RIGHT] = 0;
  f.active[2 * 3 + WALKER_RIGHT] = f.active[2 * 4 + WALKER_RIGHT] = 2;
  row_event(&f, 1, WALKER_RIGHT, 0);
  row_event(&f, 3, WALKER_RIGHT, -1);
  ambulo__clearance_rows(&f.context, &f.table);
  expect(&f, "r_toe", "low", 0.25, 0.0);
  expect(&f, "r_toe", "low", 0.5, -0.02);
  expect(&f, "r_toe_in", "low", 0.5, -0.02); /* the tip's own event is a node: s = tip_from */
  expect(&f, "r_toe", "low", 0.75, 0.0);
  expect(&f, "r_toe", "high", 0.75, 0.35);
  assert_int_equal(f.table.row_count, 3 * 2 * 5 + 2 * 2);
  row_fixture_close(&f);
}

/* of a motion that repeats, the last node has what ends there: the swing before the strike at T */
static void the_last_swing_ends_at_the_last_node(void **state) {
  (void)state;
  for (int strikes = 0; strikes < 2; strikes++) {
    row_fixture f;
    row_fixture_open(&f, 0);
    f.definition.contacts = (const ambulo_contact[]){
        {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, strikes ? 0.75 : 0.5, .place = {0.0, -0.08}},
        {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.3, 0.1}}};
    f.definition.contact_count = 2;
    f.definition.clearance.height = 0.02;
    f.definition.contact_tolerance = 0.002;
    f.definition.ends = AMBULO_ENDS_PERIODIC;
    for (int k = 0; k < ROW_NODES; k++) f.active[2 * k + WALKER_LEFT] = 1;
    f.active[WALKER_RIGHT] = strikes ? 0 : -1;
    row_event(&f, 4, WALKER_RIGHT, -1);
    ambulo__clearance_rows(&f.context, &f.table);
    assert_int_equal(row_count(&f, "clearance", "r_toe", "low", 1.0), strikes);
    for (int r = 0; r < f.table.row_count; r++)
      if (f.table.rows[r].node == 4) assert_int_equal(f.table.rows[r].before, 1);
    assert_int_equal(f.table.before, 0);
    row_fixture_close(&f);
  }
}

/* and a tip that lands there with the ball may be as low as it is ahead of the ball: with the
 * contact of the next period, with one that only begins there, and that of a motion that does not
 * repeat */
static void the_last_landing_may_have_a_low_tip(void **state) {
  (void)state;
  for (int k = 0; k < 6; k++) {
    int on_toes = k % 2, begins = k >= 2;
    ambulo_contact_mode mode = on_toes ? AMBULO_CONTACT_TOE : AMBULO_CONTACT_FLAT;
    row_fixture f;
    row_fixture_open(&f, 0);
    f.definition.contacts = (const ambulo_contact[]){
        {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.3, 0.1}},
        {WALKER_RIGHT, k < 4 ? mode : AMBULO_CONTACT_FLAT, 0.0, 0.5, .place = {0.0, -0.08}},
        {WALKER_RIGHT, mode, 1.0, 1.0, .place = {0.6, -0.08}}};
    f.definition.contact_count = begins ? 3 : 2;
    f.definition.clearance.height = 0.02;
    f.definition.contact_tolerance = 0.002;
    f.definition.ends = k < 4 ? AMBULO_ENDS_PERIODIC : AMBULO_ENDS_FREE;
    ambulo_foot *foot = &f.model->feet[WALKER_RIGHT];
    foot->has_tip = 1;
    foot->tip = foot->toe[0];
    for (int node = 0; node < ROW_NODES; node++) f.active[2 * node + WALKER_LEFT] = 0;
    for (int node = 0; node < 2; node++) f.active[2 * node + WALKER_RIGHT] = 1;
    row_event(&f, 4, WALKER_RIGHT, -1);
    if (begins) f.active[2 * 4 + WALKER_RIGHT] = 2;
    ambulo__clearance_rows(&f.context, &f.table);
    expect(&f, "r_toe_in", "low", 1.0, on_toes ? 0.04 : 0.0); /* half of the foot's width */
    expect(&f, "r_toe_in", "low", 0.75, -0.02);               /* 6 (1 - s) is still above 1 */
    assert_close(ambulo__tip_drop(&f.definition, WALKER_RIGHT, 0.95, 0.9), on_toes ? 0.04 : 0.0,
                 1e-15);
    if (k == 5) { /* it is the other foot that lands */
      f.definition.contacts = (const ambulo_contact[]){
          {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.5, .place = {0.0, -0.08}},
          {WALKER_LEFT, AMBULO_CONTACT_TOE, 1.0, 1.0, .place = {0.6, 0.1}}};
      f.definition.contact_count = 2;
      assert_close(ambulo__tip_drop(&f.definition, WALKER_RIGHT, 0.95, 0.9), 0.0, 0.0);
    }
    row_fixture_close(&f);
  }
}

static void the_track_is_that_of_the_next_foothold(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 0);
  expect(&f, "r_heel", "to the left", 0.5, 0.03 - (-0.09 + 0.1));
  expect(&f, "r_heel", "to the right", 0.5, 0.06 + (-0.09 + 0.1));
  expect(&f, "right", "turned left", 0.5, 0.2);
  expect(&f, "right", "left side low", 0.5, 0.2);
  row_fixture_close(&f);
}

/* the other foot: outward is now to the left. Left heel at 0.09 m, next foothold at 0.1 m */
static void the_left_foot_is_the_mirror_image(void **state) {
  (void)state;
  static const ambulo_contact mirrored[] = {
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 0.1, .place = {0.0, 0.08}},
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.3, -0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.9, 1.0, .place = {0.6, 0.1}}};
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.contacts = mirrored;
  f.definition.contact_count = 3;
  f.definition.clearance.height = 0.02;
  for (int k = 0; k < ROW_NODES; k++) f.active[2 * k + WALKER_RIGHT] = 1;
  f.active[WALKER_LEFT] = 0;
  f.active[2 * (ROW_NODES - 1) + WALKER_LEFT] = 2;
  ambulo__clearance_rows(&f.context, &f.table);
  expect(&f, "l_heel", "to the left", 0.5, 0.06 - (0.09 - 0.1));
  expect(&f, "l_heel", "to the right", 0.5, 0.03 + (0.09 - 0.1));
  row_fixture_close(&f);
}

static void planar_feet_only_have_heights(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 1);
  assert_int_equal(f.table.row_count, 3 * 2 * 2 + 2 * 2);
  row_fixture_close(&f);
}

static int test_clearance_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(heights_follow_the_swing),
                                     cmocka_unit_test(a_tip_that_lands_may_be_low),
                                     cmocka_unit_test(swings_hold_at_both_their_ends),
                                     cmocka_unit_test(the_last_swing_ends_at_the_last_node),
                                     cmocka_unit_test(the_last_landing_may_have_a_low_tip),
                                     cmocka_unit_test(the_track_is_that_of_the_next_foothold),
                                     cmocka_unit_test(the_left_foot_is_the_mirror_image),
                                     cmocka_unit_test(planar_feet_only_have_heights)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* A foot in the air passes beside the other. The walker's feet are 0.18 m apart at q = 0, each
 * 0.08 m wide; nodes every 0.25 s up to 1 s, so that 0.0625 m are added for what happens between.
 */

static const double gap = 0.05, kept = 0.08 + 0.05 + 0.0625;
static const char near[] = "near the other foot";

static const ambulo_contact test_feet_apart_contacts[] = {
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.25, .place = {0.0, -0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.3, 0.1}},
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.75, 1.0, .place = {0.6, -0.1}}};

/* the right foot in the air from 0.25 to 0.75 s */
static void test_feet_apart_open_with(row_fixture *f, int planar) {
  row_fixture_open(f, planar);
  f->definition.contacts = test_feet_apart_contacts;
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

static void test_feet_apart_expect(row_fixture *f, const char *subject, double time, double value) {
  int row = row_find(f, "clearance", subject, near, time);
  assert_int_equal(f->table.rows[row].relation, AMBULO_NOT_NEGATIVE);
  assert_close(row_value(f, row), value, 1e-12);
}

static void the_four_ends_keep_the_gap(void **state) {
  (void)state;
  row_fixture f;
  test_feet_apart_open_with(&f, 0);
  ambulo__feet_apart_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, 2 * 4); /* at 0.25 and 0.5 s, when it is in the air */
  static const char *const ends[] = {"r_heel", "r_toe", "l_heel", "l_toe"};
  for (int i = 0; i < 4; i++) test_feet_apart_expect(&f, ends[i], 0.5, of_distance(0.18));
  /* the right heel moves beyond the left toe, 0.22 m ahead of the heel, and 0.1 m up */
  double *heel = row_channel(
      &f, 2,
      ambulo__channel_point(&f.context.channels, f.model->feet[WALKER_RIGHT].heel_center, 0));
  heel[0] += 0.25;
  heel[1] += 0.1;
  test_feet_apart_expect(&f, "r_heel", 0.5, of_distance(hypot(0.03, 0.18)));
  row_fixture_close(&f);
}

/* where it leaves the ground and where it comes down; either foot */
static void test_feet_apart_swings_hold_at_both_their_ends(void **state) {
  (void)state;
  for (int foot = 0; foot < 2; foot++) {
    row_fixture f;
    test_feet_apart_open_with(&f, 0);
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
    test_feet_apart_open_with(&f, which == 0);
    if (which == 1) f.definition.clearance.feet = AMBULO_OFF;
    if (which == 2) f.active[2 + WALKER_RIGHT] = f.active[4 + WALKER_RIGHT] = 0;
    ambulo__feet_apart_rows(&f.context, &f.table);
    assert_int_equal(f.table.row_count, 0);
    row_fixture_close(&f);
  }
}

static int test_feet_apart_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_four_ends_keep_the_gap),
      cmocka_unit_test(test_feet_apart_swings_hold_at_both_their_ends),
      cmocka_unit_test(others_have_none)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_clearance_tests() + test_feet_apart_tests();
}
