#include "base/alloc.h"
#include "support/fail_alloc.h"
#include "support/test.h"

static int all_zero(const void *block, size_t size) {
  const unsigned char *bytes = block;
  for (size_t i = 0; i < size; i++)
    if (bytes[i]) return 0;
  return 1;
}

static void blocks_are_cleared_and_counted(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator hook = fail_alloc_hook(&memory);
  double *plain = ambulo__alloc(&hook, 100, sizeof *plain);
  double *aligned = ambulo__alloc_aligned(&hook, 100, sizeof *aligned);
  assert_non_null(plain);
  assert_non_null(aligned);
  assert_true(all_zero(plain, 100 * sizeof *plain));
  assert_true(all_zero(aligned, 100 * sizeof *aligned));
  assert_int_equal((uintptr_t)aligned % 64, 0);
  assert_int_equal(memory.live, 2);
  ambulo__free(&hook, plain);
  ambulo__free_aligned(&hook, aligned);
  ambulo__free(&hook, NULL);
  ambulo__free_aligned(&hook, NULL);
  assert_int_equal(memory.live, 0);
}

/* whatever address the hook returns, the block is aligned and inside what was asked for */
static void aligned_at_every_size(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator hook = fail_alloc_hook(&memory);
  void *blocks[200];
  for (size_t i = 0; i < 200; i++) {
    blocks[i] = ambulo__alloc_aligned(&hook, i, 3);
    assert_non_null(blocks[i]);
    assert_int_equal((uintptr_t)blocks[i] % 64, 0);
    memset(blocks[i], 0xab, i * 3);
  }
  for (size_t i = 0; i < 200; i++) ambulo__free_aligned(&hook, blocks[i]);
  assert_int_equal(memory.live, 0);
}

static void overflowing_sizes_are_refused(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator hook = fail_alloc_hook(&memory);
  char *block = ambulo__alloc(&hook, 4, 1);
  assert_non_null(block);
  assert_null(ambulo__alloc(&hook, SIZE_MAX / 2, 3));
  assert_null(ambulo__alloc(&hook, SIZE_MAX, 1));
  assert_null(ambulo__alloc_aligned(&hook, SIZE_MAX - 64, 1));
  assert_null(ambulo__realloc(&hook, block, SIZE_MAX / 4, 8));
  assert_int_equal(memory.requests, 1);
  ambulo__free(&hook, block);
}

static void a_request_for_nothing_is_a_block(void **state) {
  (void)state;
  ambulo_allocator standard = ambulo__allocator_or_default(NULL);
  void *none = ambulo__alloc(&standard, 0, 8);
  assert_non_null(none);
  void *grown = ambulo__realloc(&standard, none, 0, 8);
  assert_non_null(grown);
  ambulo__free(&standard, grown);
}

static void growing_keeps_the_content(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator hook = fail_alloc_hook(&memory);
  char *text = ambulo__strdup(&hook, "gait");
  assert_non_null(text);
  char *grown = ambulo__realloc(&hook, text, 4096, 1);
  assert_non_null(grown);
  assert_string_equal(grown, "gait");
  memory.fail_at = memory.requests;
  assert_null(ambulo__realloc(&hook, grown, 8192, 1));
  assert_string_equal(grown, "gait");
  assert_null(ambulo__strdup(&hook, "x"));
  assert_null(ambulo__alloc_aligned(&hook, 1, 1));
  ambulo__free(&hook, grown);
  assert_int_equal(memory.live, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(blocks_are_cleared_and_counted),
                                     cmocka_unit_test(aligned_at_every_size),
                                     cmocka_unit_test(overflowing_sizes_are_refused),
                                     cmocka_unit_test(a_request_for_nothing_is_a_block),
                                     cmocka_unit_test(growing_keeps_the_content)};
  return cmocka_run_group_tests_name("base/alloc", tests, NULL, NULL);
}
