/* Outputs: paths into a summary, reductions of a motion's columns. */
#include "study/results.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/scratch.h"

static const char id[] = "000000001-0000abcd";

static void make_result(void **state) {
  assert_int_equal(mkdir(scratch_path(state, "cases"), 0777), 0);
  assert_int_equal(mkdir(scratch_path(state, "cases/cd"), 0777), 0);
  assert_int_equal(mkdir(scratch_path(state, "cases/cd/000000001-0000abcd"), 0777), 0);
  scratch_write(
      scratch_path(state, "cases/cd/000000001-0000abcd/summary.json"),
      "{\"verdict\": \"optimal\", \"objective\": {\"total\": 2.5, \"terms\": {\"a\": 1}},\n"
      "\"body\": {\"up\": [0, 1, 0]}, \"none\": null}\n");
  /* the mean is over time: 2 for 1 s, then from 2 to 4 in 1 s */
  scratch_write(scratch_path(state, "cases/cd/000000001-0000abcd/motion.csv"),
                "# units\ntime,q.pin,zmp.x\n1,2,nan\n2,2,1\n2.5,3,nan\n3,4,5\n");
}

static void values_are_found(void **state) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  const char *output[] = {"verdict",     "objective",    "objective.terms.a", "body.up[1]",
                          "max(q.pin)",  "min(q.pin)",   "mean(q.pin)",       "range(q.pin)",
                          "none",        "max(q.other)", "body.up[7]",        "verdict.deeper",
                          "range(zmp.x)"};
  enum { COUNT = sizeof output / sizeof *output };
  static const char *const expected[COUNT] = {"optimal", "2.5", "1", "1", "4", "2", "2.5",
                                              "2",       "",    "",  "",  "",  "4"};
  ambulo__output value[COUNT];
  make_result(state);
  assert_int_equal(ambulo__outputs_of(*state, id, output, COUNT, &plain, NULL, value), AMBULO_OK);
  for (int i = 0; i < COUNT; i++) {
    if (strcmp(value[i].text, expected[i]) != 0) print_error("%s:\n", output[i]);
    assert_string_equal(value[i].text, expected[i]);
    assert_int_equal(value[i].kind == AMBULO__OUTPUT_NONE, expected[i][0] == '\0');
  }
}

static void misspelt_names_have_a_nearest(void **state) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  static const char *const pairs[][2] = {{"objectiv", "objective"},
                                         {"objective.totl", "total"},
                                         {"body.upp[1]", "up"},
                                         {"max(q.pni)", "q.pin"},
                                         {"min(zpm.x)", "zmp.x"}};
  char near[64];
  make_result(state);
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
    assert_true(ambulo__output_nearest(*state, id, pairs[i][0], &plain, near, sizeof near));
    assert_string_equal(near, pairs[i][1]);
  }
  assert_false(ambulo__output_nearest(*state, id, "something.else", &plain, near, sizeof near));
  assert_false(ambulo__output_nearest(*state, id, "max(ground)", &plain, near, sizeof near));
}

/* a file that is not there is no output that the result does not have */
static void what_cannot_be_read_is_told(void **state) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  static const struct {
    const char *file, *text, *output;
    ambulo_status status;
    const char *message;
  } faults[] = {
      {"summary.json", NULL, "verdict", AMBULO_E_IO, "summary.json: error[E_IO]: cannot open"},
      {"motion.csv", NULL, "max(q.pin)", AMBULO_E_IO, "motion.csv: error[E_IO]: cannot open"},
      {"summary.json", "{\"verdict\": \"opt", "verdict", AMBULO_E_PARSE, "summary.json:"},
      {"motion.csv", "# units\n", "max(q.pin)", AMBULO_E_PARSE, "motion.csv: error[E_PARSE]"}};
  for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
    char path[128];
    const char *output[] = {"objective.terms.a", faults[i].output};
    ambulo__output value[2] = {{.number = 17.0}, {.number = 17.0}};
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    if (i == 0) make_result(state);
    snprintf(path, sizeof path, "cases/cd/000000001-0000abcd/%s", faults[i].file);
    char *kept = read_whole(scratch_path(state, path));
    if (faults[i].text) {
      scratch_write(scratch_path(state, path), faults[i].text);
    } else {
      assert_int_equal(unlink(scratch_path(state, path)), 0);
    }
    assert_int_equal(ambulo__outputs_of(*state, id, output, 2, &plain, list, value),
                     faults[i].status);
    assert_message(list, 0, faults[i].message);
    assert_true(value[0].number == 17.0 && value[1].number == 17.0);
    scratch_write(scratch_path(state, path), kept);
    free(kept);
    ambulo_diagnostics_free(list);
  }
}

/* the k-th request for memory fails: E_MEMORY, never a value that is missing */
static void without_memory_no_value_is_missing(void **state) {
  const char *output[] = {(char *)(uintptr_t) "objective", (char *)(uintptr_t) "max(q.pin)"};
  make_result(state);
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__output value[2];
    memset(value, 0, sizeof value);
    ambulo_status status = ambulo__outputs_of(*state, id, output, 2, &hook, NULL, value);
    assert_int_equal(memory.live, 0);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (!memory.failed) {
      assert_string_equal(value[0].text, "2.5");
      assert_string_equal(value[1].text, "4");
      break;
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(values_are_found, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(misspelt_names_have_a_nearest, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(what_cannot_be_read_is_told, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(without_memory_no_value_is_missing, scratch_open,
                                      scratch_close),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
