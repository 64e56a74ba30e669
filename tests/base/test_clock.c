/* The clock: seconds, and never back. */
#include "base/clock.h"
#include "support/test.h"

#include <time.h>

static void it_counts_seconds(void **state) {
  (void)state;
  double before = ambulo__seconds_now();
  struct timespec pause = {0, 20000000};
  while (nanosleep(&pause, &pause) != 0) continue;
  assert_true(ambulo__seconds_now() - before >= 0.02);
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
