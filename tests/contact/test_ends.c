/* End rows: prescribed values, periodic and mirrored matching with travel and scale.
 *
 * Cubic B-spline, 4 intervals in 1 s: the largest weights at t = 0 are 3 K / T = 12 of the
 * first derivative and 9 (K / T)^2 = 144 of the second. */
#include "support/row_fixture.h"

static void set(row_fixture *f, int node, int coordinate, double q, double qd, double qdd) {
  *row_channel(f, node, ambulo__channel_q(&f->context.channels, coordinate)) = q;
  *row_channel(f, node, ambulo__channel_qd(&f->context.channels, coordinate)) = qd;
  *row_channel(f, node, ambulo__channel_qdd(&f->context.channels, coordinate)) = qdd;
}

static void prescribed_values(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  const ambulo_end_value values[] = {{3, 0, 0, 0.4}, {2, 1, 1, 1.2}, {4, 2, 1, -1.0}};
  f.definition.end_values = values;
  f.definition.end_value_count = 3;
  ambulo__end_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, 3);
  set(&f, 0, 3, 0.5, 0.0, 0.0);
  set(&f, 4, 2, 9.0, 1.5, 9.0);
  set(&f, 4, 4, 9.0, 9.0, 2.0);
  int row = row_find(&f, "initial_state", "hip_r", "value", 0.0);
  assert_close(row_value(&f, row), 0.1, 1e-15);
  assert_string_equal(f.table.rows[row].unit, "rad");
  row = row_find(&f, "final_state", "pelvis_tx", "rate", 1.0);
  assert_close(row_value(&f, row), 0.3, 1e-15);
  assert_string_equal(f.table.rows[row].unit, "m/s");
  assert_int_equal(f.table.rows[row].node, 4);
  row = row_find(&f, "final_state", "knee_r", "acceleration", 1.0);
  assert_close(row_value(&f, row), 3.0, 1e-15);
  assert_string_equal(f.table.rows[row].unit, "rad/s^2");
  row_fixture_close(&f);
}

static void periodic_ends(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.ends = AMBULO_ENDS_PERIODIC;
  f.definition.ends_order = 2;
  f.definition.travel = 1.2;
  ambulo__end_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, 7 * 3);
  for (int i = 1; i < 3; i++) {
    set(&f, 0, i, 0.1, 2.0, 10.0);
    set(&f, 4, i, 1.5, 3.2, -20.0);
  }
  int tx = row_find(&f, "periodic", "pelvis_tx", "value", 1.0);
  assert_close(row_value(&f, tx), 0.2, 1e-14);
  assert_int_equal(f.table.rows[tx].node, -1);
  assert_close(row_value(&f, row_find(&f, "periodic", "pelvis_ty", "value", 1.0)), 1.4, 1e-14);
  assert_close(row_value(&f, row_find(&f, "periodic", "pelvis_ty", "rate", 1.0)), 0.1, 1e-14);
  assert_close(row_value(&f, row_find(&f, "periodic", "pelvis_ty", "acceleration", 1.0)),
               -30.0 / 144.0, 1e-14);
  row_fixture_close(&f);
}

static void mirrored_ends(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.ends = AMBULO_ENDS_MIRRORED;
  f.definition.travel = 0.6;
  ambulo__end_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, 7 * 2);
  set(&f, 0, 0, 0.02, 0.0, 0.0);
  set(&f, 4, 0, -0.05, 0.0, 0.0);
  set(&f, 0, 2, 0.1, 0.0, 0.0);
  set(&f, 4, 2, 0.8, 0.0, 0.0);
  set(&f, 0, 3, 0.3, 1.2, 0.0);
  set(&f, 4, 5, 0.5, 3.6, 0.0);
  assert_close(row_value(&f, row_find(&f, "mirrored", "pelvis_tz", "value", 1.0)), -0.03, 1e-14);
  assert_close(row_value(&f, row_find(&f, "mirrored", "pelvis_tx", "value", 1.0)), 0.1, 1e-14);
  assert_close(row_value(&f, row_find(&f, "mirrored", "hip_l", "value", 1.0)), 0.2, 1e-14);
  assert_close(row_value(&f, row_find(&f, "mirrored", "hip_l", "rate", 1.0)), 0.2, 1e-14);
  row_fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(prescribed_values),
                                     cmocka_unit_test(periodic_ends),
                                     cmocka_unit_test(mirrored_ends)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
