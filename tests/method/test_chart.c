/* NLopt's variables: the gradient is the slope, the first step of a quasi-Newton method is the
 * model step, and what NLopt calls the centre stays the centre. */
#include "method/chart.h"
#include "support/engine_fixture.h"

typedef struct laid {
  engine_fixture f;
  ambulo__pool pool;
  ambulo__chart chart;
  double *w, *g, *v;
} laid;

static void lay(laid *l, double stretch) {
  double predicted;
  memset(l, 0, sizeof *l);
  engine_open_restored(&l->f, "yardstick_12");
  for (int i = 0; i < l->f.engine->setup->inequalities; i += 5)
    l->f.engine->iterate.lambda[i] = 0.1;
  ambulo__pool_init(&l->pool, NULL);
  assert_int_equal(ambulo__chart_create(l->f.n, &l->pool, &l->chart), AMBULO_OK);
  l->w = ambulo__pool_doubles(&l->pool, (size_t)l->f.n);
  l->g = ambulo__pool_doubles(&l->pool, (size_t)l->f.n);
  l->v = ambulo__pool_doubles(&l->pool, (size_t)l->f.n);
  unsigned seed = 3;
  for (int j = 0; j < l->f.n; j++) l->w[j] = random_number(&seed);
  assert_int_equal(ambulo__model_step(l->f.engine, &predicted), 0);
  assert_int_equal(ambulo__chart_lay(&l->chart, l->f.engine, l->w, stretch), 1);
}

static void end(laid *l) {
  ambulo__pool_clear(&l->pool);
  engine_close(&l->f);
}

static void centre_stays(void **state) {
  (void)state;
  laid l;
  lay(&l, 30.0);
  double value = ambulo__chart_value(&l.chart, l.f.engine, l.w, NULL);
  assert_true(value == l.chart.start);
  for (int j = 0; j < l.f.n; j++)
    assert_close(l.f.engine->held->trial.x[j], l.f.engine->iterate.x[j], 1e-12);
  end(&l);
}

static void gradient_is_the_slope(void **state) {
  (void)state;
  laid l;
  unsigned seed = 8;
  const double stretch = 30.0, h = 3e-3;
  lay(&l, stretch);
  l.f.engine->retraction->adjoint_tolerance = 1e-7;
  l.f.engine->retraction->tolerance = 1e-11;
  ambulo__held_forget(l.f.engine);
  double slope = 0.0, *d = calloc((size_t)l.f.n, sizeof *d);
  for (int j = 0; j < l.f.n; j++) {
    l.w[j] += 0.3 * random_number(&seed);
    d[j] = random_number(&seed);
  }
  (void)ambulo__chart_value(&l.chart, l.f.engine, l.w, l.g);
  for (int j = 0; j < l.f.n; j++) slope += l.g[j] * d[j];
  for (int j = 0; j < l.f.n; j++) l.v[j] = l.w[j] + h * d[j];
  double up = ambulo__chart_value(&l.chart, l.f.engine, l.v, NULL);
  for (int j = 0; j < l.f.n; j++) l.v[j] = l.w[j] - h * d[j];
  double down = ambulo__chart_value(&l.chart, l.f.engine, l.v, NULL);
  assert_true(fabs(slope) > 1e-6);
  assert_close((up - down) / (2.0 * h * slope), 1.0, 1e-4);
  free(d);
  end(&l);
}

/* w - stretch^2 g, stretch^2 g the gradient of what NLopt minimizes: x_k + the model step */
static void first_step_is_the_model_step(void **state) {
  (void)state;
  laid l;
  const double stretch = 7.0;
  lay(&l, stretch);
  (void)ambulo__chart_value(&l.chart, l.f.engine, l.w, l.g);
  for (int j = 0; j < l.f.n; j++) l.v[j] = l.w[j] - stretch * stretch * l.g[j];
  (void)ambulo__chart_value(&l.chart, l.f.engine, l.v, NULL);
  double size = 0.0;
  for (int j = 0; j < l.f.n; j++) size = fmax(size, fabs(l.chart.step[j]));
  assert_true(size > 1e-3);
  for (int j = 0; j < l.f.n; j++)
    assert_close((l.chart.whitened[j] - l.chart.step[j]) / size, 0.0, 1e-9);
  end(&l);
}

/* a step that leads uphill is left out */
static void only_descents_turn_the_chart(void **state) {
  (void)state;
  laid l;
  lay(&l, 1.0);
  for (int j = 0; j < l.f.n; j++) l.v[j] = -l.chart.step[j];
  ambulo__band_backward(&l.f.engine->linearized.whitener, l.v);
  memcpy(l.f.engine->quadratic->total, l.v, (size_t)l.f.n * sizeof *l.v);
  assert_int_equal(ambulo__chart_lay(&l.chart, l.f.engine, l.w, 1.0), 1);
  for (int j = 0; j < l.f.n; j++) assert_true(l.chart.step[j] == 0.0 && l.chart.turn[j] == 0.0);
  end(&l);
}

static void no_step_is_wild(void **state) {
  (void)state;
  laid l;
  lay(&l, 1.0);
  double largest = 0.0;
  memcpy(l.v, l.chart.step, (size_t)l.f.n * sizeof *l.v);
  ambulo__band_backward(&l.f.engine->linearized.whitener, l.v);
  for (int j = 0; j < l.f.n; j++) l.f.engine->quadratic->total[j] = 1e3 * l.v[j];
  assert_int_equal(ambulo__chart_lay(&l.chart, l.f.engine, l.w, 1.0), 1);
  memcpy(l.v, l.chart.step, (size_t)l.f.n * sizeof *l.v);
  ambulo__band_backward(&l.f.engine->linearized.whitener, l.v);
  for (int j = 0; j < l.f.n; j++) {
    double cap = l.f.engine->setup->cap[j % l.f.problem->coordinates];
    largest = fmax(largest, fabs(l.v[j]) / cap);
  }
  assert_close(largest, 0.5, 1e-9);
  end(&l);
}

/* what was held belongs to another centre */
static void a_new_centre_is_evaluated(void **state) {
  (void)state;
  laid l;
  lay(&l, 1.0);
  ambulo__engine *e = l.f.engine;
  double before = l.chart.start, predicted;
  assert_true(e->held->ceiling == before);
  double t = ambulo__step_limit(e->setup, e->quadratic->total, 0.1);
  (void)t;
  memcpy(l.v, l.chart.step, (size_t)l.f.n * sizeof *l.v);
  memset(l.chart.whitened, 0, (size_t)l.f.n * sizeof *l.v);
  (void)ambulo__augmented(e, l.v, NULL);
  memcpy(e->iterate.x, e->held->trial.x, (size_t)l.f.n * sizeof *l.v);
  (void)ambulo__augmented(e, l.chart.whitened, NULL);
  assert_int_equal(ambulo__model_step(e, &predicted), 0);
  e->held->ceiling = 1e9;
  assert_int_equal(ambulo__chart_lay(&l.chart, e, l.w, 1.0), 1);
  assert_true(l.chart.start != before && l.chart.start < before);
  assert_true(e->held->ceiling == l.chart.start);
  for (int j = 0; j < l.f.n; j++) e->iterate.x[j] += j % 3 ? 50.0 : -70.0;
  assert_int_equal(ambulo__chart_lay(&l.chart, e, l.w, 1.0), 0);
  end(&l);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(centre_stays),
                                     cmocka_unit_test(gradient_is_the_slope),
                                     cmocka_unit_test(first_step_is_the_model_step),
                                     cmocka_unit_test(only_descents_turn_the_chart),
                                     cmocka_unit_test(no_step_is_wild),
                                     cmocka_unit_test(a_new_centre_is_evaluated)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
