/* The method on one grid: the yardstick's optimum is met; the last steps leave no violation. */
#include "support/engine_fixture.h"

static double solve(double *violation, int *evaluations) {
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  double objective = f.engine->workspace->objective;
  *violation = fmax(ambulo__engine_equality_error(f.engine),
                    ambulo__engine_excess(f.engine, f.engine->held.excess));
  *evaluations = f.run.evaluations;
  engine_close(&f);
  return objective;
}

static void yardstick_reaches_its_optimum(void **state) {
  (void)state;
  double violation;
  int evaluations;
  double f = solve(&violation, &evaluations);
  if (f > 0.3564 * 1.001) print_error("f = %.6f after %d evaluations\n", f, evaluations);
  assert_close(f, 0.35640, 1e-3 * 0.35640); /* known: IPOPT 0.3564029 */
  assert_true(violation <= 1e-6);
  assert_true(evaluations < 400);
}

static void polish_closes_what_is_left(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  f.options.feasibility_tolerance = 1e-3;
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
  f.options.feasibility_tolerance = 1e-8;
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  double before = f.engine->workspace->objective;
  assert_true(ambulo__engine_excess(f.engine, f.engine->held.excess) > 1e-8);
  assert_int_equal(ambulo__polish(f.engine, f.x), 1);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  assert_true(ambulo__engine_excess(f.engine, f.engine->held.excess) <= 1e-8);
  assert_close(f.engine->workspace->objective, before, 1e-2);
  engine_close(&f);
}

/* Equalities hold to what is asked: at any tolerance the same walk, never a violation that "the
 * rows hold" leaves. */
static void tight_tolerances_are_met(void **state) {
  (void)state;
  static const char *const tolerances[] = {"solver.feasibility_tolerance=1e-9",
                                           "solver.feasibility_tolerance=1e-11",
                                           "solver.feasibility_tolerance=1e-13"};
  for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++) {
    ambulo_problem *problem = load_problem_with("yardstick_12", tolerances[i]);
    ambulo_result *result = NULL;
    assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
    if (ambulo_result_verdict(result) != AMBULO_OPTIMAL)
      print_error("%s: %s, off by %g\n", tolerances[i],
                  ambulo_verdict_name(ambulo_result_verdict(result)),
                  ambulo_result_audit(result)->violation.worst);
    assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
    assert_int_equal(ambulo_result_ending_code(result), AMBULO_ENDING_CONVERGED);
    ambulo_result_free(result);
    ambulo_problem_free(problem);
  }
}

/* Hermite nodes whose forces can all vanish: the objective goes to zero, the solve ends */
static void vanishing_objective_ends_the_solve(void **state) {
  (void)state;
  const char *overrides[] = {"trajectory={basis: hermite}"};
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(
      ambulo_problem_load("models/yardstick_12.yaml", overrides, 1, NULL, NULL, &problem),
      AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  int evaluations = ambulo_result_evaluations(result);
  if (evaluations > 900) print_error("%d evaluations\n", evaluations);
  assert_true(evaluations <= 900);
  assert_close(ambulo_result_audit(result)->violation.worst, 0.0, 1e-6);
  assert_close(ambulo_result_objective(result), 0.0, 1e-4);
  assert_int_equal(ambulo_result_audit(result)->at_lower_bound, 1);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* the motionless body is far from any reference: near to it is not next to nothing */
static void tracking_has_no_lower_bound_to_rest_on(void **state) {
  (void)state;
  static const char *const names[] = {"walk_tracking", "walk_normal"};
  for (int i = 0; i < 2; i++) {
    engine_fixture f;
    engine_open(&f, names[i]);
    assert_int_equal(f.engine->negligible < 0.0, i == 0);
    assert_int_equal(ambulo__evaluate(f.engine->workspace, f.engine->center), AMBULO_OK);
    assert_int_equal(ambulo__engine_at_lower_bound(f.engine), 0);
    /* every term at its bound, but for one */
    int terms = f.problem->definition.term_count;
    for (int t = 0; t < terms; t++) f.engine->workspace->term_value[t] = 0.0;
    assert_int_equal(ambulo__engine_at_lower_bound(f.engine), i == 1);
    f.engine->workspace->term_value[terms - 1] = 1.0;
    assert_int_equal(ambulo__engine_at_lower_bound(f.engine), 0);
    engine_close(&f);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(yardstick_reaches_its_optimum),
                                     cmocka_unit_test(polish_closes_what_is_left),
                                     cmocka_unit_test(tight_tolerances_are_met),
                                     cmocka_unit_test(vanishing_objective_ends_the_solve),
                                     cmocka_unit_test(tracking_has_no_lower_bound_to_rest_on)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
