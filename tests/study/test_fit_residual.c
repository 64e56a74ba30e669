/* Residual blocks: curves, centred curves, numbers of curves, the cap, solves that failed. */
#include "study/fit_residual.h"
#include "support/test.h"

enum { POINTS = 5 };
static const double mean[POINTS] = {0.0, 10.0, 20.0, 10.0, 0.0};

static ambulo_fit make(ambulo__fit_curve *curve, ambulo__fit_of of, int centred) {
  *curve = (ambulo__fit_curve){.of = of, .weight = 1.0, .centred = centred};
  return (ambulo_fit){
      .curve = curve, .curves = 1, .correlation = 1.2, .range_cost = 0.8, .cap = 12.0};
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
  ambulo__fit_residual_failed(&fit, &t, r, &s);
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
               {AMBULO__FIT_LOWEST, 5.0, 0.0}};
  const double y[POINTS] = {5.0, 10.0, 23.0, 12.0, 7.0};
  for (int i = 0; i < 3; i++) {
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_shifted_curve), cmocka_unit_test(range_and_correlation),
      cmocka_unit_test(the_cap), cmocka_unit_test(numbers_of_curves)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
