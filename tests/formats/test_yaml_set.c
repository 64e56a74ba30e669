#include "base/alloc.h"
#include "support/fail_alloc.h"
#include "support/yaml.h"

static const char TEXT[] = "time: {duration: 2.442, intervals: 36}\n"
                           "objective:\n"
                           "- {term: torque, weight: 1}\n"
                           "- {term: upright}\n"
                           "matrix: [[1, 2], [3, 4]]\n";

static const ambulo__yaml_node *at(const ambulo__yaml_node *node, const char *key) {
  return ambulo__yaml_get(node, key);
}

static void values_are_replaced_and_added(void **state) {
  (void)state;
  yaml_case c = yaml_open(TEXT);
  assert_int_equal(ambulo__yaml_set(c.document, "time.intervals", "72"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "objective[0].weight", " 0.5 "), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "objective[1].weight", "2"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "objective[upright].points", "7"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "matrix[1][0]", "9"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "matrix[0]", "[5, 6]"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "solver", "{algorithm: slsqp}"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "solver.continuation", "off"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "solver.continuation", "on"), AMBULO_OK);

  const ambulo__yaml_node *time = at(c.root, "time"), *terms = at(c.root, "objective");
  assert_int_equal(ambulo__yaml_integer(at(time, "intervals"), 1, 100, 0), 72);
  assert_true(ambulo__yaml_number(at(time, "duration"), 0.0) == 2.442);
  assert_true(ambulo__yaml_number(at(ambulo__yaml_item(terms, 0), "weight"), 0.0) == 0.5);
  assert_true(ambulo__yaml_number(at(ambulo__yaml_item(terms, 1), "weight"), 0.0) == 2.0);
  assert_int_equal(ambulo__yaml_integer(at(ambulo__yaml_item(terms, 1), "points"), 0, 9, 0), 7);
  double row[2][2];
  for (int i = 0; i < 2; i++)
    assert_true(ambulo__yaml_numbers(ambulo__yaml_item(at(c.root, "matrix"), i), 2, row[i]));
  assert_true(row[0][0] == 5.0 && row[0][1] == 6.0 && row[1][0] == 9.0 && row[1][1] == 4.0);
  const ambulo__yaml_node *solver = at(c.root, "solver");
  assert_string_equal(ambulo__yaml_text(at(solver, "algorithm")), "slsqp");
  assert_string_equal(ambulo__yaml_text(at(solver, "continuation")), "on");
  assert_int_equal(ambulo__yaml_pairs(solver), 2);
  assert_string_equal(ambulo__yaml_place(at(solver, "continuation")).path, "solver.continuation");
  assert_int_equal(ambulo__yaml_set(c.document, "matrix[1]", "[0, 0]"), AMBULO_OK);
  assert_string_equal(ambulo__yaml_place(ambulo__yaml_item(at(c.root, "matrix"), 1)).path,
                      "matrix[1]");
  expect_messages(&c, 0);
  yaml_shut(&c);
}

/* a number for all coordinates becomes a mapping that keeps it for those without their own */
static void one_scale_becomes_many(void **state) {
  (void)state;
  yaml_case c = yaml_open("term: {scale: 2.5, weight: 3}\nlist: [{scale: word}]\n");
  assert_int_equal(ambulo__yaml_set(c.document, "term.scale.knee", "4"), AMBULO_OK);
  const ambulo__yaml_node *scale = at(at(c.root, "term"), "scale");
  assert_int_equal(ambulo__yaml_pairs(scale), 2);
  assert_close(ambulo__yaml_number(at(scale, "default"), 0.0), 2.5, 0.0);
  assert_close(ambulo__yaml_number(at(scale, "knee"), 0.0), 4.0, 0.0);
  /* of other keys, and of what is no number, nothing is made */
  assert_int_not_equal(ambulo__yaml_set(c.document, "term.weight.knee", "4"), AMBULO_OK);
  assert_int_not_equal(ambulo__yaml_set(c.document, "list[0].scale.knee", "4"), AMBULO_OK);
  assert_int_not_equal(ambulo__yaml_set(c.document, "list[0].scale.knee", "null"), AMBULO_OK);
  assert_string_equal(ambulo__yaml_text(at(ambulo__yaml_item(at(c.root, "list"), 0), "scale")),
                      "word");
  expect_messages(&c, 3);
  yaml_shut(&c);
}

/* the name of a file of muscles becomes the mapping that has it */
static void one_file_becomes_a_mapping(void **state) {
  (void)state;
  yaml_case c = yaml_open("muscles: a b.yaml\nmodel: c.yaml\n");
  assert_int_equal(ambulo__yaml_set(c.document, "muscles.strength.knee", "4"), AMBULO_OK);
  const ambulo__yaml_node *muscles = at(c.root, "muscles");
  assert_int_equal(ambulo__yaml_pairs(muscles), 2);
  assert_string_equal(ambulo__yaml_text(at(muscles, "file")), "a b.yaml");
  assert_close(ambulo__yaml_number(at(at(muscles, "strength"), "knee"), 0.0), 4.0, 0.0);
  expect_messages(&c, 0);
  assert_int_not_equal(ambulo__yaml_set(c.document, "model.strength", "4"), AMBULO_OK);
  yaml_shut(&c);
}

/* what is not there is made below a key that is; rows of numbers are lengthened, to eight */
static void what_is_missing_is_made(void **state) {
  (void)state;
  yaml_case c = yaml_open("a: {row: [1], words: [[1]], one: 2}\n");
  assert_int_equal(ambulo__yaml_set(c.document, "a.row[3]", "7"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "a.new.deep.value", "5"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "a.fresh[1]", "6"), AMBULO_OK);
  const ambulo__yaml_node *a = at(c.root, "a"), *row = at(a, "row");
  assert_int_equal(ambulo__yaml_items(row), 4);
  double values[4] = {10, 20, 30, 40}; /* '~' keeps */
  assert_true(ambulo__yaml_numbers_over(row, 4, values));
  assert_true(values[0] == 1 && values[1] == 20 && values[2] == 30 && values[3] == 7);
  assert_close(ambulo__yaml_number(at(at(at(a, "new"), "deep"), "value"), 0.0), 5.0, 0.0);
  assert_int_equal(ambulo__yaml_items(at(a, "fresh")), 2);
  expect_messages(&c, 0);
  static const char *const wrong[] = {"a.row[8]", "a.words[1]", "a.one[0]", "none.deep",
                                      "b[0]",     "a.row.key",  "a..b",     "a.new[zero]"};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    ambulo_status status = ambulo__yaml_set(c.document, wrong[i], "1");
    if (!status) print_error("%s was set\n", wrong[i]);
    assert_int_equal(status, AMBULO_E_SCHEMA);
  }
  /* what takes away makes nothing */
  assert_int_equal(ambulo__yaml_set(c.document, "a.other.deep", "~"), AMBULO_E_SCHEMA);
  assert_null(at(a, "other"));
  assert_int_equal(ambulo__yaml_items(row), 4);
  yaml_shut(&c);
}

/* null and ~ leave a key or an item out; what follows moves up and keeps its place in messages */
/* words for all that a section holds */
static void words_give_way_to_what_they_stand_for(void **state) {
  (void)state;
  static const char *const words[] = {"on", "automatic"};
  for (int i = 0; i < 2; i++) {
    yaml_case c = yaml_open(TEXT);
    assert_int_equal(ambulo__yaml_set(c.document, "time.part", words[i]), AMBULO_OK);
    assert_int_equal(ambulo__yaml_set(c.document, "time.part.margin", "0.25"), AMBULO_OK);
    const ambulo__yaml_node *part = at(at(c.root, "time"), "part");
    assert_close(ambulo__yaml_number(at(part, "margin"), 0.0), 0.25, 0.0);
    yaml_shut(&c);
  }
}

static void null_leaves_out(void **state) {
  (void)state;
  yaml_case c = yaml_open(TEXT);
  assert_int_equal(ambulo__yaml_set(c.document, "time.duration", "null"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "objective[torque]", "~"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "matrix[1][0]", " null "), AMBULO_OK);
  const ambulo__yaml_node *time = at(c.root, "time"), *terms = at(c.root, "objective");
  const ambulo__yaml_node *row = ambulo__yaml_item(at(c.root, "matrix"), 1);
  assert_null(at(time, "duration"));
  assert_int_equal(ambulo__yaml_pairs(time), 1);
  assert_int_equal(ambulo__yaml_integer(at(time, "intervals"), 1, 100, 0), 36);
  assert_int_equal(ambulo__yaml_items(terms), 1);
  assert_string_equal(ambulo__yaml_text(at(ambulo__yaml_item(terms, 0), "term")), "upright");
  assert_string_equal(ambulo__yaml_place(ambulo__yaml_item(terms, 0)).path, "objective[0]");
  assert_int_equal(ambulo__yaml_items(row), 1);
  assert_int_equal(ambulo__yaml_set(c.document, "objective[0].term", "torque"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "objective[torque]", "null"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_items(at(c.root, "objective")), 0);
  assert_int_equal(ambulo__yaml_set(c.document, "time.duration", "\"null\""), AMBULO_OK);
  assert_string_equal(ambulo__yaml_text(at(time, "duration")), "null");
  assert_int_equal(ambulo__yaml_set(c.document, "time.duration", "null"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "time.duration", "2"), AMBULO_OK);
  assert_true(ambulo__yaml_number(at(time, "duration"), 0.0) == 2.0);
  expect_messages(&c, 0);
  yaml_shut(&c);
}

static const struct {
  const char *path, *value;
  ambulo_status status;
  const char *want;
  int hinted;
} faults[] = {
    {"nothing.there", "1", AMBULO_E_SCHEMA,
     ": error[E_SCHEMA]: the path needs a key that is not there (got 'nothing')", 1},
    {"tmie.duration", "1", AMBULO_E_SCHEMA,
     ": error[E_SCHEMA]: the path needs a key that is not there (got 'tmie')\n"
     "  hint: did you mean 'time'?",
     0},
    {"time.duration.x", "1", AMBULO_E_SCHEMA,
     ": error[E_SCHEMA]: the path goes through a value that is no mapping", 1},
    {"objective.x", "1", AMBULO_E_SCHEMA,
     ": error[E_SCHEMA]: the path goes through a value that is no mapping", 1},
    {"objective[2]", "1", AMBULO_E_SCHEMA,
     ": error[E_SCHEMA]: no item [2]; expected an index below 2", 0},
    {"time[0]", "1", AMBULO_E_SCHEMA, ": error[E_SCHEMA]: no item [0]; the value is no sequence",
     0},
    {"", "1", AMBULO_E_SCHEMA, ": error[E_SCHEMA]: the path is not well-formed", 1},
    {"time.", "1", AMBULO_E_SCHEMA, ": error[E_SCHEMA]: the path is not well-formed", 1},
    {".time", "1", AMBULO_E_SCHEMA, ": error[E_SCHEMA]: the path is not well-formed", 1},
    {"objective[]", "1", AMBULO_E_SCHEMA, ": error[E_SCHEMA]: the path is not well-formed", 1},
    {"objective[-1]", "1", AMBULO_E_SCHEMA, ": error[E_SCHEMA]: the path is not well-formed", 1},
    {"objective[x]", "1", AMBULO_E_SCHEMA,
     ": error[E_SCHEMA]: no item is named 'x'; expected the name of one, or its number", 0},
    {"time[x]", "1", AMBULO_E_SCHEMA, ": error[E_SCHEMA]: no item [x]; the value is no sequence",
     0},
    {"objective[0", "1", AMBULO_E_SCHEMA, ": error[E_SCHEMA]: the path is not well-formed", 1},
    {"objective[0]weight", "1", AMBULO_E_SCHEMA, ": error[E_SCHEMA]: the path is not well-formed",
     1},
    {"objective[99999999999999999999]", "1", AMBULO_E_SCHEMA,
     ": error[E_SCHEMA]: the path is not well-formed", 1},
    {"time.intervals", "", AMBULO_E_PARSE,
     ": error[E_PARSE]: got no value; expected YAML text such as 36, [1, 2] or off, or null "
     "to leave the key out",
     0},
    {"time.intervls", "null", AMBULO_E_SCHEMA,
     ": error[E_SCHEMA]: the path needs a key that is not there (got 'intervls')\n"
     "  hint: did you mean 'intervals'?",
     0},
    {"objective[2]", "~", AMBULO_E_SCHEMA,
     ": error[E_SCHEMA]: no item [2]; expected an index below 2", 0},
    {"time.intervals", "*a", AMBULO_E_PARSE,
     ":1:1: error[E_PARSE]: aliases ('*') are not allowed; expected a plain value", 0},
    {"time.intervals", "{a: 1, a: 2}", AMBULO_E_SCHEMA,
     ":1:8: error[E_SCHEMA]: duplicate key 'a'; the first one is in line 1", 0},
    {"time.intervals", "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]",
     AMBULO_E_LIMIT, ":1:31: error[E_LIMIT]: nested too deeply; expected at most 32 levels", 0}};

static void faults_name_the_setting(void **state) {
  (void)state;
  static const char hint[] = "\n  hint: paths look like 'time.intervals' or 'objective[0].weight'";
  for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
    char want[512];
    (void)snprintf(want, sizeof want, "--set %s%s%s", faults[i].path, faults[i].want,
                   faults[i].hinted ? hint : "");
    yaml_case c = yaml_open(TEXT);
    assert_int_equal(ambulo__yaml_set(c.document, faults[i].path, faults[i].value),
                     faults[i].status);
    expect_message(&c, 0, want);
    expect_messages(&c, 1);
    assert_int_equal(ambulo__yaml_integer(at(at(c.root, "time"), "intervals"), 1, 100, 0), 36);
    yaml_shut(&c);
  }
}

/* what the getters say about a value that was set */
static void a_wrong_value_is_blamed_on_the_setting(void **state) {
  (void)state;
  yaml_case c = yaml_open(TEXT);
  assert_int_equal(ambulo__yaml_set(c.document, "time.intervals", "many"), AMBULO_OK);
  assert_int_equal(ambulo__yaml_set(c.document, "tim", "1"), AMBULO_OK);
  ambulo__yaml_integer(at(at(c.root, "time"), "intervals"), 1, 100, 0);
  ambulo__yaml_expect(c.root, "objective");
  ambulo__yaml_expect(c.root, "matrix");
  ambulo__yaml_close(c.root);
  expect_message(&c, 0,
                 "--set time.intervals:1:1: error[E_SCHEMA]: got 'many'; expected a whole number "
                 "from 1 to 100");
  expect_message(&c, 1,
                 "--set tim: error[E_SCHEMA]: unknown key 'tim' at the top level\n"
                 "  hint: did you mean 'time'?");
  yaml_shut(&c);
}

static void out_of_memory_anywhere(void **state) {
  (void)state;
  static char value[40000] = "[";
  for (size_t i = 1; i + 2 < sizeof value; i += 2) memcpy(value + i, "1,", 2);
  value[sizeof value - 2] = ']';
  long k = 0;
  for (;; k++) {
    fail_alloc memory = fail_alloc_at(-1);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__yaml *document = NULL;
    assert_int_equal(
        ambulo__yaml_load_text(TEXT, sizeof TEXT - 1, "t.yaml", &hook, NULL, &document), AMBULO_OK);
    memory.fail_at = memory.requests + k;
    ambulo_status status = ambulo__yaml_set(document, "time.list", value);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    const ambulo__yaml_node *time = ambulo__yaml_value(ambulo__yaml_root(document), 0);
    assert_int_equal(ambulo__yaml_pairs(time), memory.failed ? 2 : 3);
    ambulo__yaml_free(document);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  assert_true(k > 10);
}

/* each path in turn, with what it makes on its way */
static void out_of_memory_on_the_way(void **state) {
  (void)state;
  static const char text[] = "a: {scale: 2, row: [1], on: automatic, muscles: m}\n";
  static const char *const paths[] = {"a.scale.knee", "a.row[5]",      "a.new.deep.key",
                                      "a.on.margin",  "a.none[2].key", "a.muscles.strength.knee"};
  for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
    for (long k = 0;; k++) {
      fail_alloc memory = fail_alloc_at(-1);
      ambulo_allocator hook = fail_alloc_hook(&memory);
      ambulo__yaml *document = NULL;
      assert_int_equal(
          ambulo__yaml_load_text(text, sizeof text - 1, "t.yaml", &hook, NULL, &document),
          AMBULO_OK);
      memory.fail_at = memory.requests + k;
      ambulo_status status = ambulo__yaml_set(document, paths[i], "[1, 2]");
      if (memory.failed) assert_int_equal(status, AMBULO_E_MEMORY);
      if (!memory.failed) assert_int_equal(status, i == 4 ? AMBULO_E_SCHEMA : AMBULO_OK);
      ambulo__yaml_free(document);
      assert_int_equal(memory.live, 0);
      if (!memory.failed) break;
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(values_are_replaced_and_added),
                                     cmocka_unit_test(words_give_way_to_what_they_stand_for),
                                     cmocka_unit_test(one_scale_becomes_many),
                                     cmocka_unit_test(one_file_becomes_a_mapping),
                                     cmocka_unit_test(what_is_missing_is_made),
                                     cmocka_unit_test(null_leaves_out),
                                     cmocka_unit_test(faults_name_the_setting),
                                     cmocka_unit_test(a_wrong_value_is_blamed_on_the_setting),
                                     cmocka_unit_test(out_of_memory_anywhere),
                                     cmocka_unit_test(out_of_memory_on_the_way)};
  return cmocka_run_group_tests_name("format/yaml_set", tests, NULL, NULL);
}
