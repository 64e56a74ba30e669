/* bench/table4.c - the example of the source paper, beside its Tables 3 and 4.
 *
 *   table4                   `make bench-table4`
 *
 * Wang, Xiang, Arora & Abdel-Malek solve a gait of 18 coordinates, T = 2.442 s, from zero, with
 * N = 12, 36 and 72 time intervals in three discretizations. The same nine cells are solved
 * here on the yardstick, whose duration, start, coordinates, foot points and rows per node are
 * theirs (the body, the schedule and the objective, which they do not print, are our own).
 * Printed: verdict, iterations, evaluations, processor seconds of loading and solving, and the
 * published figures (SNOPT on a PC of 3.2 GHz). Then the nonzeros of the first derivatives, counted
 * at a generic point row by row, beside the formulas of Table 3 with d = 18, N_p = 8, N_s = 1, N_z
 * = 4 and n = N + 3 control points. */
#include "mechanics/plan.h"
#include "bench_csv.h"
#include "ambulo/tools/load.h"

enum { bases = 3, grids = 3, families = 5, repeats = 3 };

static const char *const basis_name[bases] = {"central_difference", "hermite", "bspline"};
static const int intervals[grids] = {12, 36, 72};
/* Table 4 */
static const int paper_iterations[grids][bases] = {{30, 31, 43}, {29, 32, 37}, {96, 49, 51}};
static const double paper_seconds[grids][bases] = {
    {11, 20, 28}, {65, 328, 246}, {1398, 2047, 1503}};

static double process_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static ambulo_problem *load(int grid, int basis) {
  char path[256], trajectory[64];
  const char *overrides[] = {trajectory};
  ambulo_problem *problem = NULL;
  (void)snprintf(path, sizeof path, AMBULO_SOURCE_DIR "/models/yardstick_%d.yaml", intervals[grid]);
  (void)snprintf(trajectory, sizeof trajectory, "trajectory={basis: %s}", basis_name[basis]);
  if (ambulo_problem_load(path, overrides, 1, NULL, NULL, &problem)) {
    (void)fprintf(stderr, "table4: %s cannot be loaded with %s\n", path, trajectory);
    exit(1);
  }
  return problem;
}

/* Median processor seconds of loading and solving; the last result is returned. */
static ambulo_result *solve(int grid, int basis, double *median) {
  double seconds[repeats];
  ambulo_result *result = NULL;
  for (int i = 0; i < repeats; i++) {
    ambulo_result_free(result);
    result = NULL;
    double start = process_seconds();
    ambulo_problem *problem = load(grid, basis);
    ambulo_options options = ambulo_problem_options(problem);
    options.time_limit = 300;
    ambulo_status status = ambulo_solve(problem, &options, NULL, NULL, NULL, &result);
    ambulo_problem_free(problem);
    seconds[i] = process_seconds() - start;
    if (status != AMBULO_OK) {
      (void)fprintf(stderr, "table4: %s\n", ambulo_status_text(status));
      exit(1);
    }
  }
  *median = bench_median(seconds, repeats);
  return result;
}

/* Returns how many of the nine cells end feasible. */
static int report_solves(bench_table *table) {
  char quantity[bench_key];
  int feasible = 0;
  printf("%-20s %3s %-10s %11s %10s %5s %6s %9s %9s %8s\n", "Table 4", "N", "verdict", "objective",
         "violation", "iter.", "(1)", "evaluat.", "CPU s", "(1)");
  for (int b = 0; b < bases; b++) {
    for (int g = 0; g < grids; g++) {
      double seconds;
      ambulo_result *result = solve(g, b, &seconds);
      ambulo_verdict verdict = ambulo_result_verdict(result);
      int valid = ambulo_verdict_is_solution(verdict) || verdict == AMBULO_OPTIMAL_AT_NODES ||
                  verdict == AMBULO_FEASIBLE_AT_NODES;
      printf("%-20s %3d %-10s %11.4g %10.1e %5d %6d %9d %9.3f %8.0f  %.0f x\n", basis_name[b],
             intervals[g], ambulo_verdict_name(ambulo_result_verdict(result)),
             ambulo_result_objective(result), ambulo_result_audit(result)->violation.worst,
             ambulo_result_iterations(result), paper_iterations[g][b],
             ambulo_result_evaluations(result), seconds, paper_seconds[g][b],
             paper_seconds[g][b] / seconds);
      feasible += valid;
      if (valid && table->out) {
        (void)snprintf(quantity, sizeof quantity, "%s N = %d", basis_name[b], intervals[g]);
        (void)fprintf(table->out, "%s,s,%.6g\n", quantity, seconds);
      }
      ambulo_result_free(result);
    }
  }
  printf("(1) published: iterations of SNOPT and seconds on a PC of 3.2 GHz\n"
         "%d of %d cells end feasible\n",
         feasible, bases * grids);
  return feasible;
}

/* ------------------------------------------------------------------ Table 3 */

static const char *const family_name[families] = {"ground_penetration", "foot_strike", "zmp",
                                                  "joint_limit", "ends"};

static int family_of(const char *family) {
  for (int f = 0; f < families - 1; f++) {
    if (strcmp(family, family_name[f]) == 0) return f;
  }
  return families - 1;
}

/* Rows and nonzeros by family at a generic point; returns the objective's nonzeros. */
static long count_nonzeros(const ambulo_problem *problem, long rows[families],
                           long nonzeros[families]) {
  int n = ambulo_problem_variable_count(problem);
  double *x = malloc((size_t)n * sizeof *x), *gradient = malloc((size_t)n * sizeof *gradient);
  ambulo_workspace *workspace = NULL;
  long objective = 0;
  if (!x || !gradient || ambulo_workspace_create(problem, NULL, &workspace)) exit(1);
  for (int i = 0; i < n; i++) x[i] = 0.2 * sin(1.0 + 0.61803398875 * i * i);
  for (int r = 0; r < ambulo_problem_row_count(problem); r++) {
    ambulo_row row;
    if (ambulo_problem_row(problem, r, &row) ||
        ambulo_problem_row_gradient(problem, workspace, x, r, gradient))
      exit(1);
    int family = family_of(row.family);
    rows[family]++;
    for (int i = 0; i < n; i++) nonzeros[family] += gradient[i] != 0.0;
  }
  if (ambulo_problem_gradient(problem, workspace, x, 1.0, NULL, gradient)) exit(1);
  for (int i = 0; i < n; i++) objective += gradient[i] != 0.0;
  ambulo_workspace_free(workspace);
  free(gradient);
  free(x);
  return objective;
}

/* The upper bounds of Table 3; joint angles and ends are bounds or not counted there. */
static long paper_nonzeros(int basis, int family, int n_intervals) {
  static const long per_node[families] = {8, 1, 4, 0, 0};
  static const long touched[bases] = {3, 4, 4};
  if (family == 3 && basis == 2) return 4L * 18 * (n_intervals + 1);
  return touched[basis] * 18 * per_node[family] * (n_intervals + 1);
}

static void report_nonzeros(void) {
  printf("\n%-20s %3s %-20s %8s %9s %10s %9s\n", "Table 3", "N", "rows of", "number", "nonzeros",
         "published", "dense");
  for (int b = 0; b < bases; b++) {
    for (int g = 0; g < grids; g++) {
      long rows[families] = {0}, nonzeros[families] = {0}, ours = 0, paper = 0, all = 1;
      ambulo_problem *problem = load(g, b);
      long n = ambulo_problem_variable_count(problem), d = 18, nodes = intervals[g] + 1;
      long objective = count_nonzeros(problem, rows, nonzeros);
      const long paper_objective[bases] = {d * (nodes + 2), 2 * d * (nodes + 1), d * (nodes + 2)};
      printf("%-20s %3d %-20s %8d %9ld %10ld %9ld\n", basis_name[b], intervals[g], "objective", 1,
             objective, paper_objective[b], n);
      for (int f = 0; f < families; f++) {
        long theirs = paper_nonzeros(b, f, intervals[g]);
        printf("%-24s %-20s %8ld %9ld %10ld %9ld\n", "", family_name[f], rows[f], nonzeros[f],
               theirs, rows[f] * n);
        ours += nonzeros[f];
        paper += theirs;
        all += rows[f];
      }
      printf("%-24s %-20s %8ld %9ld %10ld %9ld\n", "", "total", all, ours + objective,
             paper + paper_objective[b], all * n);
      ambulo_problem_free(problem);
    }
  }
}

int main(void) {
  bench_table table;
  bench_open(&table, ambulo__instruction_set(), "table4");
  int feasible = report_solves(&table);
  bench_close(&table);
  report_nonzeros();
  return feasible == bases * grids ? 0 : 1;
}
