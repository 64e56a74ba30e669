/* bench/bench_evaluate.c - one NLP evaluation, and how it grows with the time grid.
 *
 * Prints, for the yardstick at several N, the median time of: values (objective and rows),
 * gradient of a weighted sum (reverse sweep), and all Jacobians, each at a fresh point so that
 * nothing is cached; and the time per node, which should not grow. */
#include "bench.h"
#include "nlp/nlp.h"

enum { REPEATS = 200 };

typedef struct sample {
  double values, gradient, jacobian;
} sample;

static void perturb(double *x, int n, int round) {
  for (int i = 0; i < n; i++) x[i] = 0.1 * sin(1.0 + 0.37 * i + 1e-4 * round);
}

static sample measure(const ambulo_problem *problem) {
  sample result = {0.0, 0.0, 0.0};
  ambulo_workspace *workspace = NULL;
  if (ambulo_workspace_create(problem, NULL, &workspace)) return result;
  int n = ambulo_problem_variable_count(problem), m = ambulo_problem_row_count(problem);
  double *x = calloc((size_t)n, sizeof *x), *gradient = calloc((size_t)n, sizeof *gradient);
  double *weights = calloc((size_t)m, sizeof *weights);
  double values[REPEATS], reverse[REPEATS], jacobian[REPEATS];
  for (int r = 0; r < m; r++) weights[r] = cos(r);
  for (int k = 0; k < REPEATS; k++) {
    perturb(x, n, k);
    double start = bench_seconds();
    (void)ambulo__evaluate(workspace, x);
    values[k] = bench_seconds() - start;
    start = bench_seconds();
    ambulo__gradient(workspace, 1.0, weights, gradient);
    reverse[k] = bench_seconds() - start;
    start = bench_seconds();
    (void)ambulo__evaluate_jacobian(workspace, x);
    jacobian[k] = bench_seconds() - start;
  }
  result.values = bench_median(values, REPEATS);
  result.gradient = bench_median(reverse, REPEATS);
  result.jacobian = bench_median(jacobian, REPEATS);
  free(x);
  free(gradient);
  free(weights);
  ambulo_workspace_free(workspace);
  return result;
}

int main(void) {
  static const int grids[] = {12, 36, 72, 144, 288, 576};
  printf("yardstick, kernels %s\n", ambulo_instruction_set());
  printf("%6s %8s %8s %12s %12s %12s %14s\n", "N", "unknowns", "rows", "values us", "gradient us",
         "jacobian us", "all us / node");
  for (size_t i = 0; i < sizeof grids / sizeof *grids; i++) {
    char time[64], spline[64];
    (void)snprintf(time, sizeof time, "time.intervals=%d", grids[i]);
    (void)snprintf(spline, sizeof spline, "trajectory.intervals=%d", grids[i]);
    const char *overrides[] = {time, spline};
    ambulo_problem *problem = NULL;
    if (ambulo_problem_load(AMBULO_SOURCE_DIR "/models/yardstick_12.yaml", overrides, 2, NULL, NULL,
                            &problem)) {
      printf("N = %d could not be built\n", grids[i]);
      return 1;
    }
    sample s = measure(problem);
    double all = s.values + s.gradient + s.jacobian;
    printf("%6d %8d %8d %12.1f %12.1f %12.1f %14.3f\n", grids[i],
           ambulo_problem_variable_count(problem), ambulo_problem_row_count(problem),
           1e6 * s.values, 1e6 * s.gradient, 1e6 * s.jacobian,
           1e6 * all / ambulo_problem_node_count(problem));
    ambulo_problem_free(problem);
  }
  return 0;
}
