/* bench/bench_solve.c - whole solves from zero, everything included.
 *
 *   bench_solve [N...]       other numbers of intervals, printed only
 *
 * The yardstick at N = 12 ... 576 by the pipeline (loading excluded, continuation and audit
 * included): processor seconds, where they go, evaluations, objective; the power of N that the
 * time grows with; then the small problems by each algorithm. A case
 * that ends without a feasible point is printed as such, and its time is not recorded. */
#include "mechanics/plan.h"
#include "bench_csv.h"
#include "ambulo/tools/load.h"

static double process_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void put(bench_table *table, const char *name, const char *what, const char *unit,
                double value) {
  char quantity[bench_key];
  (void)snprintf(quantity, sizeof quantity, "%s: %s", name, what);
  bench_put(table, quantity, unit, value);
}

/* Best of `rounds` solves, in processor seconds; negative without a feasible point. */
static double solve(bench_table *table, const char *name, const char *path,
                    const char *const *overrides, int count, int rounds) {
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  double best = -1;
  if (ambulo_problem_load(path, overrides, count, NULL, NULL, &problem)) {
    printf("%-44s could not be loaded\n", name);
    return -1;
  }
  ambulo_options options = ambulo_problem_options(problem);
  options.time_limit = 60;
  for (int i = 0; i < rounds; i++) {
    ambulo_result_free(result);
    result = NULL;
    double start = process_seconds();
    if (ambulo_solve(problem, &options, NULL, NULL, NULL, &result)) break;
    double seconds = process_seconds() - start;
    if (best < 0 || seconds < best) best = seconds;
  }
  ambulo_verdict verdict = result ? ambulo_result_verdict(result) : AMBULO_NOT_JUDGED;
  if (!ambulo_verdict_is_solution(verdict) && verdict != AMBULO_OPTIMAL_AT_NODES) {
    printf("%-44s %s after %.3f s, violation %.1e\n", name,
           result ? ambulo_verdict_name(ambulo_result_verdict(result)) : "failed", best,
           result ? ambulo_result_audit(result)->violation.worst : 0.0);
    best = -1;
  } else {
    const ambulo_timing *timing = ambulo_result_timing(result);
    put(table, name, "time", "s", best);
    put(table, name, "evaluations", "-", ambulo_result_evaluations(result));
    put(table, name, "objective", "-", ambulo_result_objective(result));
    printf("%-44s %s, violation %.1e, KKT residual %.1e\n", "",
           ambulo_verdict_name(ambulo_result_verdict(result)),
           ambulo_result_audit(result)->violation.worst, ambulo_result_audit(result)->kkt);
    if (rounds > 1 || best > 0.5) {
      put(table, name, "share of evaluation", "-", timing->evaluate / timing->total);
      put(table, name, "share of linear algebra", "-", timing->linear_algebra / timing->total);
    }
  }
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  return best;
}

static double solve_yardstick(bench_table *table, int intervals) {
  char time[64], spline[64], name[40];
  (void)snprintf(time, sizeof time, "time.intervals=%d", intervals);
  (void)snprintf(spline, sizeof spline, "trajectory.intervals=%d", intervals);
  (void)snprintf(name, sizeof name, "yardstick N = %d", intervals);
  const char *overrides[] = {time, spline};
  return solve(table, name, AMBULO_SOURCE_DIR "/models/yardstick_12.yaml", overrides, 2,
               intervals < 100 ? 3 : 1);
}

static void report_yardstick(bench_table *table) {
  static const int grids[] = {12, 36, 72, 144, 288, 576};
  enum { count = sizeof grids / sizeof *grids };
  double n[count], seconds[count];
  int solved = 0;
  for (int i = 0; i < count; i++) {
    double best = solve_yardstick(table, grids[i]);
    if (best < 0) continue;
    n[solved] = grids[i];
    seconds[solved++] = best;
  }
  if (solved > 1) bench_put(table, "power of N of a solve", "-", bench_power(n, seconds, solved));
}

static void report_algorithms(bench_table *table) {
  static const char *const problems[] = {"two_link_reach", "walker_2d_step", "yardstick N = 6"};
  static const char *const paths[] = {AMBULO_SOURCE_DIR "/models/two_link_reach.yaml",
                                      AMBULO_SOURCE_DIR "/models/walker_2d_step.yaml",
                                      AMBULO_SOURCE_DIR "/models/yardstick_12.yaml"};
  static const char *const algorithms[] = {"auglag", "slsqp"};
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 2; k++) {
      char solver[80], name[72];
      (void)snprintf(solver, sizeof solver, "solver.algorithm=%s", algorithms[k]);
      (void)snprintf(name, sizeof name, "%s by %s", problems[i], algorithms[k]);
      const char *overrides[] = {solver, "time.intervals=6", "trajectory.intervals=6"};
      (void)solve(table, name, paths[i], overrides, i == 2 ? 3 : 1, 1);
    }
  }
}

int main(int argc, char **argv) {
  static bench_table table;
  if (argc > 1) {
    for (int i = 1; i < argc; i++) (void)solve_yardstick(&table, atoi(argv[i]));
    return 0;
  }
  bench_open(&table, ambulo__instruction_set(), "solve");
  report_yardstick(&table);
  report_algorithms(&table);
  bench_close(&table);
  return 0;
}
