/* JSON inside of a page: whatever a text says, it stays a text. */
#include "show/script_text.h"

#include "support/test.h"

static void assert_text(const char *given, const char *want) {
  ambulo__text_buffer out;
  ambulo__text_init(&out, NULL);
  ambulo__script_text(&out, given);
  assert_string_equal(ambulo__text_data(&out), want);
  ambulo__text_free(&out);
}

static void texts(void **state) {
  (void)state;
  assert_text("walk", "\"walk\"");
  assert_text("</script><!--", "\"\\u003c/script>\\u003c!--\"");
  assert_text("a \"b\" \\ & '", "\"a \\\"b\\\" \\\\ & '\"");
  assert_text("a\nb\x01\x7f", "\"a\\u000ab\\u0001\\u007f\"");
  assert_text("Gang \xc3\xbc \xe6\xad\xa9 \xf0\x9f\x9a\xb6",
              "\"Gang \xc3\xbc \xe6\xad\xa9 \xf0\x9f\x9a\xb6\"");
  assert_text("a\xe2\x80\xa8"
              "b\xe2\x80\xa9"
              "c\xe2\x80\xaa",
              "\"a\\u2028b\\u2029c\xe2\x80\xaa\"");
}

/* names of files may be any bytes: overlong forms, surrogates, a character that is cut off */
static void bytes_that_are_no_text(void **state) {
  (void)state;
  assert_text("a\xff", "\"a\\ufffd\"");
  assert_text("\xc0\xbc", "\"\\ufffd\\ufffd\"");
  assert_text("\xe0\x80\xbc", "\"\\ufffd\\ufffd\\ufffd\"");
  assert_text("\xed\xa0\x80", "\"\\ufffd\\ufffd\\ufffd\"");
  assert_text("\xe2\x80", "\"\\ufffd\\ufffd\"");
  assert_text("\xf4\x90\x80\x80", "\"\\ufffd\\ufffd\\ufffd\\ufffd\"");
}

static void json_without_blanks(void **state) {
  (void)state;
  static const char given[] =
      "{\n  \"a b\": [1, -2.5e3 ,\t{ }],\r\n \"c\\\" d\\\\\": \"</script> \xe2\x80\xa8\"\n}\n";
  ambulo__text_buffer out;
  ambulo__text_init(&out, NULL);
  ambulo__script_json(&out, given, strlen(given));
  assert_string_equal(ambulo__text_data(&out),
                      "{\"a b\":[1,-2.5e3,{}],\"c\\\" d\\\\\":\"\\u003c/script> \\u2028\"}");
  ambulo__text_free(&out);
}

/* as JSON: numbers to six digits, whole ones to all of theirs */
static void values(void **state) {
  (void)state;
  static const char *const both[][2] = {
      {"1.23456789", "1.23457"},
      {"-0.000123456789", "-0.000123457"},
      {"9.9999996", "10"},
      {"123456.789", "123457"},
      {"12345678", "12345678"},
      {"1234567.5", "1234570"},
      {"1e-320", "1e-320"},
      {"0.1", "0.1"},
      {"0", "0"},
      {"", "null"},
      {"null", "null"},
      {"nan", "\"nan\""},
      {"1.2 m", "\"1.2 m\""},
      {"<b>", "\"\\u003cb>\""},
  };
  for (size_t i = 0; i < sizeof both / sizeof both[0]; i++) {
    ambulo__text_buffer out;
    ambulo__text_init(&out, NULL);
    ambulo__script_value(&out, both[i][0]);
    assert_string_equal(ambulo__text_data(&out), both[i][1]);
    ambulo__text_free(&out);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(texts),
      cmocka_unit_test(bytes_that_are_no_text),
      cmocka_unit_test(json_without_blanks),
      cmocka_unit_test(values),
  };
  return cmocka_run_group_tests_name("page/script_text", tests, NULL, NULL);
}
