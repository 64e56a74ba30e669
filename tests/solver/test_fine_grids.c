/* Grids that are finer by four: the same problem is solved, in little more iterations. What each
 * holds: penalties row by row where common ones drown the metric (linear/kkt.c), and polishing that
 * is relative to the metric (method/stopping.c). */
#include "support/at_nodes.h"
#include "support/problem_path.h"
#include "ambulo/tools/load.h"
#include "support/engine_fixture.h"

static ambulo_problem *load(const char *name, int intervals) {
  char path[96], time[48], spline[48];
  const char *overrides[] = {time, spline};
  ambulo_problem *problem = NULL;
  problem_path(name, path, sizeof path);
  (void)snprintf(time, sizeof time, "time.intervals=%d", intervals);
  (void)snprintf(spline, sizeof spline, "trajectory.intervals=%d", intervals);
  assert_int_equal(ambulo_problem_load(path, overrides, 2, NULL, NULL, &problem), AMBULO_OK);
  return problem;
}

static int iterations(const char *name, int intervals, double *objective) {
  ambulo_problem *problem = load(name, intervals);
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  int count = ambulo_result_iterations(result);
  if (verdict_at_nodes(result) != AMBULO_OPTIMAL)
    print_error("%s on %d: %s, KKT %.1e\n", name, intervals,
                ambulo_verdict_name(verdict_at_nodes(result)), ambulo_result_audit(result)->kkt);
  assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
  *objective = ambulo_result_objective(result);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  return count;
}

/* iterations grow with the number of doublings at the most: by as many as the coarse grid took */
static void iterations_do_not_follow_the_grid(void **state) {
  (void)state;
  static const struct {
    const char *name;
    int coarse, fine;
    double objective; /* on the fine grid, known from several ways to it */
  } cases[] = {{"yardstick_72", 72, 288, 2.65089},
               {"support/walker_2d_step", 40, 160, 1.0943},
               {"support/walker_2d_step", 160, 640, 1.0999},
               {"support/walk_rigid", 25, 100, 0.0648805},
               {"support/two_link_reach", 40, 2560, 5.16544}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    double objective;
    int before = iterations(cases[i].name, cases[i].coarse, &objective);
    int after = iterations(cases[i].name, cases[i].fine, &objective);
    if (after > 2 * before)
      print_error("%s: %d, then %d iterations\n", cases[i].name, before, after);
    assert_true(after <= 2 * before);
    assert_close(objective, cases[i].objective, 1e-3 * cases[i].objective);
  }
}

/* rows that the last micrometres leave a little inside keep their force in the audit */
static void tight_tolerances_are_met(void **state) {
  (void)state;
  static const double tolerance[] = {5e-7, 3e-7};
  ambulo_problem *problem = load("yardstick_72", 144);
  for (int i = 0; i < 2; i++) {
    ambulo_options options = ambulo_options_default();
    ambulo_result *result = NULL;
    options.feasibility_tolerance = tolerance[i];
    assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
    assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
    assert_true(ambulo_result_audit(result)->kkt < 1e-4);
    ambulo_result_free(result);
  }
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(iterations_do_not_follow_the_grid),
                                     cmocka_unit_test(tight_tolerances_are_met)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
