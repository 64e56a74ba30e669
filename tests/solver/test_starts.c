/* Several starts: the same in every run, counted by valley; the solve continues from the best. */
#include "solver/session.h"
#include "ambulo/tools/load.h"
#include "solver/result.h"
#include "support/at_nodes.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"

#include <stdlib.h>
#include <string.h>

static ambulo_result *solve(const ambulo_problem *problem, int starts, const double *start) {
  ambulo_options options = ambulo_options_default();
  ambulo_result *result = NULL;
  options.starts = starts;
  assert_int_equal(ambulo_solve(problem, &options, start, NULL, NULL, &result), AMBULO_OK);
  return result;
}

static void a_cheaper_valley_is_gone_on_from(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_12");
  ambulo_result *one = solve(problem, 1, NULL), *eight = solve(problem, 8, NULL);
  const ambulo_starts *s = ambulo_result_starts(eight);
  int found = 0;
  assert_null(ambulo_result_starts(one));
  assert_int_equal(s->count, 8);
  assert_true(s->basin_count >= 2);
  for (int b = 0; b < s->basin_count; b++) {
    found += s->basins[b].found;
    assert_true(b == 0 || s->basins[b].objective >= s->basins[b - 1].objective);
    assert_true(b == 0 ? s->basins[b].distance == 0.0 : s->basins[b].distance > 0.0);
  }
  assert_int_equal(found, s->solved);
  assert_int_equal(verdict_at_nodes(eight), AMBULO_OPTIMAL);
  assert_true(eight->objective < 0.99 * one->objective);
  ambulo_result_free(one);
  ambulo_result_free(eight);
  ambulo_problem_free(problem);
}

/* what is the best on a coarse grid may not be on the problem's own: several starts are never worse
 * than one */
static void several_are_never_worse_than_one(void **state) {
  (void)state;
  static const char *const names[] = {"yardstick_12", "walker_2d_step", "hop"};
  for (int i = 0; i < (getenv("AMBULO_LONG") ? 3 : 2); i++) {
    ambulo_problem *problem = load_problem(names[i]);
    ambulo_result *one = solve(problem, 1, NULL), *eight = solve(problem, 8, NULL);
    const ambulo_starts *s = ambulo_result_starts(eight);
    if (ambulo_verdict_is_solution(one->verdict)) {
      assert_true(ambulo_verdict_is_solution(eight->verdict));
      assert_true(eight->objective <= one->objective);
    }
    assert_true(s->chosen == 0 || s->chosen == s->basins[0].first);
    if (s->chosen == 0)
      assert_memory_equal(one->x, eight->x, (size_t)one->variables * sizeof *one->x);
    ambulo_result_free(one);
    ambulo_result_free(eight);
    ambulo_problem_free(problem);
  }
}

/* a point that holds its rows far from an optimum is no answer: other starts are looked at, and the
 * best of all is returned; an optimum needs no second look */
static void what_leaves_doubts_has_a_second_look(void **state) {
  (void)state;
  static const char *const settings[] = {"load.mass=240", "constraints.torque_limits=true",
                                         "constraints.orientation_tolerance=0.004",
                                         "time.intervals=64", "trajectory.intervals=14"};
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load("models/walk_loaded.yaml", settings, 5, NULL, NULL, &problem), AMBULO_OK);
  ambulo_result *result = solve(problem, 1, NULL);
  const ambulo_starts *s = ambulo_result_starts(result);
  assert_int_equal(result->verdict, AMBULO_FEASIBLE);
  assert_true(result->audit.kkt > 1e-3);
  assert_non_null(s);
  assert_int_equal(s->count, 3);
  ambulo_result_free(result);
  ambulo_problem_free(problem);

  ambulo_options options = ambulo_options_default();
  ambulo_result r = {
      .verdict = AMBULO_FEASIBLE, .ending_code = AMBULO_ENDING_STALLED, .objective = 1.0};
  r.audit.kkt = 2e-3;
  assert_true(ambulo__result_leaves_doubts(&options, &r));
  r.audit.kkt = 9e-4; /* of a tolerance below the usual one */
  assert_false(ambulo__result_leaves_doubts(&options, &r));
  r.verdict = AMBULO_NOT_CONVERGED;
  assert_true(ambulo__result_leaves_doubts(&options, &r));
  r.ending_code = AMBULO_ENDING_EVALUATIONS;
  assert_false(ambulo__result_leaves_doubts(&options, &r));
  r.ending_code = AMBULO_ENDING_STALLED;
  r.verdict = AMBULO_INFEASIBLE;
  assert_false(ambulo__result_leaves_doubts(&options, &r));
  r.verdict = AMBULO_OPTIMAL;
  assert_false(ambulo__result_leaves_doubts(&options, &r));
}

/* who holds its rows; then who costs less; of two that do not hold, who is off by less */
static void the_better_of_two_results(void **state) {
  (void)state;
  ambulo_result dear = {.verdict = AMBULO_OPTIMAL, .objective = 2.0}, cheap = dear, off = dear, far;
  dear.audit.violation.size = cheap.audit.violation.size = off.audit.violation.size = 1.0;
  cheap.objective = 1.0;
  off.verdict = AMBULO_NOT_CONVERGED;
  off.objective = 0.5;
  off.audit.violation.worst = 1e-3;
  far = off;
  far.objective = 0.1;
  far.audit.violation.worst = 1e-2;
  const ambulo_result *order[] = {&cheap, &dear, &off, &far};
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++)
      assert_int_equal(ambulo__result_is_better(order[i], order[j]), i < j);
}

static void every_run_is_the_same(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("support/walker_2d_step");
  ambulo_result *first = solve(problem, 6, NULL), *second = solve(problem, 6, NULL);
  const ambulo_starts *a = ambulo_result_starts(first), *b = ambulo_result_starts(second);
  assert_int_equal(a->basin_count, b->basin_count);
  assert_memory_equal(a->basins, b->basins, (size_t)a->basin_count * sizeof *a->basins);
  assert_memory_equal(first->x, second->x, (size_t)first->variables * sizeof *first->x);
  ambulo_result_free(first);
  ambulo_result_free(second);
  ambulo_problem_free(problem);
}

/* where the solver's own start is the best, the result is that of one start, to the last bit */
static void the_own_start_stays_what_it_is(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("support/two_link_reach");
  ambulo_result *one = solve(problem, 1, NULL), *several = solve(problem, 4, NULL);
  assert_int_equal(ambulo_result_starts(several)->basins[0].first, 0);
  assert_memory_equal(one->x, several->x, (size_t)one->variables * sizeof *one->x);
  ambulo_result *given = solve(problem, 4, one->x);
  assert_null(ambulo_result_starts(given)); /* the caller has one */
  ambulo_result_free(given);
  ambulo_result_free(one);
  ambulo_result_free(several);
  ambulo_problem_free(problem);
}

static void no_start_may_lead_anywhere(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_load("tests/infeasible/equalities_contradict.yaml", NULL, 0, NULL,
                                       NULL, &problem),
                   AMBULO_OK);
  ambulo_result *result = solve(problem, 3, NULL);
  const ambulo_starts *s = ambulo_result_starts(result);
  assert_int_equal(s->count, 3);
  assert_int_equal(s->solved + s->basin_count, 0);
  assert_int_equal(result->verdict, AMBULO_INFEASIBLE);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static int stop_after(void *user, const ambulo_progress *progress) {
  (void)progress;
  return --*(int *)user < 0;
}

/* the caller ends it among the starts: what is known by then is returned, and says so */
static void a_stop_keeps_what_is_there(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_12");
  ambulo_options options = ambulo_options_default();
  ambulo_result *result = NULL;
  int calls = 40;
  options.starts = 20;
  options.progress = stop_after;
  options.user = &calls;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_ending_code(result), AMBULO_ENDING_CALLER);
  assert_true(ambulo_result_starts(result)->count < 20);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void nonsense_is_refused(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("support/two_link_reach");
  ambulo_options options = ambulo_options_default();
  ambulo_result *result = NULL;
  static const int wrong[] = {0, -3, AMBULO_MOST_STARTS + 1};
  for (int i = 0; i < 3; i++) {
    options.starts = wrong[i];
    assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_E_ARGUMENT);
  }
  assert_null(result);
  assert_null(ambulo_result_starts(NULL));
  ambulo_problem_free(problem);
}

static void memory_runs_out(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("support/two_link_reach");
  ambulo_options options = ambulo_options_default();
  options.starts = 2;
  for (long at = 0;; at += at < 60 ? 1 : 37) {
    fail_alloc memory = fail_alloc_at(at);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_result *result = NULL;
    ambulo_status status = ambulo_solve(problem, &options, NULL, &hook, NULL, &result);
    ambulo_result_free(result);
    assert_int_equal(memory.live, 0);
    if (!status) break;
    assert_int_equal(status, AMBULO_E_MEMORY);
  }
  ambulo_problem_free(problem);
}

/* a problem on another grid is made of the first one's own definition, also where that has been
 * completed: strength that is limits */
static void starts_of_a_walk_by_its_limits(void **state) {
  (void)state;
  static const char *const settings[] = {
      "objective[torque_power].strength=limits",
      "objective[torque_power].scale={default: 0, knee_angle_r: [2, 1], knee_angle_l: [2, 1]}"};
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load("models/walk_normal.yaml", settings, 2, NULL, NULL, &problem), AMBULO_OK);
  ambulo_result *result = solve(problem, 2, NULL);
  assert_non_null(ambulo_result_starts(result));
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(starts_of_a_walk_by_its_limits),
                                     cmocka_unit_test(a_cheaper_valley_is_gone_on_from),
                                     cmocka_unit_test(several_are_never_worse_than_one),
                                     cmocka_unit_test(what_leaves_doubts_has_a_second_look),
                                     cmocka_unit_test(the_better_of_two_results),
                                     cmocka_unit_test(every_run_is_the_same),
                                     cmocka_unit_test(the_own_start_stays_what_it_is),
                                     cmocka_unit_test(a_stop_keeps_what_is_there),
                                     cmocka_unit_test(no_start_may_lead_anywhere),
                                     cmocka_unit_test(nonsense_is_refused),
                                     cmocka_unit_test(memory_runs_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
