/* Sealed objects: what was written holds, and nothing else does. */
#include "formats/seal.h"
#include "support/test.h"

static ambulo__text_buffer sealed(const char *text) {
  ambulo__text_buffer buffer;
  ambulo__text_init(&buffer, NULL);
  ambulo__text_append(&buffer, text);
  ambulo__seal(&buffer);
  assert_int_equal(ambulo__text_status(&buffer), AMBULO_OK);
  return buffer;
}

/* the digest is that of the bytes before it: printf '{\n  "a": 1,\n' | sha256sum */
static void the_last_key_is_the_checksum(void **state) {
  (void)state;
  ambulo__text_buffer text = sealed("{\n  \"a\": 1");
  assert_string_equal(ambulo__text_data(&text),
                      "{\n  \"a\": 1,\n  \"sha256\": "
                      "\"258d97188c1e1b71d2c4210444fd72c3cf58a6d7d799180006273b33f2d1d054\"\n}\n");
  assert_true(ambulo__seal_holds(ambulo__text_data(&text), text.length));
  ambulo__text_free(&text);
}

static void no_change_of_a_byte_holds(void **state) {
  (void)state;
  ambulo__text_buffer text = sealed("{\n  \"state\": \"optimal\",\n  \"valid\": true");
  for (size_t i = 0; i < text.length; i++) {
    for (int bit = 0; bit < 8; bit++) {
      text.data[i] = (char)(text.data[i] ^ (1 << bit));
      assert_false(ambulo__seal_holds(text.data, text.length));
      text.data[i] = (char)(text.data[i] ^ (1 << bit));
    }
  }
  assert_true(ambulo__seal_holds(text.data, text.length));
  ambulo__text_free(&text);
}

static void no_part_of_it_holds(void **state) {
  (void)state;
  ambulo__text_buffer text = sealed("{\n  \"state\": \"optimal\"");
  for (size_t length = 0; length < text.length; length++)
    assert_false(ambulo__seal_holds(text.data, length));
  for (size_t start = 1; start < text.length; start++)
    assert_false(ambulo__seal_holds(text.data + start, text.length - start));
  ambulo__text_append(&text, "\n");
  assert_false(ambulo__seal_holds(text.data, text.length));
  ambulo__text_free(&text);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_last_key_is_the_checksum),
                                     cmocka_unit_test(no_change_of_a_byte_holds),
                                     cmocka_unit_test(no_part_of_it_holds)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
