/* a gait of several steps starts at one of them: iterations, the motion, and where it does not. */
#include "ambulo/tools/load.h"
#include "method/multipliers.h"
#include "support/fail_alloc.h"
#include "support/test.h"

#include <math.h>

#define RIGID "tests/support/walk_rigid.yaml"

/* overrides end with NULL */
static ambulo_problem *open_with(const char *file, const char *const *overrides) {
  ambulo_problem *p = NULL;
  int count = 0;
  while (overrides[count]) count++;
  assert_int_equal(ambulo_problem_load(file, overrides, count, NULL, NULL, &p), AMBULO_OK);
  return p;
}

#define STEPS(n, duration, intervals, knots)                                                       \
  "gait.steps=" n, "time.duration=" duration, "time.intervals=" intervals,                         \
      "trajectory.intervals=" knots

/* x stays as it is where there is no start */
static double *start_of(const ambulo_problem *p, const ambulo_options *options,
                        ambulo_multipliers **m) {
  int n = ambulo_problem_variable_count(p), touched = 0;
  double *x = test_malloc((size_t)n * sizeof *x);
  for (int i = 0; i < n; i++) x[i] = 7.0;
  *m = (ambulo_multipliers *)&n;
  assert_int_equal(ambulo_start_from_step(p, options, NULL, x, m), AMBULO_OK);
  for (int i = 0; i < n; i++) touched += x[i] != 7.0;
  assert_true(*m ? touched > n / 2 : touched == 0);
  return x;
}

static ambulo_result *solve(const ambulo_problem *p, int from_step) {
  ambulo_options options = ambulo_problem_options(p);
  ambulo_multipliers *m = NULL;
  ambulo_result *result = NULL;
  options.dense_samples = 1;
  double *x = from_step ? start_of(p, &options, &m) : NULL;
  assert_true(!from_step || m);
  options.multipliers = m;
  assert_int_equal(ambulo_solve(p, &options, x, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  ambulo_multipliers_free(m);
  test_free(x);
  return result;
}

/* where one step is in the space of several, all cost as much each, and the solve is at its end */
static void check_steps(const char *const *overrides, int steps, double share, int iterations) {
  static const char *const none[] = {NULL};
  ambulo_problem *one = open_with(RIGID, none), *all = open_with(RIGID, overrides);
  ambulo_result *first = solve(one, 0), *last = solve(all, 1);
  double single = ambulo_result_objective(first), each = ambulo_result_objective(last) / steps;
  print_message("%d iterations for %d, %.6f for %.6f\n", ambulo_result_iterations(last),
                ambulo_result_iterations(first), each, single);
  assert_true(fabs(each / single - 1.0) < share);
  assert_in_range(ambulo_result_iterations(last), 1, iterations);
  ambulo_result_free(first);
  ambulo_result_free(last);
  ambulo_problem_free(one);
  ambulo_problem_free(all);
}

static void test_three_steps(void **state) {
  static const char *const three[] = {STEPS("3", "1.62", "75", "51"), NULL};
  (void)state;
  check_steps(three, 3, 1e-3, 12);
}

static void test_four_periodic_steps(void **state) {
  static const char *const four[] = {STEPS("4", "2.16", "100", "68"), "ends.kind=periodic", NULL};
  (void)state;
  check_steps(four, 4, 1e-3, 12);
}

/* a limp is solved as a stride */
static void test_unlike_steps(void **state) {
  static const char *const limp[] = {"gait.steps=4",        "gait.step_length=[0.66, 0.70]",
                                     "gait.step_time=0.54", "time.duration=null",
                                     "time.intervals=100",  "trajectory.intervals=68",
                                     "ends.kind=periodic",  NULL};
  (void)state;
  ambulo_problem *p = open_with(RIGID, limp);
  ambulo_options options = ambulo_problem_options(p);
  ambulo_multipliers *m = NULL;
  double *x = start_of(p, &options, &m);
  assert_non_null(m);
  assert_true(m->periods == 2 && !m->mirrored);
  ambulo_multipliers_free(m);
  test_free(x);
  ambulo_problem_free(p);
}

/* ----------------------------------------------------------- where there is no such start */

static void refuse(const char *const *overrides) {
  for (int i = 0; overrides[i]; i++) print_message("%s\n", overrides[i]);
  ambulo_problem *p = open_with(RIGID, overrides);
  ambulo_options options = ambulo_problem_options(p);
  ambulo_multipliers *m = NULL;
  test_free(start_of(p, &options, &m));
  assert_null(m);
  ambulo_problem_free(p);
}

#define TWO STEPS("2", "1.08", "50", "34")
#define PERIODIC TWO, "ends.kind=periodic"

static void test_no_start(void **state) {
  static const char *const cases[][8] = {
      {NULL},                           /* of one step */
      {TWO, "ends={kind: free}", NULL}, /* which does not repeat */
      {PERIODIC, "ends.final={knee_angle_r: 0}", NULL},
      {PERIODIC, "obstacles=[{name: box, center: [9, 0, 1], half_size: [1, 1, 1]}]", NULL},
      {PERIODIC, "trajectory={basis: bspline, breakpoints: [0, 0.3, 0.54, 0.8, 1.08]}", NULL},
      {PERIODIC, "trajectory.intervals=14", NULL}, /* too coarse */
      {PERIODIC, "solver.starts=2", NULL},
      {PERIODIC, "solver.maximum_iterations=1", NULL},   /* the step has no solution */
      {PERIODIC, "gait.step_length=[0.66, 0.70]", NULL}, /* a stride is all there is */
  };
  (void)state;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) refuse(cases[i]);
}

static int stop_at_once(void *user, const ambulo_progress *progress) {
  int *calls = user;
  assert_string_equal(progress->stage, "one step");
  assert_true(progress->time_limit == 3.0);
  ++*calls;
  return 1;
}

/* it is told, has half of the limit, and ends when the caller says so */
static void test_stopped(void **state) {
  static const char *const two[] = {PERIODIC, NULL};
  (void)state;
  int calls = 0;
  ambulo_problem *p = open_with(RIGID, two);
  ambulo_options options = ambulo_problem_options(p);
  ambulo_multipliers *m = NULL;
  options.time_limit = 6.0;
  options.progress = stop_at_once;
  options.user = &calls;
  test_free(start_of(p, &options, &m));
  assert_null(m);
  assert_true(calls > 0);
  ambulo_problem_free(p);
}

/* at requests further and further apart: each is a solve */
static void test_out_of_memory(void **state) {
  static const char *const two[] = {PERIODIC, NULL};
  (void)state;
  ambulo_problem *p = open_with(RIGID, two);
  ambulo_options options = ambulo_problem_options(p);
  double *x = test_calloc((size_t)ambulo_problem_variable_count(p), sizeof *x);
  int refused = 0;
  for (long k = 0;; k = 2 * k + 1) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator a = fail_alloc_hook(&memory);
    ambulo_multipliers *m = NULL;
    ambulo_status status = ambulo_start_from_step(p, &options, &a, x, &m);
    assert_true(status ? !m : memory.failed || m);
    ambulo_multipliers_free(m);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_int_equal(status, AMBULO_E_MEMORY);
    refused++;
  }
  assert_true(refused > 5);
  test_free(x);
  ambulo_problem_free(p);
}

static void test_arguments(void **state) {
  static const char *const two[] = {PERIODIC, NULL};
  (void)state;
  ambulo_problem *p = open_with(RIGID, two);
  ambulo_options options = ambulo_problem_options(p);
  ambulo_multipliers *m = NULL;
  double x = 0.0;
  assert_int_equal(ambulo_start_from_step(NULL, &options, NULL, &x, &m), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_start_from_step(p, &options, NULL, NULL, &m), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_start_from_step(p, &options, NULL, &x, NULL), AMBULO_E_ARGUMENT);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_three_steps),  cmocka_unit_test(test_four_periodic_steps),
      cmocka_unit_test(test_unlike_steps), cmocka_unit_test(test_no_start),
      cmocka_unit_test(test_stopped),      cmocka_unit_test(test_out_of_memory),
      cmocka_unit_test(test_arguments)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
