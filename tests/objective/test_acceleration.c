/* Squared acceleration: u^2. */
#include "objective/term.h"
#include "support/test.h"

static void values_by_hand(void **state) {
  (void)state;
  ambulo__residual r = ambulo__acceleration(-3.0);
  assert_close(r.value, 9.0, 0.0);
  assert_close(r.slope, -6.0, 0.0);
  assert_close(r.curvature, 2.0, 0.0);
}

static void the_slope_is_the_derivative(void **state) {
  (void)state;
  for (double u = -2.0; u < 2.0; u += 0.37) {
    double h = 1e-6;
    double numeric =
        (ambulo__acceleration(u + h).value - ambulo__acceleration(u - h).value) / (2.0 * h);
    assert_close(ambulo__acceleration(u).slope, numeric, 1e-8);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(values_by_hand),
                                     cmocka_unit_test(the_slope_is_the_derivative)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
