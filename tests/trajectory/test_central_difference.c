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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nodes_follow_the_equations),
      cmocka_unit_test(between_nodes_maps_are_blended),
      cmocka_unit_test(abscissas_are_node_times_with_ghosts_outside),
  };
  return cmocka_run_group_tests_name("trajectory/central_difference", tests, NULL, NULL);
}
