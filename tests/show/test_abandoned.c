/* A solve that its caller does not wait for: the point that it showed last, judged by its values.
 */
#include "ambulo/tools/report.h"
#include "support/engine_fixture.h"
#include "support/test.h"

#include <string.h>

typedef struct shown {
  const ambulo_problem *problem;
  ambulo_progress last;
  double *point;
  int calls, others;
} shown;

static int show(void *user, const ambulo_progress *p) {
  shown *s = user;
  s->calls++;
  assert_non_null(p->problem);
  assert_non_null(p->point);
  if (p->problem != s->problem) {
    s->others++;
    return 0;
  }
  size_t n = (size_t)ambulo_problem_variable_count(s->problem);
  memcpy(s->point, p->point, n * sizeof *s->point);
  s->last = *p;
  s->last.point = s->point;
  return 0;
}

static ambulo_result *solve(shown *s, const char *name, ambulo_algorithm algorithm) {
  ambulo_problem *problem = load_problem(name);
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *result = NULL;
  *s = (shown){.problem = problem};
  s->point = calloc((size_t)ambulo_problem_variable_count(problem), sizeof *s->point);
  assert_non_null(s->point);
  options.algorithm = algorithm;
  options.progress = show;
  options.user = s;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  return result;
}

static void end(shown *s, ambulo_result *result) {
  ambulo_result_free(result);
  free(s->point);
  ambulo_problem_free((ambulo_problem *)s->problem);
}

/* what SLSQP has found is shown as soon as it is there */
static void best_point_is_shown(void **state) {
  (void)state;
  shown s;
  ambulo_result *result = solve(&s, "two_link_reach", AMBULO_SLSQP);
  size_t n = (size_t)ambulo_problem_variable_count(s.problem);
  assert_memory_equal(s.point, ambulo_result_x(result), n * sizeof *s.point);
  end(&s, result);
}

static void judged_as_it_would_have_been(ambulo_ending ending, ambulo_verdict verdict) {
  shown s;
  ambulo_result *result = solve(&s, "two_link_reach", AMBULO_SLSQP), *early = NULL;
  s.last.seconds = 12.0;
  assert_int_equal(ambulo_audit_progress(s.problem, NULL, &s.last, ending, NULL, NULL, &early),
                   AMBULO_OK);
  assert_true(ambulo_result_objective(early) == ambulo_result_objective(result));
  assert_int_equal(ambulo_result_verdict(early), verdict);
  assert_int_equal(ambulo_result_ending_code(early), ending);
  assert_non_null(strstr(ambulo_result_ending(early), "did not answer"));
  assert_int_equal(ambulo_result_evaluations(early), s.last.evaluations);
  assert_int_equal(ambulo_result_iterations(early), s.last.iteration);
  assert_true(ambulo_result_timing(early)->total >= 12.0);
  assert_true(isinf(ambulo_result_audit(early)->kkt)); /* nothing is said that was not looked at */
  ambulo_result_free(early);
  end(&s, result);
}

static void limit_of_time(void **state) {
  (void)state;
  judged_as_it_would_have_been(AMBULO_ENDING_TIME, AMBULO_FEASIBLE);
}

static void stop_of_the_caller(void **state) {
  (void)state;
  judged_as_it_would_have_been(AMBULO_ENDING_CALLER, AMBULO_INTERRUPTED);
}

/* before anything was shown: the start pose, which is no solution */
static void nothing_was_shown(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("walker_2d_step");
  ambulo_progress last = {.objective = NAN};
  ambulo_result *result = NULL;
  assert_int_equal(
      ambulo_audit_progress(problem, NULL, &last, AMBULO_ENDING_TIME, NULL, NULL, &result),
      AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_LIMIT_REACHED);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* a point without values has a verdict too */
static void point_is_not_finite(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("two_link_reach");
  int n = ambulo_problem_variable_count(problem);
  double *x = calloc((size_t)n, sizeof *x);
  assert_non_null(x);
  x[0] = NAN;
  ambulo_progress last = {.point = x};
  ambulo_result *result = NULL;
  assert_int_equal(
      ambulo_audit_progress(problem, NULL, &last, AMBULO_ENDING_TIME, NULL, NULL, &result),
      AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_NUMERIC_FAILURE);
  ambulo_result_free(result);
  free(x);
  ambulo_problem_free(problem);
}

/* the points of coarser grids are told apart by their problem */
static void point_belongs_to_its_problem(void **state) {
  (void)state;
  shown s;
  ambulo_result *result = solve(&s, "yardstick_12", AMBULO_AUTO), *early = NULL;
  assert_true(s.calls > s.others);
  assert_int_equal(
      ambulo_audit_progress(s.problem, NULL, &s.last, AMBULO_ENDING_TIME, NULL, NULL, &early),
      AMBULO_OK);
  assert_true(ambulo_result_objective(early) < 1.01 * ambulo_result_objective(result));
  ambulo_result_free(early);
  end(&s, result);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(best_point_is_shown), cmocka_unit_test(limit_of_time),
      cmocka_unit_test(stop_of_the_caller),  cmocka_unit_test(nothing_was_shown),
      cmocka_unit_test(point_is_not_finite), cmocka_unit_test(point_belongs_to_its_problem),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
