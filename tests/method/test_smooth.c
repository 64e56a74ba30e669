/* Starts of the caller: valid ones are not made worse, rough ones are smoothed, and where one leads
 * nowhere the solver tries its own. */
#include "method/pipeline.h"
#include "support/at_nodes.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"

typedef struct started {
  ambulo_problem *problem;
  double *optimum, *x;
  double objective;
  int n, d, points;
} started;

static void open_started(started *s, const char *name) {
  ambulo_result *result = NULL;
  s->problem = load_problem(name);
  s->n = ambulo_problem_variable_count(s->problem);
  s->d = ambulo_model_coordinate_count(ambulo_problem_model(s->problem));
  s->points = s->n / s->d;
  s->optimum = calloc((size_t)s->n, sizeof *s->x);
  s->x = calloc((size_t)s->n, sizeof *s->x);
  assert_int_equal(ambulo_solve(s->problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
  s->objective = ambulo_result_objective(result);
  memcpy(s->optimum, ambulo_result_x(result), (size_t)s->n * sizeof *s->x);
  memcpy(s->x, s->optimum, (size_t)s->n * sizeof *s->x);
  ambulo_result_free(result);
}

static void close_started(started *s) {
  free(s->optimum);
  free(s->x);
  ambulo_problem_free(s->problem);
}

static void add_noise(started *s, double size, unsigned seed) {
  for (int j = 0; j < s->n; j++) s->x[j] = s->optimum[j] + size * random_number(&seed);
}

static ambulo_result *solve_from(const started *s, const ambulo_options *options) {
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(s->problem, options, s->x, NULL, NULL, &result), AMBULO_OK);
  return result;
}

static void expect_optimal(const started *s, double most, const char *what) {
  ambulo_result *result = solve_from(s, NULL);
  ambulo_verdict verdict = verdict_at_nodes(result);
  double objective = ambulo_result_objective(result);
  if (verdict != AMBULO_OPTIMAL || !(objective <= most))
    print_error("%s: %s, %.8g of %.8g, %s\n", what, ambulo_verdict_name(verdict), objective,
                s->objective, ambulo_result_ending(result));
  assert_int_equal(verdict, AMBULO_OPTIMAL);
  assert_true(objective <= most);
  assert_null(ambulo_result_explanation(result));
  ambulo_result_free(result);
}

/* a hundredth of a radian from one control point to the next: tens of thousands of times the cost
 */
static void noise_is_smoothed_away(void **state) {
  (void)state;
  static const char *const names[] = {"support/walk_rigid", "support/walk_rigid"};
  for (size_t i = 0; i < 2; i++) {
    started s;
    open_started(&s, names[i]);
    for (unsigned seed = 1; seed <= 4; seed++) {
      add_noise(&s, 0.01, seed);
      expect_optimal(&s, 1.001 * s.objective, names[i]);
    }
    close_started(&s);
  }
}

/* a straight line over the index of the control points is bent in time at both ends */
static void lines_over_the_index_are_no_conflict(void **state) {
  (void)state;
  started s;
  open_started(&s, "support/walk_rigid");
  for (int j = 0; j < s.n; j++) {
    int point = j / s.d, i = j % s.d;
    double share = (double)point / (double)(s.points - 1);
    s.x[j] = (1.0 - share) * s.optimum[i] + share * s.optimum[s.n - s.d + i];
  }
  expect_optimal(&s, 1.001 * s.objective, "straight lines");
  memcpy(s.x, s.optimum, (size_t)s.n * sizeof *s.x);
  for (int point = 0; point < s.points; point++) /* one coordinate alone: the way ahead */
    s.x[point * s.d] = 0.68 * (double)point / (double)(s.points - 1) - 0.1;
  expect_optimal(&s, 1.001 * s.objective, "one straight line");
  close_started(&s);
}

/* a finer grid, filled by repeating control points: knees in every curve */
static void starts_from_another_grid(void **state) {
  (void)state;
  started coarse, fine;
  open_started(&coarse, "yardstick_12");
  open_started(&fine, "yardstick_36");
  for (int point = 0; point < fine.points; point++) {
    int from = point * (coarse.points - 1) / (fine.points - 1);
    memcpy(fine.x + point * fine.d, coarse.optimum + from * coarse.d,
           (size_t)fine.d * sizeof *fine.x);
  }
  /* one of the local optima: 1.0200, 1.0590, 1.1370 */
  expect_optimal(&fine, 1.001 * 1.1370, "steps");
  close_started(&coarse);
  close_started(&fine);
}

/* valid points beside the optimum, found with no objective: the solve goes down from them */
static void valid_starts_are_not_made_worse(void **state) {
  (void)state;
  started s;
  ambulo_problem *rows = load_problem_with("yardstick_36", "objective=none");
  open_started(&s, "yardstick_36");
  for (unsigned seed = 1; seed <= 4; seed++) {
    ambulo_result *valid = NULL, *audited = NULL;
    unsigned numbers = seed;
    for (int i = 0; i < s.d; i++) {
      double a = random_number(&numbers), b = random_number(&numbers);
      for (int point = 0; point < s.points; point++) {
        double phase = 6.28 * (double)point / (double)(s.points - 1);
        s.x[point * s.d + i] =
            s.optimum[point * s.d + i] + 0.003 * (a * sin(phase) + b * cos(phase));
      }
    }
    assert_int_equal(ambulo_solve(rows, NULL, s.x, NULL, NULL, &valid), AMBULO_OK);
    assert_true(ambulo_verdict_is_solution(verdict_at_nodes(valid)));
    memcpy(s.x, ambulo_result_x(valid), (size_t)s.n * sizeof *s.x);
    assert_int_equal(ambulo_audit_point(s.problem, NULL, s.x, NULL, NULL, &audited), AMBULO_OK);
    double before = ambulo_result_objective(audited);
    assert_true(before > 1.01 * s.objective);
    expect_optimal(&s, 1.001 * s.objective, "a valid start");
    ambulo_result_free(valid);
    ambulo_result_free(audited);
  }
  ambulo_problem_free(rows);
  close_started(&s);
}

/* also when there is no time to find anything better, and by every method */
static void the_start_is_returned_at_least(void **state) {
  (void)state;
  static const char *const names[] = {"support/two_link_reach", "support/walker_2d_step"};
  for (size_t i = 0; i < 2; i++) {
    started s;
    open_started(&s, names[i]);
    for (int slsqp = 0; slsqp < 2; slsqp++) {
      for (int evaluations = 1; evaluations < 100; evaluations += 9) {
        ambulo_options options = ambulo_problem_options(s.problem);
        options.algorithm = slsqp ? AMBULO_SLSQP : AMBULO_AUGLAG;
        options.maximum_evaluations = evaluations;
        ambulo_result *result = solve_from(&s, &options);
        assert_true(ambulo_verdict_is_solution(verdict_at_nodes(result)));
        assert_true(ambulo_result_objective(result) <= s.objective * (1.0 + 2e-6));
        ambulo_result_free(result);
      }
    }
    close_started(&s);
  }
}

/* cut short where the rows are violated: the valid start, here the optimum, is returned, and it is
 * said */
static void what_is_worse_than_the_start_is_said(void **state) {
  (void)state;
  started s;
  int said = 0;
  open_started(&s, "support/walker_2d_step");
  for (int evaluations = 3; evaluations < 40; evaluations += 3) {
    ambulo_options options = ambulo_problem_options(s.problem);
    options.maximum_evaluations = evaluations;
    ambulo_result *result = solve_from(&s, &options);
    assert_true(ambulo_verdict_is_solution(verdict_at_nodes(result)));
    assert_true(ambulo_result_objective(result) <= s.objective * (1.0 + 2e-6));
    said += strstr(ambulo_result_ending(result), "worse than the given start") != NULL;
    ambulo_result_free(result);
  }
  assert_true(said > 0);
  close_started(&s);
}

/* a start from which no solution is found: the solver's own is tried, and it is said */
static void the_solver_tries_its_own_start(void **state) {
  (void)state;
  started s;
  open_started(&s, "support/walk_rigid");
  unsigned seed = 5;
  for (int j = 0; j < s.n; j++) s.x[j] = 40.0 * random_number(&seed); /* limbs turning wildly */
  ambulo_result *result = solve_from(&s, NULL);
  if (verdict_at_nodes(result) != AMBULO_OPTIMAL)
    print_error("%s: %s\n", ambulo_verdict_name(verdict_at_nodes(result)),
                ambulo_result_ending(result));
  assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
  assert_close(ambulo_result_objective(result) / s.objective, 1.0, 2e-3);
  assert_non_null(strstr(ambulo_result_ending(result), "from zero"));
  ambulo_result_free(result);
  close_started(&s);
}

/* an optimum is neither rough nor smoothed */
static void optima_stay(void **state) {
  (void)state;
  static const char *const names[] = {"support/walk_rigid", "support/walk_rigid", "yardstick_36",
                                      "support/walker_2d_step"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    started s;
    engine_fixture f;
    open_started(&s, names[i]);
    engine_open(&f, names[i]);
    int rough = -1;
    assert_int_equal(ambulo__smooth_start(f.engine, s.x, &rough), AMBULO_OK);
    assert_int_equal(rough, 0);
    assert_memory_equal(s.x, s.optimum, (size_t)s.n * sizeof *s.x);
    add_noise(&s, 0.02, 3);
    assert_int_equal(ambulo__smooth_start(f.engine, s.x, &rough), AMBULO_OK);
    if (i < 2) assert_int_equal(rough, 1);
    engine_close(&f);
    close_started(&s);
  }
}

/* a slow wave passes the filter, a fast one does not: halved at sqrt(a/s) = 38.7 rad/s = 6.2 Hz */
static void the_filter_has_its_cut_off(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_72");
  int d = f.problem->coordinates, points = f.n / d;
  double duration = f.problem->definition.duration;
  static const double hertz[] = {1.9, 12.0}, least[] = {0.9, 0.0}, most[] = {1.01, 0.25};
  for (int k = 0; k < 2; k++) {
    double before = 0.0, after = 0.0;
    double *x = calloc((size_t)f.n, sizeof *x);
    for (int j = 0; j < f.n; j++)
      x[j] = j % d == 3 ? 0.1 * sin(6.28 * hertz[k] * duration * (j / d) / (points - 1)) : 0.0;
    for (int j = 10 * d; j < f.n - 10 * d; j++) before += x[j] * x[j];
    assert_int_equal(ambulo__smooth_curve(f.engine, x, x), 0);
    for (int j = 10 * d; j < f.n - 10 * d; j++) after += x[j] * x[j];
    double gain = sqrt(after / before);
    if (!(gain >= least[k] && gain <= most[k])) print_error("%g Hz: gain %g\n", hertz[k], gain);
    assert_true(gain >= least[k] && gain <= most[k]);
    free(x);
  }
  engine_close(&f);
}

/* unknowns that are rates may move by s sqrt(a / s) = 0.77 rad/s, values by 0.02 rad */
static void rates_have_their_own_size(void **state) {
  (void)state;
  engine_fixture f;
  engine_open_with(&f, "support/two_link_reach", "trajectory={basis: hermite}");
  double *smooth = calloc((size_t)f.n, sizeof *smooth), *back = calloc((size_t)f.n, sizeof *back);
  double *weight = calloc((size_t)f.n, sizeof *weight);
  ambulo__band *base = &f.engine->linearized.base;
  const ambulo_problem *p = f.problem;
  unsigned seed = 3;
  double time = p->definition.duration / ambulo__basis_intervals(p->basis);
  int rates = 0;
  for (int j = 0; j < f.n; j++) f.x[j] = random_number(&seed);
  assert_int_equal(ambulo__smooth_curve(f.engine, f.x, smooth), AMBULO_OK);
  ambulo__metric_accelerations(&f.engine->linearized.metric, f.engine->workspace, 1.0 / 900.0,
                               base);
  for (int j = 0; j < f.n; j++) {
    int is_value = 1;
    (void)ambulo__basis_abscissa(p->basis, j / p->coordinates, &is_value);
    double size = is_value ? 0.02 : 0.02 * sqrt(30.0 / 0.02);
    weight[j] = time / (size * size);
    base->a[(size_t)j * (size_t)base->ld] += weight[j];
    rates += !is_value;
  }
  assert_int_equal(rates, f.n / 2);
  ambulo__band_multiply(base, smooth, back); /* to what the rough curve was weighed with */
  for (int j = 0; j < f.n; j++) assert_close(back[j], weight[j] * f.x[j], 1e-9 * weight[j]);
  free(smooth);
  free(back);
  free(weight);
  engine_close(&f);
}

/* a start that cannot be weighed without memory does not stay */
static void memory_that_is_out_is_told(void **state) {
  (void)state;
  started s;
  open_started(&s, "support/two_link_reach");
  for (long k = 0; k < 100; k++) {
    engine_fixture f = {.options = ambulo_options_default()};
    fail_alloc memory = fail_alloc_at(-1);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    int smoothed = 0;
    ambulo__run_begin(&f.run, &f.options);
    assert_int_equal(ambulo__engine_create(s.problem, s.x, &hook, &f.run, NULL, &f.engine),
                     AMBULO_OK);
    memory.fail_at = memory.requests + k;
    ambulo_status status = ambulo__smooth_start(f.engine, s.x, &smoothed);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__engine_free(f.engine);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) {
      assert_true(k > 3);
      break;
    }
  }
  close_started(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(noise_is_smoothed_away),
                                     cmocka_unit_test(memory_that_is_out_is_told),
                                     cmocka_unit_test(lines_over_the_index_are_no_conflict),
                                     cmocka_unit_test(starts_from_another_grid),
                                     cmocka_unit_test(valid_starts_are_not_made_worse),
                                     cmocka_unit_test(the_start_is_returned_at_least),
                                     cmocka_unit_test(what_is_worse_than_the_start_is_said),
                                     cmocka_unit_test(the_solver_tries_its_own_start),
                                     cmocka_unit_test(optima_stay),
                                     cmocka_unit_test(the_filter_has_its_cut_off),
                                     cmocka_unit_test(rates_have_their_own_size)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
