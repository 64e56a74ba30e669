/* The ending tells which limit or which test ended a solve, and credits NLopt with nothing that it
 * did not do. */
#include "solver/result.h"
#include "solver/verdict.h"
#include "support/engine_fixture.h"

static ambulo_result *solve(const ambulo_problem *problem, const ambulo_options *options) {
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, options, NULL, NULL, NULL, &result), AMBULO_OK);
  return result;
}

static void expect(const ambulo_result *r, ambulo_ending ending, const char *words) {
  if (ambulo_result_ending_code(r) != ending || !strstr(ambulo_result_ending(r), words))
    print_error("%s: '%s', expected %s: '%s'\n", ambulo_ending_name(ambulo_result_ending_code(r)),
                ambulo_result_ending(r), ambulo_ending_name(ending), words);
  assert_int_equal(ambulo_result_ending_code(r), ending);
  assert_non_null(strstr(ambulo_result_ending(r), words));
}

static void limits_are_named(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_36");
  ambulo_options options = ambulo_problem_options(problem);
  options.maximum_iterations = 8;
  ambulo_result *r = solve(problem, &options);
  expect(r, AMBULO_ENDING_ITERATIONS, "the iteration limit was met (8)");
  assert_int_not_equal(ambulo_result_verdict(r), AMBULO_OPTIMAL);
  assert_null(strstr(ambulo_result_ending(r), "converged"));
  ambulo_result_free(r);
  options = ambulo_problem_options(problem);
  options.maximum_evaluations = 60;
  r = solve(problem, &options);
  expect(r, AMBULO_ENDING_EVALUATIONS, "the evaluation limit was met (60)");
  ambulo_result_free(r);
  options = ambulo_problem_options(problem);
  options.time_limit = 0.02;
  r = solve(problem, &options);
  expect(r, AMBULO_ENDING_TIME, "the time limit was met (0.02 s)");
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

static int stop(void *user, const ambulo_progress *progress) {
  (void)user;
  return progress->iteration >= 3;
}

static void tests_are_named(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_36");
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *r = solve(problem, &options);
  expect(r, AMBULO_ENDING_CONVERGED, "reduced gradient is small");
  ambulo_result_free(r);
  options.progress = stop;
  r = solve(problem, &options);
  expect(r, AMBULO_ENDING_CALLER, "stopped by the caller");
  ambulo_result_free(r);
  ambulo_problem_free(problem);
  problem = load_problem_with("yardstick_12", "trajectory={basis: hermite}");
  r = solve(problem, NULL);
  expect(r, AMBULO_ENDING_VANISHED, "went to zero");
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

/* where NLopt ends the solve its word is given; where the pipeline does, only its part is named */
static void nlopt_has_its_own_words(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("two_link_reach");
  ambulo_options options = ambulo_problem_options(problem);
  options.presolve = 0;
  ambulo_result *r = solve(problem, &options);
  expect(r, AMBULO_ENDING_NLOPT, "NLopt's SLSQP, plain (its last call: ");
  ambulo_result_free(r);
  ambulo_problem_free(problem);
  problem = load_problem("walker_2d_step");
  r = solve(problem, NULL);
  expect(r, AMBULO_ENDING_CONVERGED, "pipeline (inner steps: NLopt's AUGLAG with LBFGS)");
  assert_null(strstr(ambulo_result_ending(r), "its last call"));
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

/* a cap that ends nothing changes nothing */
static void caps_that_are_not_met_change_nothing(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_12");
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *a = solve(problem, &options);
  options.maximum_iterations = ambulo_result_iterations(a);
  ambulo_result *b = solve(problem, &options);
  assert_close(ambulo_result_objective(b), ambulo_result_objective(a), 0.0);
  expect(b, AMBULO_ENDING_CONVERGED, "");
  ambulo_result_free(a);
  ambulo_result_free(b);
  ambulo_problem_free(problem);
}

/* heavier and heavier loads on limited joints: a few thousandths of a newton metre are no reason to
 * call a walk infeasible */
static void torques_are_judged_by_their_size(void **state) {
  (void)state;
  static const char *const loads[] = {"load.mass=60", "load.mass=150"};
  for (size_t i = 0; i < 2; i++) {
    const char *overrides[] = {loads[i], "constraints.torque_limits=true"};
    ambulo_problem *problem = NULL;
    assert_int_equal(
        ambulo_problem_load("models/walk_loaded.yaml", overrides, 2, NULL, NULL, &problem),
        AMBULO_OK);
    ambulo_result *r = solve(problem, NULL);
    const ambulo_violation *v = &ambulo_result_audit(r)->violation;
    if (ambulo_result_verdict(r) != AMBULO_OPTIMAL)
      print_error("%s: %s, %s off by %g %s\n", loads[i],
                  ambulo_verdict_name(ambulo_result_verdict(r)), v->family, v->worst, v->unit);
    assert_int_equal(ambulo_result_verdict(r), AMBULO_OPTIMAL);
    ambulo_result_free(r);
    ambulo_problem_free(problem);
  }
}

/* every family has a size that belongs to its unit */
static void violations_have_sizes(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("two_link_reach");
  ambulo_result *r = solve(problem, NULL);
  const double *gravity = ambulo_model_gravity(ambulo_problem_model(problem));
  double weight = ambulo_model_mass(ambulo_problem_model(problem)) * fabs(gravity[1]);
  for (int f = 0; f < ambulo_result_family_count(r); f++) {
    const ambulo_violation *v = ambulo_result_family(r, f);
    double want = !strcmp(v->unit, "N m") ? weight : !strcmp(v->unit, "rad/s") ? 10.0 : 1.0;
    assert_close(v->size, want, 1e-12);
  }
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

/* a result that nobody filled is not judged */
static void zero_is_no_verdict(void **state) {
  (void)state;
  ambulo_verdict zero = (ambulo_verdict)0;
  assert_string_equal(ambulo_verdict_name(zero), "not_judged");
  assert_false(ambulo_verdict_is_solution(zero));
  for (int v = 1; v <= AMBULO_INTERRUPTED; v++)
    assert_int_equal(ambulo_verdict_is_solution((ambulo_verdict)v),
                     v == AMBULO_OPTIMAL || v == AMBULO_FEASIBLE);
  ambulo_problem *problem = load_problem("pendulum_swing");
  ambulo_result *r = NULL;
  assert_int_equal(ambulo__result_create(problem, NULL, &r), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(r), AMBULO_NOT_JUDGED);
  ambulo_options options = ambulo_options_default();
  assert_int_equal(ambulo__verdict_of(ambulo_result_audit(r), &options, AMBULO_ENDING_CONVERGED),
                   AMBULO_NUMERIC_FAILURE);
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

static void endings_have_names(void **state) {
  (void)state;
  for (int a = AMBULO_ENDING_NONE; a <= AMBULO_ENDING_CALLER; a++) {
    assert_true(strlen(ambulo_ending_text((ambulo_ending)a)) > 10);
    for (int b = AMBULO_ENDING_NONE; b < a; b++)
      assert_string_not_equal(ambulo_ending_name((ambulo_ending)a),
                              ambulo_ending_name((ambulo_ending)b));
  }
  assert_string_equal(ambulo_ending_name((ambulo_ending)99), "unknown");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(limits_are_named),
      cmocka_unit_test(tests_are_named),
      cmocka_unit_test(nlopt_has_its_own_words),
      cmocka_unit_test(caps_that_are_not_met_change_nothing),
      cmocka_unit_test(torques_are_judged_by_their_size),
      cmocka_unit_test(violations_have_sizes),
      cmocka_unit_test(zero_is_no_verdict),
      cmocka_unit_test(endings_have_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
