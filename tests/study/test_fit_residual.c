/* Residual blocks: curves, centred curves, numbers of curves, guards, the cap, solves that failed.
 */
#include "study/fit.h"
#include "support/test.h"

enum { POINTS = 5 };
static const double mean[POINTS] = {0.0, 10.0, 20.0, 10.0, 0.0};

static ambulo_fit make(ambulo__fit_curve *curve, ambulo__fit_of of, int centred) {
  *curve = (ambulo__fit_curve){
      .of = of, .weight = 1.0, .centred = centred, .correlation = 1.2, .range_cost = 0.8};
  return (ambulo_fit){.curve = curve, .curves = 1, .cap = 12.0};
}

static ambulo__fit_target target_of(ambulo__fit_of of) {
  return (ambulo__fit_target){
      .points = POINTS, .mean = mean, .sd = 2.0, .count = of == AMBULO__FIT_CURVE ? POINTS + 2 : 1};
}

static double sum(const double *r, int count) {
  double s = 0.0;
  for (int i = 0; i < count; i++) s += r[i] * r[i];
  return s;
}

static void a_shifted_curve(void **state) {
  (void)state;
  ambulo__fit_curve curve;
  ambulo_fit fit = make(&curve, AMBULO__FIT_CURVE, 0);
  ambulo__fit_target t = target_of(AMBULO__FIT_CURVE);
  ambulo__fit_score s;
  double y[POINTS], r[POINTS + 2];
  for (int i = 0; i < POINTS; i++) y[i] = mean[i] + 2.0; /* one deviation */
  ambulo__fit_residual(&fit, &t, y, r, &s);
  assert_close(s.z, 1.0, 1e-12);
  assert_close(sum(r, 7), 1.0, 1e-12);
  assert_close(s.rmse, 2.0, 1e-12);
  assert_close(s.r, 1.0, 1e-12);
  assert_close(s.ratio, 1.0, 1e-12);
  fit = make(&curve, AMBULO__FIT_CURVE, 1);
  ambulo__fit_residual(&fit, &t, y, r, &s);
  assert_close(s.z, 0.0, 1e-12);
  assert_close(s.rmse, 2.0, 1e-12); /* not centred */
}

/* twice the range: e is the mean curve, r is 1, ln 2 counts */
static void range_and_correlation(void **state) {
  (void)state;
  ambulo__fit_curve curve;
  ambulo_fit fit = make(&curve, AMBULO__FIT_CURVE, 0);
  ambulo__fit_target t = target_of(AMBULO__FIT_CURVE);
  ambulo__fit_score s;
  double y[POINTS], r[POINTS + 2];
  fit.cap = 1e9;
  for (int i = 0; i < POINTS; i++) y[i] = 2.0 * mean[i];
  ambulo__fit_residual(&fit, &t, y, r, &s);
  assert_close(r[2], 20.0 / (2.0 * sqrt(5.0)), 1e-12);
  assert_close(r[5], 0.0, 1e-12);
  assert_close(r[6], 0.8 * log(2.0), 1e-12);
  for (int i = 0; i < POINTS; i++) y[i] = -mean[i];
  ambulo__fit_residual(&fit, &t, y, r, &s);
  assert_close(s.r, -1.0, 1e-12);
  assert_close(r[5], 2.4, 1e-12);
  for (int i = 0; i < POINTS; i++) y[i] = 3.0; /* constant: r is none, the ratio is floored */
  ambulo__fit_residual(&fit, &t, y, r, &s);
  assert_true(isnan(s.r));
  assert_close(r[5], 1.2, 1e-12);
  assert_close(r[6], 0.8 * log(0.1), 1e-12);
}

static void the_cap(void **state) {
  (void)state;
  ambulo__fit_curve curve;
  ambulo_fit fit = make(&curve, AMBULO__FIT_CURVE, 0);
  ambulo__fit_target t = target_of(AMBULO__FIT_CURVE);
  ambulo__fit_score s;
  double y[POINTS], r[POINTS + 2];
  for (int i = 0; i < POINTS; i++) y[i] = mean[i] + 20.0; /* z = 100 */
  ambulo__fit_residual(&fit, &t, y, r, &s);
  assert_close(s.z, 12.0 + log(100.0 / 12.0), 1e-12);
  assert_close(sum(r, 7), s.z, 1e-12);
  ambulo__fit_residual(&fit, &t, NULL, r, &s);
  assert_close(s.z, 24.0, 1e-12);
  assert_close(sum(r, 7), 24.0, 1e-12);
  assert_true(isnan(s.rmse));
}

static void numbers_of_curves(void **state) {
  (void)state;
  static const struct {
    ambulo__fit_of of;
    double value, reference;
  } cases[] = {{AMBULO__FIT_RANGE, 18.0, 20.0},
               {AMBULO__FIT_PEAK, 23.0, 20.0},
               {AMBULO__FIT_LOWEST, 5.0, 0.0},
               {AMBULO__FIT_LARGEST, 23.0, 20.0}};
  const double y[POINTS] = {5.0, 10.0, 23.0, 12.0, 7.0};
  for (int i = 0; i < 4; i++) {
    ambulo__fit_curve curve;
    ambulo_fit fit = make(&curve, cases[i].of, 0);
    ambulo__fit_target t = target_of(cases[i].of);
    ambulo__fit_score s;
    double r[1], d = (cases[i].value - cases[i].reference) / 2.0;
    ambulo__fit_residual(&fit, &t, y, r, &s);
    assert_close(s.value, cases[i].value, 0.0);
    assert_close(s.reference, cases[i].reference, 0.0);
    assert_close(r[0], d, 1e-12);
    assert_close(s.z, d * d, 1e-12);
    assert_true(isnan(s.r));
  }
}

static const double above = INFINITY;

/* the residual of one guard of a curve, and its score */
static double residual_of(ambulo__fit_of of, double least, double most, const double *y,
                          ambulo__fit_score *score) {
  ambulo__fit_curve curve = {.of = of, .weight = 1.0, .is_guard = 1, .bound = {least, most}};
  const ambulo_fit fit = {.curve = &curve, .curves = 1, .cap = 12.0};
  const ambulo__fit_target t = {.points = POINTS, .sd = 2.0, .count = 1};
  double residual = (double)NAN;
  ambulo__fit_residual(&fit, &t, y, &residual, score);
  assert_close(residual * residual, score->z, 1e-12);
  return residual;
}

static void beyond_a_bound_and_within(void **state) {
  (void)state;
  static const struct {
    ambulo__fit_of of;
    double least, most, value, residual;
  } cases[] = {{AMBULO__FIT_PEAK, -above, 20.0, 23.0, 1.5},
               {AMBULO__FIT_PEAK, -above, 23.0, 23.0, 0.0},
               {AMBULO__FIT_PEAK, -above, 90.0, 23.0, 0.0},
               {AMBULO__FIT_PEAK, 24.0, above, 23.0, -0.5},
               {AMBULO__FIT_PEAK, 20.0, above, 23.0, 0.0},
               {AMBULO__FIT_PEAK, 20.0, 22.0, 23.0, 0.5},
               {AMBULO__FIT_LOWEST, -28.0, above, -29.0, -0.5},
               {AMBULO__FIT_LOWEST, -40.0, -32.0, -29.0, 1.5},
               {AMBULO__FIT_LARGEST, -above, 28.0, 29.0, 0.5},
               {AMBULO__FIT_LARGEST, -above, 29.0, 29.0, 0.0},
               {AMBULO__FIT_RANGE, -above, 50.0, 52.0, 1.0},
               {AMBULO__FIT_RANGE, 55.0, above, 52.0, -1.5}};
  const double y[POINTS] = {5.0, -29.0, 23.0, 12.0, 7.0};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo__fit_score s;
    double r = residual_of(cases[i].of, cases[i].least, cases[i].most, y, &s);
    assert_close(r, cases[i].residual, 1e-12);
    assert_close(s.value, cases[i].value, 0.0);
    assert_true(isnan(s.reference) && isnan(s.rmse) && isnan(s.r) && isnan(s.ratio));
  }
  ambulo__fit_score s;
  double r = residual_of(AMBULO__FIT_PEAK, -above, 3.0, y, &s); /* ten deviations: the cap */
  assert_close(r, sqrt(12.0 + log(100.0 / 12.0)), 1e-12);
  assert_close(residual_of(AMBULO__FIT_PEAK, -above, 3.0, NULL, &s), sqrt(24.0), 1e-12);
}

/* the slope, by differences: 1 / sd where the bound is broken, 0 where it holds */
static void slopes(void **state) {
  (void)state;
  static const double most[] = {20.0, 30.0}, expected[] = {0.5, 0.0}, h = 1e-6;
  for (int i = 0; i < 2; i++) {
    double y[POINTS] = {5.0, -29.0, 23.0, 12.0, 7.0}, r[2];
    ambulo__fit_score s;
    for (int side = 0; side < 2; side++) {
      y[2] = 23.0 + (side ? h : -h);
      r[side] = residual_of(AMBULO__FIT_PEAK, -above, most[i], y, &s);
    }
    assert_close((r[1] - r[0]) / (2.0 * h), expected[i], 1e-8);
  }
}

/* the same of the number alone, below and above the cap */
static void slopes_of_numbers(void **state) {
  (void)state;
  static const double values[] = {-60.0, 3.0, 8.0, 21.0, 26.0, 90.0};
  ambulo__fit_curve curve = {.of = AMBULO__FIT_PEAK, .is_guard = 1, .bound = {5.0, 20.0}};
  const ambulo_fit fit = {.curve = &curve, .curves = 1, .cap = 12.0};
  const ambulo__fit_target t = {.points = POINTS, .sd = 2.0, .count = 1};
  for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
    double slope, unused, h = 1e-5;
    (void)ambulo__fit_guard(&fit, &t, values[i], &slope);
    double up = ambulo__fit_guard(&fit, &t, values[i] + h, &unused);
    double down = ambulo__fit_guard(&fit, &t, values[i] - h, &unused);
    assert_close(slope, (up - down) / (2.0 * h), 1e-8);
    assert_int_equal(slope != 0.0, i != 2);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_shifted_curve),
      cmocka_unit_test(range_and_correlation),
      cmocka_unit_test(the_cap),
      cmocka_unit_test(numbers_of_curves),
      cmocka_unit_test(beyond_a_bound_and_within),
      cmocka_unit_test(slopes),
      cmocka_unit_test(slopes_of_numbers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
