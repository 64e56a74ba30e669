/* SLSQP as the finisher: rows to rounding, the same optimum, and only if it is better. */
#include "method/finisher.h"
#include "support/engine_fixture.h"

static ambulo_result *solve(const char *name, ambulo_finisher finisher, int evaluations,
                            ambulo_diagnostics *messages) {
  ambulo_problem *problem = load_problem(name);
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *result = NULL;
  options.finisher = finisher;
  if (evaluations > 0) options.maximum_evaluations = evaluations;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, messages, &result), AMBULO_OK);
  ambulo_problem_free(problem);
  return result;
}

static void rows_hold_to_rounding(void **state) {
  (void)state;
  static const char *const names[] = {"walker_2d_step", "yardstick_12"};
  for (int i = 0; i < 2; i++) {
    ambulo_result *plain = solve(names[i], AMBULO_FINISHER_NONE, 0, NULL);
    ambulo_result *finished = solve(names[i], AMBULO_FINISHER_SLSQP, 0, NULL);
    const ambulo_audit *a = ambulo_result_audit(plain), *b = ambulo_result_audit(finished);
    assert_int_equal(ambulo_result_verdict(finished), AMBULO_OPTIMAL);
    assert_true(b->violation.worst <= 1e-9);
    assert_true(b->kkt <= fmax(a->kkt, a->violation.worst * 1e3));
    assert_close(ambulo_result_objective(finished), ambulo_result_objective(plain), 1e-5);
    assert_non_null(strstr(ambulo_result_ending(finished), "then SLSQP"));
    ambulo_result_free(plain);
    ambulo_result_free(finished);
  }
}

/* the same point, whatever is asked: no evaluations are left for the finisher */
static void a_limit_keeps_the_point(void **state) {
  (void)state;
  ambulo_result *plain = solve("walker_2d_step", AMBULO_FINISHER_NONE, 40, NULL);
  ambulo_result *finished = solve("walker_2d_step", AMBULO_FINISHER_SLSQP, 40, NULL);
  assert_close(ambulo_result_objective(finished), ambulo_result_objective(plain), 0.0);
  ambulo_result_free(plain);
  ambulo_result_free(finished);
}

static void large_problems_are_left_alone(void **state) {
  (void)state;
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  ambulo_result *finished = solve("yardstick_72", AMBULO_FINISHER_SLSQP, 0, messages);
  int told = 0;
  for (size_t i = 0; i < ambulo_diagnostics_count(messages); i++)
    told |=
        strstr(ambulo_diagnostics_get(messages, i)->message, "finisher: slsqp left out") != NULL;
  assert_true(told);
  assert_int_equal(ambulo_result_verdict(finished), AMBULO_OPTIMAL);
  ambulo_result_free(finished);
  ambulo_diagnostics_free(messages);
}

/* the engine keeps its scale and its tolerances; rows to rounding, the same minimum */
static void the_engine_is_given_back(void **state) {
  (void)state;
  engine_fixture f;
  const char *message = NULL;
  engine_open(&f, "walker_2d_step");
  f.options.feasibility_tolerance = 1e-4;
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
  ambulo__engine *e = f.engine;
  double scale = e->setup->objective_scale, adjoint = e->retraction->adjoint_tolerance;
  double retraction = e->retraction->tolerance;
  assert_int_equal(ambulo__evaluate(e->workspace, f.x), AMBULO_OK);
  double before = e->workspace->objective;
  assert_int_equal(ambulo__finish(e, f.x, &message), AMBULO_OK);
  assert_non_null(message);
  assert_true(e->setup->objective_scale == scale && e->retraction->adjoint_tolerance == adjoint);
  assert_true(e->retraction->tolerance == retraction);
  assert_int_equal(ambulo__evaluate(e->workspace, f.x), AMBULO_OK);
  assert_true(ambulo__engine_equality_error(e) <= 1e-9);
  assert_true(ambulo__engine_excess(e, e->measured.excess) <= 1e-8);
  assert_close(e->workspace->objective / before, 1.0, 1e-3);
  engine_close(&f);
}

/* the run's limits are the finisher's too */
static void a_stopped_run_stops_it(void **state) {
  (void)state;
  engine_fixture f;
  const char *message = NULL;
  engine_open(&f, "walker_2d_step");
  f.options.feasibility_tolerance = 1e-4;
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
  f.options.maximum_evaluations = f.run.evaluations + 2;
  assert_int_equal(ambulo__finish(f.engine, f.x, &message), AMBULO_OK);
  assert_string_equal(message, "FORCED_STOP");
  assert_true(f.run.evaluations <= f.options.maximum_evaluations + 1);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_hold_to_rounding),         cmocka_unit_test(a_limit_keeps_the_point),
      cmocka_unit_test(large_problems_are_left_alone), cmocka_unit_test(the_engine_is_given_back),
      cmocka_unit_test(a_stopped_run_stops_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
