/* Splines through samples: interpolation, rates, smoothing. */
#include "support/fail_alloc.h"
#include "support/test.h"
#include "people/motion_fit.h"

static const double pi = 3.14159265358979323846;

/* rows samples of two functions from time 3 on, spaced unevenly */
static ambulo__motion *sampled(int rows, double (*f)(double), double (*g)(double)) {
  const char *names[2] = {"f", "g"};
  ambulo__motion *motion = NULL;
  assert_int_equal(ambulo__motion_create(rows, 2, names, NULL, &motion), AMBULO_OK);
  for (int r = 0; r < rows; r++) {
    double s = (double)r / (rows - 1);
    motion->time[r] = 3.0 + s + 0.02 * sin(9.0 * s);
    motion->values[2 * r] = f(motion->time[r]);
    motion->values[2 * r + 1] = g(motion->time[r]);
  }
  return motion;
}

static double cubic(double t) {
  return 1.0 + (t - 3.0) * (2.0 - (t - 3.0) * (4.0 - (t - 3.0)));
}
static double wave(double t) {
  return sin(2.0 * pi * t);
}
static double wave_rate(double t) {
  return 2.0 * pi * cos(2.0 * pi * t);
}
static double wave_acceleration(double t) {
  return -4.0 * pi * pi * sin(2.0 * pi * t);
}

static void samples_are_met_and_cubics_exact(void **state) {
  (void)state;
  for (int degree = 3; degree <= 5; degree += 2) {
    ambulo__motion *motion = sampled(30, cubic, wave);
    ambulo__motion_fit *fit = NULL;
    double q[60], qd[60], qdd[60];
    assert_int_equal(ambulo__motion_fit_create(motion, degree, 0.0, NULL, &fit), AMBULO_OK);
    ambulo__motion_fit_at(fit, motion->time, 30, q, qd, qdd);
    for (int r = 0; r < 30; r++) {
      double t = motion->time[r] - 3.0;
      assert_close(q[2 * r], motion->values[2 * r], 1e-13);
      assert_close(q[2 * r + 1], motion->values[2 * r + 1], 1e-13);
      assert_close(qd[2 * r], 2.0 - 8.0 * t + 3.0 * t * t, 1e-10);
      assert_close(qdd[2 * r], -8.0 + 6.0 * t, 1e-7);
    }
    ambulo__motion_fit_free(fit);
    ambulo__motion_free(motion);
  }
}

/* halving the spacing divides the error of qdd by 4 (cubic) and by 16 (quintic) */
static double acceleration_error(int rows, int degree) {
  ambulo__motion *motion = sampled(rows, wave, wave);
  ambulo__motion_fit *fit = NULL;
  assert_int_equal(ambulo__motion_fit_create(motion, degree, 0.0, NULL, &fit), AMBULO_OK);
  double worst = 0.0;
  for (int k = 0; k <= 100; k++) {
    double t = 3.3 + 0.004 * k, qd[2], qdd[2];
    ambulo__motion_fit_at(fit, &t, 1, NULL, qd, qdd);
    worst = fmax(worst, fabs(qdd[0] - wave_acceleration(t)));
    assert_close(qd[0], wave_rate(t), 1e-2);
  }
  ambulo__motion_fit_free(fit);
  ambulo__motion_free(motion);
  return worst;
}

static void accelerations_converge_at_the_order_of_the_spline(void **state) {
  (void)state;
  double cubic_ratio = acceleration_error(41, 3) / acceleration_error(81, 3);
  double quintic_ratio = acceleration_error(41, 5) / acceleration_error(81, 5);
  if (cubic_ratio < 3.0 || quintic_ratio < 10.0) {
    print_error("error ratios %g (cubic), %g (quintic)\n", cubic_ratio, quintic_ratio);
  }
  assert_true(cubic_ratio > 3.0);
  assert_true(quintic_ratio > 10.0);
}

static double slow(double t) {
  return sin(2.0 * pi * 1.0 * t);
}
static double at_cutoff(double t) {
  return sin(2.0 * pi * 6.0 * t);
}

/* amplitude kept, by projection on the sine over whole periods away from the ends */
static double kept_amplitude(int degree, double cutoff, double (*f)(double), int column) {
  ambulo__motion *motion = sampled(401, slow, f);
  for (int r = 0; r < 401; r++) { /* even spacing over 4 s */
    motion->time[r] = 0.01 * r;
    motion->values[2 * r] = slow(motion->time[r]);
    motion->values[2 * r + 1] = f(motion->time[r]);
  }
  ambulo__motion_fit *fit = NULL;
  assert_int_equal(ambulo__motion_fit_create(motion, degree, cutoff, NULL, &fit), AMBULO_OK);
  double above = 0.0, below = 0.0;
  for (int k = 0; k < 200; k++) {
    double t = 1.0 + 0.01 * k, q[2];
    ambulo__motion_fit_at(fit, &t, 1, q, NULL, NULL);
    double want = column == 0 ? slow(t) : f(t);
    above += q[column] * want;
    below += want * want;
  }
  ambulo__motion_fit_free(fit);
  ambulo__motion_free(motion);
  return above / below;
}

static void smoothing_halves_the_amplitude_at_the_cutoff(void **state) {
  (void)state;
  for (int degree = 3; degree <= 5; degree += 2) {
    assert_close(kept_amplitude(degree, 6.0, at_cutoff, 1), 0.5, 0.02);
    double pass = 1.0 / (1.0 + pow(1.0 / 6.0, degree + 1));
    assert_close(kept_amplitude(degree, 6.0, at_cutoff, 0), pass, 1e-3);
  }
}

static void what_cannot_be_fitted_is_refused(void **state) {
  (void)state;
  ambulo__motion *motion = sampled(5, cubic, wave);
  ambulo__motion_fit *fit = NULL;
  assert_int_equal(ambulo__motion_fit_create(motion, 4, 0.0, NULL, &fit), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__motion_fit_create(motion, 5, 0.0, NULL, &fit), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__motion_fit_create(motion, 3, -1.0, NULL, &fit), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__motion_fit_create(motion, 3, NAN, NULL, &fit), AMBULO_E_ARGUMENT);
  motion->time[2] = motion->time[1];
  assert_int_equal(ambulo__motion_fit_create(motion, 3, 0.0, NULL, &fit), AMBULO_E_ARGUMENT);
  motion->time[2] = 0.5 * (motion->time[1] + motion->time[3]);
  motion->values[3] = NAN;
  assert_int_equal(ambulo__motion_fit_create(motion, 3, 0.0, NULL, &fit), AMBULO_E_NUMERIC);
  assert_null(fit);
  ambulo__motion_fit_free(NULL);
  ambulo__motion_free(motion);
}

static void the_fewest_samples_make_one_polynomial(void **state) {
  (void)state;
  ambulo__motion *motion = sampled(4, cubic, cubic);
  ambulo__motion_fit *fit = NULL;
  assert_int_equal(ambulo__motion_fit_create(motion, 3, 0.0, NULL, &fit), AMBULO_OK);
  double t = 3.4321, q[2];
  ambulo__motion_fit_at(fit, &t, 1, q, NULL, NULL);
  assert_close(q[0], cubic(t), 1e-13);
  ambulo__motion_fit_free(fit);
  ambulo__motion_free(motion);
}

static void every_failed_allocation_is_survived(void **state) {
  (void)state;
  ambulo__motion *motion = sampled(12, cubic, wave);
  for (long k = 0; k < 1000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__motion_fit *fit = NULL;
    ambulo_status status = ambulo__motion_fit_create(motion, 5, 6.0, &hook, &fit);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__motion_fit_free(fit);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_int_not_equal(k, 999);
  }
  ambulo__motion_free(motion);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(samples_are_met_and_cubics_exact),
      cmocka_unit_test(accelerations_converge_at_the_order_of_the_spline),
      cmocka_unit_test(smoothing_halves_the_amplitude_at_the_cutoff),
      cmocka_unit_test(what_cannot_be_fitted_is_refused),
      cmocka_unit_test(the_fewest_samples_make_one_polynomial),
      cmocka_unit_test(every_failed_allocation_is_survived),
  };
  return cmocka_run_group_tests_name("trajectory/motion_fit", tests, NULL, NULL);
}
