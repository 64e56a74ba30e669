/* Sine and cosine of the kernels against libm in extended precision: absolute errors in units of
 * 2^-52. The width is fixed here; the other widths run the same source, and are compared
 * elsewhere. */
#define AMBULO__WIDTH 2
#include "mechanics/kernel_sincos.h"
#include <float.h>

#include "support/random_model.h"
#include "support/test.h"

static double units(double got, long double want) {
  return (double)(fabsl(got - want) / (long double)DBL_EPSILON);
}

static void check_angle(double x) {
  wide angle = {x, -x}, sine, cosine;
  sincos_reduced(1, &angle, &sine, &cosine);
  double worst = fmax(units(sine[0], sinl(x)), units(cosine[0], cosl(x)));
  worst = fmax(worst, fmax(units(sine[1], -sinl(x)), units(cosine[1], cosl(x))));
  if (worst <= 1.8) return; /* 4e-16 */
  print_error("x = %.17g: sine %.17g and cosine %.17g are off by %.2f units\n", x, sine[0],
              cosine[0], worst);
  fail();
}

static void accurate_everywhere(void **state) {
  (void)state;
  static const double sizes[] = {1e-300, 1e-12, 1e-3, 0.8, 1, 3.2, 10, 1e3, 1e5};
  random_source source = {3};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
    for (int k = 0; k < 20000; k++) check_angle(random_between(&source, -sizes[i], sizes[i]));
  }
}

/* Where the reduction cancels most: the numbers next to multiples of 45
 * degrees. */
static void accurate_near_multiples_of_the_quarter(void **state) {
  (void)state;
  for (int k = 0; k < 120000; k++) {
    double x = (double)(k * (acosl(-1) / 4));
    if (x > AMBULO__SINCOS_LIMIT) break;
    check_angle(x);
    check_angle(nextafter(x, 0));
    check_angle(nextafter(x, 1e9));
  }
}

static void exact_at_zero(void **state) {
  (void)state;
  wide zero = {0.0, -0.0}, sine, cosine;
  sincos_reduced(1, &zero, &sine, &cosine);
  assert_true(sine[0] == 0 && sine[1] == 0);
  assert_true(cosine[0] == 1 && cosine[1] == 1);
}

/* What is left out for small angles changes nothing. */
static void small_angles_need_no_reduction(void **state) {
  (void)state;
  random_source source = {5};
  for (int k = 0; k < 20000; k++) {
    wide x[sincos_row], z[sincos_row], sine[sincos_row], cosine[sincos_row];
    for (int i = 0; i < sincos_row; i++) {
      x[i] = (wide){random_between(&source, -1.414, 1.414), k % 3 ? 1.4142 : 0};
      z[i] = x[i] * x[i];
    }
    assert_true(sincos_small(sincos_row, z));
    sincos_series(sincos_row, x, z, sine, cosine);
    for (int i = 0; i < sincos_row; i++) {
      wide s, c;
      sincos_reduced(1, &x[i], &s, &c);
      for (int lane = 0; lane < 2; lane++) {
        assert_true(s[lane] == sine[i][lane] && c[lane] == cosine[i][lane]);
      }
    }
  }
}

static void large_angles_are_not_small(void **state) {
  (void)state;
  static const double large[] = {1.415, -1.415, 2, -3, 1e5, 1e200, INFINITY, NAN};
  for (size_t i = 0; i < sizeof large / sizeof *large; i++) {
    for (int place = 0; place < 4; place++) {
      wide z[2] = {{0.5, 0.1}, {1, 1e-3}};
      z[place / 2][place % 2] = large[i] * large[i];
      assert_false(sincos_small(2, z));
    }
  }
}

static void range_shows_what_is_not_a_number(void **state) {
  (void)state;
  assert_true(sincos_inside((wide){1e10, 0}));
  assert_false(sincos_inside((wide){0, 1.1e10}));
  assert_false(sincos_inside((wide){INFINITY, 0}));
  assert_false(sincos_inside((wide){0, NAN}));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(accurate_everywhere),
                                     cmocka_unit_test(accurate_near_multiples_of_the_quarter),
                                     cmocka_unit_test(exact_at_zero),
                                     cmocka_unit_test(small_angles_need_no_reduction),
                                     cmocka_unit_test(large_angles_are_not_small),
                                     cmocka_unit_test(range_shows_what_is_not_a_number)};
  return cmocka_run_group_tests_name("mechanics/kernel_sincos", tests, NULL, NULL);
}
