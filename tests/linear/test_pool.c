/* One failed block makes the pool failed; clearing frees everything. */
#include "linear/pool.h"
#include "support/fail_alloc.h"
#include "support/test.h"

static void failure_is_sticky_and_nothing_leaks(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(2);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  ambulo__pool pool;
  memory.only_once = 1;
  ambulo__pool_init(&pool, &allocator);
  assert_non_null(ambulo__pool_doubles(&pool, 10));
  assert_non_null(ambulo__pool_ints(&pool, 10));
  assert_int_equal(pool.failed, 0);
  assert_null(ambulo__pool_doubles(&pool, 10));
  assert_int_equal(pool.failed, 1);
  assert_null(ambulo__pool_doubles(&pool, 10));
  ambulo__pool_clear(&pool);
  assert_int_equal(memory.live, 0);
  assert_non_null(ambulo__pool_doubles(&pool, 10)); /* as new */
  assert_int_equal(pool.failed, 0);
  ambulo__pool_clear(&pool);
}

static void blocks_are_zero_and_aligned(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__pool_init(&pool, NULL);
  double *block = ambulo__pool_doubles(&pool, 100);
  assert_int_equal((uintptr_t)block % 64, 0);
  for (int i = 0; i < 100; i++) assert_true(block[i] == 0.0);
  ambulo__pool_clear(&pool);
}

/* a second look at a solve takes as many again: no number of blocks is the last */
static void blocks_are_as_many_as_memory_holds(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  ambulo__pool pool;
  ambulo__pool_init(&pool, &allocator);
  double *first = ambulo__pool_doubles(&pool, 1);
  *first = 7.0;
  for (int i = 0; i < 5000; i++) assert_non_null(ambulo__pool_ints(&pool, 3));
  assert_true(*first == 7.0);
  assert_null(ambulo__pool_doubles(&pool, SIZE_MAX / 8));
  ambulo__pool_clear(&pool);
  assert_int_equal(memory.live, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(failure_is_sticky_and_nothing_leaks),
                                     cmocka_unit_test(blocks_are_zero_and_aligned),
                                     cmocka_unit_test(blocks_are_as_many_as_memory_holds)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
