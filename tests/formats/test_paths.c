/* Names of files seen from folders and from other files. */
#include "formats/paths.h"
#include "support/test.h"

static void equal_and_free(char *path, const char *expected) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  assert_non_null(path);
  assert_string_equal(path, expected);
  ambulo__free(&plain, path);
}

static void names(void **state) {
  (void)state;
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  equal_and_free(ambulo__join_paths(&a, "d", "cases", NULL), "d/cases");
  equal_and_free(ambulo__join_paths(&a, "d", "cases", "cd"), "d/cases/cd");
  equal_and_free(ambulo__sibling_path(&a, "a/b/s.yaml", "../p.yaml"), "a/b/../p.yaml");
  equal_and_free(ambulo__sibling_path(&a, "s.yaml", "p.yaml"), "p.yaml");
  equal_and_free(ambulo__sibling_path(&a, "a/s.yaml", "/p.yaml"), "/p.yaml");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(names)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
