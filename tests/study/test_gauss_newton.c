/* Gauss-Newton on residuals by formula: where it ends, jumps, bounds, failures, stops, memory. */
#include "support/fit_task.h"

static ambulo_fit_ending run(fit_made_up *w, ambulo__fit_trial *best, double sensitivity[2],
                             int *stuck) {
  ambulo_fit_ending ending = AMBULO_FIT_ITERATIONS;
  assert_int_equal(ambulo__fit_gauss_newton(&w->task, best, sensitivity, &ending, stuck),
                   AMBULO_OK);
  return ending;
}

static void a_curved_valley(void **state) {
  (void)state;
  fit_made_up w = {.scale = 5.0};
  ambulo__fit_trial *best;
  double sensitivity[2];
  int stuck;
  fit_made_up_open(&w, &best);
  assert_int_equal(run(&w, best, sensitivity, &stuck), AMBULO_FIT_CONVERGED);
  assert_close(best->u[0], 1.0, 0.01);
  assert_close(best->u[1], 1.0, 0.01);
  assert_int_equal(stuck, -1);
  assert_true(w.refreshed > 0);
  /* |dr/du| at (1, 1): (-20, -1, 0.3) / 5 and (10, 0, 0.3) / 5, by differences */
  assert_close(sensitivity[0], sqrt(400.0 + 1.0 + 0.09) / 5.0, 0.1);
  assert_close(sensitivity[1], sqrt(100.0 + 0.09) / 5.0, 0.1);
  fit_made_up_close(&w, best);
}

static void a_ridge_holds_back(void **state) {
  (void)state;
  fit_made_up w = {.scale = 5.0};
  ambulo__fit_trial *best;
  double sensitivity[2];
  int stuck;
  fit_made_up_open(&w, &best);
  w.task.ridge = 10.0;
  (void)run(&w, best, sensitivity, &stuck);
  assert_true(fabs(best->u[0]) < 0.1);
  assert_close(best->cost,
               best->distance + 5.0 * (best->u[0] * best->u[0] + best->u[1] * best->u[1]), 1e-12);
  fit_made_up_close(&w, best);
}

static void bounds_hold(void **state) {
  (void)state;
  fit_made_up w = {.scale = 5.0, .lower = {-0.1, -3.0}, .upper = {0.5, 3.0}};
  ambulo__fit_trial *best;
  double sensitivity[2];
  int stuck;
  fit_made_up_open(&w, &best);
  (void)run(&w, best, sensitivity, &stuck);
  assert_close(best->u[0], 0.5, 1e-9);
  assert_close(best->u[1], 0.25, 0.02);
  fit_made_up_close(&w, best);
}

/* the valley beyond the wall is no derivative of this one */
static void a_jump_is_tried_on_the_other_side(void **state) {
  (void)state;
  fit_made_up w = {.scale = 50.0, .wall = 0.2};
  ambulo__fit_trial *best;
  double sensitivity[2];
  int stuck;
  fit_made_up_open(&w, &best);
  w.task.iterations = 1;
  double before = best->cost;
  (void)run(&w, best, sensitivity, &stuck);
  assert_true(best->u[0] <= 0.2);
  assert_true(best->cost < before);
  /* u_0 up is a jump: what was measured is the slope to the other side, (10, 1, -0.3) / 50 */
  assert_close(sensitivity[0], sqrt(100.0 + 1.0 + 0.09) / 50.0, 1e-9);
  assert_int_equal(w.dropped, 0);
  fit_made_up_close(&w, best);
}

static void failures_are_jumps(void **state) {
  (void)state;
  fit_made_up w = {.scale = 5.0, .fails = 1};
  ambulo__fit_trial *best;
  double sensitivity[2];
  int stuck;
  fit_made_up_open(&w, &best);
  (void)run(&w, best, sensitivity, &stuck);
  assert_true(best->u[0] == 0.0 && best->u[1] == 0.0);
  assert_true(w.dropped >= 2);
  assert_int_equal(stuck, -1); /* it is solved where the fit stands */
  fit_made_up_close(&w, best);
}

static void a_condition_that_is_never_solved(void **state) {
  (void)state;
  fit_made_up w = {.scale = 5.0, .fails = 2};
  ambulo__fit_trial *best;
  double sensitivity[2];
  int stuck;
  fit_made_up_open(&w, &best);
  assert_int_equal(run(&w, best, sensitivity, &stuck), AMBULO_FIT_STUCK);
  assert_int_equal(stuck, 1);
  assert_int_equal(w.rounds, 1);
  fit_made_up_close(&w, best);
}

static void a_stop_keeps_the_best(void **state) {
  (void)state;
  for (int at = 1; at < 14; at++) {
    fit_made_up w = {.scale = 5.0, .stop_at = at};
    ambulo__fit_trial *best;
    double sensitivity[2];
    int stuck;
    fit_made_up_open(&w, &best);
    double before = best->cost;
    assert_int_equal(run(&w, best, sensitivity, &stuck), AMBULO_FIT_INTERRUPTED);
    assert_int_equal(w.evaluated, at);
    assert_true(best->cost <= before);
    fit_made_up_close(&w, best);
  }
}

static void no_iteration(void **state) {
  (void)state;
  fit_made_up w = {.scale = 5.0};
  ambulo__fit_trial *best;
  double sensitivity[2];
  int stuck;
  fit_made_up_open(&w, &best);
  w.task.iterations = 0;
  assert_int_equal(run(&w, best, sensitivity, &stuck), AMBULO_FIT_ITERATIONS);
  assert_int_equal(w.evaluated, 0);
  assert_true(isnan(sensitivity[0]));
  fit_made_up_close(&w, best);
}

static void memory_may_give_out(void **state) {
  (void)state;
  int rounds = 0;
  for (long k = 0; k < 1000; k++, rounds++) {
    fit_made_up w = {.scale = 5.0};
    ambulo__fit_trial *best;
    double sensitivity[2];
    int stuck;
    ambulo_fit_ending ending;
    fit_made_up_open(&w, &best);
    w.memory.fail_at = w.memory.requests + k;
    ambulo_status status = ambulo__fit_gauss_newton(&w.task, best, sensitivity, &ending, &stuck);
    int failed = w.memory.failed;
    assert_int_equal(status, failed ? AMBULO_E_MEMORY : AMBULO_OK);
    fit_made_up_close(&w, best);
    if (!failed) break;
  }
  assert_true(rounds > 8);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_curved_valley),       cmocka_unit_test(a_ridge_holds_back),
      cmocka_unit_test(bounds_hold),           cmocka_unit_test(a_jump_is_tried_on_the_other_side),
      cmocka_unit_test(failures_are_jumps),    cmocka_unit_test(a_condition_that_is_never_solved),
      cmocka_unit_test(a_stop_keeps_the_best), cmocka_unit_test(no_iteration),
      cmocka_unit_test(memory_may_give_out),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
