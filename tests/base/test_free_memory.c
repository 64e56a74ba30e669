/* What the machine has left, and what a limit on the address space leaves of it. */
#include "base/free_memory.h"
#include "support/test.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

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
  const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_are_read),
                                     cmocka_unit_test(a_limit_leaves_less)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
