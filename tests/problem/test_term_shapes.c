/* Scalar functions of terms: squares, smoothed absolute value, power law; a form that is full. */
#include "base/lanes.h"
#include "problem/term.h"
#include "support/random_model.h"
#include "support/test.h"

/* what finds no room is no part that may be missing: the residual has no value any more */
static void a_full_form_has_no_value(void **state) {
  (void)state;
  ambulo__form form = {.u = 1.0};
  for (int c = 0; c < AMBULO__FORM_CHANNELS; c++) ambulo__form_add(&form, c, 0, 1.0);
  assert_int_equal(form.count, AMBULO__FORM_CHANNELS);
  assert_close(form.u, 1.0, 0.0);
  ambulo__form_add(&form, 0, 0, 1.0);
  assert_int_equal(form.count, AMBULO__FORM_CHANNELS);
  assert_true(isnan(form.u));
}

/* The scalar functions: squares, smoothed absolute value, power law. */

static void values_by_hand(void **state) {
  (void)state;
  ambulo__residual r = ambulo__absolute(-3.0, 4.0);
  assert_close(r.value, 1.0, 1e-15);
  assert_close(r.slope, -0.6, 1e-15);
  assert_close(r.curvature, 0.2, 1e-15);
  r = ambulo__absolute(0.0, 0.5);
  assert_close(r.value, 0.0, 0.0);
  assert_close(r.slope, 0.0, 0.0);
  assert_close(r.curvature, 2.0, 1e-15);
}

static void it_tends_to_the_absolute_value(void **state) {
  (void)state;
  assert_close(ambulo__absolute(-7.0, 1e-6).value, 7.0, 1e-6);
  assert_close(ambulo__absolute(1e200, 1.0).value, 1e200, 1e-15);
}

/* 1e-9^2 / (2 s): the plain formula would lose every digit */
static void small_arguments_keep_their_digits(void **state) {
  (void)state;
  assert_close(ambulo__absolute(1e-9, 1.0).value * 1e18, 0.5, 1e-12);
}

static void the_slope_is_the_derivative(void **state) {
  (void)state;
  for (double u = -2.0; u < 2.0; u += 0.37) {
    double h = 1e-6, s = 0.3;
    double numeric =
        (ambulo__absolute(u + h, s).value - ambulo__absolute(u - h, s).value) / (2.0 * h);
    assert_close(ambulo__absolute(u, s).slope, numeric, 1e-8);
  }
}

/* phi(v) <= phi(u) + phi'(u) (v - u) + curvature (v - u)^2 / 2 */
static void the_parabola_lies_above(void **state) {
  (void)state;
  ambulo__residual r = ambulo__absolute(1.1, 0.2);
  for (double v = -3.0; v < 3.0; v += 0.1) {
    double step = v - 1.1;
    double parabola = r.value + r.slope * step + 0.5 * r.curvature * step * step;
    assert_true(ambulo__absolute(v, 0.2).value <= parabola + 1e-12);
  }
}

/* positive at 1, negative at n, smooth between: by hand, by differences, below its parabola */
static void negative_may_have_a_price_of_its_own(void **state) {
  (void)state;
  ambulo__residual r = ambulo__two_prices(-3.0, 4.0, 0.25),
                   one = ambulo__two_prices(-3.0, 4.0, 1.0);
  assert_close(r.value, 0.625 * 1.0 - 0.375 * 3.0, 1e-15);
  assert_close(r.slope, 0.625 * -0.6 + 0.375, 1e-15);
  assert_close(r.curvature, 0.625 * 0.2, 1e-15);
  assert_close(one.value, ambulo__absolute(-3.0, 4.0).value, 0.0);
  assert_close(one.slope, -0.6, 1e-15);
  assert_close(ambulo__two_prices(7.0, 1e-6, 0.3).value, 7.0, 1e-5);
  assert_close(ambulo__two_prices(-7.0, 1e-6, 0.3).value, 2.1, 1e-5);
  assert_close(ambulo__two_prices(0.0, 0.5, 0.3).value, 0.0, 0.0);
  r = ambulo__two_prices(1.1, 0.2, 0.3);
  for (double v = -3.0; v < 3.0; v += 0.1) {
    double h = 1e-6, step = v - 1.1, plus = ambulo__two_prices(v + h, 0.2, 0.3).value;
    double numeric = (plus - ambulo__two_prices(v - h, 0.2, 0.3).value) / (2.0 * h);
    ambulo__residual at = ambulo__two_prices(v, 0.2, 0.3);
    assert_close(at.slope, numeric, 1e-8);
    assert_true(at.value <= r.value + r.slope * step + 0.5 * r.curvature * step * step + 1e-12);
  }
}

static void squares(void **state) {
  (void)state;
  ambulo__residual r = ambulo__squared(-3.0);
  assert_close(r.value, 9.0, 0.0);
  assert_close(r.slope, -6.0, 0.0);
  assert_close(r.curvature, 2.0, 0.0);
}

static void power_laws_by_hand_and_by_differences(void **state) {
  (void)state;
  /* (3^2 + 4^2)^(3/2) - 4^3 = 125 - 64 */
  assert_close(ambulo__power_law(3.0, 3.0, 4.0, 64.0).value, 61.0, 1e-15);
  assert_close(ambulo__power_law(3.0, 2.0, 4.0, 16.0).value, 9.0, 1e-14);
  for (double power = 2.0; power < 5.0; power += 0.5) {
    for (double u = -1.5; u < 1.5; u += 0.29) {
      double h = 1e-6, s = 0.2;
      ambulo__residual r = ambulo__power_law(u, power, s, ambulo__power_least(power, s));
      ambulo__residual a = ambulo__power_law(u - h, power, s, ambulo__power_least(power, s));
      ambulo__residual b = ambulo__power_law(u + h, power, s, ambulo__power_least(power, s));
      assert_close(r.slope, (b.value - a.value) / (2.0 * h), 1e-8);
      assert_close(r.curvature, (b.slope - a.slope) / (2.0 * h), 1e-8);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(negative_may_have_a_price_of_its_own),
                                     cmocka_unit_test(squares),
                                     cmocka_unit_test(power_laws_by_hand_and_by_differences),
                                     cmocka_unit_test(values_by_hand),
                                     cmocka_unit_test(it_tends_to_the_absolute_value),
                                     cmocka_unit_test(small_arguments_keep_their_digits),
                                     cmocka_unit_test(the_slope_is_the_derivative),
                                     cmocka_unit_test(the_parabola_lies_above),
                                     cmocka_unit_test(a_full_form_has_no_value)};
  return cmocka_run_group_tests_name("problem/term_shapes", tests, NULL, NULL);
}
