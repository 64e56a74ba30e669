/* Runs over free parameters that are cut short: by the caller, by limits, without memory. */
#include "support/at_nodes.h"
#include "support/outer_fixture.h"
#include "ambulo/tools/load.h"

typedef struct watcher {
  int stop_at, last, calls; /* stop_at: solve in which the callback says stop; 0: never */
  double least;
} watcher;

static int watch(void *user, const ambulo_progress *progress) {
  watcher *w = user;
  w->calls++;
  assert_true(progress->solve == w->last || progress->solve == w->last + 1);
  assert_true(isnan(progress->best) == (progress->solve == 1));
  if (!isnan(progress->best)) {
    assert_true(progress->best <= w->least);
    w->least = progress->best;
  }
  w->last = progress->solve;
  return w->stop_at && progress->solve >= w->stop_at;
}

static void the_caller_may_stop(void **state) {
  (void)state;
  static const char *const overrides[] = {"free={gait.step_length: [0.4, 1.1]}"};
  ambulo_options options = ambulo_options_default();
  for (int stop = 0; stop <= 3; stop++) {
    watcher w = {stop, 0, 0, INFINITY};
    options.progress = watch;
    options.user = &w;
    solved s = solve(PLANAR, overrides, 1, &options);
    ambulo_verdict verdict = verdict_at_nodes(s.result);
    assert_int_equal(verdict, stop == 1 ? AMBULO_INTERRUPTED : AMBULO_OPTIMAL);
    if (stop) {
      assert_int_equal(s.outcome->solves, stop);
      assert_int_equal(s.outcome->converged, 0);
      assert_true(stop == 1 || strstr(s.outcome->ending, "stopped by the caller"));
      assert_int_equal(s.outcome->failed, 0);
    }
    if (stop > 1) assert_true(s.outcome->objective <= s.outcome->first);
    if (stop == 2) assert_close(s.outcome->items[0].value, 0.6, 1e-12);
    assert_true(w.calls > 0);
    release(&s);
  }
}

static void limits_hold(void **state) {
  (void)state;
  static const char *const overrides[] = {"free={gait.step_length: [0.4, 1.1], maximum_solves: 3}"};
  solved s = solve(PLANAR, overrides, 1, NULL);
  assert_int_equal(s.outcome->solves, 3);
  assert_int_equal(s.outcome->converged, 0);
  assert_non_null(strstr(s.outcome->ending, "limit of inner solves"));
  assert_int_equal(verdict_at_nodes(s.result), AMBULO_OPTIMAL);
  release(&s);
  ambulo_options options = ambulo_options_default();
  options.time_limit = 1e-6;
  s = solve(PLANAR, overrides, 1, &options);
  assert_int_equal(s.outcome->solves, 1);
  assert_int_equal(ambulo_result_ending_code(s.result), AMBULO_ENDING_TIME);
  release(&s);
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  static const char *const overrides[] = {"free={time.duration: [0.5, 1.5], maximum_solves: 2}",
                                          "time.intervals=6"};
  ambulo_problem *problem = load(REACH, overrides, 2);
  long last = 0;
  for (long k = 0; k < 100000; k = k < 40 ? k + 1 : k + 13) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_problem *best = NULL;
    ambulo_result *result = NULL;
    ambulo_status status =
        ambulo_solve_parameters(problem, NULL, NULL, &allocator, NULL, &best, &result);
    if (status == AMBULO_OK) {
      ambulo_result_free(result);
      ambulo_problem_free(best);
    } else {
      assert_int_equal(status, AMBULO_E_MEMORY);
      assert_null(best);
      assert_null(result);
    }
    assert_int_equal(memory.live, 0);
    last = k;
    if (!memory.failed) break;
  }
  assert_true(last > 100);
  ambulo_problem_free(problem);
}

static void other_results_have_no_outcome(void **state) {
  (void)state;
  ambulo_problem *problem = load(REACH, NULL, 0), *at = NULL;
  ambulo_result *result = NULL;
  double value = 1.0;
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_null(ambulo_result_parameters(result));
  assert_int_equal(ambulo_problem_at(problem, &value, NULL, NULL, &at), AMBULO_E_ARGUMENT);
  assert_null(at);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_caller_may_stop), cmocka_unit_test(limits_hold),
      cmocka_unit_test(every_allocation_may_fail), cmocka_unit_test(other_results_have_no_outcome)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
