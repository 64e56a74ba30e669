/* The model step: feasible to first order, downhill, and stationary for its active set. */
#include "support/engine_fixture.h"

static void step_keeps_the_equalities_and_descends(void **state) {
  (void)state;
  engine_fixture f;
  double predicted, worst = 0.0;
  engine_open_restored(&f, "yardstick_12");
  ambulo__engine *e = f.engine;
  assert_int_equal(ambulo__model_step(e, &predicted), 0);
  assert_true(predicted < 0.0);
  ambulo__sparse_rows_multiply(&e->rows.equality, e->total, e->h);
  for (int i = 0; i < e->equalities; i++) worst = fmax(worst, fabs(e->h[i]));
  ambulo__sparse_rows_multiply(&e->rows.border, e->total, e->b);
  for (int i = 0; i < e->borders; i++) worst = fmax(worst, fabs(e->b[i]));
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
  double *r = calloc((size_t)e->n, sizeof *r);
  ambulo__band_multiply(&e->base, e->total, r);
  for (int j = 0; j < e->n; j++) {
    r[j] += e->gradient[j];
    size = fmax(size, fabs(e->gradient[j]));
  }
  for (int i = 0; i < e->inequalities; i++)
    e->along[i] = fmax(0.0, e->lambda[i] + e->rho * e->linear[i]);
  ambulo__sparse_rows_add_transpose(&e->rows.inequality, 1.0, e->along, r);
  ambulo__sparse_rows_add_transpose(&e->rows.equality, 1.0, e->equality_multiplier, r);
  ambulo__sparse_rows_add_transpose(&e->rows.border, 1.0, e->border_multiplier, r);
  for (int j = 0; j < e->n; j++) rest = fmax(rest, fabs(r[j]));
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
  ambulo__band_multiply(&e->base, d, e->step);
  for (int j = 0; j < e->n; j++) value += d[j] * (e->gradient[j] + 0.5 * e->step[j]);
  ambulo__sparse_rows_multiply(&e->rows.inequality, d, e->along);
  for (int i = 0; i < e->inequalities; i++) {
    double force = fmax(0.0, e->lambda[i] + e->rho * (linear[i] + e->along[i]));
    sum += force * force;
  }
  return value + sum / (2.0 * e->rho);
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
    for (int i = 0; i < e->inequalities; i += 5) e->lambda[i] = 0.1;
    assert_int_equal(ambulo__model_step(e, &predicted), 0);
    e->rho = penalties[run];
    double *linear = calloc((size_t)e->inequalities, sizeof *linear);
    double *zero = calloc((size_t)f.n, sizeof *zero), *d = calloc((size_t)f.n, sizeof *d);
    ambulo__engine_excess(e, linear);
    double start = phi_at(e, linear, zero);
    for (int roughly = 1; roughly >= 0; roughly--) {
      memcpy(e->linear, linear, (size_t)e->inequalities * sizeof *linear);
      assert_int_equal(ambulo__model_minimize(e, roughly, roughly ? &rough : &exact), 0);
      for (int i = 0; i < e->inequalities; i++)
        assert_true(e->held.multiplier[i] == fmax(0.0, e->lambda[i] + e->rho * e->linear[i]));
      memcpy(d, e->total, (size_t)f.n * sizeof *d);
      double gained = phi_at(e, linear, d) - start;
      assert_close(gained / (roughly ? rough : exact), 1.0, 1e-6);
    }
    if (!(rough <= 0.99 * exact)) print_error("rho %g: %g of %g\n", e->rho, rough, exact);
    assert_true(exact < 0.0 && rough <= 0.99 * exact);
    /* nothing is left: no tangent step of the same rows lowers phi */
    double slope = 0.0, *g = e->previous;
    ambulo__band_multiply(&e->base, d, g);
    for (int j = 0; j < f.n; j++) g[j] += e->gradient[j];
    ambulo__sparse_rows_add_transpose(&e->rows.inequality, 1.0, e->held.multiplier, g);
    ambulo__kkt_pass(&e->kkt, memcpy(d, g, (size_t)f.n * sizeof *d), NULL, NULL);
    memset(e->dual, 0, (size_t)e->equalities * sizeof *e->dual);
    ambulo__kkt_solve(&e->kkt, g, NULL, NULL, d, e->dual, e->border_multiplier);
    for (int j = 0; j < f.n; j++) slope += d[j] * g[j];
    if (!(slope <= 1e-6 * -exact)) print_error("rho %g: slope %g of %g\n", e->rho, slope, exact);
    assert_true(slope <= 1e-6 * -exact);
    free(linear);
    free(zero);
    free(d);
    engine_close(&f);
  }
}

/* active: the rows of the metric, which is L L' */
static void the_metric_has_the_active_rows(void **state) {
  (void)state;
  engine_fixture f;
  double predicted;
  unsigned seed = 3;
  engine_open_restored(&f, "yardstick_12");
  ambulo__engine *e = f.engine;
  for (int i = 0; i < e->inequalities; i += 5) e->lambda[i] = 0.1;
  assert_int_equal(ambulo__model_step(e, &predicted), 0);
  double *d = calloc((size_t)f.n, sizeof *d), *m = calloc((size_t)f.n, sizeof *m);
  int active = 0;
  for (int j = 0; j < f.n; j++) d[j] = random_number(&seed);
  ambulo__band_multiply(&e->base, d, m);
  ambulo__sparse_rows_multiply(&e->rows.inequality, d, e->along);
  for (int i = 0; i < e->inequalities; i++) {
    assert_int_equal(e->active[i], e->added[i]);
    active += e->active[i];
    e->along[i] *= e->active[i] ? e->rho : 0.0;
  }
  ambulo__sparse_rows_add_transpose(&e->rows.inequality, 1.0, e->along, m);
  ambulo__band_forward(&e->whitener, m);
  ambulo__band_backward(&e->whitener, m);
  for (int j = 0; j < f.n; j++) assert_close(m[j], d[j], 1e-8);
  assert_true(active > 0);
  assert_int_equal(e->warm, 1);
  e->mu = -1e9;
  assert_int_equal(ambulo__model_step(e, &predicted), 1);
  assert_int_equal(e->warm, 0);
  free(d);
  free(m);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(step_keeps_the_equalities_and_descends),
      cmocka_unit_test(multipliers_balance_the_gradient),
      cmocka_unit_test(the_caller_is_asked),
      cmocka_unit_test(the_model_is_minimized),
      cmocka_unit_test(the_metric_has_the_active_rows),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
