/* Another grid is the same problem; knot insertion keeps the motion. */
#include "nlp/problem.h"
#include "support/problem_fixture.h"

static void transfer_to_a_finer_spline_keeps_the_motion(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  fixture_open(&f, &definition);
  ambulo_problem *fine = NULL;
  assert_int_equal(ambulo__problem_with_grid(f.problem, 30, 30, NULL, &fine), AMBULO_OK);
  int n = ambulo_problem_variable_count(fine);
  assert_int_equal(n, 2 * 33);
  double *x = calloc((size_t)n, sizeof *x);
  assert_int_equal(ambulo_problem_transfer(f.problem, f.x, fine, x), AMBULO_OK);
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(fine, NULL, &workspace), AMBULO_OK);
  double times[7], coarse_tau[14], fine_tau[14];
  for (int i = 0; i < 7; i++) times[i] = 0.01 + 0.14 * i;
  ambulo_motion a = {.tau = coarse_tau}, b = {.tau = fine_tau};
  assert_int_equal(ambulo_problem_motion(f.problem, f.workspace, f.x, 7, times, &a), AMBULO_OK);
  assert_int_equal(ambulo_problem_motion(fine, workspace, x, 7, times, &b), AMBULO_OK);
  for (int i = 0; i < 14; i++) assert_close(fine_tau[i], coarse_tau[i], 1e-9);
  free(x);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(fine);
  fixture_close(&f);
}

static void references_are_resampled(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  double reference[22];
  for (int k = 0; k < 11; k++) {
    reference[2 * k] = 0.1 * k;
    reference[2 * k + 1] = 1.0 - 0.2 * k;
  }
  ambulo_term term = ambulo_term_default(AMBULO_TRACKING);
  term.reference = reference;
  ambulo_problem_definition definition = arm_definition(f.model);
  definition.terms = &term;
  definition.term_count = 1;
  fixture_open(&f, &definition);
  ambulo_problem *fine = NULL;
  assert_int_equal(ambulo__problem_with_grid(f.problem, 25, 10, NULL, &fine), AMBULO_OK);
  const double *r = fine->definition.terms[0].reference;
  for (int k = 0; k <= 25; k++) {
    assert_close(r[2 * k], 0.04 * k, 1e-14);
    assert_close(r[2 * k + 1], 1.0 - 0.08 * k, 1e-14);
  }
  ambulo_problem_free(fine);
  fixture_close(&f);
}

static void other_models_are_refused(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  fixture_open(&f, &definition);
  definition.duration = 1.5;
  ambulo_problem *other = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &other), AMBULO_OK);
  assert_int_equal(ambulo_problem_transfer(f.problem, f.x, other, f.gradient), AMBULO_E_ARGUMENT);
  ambulo_problem_free(other);
  fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(transfer_to_a_finer_spline_keeps_the_motion),
      cmocka_unit_test(references_are_resampled),
      cmocka_unit_test(other_models_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
