/* The search on residuals by formula: where it ends, bounds, failures, stops, memory. */
#include "support/fit_task.h"

static ambulo_fit_ending run(fit_made_up *w, ambulo__fit_trial *best, double sensitivity[2],
                             int *stuck) {
  ambulo_fit_ending ending = AMBULO_FIT_ITERATIONS;
  assert_int_equal(ambulo__fit_search(&w->task, best, sensitivity, &ending, stuck), AMBULO_OK);
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
  assert_int_equal(w.dropped, 0); /* although the start has a condition that the others lack */
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
  w.fit.ridge = 10.0;
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

/* Residuals that are linear: the model is exact but for its damping, at least 0.2 * 0.03 of the
 * mean square of the columns, and one iteration ends at the least cost. */
static void linear_residuals_take_one_iteration(void **state) {
  (void)state;
  static const struct {
    double ridge, upper, least[2];
  } cases[] = {
      {0.0, 8.0, {1.0, 1.0}},
      {4.0, 8.0, {0.5, 0.5}},          /* 2 (u_0 + u_1 - 2) + 4 u_0 = 0, u_0 = u_1 */
      {0.0, 0.5, {0.5, 1.505 / 1.01}}, /* (u_1 - 1.5) + 0.01 (u_1 - 0.5) = 0 */
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    fit_made_up w = {.scale = 1.0, .linear = 1, .lower = {-8.0, -8.0}, .upper = {0.0, 8.0}};
    ambulo__fit_trial *best;
    double sensitivity[2];
    int stuck;
    w.upper[0] = cases[i].upper;
    fit_made_up_open(&w, &best);
    w.fit.iterations = 1;
    w.fit.ridge = cases[i].ridge;
    (void)run(&w, best, sensitivity, &stuck);
    assert_close(best->u[0], cases[i].least[0], 0.01);
    assert_close(best->u[1], cases[i].least[1], 0.01);
    assert_close(sensitivity[0], sqrt(1.01), 1e-9);
    fit_made_up_close(&w, best);
  }
}

/* A guard that holds at first has differences of 0. The model knows where it breaks, and the first
 * step ends there; with both residuals of the other condition at their least beside it. */
static void a_guard_that_holds_at_first(void **state) {
  (void)state;
  fit_made_up w = {.scale = 5.0, .linear = 1, .guarded = 1};
  ambulo__fit_trial *best;
  double sensitivity[2];
  int stuck;
  fit_made_up_open(&w, &best);
  w.fit.iterations = 1;
  (void)run(&w, best, sensitivity, &stuck);
  assert_close(best->u[0], 0.4, 0.01);
  assert_close(best->u[1], 1.6, 0.05);
  assert_true(best->distance < 2e-3);
  fit_made_up_close(&w, best);
  /* broken far beyond the cap, it is left at once */
  w.notes = 0;
  fit_made_up_open(&w, &best);
  best->u[0] = best->u[1] = 1.0;
  fit_made_up_score(&w, best, 1);
  best->cost = ambulo__fit_cost(&w.fit, best);
  assert_true(best->distance > 12.0);
  (void)run(&w, best, sensitivity, &stuck);
  assert_close(best->u[0], 0.4, 0.03);
  fit_made_up_close(&w, best);
}

/* u_0 cannot be moved without a failure: it stays, and the other is fitted */
static void a_column_that_fails_is_left_out(void **state) {
  (void)state;
  fit_made_up w = {.scale = 1.0, .linear = 1, .fails = 3};
  ambulo__fit_trial *best;
  double sensitivity[2];
  int stuck;
  fit_made_up_open(&w, &best);
  w.fit.iterations = 1;
  (void)run(&w, best, sensitivity, &stuck);
  assert_close(best->u[0], 0.0, 0.0);
  assert_close(best->u[1], 2.0 / 1.01, 0.05);
  assert_true(isnan(sensitivity[0]));
  assert_int_equal(w.dropped, 1);
  fit_made_up_close(&w, best);
}

static void failures_are_no_derivatives(void **state) {
  (void)state;
  fit_made_up w = {.scale = 5.0, .fails = 1};
  ambulo__fit_trial *best;
  double sensitivity[2];
  int stuck;
  fit_made_up_open(&w, &best);
  (void)run(&w, best, sensitivity, &stuck);
  assert_true(best->u[0] == 0.0 && best->u[1] == 0.0);
  assert_true(w.dropped >= 2);
  assert_close(w.damping, 25.0 * 0.3, 1e-9); /* ten times that of the first iteration */
  assert_int_equal(stuck, -1);               /* it is solved where the fit stands */
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
  w.fit.iterations = 0;
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
    ambulo_status status = ambulo__fit_search(&w.task, best, sensitivity, &ending, &stuck);
    int failed = w.memory.failed;
    assert_int_equal(status, failed ? AMBULO_E_MEMORY : AMBULO_OK);
    fit_made_up_close(&w, best);
    if (!failed) break;
  }
  assert_int_equal(rounds, 4);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_curved_valley),
      cmocka_unit_test(a_ridge_holds_back),
      cmocka_unit_test(bounds_hold),
      cmocka_unit_test(linear_residuals_take_one_iteration),
      cmocka_unit_test(a_guard_that_holds_at_first),
      cmocka_unit_test(a_column_that_fails_is_left_out),
      cmocka_unit_test(failures_are_no_derivatives),
      cmocka_unit_test(a_condition_that_is_never_solved),
      cmocka_unit_test(a_stop_keeps_the_best),
      cmocka_unit_test(no_iteration),
      cmocka_unit_test(memory_may_give_out),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
