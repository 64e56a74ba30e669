/* bench/bench_evaluate.c - one NLP evaluation, and how it grows with nodes and rows.
 *
 * For the yardstick at several N, the median and least time of: values (objective and rows),
 * gradient of a weighted sum (reverse sweep), and all Jacobians, each at a fresh point so that
 * nothing is cached; the time of all three per node, and the power of N it grows with. Then, at N =
 * 72, the same with families of rows switched off. Last, the walk by muscles with and without its
 * term. */
#include "mechanics/plan.h"
#include "bench_csv.h"
#include "ambulo/tools/load.h"
#include "problem/nlp.h"

enum { rounds = 8, repeats = 25, parts = 3, grid_count = 6 };
static const char *const part_name[parts] = {"values", "gradient", "jacobians"};
static const int grids[grid_count] = {12, 36, 72, 144, 288, 576};

typedef struct subject {
  ambulo_problem *problem;
  ambulo_workspace *workspace;
  double *x, *gradient, *weights;
  int n, rows, nodes, count;
  double times[parts + 1][rounds * repeats]; /* s; the last: all parts */
} subject;

static subject *subject_of(const char *name, const char *const *overrides, int count) {
  char path[256];
  (void)snprintf(path, sizeof path, "%s/models/%s.yaml", AMBULO_SOURCE_DIR, name);
  subject *s = calloc(1, sizeof *s);
  if (!s || ambulo_problem_load(path, overrides, count, NULL, NULL, &s->problem) ||
      ambulo_workspace_create(s->problem, NULL, &s->workspace)) {
    (void)fprintf(stderr, "bench_evaluate: '%s' could not be built\n", name);
    exit(1);
  }
  s->n = ambulo_problem_variable_count(s->problem);
  s->rows = ambulo_problem_row_count(s->problem);
  s->nodes = ambulo_problem_node_count(s->problem);
  s->x = calloc((size_t)s->n, sizeof *s->x);
  s->gradient = calloc((size_t)s->n, sizeof *s->gradient);
  s->weights = calloc((size_t)s->rows + 1, sizeof *s->weights);
  if (!s->x || !s->gradient || !s->weights) exit(1);
  for (int r = 0; r < s->rows; r++) s->weights[r] = cos(r);
  return s;
}

static subject *subject_open(int intervals, const char *const *extra, int extra_count) {
  char time[64], spline[64];
  (void)snprintf(time, sizeof time, "time.intervals=%d", intervals);
  (void)snprintf(spline, sizeof spline, "trajectory.intervals=%d", intervals);
  const char *overrides[8] = {time, spline};
  for (int i = 0; i < extra_count; i++) overrides[2 + i] = extra[i];
  return subject_of("yardstick_12", overrides, 2 + extra_count);
}

static void subject_free(subject *s) {
  ambulo_workspace_free(s->workspace);
  ambulo_problem_free(s->problem);
  free(s->x);
  free(s->gradient);
  free(s->weights);
  free(s);
}

static void perturb(double *x, int n, int round) {
  for (int i = 0; i < n; i++) x[i] = 0.1 * sin(1.0 + 0.37 * i + 1e-4 * round);
}

/* One round of repeats; returns the median time of all parts. */
static double measure(subject *s) {
  double all[repeats];
  for (int i = 0; i < repeats; i++, s->count++) {
    perturb(s->x, s->n, s->count);
    double start = bench_seconds();
    (void)ambulo__evaluate(s->workspace, s->x);
    double valued = bench_seconds();
    ambulo__gradient(s->workspace, 1.0, s->weights, s->gradient);
    double reversed = bench_seconds();
    (void)ambulo__evaluate_jacobian(s->workspace, s->x);
    double end = bench_seconds();
    s->times[0][s->count] = valued - start;
    s->times[1][s->count] = reversed - valued;
    s->times[2][s->count] = end - reversed;
    s->times[3][s->count] = all[i] = end - start;
  }
  return bench_median(all, repeats);
}

static void report_grid(bench_table *table, subject *s, int intervals) {
  char quantity[bench_key];
  for (int p = 0; p < parts; p++) {
    (void)snprintf(quantity, sizeof quantity, "%s at N = %d", part_name[p], intervals);
    bench_put(table, quantity, "us", 1e6 * bench_median(s->times[p], s->count));
    (void)snprintf(quantity, sizeof quantity, "%s at N = %d at least", part_name[p], intervals);
    bench_put(table, quantity, "us", 1e6 * bench_least(s->times[p], s->count));
  }
  double all = bench_median(s->times[parts], s->count);
  (void)snprintf(quantity, sizeof quantity, "evaluation with Jacobians at N = %d", intervals);
  bench_put(table, quantity, "us", 1e6 * all);
  (void)snprintf(quantity, sizeof quantity, "evaluation per node at N = %d", intervals);
  bench_put(table, quantity, "us/node", 1e6 * all / s->nodes);
  (void)snprintf(quantity, sizeof quantity, "evaluation with Jacobians at N = %d at least",
                 intervals);
  bench_put(table, quantity, "us", 1e6 * bench_least(s->times[parts], s->count));
}

/* The grids take turns, so that the power of N does not see how busy the machine is. */
static void report_nodes(bench_table *table) {
  subject *subjects[grid_count];
  double nodes[grid_count], all[grid_count], power[rounds];
  for (int i = 0; i < grid_count; i++) {
    subjects[i] = subject_open(grids[i], NULL, 0);
    nodes[i] = subjects[i]->nodes;
  }
  for (int round = 0; round < rounds; round++) {
    for (int i = 0; i < grid_count; i++) all[i] = measure(subjects[i]);
    power[round] = bench_power(nodes, all, grid_count);
  }
  for (int i = 0; i < grid_count; i++) {
    report_grid(table, subjects[i], grids[i]);
    subject_free(subjects[i]);
  }
  bench_put(table, "power of the nodes from 13 to 577", "-", bench_median(power, rounds));
}

/* What rows cost: the same problem with fewer families of them. */
static void report_rows(bench_table *table) {
  static const char *const off[] = {"constraints.joint_limits=off", "constraints.zmp=off",
                                    "constraints.ground_penetration=false",
                                    "constraints.foot_strike=false"};
  enum { count = sizeof off / sizeof *off + 1 };
  subject *subjects[count];
  char quantity[bench_key];
  for (int i = 0; i < count; i++) subjects[i] = subject_open(72, off, i);
  for (int round = 0; round < rounds; round++) {
    for (int i = 0; i < count; i++) (void)measure(subjects[i]);
  }
  for (int i = 0; i < count; i++) {
    subject *s = subjects[i];
    double median = bench_median(s->times[0], s->count) + bench_median(s->times[1], s->count);
    double least = bench_least(s->times[0], s->count) + bench_least(s->times[1], s->count);
    (void)snprintf(quantity, sizeof quantity, "values and gradient with %d rows at N = 72",
                   s->rows);
    bench_put(table, quantity, "us", 1e6 * median);
    (void)snprintf(quantity, sizeof quantity, "values and gradient with %d rows at N = 72 at least",
                   s->rows);
    bench_put(table, quantity, "us", 1e6 * least);
    subject_free(s);
  }
}

/* a walk by squared torques, by muscles, and what muscles cost more for a leg and a node */
static void report_muscles(bench_table *table) {
  enum { legs = 2, count = 3 };
  static const char *const objective[count] = {"objective=[{term: torque_squared}]",
                                               "objective=[{term: muscle_effort}]",
                                               "objective=[{term: muscle_effort, metabolic: 0.5}]"};
  static const char *const name[count] = {"squared torques", "muscles",
                                          "muscles and metabolic power"};
  subject *subjects[count];
  for (int i = 0; i < count; i++) subjects[i] = subject_of("walk_muscles", &objective[i], 1);
  double least[count];
  char quantity[bench_key];
  for (int round = 0; round < rounds; round++)
    for (int i = 0; i < count; i++) (void)measure(subjects[i]);
  for (int i = 0; i < count; i++) {
    subject *s = subjects[i];
    least[i] = bench_least(s->times[0], s->count) + bench_least(s->times[1], s->count);
    (void)snprintf(quantity, sizeof quantity, "values and gradient with %s at least", name[i]);
    bench_put(table, quantity, "us", 1e6 * least[i]);
    if (i == 0) continue;
    (void)snprintf(quantity, sizeof quantity, "%s, a leg and node", name[i]);
    bench_put(table, quantity, "us", 1e6 * (least[i] - least[0]) / (legs * s->nodes));
  }
  for (int i = 0; i < count; i++) subject_free(subjects[i]);
}

int main(void) {
  bench_table table;
  bench_open(&table, ambulo__instruction_set(), "evaluate");
  report_nodes(&table);
  report_rows(&table);
  report_muscles(&table);
  bench_close(&table);
  return 0;
}
