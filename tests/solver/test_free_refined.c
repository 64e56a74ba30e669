/* Finer grids until a motion holds between its nodes. */
#include "ambulo/parameters.h"
#include "ambulo/tools/load.h"
#include "solver/result.h"
#include "support/at_nodes.h"
#include "support/problem_path.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"

static ambulo_problem *load(const char *name, const char *const *overrides, int count) {
  char path[96];
  ambulo_problem *problem = NULL;
  problem_path(name, path, sizeof path);
  assert_int_equal(ambulo_problem_load(path, overrides, count, NULL, NULL, &problem), AMBULO_OK);
  return problem;
}

static const char *const on_events[] = {"time.grid=events", "trajectory.knots=events",
                                        "time.intervals=25"};

static void the_last_grid_holds_between_its_nodes(void **state) {
  (void)state;
  ambulo_problem *problem = load("support/walk_rigid", on_events, 3), *finer = NULL, *same = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve_refined(problem, NULL, NULL, NULL, NULL, &finer, &result),
                   AMBULO_OK);
  assert_non_null(finer);
  assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
  assert_int_equal(ambulo_result_dense_audit(result)->failing, 0);
  /* it is the problem that the file is with these intervals */
  char nodes[48], knots[48];
  const char *overrides[] = {on_events[0], on_events[1], nodes, knots};
  (void)snprintf(nodes, sizeof nodes, "time.intervals=%d", finer->definition.intervals);
  (void)snprintf(knots, sizeof knots, "trajectory.intervals=%d",
                 ambulo__basis_intervals(finer->basis));
  same = load("support/walk_rigid", overrides, 4);
  assert_true(ambulo_problem_hash(same) == ambulo_problem_hash(finer));
  assert_int_equal(finer->keys.gait, problem->keys.gait);
  ambulo_problem_free(same);
  ambulo_result_free(result);
  ambulo_problem_free(finer);
  ambulo_problem_free(problem);
}

static void a_grid_that_holds_is_left_alone(void **state) {
  (void)state;
  ambulo_problem *problem = load("pendulum_swing", NULL, 0), *finer = NULL;
  ambulo_result *one = NULL, *result = NULL;
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &one), AMBULO_OK);
  assert_int_equal(ambulo_solve_refined(problem, NULL, NULL, NULL, NULL, &finer, &result),
                   AMBULO_OK);
  assert_null(finer);
  assert_memory_equal(one->x, result->x, (size_t)one->variables * sizeof *one->x);
  ambulo_result_free(one);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static int stop_after(void *user, const ambulo_progress *progress) {
  (void)progress;
  return --*(int *)user < 0;
}

/* a stop in any of the solves: what was found by then is the result */
static void a_stop_keeps_the_best(void **state) {
  (void)state;
  ambulo_problem *problem = load("support/walk_rigid", on_events, 3);
  for (int calls = 3; calls < 80; calls += 25) {
    ambulo_options options = ambulo_options_default();
    ambulo_problem *finer = NULL;
    ambulo_result *result = NULL;
    int left = calls;
    options.progress = stop_after;
    options.user = &left;
    assert_int_equal(ambulo_solve_refined(problem, &options, NULL, NULL, NULL, &finer, &result),
                     AMBULO_OK);
    if (calls == 3) assert_int_equal(result->ending_code, AMBULO_ENDING_CALLER);
    if (calls == 3) assert_null(finer);
    ambulo_result_free(result);
    ambulo_problem_free(finer);
  }
  ambulo_problem_free(problem);
}

static void memory_runs_out(void **state) {
  (void)state;
  ambulo_problem *problem = load("support/walker_2d_step", NULL, 0);
  for (long at = 0;; at += at < 30 ? 1 : 97) {
    fail_alloc memory = fail_alloc_at(at);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_problem *finer = NULL;
    ambulo_result *result = NULL;
    ambulo_status status = ambulo_solve_refined(problem, NULL, NULL, &hook, NULL, &finer, &result);
    ambulo_result_free(result);
    ambulo_problem_free(finer);
    assert_int_equal(memory.live, 0);
    if (!status) break;
    assert_int_equal(status, AMBULO_E_MEMORY);
  }
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_last_grid_holds_between_its_nodes),
                                     cmocka_unit_test(a_grid_that_holds_is_left_alone),
                                     cmocka_unit_test(a_stop_keeps_the_best),
                                     cmocka_unit_test(memory_runs_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
