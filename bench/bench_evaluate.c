/* bench/bench_evaluate.c - one NLP evaluation, and how it grows with nodes and rows.
 *
 * For the yardstick at several N, the median time of: values (objective and rows), gradient of a
 * weighted sum (reverse sweep), and all Jacobians, each at a fresh point so that nothing is
 * cached; the time of all three per node, and the power of N it grows with. Then, at N = 72, the
 * same with families of rows switched off. */
#include "bench_csv.h"
#include "nlp/nlp.h"

enum { repeats = 200, parts = 3 };
static const char *const part_name[parts] = {"values", "gradient", "jacobians"};

typedef struct sample {
  double part[parts], all; /* s */
  int nodes, rows;
} sample;

static void perturb(double *x, int n, int round) {
  for (int i = 0; i < n; i++) x[i] = 0.1 * sin(1.0 + 0.37 * i + 1e-4 * round);
}

static void measure(const ambulo_problem *problem, ambulo_workspace *workspace, sample *result) {
  int n = ambulo_problem_variable_count(problem), m = ambulo_problem_row_count(problem);
  double *x = calloc((size_t)n, sizeof *x), *gradient = calloc((size_t)n, sizeof *gradient);
  double *weights = calloc((size_t)m + 1, sizeof *weights);
  double times[parts][repeats];
  if (!x || !gradient || !weights) exit(1);
  for (int r = 0; r < m; r++) weights[r] = cos(r);
  for (int k = 0; k < repeats; k++) {
    perturb(x, n, k);
    double start = bench_seconds();
    (void)ambulo__evaluate(workspace, x);
    double valued = bench_seconds();
    ambulo__gradient(workspace, 1.0, weights, gradient);
    double reversed = bench_seconds();
    (void)ambulo__evaluate_jacobian(workspace, x);
    times[0][k] = valued - start;
    times[1][k] = reversed - valued;
    times[2][k] = bench_seconds() - reversed;
  }
  for (int p = 0; p < parts; p++) {
    result->part[p] = bench_median(times[p], repeats);
    result->all += result->part[p];
  }
  result->nodes = ambulo_problem_node_count(problem);
  result->rows = m;
  free(x);
  free(gradient);
  free(weights);
}

static sample measure_problem(int intervals, const char *const *extra, int extra_count) {
  sample result = {{0}, 0, 0, 0};
  char time[64], spline[64];
  (void)snprintf(time, sizeof time, "time.intervals=%d", intervals);
  (void)snprintf(spline, sizeof spline, "trajectory.intervals=%d", intervals);
  const char *overrides[8] = {time, spline};
  for (int i = 0; i < extra_count; i++) overrides[2 + i] = extra[i];
  ambulo_problem *problem = NULL;
  ambulo_workspace *workspace = NULL;
  if (ambulo_problem_load(AMBULO_SOURCE_DIR "/models/yardstick_12.yaml", overrides, 2 + extra_count,
                          NULL, NULL, &problem) ||
      ambulo_workspace_create(problem, NULL, &workspace)) {
    (void)fprintf(stderr, "bench_evaluate: the yardstick with N = %d could not be built\n",
                  intervals);
    exit(1);
  }
  measure(problem, workspace, &result);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  return result;
}

static void report_nodes(bench_table *table) {
  static const int grids[] = {12, 36, 72, 144, 288, 576};
  enum { count = sizeof grids / sizeof *grids };
  double n[count], all[count];
  char quantity[bench_key];
  for (int i = 0; i < count; i++) {
    sample s = measure_problem(grids[i], NULL, 0);
    for (int p = 0; p < parts; p++) {
      (void)snprintf(quantity, sizeof quantity, "%s at N = %d", part_name[p], grids[i]);
      bench_put(table, quantity, "us", 1e6 * s.part[p]);
    }
    (void)snprintf(quantity, sizeof quantity, "evaluation with Jacobians at N = %d", grids[i]);
    bench_put(table, quantity, "us", 1e6 * s.all);
    (void)snprintf(quantity, sizeof quantity, "evaluation per node at N = %d", grids[i]);
    bench_put(table, quantity, "us/node", 1e6 * s.all / s.nodes);
    n[i] = s.nodes;
    all[i] = s.all;
  }
  bench_put(table, "power of the nodes from 13 to 577", "-", bench_power(n, all, count));
}

/* What rows cost: the same problem with fewer families of them. */
static void report_rows(bench_table *table) {
  static const char *const off[] = {"constraints.joint_limits=off", "constraints.zmp=off",
                                    "constraints.ground_penetration=false",
                                    "constraints.foot_strike=false"};
  char quantity[bench_key];
  for (int i = 0; i <= 4; i++) {
    sample s = measure_problem(72, off, i);
    (void)snprintf(quantity, sizeof quantity, "values and gradient with %d rows at N = 72", s.rows);
    bench_put(table, quantity, "us", 1e6 * (s.part[0] + s.part[1]));
  }
}

int main(void) {
  bench_table table;
  bench_open(&table, ambulo_instruction_set(), "evaluate");
  report_nodes(&table);
  report_rows(&table);
  bench_close(&table);
  return 0;
}
