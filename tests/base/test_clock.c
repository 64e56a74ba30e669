/* The clock: the seconds of the system's monotonic clock, and never back. */
#include "base/clock.h"
#include "support/test.h"

#include <time.h>

static double system_seconds(void) {
  struct timespec now;
  assert_int_equal(clock_gettime(CLOCK_MONOTONIC, &now), 0);
  return (double)now.tv_sec + (double)now.tv_nsec / 1e9;
}

/* each reading lies between two of the system's, up to the rounding of a double */
static void it_counts_seconds(void **state) {
  (void)state;
  for (int i = 0; i < 1000; i++) {
    double before = system_seconds(), now = ambulo__seconds_now(), after = system_seconds();
    assert_true(now >= before - 1e-8 && now <= after + 1e-8);
  }
}

static void it_never_goes_back(void **state) {
  (void)state;
  double last = ambulo__seconds_now();
  for (int i = 0; i < 1000; i++) {
    double now = ambulo__seconds_now();
    assert_true(now >= last);
    last = now;
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(it_counts_seconds),
                                     cmocka_unit_test(it_never_goes_back)};
  return cmocka_run_group_tests_name("base/clock", tests, NULL, NULL);
}
