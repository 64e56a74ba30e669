#include "base/alloc.h"
#include "formats/yaml_tree.h"
#include "support/fail_alloc.h"
#include "support/yaml.h"

#include <time.h>

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

/* the first and the last of each range that no text has, and their neighbours, which it may have */
static void controls(void **state) {
  (void)state;
  static const struct {
    const char *bytes;
    unsigned code;
  } bad[] = {{"\x7f", 0x7f},           {"\xc2\x80", 0x80},       {"\xc2\x84", 0x84},
             {"\xc2\x86", 0x86},       {"\xc2\x9f", 0x9f},       {"\xef\xbb\xbf", 0xfeff},
             {"\xef\xbf\xbe", 0xfffe}, {"\xef\xbf\xbf", 0xffff}, {"\x1f", 0x1f}};
  static const char *const good[] = {"\xc2\x85",        "\xc2\xa0",     "~x",
                                     "\xef\xbb\xbe",    "\xef\xbf\xbd", "\xf0\x90\x80\x80",
                                     "\xf4\x8f\xbf\xbf"};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    char text[32], want[128];
    (void)snprintf(text, sizeof text, "a: 'x%s'\n", bad[i].bytes);
    (void)snprintf(want, sizeof want,
                   "t.yaml:1:6: error[E_PARSE]: got the control character U+%04X; expected text",
                   bad[i].code);
    expect_refused(text, strlen(text), want);
  }
  for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
    char text[32];
    (void)snprintf(text, sizeof text, "a: 'x%s'\n", good[i]);
    yaml_case c = yaml_open(text);
    if (c.status) print_error("%zu\n", i);
    assert_int_equal(c.status, AMBULO_OK);
    yaml_shut(&c);
  }
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
  /* what is behind the text is none of it */
  expect_refused("%YAML 1.1\n---\n", 3,
                 "t.yaml:1:1: error[E_PARSE]: got a line that starts with '%'; directives are not "
                 "allowed");
  yaml_case c = yaml_open("%YAML 1.1\n---\na: 5%\n");
  assert_int_equal(c.status, AMBULO_OK);
  yaml_shut(&c);
}

static void tab_indentation(void **state) {
  (void)state;
  yaml_case c = yaml_open("a:\n\tb: 1\n");
  assert_int_equal(c.status, AMBULO_E_PARSE);
  expect_message(&c, 0,
                 "t.yaml:2:1: error[E_PARSE]: found character that cannot start any token while "
                 "scanning for the next token that starts in line 2, column 1\n"
                 "  hint: indent with spaces; YAML does not allow tabs there");
  yaml_shut(&c);
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

static void what_is_refused(void **state) {
  (void)state;
  static const struct {
    const char *text;
    ambulo_status status;
    const char *want;
  } cases[] = {
      {"a: [1, 2\nb: 3\n", AMBULO_E_PARSE,
       "t.yaml:2:2: error[E_PARSE]: did not find expected ',' or ']' while parsing a flow sequence "
       "that starts in line 1, column 4"},
      {"a: {b: 1", AMBULO_E_PARSE,
       "t.yaml:2:1: error[E_PARSE]: did not find expected ',' or '}' while parsing a flow mapping "
       "that starts in line 1, column 4"},
      {"x: 1\na: \"abc\n", AMBULO_E_PARSE,
       "t.yaml:3:1: error[E_PARSE]: found unexpected end of stream while scanning a quoted scalar "
       "that starts in line 2, column 4"},
      {"a: b: c", AMBULO_E_PARSE,
       "t.yaml:1:5: error[E_PARSE]: mapping values are not allowed in this context"},
      {"a: &x 1", AMBULO_E_PARSE,
       "t.yaml:1:4: error[E_PARSE]: anchors ('&') are not allowed; expected a plain value"},
      {"a: &x [1]", AMBULO_E_PARSE,
       "t.yaml:1:4: error[E_PARSE]: anchors ('&') are not allowed; expected a plain value"},
      {"a: &x {b: *x}", AMBULO_E_PARSE,
       "t.yaml:1:4: error[E_PARSE]: anchors ('&') are not allowed; expected a plain value"},
      {"a: *nothing", AMBULO_E_PARSE,
       "t.yaml:1:4: error[E_PARSE]: aliases ('*') are not allowed; expected a plain value"},
      {"a: !!float 1", AMBULO_E_PARSE,
       "t.yaml:1:4: error[E_PARSE]: tags ('!') are not allowed; expected a plain value"},
      {"a: !x {b: 1}", AMBULO_E_PARSE,
       "t.yaml:1:4: error[E_PARSE]: tags ('!') are not allowed; expected a plain value"},
      {"a: !x [1]", AMBULO_E_PARSE,
       "t.yaml:1:4: error[E_PARSE]: tags ('!') are not allowed; expected a plain value"},
      {"b: 1\n<<: {a: 1}", AMBULO_E_PARSE,
       "t.yaml:2:1: error[E_PARSE]: merge keys ('<<') are not allowed"},
      {"a: 1\n---\nb: 2", AMBULO_E_PARSE,
       "t.yaml:2:1: error[E_PARSE]: a second document starts here; expected one document"},
      {"? [a]\n: 1", AMBULO_E_PARSE,
       "t.yaml:1:3: error[E_PARSE]: got a collection as a key; expected a name"},
      {"a: \"x\\0y\"", AMBULO_E_PARSE, "t.yaml:1:4: error[E_PARSE]: got a NUL character in a text"},
      {"mass: 1\nname: x\nmass: 2\n", AMBULO_E_SCHEMA,
       "t.yaml:3:1: error[E_SCHEMA]: duplicate key 'mass'; the first one is in line 1"},
      {"a: {b: 1, 'b': 2}", AMBULO_E_SCHEMA,
       "t.yaml:1:11: error[E_SCHEMA]: duplicate key 'b'; the first one is in line 1"}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    yaml_case c = yaml_open(cases[i].text);
    expect_message(&c, 0, cases[i].want);
    assert_int_equal(c.status, cases[i].status);
    assert_null(c.document);
    expect_messages(&c, 1);
    yaml_shut(&c);
  }
}

/* the same key may stand in two mappings */
static void same_key_in_other_mappings(void **state) {
  (void)state;
  yaml_case c = yaml_open("a: {n: 1}\nb: {n: 2}\nn: {a: 1, b: 2}\n");
  assert_int_equal(c.status, AMBULO_OK);
  yaml_shut(&c);
}

static double seconds(void) {
  struct timespec now;
  (void)timespec_get(&now, TIME_UTC);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void depth_of(int depth, const char *opening, ambulo_status want) {
  size_t width = strlen(opening), length = 3 + (size_t)depth * (width + 1);
  char *text = malloc(length + 1);
  assert_non_null(text);
  memcpy(text, "a: ", 3);
  for (int i = 0; i < depth; i++) memcpy(text + 3 + (size_t)i * width, opening, width);
  memset(text + 3 + (size_t)depth * width, opening[0] == '[' ? ']' : '}', (size_t)depth);
  text[length] = '\0';
  double begin = seconds();
  yaml_case c = yaml_open_bytes(text, length);
  double taken = seconds() - begin;
  free(text);
  assert_int_equal(c.status, want);
  if (taken > 0.1) print_error("%d levels of %s took %g s\n", depth, opening, taken);
  assert_true(taken < 0.1);
  yaml_shut(&c);
}

static void nesting_is_limited_at_once(void **state) {
  (void)state;
  depth_of(31, "[", AMBULO_OK);
  depth_of(32, "[", AMBULO_E_LIMIT);
  depth_of(31, "{a: ", AMBULO_OK);
  depth_of(32, "{a: ", AMBULO_E_LIMIT);
  depth_of(100000, "[", AMBULO_E_LIMIT);
  depth_of(100000, "{a: ", AMBULO_E_LIMIT);
  depth_of(100000, "[\n", AMBULO_E_LIMIT);
}

static void number_of_keys_is_limited(void **state) {
  (void)state;
  static char text[1100 * 8];
  size_t length = 0;
  for (int i = 0; i < 1025; i++)
    length += (size_t)snprintf(text + length, sizeof text - length, "k%d:\n", i);
  yaml_case c = yaml_open(text);
  assert_int_equal(c.status, AMBULO_E_LIMIT);
  expect_message(&c, 0, "t.yaml:1025:1: error[E_LIMIT]: more than 1024 keys in one mapping");
  yaml_shut(&c);
}

static void number_of_values_is_limited(void **state) {
  (void)state;
  size_t length = 4 + 2 * 1000000 + 1;
  char *text = malloc(length);
  assert_non_null(text);
  memcpy(text, "a: [", 4);
  for (size_t i = 4; i + 1 < length; i += 2) memcpy(text + i, "1,", 2);
  text[length - 1] = ']';
  yaml_case c = yaml_open_bytes(text, length);
  free(text);
  assert_int_equal(c.status, AMBULO_E_LIMIT);
  yaml_shut(&c);
}

/* line breaks of other systems, byte order mark, no final newline, markers */
static void accepted_forms(void **state) {
  (void)state;
  static const char *const same[] = {
      "mass: 1.5\nlist: [1, 2]\n",           "mass: 1.5\r\nlist: [1, 2]\r\n",
      "\xEF\xBB\xBFmass: 1.5\nlist: [1, 2]", "--- # start\nmass: 1.5\nlist:\n- 1\n- 2\n...\n",
      "{mass: 1.5, list: [1, 2,]}",          "mass: 1.5\rlist: [1, 2]\r"};
  for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
    yaml_case c = yaml_open(same[i]);
    assert_int_equal(c.status, AMBULO_OK);
    double pair[2] = {0.0, 0.0};
    assert_true(ambulo__yaml_number(ambulo__yaml_get(c.root, "mass"), 0.0) == 1.5);
    assert_true(ambulo__yaml_numbers(ambulo__yaml_get(c.root, "list"), 2, pair));
    assert_true(pair[0] == 1.0 && pair[1] == 2.0);
    ambulo__yaml_close(c.root);
    assert_int_equal(ambulo__yaml_finish(c.document), AMBULO_OK);
    yaml_shut(&c);
  }
}

static const char SAMPLE[] = "name: walk # comment\n"
                             "links:\n"
                             "  - {name: thigh, mass: 8.5, at: [0.1, -2e-3, 3]}\n"
                             "  - name: 'shank'\n"
                             "    mass: 3.7\n"
                             "text: >\n"
                             "  folded\n"
                             "  text\n";

/* a file cut anywhere is read or refused with a message, never worse */
static void truncated_anywhere(void **state) {
  (void)state;
  for (size_t length = 0; length < sizeof SAMPLE - 1; length++) {
    yaml_case c = yaml_open_bytes(SAMPLE, length);
    if (c.status != AMBULO_OK) assert_true(ambulo_diagnostics_error_count(c.list) == 1);
    assert_int_equal(c.status == AMBULO_OK, c.document != NULL);
    yaml_shut(&c);
  }
}

/* any byte replaced by any of the characters that mean something */
static void damaged_anywhere(void **state) {
  (void)state;
  static const char special[] = "\0\t\n\r -?:,[]{}#&*!|>'\"%@`\\\xff\xc3<=~";
  char text[sizeof SAMPLE];
  for (size_t at = 0; at < sizeof SAMPLE - 1; at++) {
    for (size_t k = 0; k < sizeof special - 1; k++) {
      memcpy(text, SAMPLE, sizeof text);
      text[at] = special[k];
      yaml_case c = yaml_open_bytes(text, sizeof text - 1);
      assert_int_equal(c.status != AMBULO_OK, ambulo_diagnostics_error_count(c.list) > 0);
      yaml_shut(&c);
    }
  }
}

static void out_of_memory_anywhere(void **state) {
  (void)state;
  static char text[60000];
  size_t length = 0;
  for (int i = 0; i < 900; i++) {
    length +=
        (size_t)snprintf(text + length, sizeof text - length, "key_%d: {a: [1, 2], b: %d}\n", i, i);
  }
  long k = 0;
  for (;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__yaml *document = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo_status status = ambulo__yaml_load_text(text, length, "t.yaml", &hook, list, &document);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(ambulo_diagnostics_error_count(list), memory.failed);
    assert_int_equal(document == NULL, memory.failed);
    ambulo__yaml_free(document);
    ambulo_diagnostics_free(list);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  assert_true(k > 10);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(bytes_that_are_no_text),
                                     cmocka_unit_test(controls),
                                     cmocka_unit_test(columns_count_characters_and_lines_any_break),
                                     cmocka_unit_test(directives),
                                     cmocka_unit_test(tab_indentation),
                                     cmocka_unit_test(brackets_between_brackets_stand_in_quotes),
                                     cmocka_unit_test(what_is_refused),
                                     cmocka_unit_test(same_key_in_other_mappings),
                                     cmocka_unit_test(nesting_is_limited_at_once),
                                     cmocka_unit_test(number_of_keys_is_limited),
                                     cmocka_unit_test(number_of_values_is_limited),
                                     cmocka_unit_test(accepted_forms),
                                     cmocka_unit_test(truncated_anywhere),
                                     cmocka_unit_test(damaged_anywhere),
                                     cmocka_unit_test(out_of_memory_anywhere)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
