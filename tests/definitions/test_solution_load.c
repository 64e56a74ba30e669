/* solution.yaml: the same bits on the same grid, the same motion on another, and refusals. */
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/walker_solution.h"

static void test_same_bits(void **state) {
  walk w;
  walk_open(&w, 12);
  int n = ambulo_problem_variable_count(w.problem);
  for (int i = 0; i < n; i++) w.result->x[i] += 1.0 / (3.0 + i);
  w.result->x[5] = 1e-300;
  w.result->x[6] = -0.1;
  const char *path = write_solution(state, &w);
  double *x = calloc((size_t)n, sizeof *x);
  assert_int_equal(ambulo_solution_load(path, w.problem, NULL, NULL, x), AMBULO_OK);
  assert_memory_equal(x, w.result->x, (size_t)n * sizeof *x);
  free(x);
  walk_close(&w);
}

/* knots of 12 intervals are among those of 24: the motion stays what it was */
static void test_finer_grid(void **state) {
  walk coarse, fine;
  walk_open(&coarse, 12);
  walk_open(&fine, 24);
  const char *path = write_solution(state, &coarse);
  assert_int_equal(ambulo_solution_load(path, fine.problem, NULL, NULL, fine.result->x), AMBULO_OK);
  ambulo_workspace *a = NULL, *b = NULL;
  assert_int_equal(ambulo_workspace_create(coarse.problem, NULL, &a), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(fine.problem, NULL, &b), AMBULO_OK);
  double times[7], q[2][7 * WALKER_COORDINATES];
  for (int k = 0; k < 7; k++) times[k] = walker_step_time * k / 6.5;
  ambulo_motion first = {.size = sizeof(ambulo_motion), .q = q[0]},
                second = {.size = sizeof(ambulo_motion), .q = q[1]};
  assert_int_equal(ambulo_problem_motion(coarse.problem, a, coarse.result->x, 7, times, &first), 0);
  assert_int_equal(ambulo_problem_motion(fine.problem, b, fine.result->x, 7, times, &second), 0);
  for (int i = 0; i < 7 * WALKER_COORDINATES; i++) assert_close(q[1][i], q[0][i], 1e-11);
  ambulo_workspace_free(a);
  ambulo_workspace_free(b);
  walk_close(&coarse);
  walk_close(&fine);
}

/* One period as the start of three: each follows from the one before, mirrored or not, carried on
 * by what the first one travels. */
static void test_repeated(void **state) {
  enum { PERIODS = 3, D = WALKER_COORDINATES };
  for (int mirrored = 0; mirrored < 2; mirrored++) {
    walk one;
    walk_open(&one, 12);
    ambulo_problem_definition d = ambulo_problem_definition_default();
    d.model = one.model;
    d.duration = PERIODS * walker_step_time;
    d.intervals = d.spline_intervals = 12 * PERIODS;
    ambulo_problem *many = NULL;
    assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &many), AMBULO_OK);
    double *x = calloc((size_t)ambulo_problem_variable_count(many), sizeof *x);
    const ambulo_model *model = one.model;
    int points = ambulo_problem_control_point_count(one.problem);
    for (int i = 0; i < D; i++) {
      const ambulo_coordinate *c = ambulo_model_coordinate(model, i);
      double begin = i <= c->mirror ? 0.1 : 0.3, end = begin;
      if (mirrored && c->mirror != i) end = 0.4 - begin;
      if (c->type == AMBULO_PRISMATIC) end += 0.5 + i;
      for (int j = 0; j < points; j++)
        one.result->x[j * D + i] = begin + (end - begin) * j / (points - 1);
    }
    const char *path = write_solution(state, &one);
    ambulo_ends ends = mirrored ? AMBULO_ENDS_MIRRORED : AMBULO_ENDS_PERIODIC;
    assert_int_equal(ambulo_solution_repeat(path, many, ends, NULL, NULL, x), AMBULO_OK);
    ambulo_workspace *w = NULL;
    assert_int_equal(ambulo_workspace_create(many, NULL, &w), AMBULO_OK);
    double times[PERIODS], q[PERIODS][D];
    for (int k = 0; k < PERIODS; k++) times[k] = walker_step_time * (k + 0.3);
    ambulo_motion motion = {.size = sizeof(ambulo_motion), .q = q[0]};
    assert_int_equal(ambulo_problem_motion(many, w, x, PERIODS, times, &motion), AMBULO_OK);
    for (int k = 0; k + 1 < PERIODS; k++) {
      for (int i = 0; i < D; i++) {
        const ambulo_coordinate *c = ambulo_model_coordinate(model, i);
        double travel = c->type == AMBULO_PRISMATIC ? 0.5 + i : 0.0;
        assert_close(q[k + 1][mirrored ? c->mirror : i], q[k][i] + travel, 1e-2);
      }
    }
    assert_int_equal(ambulo_solution_repeat(path, many, AMBULO_ENDS_FREE, NULL, NULL, x),
                     AMBULO_E_ARGUMENT);
    ambulo_workspace_free(w);
    free(x);
    ambulo_problem_free(many);
    walk_close(&one);
  }
}

/* replaces the first occurrence of `old` in the solution and loads it */
static void refuse(void **state, const char *old, const char *fresh, ambulo_status expected,
                   const char *message) {
  walk w;
  walk_open(&w, 12);
  const char *path = write_solution(state, &w);
  char *text = read_text(path), *at = strstr(text, old);
  assert_non_null(at);
  char *changed = malloc(strlen(text) + strlen(fresh) + 1);
  sprintf(changed, "%.*s%s%s", (int)(at - text), text, fresh, at + strlen(old));
  scratch_write(path, changed);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  double *x = calloc((size_t)ambulo_problem_variable_count(w.problem), sizeof *x);
  ambulo_status status = ambulo_solution_load(path, w.problem, NULL, list, x);
  if (status != expected)
    print_error("'%s' for '%s' gave %s\n", fresh, old, ambulo_status_name(status));
  assert_int_equal(status, expected);
  assert_message(list, 0, message);
  for (int i = 0; i < ambulo_problem_variable_count(w.problem); i++) assert_true(x[i] == 0.0);
  free(x);
  ambulo_diagnostics_free(list);
  free(changed);
  free(text);
  walk_close(&w);
}

static void test_refusals(void **state) {
  refuse(state, "kind: solution", "kind: model", AMBULO_E_SCHEMA, "solution");
  refuse(state, "pelvis_ty", "pelvis_up", AMBULO_E_PROBLEM, "no coordinate 'pelvis_up'");
  refuse(state, "pelvis_ty", "pelvis_tx", AMBULO_E_SCHEMA, "appears twice");
  refuse(state, "duration: 0.55", "duration: 0.6", AMBULO_E_PROBLEM, "lasts 0.6 s");
  refuse(state, "degree: 3", "degree: 4", AMBULO_E_SCHEMA, "got 15 control points; expected 16");
  refuse(state, "  - [", "  - [nan, ", AMBULO_E_SCHEMA, "solution.yaml:");
  refuse(state, "breakpoints: [0, ", "breakpoints: [0.1, ", AMBULO_E_SCHEMA, "rise");
  refuse(state, "kind: solution", "kind: solution\nsped: 1", AMBULO_E_SCHEMA, "sped");
}

static void test_missing_file(void **state) {
  walk w;
  walk_open(&w, 12);
  double x = 0.0;
  assert_int_equal(
      ambulo_solution_load(scratch_path(state, "none.yaml"), w.problem, NULL, NULL, &x),
      AMBULO_E_IO);
  walk_close(&w);
}

static void test_out_of_memory(void **state) {
  walk coarse, fine;
  walk_open(&coarse, 4);
  walk_open(&fine, 8);
  const char *path = write_solution(state, &coarse);
  int n = ambulo_problem_variable_count(fine.problem);
  double *x = calloc((size_t)n, sizeof *x);
  long k = 0;
  for (;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_status status = ambulo_solution_load(path, fine.problem, &allocator, NULL, x);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) {
      assert_int_equal(status, AMBULO_OK);
      break;
    }
    assert_int_equal(status, AMBULO_E_MEMORY);
    for (int i = 0; i < n; i++) assert_true(x[i] == 0.0);
  }
  assert_true(k > 5);
  free(x);
  walk_close(&coarse);
  walk_close(&fine);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {
      SCRATCH_TEST(test_same_bits),    SCRATCH_TEST(test_finer_grid),
      SCRATCH_TEST(test_repeated),     SCRATCH_TEST(test_refusals),
      SCRATCH_TEST(test_missing_file), SCRATCH_TEST(test_out_of_memory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
