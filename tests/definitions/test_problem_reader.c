/* Memory and file names of a reader. */
#include "definitions/problem_reader.h"

#include "base/alloc.h"
#include "support/fail_alloc.h"
#include "support/test.h"

static void names_start_in_the_directory(void **state) {
  (void)state;
  static const char *const cases[][3] = {{"", "m.yaml", "m.yaml"},
                                         {"models", "m.yaml", "models/m.yaml"},
                                         {"models/", "../m.yaml", "models/../m.yaml"},
                                         {"models", "/abs/m.yaml", "/abs/m.yaml"}};
  for (int i = 0; i < 4; i++) {
    ambulo__problem_reader reader = {.allocator = ambulo__allocator_or_default(NULL),
                                     .directory = cases[i][0]};
    assert_string_equal(ambulo__reader_path(&reader, NULL, cases[i][1]), cases[i][2]);
    ambulo__reader_clear(&reader);
  }
}

static void blocks_are_zero_and_freed(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo__problem_reader reader = {.allocator = fail_alloc_hook(&memory)};
  for (size_t size = 0; size < 100; size += 7) {
    unsigned char *block = ambulo__reader_alloc(&reader, size, 1);
    assert_non_null(block);
    assert_int_equal((uintptr_t)block % sizeof(double), 0);
    for (size_t i = 0; i < size; i++) assert_int_equal(block[i], 0);
    memset(block, 255, size);
  }
  assert_true(memory.live > 10);
  ambulo__reader_clear(&reader);
  assert_int_equal(memory.live, 0);
}

static void failures_are_remembered(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(0);
  ambulo__problem_reader reader = {.allocator = fail_alloc_hook(&memory)};
  assert_null(ambulo__reader_alloc(&reader, 1, 8));
  assert_int_equal(reader.failure, AMBULO_E_MEMORY);
  memory = fail_alloc_at(-1);
  reader.failure = AMBULO_OK;
  assert_null(ambulo__reader_alloc(&reader, SIZE_MAX / 4, 8));
  assert_int_equal(reader.failure, AMBULO_E_MEMORY);
  assert_null(ambulo__reader_alloc(&reader, SIZE_MAX, 1));
  ambulo__reader_clear(&reader);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(names_start_in_the_directory),
                                     cmocka_unit_test(blocks_are_zero_and_freed),
                                     cmocka_unit_test(failures_are_remembered)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
