/* The clock: seconds, and never back. */
#include "base/clock.h"
#include "support/test.h"

#include <time.h>

static void it_never_goes_back(void **state) {
  (void)state;
  double last = ambulo__seconds_now();
  for (int i = 0; i < 1000; i++) {
    double now = ambulo__seconds_now();
    assert_true(now >= last);
    last = now;
  }
}

/* between two readings of the same clock, whatever happens on the machine */
static void it_counts_seconds(void **state) {
  (void)state;
  struct timespec before, after;
  clock_gettime(CLOCK_MONOTONIC, &before);
  double now = ambulo__seconds_now();
  clock_gettime(CLOCK_MONOTONIC, &after);
  double low = (double)before.tv_sec + 1e-9 * (double)before.tv_nsec;
  double high = (double)after.tv_sec + 1e-9 * (double)after.tv_nsec;
  assert_true(now >= low - 1e-6 && now <= high + 1e-6);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(it_never_goes_back),
                                     cmocka_unit_test(it_counts_seconds)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
