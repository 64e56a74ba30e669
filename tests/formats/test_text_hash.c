/* The hash of texts. */
#include "formats/text_hash.h"
#include "support/test.h"

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
  const struct CMUnitTest tests[] = {cmocka_unit_test(hashes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
