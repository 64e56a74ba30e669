/* summary.json: well-formed, complete, and the same through both doors. */
#include "show/summary_json.h"
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"
#include "solver/dense.h"
#include "support/walker_result.h"
#include "support/wellformed.h"

static void test_content(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  char *text = NULL;
  assert_int_equal(ambulo_report_summary(w.problem, w.result, NULL, NULL, &text), AMBULO_OK);
  assert_true(is_json(text));
  static const char *const parts[] = {"\"verdict\": \"feasible\"",
                                      "\"total\": 0.30000000000000004",
                                      "\"torque_squared\": ",
                                      "\"worst\": 3e-07",
                                      "\"family\": \"foot_strike\"",
                                      "\"row\": \"left_heel\"",
                                      "\"time\": 0.25",
                                      "\"dense_violation\": {",
                                      "\"kkt\": 0",
                                      "\"coordinates\": 9",
                                      "\"variables\": 135",
                                      "\"nodes\": 13",
                                      "\"linear_algebra\": 0",
                                      "\"nlopt\": \"",
                                      "\"libyaml\": \"0.",
                                      "\"instruction_set\": \"",
                                      "\"ending\": \"made by \\\"hand\\\"\\u000a\""};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
    if (!strstr(text, parts[i])) print_error("%s is missing from\n%s\n", parts[i], text);
    assert_non_null(strstr(text, parts[i]));
  }
  char hash[64];
  snprintf(hash, sizeof hash, "\"input_hash\": \"%016llx\"", ambulo_problem_hash(w.problem));
  assert_non_null(strstr(text, hash));
  ambulo_text_free(text, NULL);
  walk_close(&w);
}

/* a result that blew up is still JSON */
static void test_not_finite(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  w.result->objective = (double)NAN;
  w.result->audit.violation.worst = INFINITY;
  char *text = NULL;
  assert_int_equal(ambulo_report_summary(w.problem, w.result, NULL, NULL, &text), AMBULO_OK);
  assert_true(is_json(text));
  assert_non_null(strstr(text, "\"total\": null"));
  ambulo_text_free(text, NULL);
  walk_close(&w);
}

/* a whole stride of walk_normal: 75 kg for 1.08 s, and each foot comes down once */
static void test_stride(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  char *text = NULL;
  double sum = 0.0;
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", NULL, 0, NULL, NULL, &problem),
      AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_report_summary(problem, result, NULL, NULL, &text), AMBULO_OK);
  assert_int_equal(occurrences(text, "\"foot\": \"left\""), 1);
  assert_int_equal(occurrences(text, "\"foot\": \"right\""), 1);
  static const char key[] = "\"impulse_up\": ";
  for (const char *at = strstr(text, key); at; at = strstr(at + 1, key))
    sum += strtod(at + strlen(key), NULL);
  assert_close(sum, 794.61, 1e-5);
  ambulo_text_free(text, NULL);
  for (long k = 0; k < 1000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    memory.only_once = 1;
    text = NULL;
    ambulo_status status = ambulo_report_summary(problem, result, NULL, &hook, &text);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo_text_free(text, &hook);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* what happens between the nodes, with words, and where it is not finite */
static void test_between_nodes(void **state) {
  (void)state;
  static const char *const parts[] = {"\"between_nodes\": {",
                                      "\"samples\": 10",
                                      "\"holds\": 0",
                                      "\"family\": \"slip\"",
                                      "\"tolerance\": 0.001",
                                      "\"row\": \"",
                                      "feasible at the nodes only; ",
                                      "\"reason\": \"\"",
                                      "\"advice\": \"",
                                      "\"settings\": \""};
  for (int overflows = 0; overflows < 2; overflows++) {
    walk w;
    walk_open(&w, 12);
    if (overflows) w.result->x[9 * 7] = 1e200;
    assert_int_equal(ambulo__dense_audit(w.problem, 10, 1, NULL, w.result), AMBULO_OK);
    assert_int_equal(ambulo__dense_advise(w.problem, 1, NULL, NULL, w.result), AMBULO_OK);
    char *text = NULL;
    assert_int_equal(ambulo_report_summary(w.problem, w.result, NULL, NULL, &text), AMBULO_OK);
    assert_true(is_json(text));
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
      if (!strstr(text, parts[i])) print_error("%s is missing from\n%s\n", parts[i], text);
      assert_non_null(strstr(text, parts[i]));
    }
    const char *families = strstr(strstr(text, "\"between_nodes\""), "\"worst\": ");
    assert_int_equal(strncmp(families, "\"worst\": null", 13) == 0, overflows);
    ambulo_text_free(text, NULL);
    walk_close(&w);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_content), cmocka_unit_test(test_not_finite),
      cmocka_unit_test(test_stride), cmocka_unit_test(test_between_nodes)};
  return cmocka_run_group_tests_name("report/summary_json", tests, NULL, NULL);
}
