/* ambulo_solve as a caller meets it. */
#include "support/at_nodes.h"
#include "mechanics/plan.h"
#include "support/engine_fixture.h"
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"

#include <pthread.h>

static ambulo_result *solve(const ambulo_problem *problem, ambulo_options options) {
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  return result;
}

static void yardstick_is_solved_from_zero(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_12");
  ambulo_result *r = solve(problem, ambulo_options_default());
  double f = ambulo_result_objective(r);
  if (f > 0.3568) print_error("f = %.6f: %s\n", f, ambulo_result_ending(r));
  assert_int_equal(verdict_at_nodes(r), AMBULO_OPTIMAL);
  assert_true(f <= 0.3568);
  assert_true(ambulo_result_audit(r)->violation.worst <= 1e-6);
  assert_true(ambulo_result_timing(r)->total > 0.0);
  assert_non_null(strstr(ambulo_result_ending(r), "AUGLAG"));
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

static void grids_continue_from_coarser_ones(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_36");
  ambulo_result *r = solve(problem, ambulo_options_default());
  double f = ambulo_result_objective(r);
  if (f > 1.0211) print_error("f = %.6f: %s\n", f, ambulo_result_ending(r));
  assert_int_equal(verdict_at_nodes(r), AMBULO_OPTIMAL);
  assert_true(f <= 1.0211);
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

/* as many items as iterations, grid by grid, the same in two runs; the last is what is returned */
static void the_way_is_told(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_36");
  ambulo_result *r[2] = {solve(problem, ambulo_options_default()),
                         solve(problem, ambulo_options_default())};
  const ambulo_history *way = ambulo_result_history(r[0]), *again = ambulo_result_history(r[1]);
  const ambulo_violation *worst = &ambulo_result_audit(r[0])->violation;
  assert_true(way->count >= 3);
  assert_int_equal(way->count, ambulo_result_iterations(r[0]) + 1);
  assert_int_equal(way->count, again->count);
  assert_int_equal(way->every, 1);
  assert_close(way->tolerance, 1e-6, 0);
  for (int i = 0; i < way->count; i++) {
    const ambulo_iteration *now = &way->items[i], *other = &again->items[i];
    assert_int_equal(now->iteration, i + 1 < way->count ? i + 1 : i);
    assert_int_equal(now->evaluations, other->evaluations);
    assert_true(now->objective == other->objective && now->violation == other->violation);
    if (i == 0) continue;
    assert_true(now->intervals >= now[-1].intervals && now->evaluations >= now[-1].evaluations);
    assert_true(now->seconds >= now[-1].seconds && now->seconds > 0.0);
  }
  assert_true(way->items[0].intervals < 36);
  const ambulo_iteration *end = &way->items[way->count - 1];
  assert_int_equal(end->intervals, 36);
  assert_true(end->objective == ambulo_result_objective(r[0]));
  assert_true(end->violation == worst->worst / worst->size && isnan(end->gradient));
  assert_true(end[-1].gradient >= 0.0 && end[-1].gradient < 1.0);
  for (int i = 0; i < 2; i++) ambulo_result_free(r[i]);
  ambulo_problem_free(problem);
  assert_null(ambulo_result_history(NULL));
}

static void feasibility_alone_is_enough(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("fig5a_feasible");
  ambulo_result *r = solve(problem, ambulo_options_default());
  assert_int_equal(verdict_at_nodes(r), AMBULO_OPTIMAL);
  assert_true(ambulo_result_objective(r) == 0.0);
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

static int stop_at_second(void *user, const ambulo_progress *progress) {
  *(ambulo_progress *)user = *progress;
  return progress->iteration >= 2;
}

static void cancelled_solve_returns_its_point(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_12");
  ambulo_options options = ambulo_options_default();
  ambulo_progress last = {0};
  options.progress = stop_at_second;
  options.user = &last;
  ambulo_result *r = solve(problem, options);
  assert_int_equal(verdict_at_nodes(r), AMBULO_INTERRUPTED);
  assert_int_equal(ambulo_result_iterations(r), 2);
  assert_close(ambulo_result_objective(r), last.objective, 1e-12);
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

static void limits_end_the_solve(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_12");
  ambulo_options options = ambulo_options_default();
  options.maximum_evaluations = 20;
  ambulo_result *r = solve(problem, options);
  assert_int_equal(verdict_at_nodes(r), AMBULO_LIMIT_REACHED);
  assert_in_range(ambulo_result_evaluations(r), 20, 30);
  ambulo_result_free(r);
  options = ambulo_options_default();
  options.time_limit = 1e-6;
  r = solve(problem, options);
  assert_int_equal(verdict_at_nodes(r), AMBULO_LIMIT_REACHED);
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

/* the processor chooses the kernels, and not the motion: to the last bit */
static void every_instruction_set_solves_alike(void **state) {
  (void)state;
  static const char *const sets[] = {"scalar", "baseline", "avx2", "avx512"};
  static const char *const names[] = {"walk_without_reaction", "walk_normal"};
  for (int p = 0; p < 2; p++) {
    ambulo_result *first = NULL;
    for (int i = 0; i < 4; i++) {
      if (!ambulo__kernels_by_name(sets[i])) continue;
      setenv("AMBULO_ISA", sets[i], 1);
      ambulo_problem *problem = load_problem(names[p]);
      ambulo_result *r = solve(problem, ambulo_options_default());
      if (first) {
        assert_int_equal(ambulo_result_iterations(r), ambulo_result_iterations(first));
        assert_int_equal(ambulo_result_verdict(r), ambulo_result_verdict(first));
        assert_memory_equal(ambulo_result_x(r), ambulo_result_x(first),
                            (size_t)ambulo_problem_variable_count(problem) * sizeof(double));
      }
      ambulo_problem_free(problem);
      ambulo_result *done = first ? r : NULL;
      if (!first) first = r;
      ambulo_result_free(done);
    }
    ambulo_result_free(first);
  }
  unsetenv("AMBULO_ISA");
}

static void impossible_problem_is_called_infeasible(void **state) {
  (void)state;
  const char *overrides[] = {"gait.step_length=1.35"};
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load("models/yardstick_12.yaml", overrides, 1, NULL, NULL, &problem),
      AMBULO_OK);
  ambulo_options options = ambulo_options_default();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_result *r = NULL;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, list, &r), AMBULO_OK);
  assert_int_equal(verdict_at_nodes(r), AMBULO_INFEASIBLE);
  const ambulo_violation *worst = &ambulo_result_audit(r)->violation;
  assert_true(worst->worst > 0.1);
  int named = 0;
  for (size_t i = 0; i < ambulo_diagnostics_count(list); i++)
    named |= strstr(ambulo_diagnostics_get(list, i)->message, worst->family) != NULL;
  assert_int_equal(named, 1);
  ambulo_diagnostics_free(list);
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

static void start_that_is_not_finite_is_refused(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("pendulum_swing");
  size_t n = (size_t)ambulo_problem_variable_count(problem);
  double *x = calloc(n, sizeof *x);
  ambulo_result *r = NULL;
  x[1] = NAN;
  assert_int_equal(ambulo_solve(problem, NULL, x, NULL, NULL, &r), AMBULO_E_PROBLEM);
  assert_null(r);
  free(x);
  ambulo_problem_free(problem);
}

typedef struct job {
  const char *name;
  ambulo_result *result;
} job;

static void *work(void *data) {
  job *j = data;
  ambulo_problem *problem = NULL;
  char path[96];
  problem_path(j->name, path, sizeof path);
  if (ambulo_problem_load(path, NULL, 0, NULL, NULL, &problem)) return NULL;
  ambulo_options options = ambulo_options_default();
  if (ambulo_solve(problem, &options, NULL, NULL, NULL, &j->result)) j->result = NULL;
  ambulo_problem_free(problem);
  return NULL;
}

static void threads_give_the_bits_of_serial_runs(void **state) {
  (void)state;
  job serial[2] = {{"yardstick_12", NULL}, {"support/two_link_reach", NULL}};
  job parallel[2] = {{"yardstick_12", NULL}, {"support/two_link_reach", NULL}};
  pthread_t thread[2];
  for (int i = 0; i < 2; i++) (void)work(&serial[i]);
  for (int i = 0; i < 2; i++)
    assert_int_equal(pthread_create(&thread[i], NULL, work, &parallel[i]), 0);
  for (int i = 0; i < 2; i++) assert_int_equal(pthread_join(thread[i], NULL), 0);
  for (int i = 0; i < 2; i++) {
    assert_non_null(serial[i].result);
    assert_non_null(parallel[i].result);
    double a = ambulo_result_objective(serial[i].result);
    double b = ambulo_result_objective(parallel[i].result);
    assert_memory_equal(&a, &b, sizeof a);
    ambulo_result_free(serial[i].result);
    ambulo_result_free(parallel[i].result);
  }
}

static void out_of_memory_is_survived(const char *name, long stride) {
  ambulo_problem *problem = load_problem(name);
  ambulo_options options = ambulo_options_default();
  options.maximum_evaluations = 30;
  for (long k = 0; k < 100000; k += stride) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_result *r = NULL;
    ambulo_status status = ambulo_solve(problem, &options, NULL, &allocator, NULL, &r);
    if (status) {
      assert_int_equal(status, AMBULO_E_MEMORY);
      assert_null(r);
    }
    ambulo_result_free(r);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  ambulo_problem_free(problem);
}

static void any_allocation_may_fail(void **state) {
  (void)state;
  out_of_memory_is_survived("support/two_link_reach", 3);
  out_of_memory_is_survived("yardstick_36", 41);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(yardstick_is_solved_from_zero),
      cmocka_unit_test(grids_continue_from_coarser_ones),
      cmocka_unit_test(the_way_is_told),
      cmocka_unit_test(feasibility_alone_is_enough),
      cmocka_unit_test(cancelled_solve_returns_its_point),
      cmocka_unit_test(limits_end_the_solve),
      cmocka_unit_test(every_instruction_set_solves_alike),
      cmocka_unit_test(impossible_problem_is_called_infeasible),
      cmocka_unit_test(start_that_is_not_finite_is_refused),
      cmocka_unit_test(threads_give_the_bits_of_serial_runs),
      cmocka_unit_test(any_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
