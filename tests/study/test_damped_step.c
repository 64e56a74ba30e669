/* The damped step: the normal equations hold, parameters that are not free stand still. */
#include "study/damped_step.h"
#include "support/fail_alloc.h"
#include "support/test.h"

enum { M = 6, N = 3 };
static const double jacobian[M * N] = {1.0, 0.5,  -2.0, 0.3, 0.0, 1.1, -0.7, 2.0, 0.4,
                                       0.9, -1.2, 0.2,  0.1, 0.8, 1.5, -0.6, 0.3, 2.2};
static const double residual[M] = {0.4, -1.0, 0.7, 0.2, 1.3, -0.5}, u[N] = {0.5, -0.25, 1.0};

/* J'(r + J d) + ridge (u + d) + lambda d = 0 at the free ones */
static void check(const unsigned char *is_free, double ridge, double damping) {
  ambulo__damped_system s = {M, N, jacobian, residual, u, is_free, ridge};
  double d[N], left[M], trace = 0.0;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator usual = fail_alloc_hook(&memory);
  assert_int_equal(ambulo__damped_step(&s, damping, &usual, d), AMBULO_OK);
  for (int k = 0; k < M; k++) left[k] = residual[k];
  for (int i = 0; i < N; i++)
    for (int k = 0; k < M; k++) {
      left[k] += jacobian[i * M + k] * d[i];
      trace += jacobian[i * M + k] * jacobian[i * M + k];
    }
  for (int i = 0; i < N; i++) {
    double slope = ridge * (u[i] + d[i]) + damping * trace / N * d[i];
    for (int k = 0; k < M; k++) slope += jacobian[i * M + k] * left[k];
    if (is_free[i])
      assert_close(slope, 0.0, 1e-12);
    else
      assert_true(d[i] == 0.0);
  }
}

static void normal_equations(void **state) {
  (void)state;
  check((const unsigned char[]){1, 1, 1}, 0.0, 0.0);
  check((const unsigned char[]){1, 1, 1}, 0.3, 0.02);
  check((const unsigned char[]){1, 0, 1}, 0.3, 0.5);
  check((const unsigned char[]){0, 0, 0}, 0.3, 0.5);
}

/* a parameter without any effect, and neither ridge nor damping */
static void singular(void **state) {
  (void)state;
  double none[M * N] = {1.0, 2.0, 3.0}, d[N];
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator usual = fail_alloc_hook(&memory);
  const unsigned char is_free[] = {1, 1, 1};
  ambulo__damped_system s = {M, N, none, residual, u, is_free, 0.0};
  assert_int_equal(ambulo__damped_step(&s, 0.0, &usual, d), AMBULO_E_NUMERIC);
  assert_int_equal(ambulo__damped_step(&s, 0.1, &usual, d), AMBULO_OK);
  assert_close(d[1], 0.0, 1e-14);
}

static void memory(void **state) {
  (void)state;
  const unsigned char is_free[] = {1, 1, 1};
  ambulo__damped_system s = {M, N, jacobian, residual, u, is_free, 0.1};
  double d[N];
  for (long k = 0; k < 4; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_status status = ambulo__damped_step(&s, 0.1, &allocator, d);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(normal_equations), cmocka_unit_test(singular),
                                     cmocka_unit_test(memory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
