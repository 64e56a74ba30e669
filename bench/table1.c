/* bench/table1.c - the three formulations of Table 1 of the source paper, on the same problems.
 *
 *   table1 [STARTS] [SECONDS]     `make bench-table1`
 *
 * Wang, Xiang, Arora & Abdel-Malek compare state variable elimination, direct collocation and
 * differential inclusion in words. Here the pendulum's swing, the reach of two links and the planar
 * walker's step are solved by each (formulations.h), by the same optimizer of NLopt with the same
 * settings: SLSQP; of the walker, whose equalities are dependent and many, AUGLAG with L-BFGS
 * inside. The first start is zero, the others are random: up to 0.5 rad or m of every place, half
 * the torque that the model can. A start succeeds where it ends with violations below 1e-4 and an
 * objective at most 1 % above the best of its formulation. The last line of a problem is ambulo's
 * own solver, which is given the third formulation.
 *
 * First the gradients of all formulations are compared with central differences; exit code 1 where
 * one is wrong. */
#include "formulations.h"

#include <nlopt.h>

enum { problems = 3, most_starts = 50 };
static const char *const problem_name[problems] = {"pendulum_swing", "two_link_reach",
                                                   "walker_2d_step"};
static const char *const kind_name[formulations] = {"state elimination", "direct collocation",
                                                    "differential inclusion"};
static const double feasible = 1e-4, near_best = 1.01, spread = 0.5, band = 2e-5;

typedef struct start {
  double *x, *q, *qd, *tau; /* of the problem as it is; at its nodes [nodes][d] */
} start;

/* --------------------------------------------------------------------- building */

static unsigned long long seed = 1;

static double uniform(void) {
  seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
  return (double)(seed >> 11) / 9007199254740992.0;
}

static void must(int status, const char *what) {
  if (!status) return;
  (void)fprintf(stderr, "table1: %s failed\n", what);
  exit(1);
}

static ambulo_problem *load(const char *name, int separate) {
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
static void find_basis(formulation *f) {
  int d = f->d, n = f->control_points;
  double *times = bench_array((size_t)f->nodes, sizeof *times);
  double *q = bench_array(3 * (size_t)(f->nodes * d), sizeof *q);
  ambulo_motion motion = {.q = q, .qd = q + f->nodes * d, .qdd = q + 2 * f->nodes * d};
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

static int is_family(const ambulo_row *row, const char *family) {
  return strcmp(row->family, family) == 0;
}

/* rows that are not bounds of this formulation */
static void choose_rows(formulation *f) {
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

static void bound(formulation *f, int at, double size, const ambulo_limits *limits) {
  f->scale[at] = size;
  f->lower[at] = limits ? limits->low / size : -INFINITY;
  f->upper[at] = limits ? limits->high / size : INFINITY;
}

static void bound_all(formulation *f) {
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

static void build(formulation *f, formulation_kind kind, const char *name) {
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

static void destroy(formulation *f) {
  void *const arrays[] = {f->row,    f->all,   f->scale,    f->lower, f->upper,
                          f->slope,  f->c,     f->jacobian, f->big,   f->gradient,
                          f->window, f->basis, f->inverse,  f->state, f->control,
                          f->A,      f->B,     f->F,        f->S,     f->K};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
  ambulo_mechanics_free(f->mechanics);
  ambulo_workspace_free(f->workspace);
  ambulo_problem_free(f->problem);
}

/* -------------------------------------------------------------------- gradients */

/* A start is a motion, the same in all formulations: `size` times random control points of the
 * problem as it is. */
static void start_from(const formulation *f, const start *from, double *x) {
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

static void make_start(const char *name, double size, start *s) {
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
  ambulo_motion motion = {.q = s->q, .qd = s->qd, .tau = s->tau};
  must(ambulo_problem_motion(problem, workspace, s->x, nodes, times, &motion), "motion");
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  free(times);
}

static void free_start(start *s) {
  free(s->x);
  free(s->q);
  free(s->qd);
  free(s->tau);
}

/* worst disagreement with central differences, relative to the gradient of the row; *density: share
 * of the Jacobian that is not zero */
static double check_gradients(formulation *f, const start *from, double *density) {
  size_t n = (size_t)f->unknowns, rows = (size_t)(f->equalities + f->inequalities);
  double *x = bench_array(n, sizeof *x), *J = bench_array((rows + 1) * n, sizeof *J);
  double *c = bench_array(rows + 1, sizeof *c), worst = 0.0;
  const double step = 1e-6;
  start_from(f, from, x);
  formulation_evaluate(f, x);
  must(!f->finite, "evaluation");
  memcpy(J, f->jacobian, rows * n * sizeof *J);
  memcpy(J + rows * n, f->slope, n * sizeof *J);
  long nonzeros = 0;
  for (size_t i = 0; i < rows * n; i++) nonzeros += fabs(J[i]) > 1e-12;
  *density = (double)nonzeros / (double)(rows * n);
  for (size_t j = 0; j < n; j++) {
    double at = x[j];
    x[j] = at + step;
    formulation_evaluate(f, x);
    memcpy(c, f->c, rows * sizeof *c);
    c[rows] = f->objective;
    x[j] = at - step;
    formulation_evaluate(f, x);
    x[j] = at;
    for (size_t r = 0; r <= rows; r++) {
      double other = r < rows ? f->c[r] : f->objective, size = 1.0;
      for (size_t i = 0; i < n; i++) size = fmax(size, fabs(J[r * n + i]));
      worst = fmax(worst, fabs((c[r] - other) / (2.0 * step) - J[r * n + j]) / size);
    }
  }
  free(x);
  free(J);
  free(c);
  return worst;
}

/* --------------------------------------------------------------------- solving */

typedef struct solve {
  formulation *f;
  double *x; /* of the last evaluation; NaN: none */
  double objective_size;
  int defects; /* rows that stay equalities */
} solve;

static void at(solve *s, const double *x) {
  size_t size = (size_t)s->f->unknowns * sizeof *x;
  if (memcmp(s->x, x, size) == 0) return;
  memcpy(s->x, x, size);
  formulation_evaluate(s->f, x);
  /* an integration that leaves all bounds: the optimizer is told that it is very bad there */
  if (s->f->finite) return;
  s->f->objective = 1e12 * s->objective_size;
}

static double objective(unsigned n, const double *x, double *gradient, void *user) {
  solve *s = user;
  at(s, x);
  for (unsigned j = 0; gradient && j < n; j++) gradient[j] = s->f->slope[j] / s->objective_size;
  return s->f->objective / s->objective_size;
}

static void rows_of(solve *s, int first, unsigned m, double *result, unsigned n, const double *x,
                    double *gradient, double sign) {
  at(s, x);
  const double *J = s->f->jacobian + (size_t)first * n;
  for (unsigned i = 0; i < m; i++) result[i] = sign * s->f->c[first + (int)i];
  for (size_t i = 0; gradient && i < (size_t)m * n; i++) gradient[i] = sign * J[i];
}

/* Rows 0 .. defects are equal to 0. Those equalities of the problem that depend on each other, and
 * would leave SLSQP without a step, stand between two bounds: band >= c >= -band. */
static void equal(unsigned m, double *result, unsigned n, const double *x, double *gradient,
                  void *user) {
  rows_of(user, 0, m, result, n, x, gradient, 1.0);
}

static void at_least(unsigned m, double *result, unsigned n, const double *x, double *gradient,
                     void *user) {
  solve *s = user;
  int first = s->defects, bands = s->f->equalities - first, rest = (int)m - 2 * bands;
  size_t width = (size_t)bands * n;
  rows_of(s, s->f->equalities, (unsigned)rest, result, n, x, gradient, -1.0);
  for (int side = 0; side < 2 && bands > 0; side++) {
    double *part = result + rest + side * bands, sign = side ? 1.0 : -1.0;
    double *slope = gradient ? gradient + (size_t)rest * n + (size_t)side * width : NULL;
    rows_of(s, first, (unsigned)bands, part, n, x, slope, sign);
    for (int i = 0; i < bands; i++) part[i] -= band;
  }
}

static nlopt_opt optimizer(solve *s, double seconds) {
  unsigned n = (unsigned)s->f->unknowns, defects = (unsigned)s->defects;
  unsigned rest = (unsigned)s->f->inequalities + 2 * ((unsigned)s->f->equalities - defects);
  size_t most = (size_t)(defects + rest);
  double *tolerance = bench_array(most, sizeof *tolerance);
  for (size_t i = 0; i < most; i++) tolerance[i] = 1e-6;
  nlopt_opt opt = nlopt_create(NLOPT_LD_SLSQP, n);
  nlopt_set_lower_bounds(opt, s->f->lower);
  nlopt_set_upper_bounds(opt, s->f->upper);
  nlopt_set_min_objective(opt, objective, s);
  if (defects) nlopt_add_equality_mconstraint(opt, defects, equal, s, tolerance);
  if (rest) nlopt_add_inequality_mconstraint(opt, rest, at_least, s, tolerance);
  nlopt_set_ftol_rel(opt, 1e-8);
  nlopt_set_maxtime(opt, seconds);
  free(tolerance);
  return opt;
}

typedef struct outcome {
  double objective, violation, seconds;
  long evaluations;
} outcome;

static double violation_of(const formulation *f) {
  double worst = 0.0;
  for (int i = 0; i < f->equalities; i++) worst = fmax(worst, fabs(f->c[i]));
  for (int i = 0; i < f->inequalities; i++) worst = fmax(worst, -f->c[f->equalities + i]);
  return f->finite ? worst : INFINITY;
}

static outcome solve_once(formulation *f, double *x, double size, int is_dependent,
                          double seconds) {
  solve s = {.f = f, .objective_size = size};
  s.x = bench_array((size_t)f->unknowns, sizeof *s.x);
  for (int j = 0; j < f->unknowns; j++) s.x[j] = (double)NAN;
  s.defects = !is_dependent            ? f->equalities
              : f->kind == COLLOCATION ? 2 * f->d * (f->nodes - 1)
                                       : 0;
  nlopt_opt opt = optimizer(&s, seconds);
  double value, begin = bench_seconds();
  f->evaluations = 0;
  (void)nlopt_optimize(opt, x, &value);
  outcome o = {.seconds = bench_seconds() - begin, .evaluations = f->evaluations};
  formulation_evaluate(f, x);
  o.objective = f->objective;
  o.violation = violation_of(f);
  nlopt_destroy(opt);
  free(s.x);
  return o;
}

/* ---------------------------------------------------------------------- report */

typedef struct line {
  int unknowns, equalities, inequalities, starts, feasible, good;
  double density, error, best, seconds, evaluations;
} line;

static line report(formulation *f, const start *from, double size, int is_dependent, int starts,
                   double seconds) {
  line l = {.unknowns = f->unknowns,
            .equalities = f->equalities,
            .inequalities = f->inequalities,
            .starts = starts,
            .best = INFINITY};
  outcome o[most_starts];
  double time[most_starts], count[most_starts];
  double *x = bench_array((size_t)f->unknowns, sizeof *x);
  l.error = check_gradients(f, &from[starts], &l.density);
  for (int i = 0; i < starts; i++) {
    start_from(f, &from[i], x);
    o[i] = solve_once(f, x, size, is_dependent, seconds);
    time[i] = o[i].seconds;
    count[i] = (double)o[i].evaluations;
    if (o[i].violation >= feasible) continue;
    l.feasible++;
    l.best = fmin(l.best, o[i].objective);
  }
  for (int i = 0; i < starts; i++)
    l.good += o[i].violation < feasible && o[i].objective <= near_best * l.best;
  l.seconds = bench_median(time, starts);
  l.evaluations = bench_median(count, starts);
  free(x);
  return l;
}

static outcome solve_by_ambulo(const char *name) {
  ambulo_problem *problem = load(name, 0);
  ambulo_result *result = NULL;
  ambulo_options options = ambulo_problem_options(problem);
  double begin = bench_seconds();
  must(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), name);
  outcome o = {.seconds = bench_seconds() - begin,
               .objective = ambulo_result_objective(result),
               .evaluations = ambulo_result_evaluations(result)};
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  return o;
}

/* returns the worst error of a gradient */
static double report_problem(const char *name, int is_dependent, int starts, double seconds) {
  line l[formulations];
  start from[most_starts + 1];
  double worst = 0.0;
  seed = 1;
  /* the first is zero, the last one is for the check of gradients */
  for (int i = 0; i <= starts; i++)
    make_start(name, i == 0 ? 0.0 : i < starts ? spread : 0.1, &from[i]);
  outcome own = solve_by_ambulo(name);
  for (int k = 0; k < formulations; k++) {
    formulation f;
    build(&f, (formulation_kind)k, name);
    l[k] = report(&f, from, own.objective, is_dependent, starts, seconds);
    worst = fmax(worst, l[k].error);
    destroy(&f);
  }
  for (int i = 0; i <= starts; i++) free_start(&from[i]);
  const line *last = &l[INCLUSION];
  for (int k = 0; k < formulations; k++) {
    printf("%-15s %-22s %4d %4d %4d %6.1f%% %8.0f %9.4f %7.1f %3d/%-3d %3d/%-3d %10.5g %+7.2f%% "
           "%8.0e\n",
           k ? "" : name, kind_name[k], l[k].unknowns, l[k].equalities, l[k].inequalities,
           100.0 * l[k].density, l[k].evaluations, l[k].seconds, l[k].seconds / last->seconds,
           l[k].feasible, l[k].starts, l[k].good, l[k].starts, l[k].best,
           100.0 * (l[k].best / last->best - 1.0), l[k].error);
    (void)fflush(stdout);
  }
  printf("%-15s %-22s %4d %4d %4d %7s %8ld %9.4f %7.3f %7s %7s %10.5g %+7.2f%%\n", "",
         "the last, ambulo solve", last->unknowns, last->equalities, last->inequalities, "",
         own.evaluations, own.seconds, own.seconds / last->seconds, "", "", own.objective,
         100.0 * (own.objective / last->best - 1.0));
  return worst;
}

int main(int argc, char **argv) {
  int starts = argc > 1 ? atoi(argv[1]) : 10;
  double seconds = argc > 2 ? atof(argv[2]) : 60.0, worst = 0.0;
  if (starts < 1 || starts > most_starts) starts = 10;
  printf("%-15s %-22s %4s %4s %4s %7s %8s %9s %7s %7s %7s %10s %8s %8s\n", "Table 1", "formulation",
         "x", "=", ">=", "dense", "evaluat.", "CPU s", "ratio", "rows", "(1)", "objective", "(2)",
         "(3)");
  for (int p = 0; p < problems; p++)
    worst = fmax(worst, report_problem(problem_name[p], p == 2, starts, seconds));
  printf(
      "medians of %d starts; rows: starts that end with violations below 1e-4\n"
      "(1) and an objective within 1 %% of the formulation's best; (2) its best beside the last's; "
      "(3) worst\nerror of a gradient against central differences\n",
      starts);
  return worst < 1e-5 ? 0 : 1;
}
