/* B-splines against what defines them: partition of unity, polynomials, smoothness. */
#include "trajectory/basis_fixture.h"

static void weights_sum_to_one_and_derivatives_to_zero(void **state) {
  (void)state;
  for (int degree = 3; degree <= 7; degree++) {
    ambulo__basis *basis = make_basis(AMBULO__BSPLINE, degree, 5, 2.0, uneven_knots);
    for (int k = 0; k <= 400; k++) {
      ambulo__basis_point point;
      ambulo__basis_at(basis, 0.005 * k, &point);
      for (int order = 0; order <= 3; order++) {
        double sum = 0.0, size = 1.0;
        for (int c = 0; c < AMBULO__MAX_SPAN; c++) {
          sum += point.weight[order][c];
          size += fabs(point.weight[order][c]);
          if (order == 0) assert_true(point.weight[0][c] >= 0.0);
        }
        assert_close(sum / size, order == 0 ? 1.0 / size : 0.0, 1e-14);
      }
    }
    ambulo__basis_free(basis);
  }
}

/* control points of t^power, power <= degree: the blossom, the mean of all products of
 * `power` different knots among c+1 .. c+degree */
static double monomial_control_point(int degree, int intervals, const double *breakpoints, int c,
                                     int power) {
  double symmetric[AMBULO__MAX_DEGREE + 1] = {1.0};
  double choose = 1.0;
  for (int k = 1; k <= degree; k++) {
    int at = c + k - degree;
    double knot = breakpoints[at < 0 ? 0 : at > intervals ? intervals : at];
    for (int p = k; p >= 1; p--) symmetric[p] += knot * symmetric[p - 1];
  }
  for (int p = 1; p <= power; p++) choose = choose * (degree + 1 - p) / p;
  return symmetric[power] / choose;
}

static void polynomials_up_to_the_degree_are_exact(void **state) {
  (void)state;
  for (int degree = 3; degree <= 7; degree++) {
    ambulo__basis *basis = make_basis(AMBULO__BSPLINE, degree, 5, 2.0, uneven_knots);
    for (int power = 0; power <= degree; power++) {
      double x[16];
      for (int c = 0; c < ambulo__basis_control_points(basis); c++) {
        x[c] = monomial_control_point(degree, 5, uneven_knots, c, power);
      }
      for (int k = 0; k <= 80; k++) {
        double t = 0.025 * k, factor = 1.0;
        for (int order = 0; order <= 3; order++) {
          double want = power >= order ? factor * pow(t, power - order) : 0.0;
          assert_close(curve(basis, x, t, order), want, order < 3 ? 2e-12 : 1e-9);
          factor *= power - order;
        }
      }
    }
    ambulo__basis_free(basis);
  }
}

static void derivatives_are_the_slopes_of_one_another(void **state) {
  (void)state;
  const double step = 1e-5;
  for (int degree = 3; degree <= 7; degree++) {
    ambulo__basis *basis = make_basis(AMBULO__BSPLINE, degree, 8, 2.4, NULL);
    double x[32];
    fill_pseudo_random(x, ambulo__basis_control_points(basis), 7);
    for (int k = 0; k < 50; k++) {
      double t = 0.0237 + 0.047 * k;
      for (int order = 0; order < 3; order++) {
        double slope =
            (curve(basis, x, t + step, order) - curve(basis, x, t - step, order)) / (2.0 * step);
        double size = fabs(curve(basis, x, t, order + 1)) + 100.0;
        assert_close((slope - curve(basis, x, t, order + 1)) / size, 0.0, 1e-6);
      }
    }
    ambulo__basis_free(basis);
  }
}

static void uniform_cubic_has_the_textbook_weights_at_breakpoints(void **state) {
  (void)state;
  ambulo__basis *basis = make_basis(AMBULO__BSPLINE, 3, 10, 2.5, NULL);
  const double h = 0.25, want[4][4] = {{1 / 6.0, 4 / 6.0, 1 / 6.0, 0},
                                       {-0.5 / h, 0, 0.5 / h, 0},
                                       {1 / (h * h), -2 / (h * h), 1 / (h * h), 0},
                                       {-1 / (h * h * h), 3 / (h * h * h), -3 / (h * h * h),
                                        1 / (h * h * h)}};
  ambulo__basis_point point;
  ambulo__basis_at(basis, 5 * h, &point);
  assert_int_equal(point.first, 5);
  assert_int_equal(point.jerk_first, 5);
  for (int order = 0; order <= 3; order++) {
    for (int c = 0; c < 4; c++) assert_close(point.weight[order][c], want[order][c], 1e-14);
  }
  ambulo__basis_free(basis);
}

static void curves_are_continuous_across_breakpoints(void **state) {
  (void)state;
  ambulo__basis *basis = make_basis(AMBULO__BSPLINE, 3, 5, 2.0, uneven_knots);
  double x[8];
  fill_pseudo_random(x, 8, 3);
  for (int i = 1; i < 5; i++) {
    double t = uneven_knots[i];
    for (int order = 0; order <= 2; order++) {
      double left = curve(basis, x, t - 1e-9, order), right = curve(basis, x, t + 1e-9, order);
      assert_close(left, right, 1e-4);
      assert_close(curve(basis, x, t, order), right, 1e-4);
    }
    assert_close(curve(basis, x, t, 3), curve(basis, x, t + 1e-9, 3), 1e-9);
  }
  ambulo__basis_free(basis);
}

static void motion_stays_in_the_hull_of_its_control_points(void **state) {
  (void)state;
  ambulo__basis *basis = make_basis(AMBULO__BSPLINE, 5, 12, 2.442, NULL);
  double x[17];
  for (unsigned seed = 1; seed <= 20; seed++) {
    fill_pseudo_random(x, 17, seed);
    for (int k = 0; k <= 500; k++) {
      double t = 2.442 * k / 500, low = INFINITY, high = -INFINITY;
      ambulo__basis_point point;
      ambulo__basis_at(basis, t, &point);
      for (int c = 0; c < point.span; c++) {
        low = fmin(low, x[point.first + c]);
        high = fmax(high, x[point.first + c]);
      }
      double q = curve(basis, x, t, 0);
      assert_true(q >= low - 1e-15 && q <= high + 1e-15);
    }
  }
  ambulo__basis_free(basis);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(weights_sum_to_one_and_derivatives_to_zero),
      cmocka_unit_test(polynomials_up_to_the_degree_are_exact),
      cmocka_unit_test(derivatives_are_the_slopes_of_one_another),
      cmocka_unit_test(uniform_cubic_has_the_textbook_weights_at_breakpoints),
      cmocka_unit_test(curves_are_continuous_across_breakpoints),
      cmocka_unit_test(motion_stays_in_the_hull_of_its_control_points),
  };
  return cmocka_run_group_tests_name("trajectory/bspline", tests, NULL, NULL);
}
