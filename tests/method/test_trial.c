/* A point and all that belongs to it, copied. */
#include "method/trial.h"
#include "support/fail_alloc.h"
#include "support/test.h"

enum { N = 5, INEQUALITIES = 3, EQUALITIES = 2 };

static void a_copy_has_everything(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__trial from, to;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__trial_create(N, INEQUALITIES, EQUALITIES, &pool, &from), AMBULO_OK);
  assert_int_equal(ambulo__trial_create(N, INEQUALITIES, EQUALITIES, &pool, &to), AMBULO_OK);
  assert_true(from.value == HUGE_VAL);
  for (int j = 0; j < N; j++) from.x[j] = 1.0 + j;
  for (int i = 0; i < INEQUALITIES; i++) {
    from.excess[i] = -1.0 - i;
    from.multiplier[i] = 10.0 + i;
  }
  for (int i = 0; i < EQUALITIES; i++) from.equality_multiplier[i] = 20.0 + i;
  from.value = 1.5;
  from.objective = 2.5;
  from.violation = 3.5;
  from.gradient_norm = 4.5;
  ambulo__trial_copy(&from, &to);
  assert_memory_equal(to.x, from.x, sizeof(double) * N);
  assert_memory_equal(to.excess, from.excess, sizeof(double) * INEQUALITIES);
  assert_memory_equal(to.multiplier, from.multiplier, sizeof(double) * INEQUALITIES);
  assert_memory_equal(to.equality_multiplier, from.equality_multiplier,
                      sizeof(double) * EQUALITIES);
  assert_true(to.x != from.x && to.value == 1.5 && to.objective == 2.5);
  assert_true(to.violation == 3.5 && to.gradient_norm == 4.5);
  ambulo__pool_clear(&pool);
}

static void memory_that_is_out_is_told(void **state) {
  (void)state;
  for (long k = 0; k < 5; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__pool pool;
    ambulo__trial trial;
    ambulo__pool_init(&pool, &hook);
    assert_int_equal(ambulo__trial_create(N, INEQUALITIES, EQUALITIES, &pool, &trial),
                     k < 4 ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__pool_clear(&pool);
    assert_int_equal(memory.live, 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_copy_has_everything),
                                     cmocka_unit_test(memory_that_is_out_is_told)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
