/* Ground rows: which corners, which relation, which height. */
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(heights_by_mode),
                                     cmocka_unit_test(corners_at_events),
                                     cmocka_unit_test(feet_in_the_air_stay_above_the_lower_step),
                                     cmocka_unit_test(planar_feet_have_two_corners)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
