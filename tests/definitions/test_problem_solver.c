/* `solver:`. */
#include "definitions/problem_text.h"
#include "support/arm.h"

#define HEAD PENDULUM "time: {duration: 1, intervals: 4}\nobjective: none\n"

static void absent_means_defaults(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(HEAD);
  ambulo_options got = ambulo_problem_options(p), want = ambulo_options_default();
  assert_int_equal(got.size, want.size);
  assert_int_equal(got.algorithm, want.algorithm);
  assert_int_equal(got.presolve, want.presolve);
  assert_int_equal(got.maximum_evaluations, want.maximum_evaluations);
  assert_close(got.feasibility_tolerance, want.feasibility_tolerance, 0.0);
  ambulo_problem_free(p);
}

static void without_a_file_all_are_defaults(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition definition = arm_definition(model);
  ambulo_problem *p = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &p), AMBULO_OK);
  ambulo_options got = ambulo_problem_options(p), want = ambulo_options_default();
  assert_int_equal(got.size, want.size);
  assert_int_equal(got.maximum_iterations, want.maximum_iterations);
  assert_int_equal(got.dense_samples, want.dense_samples);
  ambulo_problem_free(p);
  ambulo_model_free(model);
}

static void every_key_arrives(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      HEAD "solver: {algorithm: auglag, presolve: off, maximum_evaluations: 77, time_limit: 2.5,\n"
           "  feasibility_tolerance: 1e-7, optimality_tolerance: 1e-4, continuation: false,\n"
           "  dense_samples: 3, equalities: nlopt}\n");
  ambulo_options o = ambulo_problem_options(p);
  assert_int_equal(o.algorithm, AMBULO_AUGLAG);
  assert_int_equal(o.presolve, 0);
  assert_int_equal(o.maximum_evaluations, 77);
  assert_close(o.time_limit, 2.5, 0.0);
  assert_close(o.feasibility_tolerance, 1e-7, 1e-20);
  assert_close(o.optimality_tolerance, 1e-4, 1e-20);
  assert_int_equal(o.continuation, 0);
  assert_int_equal(o.dense_samples, 3);
  assert_int_equal(o.equalities, AMBULO_EQUALITIES_NLOPT);
  ambulo_problem_free(p);
}

static void switches_have_two_spellings(void **state) {
  (void)state;
  static const char *const words[] = {"on", "true", "off", "false"};
  for (int i = 0; i < 4; i++) {
    char text[256];
    (void)snprintf(text, sizeof text, HEAD "solver: {presolve: %s}\n", words[i]);
    ambulo_problem *p = problem_of(text);
    assert_int_equal(ambulo_problem_options(p).presolve, i < 2);
    ambulo_problem_free(p);
  }
}

static void faults_are_placed(void **state) {
  (void)state;
  expect_refusal(HEAD "solver: {algorithm: ipopt}\n", AMBULO_E_SCHEMA, "p.yaml:6:21: error");
  expect_refusal(HEAD "solver: {equalities: ours}\n", AMBULO_E_SCHEMA, "p.yaml:6:22: error");
  expect_refusal(HEAD "solver: {presolve: maybe}\n", AMBULO_E_SCHEMA, "p.yaml:6:20: error");
  expect_refusal(HEAD "solver: {time_limit: -1}\n", AMBULO_E_SCHEMA, "p.yaml:6:22: error");
  expect_refusal(HEAD "solver: {maximum_evaluations: 1.5}\n", AMBULO_E_SCHEMA,
                 "p.yaml:6:31: error");
  expect_refusal(HEAD "solver: {feasibility_tolerance: 0}\n", AMBULO_E_SCHEMA,
                 "p.yaml:6:33: error");
  expect_refusal(HEAD "solver: {tolerance: 1}\n", AMBULO_E_SCHEMA, "unknown key 'tolerance'");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(absent_means_defaults), cmocka_unit_test(without_a_file_all_are_defaults),
      cmocka_unit_test(every_key_arrives), cmocka_unit_test(switches_have_two_spellings),
      cmocka_unit_test(faults_are_placed)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
