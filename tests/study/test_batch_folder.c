/* Locks of a batch folder: who holds it, shards beside each other, other divisions refused.
 *
 * POSIX locks belong to a process, so the holder is a child that waits on a pipe. */
#include "study/batch.h"
#include "support/messages.h"
#include "support/scratch.h"

#include <signal.h>
#include <sys/wait.h>

static pid_t hold(void **state, int shard, int shards) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  int ready[2];
  assert_int_equal(pipe(ready), 0);
  pid_t child = fork();
  assert_true(child >= 0);
  if (child == 0) {
    int lock = -1;
    char word = ambulo__lock_take(*state, shard, shards, &plain, NULL, &lock) ? 'n' : 'y';
    (void)!write(ready[1], &word, 1);
    for (;;) pause();
  }
  char word = 0;
  assert_int_equal(read(ready[0], &word, 1), 1);
  assert_int_equal(word, 'y');
  close(ready[0]);
  close(ready[1]);
  return child;
}

static void let_go(pid_t child) {
  kill(child, SIGKILL);
  assert_int_equal(waitpid(child, NULL, 0), child);
}

/* taken and given back at once; otherwise refused with the process that holds it */
static void expect(void **state, int shard, int shards, pid_t holder) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  int lock = -1;
  char process[32];
  snprintf(process, sizeof process, ":%ld; expected none", (long)holder);
  ambulo_status status = ambulo__lock_take(*state, shard, shards, &plain, list, &lock);
  assert_int_equal(status, holder ? AMBULO_E_IO : AMBULO_OK);
  if (holder) assert_message(list, 0, process);
  ambulo__lock_release(lock);
  ambulo_diagnostics_free(list);
}

static void one_run_at_a_time(void **state) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  char holder[AMBULO__HOLDER_TEXT], process[32];
  expect(state, 1, 1, 0);
  assert_int_equal(ambulo__lock_holder(*state, &plain, NULL, holder), AMBULO_OK);
  assert_string_equal(holder, "");
  pid_t child = hold(state, 1, 1);
  expect(state, 1, 1, child);
  expect(state, 1, 2, child);
  assert_int_equal(ambulo__lock_holder(*state, &plain, NULL, holder), AMBULO_OK);
  snprintf(process, sizeof process, ":%ld", (long)child);
  assert_non_null(strstr(holder, process));
  let_go(child);
  expect(state, 1, 1, 0);
}

static void shards_of_one_division_run_side_by_side(void **state) {
  pid_t first = hold(state, 1, 3), second = hold(state, 2, 3);
  expect(state, 3, 3, 0);
  expect(state, 2, 3, second);
  let_go(second);
  expect(state, 3, 4, first);
  /* a refused attempt leaves no name of its own behind */
  expect(state, 1, 3, first);
  expect(state, 1, 1, first);
  expect(state, 2, 3, 0);
  let_go(first);
  expect(state, 3, 4, 0);
  /* another number of shards is seen from above and from below */
  first = hold(state, 1, 4);
  expect(state, 2, 3, first);
  expect(state, 2, 5, first);
  expect(state, 2, 4, 0);
  let_go(first);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(one_run_at_a_time),
      TEST(shards_of_one_division_run_side_by_side),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
