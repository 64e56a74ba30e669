/* Ground rows: which corners, which relation, which height. */
#include "support/row_fixture.h"

static void heights_by_mode(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  const ambulo_contact contacts[] = {{WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.2, {0, 0}},
                                     {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.2, 0.4, {0, 0}},
                                     {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.4, 0.6, {0, 0}}};
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

static void planar_feet_have_two_corners(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 1);
  ambulo__ground_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, ROW_NODES * 4);
  row_fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(heights_by_mode),
                                     cmocka_unit_test(planar_feet_have_two_corners)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
