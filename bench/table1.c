/* bench/table1.c - the three formulations of Table 1 of the source paper, on the same problems.
 *
 *   table1 [STARTS] [SECONDS]     `make bench-table1`
 *
 * Wang, Xiang, Arora & Abdel-Malek compare state variable elimination, direct collocation and
 * differential inclusion in words. Here the pendulum's swing, the reach of two links and the planar
 * walker's step are solved by each (formulations.h), by the same optimizer with the same settings:
 * NLopt's SLSQP, begun again where it ends with rows that do not hold, for at most SECONDS of the
 * processor (the walker in processes of its own, so that the limit holds inside SLSQP, too; one
 * that is ended so has no evaluations to count). Equalities of the walker depend on each other,
 * which SLSQP cannot have: they stand between bounds of 2e-5. Starts are motions, the same for all:
 * the first is zero, the others random up to 0.5 rad or m of every control point (the walker has a
 * fifth of them); torques are those that move the body so. A start succeeds where it ends with
 * violations below 1e-4 and an objective at most 1 % above the best of its formulation. The last
 * line of a problem is ambulo's own solver, which is given the third formulation.
 *
 * First the gradients of all formulations are compared with differences (four points); exit code 1
 * where one is wrong. */
#include "formulations_build.h"

#include <nlopt.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { problems = 3, most_starts = 50, most_runs = 10 };
static const char *const problem_name[problems] = {"pendulum_swing", "two_link_reach",
                                                   "walker_2d_step"};
static const char *const kind_name[formulations] = {"state elimination", "direct collocation",
                                                    "differential inclusion"};
static const double feasible = 1e-4, near_best = 1.01, spread = 0.5, band = 2e-5;

/* -------------------------------------------------------------------- gradients */

/* worst disagreement with central differences, relative to the gradient of the row; *density: share
 * of the Jacobian that is not zero */
static double check_gradients(formulation *f, const start *from, double *density) {
  size_t n = (size_t)f->unknowns, rows = (size_t)(f->equalities + f->inequalities);
  double *x = bench_array(n, sizeof *x), *J = bench_array((rows + 1) * n, sizeof *J);
  double *c = bench_array(rows + 1, sizeof *c), worst = 0.0;
  const double step = 1e-4;
  start_from(f, from, x);
  formulation_evaluate(f, x);
  must(!f->finite, "evaluation");
  memcpy(J, f->jacobian, rows * n * sizeof *J);
  memcpy(J + rows * n, f->slope, n * sizeof *J);
  long nonzeros = 0;
  for (size_t i = 0; i < rows * n; i++) nonzeros += fabs(J[i]) > 1e-12;
  *density = (double)nonzeros / (double)(rows * n);
  for (size_t j = 0; j < n; j++) {
    static const double weight[4] = {1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0};
    double here = x[j];
    memset(c, 0, (rows + 1) * sizeof *c);
    for (int k = 0; k < 4; k++) {
      x[j] = here + step * (k < 2 ? k - 2 : k - 1);
      formulation_evaluate(f, x);
      for (size_t r = 0; r <= rows; r++)
        c[r] += weight[k] / step * (r < rows ? f->c[r] : f->objective);
    }
    x[j] = here;
    for (size_t r = 0; r <= rows; r++) {
      double size = 1.0;
      for (size_t i = 0; i < n; i++) size = fmax(size, fabs(J[r * n + i]));
      worst = fmax(worst, fabs(c[r] - J[r * n + j]) / size);
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
  nlopt_opt opt;
  double end; /* processor seconds */
} solve;

static void at(solve *s, const double *x) {
  size_t size = (size_t)s->f->unknowns * sizeof *x;
  if (memcmp(s->x, x, size) == 0) return;
  memcpy(s->x, x, size);
  formulation_evaluate(s->f, x);
  if (bench_seconds() > s->end) (void)nlopt_force_stop(s->opt);
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

static nlopt_opt optimizer(solve *s) {
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
  double value, begin = bench_seconds();
  s.end = begin + seconds;
  outcome o = {.violation = INFINITY};
  f->evaluations = 0;
  /* where SLSQP ends with rows that do not hold, it goes on from there with a new curvature */
  for (int run = 0; run < most_runs && o.violation >= feasible && bench_seconds() < s.end; run++) {
    s.opt = optimizer(&s);
    (void)nlopt_optimize(s.opt, x, &value);
    at(&s, x);
    nlopt_destroy(s.opt);
    o.violation = violation_of(f);
  }
  o.seconds = bench_seconds() - begin;
  o.evaluations = f->evaluations;
  o.objective = f->objective;
  free(s.x);
  return o;
}

/* The same in a process of its own, which ends with its time: SLSQP asks for limits where it
 * evaluates, and of the walker's torques it may never come back from its quadratic program. */
static outcome solve_apart(formulation *f, double *x, double size, int is_dependent,
                           double seconds) {
  outcome o = {.violation = INFINITY, .seconds = seconds};
  int ends[2];
  must(pipe(ends), "pipe");
  pid_t child = fork();
  must(child < 0, "fork");
  if (child == 0) {
    const rlim_t most = (rlim_t)ceil(seconds) + 1;
    const struct rlimit limit = {most, most};
    (void)setrlimit(RLIMIT_CPU, &limit);
    o = solve_once(f, x, size, is_dependent, seconds);
    _exit(write(ends[1], &o, sizeof o) != (ssize_t)sizeof o);
  }
  close(ends[1]);
  outcome got;
  if (read(ends[0], &got, sizeof got) == (ssize_t)sizeof got) o = got;
  close(ends[0]);
  (void)waitpid(child, NULL, 0);
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
    o[i] = (is_dependent ? solve_apart : solve_once)(f, x, size, is_dependent, seconds);
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
    make_start(name, i == 0 ? 0.0 : i < starts ? spread : 0.02, &from[i]);
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
    char best[40] = "         -        -";
    if (l[k].feasible > 0)
      (void)snprintf(best, sizeof best, "%10.5g %+7.2f%%", l[k].best,
                     100.0 * (l[k].best / last->best - 1.0));
    printf("%-15s %-22s %4d %4d %4d %6.1f%% %8.0f %9.4f %7.1f %3d/%-3d %3d/%-3d %s %8.0e\n",
           k ? "" : name, kind_name[k], l[k].unknowns, l[k].equalities, l[k].inequalities,
           100.0 * l[k].density, l[k].evaluations, l[k].seconds, l[k].seconds / last->seconds,
           l[k].feasible, l[k].starts, l[k].good, l[k].starts, best, l[k].error);
    (void)fflush(stdout);
  }
  char beside[20] = "       -";
  if (last->feasible > 0)
    (void)snprintf(beside, sizeof beside, "%+7.2f%%", 100.0 * (own.objective / last->best - 1.0));
  printf("%-15s %-22s %4d %4d %4d %7s %8ld %9.4f %7.3f %7s %7s %10.5g %s\n", "",
         "the last, ambulo solve", last->unknowns, last->equalities, last->inequalities, "",
         own.evaluations, own.seconds, own.seconds / last->seconds, "", "", own.objective, beside);
  return worst;
}

int main(int argc, char **argv) {
  int starts = argc > 1 ? atoi(argv[1]) : 10;
  double seconds = argc > 2 ? atof(argv[2]) : 40.0, worst = 0.0;
  if (starts < 1 || starts > most_starts) starts = 10;
  printf("%-15s %-22s %4s %4s %4s %7s %8s %9s %7s %7s %7s %10s %8s %8s\n", "Table 1", "formulation",
         "x", "=", ">=", "dense", "evaluat.", "CPU s", "ratio", "rows", "(1)", "objective", "(2)",
         "(3)");
  for (int p = 0; p < problems; p++)
    worst = fmax(worst, report_problem(problem_name[p], p == 2, p == 2 ? (starts + 4) / 5 : starts,
                                       seconds));
  printf(
      "medians of the starts; rows: starts that end with violations below 1e-4\n"
      "(1) and an objective within 1 %% of the formulation's best; (2) its best beside the last's; "
      "(3) worst\nerror of a gradient against differences\n");
  return worst < 1e-5 ? 0 : 1;
}
