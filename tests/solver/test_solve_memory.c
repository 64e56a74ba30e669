/* Predicted memory against what is taken, counted by an allocator; absurd sizes are refused. */
#include "solver/session.h"
#include "ambulo/tools/load.h"
#include "base/machine.h"
#include "problem/nlp.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"
#include "support/messages.h"

#include <limits.h>

typedef struct counter {
  double now, peak;
} counter;

enum { HEADER = 64 };

static void *count(void *user, void *pointer, size_t size) {
  counter *c = user;
  char *block = pointer ? (char *)pointer - HEADER : NULL;
  size_t before = 0;
  if (block) memcpy(&before, block, sizeof before);
  c->now -= (double)before;
  if (size == 0) {
    free(block);
    return NULL;
  }
  block = realloc(block, size + HEADER);
  if (!block) return NULL;
  memcpy(block, &size, sizeof size);
  c->now += (double)size;
  if (c->now > c->peak) c->peak = c->now;
  return block + HEADER;
}

/* peak of loading (without the text of the file) and solving */
static double peak_of(const char *path, const char *override, double *problem_bytes) {
  counter c = {0.0, 0.0};
  ambulo_allocator allocator = {count, &c};
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(
      ambulo_problem_load(path, &override, override != NULL, &allocator, NULL, &problem),
      AMBULO_OK);
  *problem_bytes = c.peak = c.now;
  assert_int_equal(ambulo_solve(problem, NULL, NULL, &allocator, NULL, &result), AMBULO_OK);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  assert_true(c.now == 0.0);
  return c.peak;
}

static void predictions_hold(void **state) {
  (void)state;
  static const char *const cases[][2] = {{"tests/support/walk_rigid.yaml", NULL},
                                         {"tests/support/walk_without_reaction.yaml", NULL},
                                         {"models/yardstick_12.yaml", NULL},
                                         {"models/yardstick_72.yaml", NULL},
                                         {"tests/support/walker_2d_step.yaml", "time.intervals=96"},
                                         {"tests/infeasible/step_too_long.yaml", NULL}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo_problem *problem = NULL;
    assert_int_equal(ambulo_problem_load(cases[i][0], (const char *const *)&cases[i][1],
                                         cases[i][1] != NULL, NULL, NULL, &problem),
                     AMBULO_OK);
    ambulo_memory said = ambulo_problem_memory(problem);
    double taken = 0.0, peak = peak_of(cases[i][0], cases[i][1], &taken);
    double ratio = said.solve / peak;
    if (!(ratio >= 1.0 && ratio <= 2.0))
      print_error("%s: %g MB predicted, %g MB taken\n", cases[i][0], 1e-6 * said.solve,
                  1e-6 * peak);
    assert_true(ratio >= 1.0 && ratio <= 2.0);
    assert_true(said.evaluation < said.solve && said.problem < said.solve);
    ambulo_problem_free(problem);
  }
}

static void a_solve_that_does_not_fit_is_refused(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_72");
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_result *result = NULL;
  options.maximum_memory = 0.5 * ambulo_problem_memory(problem).solve;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, list, &result), AMBULO_E_LIMIT);
  assert_null(result);
  assert_message(list, 0, "1350 unknowns, 54 diagonals, 3780 rows");
  options.maximum_memory = 1.1 * ambulo_problem_memory(problem).solve;
  assert_int_equal(ambulo__solve_check_memory(problem, &options, list), AMBULO_OK);
  ambulo_diagnostics_free(list);
  ambulo_problem_free(problem);
}

/* refused before the rows are there: in no time, with the figures */
static void absurd_problems_are_refused(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *problem = load_problem("yardstick_12");
  ambulo_problem_definition definition = problem->definition;
  ambulo_problem *huge = NULL;
  ambulo_tube tubes[16];
  int d = problem->coordinates;
  double *reference = calloc((size_t)(2 * d), sizeof *reference);
  double *width = calloc((size_t)d, sizeof *width);
  for (int t = 0; t < 16; t++) tubes[t] = (ambulo_tube){2, reference, width};
  definition.intervals = 100000;
  definition.tubes = tubes;
  definition.tube_count = 16; /* 68 million rows */
  definition.terms = NULL;
  definition.term_count = 0;
  definition.speed_limits = definition.torque_limits = 1;
  assert_int_equal(ambulo_problem_create(&definition, NULL, list, &huge), AMBULO_E_LIMIT);
  assert_message(list, 0, "100001 time nodes");
  assert_message(list, 0, "at most 50 million rows");
  free(reference);
  free(width);
  ambulo_diagnostics_free(list);
  ambulo_problem_free(problem);
}

/* without a limit of its own a solve has what the machine has left */
static void what_the_machine_has_is_the_limit(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_12");
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  int variables = problem->variables;
  if (ambulo__free_megabytes() > 0.0) {
    assert_int_equal(ambulo__solve_check_memory(problem, &options, list), AMBULO_OK);
    problem->variables = INT_MAX; /* a few terabytes */
    assert_int_equal(ambulo__solve_check_memory(problem, &options, list), AMBULO_E_LIMIT);
    assert_message(list, 0, " GB (free)");
    problem->variables = variables;
  }
  ambulo_diagnostics_free(list);
  ambulo_problem_free(problem);
}

/* with and without Jacobians; small arrays are not counted */
static void workspaces_are_predicted(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("support/walk_rigid");
  for (int jacobians = 0; jacobians < 2; jacobians++) {
    counter c = {0.0, 0.0};
    ambulo_allocator allocator = {count, &c};
    ambulo_workspace *w = NULL;
    ambulo_status status = jacobians ? ambulo_workspace_create(problem, &allocator, &w)
                                     : ambulo__workspace_create_for_values(problem, &allocator, &w);
    assert_int_equal(status, AMBULO_OK);
    double ratio = ambulo__workspace_bytes(problem, jacobians) / c.peak;
    if (!(ratio > 0.9 && ratio < 1.1)) print_error("%d: ratio %g\n", jacobians, ratio);
    assert_true(ratio > 0.9 && ratio < 1.1);
    ambulo_workspace_free(w);
  }
  ambulo_problem_free(problem);
}

/* the message of a lack of memory says how much it takes */
static void lack_of_memory_tells_the_figure(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(20);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  ambulo_problem *problem = load_problem("pendulum_swing");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, NULL, NULL, &allocator, list, &result), AMBULO_E_MEMORY);
  assert_message(list, 0, "cannot allocate memory to solve the problem; it takes about ");
  assert_int_equal(memory.live, 0);
  ambulo_diagnostics_free(list);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(predictions_hold),
                                     cmocka_unit_test(lack_of_memory_tells_the_figure),
                                     cmocka_unit_test(a_solve_that_does_not_fit_is_refused),
                                     cmocka_unit_test(absurd_problems_are_refused),
                                     cmocka_unit_test(what_the_machine_has_is_the_limit),
                                     cmocka_unit_test(workspaces_are_predicted)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
