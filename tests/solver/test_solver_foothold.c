/* The solver object with another foothold: it is the solver of a problem with that foothold. */
#include "ambulo/tools/load.h"
#include "problem/nlp.h"
#include "support/fail_alloc.h"
#include "support/problem_path.h"
#include "support/test.h"

static const double degree = 3.14159265358979323846 / 180.0;
enum {
  STRIKE = 4
}; /* the first of three contacts in which the right foot stands on its foothold */

static ambulo_problem *open_problem(const char *name, const char *const *overrides, int count) {
  char path[96];
  ambulo_problem *problem = NULL;
  problem_path(name, path, sizeof path);
  assert_int_equal(ambulo_problem_load(path, overrides, count, NULL, NULL, &problem), AMBULO_OK);
  return problem;
}

static ambulo_problem *start(void) {
  return open_problem("support/rigid_walk_start", NULL, 0);
}

/* the walk with the right foot's next foothold at 0.55 m, -0.06 m, turned by 4 degrees if so */
static ambulo_problem *moved(int turned) {
  static const char *const overrides[] = {
      "contacts[4].place=[0.55, -0.06]", "contacts[5].place=[0.55, -0.06]",
      "contacts[6].place=[0.55, -0.06]", "contacts[4].heading=4",
      "contacts[5].heading=4",           "contacts[6].heading=4"};
  return open_problem("support/rigid_walk_start", overrides, turned ? 6 : 3);
}

static const double place[2] = {0.55, -0.06};

static ambulo_solver *open_solver(const ambulo_problem *problem) {
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_solver *solver = NULL;
  options.dense_samples = 1;
  assert_int_equal(ambulo_solver_create(problem, &options, NULL, NULL, &solver), AMBULO_OK);
  return solver;
}

/* values of rows and a gradient at some point, in one array, freed by the caller */
static double *judged(const ambulo_problem *p, size_t *count) {
  size_t rows = (size_t)p->rows, n = (size_t)p->variables;
  double *x = calloc(n, sizeof *x), *weight = calloc(rows, sizeof *weight);
  double *found = calloc(rows + n, sizeof *found);
  ambulo_workspace *w = NULL;
  for (size_t i = 0; i < n; i++) x[i] = 0.3 * sin(1.0 + 1.7 * (double)i);
  for (size_t r = 0; r < rows; r++) weight[r] = cos(0.3 * (double)r);
  assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
  assert_int_equal(ambulo__evaluate_jacobian(w, x), AMBULO_OK);
  memcpy(found, w->row_value, rows * sizeof *found);
  assert_int_equal(ambulo__gradient(w, 1.0, weight, found + rows), AMBULO_OK);
  ambulo_workspace_free(w);
  free(x);
  free(weight);
  *count = rows + n;
  return found;
}

static void assert_same(const ambulo_problem *a, const ambulo_problem *b, int same) {
  size_t count, other_count;
  double *one = judged(a, &count), *other = judged(b, &other_count);
  assert_int_equal(a->rows, b->rows);
  assert_int_equal(a->equalities, b->equalities);
  assert_int_equal(count, other_count);
  assert_int_equal(memcmp(one, other, count * sizeof *one) == 0, same);
  free(one);
  free(other);
}

/* to the last bit; and back again, and after a refusal */
static void it_is_the_problem_with_that_foothold(void **state) {
  (void)state;
  ambulo_problem *problem = start();
  for (int turned = 0; turned < 2; turned++) {
    ambulo_problem *other = moved(turned);
    ambulo_solver *solver = open_solver(problem);
    const ambulo_problem *own = ambulo_solver_problem(solver);
    double heading = turned ? 4.0 * degree : 0.0;
    assert_same(own, other, 0);
    assert_int_equal(ambulo_solver_set_foothold(solver, STRIKE + 1, place, heading), AMBULO_OK);
    assert_same(own, other, 1);
    assert_int_equal(ambulo_solver_set_foothold(solver, STRIKE, (double[]){3.0, 0.0}, 0.0),
                     AMBULO_E_PROBLEM);
    assert_same(own, other, 1);
    assert_int_equal(ambulo_solver_set_foothold(solver, STRIKE, (double[]){0.52, -0.05}, 0.0),
                     AMBULO_OK);
    assert_same(own, problem, 1);
    ambulo_solver_free(solver);
    ambulo_problem_free(other);
  }
  ambulo_problem_free(problem);
}

static double objective(ambulo_solver *solver, int iterations, int *taken) {
  const ambulo_solver_state *s = NULL;
  assert_int_equal(ambulo_solver_iterate(solver, iterations, AMBULO_OFF, &s), AMBULO_OK);
  assert_true(s->feasible && s->converged);
  *taken = s->iterations;
  return s->objective;
}

/* beside the solution, also where the factors are set up anew: a foot that turns */
static void it_goes_on_beside_the_solution(void **state) {
  (void)state;
  ambulo_problem *problem = start();
  for (int turned = 0; turned < 2; turned++) {
    ambulo_problem *other = moved(turned);
    ambulo_solver *solver = open_solver(problem), *fresh = open_solver(other);
    int first, again, from_zero;
    double heading = turned ? 4.0 * degree : 0.0;
    (void)objective(solver, 300, &first);
    assert_int_equal(ambulo_solver_set_foothold(solver, STRIKE, place, heading), AMBULO_OK);
    double here = objective(solver, 300, &again), there = objective(fresh, 300, &from_zero);
    print_message("turned %d: %.6f in %d, %.6f in %d\n", turned, here, again, there, from_zero);
    assert_close(here / there, 1.0, 2e-3);
    assert_true(2 * again < from_zero);
    ambulo_solver_free(solver);
    ambulo_solver_free(fresh);
    ambulo_problem_free(other);
  }
  ambulo_problem_free(problem);
}

static void refusals(void **state) {
  (void)state;
  ambulo_problem *problem = start();
  ambulo_problem *walk = open_problem("support/walk_rigid", NULL, 0);
  ambulo_solver *solver = open_solver(problem), *mirrored = open_solver(walk);
  const double nowhere[2] = {(double)NAN, 0.0};
  assert_int_equal(ambulo_solver_set_foothold(solver, -1, place, 0.0), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_set_foothold(solver, 8, place, 0.0), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_set_foothold(solver, STRIKE, nowhere, 0.0), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_set_foothold(solver, STRIKE, place, INFINITY), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_set_foothold(solver, STRIKE, NULL, 0.0), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_set_foothold(NULL, STRIKE, place, 0.0), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solver_set_foothold(mirrored, 0, place, 0.0), AMBULO_E_ARGUMENT);
  assert_same(ambulo_solver_problem(solver), problem, 1);
  assert_null(ambulo_solver_problem(NULL));
  ambulo_solver_free(solver);
  ambulo_solver_free(mirrored);
  ambulo_problem_free(problem);
  ambulo_problem_free(walk);
}

/* refused once at any request, the solver has the foothold or has it not */
static void memory_may_run_out(void **state) {
  (void)state;
  ambulo_problem *problem = start(), *other = moved(1);
  ambulo_options options = ambulo_problem_options(problem);
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator a = fail_alloc_hook(&memory);
  ambulo_solver *solver = NULL;
  assert_int_equal(ambulo_solver_create(problem, &options, &a, NULL, &solver), AMBULO_OK);
  int refused = 0;
  for (long k = 0; k < 10000; k += k < 60 ? 1 : 5) {
    memory.fail_at = memory.requests + k;
    memory.only_once = 1;
    ambulo_status status = ambulo_solver_set_foothold(solver, STRIKE, place, 4.0 * degree);
    if (!status) break;
    refused++;
    assert_int_equal(status, AMBULO_E_MEMORY);
    if (k % 5 == 0) assert_same(ambulo_solver_problem(solver), problem, 1);
  }
  assert_true(refused > 20);
  assert_same(ambulo_solver_problem(solver), other, 1);
  ambulo_solver_free(solver);
  assert_int_equal(memory.live, 0);
  ambulo_problem_free(problem);
  ambulo_problem_free(other);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(it_is_the_problem_with_that_foothold),
                                     cmocka_unit_test(it_goes_on_beside_the_solution),
                                     cmocka_unit_test(refusals),
                                     cmocka_unit_test(memory_may_run_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
