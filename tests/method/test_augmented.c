/* The augmented Lagrangian's reduced gradient against central differences of its value, with
 * rows inside and outside, and the retraction behind both. */
#include "method/augmented.h"
#include "support/engine_fixture.h"

static void open_at_model_step(engine_fixture *f) {
  double predicted;
  engine_open_restored(f, "yardstick_12");
  for (int i = 0; i < f->engine->setup->inequalities; i += 5) f->engine->iterate.lambda[i] = 0.1;
  assert_int_equal(ambulo__model_step(f->engine, &predicted), 0);
  ambulo__last_point_forget(f->engine);
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
  e->last->ceiling = -HUGE_VAL;
  double value = ambulo__augmented(e, w, NULL);
  assert_int_equal(f.run.evaluations, counted + 1);
  assert_true(ambulo__augmented(e, w, g) == value);
  assert_int_equal(f.run.evaluations, counted + 1);
  for (int i = 0; i < e->setup->inequalities; i++) {
    double p = fmax(0.0, e->iterate.lambda[i] + e->iterate.rho * e->last->trial.excess[i]);
    assert_true(e->last->trial.multiplier[i] == p);
    sum += p * p - e->iterate.lambda[i] * e->iterate.lambda[i];
  }
  assert_true(sum != 0.0);
  assert_close(value,
               e->setup->objective_scale * e->workspace->objective + sum / (2.0 * e->iterate.rho),
               1e-12);
  assert_true(e->last->ceiling == value);
  for (int i = 0; i < e->setup->equalities; i++)
    assert_true(e->last->trial.equality_multiplier[i] == e->iterate.equality_multiplier[i]);
  for (int j = 0; j < f.n; j++) {
    w[j] = 1e6 * (j % 2 ? 1.0 : -1.0);
    squares += w[j] * w[j];
  }
  double bowl = ambulo__augmented(e, w, g), height = 1.0 + fabs(value);
  assert_close(bowl / (value + height * (1.0 + squares)), 1.0, 1e-12);
  for (int j = 0; j < f.n; j++) assert_close(g[j] / (2.0 * height * w[j]), 1.0, 1e-12);
  assert_true(e->last->ceiling == value);
  free(w);
  free(g);
  engine_close(&f);
}

/* a value, a gradient, a whitened gradient that is not finite: the point is rejected */
static void what_is_not_finite_is_given_up(void **state) {
  (void)state;
  for (int run = 0; run < 3; run++) {
    engine_fixture f;
    open_at_model_step(&f);
    ambulo__engine *e = f.engine;
    double *w = calloc((size_t)f.n, sizeof *w), *g = calloc((size_t)f.n, sizeof *g);
    e->last->ceiling = -HUGE_VAL;
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

/* NLopt's variables: the gradient is the slope, the first step of a quasi-Newton method is the
 * model step, and what NLopt calls the centre stays the centre. */

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
    assert_close(l.f.engine->last->trial.x[j], l.f.engine->iterate.x[j], 1e-12);
  end(&l);
}

static void test_chart_gradient_is_the_slope(void **state) {
  (void)state;
  laid l;
  unsigned seed = 8;
  const double stretch = 30.0, h = 3e-3;
  lay(&l, stretch);
  l.f.engine->retraction->adjoint_tolerance = 1e-7;
  l.f.engine->retraction->tolerance = 1e-11;
  ambulo__last_point_forget(l.f.engine);
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

/* what was kept belongs to another centre */
static void a_new_centre_is_evaluated(void **state) {
  (void)state;
  laid l;
  lay(&l, 1.0);
  ambulo__engine *e = l.f.engine;
  double before = l.chart.start, predicted;
  assert_true(e->last->ceiling == before);
  double t = ambulo__step_limit(e->setup, e->quadratic->total, 0.1);
  (void)t;
  memcpy(l.v, l.chart.step, (size_t)l.f.n * sizeof *l.v);
  memset(l.chart.whitened, 0, (size_t)l.f.n * sizeof *l.v);
  (void)ambulo__augmented(e, l.v, NULL);
  memcpy(e->iterate.x, e->last->trial.x, (size_t)l.f.n * sizeof *l.v);
  (void)ambulo__augmented(e, l.chart.whitened, NULL);
  assert_int_equal(ambulo__model_step(e, &predicted), 0);
  e->last->ceiling = 1e9;
  assert_int_equal(ambulo__chart_lay(&l.chart, e, l.w, 1.0), 1);
  assert_true(l.chart.start != before && l.chart.start < before);
  assert_true(e->last->ceiling == l.chart.start);
  for (int j = 0; j < l.f.n; j++) e->iterate.x[j] += j % 3 ? 50.0 : -70.0;
  assert_int_equal(ambulo__chart_lay(&l.chart, e, l.w, 1.0), 0);
  end(&l);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gradient_is_the_slope),
      cmocka_unit_test(lost_point_gives_a_large_finite_value),
      cmocka_unit_test(values_are_the_formula),
      cmocka_unit_test(what_is_not_finite_is_given_up),
      cmocka_unit_test(centre_stays),
      cmocka_unit_test(test_chart_gradient_is_the_slope),
      cmocka_unit_test(first_step_is_the_model_step),
      cmocka_unit_test(only_descents_turn_the_chart),
      cmocka_unit_test(no_step_is_wild),
      cmocka_unit_test(a_new_centre_is_evaluated),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
