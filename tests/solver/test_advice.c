/* How suggestions are written down; their sentences and settings are in test_suggest*.c. */
#include "solver/advice.h"
#include "support/test.h"

#include <math.h>

static void new_values_are_rounded_outward(void **state) {
  (void)state;
  assert_close(ambulo__outward(0.123449, 1), 0.1235, 1e-15);
  assert_close(ambulo__outward(0.123451, 0), 0.1234, 1e-15);
  assert_close(ambulo__outward(-123.44, 0), -123.5, 1e-12);
  assert_close(ambulo__outward(-123.46, 1), -123.4, 1e-12);
  assert_close(ambulo__outward(0.25, 1), 0.25, 1e-15);
  assert_true(ambulo__outward(0.0, 1) == 0.0 && isinf(ambulo__outward(INFINITY, 1)));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(new_values_are_rounded_outward)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
