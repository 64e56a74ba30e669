/* Names in a batch folder, and the hash of texts. */
#include "batch/paths.h"
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
  equal_and_free(ambulo__case_path(&a, "d", "000000001-0000abcd", ".json"),
                 "d/cases/cd/000000001-0000abcd.json");
  equal_and_free(ambulo__case_path(&a, ".", "x", "/gait.svg"), "./cases/00/x/gait.svg");
  equal_and_free(ambulo__join_paths(&a, "d", "cases", NULL), "d/cases");
  equal_and_free(ambulo__join_paths(&a, "d", "cases", "cd"), "d/cases/cd");
  equal_and_free(ambulo__sibling_path(&a, "a/b/s.yaml", "../p.yaml"), "a/b/../p.yaml");
  equal_and_free(ambulo__sibling_path(&a, "s.yaml", "p.yaml"), "p.yaml");
  equal_and_free(ambulo__sibling_path(&a, "a/s.yaml", "/p.yaml"), "/p.yaml");
}

/* FNV-1a, the end of each text included, so that "ab", "c" is not "a", "bc" */
static void hashes(void **state) {
  (void)state;
  unsigned long long h = AMBULO__HASH_START;
  assert_true(ambulo__hash_text(h, "") == (AMBULO__HASH_START ^ 0) * 1099511628211ULL);
  assert_true(ambulo__hash_text(ambulo__hash_text(h, "ab"), "c") !=
              ambulo__hash_text(ambulo__hash_text(h, "a"), "bc"));
  assert_true(ambulo__hash_word(h, 1) != ambulo__hash_word(h, 256));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(names), cmocka_unit_test(hashes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
