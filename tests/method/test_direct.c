/* Every row to NLopt: small problems, whitened and plain; an analytic one by callbacks. */
#include "method/direct.h"
#include "support/arm.h"
#include "support/engine_fixture.h"

static double solve(const char *name, ambulo_algorithm algorithm, int presolve) {
  ambulo_problem *problem = load_problem(name);
  ambulo_options options = ambulo_options_default();
  ambulo_result *result = NULL;
  options.algorithm = algorithm;
  options.presolve = presolve;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  ambulo_verdict verdict = ambulo_result_verdict(result);
  if (verdict != AMBULO_OPTIMAL)
    print_error("%s: %s, %s\n", name, ambulo_verdict_name(verdict), ambulo_result_ending(result));
  assert_int_equal(verdict, AMBULO_OPTIMAL);
  double objective = ambulo_result_objective(result);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  return objective;
}

static void every_way_finds_the_swing(void **state) {
  (void)state;
  double best = solve("pendulum_swing", AMBULO_AUTO, 1);
  assert_close(solve("pendulum_swing", AMBULO_SLSQP, 0), best, 1e-5);
  assert_close(solve("pendulum_swing", AMBULO_AUGLAG, 0), best, 1e-5);
  assert_close(solve("pendulum_swing", AMBULO_SLSQP, 1), best, 1e-5);
  assert_close(solve("pendulum_swing", AMBULO_AUGLAG, 1), best, 1e-5);
}

/* equalities as constraints of NLopt's own: the same optimum, and no point is carried to them */
static void equalities_may_be_nlopts(void **state) {
  (void)state;
  double best = solve("two_link_reach", AMBULO_AUTO, 1);
  ambulo_problem *problem = load_problem("two_link_reach");
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *result = NULL;
  options.equalities = AMBULO_EQUALITIES_NLOPT;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  assert_close(ambulo_result_objective(result), best, 1e-5);
  assert_non_null(strstr(ambulo_result_ending(result), "all rows"));
  assert_int_equal(ambulo_result_nlopt(result)->outer, 0); /* not by auglag.c */
  assert_true(ambulo_result_nlopt(result)->inner > 100);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void every_way_finds_the_reach(void **state) {
  (void)state;
  double best = solve("two_link_reach", AMBULO_AUTO, 1);
  assert_close(solve("two_link_reach", AMBULO_SLSQP, 0), best, 1e-4);
  assert_close(solve("two_link_reach", AMBULO_AUGLAG, 0), best, 1e-4);
}

/* every row handed straight to NLopt, from zero; on six intervals or as the file says */
static double step_of(const char *name, ambulo_algorithm algorithm, int six) {
  static const char *const overrides[] = {"time.intervals=6", "trajectory.intervals=6"};
  char path[300];
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  (void)snprintf(path, sizeof path, "models/%s.yaml", name);
  assert_int_equal(ambulo_problem_load(path, overrides, six ? 2 : 0, NULL, NULL, &problem),
                   AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  options.algorithm = algorithm;
  options.presolve = 0;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  double violation = ambulo_result_audit(result)->violation.worst;
  double objective = ambulo_result_objective(result);
  if (!(violation <= 1e-6)) print_error("%s: %s\n", name, ambulo_result_ending(result));
  assert_close(violation, 0.0, 1e-6);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  return objective;
}

static void every_way_finds_a_step(void **state) {
  (void)state;
  double slsqp = step_of("walker_2d_step", AMBULO_SLSQP, 1);
  double auglag = step_of("walker_2d_step", AMBULO_AUGLAG, 1);
  /* a minimum near zero; the whitened solve finds a lower one, 0.233904 */
  assert_close(slsqp / 0.270751, 1.0, 1e-3);
  assert_close(auglag / 0.233904, 1.0, 0.05); /* it ends on its way there, feasible */
}

/* ends feasible, which step_of asserts */
static void every_way_ends_a_step_as_shipped(void **state) {
  (void)state;
  (void)step_of("walker_2d_step", AMBULO_SLSQP, 0);
  (void)step_of("walker_2d_step", AMBULO_AUGLAG, 0);
  (void)step_of("yardstick_12", AMBULO_SLSQP, 1);
}

static void auglag_finds_a_gait(void **state) {
  (void)state;
  double objective = step_of("yardstick_12", AMBULO_AUGLAG, 1);
  assert_close(objective / 0.449616, 1.0, 1e-3);
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
static void analytic_problem(ambulo_algorithm algorithm, int presolve) {
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
  options.presolve = presolve;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  if (ambulo_result_verdict(result) != AMBULO_OPTIMAL)
    print_error("algorithm %d presolve %d: %s kkt %g\n", (int)algorithm, presolve,
                ambulo_result_ending(result), ambulo_result_audit(result)->kkt);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  assert_close(ambulo_result_objective(result), 0.5, 1e-5);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

static void analytic_optimum_is_found(void **state) {
  (void)state;
  analytic_problem(AMBULO_SLSQP, 0);
  analytic_problem(AMBULO_AUGLAG, 0);
  analytic_problem(AMBULO_SLSQP, 1);
  analytic_problem(AMBULO_AUGLAG, 1);
  analytic_problem(AMBULO_AUTO, 1);
}

/* one call that improves is allowed, and more would be made; what was not finite is forgiven */
static void calls_are_limited(void **state) {
  (void)state;
  static const ambulo_algorithm algorithms[] = {AMBULO_SLSQP, AMBULO_AUGLAG};
  for (int i = 0; i < 2; i++) {
    engine_fixture f;
    const char *message = "";
    engine_open(&f, "two_link_reach");
    f.options.maximum_iterations = 0;
    f.run.faults_lately = 3;
    assert_int_equal(ambulo__solve_direct(f.engine, algorithms[i], 1, NULL, f.x, &message),
                     AMBULO_OK);
    assert_int_equal(f.run.ending, AMBULO_ENDING_ITERATIONS);
    assert_int_equal(f.run.faults_lately, 0);
    /* the way to the rows is found all the same */
    assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
    assert_true(ambulo__engine_equality_error(f.engine) <= 1e-6);
    engine_close(&f);
  }
}

/* NLopt may not be given as many equalities as unknowns, nor more memory than a machine has */
static void what_nlopt_cannot_do_is_not_asked(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "two_link_reach");
  ambulo__setup setup = *f.engine->setup;
  ambulo__direct d;
  assert_int_equal(ambulo__direct_create(f.engine, 1, &d), AMBULO_OK);
  f.engine->setup = &setup;
  d.set[0] = d.set[2];
  assert_true(setup.inequalities >= setup.n);
  assert_int_equal(ambulo__direct_minimize(&d, AMBULO_SLSQP, 10), AMBULO_OK);
  assert_string_equal(d.message, "not called: as many equality rows as unknowns");
  assert_int_equal(f.run.nlopt.calls, 0);
  setup.n = 12000; /* 4 n^2 doubles are 4.6 GB */
  assert_int_equal(ambulo__direct_minimize(&d, AMBULO_SLSQP, 10), AMBULO_E_LIMIT);
  engine_close(&f);
}

/* no round: what is returned satisfies the equalities all the same; one round of many: the limit
 * ends it */
static void rounds_are_limited(void **state) {
  (void)state;
  for (int most = 0; most < 2; most++) {
    engine_fixture f;
    const char *message = "";
    engine_open(&f, "two_link_reach");
    f.options.maximum_iterations = most;
    assert_int_equal(ambulo__solve_direct(f.engine, AMBULO_SLSQP, 0, NULL, f.x, &message),
                     AMBULO_OK);
    assert_int_equal(f.run.ending, AMBULO_ENDING_ITERATIONS);
    assert_int_equal(f.run.nlopt.calls, most);
    assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
    assert_true(ambulo__engine_equality_error(f.engine) <= 1e-6);
    engine_close(&f);
  }
}

/* AUGLAG's own words, not those of the way back to the rows, which we stop */
static void the_algorithm_has_the_last_word(void **state) {
  (void)state;
  engine_fixture f;
  const char *message = "";
  engine_open(&f, "two_link_reach");
  f.options.maximum_iterations = 1;
  assert_int_equal(ambulo__solve_direct(f.engine, AMBULO_AUGLAG, 1, NULL, f.x, &message),
                   AMBULO_OK);
  assert_string_not_equal(message, "FORCED_STOP");
  assert_string_not_equal(message, "not called");
  engine_close(&f);
}

static double lost(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  const int *is_lost = user;
  (void)state;
  (void)gradient;
  return *is_lost ? (double)NAN : 0.0;
}

/* no point has a value: none is returned, and that is said */
static void without_a_value_there_is_no_descent(void **state) {
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
  assert_int_equal(ambulo__solve_direct(f.engine, AMBULO_SLSQP, 1, NULL, f.x, &message), AMBULO_OK);
  assert_int_equal(f.run.ending, AMBULO_ENDING_NO_DESCENT);
  assert_true(f.run.faults > 0 && f.x[1] == 0.25);
  engine_close(&f);
  ambulo_model_free(model);
}

/* rows that cannot hold: rounds that bring nothing end it */
static void rounds_without_progress_end(void **state) {
  (void)state;
  engine_fixture f;
  const char *message = "";
  engine_open(&f, "../tests/infeasible/torque_too_weak");
  assert_int_equal(ambulo__solve_direct(f.engine, AMBULO_SLSQP, 0, NULL, f.x, &message), AMBULO_OK);
  assert_int_equal(f.run.ending, AMBULO_ENDING_STALLED);
  assert_true(f.run.nlopt.calls < 60);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_way_finds_the_swing),
                                     cmocka_unit_test(every_way_finds_the_reach),
                                     cmocka_unit_test(equalities_may_be_nlopts),
                                     cmocka_unit_test(every_way_finds_a_step),
                                     cmocka_unit_test(every_way_ends_a_step_as_shipped),
                                     cmocka_unit_test(auglag_finds_a_gait),
                                     cmocka_unit_test(analytic_optimum_is_found),
                                     cmocka_unit_test(calls_are_limited),
                                     cmocka_unit_test(the_algorithm_has_the_last_word),
                                     cmocka_unit_test(without_a_value_there_is_no_descent),
                                     cmocka_unit_test(rounds_are_limited),
                                     cmocka_unit_test(rounds_without_progress_end),
                                     cmocka_unit_test(what_nlopt_cannot_do_is_not_asked)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
