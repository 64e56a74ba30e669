/* The zero-lag filter against closed forms: gain and phase of sines, what it must leave alone, the
 * edges, and an impulse by sums of the same poles. */
#include "support/fail_alloc.h"
#include "support/test.h"
#include "trajectory/butterworth.h"

static const double pi = 3.14159265358979323846;

/* 1 / (1 + (w / W)^2n): both passes together */
static double gain(double frequency, double rate, double cutoff, int order) {
  double n = order / 2, ratio = tan(pi * frequency / rate) / tan(pi * cutoff / rate);
  return 1.0 / (1.0 + pow(ratio, 2.0 * n) * (sqrt(2.0) - 1.0));
}

/* whole periods of a sine: amplitude and phase by its Fourier coefficients away from the ends */
static void pass_a_sine(double frequency, double rate, double cutoff, int order, double *amplitude,
                        double *phase) {
  enum { ROWS = 6000 };
  static double x[ROWS];
  for (int k = 0; k < ROWS; k++) x[k] = sin(2.0 * pi * frequency * k / rate + 0.4);
  assert_int_equal(ambulo__butterworth(x, ROWS, 1, rate, cutoff, order, NULL), AMBULO_OK);
  double s = 0.0, c = 0.0;
  int first = 2000, count = 2000;
  for (int k = first; k < first + count; k++) {
    s += x[k] * sin(2.0 * pi * frequency * k / rate + 0.4);
    c += x[k] * cos(2.0 * pi * frequency * k / rate + 0.4);
  }
  *amplitude = 2.0 * hypot(s, c) / count;
  *phase = atan2(c, s);
}

static void gain_and_phase_of_sines(void **state) {
  (void)state;
  static const double frequencies[] = {0.5, 3.0, 6.0, 9.0, 12.0, 25.0};
  for (int order = 2; order <= 8; order += 2) {
    for (int i = 0; i < 6; i++) {
      double amplitude, phase, wanted = gain(frequencies[i], 100.0, 6.0, order);
      pass_a_sine(frequencies[i], 100.0, 6.0, order, &amplitude, &phase);
      assert_close(amplitude, wanted, 1e-9);
      if (wanted > 1e-4) assert_close(phase, 0.0, 1e-7);
    }
    double amplitude, phase;
    pass_a_sine(6.0, 100.0, 6.0, order, &amplitude, &phase);
    assert_close(20.0 * log10(amplitude), -3.0103, 1e-5);
  }
}

/* constants and straight lines pass, edges included; columns do not mix */
static void lines_pass_unchanged(void **state) {
  (void)state;
  enum { ROWS = 120 };
  static double x[ROWS][3];
  for (int k = 0; k < ROWS; k++) {
    x[k][0] = 7.5;
    x[k][1] = 3.0 - 0.25 * k;
    x[k][2] = k == 60 ? 1.0 : 0.0;
  }
  assert_int_equal(ambulo__butterworth(&x[0][0], ROWS, 3, 200.0, 20.0, 4, NULL), AMBULO_OK);
  double sum = 0.0;
  for (int k = 0; k < ROWS; k++) {
    assert_close(x[k][0], 7.5, 1e-13);
    assert_close(x[k][1], 3.0 - 0.25 * k, 1e-5);
    sum += x[k][2];
    if (k < 60) assert_close(x[k][2], x[120 - k < ROWS ? 120 - k : ROWS - 1][2], 2e-6);
  }
  assert_close(sum, 1.0, 1e-6);
}

/* a sine of a tenth of the cut-off that ends in the middle of its swing */
static void edges_are_as_good_as_the_inside(void **state) {
  (void)state;
  enum { ROWS = 200 };
  double x[ROWS], worst = 0.0;
  for (int k = 0; k < ROWS; k++) x[k] = sin(2.0 * pi * 0.6 * k / 100.0);
  assert_int_equal(ambulo__butterworth(x, ROWS, 1, 100.0, 6.0, 4, NULL), AMBULO_OK);
  for (int k = 0; k < ROWS; k++) worst = fmax(worst, fabs(x[k] - sin(2.0 * pi * 0.6 * k / 100.0)));
  if (worst > 2.5e-3) print_error("off by %g\n", worst);
  assert_true(worst < 2.5e-3);
}

/* two rows are enough, and a cut-off close to half the rate */
static void small_and_extreme(void **state) {
  (void)state;
  double x[3] = {1.0, 2.0, 4.0};
  assert_int_equal(ambulo__butterworth(x, 2, 1, 100.0, 6.0, 8, NULL), AMBULO_OK);
  assert_close(x[0], 1.0, 1e-6);
  assert_close(x[1], 2.0, 1e-6);
  double y[50];
  for (int k = 0; k < 50; k++) y[k] = cos(0.3 * k);
  assert_int_equal(ambulo__butterworth(y, 50, 1, 100.0, 49.999, 4, NULL), AMBULO_OK);
  for (int k = 0; k < 50; k++) assert_close(y[k], cos(0.3 * k), 1e-6);
  assert_int_equal(ambulo__butterworth(x, 1, 1, 100.0, 6.0, 4, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__butterworth(x, 3, 1, 100.0, 50.0, 4, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__butterworth(x, 3, 1, 100.0, 0.0, 4, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__butterworth(x, 3, 1, (double)NAN, 6.0, 4, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__butterworth(x, 3, 1, 100.0, 6.0, 3, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__butterworth(x, 3, 1, 100.0, 6.0, 10, NULL), AMBULO_E_ARGUMENT);
  fail_alloc memory = fail_alloc_at(0);
  ambulo_allocator hook = fail_alloc_hook(&memory);
  double z[3] = {1.0, 2.0, 4.0};
  assert_int_equal(ambulo__butterworth(z, 3, 1, 100.0, 6.0, 4, &hook), AMBULO_E_MEMORY);
  assert_close(z[2], 4.0, 0.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gain_and_phase_of_sines), cmocka_unit_test(lines_pass_unchanged),
      cmocka_unit_test(edges_are_as_good_as_the_inside), cmocka_unit_test(small_and_extreme)};
  return cmocka_run_group_tests_name("trajectory/butterworth", tests, NULL, NULL);
}
