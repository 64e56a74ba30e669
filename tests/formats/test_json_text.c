/* JSON text: commas, escapes, and what JSON does not have. */
#include "formats/json_text.h"
#include "support/test.h"
#include "support/wellformed.h"

static void test_layout(void **state) {
  (void)state;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__json json = {.text = &text, .first = 1};
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_number(&json, "a", 0.1);
  ambulo__json_open(&json, "list", '[');
  ambulo__json_integer(&json, NULL, -3);
  ambulo__json_number(&json, NULL, (double)NAN);
  ambulo__json_number(&json, NULL, -INFINITY);
  ambulo__json_close(&json, ']');
  ambulo__json_open(&json, "empty", '{');
  ambulo__json_close(&json, '}');
  ambulo__json_text(&json, "none", NULL);
  ambulo__json_text(&json, "odd", "a\"b\\c\n\x1b");
  ambulo__json_close(&json, '}');
  assert_string_equal(ambulo__text_data(&text),
                      "{\n  \"a\": 0.1,\n  \"list\": [\n    -3,\n    null,\n    null\n  ],\n"
                      "  \"empty\": {},\n  \"none\": null,\n"
                      "  \"odd\": \"a\\\"b\\\\c\\u000a\\u001b\"\n}\n");
  assert_true(is_json(ambulo__text_data(&text)));
  ambulo__text_free(&text);
}

/* the recognizers themselves can say no */
static void test_recognizers(void **state) {
  (void)state;
  static const char *const bad_json[] = {"",   "{",          "{\"a\" 1}", "[1,]", "nan",
                                         "01", "{\"a\":1}x", "\"\n\"",    "1e",   "[1 2]"};
  for (size_t i = 0; i < sizeof bad_json / sizeof *bad_json; i++) {
    if (is_json(bad_json[i])) print_error("taken for JSON: %s\n", bad_json[i]);
    assert_false(is_json(bad_json[i]));
  }
  static const char *const bad_xml[] = {"<a>",       "<a></b>",    "<a b=1/><c/>",
                                        "<a>&x</a>", "<a \"<\"/>", "<a/>x"};
  for (size_t i = 0; i < sizeof bad_xml / sizeof *bad_xml; i++) {
    if (is_xml(bad_xml[i])) print_error("taken for XML: %s\n", bad_xml[i]);
    assert_false(is_xml(bad_xml[i]));
  }
  assert_true(is_xml("<?xml version=\"1.0\"?>\n<a x=\"1\"><b/>t&lt;</a>\n"));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_layout),
                                     cmocka_unit_test(test_recognizers)};
  return cmocka_run_group_tests_name("format/json_text", tests, NULL, NULL);
}
