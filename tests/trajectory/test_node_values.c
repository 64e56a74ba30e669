/* Central differences against Eqs. (18) and (19), written out. */
#include "trajectory/basis_fixture.h"

static void nodes_follow_the_equations(void **state) {
  (void)state;
  const int last = 9;
  const double duration = 1.8, h = duration / last;
  ambulo__basis *basis = make_basis(AMBULO__CENTRAL_DIFFERENCE, 0, last, duration, NULL);
  double x[12];
  fill_pseudo_random(x, 12, 5);
  const double *q = x + 1; /* q[-1] is the ghost */
  for (int i = 0; i <= last; i++) {
    double t = i * h;
    assert_true(curve(basis, x, t, 0) == q[i]);
    assert_close(curve(basis, x, t, 1), (q[i + 1] - q[i - 1]) / (2 * h), 1e-14);
    assert_close(curve(basis, x, t, 2), (q[i + 1] - 2 * q[i] + q[i - 1]) / (h * h), 1e-13);
    assert_true(curve(basis, x, t, 3) == 0.0);
  }
  ambulo__basis_free(basis);
}

static void between_nodes_maps_are_blended(void **state) {
  (void)state;
  ambulo__basis *basis = make_basis(AMBULO__CENTRAL_DIFFERENCE, 0, 4, 1.0, NULL);
  double x[7];
  fill_pseudo_random(x, 7, 6);
  for (int i = 0; i < 4; i++) {
    for (int order = 0; order <= 2; order++) {
      double left = curve(basis, x, 0.25 * i, order);
      double right = curve(basis, x, 0.25 * (i + 1), order);
      double got = curve(basis, x, 0.25 * (i + 0.3), order);
      assert_close(got, 0.7 * left + 0.3 * right, 1e-13);
    }
  }
  ambulo__basis_free(basis);
}

static void abscissas_are_node_times_with_ghosts_outside(void **state) {
  (void)state;
  ambulo__basis *basis = make_basis(AMBULO__CENTRAL_DIFFERENCE, 0, 4, 1.0, NULL);
  for (int c = 0; c < 7; c++) {
    int is_value = 0;
    assert_close(ambulo__basis_abscissa(basis, c, &is_value), 0.25 * (c - 1), 1e-15);
    assert_int_equal(is_value, 1);
  }
  ambulo__basis_free(basis);
}

static int test_central_difference_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nodes_follow_the_equations),
      cmocka_unit_test(between_nodes_maps_are_blended),
      cmocka_unit_test(abscissas_are_node_times_with_ghosts_outside),
  };
  return cmocka_run_group_tests_name("trajectory/central_difference", tests, NULL, NULL);
}

/* Cubic Hermite interpolation against Eqs. (20) to (22), written out. */

enum { LAST = 6 };
static const double duration = 1.5, h = 1.5 / LAST;

static void test_hermite_nodes_follow_the_equations(void **state) {
  (void)state;
  ambulo__basis *basis = make_basis(AMBULO__HERMITE, 0, LAST, duration, NULL);
  double x[2 * (LAST + 1)];
  fill_pseudo_random(x, 2 * (LAST + 1), 9);
  for (int i = 0; i <= LAST; i++) {
    double t = duration * i / LAST;
    assert_close(curve(basis, x, t, 0), x[2 * i], 1e-15);
    assert_close(curve(basis, x, t, 1), x[2 * i + 1] / h, 1e-13);
    if (i == LAST) continue;
    double q = x[2 * i], qd = x[2 * i + 1] / h, next = x[2 * i + 2], next_qd = x[2 * i + 3] / h;
    double want = 2 / (h * h) * (-3 * q + 3 * next - 2 * h * qd - h * next_qd);
    assert_close(curve(basis, x, t, 2), want, 1e-13);
  }
  ambulo__basis_free(basis);
}

static void the_last_node_takes_the_interval_to_its_left(void **state) {
  (void)state;
  ambulo__basis *basis = make_basis(AMBULO__HERMITE, 0, LAST, duration, NULL);
  double x[2 * (LAST + 1)];
  fill_pseudo_random(x, 2 * (LAST + 1), 10);
  double c2 = -3 * x[10] - 2 * x[11] + 3 * x[12] - x[13];
  double c3 = 2 * x[10] + x[11] - 2 * x[12] + x[13];
  assert_close(curve(basis, x, duration, 2), (2 * c2 + 6 * c3) / (h * h), 1e-13);
  assert_close(curve(basis, x, duration, 3), 6 * c3 / (h * h * h), 1e-13);
  ambulo__basis_free(basis);
}

static void cubics_are_exact_everywhere(void **state) {
  (void)state;
  ambulo__basis *basis = make_basis(AMBULO__HERMITE, 0, LAST, duration, NULL);
  double x[2 * (LAST + 1)];
  for (int i = 0; i <= LAST; i++) {
    double t = duration * i / LAST;
    x[2 * i] = 1 - 2 * t + t * t * (3 - t);
    x[2 * i + 1] = h * (-2 + 6 * t - 3 * t * t);
  }
  for (int k = 0; k <= 90; k++) {
    double t = duration * k / 90;
    assert_close(curve(basis, x, t, 0), 1 - 2 * t + t * t * (3 - t), 1e-14);
    assert_close(curve(basis, x, t, 1), -2 + 6 * t - 3 * t * t, 1e-13);
    assert_close(curve(basis, x, t, 2), 6 - 6 * t, 1e-12);
    assert_close(curve(basis, x, t, 3), -6, 1e-11);
  }
  ambulo__basis_free(basis);
}

static void abscissas_tell_values_from_rates(void **state) {
  (void)state;
  ambulo__basis *basis = make_basis(AMBULO__HERMITE, 0, LAST, duration, NULL);
  for (int c = 0; c < 2 * (LAST + 1); c++) {
    int is_value = -1;
    assert_close(ambulo__basis_abscissa(basis, c, &is_value), h * (c / 2), 1e-15);
    assert_int_equal(is_value, c % 2 == 0);
  }
  ambulo__basis_free(basis);
}

static int test_hermite_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_hermite_nodes_follow_the_equations),
      cmocka_unit_test(the_last_node_takes_the_interval_to_its_left),
      cmocka_unit_test(cubics_are_exact_everywhere),
      cmocka_unit_test(abscissas_tell_values_from_rates),
  };
  return cmocka_run_group_tests_name("trajectory/hermite", tests, NULL, NULL);
}

int main(void) {
  return test_central_difference_tests() + test_hermite_tests();
}
