#include "support/fail_alloc.h"
#include "support/yaml.h"

/* the value of `v:` is read by `kind`; the one message must be `want` */
static void expect_value_error(const char *value, char kind, const char *want) {
  static const char *const words[] = {"slsqp", "auglag", "auto"};
  char text[256], message[512];
  (void)snprintf(text, sizeof text, "v:%s%s\n", value[0] ? " " : "", value);
  (void)snprintf(message, sizeof message, "t.yaml:1:%d: error[E_SCHEMA]: %s", value[0] ? 4 : 3,
                 want);
  yaml_case c = yaml_open(text);
  assert_int_equal(c.status, AMBULO_OK);
  const ambulo__yaml_node *node = ambulo__yaml_get(c.root, "v");
  double numbers[2] = {7.0, 8.0};
  switch (kind) {
  case 'n':
    assert_true(ambulo__yaml_number(node, -3.0) == -3.0);
    break;
  case 'r':
    assert_true(ambulo__yaml_number_in(node, 0.0, 2.5, -3.0) == -3.0);
    break;
  case 'p':
    assert_true(ambulo__yaml_number_in(node, 0.0, (double)INFINITY, -3.0) == -3.0);
    break;
  case 'm':
    assert_true(ambulo__yaml_number_in(node, -(double)INFINITY, 0.0, -3.0) == -3.0);
    break;
  case 'i':
    assert_int_equal(ambulo__yaml_integer(node, 1, 100, -3), -3);
    break;
  case 'b':
    assert_int_equal(ambulo__yaml_boolean(node, -3), -3);
    break;
  case 'c':
    assert_int_equal(ambulo__yaml_choice(node, words, 3, -3), -3);
    break;
  case 'N':
    assert_string_equal(ambulo__yaml_name(node), "");
    break;
  case 't':
    assert_string_equal(ambulo__yaml_text(node), "");
    break;
  case 'L':
    assert_int_equal(ambulo__yaml_items(node), 0);
    break;
  case 'M':
    assert_int_equal(ambulo__yaml_pairs(node), 0);
    break;
  case 'g':
    assert_null(ambulo__yaml_get(node, "a"));
    break;
  default:
    assert_false(ambulo__yaml_numbers(node, 2, numbers));
    assert_true(numbers[0] == 7.0 && numbers[1] == 8.0);
  }
  expect_message(&c, 0, message);
  expect_messages(&c, 1);
  assert_int_equal(ambulo__yaml_finish(c.document), AMBULO_E_SCHEMA);
  assert_string_equal(ambulo_diagnostics_get(c.list, 0)->path, kind == 'l' ? "v[1]" : "v");
  yaml_shut(&c);
}

static void numbers(void **state) {
  (void)state;
  expect_value_error("1,5", 'n',
                     "got '1,5'; expected a number\n  hint: the decimal separator is a point");
  expect_value_error("1_000", 'n',
                     "got '1_000'; expected a number\n  hint: digits are not grouped");
  expect_value_error("-1_000", 'n',
                     "got '-1_000'; expected a number\n  hint: digits are not grouped");
  expect_value_error("by_speed", 'n', "got 'by_speed'; expected a number");
  expect_value_error("7x5", 'n', "got '7x5'; expected a number");
  expect_value_error("1e", 'n', "got '1e'; expected a number");
  expect_value_error("0x10", 'n', "got '0x10'; expected a number");
  expect_value_error(".nan", 'n', "got '.nan'; expected a finite number");
  expect_value_error("nan", 'n', "got 'nan'; expected a finite number");
  expect_value_error("-.inf", 'n', "got '-.inf'; expected a finite number");
  expect_value_error("1e999", 'n',
                     "got '1e999'; expected a finite number in the range of double precision");
  expect_value_error("1e-999", 'n',
                     "got '1e-999'; expected a finite number in the range of double precision");
  expect_value_error("'1.5'", 'n',
                     "got the quoted text '1.5'; expected a number\n"
                     "  hint: numbers are written without quotes");
  expect_value_error("[1]", 'n', "got a sequence of 1; expected a number");
  expect_value_error("{a: 1}", 'n', "got a mapping; expected a number");
  expect_value_error("~", 'n', "got '~'; expected a number");
  expect_value_error("3", 'r', "got '3'; expected a number from 0 to 2.5");
  expect_value_error("-1", 'p', "got '-1'; expected a number of at least 0");
  expect_value_error("1e-300", 'm', "got '1e-300'; expected a number of at most 0");
  expect_value_error("x", 'r', "got 'x'; expected a number");
  expect_value_error("0123456789012345678901234567890123456789x", 'n',
                     "got '0123456789012345678901234567890123456789...'; expected a number");
}

static void whole_numbers(void **state) {
  (void)state;
  static const char *const bad[] = {"3.5", "-1", "0", "101", "1e30", "9223372036854775808", "1e1"};
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    char want[128];
    (void)snprintf(want, sizeof want, "got '%s'; expected a whole number from 1 to 100", bad[i]);
    expect_value_error(bad[i], 'i', want);
  }
  expect_value_error("'5'", 'i',
                     "got the quoted text '5'; expected a whole number from 1 to 100\n"
                     "  hint: numbers are written without quotes");
}

static void words(void **state) {
  (void)state;
  expect_value_error("yes", 'b', "got 'yes'; expected true or false");
  expect_value_error("True", 'b', "got 'True'; expected true or false");
  expect_value_error("'true'", 'b', "got the quoted text 'true'; expected true or false");
  expect_value_error("1", 'b', "got '1'; expected true or false");
  expect_value_error("slsp", 'c',
                     "got 'slsp'; expected one of: slsqp, auglag, auto\n"
                     "  hint: did you mean 'slsqp'?");
  expect_value_error("ipopt", 'c', "got 'ipopt'; expected one of: slsqp, auglag, auto");
  expect_value_error("[auto]", 'c', "got a sequence of 1; expected one of: slsqp, auglag, auto");
  expect_value_error("[a]", 't', "got a sequence of 1; expected a text");
  expect_value_error("{a: 1}", 't', "got a mapping; expected a text");
  expect_value_error("", 't', "got nothing; expected a text");
  static const char rule[] = "expected a name of 1 to 64 letters, digits, '_', '-' or '.'";
  static const char *const names[][2] = {{"a/b", "'a/b'"},
                                         {"'a b'", "the quoted text 'a b'"},
                                         {"\"a\\e[1m\"", "the quoted text 'a\\x1b[1m'"},
                                         {"\"a\\n\"", "the quoted text 'a\\x0a'"},
                                         {"''", "the quoted text ''"},
                                         {"[a]", "a sequence of 1"}};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
    char want[200];
    (void)snprintf(want, sizeof want, "got %s; %s", names[i][1], rule);
    expect_value_error(names[i][0], 'N', want);
  }
}

static void names_have_at_most_64_letters(void **state) {
  (void)state;
  char text[80];
  for (int length = 63; length <= 66; length++) {
    memcpy(text, "v: ", 3);
    memset(text + 3, 'a', (size_t)length);
    text[3 + length] = '\0';
    yaml_case c = yaml_open(text);
    assert_int_equal(ambulo__yaml_name(ambulo__yaml_get(c.root, "v"))[0] != '\0', length <= 64);
    expect_messages(&c, length <= 64 ? 0 : 1);
    yaml_shut(&c);
  }
}

static void lists(void **state) {
  (void)state;
  expect_value_error("[1, 2, 3]", 's', "got a sequence of 3; expected a sequence of 2 numbers");
  expect_value_error("[1]", 's', "got a sequence of 1; expected a sequence of 2 numbers");
  expect_value_error("1", 's', "got '1'; expected a sequence of 2 numbers");
  expect_value_error("1", 'L', "got '1'; expected a list");
  expect_value_error("{a: 1}", 'L', "got a mapping; expected a list");
  expect_value_error("", 'M', "got nothing; expected a mapping");
  expect_value_error("[{a: 1}]", 'M', "got a sequence of 1; expected a mapping");
  expect_value_error("[{a: 1}]", 'g', "got a sequence of 1; expected a mapping");
  yaml_case c = yaml_open("v: [x, y]\n");
  double pair[2] = {7.0, 8.0};
  assert_false(ambulo__yaml_numbers(ambulo__yaml_get(c.root, "v"), 2, pair));
  expect_message(&c, 0, "t.yaml:1:5: error[E_SCHEMA]: got 'x'; expected a number");
  expect_message(&c, 1, "t.yaml:1:8: error[E_SCHEMA]: got 'y'; expected a number");
  yaml_shut(&c);
}

static void good_values(void **state) {
  (void)state;
  static const char *const algorithms[] = {"slsqp", "auglag"};
  yaml_case c = yaml_open("n: -1.5e-3\ni: 100\nb: true\nf: false\nc: auglag\nN: a_B-1.x\n"
                          "t: 'a b'\nl: [1, 2.5]\ne: ''\n");
  const ambulo__yaml_node *root = c.root;
  double pair[2];
  assert_true(ambulo__yaml_number(ambulo__yaml_get(root, "n"), 0.0) == -1.5e-3);
  assert_true(ambulo__yaml_number_in(ambulo__yaml_get(root, "n"), -1.0, 0.0, 9.0) == -1.5e-3);
  assert_int_equal(ambulo__yaml_integer(ambulo__yaml_get(root, "i"), 1, 100, 0), 100);
  assert_int_equal(ambulo__yaml_boolean(ambulo__yaml_get(root, "b"), 0), 1);
  assert_int_equal(ambulo__yaml_boolean(ambulo__yaml_get(root, "f"), 1), 0);
  assert_int_equal(ambulo__yaml_choice(ambulo__yaml_get(root, "c"), algorithms, 2, 0), 1);
  assert_string_equal(ambulo__yaml_name(ambulo__yaml_get(root, "N")), "a_B-1.x");
  assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(root, "t")), "a b");
  assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(root, "e")), "");
  assert_true(ambulo__yaml_numbers(ambulo__yaml_get(root, "l"), 2, pair));
  assert_true(pair[0] == 1.0 && pair[1] == 2.5);
  ambulo__yaml_close(root);
  expect_messages(&c, 0);
  yaml_shut(&c);
}

static void absent_values_are_fallbacks(void **state) {
  (void)state;
  double pair[2] = {7.0, 8.0};
  assert_true(ambulo__yaml_number(NULL, 4.0) == 4.0);
  assert_true(ambulo__yaml_number_in(NULL, 0.0, 1.0, 4.0) == 4.0);
  assert_int_equal(ambulo__yaml_integer(NULL, 0, 1, 4), 4);
  assert_int_equal(ambulo__yaml_boolean(NULL, 4), 4);
  assert_int_equal(ambulo__yaml_choice(NULL, NULL, 0, 4), 4);
  assert_string_equal(ambulo__yaml_name(NULL), "");
  assert_string_equal(ambulo__yaml_text(NULL), "");
  assert_int_equal(ambulo__yaml_items(NULL), 0);
  assert_int_equal(ambulo__yaml_pairs(NULL), 0);
  assert_null(ambulo__yaml_item(NULL, 0));
  assert_null(ambulo__yaml_value(NULL, 0));
  assert_string_equal(ambulo__yaml_key(NULL, 0), "");
  assert_false(ambulo__yaml_is(NULL, AMBULO__YAML_SCALAR));
  assert_null(ambulo__yaml_place(NULL).file);
  assert_int_equal(ambulo__yaml_error(NULL, AMBULO_E_IO, NULL, "x"), AMBULO_E_IO);
  ambulo__yaml_warning(NULL, NULL, "x");
  assert_false(ambulo__yaml_numbers(NULL, 2, pair));
  assert_true(pair[0] == 7.0);
  assert_null(ambulo__yaml_get(NULL, "a"));
  assert_null(ambulo__yaml_require(NULL, "a"));
  ambulo__yaml_close(NULL);
}

static void missing_and_unknown_keys(void **state) {
  (void)state;
  yaml_case c = yaml_open("links:\n"
                          "- name: shank\n"
                          "  mas: 3\n"
                          "  zzzzzzz: 1\n"
                          "- {mass: 2}\n"
                          "extra: 1\n");
  const ambulo__yaml_node *links = ambulo__yaml_require(c.root, "links");
  for (int i = 0; i < 2; i++) {
    const ambulo__yaml_node *link = ambulo__yaml_item(links, i);
    assert_int_equal(ambulo__yaml_require(link, "mass") != NULL, i == 1);
    ambulo__yaml_expect(link, "name");
    ambulo__yaml_close(link);
  }
  assert_null(ambulo__yaml_require(c.root, "time"));
  ambulo__yaml_close(c.root);
  expect_message(&c, 0,
                 "t.yaml:2:3: error[E_SCHEMA]: missing required key 'mass' in links[0] ('shank')");
  expect_message(&c, 1,
                 "t.yaml:3:3: error[E_SCHEMA]: unknown key 'mas' in links[0] ('shank')\n"
                 "  hint: did you mean 'mass'?");
  expect_message(&c, 2,
                 "t.yaml:4:3: error[E_SCHEMA]: unknown key 'zzzzzzz' in links[0] ('shank')\n"
                 "  hint: known here: mass, name");
  expect_message(&c, 3,
                 "t.yaml:1:1: error[E_SCHEMA]: missing required key 'time' at the top level");
  expect_message(&c, 4,
                 "t.yaml:6:1: error[E_SCHEMA]: unknown key 'extra' at the top level\n"
                 "  hint: known here: links, time");
  expect_messages(&c, 5);
  assert_string_equal(ambulo_diagnostics_get(c.list, 1)->path, "links[0].mas");
  yaml_shut(&c);
}

/* no getter trusts its caller: each of them on each kind of node */
static void every_getter_takes_every_node(void **state) {
  (void)state;
  static const char *const words[] = {"a"};
  yaml_case c =
      yaml_open("n: 1\nw: word\ne:\nq: ''\nl: []\nL: [[1], {a: 1}]\nm: {}\nM: {a: [1]}\n");
  for (int i = -1; i <= ambulo__yaml_pairs(c.root); i++) {
    const ambulo__yaml_node *node = ambulo__yaml_value(c.root, i);
    double pair[2];
    assert_non_null(ambulo__yaml_text(node));
    assert_non_null(ambulo__yaml_name(node));
    assert_true(ambulo__yaml_items(node) >= 0 && ambulo__yaml_pairs(node) >= 0);
    assert_true(!ambulo__yaml_item(node, 0) || ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE));
    assert_true(!ambulo__yaml_value(node, 0) || ambulo__yaml_is(node, AMBULO__YAML_MAPPING));
    assert_null(ambulo__yaml_item(node, 100));
    assert_string_equal(ambulo__yaml_key(node, -1), "");
    assert_int_equal(ambulo__yaml_get(node, "a") != NULL, ambulo__yaml_value(node, 0) != NULL);
    (void)ambulo__yaml_require(node, "b");
    ambulo__yaml_expect(node, "b");
    (void)ambulo__yaml_number(node, 0.0);
    (void)ambulo__yaml_number_in(node, 0.0, 1.0, 0.0);
    (void)ambulo__yaml_integer(node, 0, 1, 0);
    (void)ambulo__yaml_boolean(node, 0);
    (void)ambulo__yaml_choice(node, words, 1, 0);
    (void)ambulo__yaml_numbers(node, 2, pair);
    ambulo__yaml_close(node);
  }
  assert_int_equal(ambulo__yaml_finish(c.document), AMBULO_E_SCHEMA);
  yaml_shut(&c);
}

/* a scalar where a section belongs is reported, and once */
static void sections_of_the_wrong_kind(void **state) {
  (void)state;
  yaml_case c = yaml_open("solver: 3\ntime:\ngait: [1]\n");
  static const char *const sections[] = {"solver", "time", "gait"};
  for (size_t i = 0; i < 3; i++) {
    const ambulo__yaml_node *section = ambulo__yaml_get(c.root, sections[i]);
    assert_null(ambulo__yaml_get(section, "a"));
    assert_null(ambulo__yaml_require(section, "b"));
    assert_null(ambulo__yaml_require(section, "c"));
    ambulo__yaml_close(section);
  }
  expect_message(&c, 0, "t.yaml:1:9: error[E_SCHEMA]: got '3'; expected a mapping");
  expect_message(&c, 1, "t.yaml:2:6: error[E_SCHEMA]: got nothing; expected a mapping");
  expect_message(&c, 2, "t.yaml:3:7: error[E_SCHEMA]: got a sequence of 1; expected a mapping");
  expect_messages(&c, 3);
  yaml_shut(&c);
}

/* without memory hints and paths may be lost, never the fault itself */
static void messages_without_memory(void **state) {
  (void)state;
  static const char text[] = "mas: x\nmass: y\n";
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__yaml *document = NULL;
    ambulo_status status =
        ambulo__yaml_load_text(text, sizeof text - 1, "t.yaml", &hook, NULL, &document);
    if (status == AMBULO_OK) {
      memory.fail_at = 0; /* everything from here on */
      const ambulo__yaml_node *root = ambulo__yaml_root(document);
      for (int i = 0; i < 2000; i++) {
        char key[32];
        (void)snprintf(key, sizeof key, "some_key_%d", i);
        assert_null(ambulo__yaml_get(root, key));
      }
      ambulo__yaml_number(ambulo__yaml_get(root, "mass"), 0.0);
      ambulo__yaml_close(root);
      assert_true(memory.failed);
      assert_int_equal(ambulo__yaml_finish(document), AMBULO_E_SCHEMA);
    }
    ambulo__yaml_free(document);
    assert_int_equal(memory.live, 0);
    if (status == AMBULO_OK) break;
    assert_int_equal(status, AMBULO_E_MEMORY);
  }
}

/* a part without a name is told by the item it belongs to */
static void parts_are_named_by_their_item(void **state) {
  (void)state;
  yaml_case c = yaml_open("name: x\n"
                          "links:\n"
                          "- name: shank\n"
                          "  body: {com: 1}\n"
                          "units: {}\n");
  const ambulo__yaml_node *link = ambulo__yaml_item(ambulo__yaml_require(c.root, "links"), 0);
  assert_null(ambulo__yaml_require(ambulo__yaml_require(link, "body"), "mass"));
  assert_null(ambulo__yaml_require(ambulo__yaml_require(c.root, "units"), "angle"));
  expect_message(&c, 0,
                 "t.yaml:4:9: error[E_SCHEMA]: missing required key 'mass' in links[0].body "
                 "('shank')");
  expect_message(&c, 1, "t.yaml:5:8: error[E_SCHEMA]: missing required key 'angle' in units");
  yaml_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(parts_are_named_by_their_item),
                                     cmocka_unit_test(numbers),
                                     cmocka_unit_test(every_getter_takes_every_node),
                                     cmocka_unit_test(whole_numbers),
                                     cmocka_unit_test(words),
                                     cmocka_unit_test(names_have_at_most_64_letters),
                                     cmocka_unit_test(lists),
                                     cmocka_unit_test(good_values),
                                     cmocka_unit_test(absent_values_are_fallbacks),
                                     cmocka_unit_test(missing_and_unknown_keys),
                                     cmocka_unit_test(sections_of_the_wrong_kind),
                                     cmocka_unit_test(messages_without_memory)};
  return cmocka_run_group_tests_name("format/yaml_get", tests, NULL, NULL);
}
