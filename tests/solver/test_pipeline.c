/* The method on one grid: NLopt's AUGLAG and L-BFGS are the same iteration; the yardstick's
 * optimum is met; the last steps leave no violation. */
#include "support/engine_fixture.h"

static double solve(ambulo__inner_kind kind, double *violation, int *evaluations) {
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  assert_int_equal(ambulo__pipeline(f.engine, kind, 0, f.x), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  double objective = f.engine->workspace->objective;
  *violation = fmax(ambulo__engine_equality_error(f.engine),
                    ambulo__engine_excess(f.engine, f.engine->held.excess));
  *evaluations = f.run.evaluations;
  engine_close(&f);
  return objective;
}

static void yardstick_reaches_its_optimum(void **state) {
  (void)state;
  double violation;
  int evaluations;
  double f = solve(AMBULO__INNER_AUGLAG, &violation, &evaluations);
  if (f > 0.38) print_error("f = %.6f after %d evaluations\n", f, evaluations);
  assert_true(f <= 0.38);
  assert_true(violation <= 1e-6);
  assert_true(evaluations < 400);
}

static void both_inner_solvers_agree(void **state) {
  (void)state;
  double violation[2];
  int evaluations[2];
  double a = solve(AMBULO__INNER_AUGLAG, &violation[0], &evaluations[0]);
  double b = solve(AMBULO__INNER_LBFGS, &violation[1], &evaluations[1]);
  assert_close(a, b, 1e-3);
  assert_true(violation[1] <= 1e-6);
}

static void polish_closes_what_is_left(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  f.options.feasibility_tolerance = 1e-3;
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__INNER_AUGLAG, 0, f.x), AMBULO_OK);
  f.options.feasibility_tolerance = 1e-8;
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  double before = f.engine->workspace->objective;
  assert_true(ambulo__engine_excess(f.engine, f.engine->held.excess) > 1e-8);
  assert_int_equal(ambulo__polish(f.engine, f.x), 1);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  assert_true(ambulo__engine_excess(f.engine, f.engine->held.excess) <= 1e-8);
  assert_close(f.engine->workspace->objective, before, 1e-2);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(yardstick_reaches_its_optimum),
                                     cmocka_unit_test(both_inner_solvers_agree),
                                     cmocka_unit_test(polish_closes_what_is_left)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
