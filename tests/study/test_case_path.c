/* Where the files of a case are. */
#include "study/case_path.h"
#include "support/test.h"

static void equal_and_free(char *path, const char *expected) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  assert_non_null(path);
  assert_string_equal(path, expected);
  ambulo__free(&plain, path);
}

static void cases_spread_over_folders(void **state) {
  (void)state;
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  equal_and_free(ambulo__case_path(&a, "d", "000000001-0000abcd", ".json"),
                 "d/cases/cd/000000001-0000abcd.json");
  equal_and_free(ambulo__case_path(&a, ".", "x", "/gait.svg"), "./cases/00/x/gait.svg");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(cases_spread_over_folders)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
