/* Every verdict can be reached, and each has a name and a text. */
#include "solver/result.h"
#include "support/test.h"

static ambulo_verdict verdict(double violation, double kkt, ambulo_ending ending) {
  ambulo_options options = ambulo_options_default();
  ambulo_audit audit = {.kkt = kkt};
  audit.violation.worst = violation;
  audit.violation.size = 1.0;
  return ambulo__verdict_of(&audit, &options, ending);
}

static void each_is_reached(void **state) {
  (void)state;
  assert_int_equal(verdict(1e-7, 1e-5, AMBULO_ENDING_CONVERGED), AMBULO_OPTIMAL);
  assert_int_equal(verdict(1e-7, 1e-5, AMBULO_ENDING_TIME), AMBULO_OPTIMAL);
  assert_int_equal(verdict(1e-7, 0.1, AMBULO_ENDING_CONVERGED), AMBULO_FEASIBLE);
  assert_int_equal(verdict(1e-7, 0.1, AMBULO_ENDING_TIME), AMBULO_FEASIBLE);
  assert_int_equal(verdict(1e-3, 1e-5, AMBULO_ENDING_CONVERGED), AMBULO_INFEASIBLE);
  assert_int_equal(verdict(1e-3, 1e-5, AMBULO_ENDING_TIME), AMBULO_LIMIT_REACHED);
  assert_int_equal(verdict(1e-3, 1e-5, AMBULO_ENDING_EVALUATIONS), AMBULO_LIMIT_REACHED);
  assert_int_equal(verdict(1e-3, 1e-5, AMBULO_ENDING_ITERATIONS), AMBULO_LIMIT_REACHED);
  assert_int_equal(verdict(1e-3, 1e-5, AMBULO_ENDING_CALLER), AMBULO_INTERRUPTED);
  assert_int_equal(verdict(1e-3, 1e-5, AMBULO_ENDING_NOT_FINITE), AMBULO_NUMERIC_FAILURE);
  assert_int_equal(verdict(1e-7, 0.1, AMBULO_ENDING_NOT_FINITE), AMBULO_NUMERIC_FAILURE);
  assert_int_equal(verdict(1e-7, NAN, AMBULO_ENDING_CONVERGED), AMBULO_FEASIBLE);
  assert_int_equal(verdict(NAN, 1e-5, AMBULO_ENDING_CONVERGED), AMBULO_NUMERIC_FAILURE);
  assert_int_equal(verdict(HUGE_VAL, 0.0, AMBULO_ENDING_CALLER), AMBULO_NUMERIC_FAILURE);
}

/* a violation counts relative to the size of its row: 0.001 N of 290 N, not of 1 */
static void violations_have_sizes(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo_audit audit = {.violation = {.worst = 5e-5, .size = 290.0}};
  assert_int_equal(ambulo__verdict_of(&audit, &options, AMBULO_ENDING_CONVERGED), AMBULO_OPTIMAL);
  audit.violation.size = 1.0;
  assert_int_equal(ambulo__verdict_of(&audit, &options, AMBULO_ENDING_CONVERGED),
                   AMBULO_INFEASIBLE);
}

static void a_lower_bound_is_a_proof(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo_audit audit = {.kkt = 0.9, .at_lower_bound = 1};
  audit.violation.size = 1.0;
  assert_int_equal(ambulo__verdict_of(&audit, &options, AMBULO_ENDING_CONVERGED), AMBULO_OPTIMAL);
  audit.violation.worst = 1e-3;
  assert_int_equal(ambulo__verdict_of(&audit, &options, AMBULO_ENDING_CONVERGED),
                   AMBULO_INFEASIBLE);
}

static void names_are_distinct(void **state) {
  (void)state;
  for (int a = AMBULO_NOT_JUDGED; a <= AMBULO_NOT_CONVERGED; a++) {
    assert_true(strlen(ambulo_verdict_text((ambulo_verdict)a)) > 10);
    for (int b = AMBULO_NOT_JUDGED; b < a; b++)
      assert_string_not_equal(ambulo_verdict_name((ambulo_verdict)a),
                              ambulo_verdict_name((ambulo_verdict)b));
  }
  assert_string_equal(ambulo_verdict_name(AMBULO_LIMIT_REACHED), "limit");
  assert_string_equal(ambulo_verdict_name((ambulo_verdict)99), "unknown");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_is_reached), cmocka_unit_test(violations_have_sizes),
      cmocka_unit_test(a_lower_bound_is_a_proof), cmocka_unit_test(names_are_distinct)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
