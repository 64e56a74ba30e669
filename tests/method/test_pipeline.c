/* The method on one grid: the yardstick's optimum is met; the last steps leave no violation. */
#include "method/pipeline.h"
#include "ambulo/tools/load.h"
#include "support/arm.h"
#include "support/engine_fixture.h"
#include "support/at_nodes.h"

static double solve(double *violation, int *evaluations) {
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  double objective = f.engine->workspace->objective;
  *violation = fmax(ambulo__engine_equality_error(f.engine),
                    ambulo__engine_excess(f.engine, f.engine->measured.excess));
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
  assert_true(ambulo__engine_excess(f.engine, f.engine->measured.excess) > 1e-8);
  assert_int_equal(ambulo__polish(f.engine, 0, f.x), 1);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  assert_true(ambulo__engine_excess(f.engine, f.engine->measured.excess) <= 1e-8);
  assert_close(f.engine->workspace->objective, before, 1e-2);
  engine_close(&f);
}

/* Equalities hold to what is asked: at any tolerance the same walk, never a violation that "the
 * rows hold" leaves. */
/* a reached point that claims to cost less: then what polishing finds is another motion */
static void polish_is_not_to_cost_more(void **state) {
  (void)state;
  for (int anyhow = 0; anyhow < 2; anyhow++) {
    engine_fixture f;
    engine_open(&f, "yardstick_12");
    f.options.feasibility_tolerance = 1e-3;
    assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
    f.options.feasibility_tolerance = 1e-8;
    double predicted = 0.0;
    const ambulo__trial *reached = &f.engine->reached;
    for (int i = 0; i < f.engine->setup->inequalities; i++)
      predicted += reached->multiplier[i] * fabs(reached->excess[i]);
    f.engine->reached.objective -= 6.0 * predicted + 2e-5 * fabs(reached->objective);
    assert_int_equal(ambulo__polish(f.engine, anyhow, f.x), anyhow);
    engine_close(&f);
  }
}

static void tight_tolerances_are_met(void **state) {
  (void)state;
  static const char *const tolerances[] = {
      "solver.feasibility_tolerance=1e-9", "solver.feasibility_tolerance=1e-11",
      "solver.feasibility_tolerance=1e-13", "solver.feasibility_tolerance=1e-9"};
  for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++) {
    ambulo_problem *problem =
        load_problem_with(i < 3 ? "yardstick_12" : "support/walk_rigid", tolerances[i]);
    ambulo_result *result = NULL;
    assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
    if (verdict_at_nodes(result) != AMBULO_OPTIMAL)
      print_error("%s: %s, off by %g\n", tolerances[i],
                  ambulo_verdict_name(verdict_at_nodes(result)),
                  ambulo_result_audit(result)->violation.worst);
    assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
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
  assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* the motionless body is far from any reference: near to it is not next to nothing */
static void tracking_has_no_lower_bound_to_rest_on(void **state) {
  (void)state;
  static const char *const names[] = {"walk_tracking", "support/walk_rigid"};
  for (int i = 0; i < 2; i++) {
    engine_fixture f;
    engine_open(&f, names[i]);
    assert_int_equal(f.engine->setup->negligible < 0.0, i == 0);
    assert_int_equal(ambulo__evaluate(f.engine->workspace, f.engine->iterate.x), AMBULO_OK);
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

/* a run that is stopped as soon as the equalities hold: what the method starts with */
static void open_stopped(engine_fixture *f) {
  double error;
  engine_open(f, "yardstick_12");
  assert_int_equal(ambulo__restore(f->engine, f->x, &error), AMBULO_OK);
  f->run.stopped = 1;
  for (int i = 0; i < f->engine->setup->inequalities; i++) f->engine->iterate.lambda[i] = 0.25;
  for (int i = 0; i < f->engine->setup->equalities; i++)
    f->engine->iterate.equality_multiplier[i] = 0.5;
  f->engine->reached.value = 1.0;
}

static void each_start_has_its_penalty_and_damping(void **state) {
  (void)state;
  static const struct {
    ambulo__stage stage;
    double carried, rho, mu, lambda; /* carried: times the objective there; < 0: nothing is */
  } cases[] = {
      {AMBULO__FAR, -1.0, 10.0, 0.3, 0.0},
      {AMBULO__NEAR, -1.0, 3000.0, 0.3, 0.0},
      {AMBULO__FAR, 0.51, 160.0, 0.075, 0.25}, /* the coarser grid had resolved it */
      {AMBULO__FAR, 0.49, 10.0, 0.3, 0.0},
      {AMBULO__BESIDE, 1.0 / 1.0008, 80.0 * 2.8117066, 0.075, 0.25}, /* (.05 / 8e-4)^(1/4) */
      {AMBULO__BESIDE, 0.1, 80.0, 0.075, 0.25},
      {AMBULO__BESIDE, 1.0, 640.0, 0.075, 0.25},
  };
  for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
    engine_fixture f;
    open_stopped(&f);
    ambulo__engine *e = f.engine;
    assert_int_equal(ambulo__evaluate(e->workspace, f.x), AMBULO_OK);
    e->iterate.carried_objective =
        cases[c].carried < 0 ? -1.0 : cases[c].carried * e->workspace->objective;
    assert_int_equal(ambulo__pipeline(e, cases[c].stage, f.x), AMBULO_OK);
    double interval = f.problem->definition.duration / ambulo__basis_intervals(f.problem->basis);
    assert_close(e->iterate.rho / cases[c].rho, 1.0, 1e-6);
    assert_close(e->iterate.mu / interval, cases[c].mu, 1e-12);
    const ambulo__row_roles *rows = e->setup->rows;
    double lambda = e->iterate.lambda[3] / rows->size[3] * rows->unit[3]; /* before balancing */
    assert_close(lambda, cases[c].lambda, 1e-15);
    assert_true(e->iterate.equality_multiplier[0] == 0.0);
    assert_true(e->iterate.carried_objective == -1.0 && e->reached.value == HUGE_VAL);
    engine_close(&f);
  }
}

static void a_start_that_leads_nowhere_is_told(void **state) {
  (void)state;
  for (int run = 0; run < 2; run++) {
    engine_fixture f;
    engine_open(&f, "yardstick_12");
    f.x[3] = run ? NAN : 0.0;
    f.options.maximum_evaluations = 0; /* restoring stops at once */
    if (run) f.options.maximum_evaluations = 1000;
    ambulo_status status = ambulo__pipeline(f.engine, AMBULO__FAR, f.x);
    assert_int_equal(status, run ? AMBULO_E_NUMERIC : AMBULO_OK);
    if (run) assert_int_equal(f.run.ending, AMBULO_ENDING_NOT_FINITE);
    assert_true(f.engine->reached.value == HUGE_VAL);
    assert_true(f.engine->iterate.rho == 10.0 && f.run.nlopt.calls == 0);
    engine_close(&f);
  }
}

static double too_far(void *user, const ambulo_node_state *s, ambulo_node_gradient *g) {
  (void)user;
  if (g) g->points[0] += 1.0;
  return s->points[0] - 0.6; /* of an arm of 0.55 m */
}

/* equations that no motion satisfies are where it ends: nothing is minimized beside them */
static void what_cannot_be_restored_is_told(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  ambulo_user_row row = {"own", "m", AMBULO_EQUAL, 0.5, 0.5, too_far, NULL};
  engine_fixture f = {.options = ambulo_options_default()};
  d.user_rows = &row;
  d.user_row_count = 1;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &f.problem), AMBULO_OK);
  f.x = calloc((size_t)f.problem->variables, sizeof *f.x);
  ambulo__run_begin(&f.run, &f.options);
  assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine), AMBULO_OK);
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
  assert_int_equal(f.run.ending, AMBULO_ENDING_NOT_RESTORED);
  assert_int_equal(f.run.nlopt.calls, 0);
  engine_close(&f);
  ambulo_model_free(model);
}

/* twice the body's weight on a back, and torques with limits: models that full steps do not solve,
 * nor searches from where those have led */
static void heavy_loads_are_solved(void **state) {
  (void)state;
  const char *overrides[] = {"load.mass=150", "constraints.torque_limits=true"};
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(
      ambulo_problem_load("models/walk_loaded.yaml", overrides, 2, NULL, NULL, &problem),
      AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* by the caller's limit on iterations, or on evaluations: the rows hold where they nearly did */
static void what_is_cut_short_is_polished(void **state) {
  (void)state;
  for (int run = 0; run < 2; run++) {
    int polished = 0;
    for (int limit = 4; limit < 8; limit++) {
      engine_fixture f;
      engine_open(&f, "yardstick_12");
      if (run == 0) f.options.maximum_iterations = limit;
      if (run == 1) f.options.maximum_evaluations = 10 * limit;
      assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
      double before = f.engine->reached.violation;
      assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
      double after = ambulo__engine_excess(f.engine, f.engine->measured.excess);
      if (f.engine->reached.value < HUGE_VAL && before > 1e-4 && before < 1e-2) {
        assert_true(after <= 1e-6);
        polished++;
      }
      engine_close(&f);
    }
    if (polished == 0) print_error("run %d: no point between\n", run);
    assert_true(polished > 0);
  }
}

/* the engine is left as it was, but for lambda; a point that cannot be had stays */
static void polish_gives_back_what_it_takes(void **state) {
  (void)state;
  for (int run = 0; run < 2; run++) {
    engine_fixture f;
    engine_open(&f, "yardstick_12");
    f.options.feasibility_tolerance = 1e-3;
    assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
    ambulo__engine *e = f.engine;
    double *x = calloc((size_t)f.n, sizeof *x), rho = e->iterate.rho, moved = 0.0;
    assert_true(rho < 1e5);
    memcpy(x, f.x, (size_t)f.n * sizeof *x);
    for (int i = 0; i < e->setup->equalities; i++) e->iterate.equality_multiplier[i] = 1e3;
    for (int i = 0; i < e->setup->inequalities; i++) e->iterate.lambda[i] = 1e3;
    f.options.feasibility_tolerance = run ? 1e-30 : 1e-8;
    assert_int_equal(ambulo__polish(e, 0, f.x), !run);
    assert_true(e->iterate.rho == rho);
    for (int i = 0; i < e->setup->equalities; i++)
      assert_true(e->iterate.equality_multiplier[i] == e->reached.equality_multiplier[i]);
    for (int j = 0; j < f.n; j++) moved = fmax(moved, fabs(f.x[j] - x[j]));
    assert_int_equal(moved > 0.0, !run);
    if (!run) {
      for (int i = 0; i < e->setup->inequalities; i++)
        assert_true(e->iterate.lambda[i] == e->reached.multiplier[i]);
      assert_int_equal(ambulo__evaluate(e->workspace, f.x), AMBULO_OK);
      /* rows with a force from both sides */
      assert_true(ambulo__engine_excess(e, e->measured.excess) <= 1e-8);
      for (int i = 0; i < e->setup->inequalities; i++) {
        if (e->reached.multiplier[i] > 0.1) assert_close(e->measured.excess[i], 0.0, 1e-6);
      }
    }
    free(x);
    engine_close(&f);
  }
}

/* ---------------------------------------------------------------- balanced rows */

static double length_in_units(const engine_fixture *f, int i) {
  const ambulo__linearized *at = &f->engine->linearized;
  return ambulo__band_row_length(&at->base, &at->rows.inequality, i) * at->rows.size[i] /
         at->rows.unit[i];
}

/* v = -c / (s max(1, sqrt l)), near a solution -c / (s max(.3, sqrt l)) */
static void check_sizes(ambulo__stage stage, double shortest) {
  engine_fixture f;
  int weaker = 0, short_ones = 0;
  engine_open_restored(&f, "walk_normal");
  ambulo__balance_rows(f.engine, AMBULO__BESIDE, f.x); /* sizes do not pile up */
  ambulo__balance_rows(f.engine, stage, f.x);
  for (int i = 0; i < f.engine->setup->inequalities; i++) {
    const ambulo__row_roles *rows = f.engine->setup->rows;
    double length = length_in_units(&f, i);
    double divided = rows->size[i] / rows->unit[i];
    if (fabs(length - 1.0) < 1e-9 || length == 0.0) continue;
    assert_close(divided / fmax(shortest, sqrt(length)), 1.0, 1e-12);
    assert_close(rows->inequality.scale[i] * rows->size[i], -1.0, 1e-15);
    weaker += length > 2.0;
    short_ones += length < 0.5;
  }
  assert_true(weaker > 100 && short_ones > 100);
  engine_close(&f);
}

static void rows_are_balanced(void **state) {
  (void)state;
  check_sizes(AMBULO__FAR, 1.0);
  check_sizes(AMBULO__NEAR, 0.3);
  check_sizes(AMBULO__BESIDE, 0.3);
}

/* forces lambda / size stay as they are, and a violation is in the rows' units as before */
static void forces_and_violations_stay(void **state) {
  (void)state;
  engine_fixture f;
  engine_open_restored(&f, "walk_normal");
  ambulo__engine *e = f.engine;
  int m = e->setup->inequalities;
  double *force = calloc((size_t)m, sizeof *force);
  for (int i = 0; i < m; i++) {
    e->iterate.lambda[i] = 1.0 + 0.01 * (i % 7);
    force[i] = e->iterate.lambda[i] / e->setup->rows->size[i];
  }
  assert_int_equal(ambulo__evaluate(e->workspace, f.x), AMBULO_OK);
  double before = ambulo__engine_excess(e, e->measured.excess);
  ambulo__balance_rows(e, AMBULO__FAR, f.x);
  double after = ambulo__engine_excess(e, e->measured.excess);
  assert_true(before > 0.0);
  assert_close(after / before, 1.0, 1e-12);
  for (int i = 0; i < m; i++)
    assert_close(e->iterate.lambda[i] / e->setup->rows->size[i] / force[i], 1.0, 1e-12);
  free(force);
  engine_close(&f);
}

/* a torque that is not a number: whoever comes next will say so */
static void what_is_not_finite_changes_nothing(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "walk_normal");
  int m = f.engine->setup->inequalities;
  for (int j = 0; j < f.n; j++) f.x[j] = (double)NAN;
  ambulo__balance_rows(f.engine, AMBULO__FAR, f.x);
  for (int i = 0; i < m; i++)
    assert_true(f.engine->setup->rows->size[i] == f.engine->setup->rows->unit[i]);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(yardstick_reaches_its_optimum),
                                     cmocka_unit_test(polish_closes_what_is_left),
                                     cmocka_unit_test(polish_is_not_to_cost_more),
                                     cmocka_unit_test(tight_tolerances_are_met),
                                     cmocka_unit_test(vanishing_objective_ends_the_solve),
                                     cmocka_unit_test(tracking_has_no_lower_bound_to_rest_on),
                                     cmocka_unit_test(each_start_has_its_penalty_and_damping),
                                     cmocka_unit_test(a_start_that_leads_nowhere_is_told),
                                     cmocka_unit_test(what_cannot_be_restored_is_told),
                                     cmocka_unit_test(heavy_loads_are_solved),
                                     cmocka_unit_test(what_is_cut_short_is_polished),
                                     cmocka_unit_test(polish_gives_back_what_it_takes),
                                     cmocka_unit_test(rows_are_balanced),
                                     cmocka_unit_test(forces_and_violations_stay),
                                     cmocka_unit_test(what_is_not_finite_changes_nothing)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
