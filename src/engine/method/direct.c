/* method/direct.c - see direct.h.
 *
 * Calls of NLopt's SLSQP or AUGLAG, each from the best point of the last: SLSQP stops with
 * ROUNDOFF_LIMITED, or with success at points that are not feasible, and a new call starts with a
 * fresh quadratic model, the identity. In w that is the metric at the point (model_step.c), unless
 * the call is plain (presolve: off). Before the first call x is carried onto the rows:
 *
 *   whitened  onto the equalities by restore.c
 *   plain     by SLSQP with the objective |x - x_0|^2 / 2 in place of the problem's own, call after
 *             call until all rows hold. (A constant objective, the published practice, would leave
 *             SLSQP's quadratic model without curvature; with the distance its first step is the
 *             Gauss-Newton step to the rows.)
 *
 * AUGLAG approaches the rows from outside, so where its last inner problem ended is carried onto
 * them in the same way. Its multipliers do not outlive a call, which is therefore given all
 * evaluations that are left.
 *
 * NLopt is kept from harm (docs/equations.md, "the solver"): a non-finite value becomes HUGE_VAL,
 * with rows that are finite; its answers are not believed: the best point is kept here; evaluation
 * limit and tolerances are always set; equalities are counted against the unknowns before they are
 * added; stop requests are polled in every callback.
 */
#include "method/direct.h"
#include "base/arithmetic.h"
#include "method/point.h"
#include "method/model_step.h"
#include "method/mirror.h"
#include "method/parameters.h"
#include "method/equalities.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>

typedef struct callback {
  ambulo__direct *direct;
  nlopt_opt opt;
  ambulo__sparse_rows *set;
} callback;

ambulo_status ambulo__direct_create(ambulo__engine *e, int plain, ambulo__direct *d) {
  ambulo__rows_split *rows = &e->linearized.rows;
  size_t n = (size_t)e->setup->n, largest = 1;
  *d = (ambulo__direct){.engine = e,
                        .set = {&rows->equality, &rows->border, &rows->inequality},
                        .whitener = plain ? NULL : &e->linearized.whitener,
                        .best_objective = HUGE_VAL,
                        .best_violation = HUGE_VAL,
                        .message = "not called"};
  for (int s = 0; s < AMBULO__DIRECT_SETS; s++) {
    if ((size_t)d->set[s]->count > largest) largest = (size_t)d->set[s]->count;
  }
  double **vectors[] = {&d->start, &d->x, &d->w, &d->last_x, &d->best_x, &d->spare_x};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
    *vectors[i] = ambulo__pool_doubles(&e->pool, n);
  d->values = ambulo__pool_doubles(&e->pool, largest);
  return e->pool.failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

static int is_equality(int set) {
  return set < AMBULO__DIRECT_SETS - 1;
}

static size_t bytes_of(const ambulo__direct *d) {
  return (size_t)d->engine->setup->n * sizeof *d->start;
}

static int is_feasible(const ambulo__direct *d) {
  return d->best_violation <= d->engine->run->options->feasibility_tolerance;
}

/* --------------------------------------------------------------- what NLopt asks */

/* worst over all sets, relative to the sizes of the rows */
static double violation_of(ambulo__direct *d) {
  const ambulo__table_row *table = d->engine->setup->problem->table.rows;
  double worst = 0.0;
  for (int s = 0; s < AMBULO__DIRECT_SETS; s++) {
    const ambulo__sparse_rows *set = d->set[s];
    ambulo__sparse_rows_values(set, d->engine->workspace, d->values);
    for (int i = 0; i < set->count; i++) {
      double value = is_equality(s) ? fabs(d->values[i]) : ambulo__worse(0.0, d->values[i]);
      worst = ambulo__worse(worst, value / (fabs(set->scale[i]) * table[set->row[i]].size));
    }
  }
  return worst;
}

static void keep_best(ambulo__direct *d) {
  double violation = violation_of(d), objective = d->engine->workspace->objective;
  int feasible = violation <= d->engine->run->options->feasibility_tolerance;
  int better =
      feasible && is_feasible(d) ? objective < d->best_objective : violation < d->best_violation;
  if (!better) return;
  ambulo__run_forgive(d->engine->run);
  d->best_violation = violation;
  d->best_objective = objective;
  memcpy(d->best_x, d->x, bytes_of(d));
}

/* evaluates at w; 0 when the values are finite. Points where they are not, or where gradients are
 * not, are rejected: HUGE_VAL never looks like a descent. */
static int move_to(ambulo__direct *d, const double *w) {
  ambulo__engine *e = d->engine;
  memcpy(d->x, w, bytes_of(d));
  if (d->whitener) ambulo__band_backward(d->whitener, d->x);
  for (int j = 0; j < e->setup->n; j++) d->x[j] += d->start[j];
  if (!ambulo__evaluate(e->workspace, d->x)) return 0;
  ambulo__run_fault(e->run, &e->workspace->fault);
  return 1;
}

/* |w|^2 / 2 */
static double distance(unsigned n, const double *w, double *gradient) {
  double sum = 0.0;
  for (unsigned j = 0; j < n; j++) sum += w[j] * w[j];
  if (gradient) memcpy(gradient, w, n * sizeof *gradient);
  return 0.5 * sum;
}

static double objective(unsigned n, const double *w, double *gradient, void *data) {
  callback *c = data;
  ambulo__direct *d = c->direct;
  ambulo__engine *e = d->engine;
  ambulo__run_count(e->run);
  int failed = move_to(d, w);
  if (!failed && gradient && !d->nearest) {
    failed = ambulo__engine_gradient(e, e->setup->objective_scale, NULL, NULL, gradient) != 0;
    if (d->whitener) ambulo__band_forward(d->whitener, gradient);
  }
  if (!failed) keep_best(d);
  if (e->run->stopped || (d->nearest && is_feasible(d))) nlopt_force_stop(c->opt);
  if (gradient && failed) memset(gradient, 0, n * sizeof *gradient);
  if (failed) return HUGE_VAL;
  if (!gradient) memcpy(d->last_x, d->x, n * sizeof *d->x);
  if (d->nearest) return distance(n, w, gradient);
  return e->setup->objective_scale * e->workspace->objective;
}

static void rows(unsigned m, double *result, unsigned n, const double *w, double *gradient,
                 void *data) {
  callback *c = data;
  ambulo__direct *d = c->direct;
  ambulo_workspace *workspace = d->engine->workspace;
  int failed = move_to(d, w);
  if (!failed && gradient) failed = ambulo__evaluate_jacobian(workspace, d->x) != AMBULO_OK;
  if (gradient) memset(gradient, 0, (size_t)m * (size_t)n * sizeof *gradient);
  if (!failed && gradient) {
    failed = ambulo__sparse_rows_fill(c->set, workspace, 0) != AMBULO_OK;
    if (failed) ambulo__run_fault(d->engine->run, &workspace->fault);
  }
  if (failed) {
    for (unsigned i = 0; i < m; i++) result[i] = 1.0;
    return;
  }
  ambulo__sparse_rows_values(c->set, workspace, result);
  for (unsigned i = 0; i < m && gradient; i++) {
    double *row = gradient + (size_t)i * (size_t)n;
    const double *value = ambulo__sparse_rows_gradient(c->set, (int)i) - c->set->start[i];
    for (int e = c->set->start[i]; e < c->set->start[i + 1]; e++)
      row[c->set->column[e]] += value[e];
    if (d->whitener) ambulo__band_forward(d->whitener, row);
  }
}

/* ---------------------------------------------------------------------- one call */

static int count_of(const ambulo__direct *d, int sets) {
  int count = 0;
  for (int s = 0; s < sets; s++) count += d->set[s]->count;
  return count;
}

/* bytes of SLSQP's and AUGLAG's dense work, roughly */
static double memory_of(const ambulo__direct *d, ambulo_algorithm algorithm) {
  double n = d->engine->setup->n, m = count_of(d, AMBULO__DIRECT_SETS);
  return 8.0 * (algorithm == AMBULO_AUGLAG ? m * n : 4.0 * n * n + 4.0 * m * n);
}

static nlopt_opt create_optimizer(unsigned n, ambulo_algorithm algorithm, int evaluations) {
  nlopt_opt opt = nlopt_create(algorithm == AMBULO_AUGLAG ? NLOPT_AUGLAG : NLOPT_LD_SLSQP, n);
  if (!opt) return NULL;
  int failed = nlopt_set_maxeval(opt, evaluations) < 0 ||
               nlopt_set_ftol_rel(opt, AMBULO__ROUNDING) < 0 ||
               nlopt_set_xtol_rel(opt, AMBULO__ROUNDING) < 0;
  if (!failed && algorithm == AMBULO_AUGLAG) {
    nlopt_opt local = nlopt_create(NLOPT_LD_LBFGS, n);
    failed = !local || nlopt_set_maxeval(local, evaluations / 10 + 50) < 0 ||
             nlopt_set_ftol_rel(local, AMBULO__RESTORE_TARGET) < 0 ||
             nlopt_set_xtol_rel(local, AMBULO__RESTORE_TARGET) < 0 || !ambulo__nlopt_can_copy(n) ||
             nlopt_set_local_optimizer(opt, local) < 0;
    nlopt_destroy(local);
  }
  if (!failed) return opt;
  nlopt_destroy(opt);
  return NULL;
}

static int add_sets(ambulo__direct *d, nlopt_opt opt, callback *rows_of) {
  for (int s = 0; s < AMBULO__DIRECT_SETS; s++) {
    unsigned m = (unsigned)d->set[s]->count;
    if (m == 0) continue;
    rows_of[s] = (callback){d, opt, d->set[s]};
    for (unsigned i = 0; i < m; i++) d->values[i] = AMBULO__RESTORE_TARGET;
    int added = is_equality(s)
                    ? nlopt_add_equality_mconstraint(opt, m, rows, &rows_of[s], d->values)
                    : nlopt_add_inequality_mconstraint(opt, m, rows, &rows_of[s], d->values);
    if (added < 0) return added;
  }
  return NLOPT_SUCCESS;
}

ambulo_status ambulo__direct_minimize(ambulo__direct *d, ambulo_algorithm algorithm,
                                      int evaluations) {
  ambulo__run *run = d->engine->run;
  unsigned n = (unsigned)d->engine->setup->n;
  if (memory_of(d, algorithm) > AMBULO__DIRECT_MEMORY) return AMBULO_E_LIMIT;
  if (count_of(d, AMBULO__DIRECT_SETS - 1) >= d->engine->setup->n) {
    d->message = "not called: as many equality rows as unknowns";
    return AMBULO_OK;
  }
  nlopt_opt opt = create_optimizer(n, algorithm, evaluations);
  if (!opt) return AMBULO_E_MEMORY;
  callback of_objective = {d, opt, NULL}, of_rows[AMBULO__DIRECT_SETS];
  double least, begin = ambulo__seconds_now(), inside = d->engine->workspace->seconds_evaluate;
  int evaluations_before = run->evaluations;
  int result = nlopt_set_min_objective(opt, objective, &of_objective);
  if (result >= 0) result = add_sets(d, opt, of_rows);
  memset(d->w, 0, n * sizeof *d->w);
  if (result >= 0) result = nlopt_optimize(opt, d->w, &least);
  nlopt_destroy(opt);
  inside = d->engine->workspace->seconds_evaluate - inside;
  run->nlopt.inner += run->evaluations - evaluations_before;
  ambulo__run_nlopt(run, result, ambulo__seconds_now() - begin - inside);
  d->message = run->nlopt.result_name;
  return result == NLOPT_OUT_OF_MEMORY ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* ------------------------------------------------------------------------- calls */

static int is_over(const ambulo__direct *d) {
  return ambulo__run_over(d->engine->run) || !(d->best_violation < HUGE_VAL);
}

/* plain: from start to the rows, nearby; the point found is the best one */
static ambulo_status reach(ambulo__direct *d) {
  ambulo_status status = AMBULO_OK;
  d->nearest = 1;
  d->best_violation = d->best_objective = HUGE_VAL;
  for (int k = 0; k < AMBULO__REACH_CALLS && !status && !is_feasible(d); k++) {
    double before = d->best_violation;
    status = ambulo__direct_minimize(d, AMBULO_SLSQP, AMBULO__REACH_EVALUATIONS);
    if (status || is_over(d) || d->best_violation >= before) break;
    memcpy(d->start, d->best_x, bytes_of(d));
    d->engine->run->iterations++;
  }
  d->nearest = 0;
  return status;
}

/* whitened: the metric at `start`; 1 when it cannot be had, which *ending says */
static int whiten(ambulo__direct *d, ambulo_ending *ending) {
  double predicted;
  if (!d->whitener) return 0;
  memcpy(d->engine->iterate.x, d->start, bytes_of(d));
  int failed = ambulo__model_step(d->engine, &predicted);
  if (failed) *ending = failed == 2 ? AMBULO_ENDING_NOT_FINITE : AMBULO_ENDING_BREAKDOWN;
  return failed != 0;
}

/* one call of AUGLAG; plain: then from where its last inner problem ended to the rows. The point
 * found there replaces the best one before the call where it is better. */
static ambulo_status minimize_by_auglag(ambulo__direct *d) {
  const ambulo__run *run = d->engine->run;
  double objective = d->best_objective, violation = d->best_violation;
  int left = run->options->maximum_evaluations - run->evaluations, was_feasible = is_feasible(d);
  /* the way to the rows takes a few calls as well */
  int reserve = AMBULO__REACH_CALLS / 2 * AMBULO__REACH_EVALUATIONS;
  int evaluations = left > 2 * reserve ? left - reserve : (left + 1) / 2;
  memcpy(d->spare_x, d->best_x, bytes_of(d));
  ambulo_status status = ambulo__direct_minimize(d, AMBULO_AUGLAG, evaluations);
  if (status || d->whitener) return status;
  const char *message = d->message;
  memcpy(d->start, d->last_x, bytes_of(d));
  status = reach(d);
  d->message = message;
  if (was_feasible ? is_feasible(d) && d->best_objective < objective
                   : d->best_violation < violation)
    return status;
  memcpy(d->best_x, d->spare_x, bytes_of(d));
  d->best_objective = objective;
  d->best_violation = violation;
  return status;
}

/* a call, and whether it ends the solve: the objective has settled at a feasible point, or the
 * violation has not fallen for `*idle` calls */
static ambulo_status call(ambulo__direct *d, ambulo_algorithm algorithm, int *idle,
                          ambulo_ending *ending) {
  ambulo__run *run = d->engine->run;
  double before = d->best_objective, violation = d->best_violation;
  if (whiten(d, ending)) return AMBULO_OK;
  ambulo_status status = algorithm == AMBULO_AUGLAG
                             ? minimize_by_auglag(d)
                             : ambulo__direct_minimize(d, AMBULO_SLSQP, AMBULO__CALL_EVALUATIONS);
  if (status) return status;
  double change = fabs(d->best_objective - before);
  int feasible = is_feasible(d);
  run->iterations++;
  *idle = feasible || d->best_violation < AMBULO__VIOLATION_BETTER * violation ? 0 : *idle + 1;
  if (*idle == AMBULO__PATIENCE) *ending = AMBULO_ENDING_STALLED;
  if (!(d->best_violation < HUGE_VAL)) *ending = AMBULO_ENDING_NO_DESCENT;
  if (feasible && before < HUGE_VAL && change <= AMBULO__HALF_DIGITS * (fabs(before) + 1e-12))
    *ending = AMBULO_ENDING_SETTLED;
  (void)ambulo__run_iteration(run, d->engine->setup->problem->definition.intervals,
                              d->best_objective, d->best_violation, NAN);
  return AMBULO_OK;
}

/* whitened: the last point that AUGLAG was at, carried onto the equalities, into start; 1 when
 * there is none */
static int restore_last(ambulo__direct *d) {
  double error;
  memcpy(d->start, d->last_x, bytes_of(d));
  return ambulo__restore(d->engine, d->start, &error) || !(error <= AMBULO__RESTORED);
}

/* calls from start until one of them, or the run, ends them */
static ambulo_status calls(ambulo__direct *d, ambulo_algorithm algorithm) {
  ambulo__run *run = d->engine->run;
  ambulo_status status = AMBULO_OK;
  ambulo_ending ending = AMBULO_ENDING_NONE;
  int idle = 0, from_last = 0, most = run->options->maximum_iterations;
  for (int k = 0; !status && !ending && !run->stopped; k++) {
    if (k == most) {
      ending = AMBULO_ENDING_ITERATIONS;
      break;
    }
    status = call(d, algorithm, &idle, &ending);
    from_last =
        ending == AMBULO_ENDING_SETTLED && algorithm == AMBULO_AUGLAG && d->whitener && !from_last;
    if (!status && from_last && !restore_last(d)) {
      ending = AMBULO_ENDING_NONE;
    } else {
      memcpy(d->start, d->best_x, bytes_of(d));
    }
  }
  if (ending) ambulo__run_end(run, ending);
  return status;
}

ambulo_status ambulo__solve_direct(ambulo__engine *e, ambulo_algorithm algorithm, int plain,
                                   ambulo_diagnostics *diagnostics, double *x,
                                   const char **message) {
  ambulo__direct d;
  double error;
  size_t bytes = (size_t)e->setup->n * sizeof *x;
  ambulo_status status = ambulo__direct_create(e, plain, &d);
  e->iterate.mu = AMBULO__DAMPING_START * e->setup->problem->definition.duration /
                  (double)ambulo__basis_intervals(e->setup->problem->basis);
  e->iterate.rho = AMBULO__PENALTY_START;
  if (!status && !plain) status = ambulo__restore(e, x, &error);
  if (!status) memcpy(d.start, x, bytes);
  if (!status && plain) {
    status = reach(&d);
    memcpy(d.start, d.best_x, bytes);
  }
  if (!status) status = calls(&d, algorithm);
  if (status == AMBULO_E_LIMIT)
    (void)ambulo__error(diagnostics, status, ambulo__nowhere, "use solver.algorithm: auto",
                        "%d unknowns and %d rows need more memory than 4 GB in dense form",
                        e->setup->n, e->setup->problem->rows);
  if (!status && d.best_violation < HUGE_VAL) memcpy(x, d.best_x, bytes);
  *message = d.message;
  return status;
}
