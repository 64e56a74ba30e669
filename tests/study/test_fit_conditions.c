/* Conditions: what they set, their references, curves that lack, held-out ones. */
#include "study/fit.h"
#include "support/fit_files.h"
#include "support/test.h"

static void sets_are_overrides(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS
                         "conditions:\n"
                         "  - {name: a, set: {time.duration: 0.8, 'ends.initial': {pin: 0.1}},\n"
                         "     reference: slow.csv, weight: 2}\n"
                         "  - {name: b, after: a, set: {name: \"12\"}, reference: quick.csv,\n"
                         "     held_out: true}\n" FIT_DISTANCE);
  assert_int_equal(f->conditions, 2);
  assert_string_equal(f->condition[0].set[0], "time.duration=0.8");
  assert_string_equal(f->condition[0].set[1], "ends.initial={pin: 0.1}");
  assert_string_equal(f->condition[1].set[0], "name=\"12\"");
  assert_int_equal(f->condition[0].after, -1);
  assert_int_equal(f->condition[1].after, 0);
  assert_close(f->condition[0].weight, 2.0, 0.0);
  assert_int_equal(f->condition[0].held_out, 0);
  assert_int_equal(f->condition[1].held_out, 1);
  /* 21 points and two numbers; the held-out one is not among the residuals */
  assert_int_equal(f->condition[0].residuals, 23);
  assert_int_equal(f->residuals, 23);
  ambulo_fit_free(f);
}

static void blocks_stand_one_behind_the_other(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS
                         "distance: {curves: {pin: 1, top: {curve: pin, of: peak, sd: 4},\n"
                         "  late: {curve: pin, between: [50, 90]}}}\n");
  const ambulo__fit_target *t = f->condition[1].target;
  assert_int_equal(f->condition[1].targets, 3);
  assert_int_equal(t[0].count, 23);
  assert_int_equal(t[1].first, 23);
  assert_int_equal(t[1].count, 1);
  assert_int_equal(t[2].first, 24);
  assert_int_equal(t[2].points, 9); /* 50, 55, ... 90 */
  assert_close(t[2].percent[0], 50.0, 0.0);
  assert_close(t[2].percent[8], 90.0, 0.0);
  assert_close(t[0].sd, 2.0, 1e-12);
  assert_close(t[1].sd, 4.0, 0.0);
  assert_int_equal(f->condition[1].first, 35);
  assert_int_equal(f->residuals, 70);
  ambulo_fit_free(f);
}

static void a_condition_may_lack_curves(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS
                         "conditions:\n  - {name: a, reference: slow.csv}\n"
                         "  - {name: b, reference: quick.csv, curves: [top]}\n"
                         "distance: {curves: {pin: 1, top: {curve: pin, of: peak}}}\n");
  assert_int_equal(f->condition[0].targets, 2);
  assert_int_equal(f->condition[1].targets, 1);
  assert_int_equal(f->condition[1].target[0].curve, 1);
  assert_int_equal(f->residuals, 25);
  ambulo_fit_free(f);
}

#define WITH(conditions) FIT_HEAD FIT_PARAMETERS "conditions:\n" conditions FIT_DISTANCE

static void conditions_that_are_none(void **state) {
  fit_refused(state, FIT_HEAD FIT_PARAMETERS "conditions: []\n" FIT_DISTANCE, "0 conditions");
  fit_refused(state, WITH("  - {name: a, reference: slow.csv, held_out: true}\n"),
              "all conditions are held out");
  fit_refused(state,
              WITH("  - {name: a, reference: slow.csv}\n  - {name: a, reference: slow.csv}\n"),
              "two conditions are named 'a'");
  fit_refused(state,
              WITH("  - {name: slow, reference: slow.csv}\n"
                   "  - {name: b, after: slwo, reference: slow.csv}\n"),
              "'after' names no earlier condition (got 'slwo')");
  fit_refused(state,
              WITH("  - {name: slow, reference: slow.csv}\n"
                   "  - {name: b, after: slwo, reference: slow.csv}\n"),
              "did you mean 'slow'?");
  fit_refused(state, WITH("  - {name: a, reference: none.csv}\n"),
              "fit.yaml:10:26: error[E_IO]: the reference");
  fit_refused(state, WITH("  - {name: a, reference: slow.csv, curves: [pni]}\n"),
              "no curve of 'distance' (got 'pni')");
}

/* a fit without anything to come closer to */
static void conditions_without_weight(void **state) {
  fit_refused(state, WITH("  - {name: a, reference: slow.csv, curves: []}\n"),
              "fit.yaml:10:44: error[E_SCHEMA]: condition 'a' has no curve with a weight above 0");
  fit_refused(state,
              FIT_HEAD FIT_PARAMETERS
              "conditions:\n  - {name: a, reference: slow.csv, curves: [pin]}\n"
              "  - {name: b, reference: slow.csv, held_out: true}\n"
              "distance: {curves: {pin: 0, top: {curve: pin, of: peak}}}\n",
              "condition 'a' has no curve with a weight above 0");
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS
                         "distance: {curves: {pin: 0, top: {curve: pin, of: peak}}}\n");
  ambulo_fit_free(f);
}

static void references_that_lack(void **state) {
  fit_refused(state,
              FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS "distance: {curves: {knee_flexion: 1}}\n",
              "of condition 'slow' has no curve 'knee_flexion'");
  fit_refused(state, WITH("  - {name: a, reference: plain.csv}\n"),
              "has no deviations of 'pin'; expected 'sd' with the curve");
  fit_refused(state,
              FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS
              "distance: {curves: {pin: {weight: 1, between: [11, 14]}}}\n",
              "has 0 points of 'pin' between 11 and 14 percent");
  ambulo_fit *f =
      fit_of(state, FIT_HEAD FIT_PARAMETERS "conditions:\n  - {name: a, reference: plain.csv}\n"
                                            "distance: {curves: {pin: {sd: 5}}}\n");
  assert_close(f->condition[0].target[0].sd, 5.0, 0.0);
  ambulo_fit_free(f);
}

/* Residual blocks: curves, centred curves, numbers of curves, the cap, solves that failed. */

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
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(sets_are_overrides),          TEST(blocks_stand_one_behind_the_other),
      TEST(a_condition_may_lack_curves), TEST(conditions_that_are_none),
      TEST(conditions_without_weight),   TEST(references_that_lack),
      cmocka_unit_test(a_shifted_curve), cmocka_unit_test(range_and_correlation),
      cmocka_unit_test(the_cap),         cmocka_unit_test(numbers_of_curves),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
