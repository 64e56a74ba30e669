/* Texts in a page: a JSON string of base64, in which the text stands packed. */
#include "show/packed_text.h"

#include "support/inflate.h"

static void comes_out_again(const char *text, size_t length) {
  ambulo__text_buffer out;
  ambulo__text_init(&out, NULL);
  ambulo__packed_text(&out, text, length);
  assert_int_equal(ambulo__text_status(&out), AMBULO_OK);
  assert_true(out.length >= 2 && out.data[0] == '"' && out.data[out.length - 1] == '"');
  out.data[out.length - 1] = '\0';
  size_t bytes, size;
  char *packed = unbase64(out.data + 1, &bytes);
  unsigned char *got = unpacked(packed, bytes, &size);
  assert_int_equal(size, length);
  assert_memory_equal(got, text, length);
  free(got);
  free(packed);
  ambulo__text_free(&out);
}

static void any_length(void **state) {
  (void)state;
  static const char text[] = "{\"summary\": [1, 2, 3], \"name\": \"\xc3\xbc<\\u2028\"}";
  for (size_t length = 0; length < sizeof text; length++) comes_out_again(text, length);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(any_length)};
  return cmocka_run_group_tests_name("page/packed_text", tests, NULL, NULL);
}
