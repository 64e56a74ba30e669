/* NLopt's SLSQP on every row: small problems; an analytic one by callbacks. */
#include "method/slsqp.h"
#include "support/arm.h"
#include "support/engine_fixture.h"
#include "support/at_nodes.h"

static double solve(const char *name, ambulo_algorithm algorithm) {
  ambulo_problem *problem = load_problem(name);
  ambulo_options options = ambulo_options_default();
  ambulo_result *result = NULL;
  options.algorithm = algorithm;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  ambulo_verdict verdict = verdict_at_nodes(result);
  if (verdict != AMBULO_OPTIMAL)
    print_error("%s: %s, %s\n", name, ambulo_verdict_name(verdict), ambulo_result_ending(result));
  assert_int_equal(verdict, AMBULO_OPTIMAL);
  double objective = ambulo_result_objective(result);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  return objective;
}

static void both_find_small_motions(void **state) {
  (void)state;
  static const char *const names[] = {"pendulum_swing", "support/two_link_reach",
                                      "support/walker_2d_step"};
  for (int i = 0; i < 3; i++)
    assert_close(solve(names[i], AMBULO_SLSQP) / solve(names[i], AMBULO_AUGLAG), 1.0, 1e-6);
}

/* (q0 - 2)^2 + (q1 + 1)^2 at every node */
static double bowl(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  (void)user;
  double a = state->q[0] - 2.0, b = state->q[1] + 1.0;
  if (gradient) {
    gradient->q[0] += 2.0 * a;
    gradient->q[1] += 2.0 * b;
  }
  return a * a + b * b;
}

/* q0 + q1 <= 0 */
static double half_plane(void *user, const ambulo_node_state *state,
                         ambulo_node_gradient *gradient) {
  (void)user;
  if (gradient) {
    gradient->q[0] -= 1.0;
    gradient->q[1] -= 1.0;
  }
  return -state->q[0] - state->q[1];
}

/* nearest point of the half plane to (2, -1): (1.5, -1.5), distance squared 0.5, one second */
static void analytic_problem(ambulo_algorithm algorithm) {
  ambulo_model *model = arm_create();
  ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
  ambulo_user_row row = {"half_plane", "rad", AMBULO_NOT_NEGATIVE, 0.0, 1.0, half_plane, NULL};
  ambulo_problem_definition definition = ambulo_problem_definition_default();
  term.name = "bowl";
  term.function = bowl;
  definition.model = model;
  definition.intervals = 4;
  definition.terms = &term;
  definition.term_count = 1;
  definition.user_rows = &row;
  definition.user_row_count = 1;
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_options options = ambulo_options_default();
  options.algorithm = algorithm;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  if (verdict_at_nodes(result) != AMBULO_OPTIMAL)
    print_error("algorithm %d: %s kkt %g\n", (int)algorithm, ambulo_result_ending(result),
                ambulo_result_audit(result)->kkt);
  assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
  assert_close(ambulo_result_objective(result), 0.5, 1e-5);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

static void analytic_optimum_is_found(void **state) {
  (void)state;
  analytic_problem(AMBULO_SLSQP);
  analytic_problem(AMBULO_AUGLAG);
}

/* NLopt may not be given as many equalities as unknowns, nor more memory than a machine has */
static void what_nlopt_cannot_do_is_not_asked(void **state) {
  (void)state;
  engine_fixture f;
  const char *message = "";
  engine_open(&f, "support/two_link_reach");
  ambulo__setup setup = *f.engine->setup;
  f.engine->setup = &setup;
  setup.equalities = setup.n;
  assert_int_equal(ambulo__solve_slsqp(f.engine, NULL, f.x, &message), AMBULO_OK);
  assert_string_equal(message, "not called: as many equality rows as unknowns");
  assert_int_equal(f.run.nlopt.calls, 0);
  assert_int_equal(f.run.ending, AMBULO_ENDING_NO_DESCENT);
  setup.n = 12000; /* 4 n^2 doubles are 4.6 GB */
  assert_int_equal(ambulo__solve_slsqp(f.engine, NULL, f.x, &message), AMBULO_E_LIMIT);
  engine_close(&f);
}

/* no round: what is returned satisfies the equalities all the same; one round of many: the limit
 * ends it */
static void rounds_are_limited(void **state) {
  (void)state;
  for (int most = 0; most < 2; most++) {
    engine_fixture f;
    const char *message = "";
    engine_open(&f, "support/two_link_reach");
    f.options.maximum_iterations = most;
    assert_int_equal(ambulo__solve_slsqp(f.engine, NULL, f.x, &message), AMBULO_OK);
    assert_int_equal(f.run.ending, AMBULO_ENDING_ITERATIONS);
    assert_int_equal(f.run.nlopt.calls, most);
    assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
    assert_true(ambulo__engine_equality_error(f.engine) <= 1e-6);
    engine_close(&f);
  }
}

static double lost(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  const int *is_lost = user;
  (void)state;
  (void)gradient;
  return *is_lost ? (double)NAN : 0.0;
}

/* no point has a value: none is returned, and that is said */
static void without_a_value_there_is_nothing_to_descend(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
  int is_lost = 0;
  engine_fixture f = {.options = ambulo_options_default()};
  const char *message = "";
  term.function = lost;
  term.user = &is_lost;
  d.terms = &term;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &f.problem), AMBULO_OK);
  f.x = calloc((size_t)f.problem->variables, sizeof *f.x);
  f.x[1] = 0.25;
  ambulo__run_begin(&f.run, &f.options);
  assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine), AMBULO_OK);
  is_lost = 1;
  assert_int_equal(ambulo__solve_slsqp(f.engine, NULL, f.x, &message), AMBULO_E_NUMERIC);
  assert_int_equal(f.run.ending, AMBULO_ENDING_NOT_FINITE);
  assert_true(f.x[1] == 0.25);
  engine_close(&f);
  ambulo_model_free(model);
}

/* rows that cannot hold: rounds that bring nothing end it */
static void rounds_without_progress_end(void **state) {
  (void)state;
  engine_fixture f;
  const char *message = "";
  engine_open(&f, "../tests/infeasible/torque_too_weak");
  assert_int_equal(ambulo__solve_slsqp(f.engine, NULL, f.x, &message), AMBULO_OK);
  assert_int_equal(f.run.ending, AMBULO_ENDING_STALLED);
  assert_true(f.run.nlopt.calls < 60);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(both_find_small_motions),
      cmocka_unit_test(analytic_optimum_is_found),
      cmocka_unit_test(what_nlopt_cannot_do_is_not_asked),
      cmocka_unit_test(rounds_are_limited),
      cmocka_unit_test(without_a_value_there_is_nothing_to_descend),
      cmocka_unit_test(rounds_without_progress_end),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
