/* The clock: the seconds of the system's monotonic clock, and never back. */
#include "base/machine.h"
#include "support/test.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

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

/* What the machine has left, and what a limit on the address space leaves of it. */

static void numbers_are_read(void **state) {
  (void)state;
  double first = -1.0, second = -1.0;
  assert_int_equal(ambulo__read_numbers("/nowhere/at/all", &first, &second), 0);
  if (access("/proc/self/statm", R_OK) != 0) skip(); /* the system has no such files */
  assert_int_equal(ambulo__read_numbers("/proc/self/statm", &first, &second), 2);
  assert_true(first > second && second > 0.0);
}

/* in a process of its own, since the limit cannot be lifted again */
static void a_limit_leaves_less(void **state) {
  (void)state;
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    struct rlimit space = {(rlim_t)3 << 30, (rlim_t)3 << 30};
    if (setrlimit(RLIMIT_AS, &space)) _exit(0);
    double megabytes = ambulo__free_megabytes();
    _exit(megabytes >= 1.0 && megabytes <= 3072.0 ? 0 : 1);
  }
  int status = 1;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFEXITED(status));
  assert_int_equal(WEXITSTATUS(status), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(it_counts_seconds), cmocka_unit_test(it_never_goes_back),
      cmocka_unit_test(numbers_are_read), cmocka_unit_test(a_limit_leaves_less)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
