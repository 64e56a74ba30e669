/* The augmented Lagrangian's reduced gradient against central differences of its value, with
 * rows inside and outside, and the retraction behind both. */
#include "support/engine_fixture.h"

static void open_at_model_step(engine_fixture *f) {
  double predicted;
  engine_open_restored(f, "yardstick_12");
  for (int i = 0; i < f->engine->setup->inequalities; i += 5) f->engine->iterate.lambda[i] = 0.1;
  assert_int_equal(ambulo__model_step(f->engine, &predicted), 0);
  ambulo__held_forget(f->engine);
}

static void gradient_is_the_slope(void **state) {
  (void)state;
  engine_fixture f;
  unsigned seed = 2;
  open_at_model_step(&f);
  size_t n = (size_t)f.n;
  double *w = calloc(n, sizeof *w), *v = calloc(n, sizeof *v), *g = calloc(n, sizeof *g);
  double *d = calloc(n, sizeof *d), h = 1e-4, slope = 0.0;
  for (size_t j = 0; j < n; j++) {
    w[j] = 0.02 * random_number(&seed);
    d[j] = random_number(&seed);
  }
  f.engine->retraction->adjoint_tolerance = 1e-5;
  double middle = ambulo__augmented(f.engine, w, g);
  assert_true(middle < 1e4);
  for (size_t j = 0; j < n; j++) slope += g[j] * d[j];
  for (size_t j = 0; j < n; j++) v[j] = w[j] + h * d[j];
  double up = ambulo__augmented(f.engine, v, NULL);
  for (size_t j = 0; j < n; j++) v[j] = w[j] - h * d[j];
  double down = ambulo__augmented(f.engine, v, NULL);
  assert_true(fabs(slope) > 1e-3);
  assert_close((up - down) / (2.0 * h * slope), 1.0, 2e-4);
  free(w);
  free(v);
  free(g);
  free(d);
  engine_close(&f);
}

static void lost_point_gives_a_large_finite_value(void **state) {
  (void)state;
  engine_fixture f;
  open_at_model_step(&f);
  double *w = calloc((size_t)f.n, sizeof *w), *g = calloc((size_t)f.n, sizeof *g);
  for (int j = 0; j < f.n; j++) w[j] = 1e6 * (j % 2 ? 1.0 : -1.0);
  double value = ambulo__augmented(f.engine, w, g);
  assert_true(isfinite(value) && value >= 1e4);
  assert_true(g[1] > 0.0 && g[2] < 0.0);
  free(w);
  free(g);
  engine_close(&f);
}

/* f + sum (p^2 - lambda^2) / (2 rho), counted once; what lies above all of it elsewhere */
static void values_are_the_formula(void **state) {
  (void)state;
  engine_fixture f;
  open_at_model_step(&f);
  ambulo__engine *e = f.engine;
  double *w = calloc((size_t)f.n, sizeof *w), *g = calloc((size_t)f.n, sizeof *g);
  int counted = f.run.evaluations;
  double sum = 0.0, squares = 0.0;
  e->held->ceiling = -HUGE_VAL;
  double value = ambulo__augmented(e, w, NULL);
  assert_int_equal(f.run.evaluations, counted + 1);
  assert_true(ambulo__augmented(e, w, g) == value);
  assert_int_equal(f.run.evaluations, counted + 1);
  for (int i = 0; i < e->setup->inequalities; i++) {
    double p = fmax(0.0, e->iterate.lambda[i] + e->iterate.rho * e->held->trial.excess[i]);
    assert_true(e->held->trial.multiplier[i] == p);
    sum += p * p - e->iterate.lambda[i] * e->iterate.lambda[i];
  }
  assert_true(sum != 0.0);
  assert_close(value,
               e->setup->objective_scale * e->workspace->objective + sum / (2.0 * e->iterate.rho),
               1e-12);
  assert_true(e->held->ceiling == value);
  for (int i = 0; i < e->setup->equalities; i++)
    assert_true(e->held->trial.equality_multiplier[i] == e->iterate.equality_multiplier[i]);
  for (int j = 0; j < f.n; j++) {
    w[j] = 1e6 * (j % 2 ? 1.0 : -1.0);
    squares += w[j] * w[j];
  }
  double bowl = ambulo__augmented(e, w, g), height = 1.0 + fabs(value);
  assert_close(bowl / (value + height * (1.0 + squares)), 1.0, 1e-12);
  for (int j = 0; j < f.n; j++) assert_close(g[j] / (2.0 * height * w[j]), 1.0, 1e-12);
  assert_true(e->held->ceiling == value);
  free(w);
  free(g);
  engine_close(&f);
}

/* a value, a gradient, a whitened gradient that is not finite: the point is given up */
static void what_is_not_finite_is_given_up(void **state) {
  (void)state;
  for (int run = 0; run < 3; run++) {
    engine_fixture f;
    open_at_model_step(&f);
    ambulo__engine *e = f.engine;
    double *w = calloc((size_t)f.n, sizeof *w), *g = calloc((size_t)f.n, sizeof *g);
    e->held->ceiling = -HUGE_VAL;
    if (run == 0) e->iterate.lambda[0] = INFINITY;
    double value = ambulo__augmented(e, w, NULL);
    if (run == 0) assert_true(value == 1.0); /* the bottom of the bowl */
    if (run == 1) setup_to_break(e)->objective_scale = NAN;
    if (run == 2) e->linearized.whitener.a[0] = INFINITY;
    double bowl = run == 0 ? 1.0 : value + 1.0 + fabs(value);
    assert_close(ambulo__augmented(e, w, g), bowl, 1e-12);
    for (int j = 0; j < f.n; j++) assert_true(g[j] == 0.0);
    free(w);
    free(g);
    engine_close(&f);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gradient_is_the_slope),
      cmocka_unit_test(lost_point_gives_a_large_finite_value),
      cmocka_unit_test(values_are_the_formula),
      cmocka_unit_test(what_is_not_finite_is_given_up),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
