/* Impulses of the ground's force: momentum is balanced over a stride, and each foot's share is what
 * a very fine sum gives. */
#include "people/impulse.h"
#include "ambulo/tools/load.h"
#include "people/stride.h"
#include "support/fail_alloc.h"
#include "support/test.h"

typedef struct solved {
  ambulo_problem *problem;
  ambulo_result *result;
} solved;

static solved solve(const char *file, const char *const *overrides, int count) {
  solved s = {NULL, NULL};
  assert_int_equal(ambulo_problem_load(file, overrides, count, NULL, NULL, &s.problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(s.problem, NULL, NULL, NULL, NULL, &s.result), AMBULO_OK);
  return s;
}

static void release(solved *s) {
  ambulo_result_free(s->result);
  ambulo_problem_free(s->problem);
}

static double along(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* over a stride that repeats, the ground gives back what gravity takes: 794.61 N s of 75 kg in
 * 1.08 s, and nothing forward on level ground */
static void a_stride_gains_no_momentum(void **state) {
  (void)state;
  static const char *const files[] = {"tests/two_step/walk_normal.yaml",
                                      "tests/two_step/walk_uphill.yaml",
                                      "tests/two_step/walk_asymmetric.yaml"};
  for (int i = 0; i < 3; i++) {
    solved s = solve(files[i], NULL, 0);
    const ambulo_model *model = s.problem->model;
    double impulse[6], sum[3], mass = ambulo_model_mass(model);
    double time = ambulo_problem_duration(s.problem);
    if (ambulo_problem_ends(s.problem) == AMBULO_ENDS_MIRRORED) time *= 2.0;
    assert_int_equal(ambulo__impulses(s.problem, ambulo_result_x(s.result), NULL, impulse), 0);
    for (int k = 0; k < 3; k++) {
      sum[k] = impulse[k] + impulse[3 + k] + mass * ambulo_model_gravity(model)[k] * time;
      assert_close(sum[k] / (mass * 9.81 * time), 0.0, 1e-6);
    }
    if (i == 0)
      assert_close(along(impulse, model->up) + along(impulse + 3, model->up), 794.61, 1e-5);
    release(&s);
  }
}

/* 20,000 intervals of the trapezoidal rule; a periodic stride, and a step with its mirror image */
static void each_foot_gets_its_own(void **state) {
  (void)state;
  static const char *const coarse[] = {"time.intervals=12", "trajectory.intervals=9"};
  static const char *const files[] = {"tests/two_step/walk_asymmetric.yaml",
                                      "tests/two_step/walk_normal.yaml"};
  enum { FINE = 20001 };
  for (int k = 0; k < 2; k++) {
    solved s = solve(files[k], coarse, 2);
    ambulo__stride stride = {.samples = 0};
    double impulse[6];
    assert_int_equal(
        ambulo__stride_create(s.problem, ambulo_result_x(s.result), FINE, NULL, &stride),
        AMBULO_OK);
    assert_int_equal(ambulo__impulses(s.problem, ambulo_result_x(s.result), NULL, impulse), 0);
    for (int i = 0; i < 6; i++) {
      double sum = 0.0, step = stride.duration / (FINE - 1);
      for (int n = 0; n < FINE; n++)
        sum += (n % (FINE - 1) ? step : 0.5 * step) * stride.grf[6 * n + i];
      assert_close(impulse[i] / 800.0, sum / 800.0, 2e-5);
    }
    ambulo__stride_free(&stride);
    release(&s);
  }
}

static void nothing_without_ground_reaction(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  double untouched = 7.0;
  assert_int_equal(
      ambulo_problem_load("models/walk_without_reaction.yaml", NULL, 0, NULL, NULL, &problem), 0);
  double *x = calloc((size_t)problem->variables, sizeof *x);
  assert_int_equal(ambulo__impulses(problem, x, NULL, &untouched), AMBULO_OK);
  assert_close(untouched, 7.0, 0.0);
  free(x);
  ambulo_problem_free(problem);
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/two_step/walk_normal.yaml", NULL, 0, NULL, NULL, &problem), 0);
  double *x = calloc((size_t)problem->variables, sizeof *x), impulse[6] = {7.0};
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_status status = ambulo__impulses(problem, x, &hook, impulse);
    assert_int_equal(memory.live, 0);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (!memory.failed) break;
    assert_close(impulse[0], 7.0, 0.0);
    assert_true(k < 99);
  }
  free(x);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_stride_gains_no_momentum),
                                     cmocka_unit_test(each_foot_gets_its_own),
                                     cmocka_unit_test(nothing_without_ground_reaction),
                                     cmocka_unit_test(every_allocation_may_fail)};
  return cmocka_run_group_tests_name("stride/impulse", tests, NULL, NULL);
}
