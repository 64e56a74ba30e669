/* Unknowns carried from one basis to another: what is contained is kept exactly. */
#include "support/fail_alloc.h"
#include "trajectory/basis_fixture.h"

enum { D = 3 };

/* largest difference of the orders 0..order of all D curves, at 401 times, relative to the
 * largest value of each order */
static double difference(const ambulo__basis *a, const double *x, const ambulo__basis *b,
                         const double *y, int order) {
  double worst = 0.0, error[3] = {0}, size[3] = {1e-300, 1e-300, 1e-300};
  for (int k = 0; k <= 400; k++) {
    double t = ambulo__basis_duration(a) * k / 400;
    ambulo__basis_point pa, pb;
    ambulo__basis_at(a, t, &pa);
    ambulo__basis_at(b, t, &pb);
    for (int o = 0; o <= order; o++) {
      for (int i = 0; i < D; i++) {
        double va = 0.0, vb = 0.0;
        for (int c = 0; c < pa.span; c++) va += pa.weight[o][c] * x[(pa.first + c) * D + i];
        for (int c = 0; c < pb.span; c++) vb += pb.weight[o][c] * y[(pb.first + c) * D + i];
        error[o] = fmax(error[o], fabs(va - vb));
        size[o] = fmax(size[o], fabs(va));
      }
    }
  }
  for (int o = 0; o <= order; o++) worst = fmax(worst, error[o] / size[o]);
  return worst;
}

static double transfer_error(const ambulo__basis *from, const ambulo__basis *to, int order) {
  static double x[400 * D], y[400 * D];
  fill_pseudo_random(x, ambulo__basis_control_points(from) * D, 17);
  assert_int_equal(ambulo__basis_transfer(from, x, to, y, D, NULL), AMBULO_OK);
  return difference(from, x, to, y, order);
}

static void knot_insertion_is_exact(void **state) {
  (void)state;
  const int steps[3][2] = {{12, 36}, {36, 72}, {72, 144}};
  for (int degree = 3; degree <= 7; degree++) {
    for (int s = 0; s < 3; s++) {
      ambulo__basis *from = make_basis(AMBULO__BSPLINE, degree, steps[s][0], 2.442, NULL);
      ambulo__basis *to = make_basis(AMBULO__BSPLINE, degree, steps[s][1], 2.442, NULL);
      assert_close(transfer_error(from, to, 2), 0.0, 1e-12);
      ambulo__basis_free(from);
      ambulo__basis_free(to);
    }
  }
}

static void knots_may_be_inserted_anywhere(void **state) {
  (void)state;
  const double finer[10] = {0.0, 0.05, 0.1, 0.3, 0.7, 0.72, 0.75, 1.6, 1.9, 2.0};
  ambulo__basis *from = make_basis(AMBULO__BSPLINE, 3, 5, 2.0, uneven_knots);
  ambulo__basis *to = make_basis(AMBULO__BSPLINE, 3, 9, 2.0, finer);
  assert_close(transfer_error(from, to, 2), 0.0, 1e-12);
  ambulo__basis_free(from);
  ambulo__basis_free(to);
}

static void inserted_control_points_stay_in_the_hull(void **state) {
  (void)state;
  ambulo__basis *from = make_basis(AMBULO__BSPLINE, 3, 12, 1.0, NULL);
  ambulo__basis *to = make_basis(AMBULO__BSPLINE, 3, 36, 1.0, NULL);
  double x[15], y[39], low = INFINITY, high = -INFINITY;
  fill_pseudo_random(x, 15, 2);
  for (int c = 0; c < 15; c++) {
    low = fmin(low, x[c]);
    high = fmax(high, x[c]);
  }
  assert_int_equal(ambulo__basis_transfer(from, x, to, y, 1, NULL), AMBULO_OK);
  for (int c = 0; c < 39; c++) assert_true(y[c] >= low - 1e-15 && y[c] <= high + 1e-15);
  assert_true(y[0] == x[0] && y[38] == x[14]);
  ambulo__basis_free(from);
  ambulo__basis_free(to);
}

static void a_basis_that_contains_the_source_keeps_it(void **state) {
  (void)state;
  ambulo__basis *spline = make_basis(AMBULO__BSPLINE, 3, 12, 2.442, NULL);
  ambulo__basis *same = make_basis(AMBULO__BSPLINE, 3, 12, 2.442, NULL);
  ambulo__basis *hermite = make_basis(AMBULO__HERMITE, 3, 24, 2.442, NULL);
  ambulo__basis *finer = make_basis(AMBULO__HERMITE, 3, 48, 2.442, NULL);
  assert_true(transfer_error(spline, same, 2) == 0.0);
  /* qdd of a cubic spline is continuous, so the Hermite curve has it too, at all times */
  assert_close(transfer_error(spline, hermite, 1), 0.0, 1e-11);
  assert_close(transfer_error(hermite, finer, 1), 0.0, 1e-11);
  ambulo__basis_free(spline);
  ambulo__basis_free(same);
  ambulo__basis_free(hermite);
  ambulo__basis_free(finer);
}

static void least_squares_reproduce_common_polynomials(void **state) {
  (void)state;
  ambulo__basis *from = make_basis(AMBULO__BSPLINE, 3, 7, 2.0, NULL);
  ambulo__basis *to = make_basis(AMBULO__BSPLINE, 5, 5, 2.0, uneven_knots);
  double line[10], fitted[10];
  for (int c = 0; c < 10; c++) {
    int is_value;
    line[c] = 2.0 - 3.0 * ambulo__basis_abscissa(from, c, &is_value);
  }
  assert_int_equal(ambulo__basis_transfer(from, line, to, fitted, 1, NULL), AMBULO_OK);
  for (double t = 0.0; t <= 2.0; t += 0.125) {
    assert_close(curve(to, fitted, t, 0), 2.0 - 3.0 * t, 1e-11);
    assert_close(curve(to, fitted, t, 1), -3.0, 1e-9);
  }
  ambulo__basis_free(from);
  ambulo__basis_free(to);
}

/* the residual of a least-squares fit is orthogonal to the target: transferring the result
 * back and forth changes nothing more */
static void least_squares_to_a_coarser_basis_are_a_projection(void **state) {
  (void)state;
  ambulo__basis *fine = make_basis(AMBULO__BSPLINE, 3, 24, 1.0, NULL);
  ambulo__basis *coarse = make_basis(AMBULO__BSPLINE, 3, 8, 1.0, NULL);
  double x[27], once[11], back[27], twice[11];
  for (int c = 0; c < 11; c++) once[c] = twice[c] = back[c] = NAN;
  fill_pseudo_random(x, 27, 4);
  assert_int_equal(ambulo__basis_transfer(fine, x, coarse, once, 1, NULL), AMBULO_OK);
  assert_int_equal(ambulo__basis_transfer(coarse, once, fine, back, 1, NULL), AMBULO_OK);
  assert_int_equal(ambulo__basis_transfer(fine, back, coarse, twice, 1, NULL), AMBULO_OK);
  for (int c = 0; c < 11; c++) assert_close(twice[c], once[c], 1e-12);
  ambulo__basis_free(fine);
  ambulo__basis_free(coarse);
}

static void central_differences_take_and_give_node_values(void **state) {
  (void)state;
  ambulo__basis *spline = make_basis(AMBULO__BSPLINE, 3, 6, 1.2, NULL);
  ambulo__basis *nodes = make_basis(AMBULO__CENTRAL_DIFFERENCE, 0, 12, 1.2, NULL);
  ambulo__basis *hermite = make_basis(AMBULO__HERMITE, 3, 12, 1.2, NULL);
  double x[9], y[15], z[26]; /* what targets held before does not matter */
  for (int i = 0; i < 15; i++) y[i] = NAN;
  for (int i = 0; i < 26; i++) z[i] = NAN;
  fill_pseudo_random(x, 9, 8);
  assert_int_equal(ambulo__basis_transfer(spline, x, nodes, y, 1, NULL), AMBULO_OK);
  for (int i = 0; i <= 12; i++) assert_close(y[i + 1], curve(spline, x, 0.1 * i, 0), 1e-14);
  assert_close(curve(nodes, y, 0.0, 1), curve(spline, x, 0.0, 1), 1e-12);
  assert_close(curve(nodes, y, 1.2, 1), curve(spline, x, 1.2, 1), 1e-12);
  assert_int_equal(ambulo__basis_transfer(nodes, y, hermite, z, 1, NULL), AMBULO_OK);
  for (int i = 0; i <= 12; i++) {
    assert_close(z[2 * i], y[i + 1], 1e-13);
    assert_close(z[2 * i + 1], 0.5 * (y[i + 2] - y[i]), 1e-13);
  }
  ambulo__basis_free(spline);
  ambulo__basis_free(nodes);
  ambulo__basis_free(hermite);
}

static void misuse_is_refused_and_leaves_the_target(void **state) {
  (void)state;
  ambulo__basis *from = make_basis(AMBULO__BSPLINE, 3, 4, 1.0, NULL);
  ambulo__basis *longer = make_basis(AMBULO__BSPLINE, 3, 4, 1.1, NULL);
  ambulo__basis *other = make_basis(AMBULO__BSPLINE, 4, 4, 1.0, NULL);
  double x[7] = {0}, y[8] = {5, 5, 5, 5, 5, 5, 5, 5};
  assert_int_equal(ambulo__basis_transfer(from, x, longer, y, 1, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo__basis_transfer(from, x, other, y, 0, NULL), AMBULO_E_ARGUMENT);
  x[3] = NAN;
  assert_int_equal(ambulo__basis_transfer(from, x, other, y, 1, NULL), AMBULO_E_NUMERIC);
  for (int c = 0; c < 8; c++) assert_true(y[c] == 5.0);
  ambulo__basis_free(from);
  ambulo__basis_free(longer);
  ambulo__basis_free(other);
}

static void every_failed_allocation_is_survived(void **state) {
  (void)state;
  ambulo__basis *from = make_basis(AMBULO__CENTRAL_DIFFERENCE, 0, 4, 1.0, NULL);
  ambulo__basis *to = make_basis(AMBULO__BSPLINE, 3, 4, 1.0, NULL);
  double x[7] = {1, 2, 3, 4, 5, 6, 7}, y[7];
  for (long k = 0;; k++) {
    assert_in_range(k, 0, 100);
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_status status = ambulo__basis_transfer(from, x, to, y, 1, &hook);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  ambulo__basis_free(from);
  ambulo__basis_free(to);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(knot_insertion_is_exact),
      cmocka_unit_test(knots_may_be_inserted_anywhere),
      cmocka_unit_test(inserted_control_points_stay_in_the_hull),
      cmocka_unit_test(a_basis_that_contains_the_source_keeps_it),
      cmocka_unit_test(least_squares_reproduce_common_polynomials),
      cmocka_unit_test(least_squares_to_a_coarser_basis_are_a_projection),
      cmocka_unit_test(central_differences_take_and_give_node_values),
      cmocka_unit_test(misuse_is_refused_and_leaves_the_target),
      cmocka_unit_test(every_failed_allocation_is_survived),
  };
  return cmocka_run_group_tests_name("trajectory/transfer", tests, NULL, NULL);
}
