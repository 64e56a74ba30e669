/* Two threads give the bits of a serial run: with a problem each, and with a shared problem and
 * a workspace each. Nothing is locked; there is nothing to lock. */
#include <pthread.h>

#include "support/arm.h"
#include "support/test.h"

enum { threads = 2, points = 40, most_variables = 64, most_rows = 512 };

typedef struct outcome {
  double objective, gradient[most_variables], rows[most_rows], x[most_variables];
  ambulo_status status;
} outcome;

typedef struct job {
  const ambulo_problem *problem;
  double phase;        /* which points this thread evaluates */
  const double *start; /* for solves */
  outcome results[points];
} job;

static ambulo_problem *arm_problem(const ambulo_model *model, int intervals) {
  ambulo_problem_definition definition = arm_definition(model);
  definition.intervals = intervals;
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  assert_true(ambulo_problem_variable_count(problem) <= most_variables);
  assert_true(ambulo_problem_row_count(problem) <= most_rows);
  return problem;
}

/* no assertion here: cmocka jumps, and a jump must not leave its thread */
static void *evaluate_all(void *argument) {
  job *j = argument;
  ambulo_workspace *workspace = NULL;
  ambulo_status status = ambulo_workspace_create(j->problem, NULL, &workspace);
  int n = ambulo_problem_variable_count(j->problem);
  for (int k = 0; k < points; k++) {
    outcome *o = &j->results[k];
    for (int i = 0; i < n; i++) o->x[i] = 0.5 * sin(j->phase + 0.37 * i + 0.11 * k);
    o->status = status;
    if (!o->status)
      o->status =
          ambulo_problem_evaluate(j->problem, workspace, o->x, &o->objective, NULL, o->rows);
    if (!o->status)
      o->status = ambulo_problem_gradient(j->problem, workspace, o->x, 1.0, NULL, o->gradient);
  }
  ambulo_workspace_free(workspace);
  return NULL;
}

static void *solve_once(void *argument) {
  job *j = argument;
  outcome *o = &j->results[0];
  ambulo_options options = ambulo_options_default();
  ambulo_result *result = NULL;
  o->status = ambulo_solve(j->problem, &options, j->start, NULL, NULL, &result);
  if (!o->status) {
    size_t n = (size_t)ambulo_problem_variable_count(j->problem);
    memcpy(o->x, ambulo_result_x(result), n * sizeof *o->x);
    o->objective = ambulo_result_objective(result);
  }
  ambulo_result_free(result);
  return NULL;
}

static void run_serial(job jobs[threads], void *(*work)(void *)) {
  for (int i = 0; i < threads; i++) work(&jobs[i]);
}

static void run_together(job jobs[threads], void *(*work)(void *)) {
  pthread_t handles[threads];
  for (int i = 0; i < threads; i++)
    assert_int_equal(pthread_create(&handles[i], NULL, work, &jobs[i]), 0);
  for (int i = 0; i < threads; i++) assert_int_equal(pthread_join(handles[i], NULL), 0);
}

static void compare(const job *serial, const job *together, int count) {
  for (int i = 0; i < threads; i++) {
    for (int k = 0; k < count; k++) {
      const outcome *a = &serial[i].results[k], *b = &together[i].results[k];
      assert_int_equal(a->status, AMBULO_OK);
      if (memcmp(a, b, sizeof *a) != 0)
        print_error("thread %d, point %d: objective %.17g serially, %.17g in a thread\n", i, k,
                    a->objective, b->objective);
      assert_memory_equal(a, b, sizeof *a);
    }
  }
}

static void check_same_bits(const ambulo_problem *const problems[threads], const double *start,
                            void *(*work)(void *), int count) {
  job *serial = calloc(threads, sizeof *serial), *together = calloc(threads, sizeof *together);
  for (int i = 0; i < threads; i++) {
    serial[i].problem = together[i].problem = problems[i];
    serial[i].phase = together[i].phase = 1.0 + i;
    serial[i].start = together[i].start = start;
  }
  run_serial(serial, work);
  run_together(together, work);
  compare(serial, together, count);
  free(serial);
  free(together);
}

static void evaluation_of_two_problems(void **state) {
  (void)state;
  ambulo_model *models[threads] = {arm_create(), arm_create()};
  ambulo_problem *problems[threads] = {arm_problem(models[0], 12), arm_problem(models[1], 20)};
  check_same_bits((const ambulo_problem *const *)problems, NULL, evaluate_all, points);
  for (int i = 0; i < threads; i++) {
    ambulo_problem_free(problems[i]);
    ambulo_model_free(models[i]);
  }
}

static void evaluation_of_one_shared_problem(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem *problem = arm_problem(model, 16);
  const ambulo_problem *const shared[threads] = {problem, problem};
  check_same_bits(shared, NULL, evaluate_all, points);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

static void solution_of_two_problems(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem *problems[threads] = {arm_problem(model, 12), arm_problem(model, 20)};
  check_same_bits((const ambulo_problem *const *)problems, NULL, solve_once, 1);
  for (int i = 0; i < threads; i++) ambulo_problem_free(problems[i]);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(evaluation_of_two_problems),
      cmocka_unit_test(evaluation_of_one_shared_problem),
      cmocka_unit_test(solution_of_two_problems),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
