/* Mixing solves a linear fixed-point problem that plain iteration does not. */
#include "linear/mixing.h"
#include "support/test.h"

enum { N = 3 };

/* x <- x - r(x), r = A x - b, with an A for which that diverges */
static void residual(const double *x, double *r) {
  static const double a[N][N] = {{3.0, 0.2, 0.0}, {0.1, 2.5, 0.3}, {0.0, -0.2, 0.4}};
  static const double b[N] = {1.0, 2.0, 3.0};
  for (int i = 0; i < N; i++) {
    r[i] = -b[i];
    for (int j = 0; j < N; j++) r[i] += a[i][j] * x[j];
  }
}

static double size(const double *r) {
  return fabs(r[0]) + fabs(r[1]) + fabs(r[2]);
}

static void linear_problem_is_solved_in_a_few_steps(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mixing mixing;
  double x[N] = {0.0}, r[N];
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mixing_create(&pool, N, N, &mixing), AMBULO_OK);
  ambulo__mixing_reset(&mixing);
  for (int k = 0; k < 8; k++) {
    residual(x, r);
    for (int i = 0; i < N; i++) x[i] -= r[i];
    ambulo__mixing_apply(&mixing, r, x);
  }
  residual(x, r);
  assert_close(size(r), 0.0, 1e-9);
  ambulo__pool_clear(&pool);
}

static void repeated_residual_leaves_the_image_finite(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mixing mixing;
  double r[N] = {1.0, 1.0, 1.0};
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mixing_create(&pool, N, N, &mixing), AMBULO_OK);
  for (int k = 0; k < 4; k++) {
    double image[N] = {1.0, 2.0, 3.0};
    ambulo__mixing_apply(&mixing, r, image);
    assert_close(image[2], 3.0, 1e-12);
  }
  ambulo__pool_clear(&pool);
}

/* all differences point the same way: the secant all the same */
static void parallel_residuals_are_extrapolated(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mixing mixing;
  double image[N] = {0.0};
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mixing_create(&pool, N, N, &mixing), AMBULO_OK);
  for (int k = 0; k < 3; k++) {
    double r[N] = {1.0 - 0.1 * k, 0.5, 2.0 - 0.2 * k};
    for (int i = 0; i < N; i++) image[i] = k + 1.0;
    ambulo__mixing_apply(&mixing, r, image);
  }
  for (int i = 0; i < N; i++) assert_close(image[i], 11.0, 1e-3);
  ambulo__pool_clear(&pool);
}

/* the newest pairs are kept, none after a reset */
static void the_oldest_pair_gives_way(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mixing mixing;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mixing_create(&pool, N, N, &mixing), AMBULO_OK);
  for (int k = 0; k <= AMBULO__MIXING_DEPTH; k++) {
    double r[N] = {k + 1.0, cos(k), sin(k)}, image[N] = {k, k, k};
    ambulo__mixing_apply(&mixing, r, image);
  }
  assert_int_equal(mixing.count, AMBULO__MIXING_DEPTH);
  for (int slot = 0; slot < AMBULO__MIXING_DEPTH; slot++)
    assert_true(mixing.residual[slot][0] == (slot ? slot + 1.0 : AMBULO__MIXING_DEPTH + 1.0));
  double r[N] = {0.3, 0.2, 0.1}, image[N] = {5.0, 6.0, 7.0};
  ambulo__mixing_reset(&mixing);
  ambulo__mixing_apply(&mixing, r, image);
  assert_true(image[0] == 5.0 && image[1] == 6.0 && image[2] == 7.0);
  assert_int_equal(mixing.count, 1);
  ambulo__pool_clear(&pool);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(linear_problem_is_solved_in_a_few_steps),
      cmocka_unit_test(repeated_residual_leaves_the_image_finite),
      cmocka_unit_test(parallel_residuals_are_extrapolated),
      cmocka_unit_test(the_oldest_pair_gives_way),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
