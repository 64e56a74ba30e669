/* Finer grids until the objective settles and the motion holds between its nodes. */
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

/* one grid more tells how much there was to gain */
static void the_objective_settles(void **state) {
  (void)state;
  static const char *const coarse[] = {"time.intervals=64", "trajectory.intervals=14"};
  ambulo_problem *problem = load("walk_normal", coarse, 2), *finer = NULL;
  ambulo_result *one = NULL, *result = NULL;
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &one), AMBULO_OK);
  assert_null(ambulo_result_refinement(one));
  assert_int_equal(ambulo_solve_refined(problem, NULL, NULL, NULL, NULL, &finer, &result),
                   AMBULO_OK);
  const ambulo_refinement *r = ambulo_result_refinement(result);
  assert_non_null(r);
  assert_true(r->grid_count >= 3);
  const ambulo_refined_grid *last = &r->grids[r->grid_count - 1];
  for (int g = 0; g < r->grid_count; g++) {
    assert_int_equal(r->grids[g].intervals, problem->definition.intervals << g);
    assert_true(r->grids[g].kept && r->grids[g].holds);
  }
  assert_close(r->grids[0].objective, one->objective, 1e-12);
  assert_true(fabs(last->objective - last[-1].objective) <= 0.02 * last->objective);
  assert_close(last->objective, result->objective, 1e-12);
  assert_int_equal(finer->definition.intervals, last->intervals);
  assert_true(result->objective < 0.97 * one->objective);
  assert_true(r->resolution > 0.0 && r->resolution < 0.01);
  ambulo_result_free(one);
  ambulo_result_free(result);
  ambulo_problem_free(finer);
  ambulo_problem_free(problem);
}

/* J + C h^p is extrapolated exactly; of two grids p is 2, and of an order that cannot be, too */
static void what_is_left_follows_from_the_orders(void **state) {
  (void)state;
  const double limit = 2.0, c = 0.3;
  for (int order = 1; order <= 4; order++) {
    double ratio = pow(2.0, order);
    double j[3] = {limit + c, limit + c / ratio, limit + c / ratio / ratio};
    assert_close(ambulo__resolution_error(j, 3), (j[2] - limit) / j[2], 1e-12);
    assert_close(ambulo__resolution_error(j + 1, 2), (j[1] - j[2]) / 3.0 / j[2], 1e-12);
  }
  const double turns[3] = {2.0, 2.2, 2.1}, rises[2] = {1.0, 1.3};
  assert_close(ambulo__resolution_error(turns, 3), 0.1 / 3.0 / 2.1, 1e-12);
  assert_close(ambulo__resolution_error(rises, 2), -0.1 / 1.3, 1e-12);
  assert_true(isnan(ambulo__resolution_error(turns, 1)));
}

/* coarse grids that hold at their nodes alone go on, and are not preferred for being cheap */
static void a_coarse_grid_is_not_the_end(void **state) {
  (void)state;
  ambulo_problem *problem = load("yardstick_12", NULL, 0), *finer = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve_refined(problem, NULL, NULL, NULL, NULL, &finer, &result),
                   AMBULO_OK);
  const ambulo_refinement *r = ambulo_result_refinement(result);
  assert_true(r->grid_count >= 4);
  assert_true(r->resolution < 0.0);
  assert_true(result->objective > 2.0);
  assert_true(finer->definition.intervals >= 96);
  ambulo_result_free(result);
  ambulo_problem_free(finer);
  ambulo_problem_free(problem);
}

/* `free` is found on the grid given, and its best problem refined */
static void free_numbers_are_found_first(void **state) {
  (void)state;
  const char *own[] = {"free={gait.step_length: [0.55, 0.62]}"};
  ambulo_problem *problem = load("walker_2d_step", own, 1), *finer = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve_refined(problem, NULL, NULL, NULL, NULL, &finer, &result),
                   AMBULO_OK);
  assert_non_null(finer);
  assert_non_null(ambulo_result_parameters(result));
  assert_int_equal(ambulo_result_parameters(result)->items[0].bound, AMBULO_AT_UPPER);
  assert_true(ambulo_result_refinement(result)->grid_count >= 2);
  assert_true(result->objective < ambulo_result_refinement(result)->grids[0].objective);
  ambulo_problem_free(problem); /* whose body the finer one has not */
  assert_true(ambulo_model_mass(ambulo_problem_model(finer)) > 0.0);
  ambulo_result_free(result);
  ambulo_problem_free(finer);
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
  ambulo_problem *problem = load("pendulum_swing", NULL, 0);
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
                                     cmocka_unit_test(the_objective_settles),
                                     cmocka_unit_test(what_is_left_follows_from_the_orders),
                                     cmocka_unit_test(a_coarse_grid_is_not_the_end),
                                     cmocka_unit_test(free_numbers_are_found_first),
                                     cmocka_unit_test(a_stop_keeps_the_best),
                                     cmocka_unit_test(memory_runs_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
