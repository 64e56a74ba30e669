/* bench/formulations_build.h - the formulations of a problem file, and motions to start them from.
 */
#ifndef AMBULO_BENCH_FORMULATIONS_BUILD_H
#define AMBULO_BENCH_FORMULATIONS_BUILD_H

#include "formulations.h"
#include "ambulo/tools/load.h"

typedef struct start {
  double *x, *q, *qd, *tau; /* of the problem as it is; at its nodes [nodes][d] */
} start;

/* --------------------------------------------------------------------- building */

static unsigned long long seed = 1;

static inline double uniform(void) {
  seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
  return (double)(seed >> 11) / 9007199254740992.0;
}

/* a status, or 1 for what went wrong */
#define must(status, what) stop_where((status) != 0, what)
static inline void stop_where(int failed, const char *what) {
  if (!failed) return;
  (void)fprintf(stderr, "table1: %s failed\n", what);
  exit(1);
}

static inline ambulo_problem *load(const char *name, int separate) {
  char path[300], trajectory[80];
  const char *overrides[] = {trajectory};
  ambulo_problem *problem = NULL, *fine = NULL;
  (void)snprintf(path, sizeof path, AMBULO_SOURCE_DIR "/models/%s.yaml", name);
  must(ambulo_problem_load(path, NULL, 0, NULL, NULL, &problem), path);
  if (!separate) return problem;
  (void)snprintf(trajectory, sizeof trajectory,
                 "trajectory={basis: bspline, degree: 3, intervals: %d}",
                 4 * (ambulo_problem_node_count(problem) - 1));
  must(ambulo_problem_load(path, overrides, 1, NULL, NULL, &fine), path);
  ambulo_problem_free(problem);
  return fine;
}

/* the three control points of each node and what they make of it, of the first coordinate */
static inline void find_basis(formulation *f) {
  int d = f->d, n = f->control_points;
  double *times = bench_array((size_t)f->nodes, sizeof *times);
  double *q = bench_array(3 * (size_t)(f->nodes * d), sizeof *q);
  ambulo_motion motion = {
      .size = sizeof(ambulo_motion), .q = q, .qd = q + f->nodes * d, .qdd = q + 2 * f->nodes * d};
  int *found = bench_array((size_t)f->nodes, sizeof *found);
  for (int k = 0; k < f->nodes; k++) times[k] = ambulo_problem_node_time(f->problem, k);
  for (int p = 0; p < n; p++) {
    memset(f->big, 0, (size_t)(n * d) * sizeof *f->big);
    f->big[p * d] = 1.0;
    must(ambulo_problem_motion(f->problem, f->workspace, f->big, f->nodes, times, &motion),
         "motion");
    for (int k = 0; k < f->nodes; k++) {
      double s[3];
      for (int o = 0; o < 3; o++) s[o] = q[(o * f->nodes + k) * d];
      if (fabs(s[0]) + f->h * fabs(s[1]) + f->h * f->h * fabs(s[2]) < 1e-9) continue;
      must(found[k] == 3, "a node with control points of its own");
      for (int o = 0; o < 3; o++) f->basis[9 * k + 3 * o + found[k]] = s[o];
      f->window[3 * k + found[k]++] = p;
    }
  }
  for (int k = 0; k < f->nodes; k++) {
    double M[9];
    must(found[k] != 3, "a node with three control points");
    memcpy(M, f->basis + 9 * k, sizeof M);
    for (int i = 0; i < 3; i++) f->inverse[9 * k + 4 * i] = 1.0;
    solve_dense(3, M, f->inverse + 9 * k, 3);
  }
  free(times);
  free(q);
  free(found);
}

static inline int is_family(const ambulo_row *row, const char *family) {
  return strcmp(row->family, family) == 0;
}

/* rows that are not bounds of this formulation */
static inline void choose_rows(formulation *f) {
  int count = ambulo_problem_row_count(f->problem);
  f->row = bench_array((size_t)count, sizeof *f->row);
  f->all = bench_array((size_t)count, sizeof *f->all);
  f->equalities = f->kind == COLLOCATION ? 2 * f->d * (f->nodes - 1) : 0;
  for (int r = 0; r < count; r++) {
    ambulo_row row;
    must(ambulo_problem_row(f->problem, r, &row), "row");
    int torque = is_family(&row, "torque_limit");
    f->torque_limits |= torque;
    if (f->kind != INCLUSION && torque) continue;
    if (f->kind == COLLOCATION && is_family(&row, "joint_limit")) continue;
    f->row[f->rows++] = r;
    f->equalities += row.relation == AMBULO_EQUAL;
    f->inequalities += row.relation != AMBULO_EQUAL;
  }
}

static inline void bound(formulation *f, int at, double size, const ambulo_limits *limits) {
  f->scale[at] = size;
  f->lower[at] = limits ? limits->low / size : -INFINITY;
  f->upper[at] = limits ? limits->high / size : INFINITY;
}

static inline void bound_all(formulation *f) {
  int d = f->d, two = 2 * d, step = f->kind == COLLOCATION ? 3 * d : d;
  for (int j = 0; j < f->unknowns; j++) bound(f, j, 1.0, NULL);
  if (f->kind == INCLUSION) return;
  for (int i = 0; i < d; i++) {
    ambulo_limits range, torque;
    must(ambulo_problem_limits(f->problem, i, AMBULO_LIMITED_POSITION, &range), "limits");
    must(ambulo_problem_limits(f->problem, i, AMBULO_LIMITED_TORQUE, &torque), "limits");
    int is_bounded = isfinite(torque.high) && isfinite(torque.low);
    double size = is_bounded ? fmax(torque.high, -torque.low) : 750.0;
    for (int k = 0; k < f->nodes; k++) {
      int y = f->kind == COLLOCATION ? k * step : 0;
      if (k == 0 || f->kind == COLLOCATION) {
        bound(f, y + i, 1.0, f->kind == COLLOCATION ? &range : NULL);
        bound(f, y + d + i, 5.0, NULL);
      }
      int torques = f->kind == COLLOCATION ? k * step + two + i : two + k * d + i;
      bound(f, torques, size, f->torque_limits && is_bounded ? &torque : NULL);
    }
  }
}

static inline void build(formulation *f, formulation_kind kind, const char *name) {
  memset(f, 0, sizeof *f);
  f->kind = kind;
  f->problem = load(name, kind != INCLUSION);
  const ambulo_model *model = ambulo_problem_model(f->problem);
  f->d = ambulo_model_coordinate_count(model);
  f->nodes = ambulo_problem_node_count(f->problem);
  f->control_points = ambulo_problem_control_point_count(f->problem);
  f->h = ambulo_problem_duration(f->problem) / (f->nodes - 1);
  must(ambulo_workspace_create(f->problem, NULL, &f->workspace), "workspace");
  must(ambulo_mechanics_create(model, NULL, &f->mechanics), "mechanics");
  size_t d = (size_t)f->d, nodes = (size_t)f->nodes, two = 2 * d;
  size_t n = kind == ELIMINATION   ? two + nodes * d
             : kind == COLLOCATION ? 3 * nodes * d
                                   : (size_t)ambulo_problem_variable_count(f->problem);
  f->unknowns = (int)n;
  choose_rows(f);
  size_t rows = (size_t)(f->equalities + f->inequalities);
  f->scale = bench_array(n, sizeof(double));
  f->lower = bench_array(n, sizeof(double));
  f->upper = bench_array(n, sizeof(double));
  f->slope = bench_array(n, sizeof(double));
  f->c = bench_array(rows, sizeof(double));
  f->jacobian = bench_array(rows * n, sizeof(double));
  f->big = bench_array((size_t)f->control_points * d, sizeof(double));
  f->gradient = bench_array((size_t)f->control_points * d, sizeof(double));
  f->window = bench_array(3 * nodes, sizeof(int));
  f->basis = bench_array(9 * nodes, sizeof(double));
  f->inverse = bench_array(9 * nodes, sizeof(double));
  f->state = bench_array(3 * nodes * d, sizeof(double));
  f->control = bench_array(nodes * d, sizeof(double));
  f->A = bench_array(nodes * two * two, sizeof(double));
  f->B = bench_array(nodes * two * d, sizeof(double));
  f->F = bench_array(nodes * two, sizeof(double));
  f->S = bench_array(kind == ELIMINATION ? nodes * two * n : 0, sizeof(double));
  f->K = bench_array(kind == ELIMINATION ? 4 * two * n : 0, sizeof(double));
  bound_all(f);
  if (kind != INCLUSION) find_basis(f);
}

static inline void destroy(formulation *f) {
  void *const arrays[] = {f->row,    f->all,   f->scale,    f->lower, f->upper,
                          f->slope,  f->c,     f->jacobian, f->big,   f->gradient,
                          f->window, f->basis, f->inverse,  f->state, f->control,
                          f->A,      f->B,     f->F,        f->S,     f->K};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
  ambulo_mechanics_free(f->mechanics);
  ambulo_workspace_free(f->workspace);
  ambulo_problem_free(f->problem);
}

/* ------------------------------------------------------------------------ starts */

/* A start is a motion, the same in all formulations: `size` times random control points of the
 * problem as it is. */
static inline void start_from(const formulation *f, const start *from, double *x) {
  int d = f->d, two = 2 * d;
  if (f->kind == INCLUSION) {
    memcpy(x, from->x, (size_t)f->unknowns * sizeof *x);
    return;
  }
  for (int k = 0; k < f->nodes; k++) {
    int y = f->kind == COLLOCATION ? 3 * k * d : 0;
    int torque = f->kind == COLLOCATION ? y + two : two + k * d;
    for (int i = 0; i < d; i++) {
      if (y > 0 || k == 0) x[y + i] = from->q[k * d + i] / f->scale[y + i];
      if (y > 0 || k == 0) x[y + d + i] = from->qd[k * d + i] / f->scale[y + d + i];
      x[torque + i] = from->tau[k * d + i] / f->scale[torque + i];
    }
  }
  for (int j = 0; j < f->unknowns; j++) x[j] = fmin(f->upper[j], fmax(f->lower[j], x[j]));
}

static inline void make_start(const char *name, double size, start *s) {
  ambulo_problem *problem = load(name, 0);
  ambulo_workspace *workspace = NULL;
  must(ambulo_workspace_create(problem, NULL, &workspace), "workspace");
  int n = ambulo_problem_variable_count(problem), nodes = ambulo_problem_node_count(problem);
  int d = n / ambulo_problem_control_point_count(problem);
  double *times = bench_array((size_t)nodes, sizeof *times);
  s->x = bench_array((size_t)n, sizeof(double));
  s->q = bench_array((size_t)(nodes * d), sizeof(double));
  s->qd = bench_array((size_t)(nodes * d), sizeof(double));
  s->tau = bench_array((size_t)(nodes * d), sizeof(double));
  for (int k = 0; k < nodes; k++) times[k] = ambulo_problem_node_time(problem, k);
  for (int j = 0; j < n; j++) s->x[j] = size * (2.0 * uniform() - 1.0);
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .q = s->q, .qd = s->qd, .tau = s->tau};
  must(ambulo_problem_motion(problem, workspace, s->x, nodes, times, &motion), "motion");
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  free(times);
}

static inline void free_start(start *s) {
  free(s->x);
  free(s->q);
  free(s->qd);
  free(s->tau);
}

#endif
