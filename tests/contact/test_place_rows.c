/* Ground rows: which corners, which relation, which height. */
#include "contact/row_families.h"
#include "contact/rows.h"
#include "support/patched_walker.h"
#include "support/row_fixture.h"

static void heights_by_mode(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  const ambulo_contact contacts[] = {{WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.2, .place = {0, 0}},
                                     {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.2, 0.4, .place = {0, 0}},
                                     {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.4, 0.6, .place = {0, 0}}};
  f.definition.contacts = contacts;
  f.definition.ground_height = 0.3;
  for (int k = 0; k < 3; k++) f.active[2 * k + WALKER_LEFT] = k;
  ambulo__ground_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, ROW_NODES * 8);
  *row_channel(&f, 1,
               ambulo__channel_point(&f.context.channels,
                                     ambulo_model_find_point(f.model, "l_toe_in"), 1)) = 0.7;
  assert_close(row_value(&f, row_find(&f, "ground_penetration", "l_toe_in", "height", 0.25)), 0.4,
               1e-15);
  static const char *const corners[] = {"l_heel_in", "l_heel_out", "l_toe_in", "l_toe_out"};
  static const int equal[4][4] = {{1, 1, 0, 0}, {1, 1, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 0}};
  for (int k = 0; k < 4; k++) {
    for (int c = 0; c < 4; c++) {
      int row = row_find(&f, "ground_penetration", corners[c], "height", f.times[k]);
      assert_int_equal(f.table.rows[row].relation,
                       equal[k][c] ? AMBULO_EQUAL : AMBULO_NOT_NEGATIVE);
      assert_int_equal(f.table.rows[row].node, k);
      assert_string_equal(f.table.rows[row].unit, "m");
    }
  }
  row_fixture_close(&f);
}

/* a corner that is down before or after an event is down at it; one row each */
static void corners_at_events(void **state) {
  (void)state;
  static const ambulo_contact contacts[] = {
      {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.25, .place = {0, 0}},
      {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.25, 0.5, .place = {0, 0}}};
  for (int tolerance = 0; tolerance < 2; tolerance++) {
    row_fixture f;
    row_fixture_open(&f, 0);
    f.definition.contacts = contacts;
    f.definition.contact_tolerance = 0.002 * tolerance;
    f.active[WALKER_LEFT] = 0;
    f.active[2 + WALKER_LEFT] = 1;
    row_event(&f, 1, WALKER_LEFT, 0);
    row_event(&f, 2, WALKER_LEFT, 1);
    ambulo__ground_rows(&f.context, &f.table);
    static const char *const corners[] = {"l_heel_in", "l_heel_out", "l_toe_in", "l_toe_out"};
    for (int c = 0; c < 4; c++) {
      assert_int_equal(row_count(&f, "ground_penetration", corners[c], "height", 0.25), !tolerance);
      int row = row_find(&f, "ground_penetration", corners[c], "height", 0.5); /* leaves it */
      assert_int_equal(f.table.rows[row].relation,
                       c >= 2 && !tolerance ? AMBULO_EQUAL : AMBULO_NOT_NEGATIVE);
      if (tolerance) continue;
      row = row_find(&f, "ground_penetration", corners[c], "height", 0.25);
      assert_int_equal(f.table.rows[row].relation, AMBULO_EQUAL);
    }
    row_fixture_close(&f);
  }
}

static void planar_feet_have_two_corners(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 1);
  ambulo__ground_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, ROW_NODES * 4);
  row_fixture_close(&f);
}

/* a foot that comes down from 0.3 m to 0.1 m stays above its own step, then above the lower one */
static void feet_in_the_air_stay_above_the_lower_step(void **state) {
  (void)state;
  static const ambulo_contact contacts[] = {
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 0.2, .place = {0, 0, 0.3}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.7, 1.0, .place = {0.3, 0, 0.1}}};
  static const double height[ROW_NODES] = {0.3, 0.1, 0.1, 0.1, 0.1};
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.contacts = contacts;
  f.definition.contact_count = 2;
  f.active[WALKER_LEFT] = 0;
  f.active[2 * 3 + WALKER_LEFT] = f.active[2 * 4 + WALKER_LEFT] = 1;
  ambulo__ground_rows(&f.context, &f.table);
  for (int k = 0; k < ROW_NODES; k++) {
    int left = row_find(&f, "ground_penetration", "l_toe_in", "height", f.times[k]);
    int right = row_find(&f, "ground_penetration", "r_toe_in", "height", f.times[k]);
    assert_close(row_value(&f, left), -height[k], 1e-15); /* the sole is at 0 */
    assert_close(row_value(&f, right), 0.0, 1e-15);
  }
  row_fixture_close(&f);
}

static int test_ground_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(heights_by_mode),
                                     cmocka_unit_test(corners_at_events),
                                     cmocka_unit_test(feet_in_the_air_stay_above_the_lower_step),
                                     cmocka_unit_test(planar_feet_have_two_corners)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Strike rows at q = 0: left heel at (-0.05, 0.09), left toe at (0.17, 0.09) m. */

static void open_with(row_fixture *f, int planar, const ambulo_contact *contacts) {
  row_fixture_open(f, planar);
  f->definition.contacts = contacts;
  for (int k = 0; k < 3; k++) f->active[2 * k + WALKER_LEFT] = k;
  ambulo__foot_strike_rows(&f->context, &f->table);
}

static const ambulo_contact contacts[] = {
    {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.2, .place = {0.6, 0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.2, 0.4, .place = {0.6, 0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.4, 0.6, .place = {0.6, 0.1}}};

static void places_by_mode(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 0, contacts);
  static const struct {
    const char *point, *detail;
    double time, value;
  } expected[] = {{"l_heel", "forward", 0.0, -0.65},  {"l_heel", "left", 0.0, -0.01},
                  {"l_heel", "forward", 0.25, -0.65}, {"l_heel", "left", 0.25, -0.01},
                  {"l_toe", "heading", 0.25, -0.01},  {"l_toe", "forward", 0.5, 0.17 - 0.82},
                  {"l_toe", "left", 0.5, -0.01}};
  assert_int_equal(f.table.row_count, 7);
  for (int i = 0; i < 7; i++) {
    int row = row_find(&f, "foot_strike", expected[i].point, expected[i].detail, expected[i].time);
    assert_int_equal(row, i);
    assert_int_equal(f.table.rows[row].relation, AMBULO_EQUAL);
    assert_close(row_value(&f, row), expected[i].value, 1e-14);
  }
  row_fixture_close(&f);
}

/* at an event both points are held; a flat foot holds its toes already */
static void points_at_events(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.contacts = contacts;
  for (int k = 1; k < 3; k++) f.active[2 * k + WALKER_LEFT] = k;
  row_event(&f, 1, WALKER_LEFT, 0);
  row_event(&f, 2, WALKER_LEFT, 1);
  row_event(&f, 3, WALKER_LEFT, 2);
  ambulo__foot_strike_rows(&f.context, &f.table);
  for (int k = 1; k < 3; k++) {
    assert_int_equal(row_count(&f, "foot_strike", "l_heel", "forward", 0.25 * k), 1);
    assert_int_equal(row_count(&f, "foot_strike", "l_heel", "left", 0.25 * k), 1);
    assert_int_equal(row_count(&f, "foot_strike", "l_toe", "heading", 0.25 * k), 1);
    assert_int_equal(row_count(&f, "foot_strike", "l_toe", "forward", 0.25 * k), 0);
  }
  assert_int_equal(row_count(&f, "foot_strike", "l_toe", "forward", 0.75), 1);
  assert_int_equal(f.table.row_count, 3 + 3 + 2);
  row_fixture_close(&f);
}

/* heel to toes at once, and a foot that goes on elsewhere: nothing covers anything */
static void unlike_contacts_both_hold(void **state) {
  (void)state;
  static const ambulo_contact apart[] = {
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 0.25, .place = {0.6, 0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.25, 0.5, .place = {0.7, 0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.5, 1.0, .place = {0.7, 0.1}}};
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.contacts = apart;
  for (int k = 1; k < 3; k++) f.active[2 * k + WALKER_LEFT] = k;
  row_event(&f, 1, WALKER_LEFT, 0);
  row_event(&f, 2, WALKER_LEFT, 1);
  ambulo__foot_strike_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "foot_strike", "l_heel", "forward", 0.25), 2);
  assert_int_equal(row_count(&f, "foot_strike", "l_heel", "forward", 0.5), 1);
  assert_int_equal(row_count(&f, "foot_strike", "l_toe", "forward", 0.5), 1);
  row_fixture_close(&f);
}

static void planar_models_have_no_lateral_rows(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 1, contacts);
  assert_int_equal(f.table.row_count, 3);
  for (int r = 0; r < 3; r++) assert_string_equal(f.table.rows[r].detail, "forward");
  row_fixture_close(&f);
}

static int test_foot_strike_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(places_by_mode),
                                     cmocka_unit_test(points_at_events),
                                     cmocka_unit_test(unlike_contacts_both_hold),
                                     cmocka_unit_test(planar_models_have_no_lateral_rows)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Rows that hold patches: hands of the walker at q = 0 at (0.4, 1.22, -+0.25) m, x forward, y up.
 */

/* a rail that is held from above, and a wall ahead that is pushed */
static const ambulo_contact test_patch_rows_contacts[] = {
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
  f->definition.contacts = test_patch_rows_contacts;
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
    ambulo_contact one[] = {test_patch_rows_contacts[1], test_patch_rows_contacts[1]};
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
  ambulo_contact through = test_patch_rows_contacts[1];
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

static int test_patch_rows_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(patches_stay_on_their_places_within_the_tolerance),
      cmocka_unit_test(a_wall_has_its_own_axes),
      cmocka_unit_test(without_a_tolerance_they_are_equations),
      cmocka_unit_test(planar_bodies_have_none_to_the_side),
      cmocka_unit_test(events_hold_both),
      cmocka_unit_test(ends_that_match_are_held_once)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_ground_tests() + test_foot_strike_tests() + test_patch_rows_tests();
}
