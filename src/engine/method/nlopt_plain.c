/* method/nlopt_plain.c - presolve: off. Every family of rows handed straight to NLopt: for
 * small problems and for comparison.
 *
 * The problem stays as it is: no metric, no retraction, no coarser grids. What NLopt cannot
 * do without is done:
 *
 *   rows     equalities that follow from others are left out (presolve_rank.c): SLSQP stops
 *            at its first step with them. Rows and objective carry the sizes of rows_split.h
 *            and metric.c; the unknowns, radians and metres, keep theirs.
 *   reach    a first stage looks for a feasible point: SLSQP with the objective |x - x_0|^2 / 2
 *            in place of the problem's own, one call after the other, each from the best point
 *            of the last, until the rows hold. (A constant objective, the published practice,
 *            would leave SLSQP's quadratic model without curvature; with the distance its
 *            first step is the Gauss-Newton step to the rows.)
 *   improve  the algorithm from there with the problem's objective, again from the best point
 *            while that helps: SLSQP stops with ROUNDOFF_LIMITED, or with success at points
 *            that are not feasible, and a new call starts with a fresh quadratic model.
 *   restore  AUGLAG approaches the rows slowly from outside: where its last inner problem
 *            ended is led to the rows by `reach` before it is judged. It is given all
 *            evaluations that are left: its multipliers do not outlive a call.
 *
 * At most options->maximum_iterations calls that improve; run->ending says what ended them.
 * The best point of all calls (feasible: lowest objective; else smallest violation) is kept.
 */
#include "method/nlopt_direct.h"
#include "method/parameters.h"

#include <math.h>
#include <string.h>

static void prepare(ambulo__engine *e, ambulo__direct *d) {
  d->problem = e->setup->problem;
  d->workspace = e->workspace;
  d->run = e->run;
  d->set[0] = &e->linearized.rows.equality;
  d->set[1] = &e->linearized.rows.border;
  d->set[2] = &e->linearized.rows.inequality;
  d->is_equality[0] = d->is_equality[1] = 1;
  d->sets = AMBULO__DIRECT_SETS;
  d->objective_scale = e->setup->objective_scale;
}

static size_t bytes_of(const ambulo__direct *d) {
  return (size_t)d->problem->variables * sizeof *d->start;
}

static int is_feasible(const ambulo__direct *d) {
  return d->best_violation <= d->run->options->feasibility_tolerance;
}

static int is_over(const ambulo__direct *d) {
  return ambulo__run_over(d->run) || !(d->best_violation < HUGE_VAL);
}

/* from start to the rows, nearby; the point found is d->best_x and the new start */
static ambulo_status reach(ambulo__direct *d) {
  ambulo_status status = AMBULO_OK;
  d->nearest = 1;
  d->best_violation = d->best_objective = HUGE_VAL;
  for (int k = 0; k < AMBULO__REACH_CALLS && !status && !is_feasible(d); k++) {
    double before = d->best_violation;
    status = ambulo__direct_minimize(d, AMBULO_SLSQP, AMBULO__REACH_EVALUATIONS);
    if (status || is_over(d)) break;
    memcpy(d->start, d->best_x, bytes_of(d));
    d->run->iterations++;
    if (d->best_violation >= before) break;
  }
  d->nearest = 0;
  return status;
}

/* SLSQP from start; *done when it brought nothing new */
static ambulo_status improve(ambulo__direct *d, int *done) {
  double before = d->best_objective;
  int was_feasible = is_feasible(d);
  ambulo_status status = ambulo__direct_minimize(d, AMBULO_SLSQP, AMBULO__CALL_EVALUATIONS);
  if (status) return status;
  d->run->iterations++;
  *done =
      is_over(d) || (was_feasible && is_feasible(d) &&
                     before - d->best_objective <= AMBULO__PLAIN_SETTLED * fabs(before) + 1e-15);
  memcpy(d->start, d->best_x, bytes_of(d));
  return AMBULO_OK;
}

/* AUGLAG from start, then to the rows; x: the point before, kept when it is better */
static ambulo_status improve_nearly(ambulo__direct *d, double *x, int *done) {
  double objective = d->best_objective, violation = d->best_violation;
  memcpy(x, d->best_x, bytes_of(d));
  int left = d->run->options->maximum_evaluations - d->run->evaluations;
  /* the way back to the rows takes a few calls as well */
  int reserve = AMBULO__REACH_CALLS / 2 * AMBULO__REACH_EVALUATIONS;
  int evaluations = left > 2 * reserve ? left - reserve : (left + 1) / 2;
  ambulo_status status = ambulo__direct_minimize(d, AMBULO_AUGLAG, evaluations);
  if (status) return status;
  const char *message = d->message;
  d->run->iterations++;
  memcpy(d->start, d->last_x, bytes_of(d));
  status = reach(d);
  d->message = message;
  int feasible = is_feasible(d);
  int better = violation > d->run->options->feasibility_tolerance
                   ? d->best_violation < violation
                   : feasible && d->best_objective < objective;
  *done = is_over(d) || !better ||
          (feasible && objective - d->best_objective <= AMBULO__PLAIN_SETTLED * fabs(objective));
  if (better) return status;
  memcpy(d->best_x, x, bytes_of(d));
  d->best_objective = objective;
  d->best_violation = violation;
  return status;
}

static ambulo_status solve(ambulo__engine *e, ambulo__direct *d, ambulo_algorithm algorithm,
                           double *x) {
  int done = 0;
  prepare(e, d);
  ambulo_status status = ambulo__direct_create(d, &e->pool);
  if (status) return status;
  memcpy(d->start, x, (size_t)e->setup->n * sizeof *x);
  status = reach(d);
  ambulo_ending ending = AMBULO_ENDING_NLOPT;
  for (int k = 0; !status && !done && !is_over(d); k++) {
    if (k == e->run->options->maximum_iterations) {
      ending = AMBULO_ENDING_ITERATIONS;
      break;
    }
    status = algorithm == AMBULO_AUGLAG ? improve_nearly(d, x, &done) : improve(d, &done);
  }
  ambulo__run_end(e->run, d->best_violation < HUGE_VAL ? ending : AMBULO_ENDING_NO_DESCENT);
  return status;
}

ambulo_status ambulo__solve_plain(ambulo__engine *e, ambulo_algorithm algorithm,
                                  ambulo_diagnostics *diagnostics, double *x,
                                  const char **message) {
  ambulo__direct d = {.message = "not called"};
  ambulo_status status = solve(e, &d, algorithm, x);
  if (status == AMBULO_E_LIMIT)
    (void)ambulo__error(diagnostics, status, ambulo__nowhere, "use solver.algorithm: auto",
                        "%d unknowns and %d rows need more memory than 4 GB in dense form",
                        e->setup->n, e->setup->problem->rows);
  if (!status && d.best_violation < HUGE_VAL) memcpy(x, d.best_x, (size_t)e->setup->n * sizeof *x);
  *message = d.message;
  return status;
}
