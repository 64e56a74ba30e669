/* The augmented Lagrangian's reduced gradient against central differences of its value, with
 * rows inside and outside, and the retraction behind both. */
#include "support/engine_fixture.h"

static void open_at_model_step(engine_fixture *f) {
  double predicted;
  engine_open_restored(f, "yardstick_12");
  for (int i = 0; i < f->engine->inequalities; i += 5) f->engine->lambda[i] = 0.1;
  assert_int_equal(ambulo__model_step(f->engine, &predicted), 0);
  f->engine->has_held = 0;
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gradient_is_the_slope),
      cmocka_unit_test(lost_point_gives_a_large_finite_value),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
