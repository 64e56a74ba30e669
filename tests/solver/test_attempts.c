/* Solves beside a solved problem: few iterations, the same answer, whatever the start was. */
#include "ambulo/tools/load.h"
#include "support/problem_path.h"
#include "support/test.h"

static ambulo_problem *open_walk(const char *const *overrides, int count) {
  char path[96];
  ambulo_problem *problem = NULL;
  problem_path("support/walk_rigid", path, sizeof path);
  assert_int_equal(ambulo_problem_load(path, overrides, count, NULL, NULL, &problem), AMBULO_OK);
  return problem;
}

static ambulo_result *solve(const ambulo_problem *problem, const double *start,
                            const ambulo_multipliers *multipliers) {
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *result = NULL;
  options.multipliers = multipliers;
  options.dense_samples = 1;
  assert_int_equal(ambulo_solve(problem, &options, start, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  return result;
}

static double *carry(const ambulo_problem *from, const ambulo_result *result,
                     const ambulo_problem *to) {
  size_t n = (size_t)ambulo_problem_variable_count(to);
  double *x = calloc(n, sizeof *x);
  if (n == (size_t)ambulo_problem_variable_count(from)) /* stretched to another duration */
    return memcpy(x, ambulo_result_x(result), n * sizeof *x);
  assert_int_equal(ambulo_problem_transfer(from, ambulo_result_x(result), to, x), AMBULO_OK);
  return x;
}

/* one percent longer, on a finer grid, one percent slower; counted beside a solve from zero */
static void few_iterations_and_the_same_answer(void **state) {
  (void)state;
  static const char *const changes[] = {"gait.step_length=0.6868", "time.intervals=30",
                                        "time.duration=0.5454"};
  ambulo_problem *base = open_walk(NULL, 0);
  ambulo_result *solved = solve(base, NULL, NULL);
  ambulo_multipliers *multipliers = NULL;
  assert_int_equal(ambulo_multipliers_of(base, solved, NULL, &multipliers), AMBULO_OK);
  for (size_t c = 0; c < sizeof changes / sizeof *changes; c++) {
    ambulo_problem *other = open_walk(&changes[c], 1);
    double *x = carry(base, solved, other);
    ambulo_result *warm = solve(other, x, multipliers), *cold = solve(other, NULL, NULL);
    assert_close(ambulo_result_objective(warm), ambulo_result_objective(cold), 1e-4);
    assert_true(3 * ambulo_result_iterations(warm) <= ambulo_result_iterations(cold));
    ambulo_result_free(warm);
    ambulo_result_free(cold);
    free(x);
    ambulo_problem_free(other);
  }
  ambulo_multipliers_free(multipliers);
  ambulo_result_free(solved);
  ambulo_problem_free(base);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(few_iterations_and_the_same_answer)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
