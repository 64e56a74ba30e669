/* The solver object: other ends, references and times on one problem, with few iterations. */
#include "ambulo/tools/load.h"
#include "model/neutral_pose.h"
#include "problem/nlp.h"
#include "solver/result.h"
#include "support/fail_alloc.h"
#include "support/problem_path.h"
#include "support/test.h"

static const double degree = 3.14159265358979323846 / 180.0;

static ambulo_problem *open_problem(const char *name, const char *override) {
  char path[96];
  ambulo_problem *problem = NULL;
  problem_path(name, path, sizeof path);
  assert_int_equal(ambulo_problem_load(path, &override, override != NULL, NULL, NULL, &problem),
                   AMBULO_OK);
  return problem;
}

static ambulo_solver *open_solver(const ambulo_problem *problem) {
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_solver *solver = NULL;
  options.algorithm = AMBULO_AUGLAG;
  options.dense_samples = 1;
  assert_int_equal(ambulo_solver_create(problem, &options, NULL, NULL, &solver), AMBULO_OK);
  return solver;
}

static const ambulo_solver_state *iterate(ambulo_solver *solver, int iterations) {
  const ambulo_solver_state *state = NULL;
  assert_int_equal(ambulo_solver_iterate(solver, iterations, AMBULO_OFF, &state), AMBULO_OK);
  return state;
}

static double solved(const ambulo_problem *problem) {
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *result = NULL;
  options.algorithm = AMBULO_AUGLAG;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  double objective = ambulo_result_objective(result);
  ambulo_result_free(result);
  return objective;
}

/* what a problem with the other end comes to, in a share of the iterations */
static void another_end_is_another_problem(void **state) {
  (void)state;
  ambulo_problem *problem = open_problem("support/two_link_reach", NULL);
  ambulo_problem *other = open_problem("support/two_link_reach", "ends.final.shoulder=-20");
  int shoulder = ambulo_model_find_coordinate(problem->model, "shoulder");
  ambulo_solver *solver = open_solver(problem);
  const ambulo_solver_state *s = iterate(solver, 150);
  assert_true(s->converged && s->feasible);
  assert_close(s->objective, solved(problem), 1e-5);
  assert_int_equal(ambulo_solver_set_end(solver, shoulder, 0, 1, -20.0 * degree), AMBULO_OK);
  s = iterate(solver, 150);
  assert_true(s->converged && s->feasible);
  assert_close(s->objective, solved(other), 1e-4);
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solver_result(solver, NULL, &result), AMBULO_OK);
  assert_true(ambulo_verdict_is_solution(ambulo_result_verdict(result)));
  assert_memory_equal(ambulo_result_x(result), s->x, (size_t)problem->variables * sizeof(double));
  ambulo_result_free(result);
  ambulo_solver_free(solver);
  ambulo_problem_free(problem);
  ambulo_problem_free(other);
}

/* what was at t + d is at t; behind the end the body rests */
static void a_shift_moves_the_motion(void **state) {
  (void)state;
  enum { TIMES = 9 };
  ambulo_problem *problem = open_problem("support/two_link_reach", "trajectory.intervals=40");
  ambulo_solver *solver = open_solver(problem);
  const ambulo_solver_state *s = iterate(solver, 150);
  ambulo_workspace *w = NULL;
  double before[TIMES][2], after[TIMES][2], times[TIMES];
  ambulo_motion one = {.size = sizeof one, .q = before[0]},
                two = {.size = sizeof two, .q = after[0]};
  assert_int_equal(ambulo_workspace_create(problem, NULL, &w), AMBULO_OK);
  for (int k = 0; k < TIMES; k++) times[k] = fmin(0.8, 0.1 * k + 0.06);
  assert_int_equal(ambulo_problem_motion(problem, w, s->x, TIMES, times, &one), AMBULO_OK);
  assert_int_equal(ambulo_solver_shift(solver, 0.06), AMBULO_OK);
  for (int k = 0; k < TIMES; k++) times[k] = 0.1 * k;
  assert_int_equal(ambulo_problem_motion(problem, w, s->x, TIMES, times, &two), AMBULO_OK);
  for (int k = 0; k < TIMES; k++)
    for (int i = 0; i < 2; i++) assert_close(after[k][i], before[k][i], 2e-3);
  assert_int_equal(ambulo_solver_shift(solver, -0.1), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_shift(solver, 0.9), AMBULO_E_ARGUMENT);
  ambulo_workspace_free(w);
  ambulo_solver_free(solver);
  ambulo_problem_free(problem);
}

/* A controller: the arm is disturbed at every cycle, and two inner solves bring it back. */
static void two_inner_solves_a_cycle(void **state) {
  (void)state;
  enum { CYCLES = 40 };
  ambulo_problem *problem = open_problem("support/two_link_reach", NULL);
  ambulo_solver *solver = open_solver(problem);
  const ambulo_solver_state *s = iterate(solver, 150);
  double worst = 0.0;
  for (int c = 0; c < CYCLES; c++) {
    double off = 0.5 * degree * sin(1.7 * c);
    for (int i = 0; i < 2; i++)
      assert_int_equal(ambulo_solver_set_end(solver, i, 0, 0, (i ? 0.0 : -90.0 * degree) + off),
                       AMBULO_OK);
    s = iterate(solver, 2);
    assert_in_range(s->iterations, 0, 2);
    worst = fmax(worst, s->worst.worst / s->worst.size);
  }
  assert_true(worst < 1e-3);
  s = iterate(solver, 20); /* without a disturbance to the tolerance */
  assert_true(s->converged && s->feasible);
  ambulo_solver_free(solver);
  ambulo_problem_free(problem);
}

/* a budget that is too small says what is missing */
static void a_budget_says_what_is_missing(void **state) {
  (void)state;
  ambulo_problem *problem = open_problem("yardstick_12", NULL);
  ambulo_solver *solver = open_solver(problem);
  const ambulo_solver_state *s = iterate(solver, 1);
  assert_true(!s->converged && !s->feasible);
  assert_int_equal(s->ending, AMBULO_ENDING_ITERATIONS);
  assert_true(s->worst.worst > 0.0 && s->worst.family[0] != '\0');
  double first = s->worst.worst / s->worst.size;
  for (int k = 0; k < 30 && !s->converged; k++) s = iterate(solver, 3);
  assert_true(s->converged && s->feasible && s->worst.worst / s->worst.size < first);
  ambulo_solver_free(solver);
  ambulo_problem_free(problem);
}

static double objective_at_start(ambulo_solver *solver) {
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solver_result(solver, NULL, &result), AMBULO_OK);
  double objective = ambulo_result_objective(result);
  ambulo_result_free(result);
  return objective;
}

/* From a solution, which holds every row, one inner solve a call leads to what is asked now; and a
 * result of any of them is judged whole, however small the budget was. */
static void a_solution_is_left_for_another_reference(void **state) {
  (void)state;
  ambulo_problem *problem = open_problem("walk_tracking", "time.intervals=24");
  const ambulo_problem_definition *d = &problem->definition;
  const ambulo_solver_state *s = NULL;
  int t = 0;
  while (!d->terms[t].reference) t++;
  size_t count = (size_t)problem->nodes * (size_t)problem->coordinates;
  double *other = calloc(count, sizeof *other);
  for (size_t i = 0; i < count; i++)
    other[i] = d->terms[t].reference[i] + 0.02 * sin(0.1 * (double)i);
  ambulo_solver *solver = open_solver(problem);
  s = iterate(solver, 300);
  assert_true(s->feasible);
  assert_int_equal(ambulo_solver_set_reference(solver, t, other), AMBULO_OK);
  double before = objective_at_start(solver);
  for (int k = 0; k < 40; k++)
    assert_int_equal(ambulo_solver_iterate(solver, 1, 10.0, &s), AMBULO_OK);
  assert_true(s->worst.worst / s->worst.size < 1e-3);
  assert_true(s->objective < 0.99 * before);
  assert_int_equal(ambulo_solver_iterate(solver, 1, 1e-9, &s), AMBULO_OK);
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solver_result(solver, NULL, &result), AMBULO_OK);
  assert_true(isfinite(ambulo_result_audit(result)->kkt));
  ambulo_result_free(result);
  free(other);
  ambulo_solver_free(solver);
  ambulo_problem_free(problem);
}

/* half the reference, and back */
static void another_reference_is_followed(void **state) {
  (void)state;
  ambulo_problem *problem = open_problem("walk_tracking", NULL);
  const ambulo_problem_definition *d = &problem->definition;
  int t = 0;
  while (!d->terms[t].reference) t++;
  size_t count = (size_t)problem->nodes * (size_t)problem->coordinates;
  double *half = calloc(count, sizeof *half);
  for (size_t i = 0; i < count; i++) half[i] = 0.5 * d->terms[t].reference[i];
  ambulo_solver *solver = open_solver(problem);
  double whole = objective_at_start(solver);
  assert_int_equal(ambulo_solver_set_reference(solver, t, half), AMBULO_OK);
  double other = objective_at_start(solver);
  assert_true(other < 0.9 * whole);
  assert_int_equal(ambulo_solver_set_reference(solver, t, d->terms[t].reference), AMBULO_OK);
  assert_true(objective_at_start(solver) == whole);
  free(half);
  ambulo_solver_free(solver);
  ambulo_problem_free(problem);
}

static void refusals(void **state) {
  (void)state;
  ambulo_problem *problem = open_problem("support/two_link_reach", NULL);
  ambulo_solver *solver = NULL;
  const ambulo_solver_state *s = NULL;
  double *x = calloc((size_t)problem->variables, sizeof *x);
  ambulo_options options = ambulo_problem_options(problem);
  options.algorithm = AMBULO_SLSQP;
  assert_int_equal(ambulo_solver_create(problem, &options, NULL, NULL, &solver), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_create(NULL, NULL, NULL, NULL, &solver), AMBULO_E_ARGUMENT);
  assert_null(solver);
  solver = open_solver(problem);
  assert_int_equal(ambulo_solver_set_end(solver, 0, 2, 0, 0.1), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_set_end(solver, 0, 0, 0, (double)NAN), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_set_reference(solver, 0, x), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_set_reference(solver, 7, x), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_iterate(solver, 0, AMBULO_OFF, &s), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_iterate(solver, 1, 0.0, &s), AMBULO_E_ARGUMENT);
  x[3] = (double)NAN;
  assert_int_equal(ambulo_solver_start(solver, x, NULL), AMBULO_E_PROBLEM);
  assert_null(s);
  free(x);
  ambulo_solver_free(solver);
  ambulo_solver_free(NULL);
  ambulo_problem_free(problem);
}

/* refused once at any request, nothing is lost, and the next call goes on */
static void memory_may_run_out(void **state) {
  (void)state;
  ambulo_problem *problem = open_problem("support/two_link_reach", NULL);
  ambulo_options options = ambulo_problem_options(problem);
  options.algorithm = AMBULO_AUGLAG;
  options.dense_samples = 1;
  int refused = 0;
  for (long k = 0; k < 10000; k += k < 40 ? 1 : 7) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator a = fail_alloc_hook(&memory);
    ambulo_solver *solver = NULL;
    const ambulo_solver_state *s = NULL;
    memory.only_once = 1;
    ambulo_status status = ambulo_solver_create(problem, &options, &a, NULL, &solver);
    if (!status) status = ambulo_solver_iterate(solver, 20, AMBULO_OFF, &s);
    if (!status) status = ambulo_solver_shift(solver, 0.01);
    if (!status) status = ambulo_solver_iterate(solver, 20, AMBULO_OFF, &s);
    if (status) assert_int_equal(status, AMBULO_E_MEMORY);
    refused += status != AMBULO_OK;
    ambulo_solver_free(solver);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  assert_true(refused > 20);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(another_end_is_another_problem),
                                     cmocka_unit_test(a_shift_moves_the_motion),
                                     cmocka_unit_test(two_inner_solves_a_cycle),
                                     cmocka_unit_test(a_budget_says_what_is_missing),
                                     cmocka_unit_test(another_reference_is_followed),
                                     cmocka_unit_test(a_solution_is_left_for_another_reference),
                                     cmocka_unit_test(refusals),
                                     cmocka_unit_test(memory_may_run_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
