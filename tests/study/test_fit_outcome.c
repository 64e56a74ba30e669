/* What is told of a fit: bounds, held-out conditions, endings. */
#include "study/fit_outcome.h"
#include "support/test.h"

static void bounds_and_held_out(void **state) {
  (void)state;
  ambulo__fit_parameter parameter[3] = {
      {.lower = -2.0, .upper = 3.0}, {.lower = -2.0, .upper = 3.0}, {.lower = -2.0, .upper = 3.0}};
  ambulo__fit_condition condition[3] = {
      {.weight = 1.0}, {.held_out = 1, .weight = 1.0}, {.held_out = 1, .weight = 3.0}};
  ambulo_fit fit = {
      .parameter = parameter, .parameters = 3, .condition = condition, .conditions = 3};
  double u[3] = {-2.0, 0.5, 3.0}, before[3] = {9.0, 4.0, 8.0}, after[3] = {1.0, NAN, NAN},
         apart[3] = {NAN, 2.0, 6.0};
  ambulo__fit_trial trial[4] = {{.apart = before}, {.u = u, .apart = after}, {.apart = apart}};
  ambulo__fit_outcome o = {.fit = &fit, .trial = trial};
  assert_int_equal(ambulo__fit_bound(&o, 0), -1);
  assert_int_equal(ambulo__fit_bound(&o, 1), 0);
  assert_int_equal(ambulo__fit_bound(&o, 2), 1);
  assert_ptr_equal(ambulo__fit_after(&o, 0), &trial[AMBULO__FIT_BEST]);
  assert_ptr_equal(ambulo__fit_after(&o, 2), &trial[AMBULO__FIT_APART]);
  assert_close(ambulo__fit_held_out(&o, 0), (4.0 + 24.0) / 4.0, 1e-15);
  assert_close(ambulo__fit_held_out(&o, 1), (2.0 + 18.0) / 4.0, 1e-15);
  fit.conditions = 1;
  assert_true(isnan(ambulo__fit_held_out(&o, 1)));
}

static void endings(void **state) {
  (void)state;
  assert_string_equal(ambulo__fit_ending_name(AMBULO_FIT_NOT_RUN), "not_run");
  assert_string_equal(ambulo__fit_ending_name(AMBULO_FIT_CONVERGED), "converged");
  assert_string_equal(ambulo__fit_ending_name(AMBULO_FIT_ITERATIONS), "iterations");
  assert_string_equal(ambulo__fit_ending_name(AMBULO_FIT_INTERRUPTED), "interrupted");
  assert_string_equal(ambulo__fit_ending_name(AMBULO_FIT_STUCK), "stuck");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(bounds_and_held_out),
                                     cmocka_unit_test(endings)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
