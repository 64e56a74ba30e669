/* bench/bench_solve.c - whole solves from zero: the yardstick and its finer grids.
 *
 * One line a grid: intervals, unknowns, seconds, evaluations, objective, violation, KKT
 * residual, verdict, and where the time went (share of evaluation, linear algebra, NLopt).
 * Arguments: the numbers of intervals (default 12 36 72 144). Run with
 * OPENBLAS_NUM_THREADS=1. */
#include "bench.h"

static int solve(int intervals) {
  char time_grid[48], spline_grid[48];
  (void)snprintf(time_grid, sizeof time_grid, "time.intervals=%d", intervals);
  (void)snprintf(spline_grid, sizeof spline_grid, "trajectory.intervals=%d", intervals);
  const char *overrides[] = {time_grid, spline_grid};
  ambulo_problem *problem = NULL;
  ambulo_result *r = NULL;
  ambulo_options options = ambulo_options_default();
  ambulo_status status = ambulo_problem_load(AMBULO_SOURCE_DIR "/models/yardstick_12.yaml",
                                             overrides, 2, NULL, NULL, &problem);
  if (!status) status = ambulo_solve(problem, &options, NULL, NULL, NULL, &r);
  if (status) {
    fprintf(stderr, "N = %d: %s\n", intervals, ambulo_status_name(status));
    ambulo_problem_free(problem);
    return 1;
  }
  const ambulo_timing *t = ambulo_result_timing(r);
  const ambulo_audit *a = ambulo_result_audit(r);
  printf("%d,%d,%.4f,%d,%.6f,%.1e,%.1e,%s,%.2f,%.2f,%.2f\n", intervals,
         ambulo_problem_variable_count(problem), t->total, ambulo_result_evaluations(r),
         ambulo_result_objective(r), a->violation.worst, a->kkt,
         ambulo_verdict_name(ambulo_result_verdict(r)), t->evaluate / t->total,
         t->linear_algebra / t->total, t->nlopt / t->total);
  ambulo_result_free(r);
  ambulo_problem_free(problem);
  return 0;
}

int main(int argc, char **argv) {
  static const int standard[] = {12, 36, 72, 144};
  int failed = 0;
  printf("intervals,unknowns,seconds,evaluations,objective,violation,kkt,verdict,"
         "share_evaluate,share_linear,share_nlopt\n");
  for (int i = 1; i < argc; i++) failed |= solve(atoi(argv[i]));
  for (int i = 0; argc == 1 && i < 4; i++) failed |= solve(standard[i]);
  return failed;
}
