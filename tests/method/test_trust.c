/* How far the model is trusted: damping and penalty after an inner solve. */
#include "method/parameters.h"
#include "method/trust.h"
#include "support/test.h"

/* what is reached, near a solution */
static double damp(ambulo__trust *t, double mu, double reached, double objective) {
  const ambulo__trial at = {.objective = objective, .violation = 1e-3};
  return ambulo__trust_damping(t, mu, reached, &at);
}

/* F = 10 at the chart; 1 was promised */
static ambulo__trust promised(double tried) {
  return (ambulo__trust){.damping = 0.1, .start = 10.0, .predicted = -1.0, .tried = tried};
}

static void damping_follows_the_promise(void **state) {
  (void)state;
  ambulo__trust kept = promised(9.0), timid = promised(9.0), bold = promised(9.95);
  assert_close(damp(&kept, 0.1, 9.0, 1.0), 0.1, 0.0);
  assert_close(damp(&timid, 0.1, 8.4, 1.0), 0.05, 1e-15);
  assert_close(damp(&timid, 0.004, 8.4, 1.0), 0.003, 1e-15); /* the least */
  assert_close(damp(&bold, 0.1, 9.0, 1.0), 0.2, 1e-15);
  assert_close(damp(&bold, 0.25, 9.0, 1.0), 0.3, 1e-15); /* the largest */
}

static void penalty_grows_after_whole_solves_alone(void **state) {
  (void)state;
  double limit = 3000.0;
  ambulo__trust t = promised(9.0);
  (void)damp(&t, 0.1, 9.0, 1.0);
  assert_close(ambulo__trust_penalty(&t, 1, 100.0, &limit), 2.0, 0.0);
  assert_close(ambulo__trust_penalty(&t, 1, 2000.0, &limit), 1.5, 1e-15); /* to its bound */
  assert_close(ambulo__trust_penalty(&t, 1, 4000.0, &limit), 1.0, 0.0);
  assert_close(ambulo__trust_penalty(&t, 0, 100.0, &limit), 1.0, 0.0);
  (void)damp(&t, 0.1, 9.51, 1.0);
  assert_close(ambulo__trust_penalty(&t, 1, 100.0, &limit), 1.0, 0.0);
  (void)damp(&t, 0.1, 9.49, 1.0);
  assert_close(ambulo__trust_penalty(&t, 1, 100.0, &limit), 2.0, 0.0);
}

/* three short solves in a row; one that is whole, or whose promise is rounding, begins anew */
static void a_stiff_penalty_falls(void **state) {
  (void)state;
  double limit = 30000.0;
  ambulo__trust t = promised(9.0);
  for (int k = 0; k < 2; k++) (void)damp(&t, 0.1, 9.9, 1.0);
  assert_close(ambulo__trust_penalty(&t, 1, 5000.0, &limit), 1.0, 0.0);
  (void)damp(&t, 0.1, 9.9, 1e6);
  for (int k = 0; k < AMBULO__SHORT_SOLVES; k++) (void)damp(&t, 0.1, 9.9, 1.0);
  assert_close(limit, 30000.0, 0.0);
  ambulo__trust weak = t;
  assert_close(ambulo__trust_penalty(&weak, 1, 100.0, &limit), 1.0, 0.0); /* it is not stiff */
  assert_close(ambulo__trust_penalty(&t, 1, 5000.0, &limit), 0.1, 1e-15);
  assert_close(limit, 3000.0, 0.0);
  assert_close(ambulo__trust_penalty(&t, 1, 500.0, &limit), 2.0, 0.0);
}

/* contradictory rows need a penalty that grows: far from a solution, and after some falls */
static void there_is_an_end_to_falls(void **state) {
  (void)state;
  double limit = 3000.0;
  const ambulo__trial far = {.objective = 1.0, .violation = 0.1};
  ambulo__trust t = promised(9.0);
  for (int k = 0; k < 10; k++) {
    (void)ambulo__trust_damping(&t, 0.1, 9.9, &far);
    assert_close(ambulo__trust_penalty(&t, 1, 500.0, &limit), 2.0, 0.0);
  }
  int falls = 0;
  for (int k = 0; k < 40; k++) {
    (void)damp(&t, 0.1, 9.9, 1.0);
    falls += ambulo__trust_penalty(&t, 1, 500.0, &limit) < 1.0;
  }
  assert_int_equal(falls, AMBULO__PENALTY_FALLS);
  assert_close(ambulo__trust_penalty(&t, 1, 500.0, &limit), 2.0, 0.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(damping_follows_the_promise),
                                     cmocka_unit_test(penalty_grows_after_whole_solves_alone),
                                     cmocka_unit_test(a_stiff_penalty_falls),
                                     cmocka_unit_test(there_is_an_end_to_falls)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
