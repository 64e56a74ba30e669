/* Errors of sensitivities of a solve that ends early: what goes on much longer changes is below
 * them. */
#include "ambulo/tools/load.h"
#include "solver/sensitivity.h"
#include "support/test.h"

static ambulo_result *solve(const ambulo_problem *p, const double *start, double tolerance,
                            int iterations) {
  ambulo_options options = ambulo_problem_options(p);
  ambulo_result *result = NULL;
  options.optimality_tolerance = tolerance;
  options.maximum_iterations = iterations;
  assert_int_equal(ambulo_solve(p, &options, start, NULL, NULL, &result), AMBULO_OK);
  return result;
}

static const ambulo_sensitivity *find(const ambulo_sensitivity_list *list, const char *name) {
  for (int i = 0; i < list->count; i++)
    if (strcmp(list->items[i].name, name) == 0) return &list->items[i];
  return NULL;
}

static int ascending(const void *left, const void *right) {
  double a = *(const double *)left, b = *(const double *)right;
  return (a > b) - (a < b);
}

/* error over true error, of numbers that count: most above 1, nearly all above a third, in the
 * median below 10. Where an early end leaves joints in a flat valley (subtalar ones of a walk) it
 * may be half of the true one. */
static void check(const char *path) {
  enum { MOST = 512 };
  double ratio[MOST];
  int count = 0, above = 0, near = 0;
  ambulo_problem *p = NULL;
  ambulo_sensitivity_list *list = NULL, *truth = NULL;
  assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &p), AMBULO_OK);
  ambulo_result *early = solve(p, NULL, 1e-2, 150);
  ambulo_result *late = solve(p, ambulo_result_x(early), 1e-9, 300);
  assert_int_equal(ambulo_result_verdict(early), AMBULO_OPTIMAL);
  assert_int_equal(ambulo_sensitivities(p, early, NULL, &list), AMBULO_OK);
  assert_int_equal(ambulo__sensitivities_nearly(p, late, NULL, 0, NULL, &truth), AMBULO_OK);
  for (int i = 0; i < list->count && count < MOST; i++) {
    const ambulo_sensitivity *s = &list->items[i], *t = find(truth, s->name);
    if (!t || fabs(s->share) < 1e-5) continue;
    assert_true(isfinite(s->error) && s->error >= 0.0);
    double off = fabs(t->derivative - s->derivative);
    ratio[count] = s->error / fmax(off, 1e-12 * fabs(s->derivative));
    near += ratio[count] >= 1.0 / 3.0;
    above += ratio[count++] >= 1.0;
  }
  qsort(ratio, (size_t)count, sizeof *ratio, ascending);
  assert_true(count > 20);
  assert_true(above >= 0.8 * count && near >= 0.95 * count);
  assert_true(ratio[count / 2] < 10.0);
  ambulo_sensitivities_free(list);
  ambulo_sensitivities_free(truth);
  ambulo_result_free(early);
  ambulo_result_free(late);
  ambulo_problem_free(p);
}

static void of_a_run(void **state) {
  (void)state;
  ONLY_IN_CHECK_LONG();
  check("models/walk_or_run.yaml");
}

static void of_a_walk(void **state) {
  (void)state;
  check("models/walk.yaml");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(of_a_run), cmocka_unit_test(of_a_walk)};
  return cmocka_run_group_tests_name("solver/sensitivity_errors", tests, NULL, NULL);
}
