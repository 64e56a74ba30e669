/* Passive torque and strength as functions of the angle. */
#include "problem/term.h"
#include "support/test.h"

static void passive_torque_and_its_derivative(void **state) {
  (void)state;
  /* hip, men of 18-25 years: Anderson et al. 2007, Table 3 */
  static const double curve[] = {-1.21, -6.351, 0.476, 5.91};
  for (double q = -0.4; q < 0.5; q += 0.11) {
    double slope, ignored, h = 1e-6;
    double value = ambulo__passive_torque(curve, q, &slope);
    assert_close(value, -1.21 * exp(-6.351 * q) + 0.476 * exp(5.91 * q), 1e-14);
    double numeric = (ambulo__passive_torque(curve, q + h, &ignored) -
                      ambulo__passive_torque(curve, q - h, &ignored)) /
                     (2.0 * h);
    assert_close(slope, numeric, 1e-7);
  }
}

static void strength_is_a_cosine_that_stays_positive(void **state) {
  (void)state;
  static const double curve[] = {200.0, 0.958, 0.932};
  double slope, ignored;
  assert_close(ambulo__strength(curve, 0.932, &slope), 200.0, 1e-15);
  assert_close(slope, 0.0, 1e-12);
  for (double q = -3.0; q < 3.0; q += 0.17) {
    double h = 1e-6, value = ambulo__strength(curve, q, &slope);
    assert_true(value > 0.0);
    double numeric =
        (ambulo__strength(curve, q + h, &ignored) - ambulo__strength(curve, q - h, &ignored)) /
        (2.0 * h);
    assert_close(slope, numeric, 1e-6);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(passive_torque_and_its_derivative),
                                     cmocka_unit_test(strength_is_a_cosine_that_stays_positive)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
