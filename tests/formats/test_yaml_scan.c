#include "formats/yaml_tree.h"
#include "support/yaml.h"

static void expect_refused(const char *bytes, size_t length, const char *want) {
  yaml_case c = yaml_open_bytes(bytes, length);
  assert_int_equal(c.status, AMBULO_E_PARSE);
  expect_message(&c, 0, want);
  expect_messages(&c, 1);
  yaml_shut(&c);
}
#define EXPECT_REFUSED(bytes, want) expect_refused(bytes, sizeof(bytes) - 1, want)

static void bytes_that_are_no_text(void **state) {
  (void)state;
  static const char utf8_hint[] =
      "t.yaml:2:4: error[E_PARSE]: invalid UTF-8 (got byte 0x%02x); expected UTF-8 text\n"
      "  hint: save the file as UTF-8";
  static const char *const bad[] = {"a: 1\nb: \xff",
                                    "a: 1\nb: \xc0\xaf",
                                    "a: 1\nb: \xed\xa0\x80",
                                    "a: 1\nb: \x80",
                                    "a: 1\nb: \xf4\x90\x80\x80",
                                    "a: 1\nb: \xe2\x82",
                                    "a: 1\nb: \xf0\x80\x80\x80"};
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    char want[256];
    (void)snprintf(want, sizeof want, utf8_hint, (unsigned char)bad[i][8]);
    expect_refused(bad[i], strlen(bad[i]), want);
  }
  EXPECT_REFUSED("a: 1\0\n", "t.yaml:1:5: error[E_PARSE]: got a NUL byte; expected text");
  EXPECT_REFUSED("a: \x1b[31m",
                 "t.yaml:1:4: error[E_PARSE]: got the control character U+001B; expected text");
  EXPECT_REFUSED("a: \xc3\xa9\xef\xbb\xbf",
                 "t.yaml:1:5: error[E_PARSE]: got the control character U+FEFF; expected text");
}

static void columns_count_characters_and_lines_any_break(void **state) {
  (void)state;
  EXPECT_REFUSED("a: \xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\x01",
                 "t.yaml:1:7: error[E_PARSE]: got the control character U+0001; expected text");
  EXPECT_REFUSED("a: 1\r\nb: 2\rc: \x01",
                 "t.yaml:3:4: error[E_PARSE]: got the control character U+0001; expected text");
}

/* half a million of them would take libyaml minutes */
static void directives(void **state) {
  (void)state;
  EXPECT_REFUSED(
      "%TAG !a! tag:a\n---\na: 1\n",
      "t.yaml:1:1: error[E_PARSE]: got a line that starts with '%'; directives are not allowed");
  yaml_case c = yaml_open("%YAML 1.1\n---\na: 5%\n");
  assert_int_equal(c.status, AMBULO_OK);
  yaml_shut(&c);
}

static void tab_indentation(void **state) {
  (void)state;
  static const char text[] = "a:\n  b: 1\n \tc: 2\nd: \t3\n\n";
  assert_false(ambulo__yaml_tab_indent(text, sizeof text - 1, 1));
  assert_false(ambulo__yaml_tab_indent(text, sizeof text - 1, 2));
  assert_true(ambulo__yaml_tab_indent(text, sizeof text - 1, 3));
  assert_false(ambulo__yaml_tab_indent(text, sizeof text - 1, 4));
  assert_false(ambulo__yaml_tab_indent(text, sizeof text - 1, 99));
  yaml_case c = yaml_open("a:\n\tb: 1\n");
  assert_int_equal(c.status, AMBULO_E_PARSE);
  expect_message(&c, 0,
                 "t.yaml:2:1: error[E_PARSE]: found character that cannot start any token while "
                 "scanning for the next token that starts in line 2, column 1\n"
                 "  hint: indent with spaces; YAML does not allow tabs there");
  yaml_shut(&c);
}

static void bytes_are_found_by_line_and_column(void **state) {
  (void)state;
  static const char text[] = "ab\n\xC3\xA9[c\n";
  assert_int_equal(ambulo__yaml_byte_at(text, sizeof text - 1, 1, 2), 'b');
  assert_int_equal(ambulo__yaml_byte_at(text, sizeof text - 1, 1, 3), '\0');
  assert_int_equal(ambulo__yaml_byte_at(text, sizeof text - 1, 2, 2), '[');
  assert_int_equal(ambulo__yaml_byte_at(text, sizeof text - 1, 2, 3), 'c');
  assert_int_equal(ambulo__yaml_byte_at(text, sizeof text - 1, 4, 1), '\0');
}

/* the commonest fault in a sweep file: its axes are written between brackets */
static void brackets_between_brackets_stand_in_quotes(void **state) {
  (void)state;
  static const char *const texts[] = {"a: {key: objective[0].weight}\n", "a: [max(x), b[1]]\n",
                                      "a: {key: x{y}}\n"};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    char message[1024];
    yaml_case c = yaml_open(texts[i]);
    assert_int_equal(c.status, AMBULO_E_PARSE);
    ambulo_diagnostics_format(c.list, 0, message, sizeof message);
    assert_non_null(strstr(message, "hint: between brackets a text that holds brackets stands in "
                                    "quotes"));
    yaml_shut(&c);
  }
  yaml_case c = yaml_open("a: {key: \"objective[0].weight\"}\n");
  assert_int_equal(c.status, AMBULO_OK);
  yaml_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(bytes_that_are_no_text),
                                     cmocka_unit_test(columns_count_characters_and_lines_any_break),
                                     cmocka_unit_test(directives),
                                     cmocka_unit_test(tab_indentation),
                                     cmocka_unit_test(bytes_are_found_by_line_and_column),
                                     cmocka_unit_test(brackets_between_brackets_stand_in_quotes)};
  return cmocka_run_group_tests_name("format/yaml_scan", tests, NULL, NULL);
}
