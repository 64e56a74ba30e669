/* What counts as hardly an angle in radians, hardly a length in metres. */
#include "formats/motion_units.h"
#include "support/test.h"

static double bound(ambulo_joint_type type, double lower, double upper) {
  ambulo_coordinate c = ambulo_coordinate_default();
  c.type = type;
  c.range[0] = lower;
  c.range[1] = upper;
  return ambulo__largest_plausible(&c);
}

static void bounds_follow_the_range(void **state) {
  (void)state;
  const double turn = 6.283185307179586;
  assert_close(bound(AMBULO_REVOLUTE, -0.3, 0.2), 3.0, 1e-14);
  assert_close(bound(AMBULO_REVOLUTE, 0.0, 2.1), turn, 1e-14);
  assert_close(bound(AMBULO_REVOLUTE, -20.0, 2.0), 40.0, 1e-14);
  assert_close(bound(AMBULO_REVOLUTE, -1.0, INFINITY), 10.0 * turn, 1e-14);
  assert_close(bound(AMBULO_PRISMATIC, -0.2, 0.1), 2.0, 1e-14);
  assert_true(isinf(bound(AMBULO_PRISMATIC, -INFINITY, INFINITY)));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(bounds_follow_the_range)};
  return cmocka_run_group_tests_name("format/motion_units", tests, NULL, NULL);
}
