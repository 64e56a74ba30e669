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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(step_keeps_the_equalities_and_descends),
      cmocka_unit_test(multipliers_balance_the_gradient),
      cmocka_unit_test(the_caller_is_asked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
