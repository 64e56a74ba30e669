/* Which format a file is in: by its kind, by its keys, and what is said of the wrong one. */
#include "base/diagnostics.h"
#include "formats/yaml_node.h"
#include "support/messages.h"
#include "support/test.h"

#include <string.h>

/* the index found in `kinds`, and the status that reading ends with */
static int kind_of(const char *text, const char *const *kinds, int count, ambulo_diagnostics *list,
                   ambulo_status *status) {
  ambulo__yaml *document = NULL;
  ambulo__diagnostics_clear(list);
  assert_int_equal(ambulo__yaml_load_text(text, strlen(text), "f.yaml", NULL, list, &document), 0);
  int found = ambulo__yaml_file_kind(ambulo__yaml_root(document), kinds, count);
  *status = ambulo__yaml_finish(document);
  ambulo__yaml_free(document);
  return found;
}

static const char *const model[] = {"model"}, *const problem[] = {"problem"},
                         *const either[] = {"model", "problem"};

static void right_kinds(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status;
  assert_int_equal(kind_of("kind: problem\n", problem, 1, list, &status), 0);
  assert_int_equal(kind_of("kind: problem\n", either, 2, list, &status), 1);
  assert_int_equal(status, AMBULO_OK);
  /* a model need not say it */
  assert_int_equal(kind_of("ambulo: 1\nname: x\n", model, 1, list, &status), 0);
  assert_int_equal(status, AMBULO_OK);
  assert_int_equal(kind_of("links: []\n", either, 2, list, &status), 0);
  assert_int_equal(status, AMBULO_OK);
  ambulo_diagnostics_free(list);
}

static void missing_kinds(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status;
  assert_int_equal(kind_of("ambulo: 1\n", problem, 1, list, &status), 0);
  assert_message(list, 0, "missing required key 'kind'");
  assert_int_equal(status, AMBULO_E_SCHEMA);
  assert_int_equal(kind_of("objective: none\n", either, 2, list, &status), 1);
  assert_message(list, 0, "missing required key 'kind'");
  assert_int_equal(kind_of("ambulo: 1\n", either, 2, list, &status), 0);
  assert_message(list, 0, "missing required key 'kind'");
  ambulo_diagnostics_free(list);
}

/* JSON and YAML of other programs: one line, not every key that they lack */
static void strange_files(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status;
  assert_int_equal(kind_of("{\"a\": 1}", problem, 1, list, &status), -1);
  assert_message(list, 0,
                 "f.yaml:1:1: error[E_SCHEMA]: no key 'ambulo' and no 'kind': this is no "
                 "file of Ambulo; expected a problem");
  assert_message(list, 0, "begins with 'ambulo: 1' and 'kind: problem'");
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  assert_int_equal(status, AMBULO_E_SCHEMA);
  assert_int_equal(kind_of("name: x\n", model, 1, list, &status), -1);
  assert_message(list, 0, "expected a skeleton model");
  ambulo_diagnostics_free(list);
}

static void wrong_kinds(void **state) {
  (void)state;
  static const struct {
    const char *text, *says, *hints;
  } cases[] = {
      {"ambulo: 1\nkind: model\n",
       "f.yaml:2:7: error[E_SCHEMA]: this is a skeleton model; "
       "expected a problem",
       "under 'model:'"},
      {"kind: sweep\n", "this is a sweep; expected a problem", "ambulo batch"},
      {"kind: solution\n", "this is a solution; expected a problem", "ambulo evaluate"},
      {"links: []\n", "f.yaml:1:1: error[E_SCHEMA]: this is a skeleton model", "'model:'"},
      {"{\"schema\": \"ambulo-summary/1\", \"objective\": {}}", "this is the summary of a result",
       "the YAML file"},
      {"kind: problme\n", "got 'problme'; expected one of: problem", "did you mean 'problem'?"},
      {"kind: [model]\n", "got a sequence of 1; expected one of: problem", NULL},
  };
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    ambulo_status status;
    assert_int_equal(kind_of(cases[i].text, problem, 1, list, &status), -1);
    assert_int_equal(status, AMBULO_E_SCHEMA);
    assert_int_equal(ambulo_diagnostics_count(list), 1);
    assert_message(list, 0, cases[i].says);
    if (cases[i].hints) assert_message(list, 0, cases[i].hints);
  }
  ambulo_status status;
  assert_int_equal(kind_of("kind: sweep\n", either, 2, list, &status), -1);
  assert_message(list, 0, "expected a skeleton model or a problem");
  ambulo_diagnostics_free(list);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(right_kinds),
      cmocka_unit_test(missing_kinds),
      cmocka_unit_test(strange_files),
      cmocka_unit_test(wrong_kinds),
  };
  return cmocka_run_group_tests_name("formats/yaml_load", tests, NULL, NULL);
}
