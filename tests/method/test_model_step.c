/* The model step: feasible to first order, downhill, and stationary for its active set. */
#include "base/arithmetic.h"
#include "support/at_nodes.h"
#include "support/engine_fixture.h"

static void step_keeps_the_equalities_and_descends(void **state) {
  (void)state;
  engine_fixture f;
  double predicted, worst = 0.0;
  engine_open_restored(&f, "yardstick_12");
  ambulo__engine *e = f.engine;
  assert_int_equal(ambulo__model_step(e, &predicted), 0);
  assert_true(predicted < 0.0);
  ambulo__sparse_rows_multiply(&e->linearized.rows.equality, e->quadratic->total,
                               e->measured.equality);
  for (int i = 0; i < e->setup->equalities; i++) worst = fmax(worst, fabs(e->measured.equality[i]));
  ambulo__sparse_rows_multiply(&e->linearized.rows.border, e->quadratic->total, e->measured.border);
  for (int i = 0; i < e->setup->borders; i++) worst = fmax(worst, fabs(e->measured.border[i]));
  assert_close(worst, 0.0, 1e-9);
  engine_close(&f);
}

/* grad phi + J_e' l + C' m = 0 at the model's minimum */
static void multipliers_balance_the_gradient(void **state) {
  (void)state;
  engine_fixture f;
  double predicted, size = 0.0, rest = 0.0;
  engine_open_restored(&f, "yardstick_12");
  ambulo__engine *e = f.engine;
  assert_int_equal(ambulo__model_step(e, &predicted), 0);
  double *r = calloc((size_t)e->setup->n, sizeof *r);
  ambulo__band_multiply(&e->linearized.base, e->quadratic->total, r);
  for (int j = 0; j < e->setup->n; j++) {
    r[j] += e->quadratic->gradient[j];
    size = fmax(size, fabs(e->quadratic->gradient[j]));
  }
  for (int i = 0; i < e->setup->inequalities; i++)
    e->quadratic->along[i] =
        fmax(0.0, e->iterate.lambda[i] + e->iterate.rho * e->quadratic->linear[i]);
  ambulo__sparse_rows_add_transpose(&e->linearized.rows.inequality, 1.0, e->quadratic->along, r);
  ambulo__sparse_rows_add_transpose(&e->linearized.rows.equality, 1.0,
                                    e->iterate.equality_multiplier, r);
  ambulo__sparse_rows_add_transpose(&e->linearized.rows.border, 1.0, e->iterate.border_multiplier,
                                    r);
  for (int j = 0; j < e->setup->n; j++) rest = fmax(rest, fabs(r[j]));
  assert_true(rest <= 1e-6 * size);
  free(r);
  engine_close(&f);
}

static int refuse(void *user, const ambulo_progress *progress) {
  (void)user;
  (void)progress;
  return 1;
}

static void the_caller_is_asked(void **state) {
  (void)state;
  engine_fixture f;
  double predicted;
  engine_open_restored(&f, "yardstick_12");
  f.options.progress = refuse;
  f.run.polled_at -= 1e9;
  (void)ambulo__model_step(f.engine, &predicted);
  assert_true(f.run.stopped);
  assert_int_equal(f.run.ending, AMBULO_ENDING_CALLER);
  engine_close(&f);
}

/* phi of model_step.c at d, with the excesses at d = 0 */
static double phi_at(ambulo__engine *e, const double *linear, const double *d) {
  double sum = 0.0, value = 0.0;
  ambulo__band_multiply(&e->linearized.base, d, e->quadratic->step);
  for (int j = 0; j < e->setup->n; j++)
    value += d[j] * (e->quadratic->gradient[j] + 0.5 * e->quadratic->step[j]);
  ambulo__sparse_rows_multiply(&e->linearized.rows.inequality, d, e->quadratic->along);
  for (int i = 0; i < e->setup->inequalities; i++) {
    double force =
        fmax(0.0, e->iterate.lambda[i] + e->iterate.rho * (linear[i] + e->quadratic->along[i]));
    sum += force * force;
  }
  return value + sum / (2.0 * e->iterate.rho);
}

/* from soft to stiff penalties, with forces on many rows */
static void the_model_is_minimized(void **state) {
  (void)state;
  static const double penalties[] = {10.0, 1e3, 1e5, 1e7};
  for (int run = 0; run < 4; run++) {
    engine_fixture f;
    double predicted, exact, rough;
    engine_open_restored(&f, "yardstick_12");
    ambulo__engine *e = f.engine;
    for (int i = 0; i < e->setup->inequalities; i += 5) e->iterate.lambda[i] = 0.1;
    assert_int_equal(ambulo__model_step(e, &predicted), 0);
    e->iterate.rho = penalties[run];
    double *linear = calloc((size_t)e->setup->inequalities, sizeof *linear);
    double *zero = calloc((size_t)f.n, sizeof *zero), *d = calloc((size_t)f.n, sizeof *d);
    ambulo__engine_excess(e, linear);
    double start = phi_at(e, linear, zero);
    for (int roughly = 1; roughly >= 0; roughly--) {
      memcpy(e->quadratic->linear, linear, (size_t)e->setup->inequalities * sizeof *linear);
      assert_int_equal(
          ambulo__model_minimize(e, e->iterate.rho, roughly, roughly ? &rough : &exact), 0);
      for (int i = 0; i < e->setup->inequalities; i++)
        assert_true(e->quadratic->force[i] ==
                    fmax(0.0, e->iterate.lambda[i] + e->iterate.rho * e->quadratic->linear[i]));
      memcpy(d, e->quadratic->total, (size_t)f.n * sizeof *d);
      double gained = phi_at(e, linear, d) - start;
      assert_close(gained / (roughly ? rough : exact), 1.0, 1e-6);
    }
    if (!(rough <= 0.99 * exact)) print_error("rho %g: %g of %g\n", e->iterate.rho, rough, exact);
    assert_true(exact < 0.0 && rough <= 0.99 * exact);
    /* nothing is left: no tangent step of the same rows lowers phi */
    double slope = 0.0, *g = e->quadratic->right;
    ambulo__band_multiply(&e->linearized.base, d, g);
    for (int j = 0; j < f.n; j++) g[j] += e->quadratic->gradient[j];
    ambulo__sparse_rows_add_transpose(&e->linearized.rows.inequality, 1.0, e->quadratic->force, g);
    ambulo__kkt_pass(&e->linearized.kkt, memcpy(d, g, (size_t)f.n * sizeof *d), NULL, NULL);
    double *l = calloc((size_t)e->setup->equalities, sizeof *l);
    ambulo__kkt_solve(&e->linearized.kkt, g, NULL, NULL, d, l, e->iterate.border_multiplier);
    for (int j = 0; j < f.n; j++) slope += d[j] * g[j];
    if (!(slope <= 1e-6 * -exact))
      print_error("rho %g: slope %g of %g\n", e->iterate.rho, slope, exact);
    assert_true(slope <= 1e-6 * -exact);
    free(l);
    free(linear);
    free(zero);
    free(d);
    engine_close(&f);
  }
}

/* ------------------------------------------------------------ generated models */

/* other gradients, excesses, forces and penalties on the rows of a problem, with the metric I times
 * `curvature` (0: its own) */
typedef struct generated {
  engine_fixture f;
  double *linear, *own, *zero, *d, *g, *dual;
  double largest;
  unsigned seed;
} generated;

static void open_generated(generated *m, const char *name, double curvature) {
  double predicted;
  memset(m, 0, sizeof *m);
  m->seed = 7;
  engine_open_restored(&m->f, name);
  ambulo__engine *e = m->f.engine;
  assert_int_equal(ambulo__model_step(e, &predicted), 0);
  size_t n = (size_t)e->setup->n;
  m->linear = calloc((size_t)e->setup->inequalities, sizeof(double));
  m->dual = calloc((size_t)e->setup->equalities, sizeof(double));
  m->own = calloc(n, sizeof(double));
  m->zero = calloc(n, sizeof(double));
  m->d = calloc(n, sizeof(double));
  m->g = calloc(n, sizeof(double));
  memcpy(m->own, e->quadratic->gradient, n * sizeof(double));
  m->largest = ambulo__largest(m->own, n);
  if (!(curvature > 0.0)) return;
  ambulo__band_clear(&e->linearized.base);
  ambulo__band_add_diagonal(&e->linearized.base, curvature);
}

static void close_generated(generated *m) {
  free(m->linear);
  free(m->dual);
  free(m->own);
  free(m->zero);
  free(m->d);
  free(m->g);
  engine_close(&m->f);
}

/* solves the k-th; *gained: at the point returned, by phi's formula. Returns what was said. */
static double solve_generated(generated *m, int k, int roughly, double *gained) {
  ambulo__engine *e = m->f.engine;
  ambulo__quadratic *q = e->quadratic;
  double rho = pow(10.0, 1 + k % 4), spread = pow(10.0, -(k / 4) % 4), said = 0.0;
  m->seed = 100u + (unsigned)k;
  for (int i = 0; i < q->inequalities; i++) {
    m->linear[i] = spread * (random_number(&m->seed) - 0.5 * (k % 3));
    e->iterate.lambda[i] = k % 5 == 0 && i % 7 == 0 ? fabs(random_number(&m->seed)) : 0.0;
  }
  for (int j = 0; j < q->n; j++)
    q->gradient[j] = m->own[j] + (k % 2 ? 3.0 * m->largest * random_number(&m->seed) : 0.0);
  memcpy(q->linear, m->linear, (size_t)q->inequalities * sizeof(double));
  q->warm = 0;
  e->iterate.rho = rho;
  assert_int_equal(ambulo__model_minimize(e, rho, roughly, &said), 0);
  memcpy(m->d, q->total, (size_t)q->n * sizeof(double));
  *gained = phi_at(e, m->linear, m->d) - phi_at(e, m->linear, m->zero);
  for (int i = 0; i < q->inequalities; i++)
    assert_true(q->force[i] == fmax(0.0, e->iterate.lambda[i] + rho * q->linear[i]));
  return said;
}

/* what a tangent step of the same active rows would still gain */
static double left_to_gain(generated *m) {
  ambulo__engine *e = m->f.engine;
  ambulo__quadratic *q = e->quadratic;
  double slope = 0.0;
  ambulo__band_multiply(&e->linearized.base, m->d, m->g);
  for (int j = 0; j < q->n; j++) m->g[j] += q->gradient[j];
  ambulo__sparse_rows_add_transpose(&e->linearized.rows.inequality, 1.0, q->force, m->g);
  memset(m->dual, 0, (size_t)e->setup->equalities * sizeof(double));
  ambulo__kkt_solve(&e->linearized.kkt, m->g, NULL, NULL, m->d, m->dual,
                    e->iterate.border_multiplier);
  for (int j = 0; j < q->n; j++) slope += m->d[j] * m->g[j];
  return slope;
}

/* roughly, to a thousandth; exactly, to rounding */
static void generated_models_are_minimized(void **state) {
  (void)state;
  static const double curvatures[] = {0.0, 100.0};
  for (int c = 0; c < 2; c++) {
    generated m;
    open_generated(&m, "support/two_link_reach", curvatures[c]);
    for (int k = 0; k < 120; k++) {
      double gained, rough = solve_generated(&m, k, 1, &gained);
      assert_close(gained / rough, 1.0, 1e-8);
      double exact = solve_generated(&m, k, 0, &gained);
      assert_close(gained / exact, 1.0, 1e-8);
      if (rough > 0.99 * exact) print_error("model %d: %g of %g\n", k, rough, exact);
      assert_true(rough <= 0.99 * exact && rough >= exact * (1.0 + 1e-6));
      assert_true(left_to_gain(&m) <= 1e-9 * -exact);
    }
    close_generated(&m);
  }
}

/* hundreds of rows on a metric next to nothing, which fifteen steps do not settle: the best point
 * on the way is the answer, and never worse than none */
static void what_is_not_settled_is_the_best_on_the_way(void **state) {
  (void)state;
  static const double curvatures[] = {0.01, 1.0};
  double least = 0.0;
  for (int c = 0; c < 2; c++) {
    generated m;
    open_generated(&m, "yardstick_12", curvatures[c]);
    for (int k = 0; k < 60; k++) {
      double gained, rough = solve_generated(&m, k, 1, &gained);
      assert_true(rough <= 0.0);
      if (rough < 0.0) assert_close(gained / rough, 1.0, 1e-6);
      if (rough == 0.0) assert_true(gained == 0.0);
      least = fmin(least, rough);
    }
    close_generated(&m);
  }
  assert_true(least < 0.0);
}

/* a Newton step of the line search may leave the bracket: then the KKT residual, which is such a
 * model's minimum, would be a hundred thousand times as large */
static void searches_stay_in_their_bracket(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("pendulum_swing");
  ambulo_result *result = NULL;
  ambulo_options options = ambulo_problem_options(problem);
  options.algorithm = AMBULO_SLSQP; /* which comes to 1e-15 */
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
  assert_true(ambulo_result_audit(result)->kkt < 1e-8);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* active: the rows of the metric, which is L L' */
static void check_metric(const char *name, double penalty) {
  engine_fixture f;
  double predicted;
  unsigned seed = 3;
  engine_open_restored(&f, name);
  ambulo__engine *e = f.engine;
  e->iterate.rho = penalty;
  for (int i = 0; i < e->setup->inequalities; i += 5) e->iterate.lambda[i] = 0.1;
  assert_int_equal(ambulo__model_step(e, &predicted), 0);
  double *d = calloc((size_t)f.n, sizeof *d), *m = calloc((size_t)f.n, sizeof *m);
  int active = 0;
  for (int j = 0; j < f.n; j++) d[j] = random_number(&seed);
  ambulo__band_multiply(&e->linearized.base, d, m);
  ambulo__sparse_rows_multiply(&e->linearized.rows.inequality, d, e->quadratic->along);
  for (int i = 0; i < e->setup->inequalities; i++) {
    assert_int_equal(e->quadratic->active[i], e->quadratic->added[i]);
    active += e->quadratic->active[i];
    e->quadratic->along[i] *= e->quadratic->active[i] ? e->iterate.rho : 0.0;
  }
  ambulo__sparse_rows_add_transpose(&e->linearized.rows.inequality, 1.0, e->quadratic->along, m);
  ambulo__band_forward(&e->linearized.whitener, m);
  ambulo__band_backward(&e->linearized.whitener, m);
  for (int j = 0; j < f.n; j++) assert_close(m[j], d[j], 1e-6);
  assert_true(active > 0);
  assert_int_equal(e->quadratic->warm, 1);
  e->iterate.mu = -1e9;
  assert_int_equal(ambulo__model_step(e, &predicted), 1);
  assert_int_equal(e->quadratic->warm, 0);
  free(d);
  free(m);
  engine_close(&f);
}

/* with equalities and without: the factor is another's then */
static void the_metric_has_the_active_rows(void **state) {
  (void)state;
  check_metric("yardstick_12", 10.0);
  check_metric("yardstick_12", 3000.0);
  check_metric("support/walk_rigid", 10.0);
  check_metric("support/walk_rigid", 3000.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(step_keeps_the_equalities_and_descends),
      cmocka_unit_test(multipliers_balance_the_gradient),
      cmocka_unit_test(the_caller_is_asked),
      cmocka_unit_test(the_model_is_minimized),
      cmocka_unit_test(generated_models_are_minimized),
      cmocka_unit_test(what_is_not_settled_is_the_best_on_the_way),
      cmocka_unit_test(searches_stay_in_their_bracket),
      cmocka_unit_test(the_metric_has_the_active_rows),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
