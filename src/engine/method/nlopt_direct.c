/* method/nlopt_direct.c - see nlopt_direct.h.
 *
 * NLopt is kept from harm (docs/equations.md, "the solver"): a non-finite value becomes
 * HUGE_VAL, with rows that are finite; its answers are not believed: the best point is kept
 * here (feasible: lowest objective; else smallest violation); evaluation limit and
 * tolerances are always set; equalities are counted against the unknowns before they are
 * added; stop requests are polled in every callback.
 */
#include "method/nlopt_direct.h"
#include "method/parameters.h"
#include "base/worst.h"
#include "method/nlopt_memory.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>

typedef struct callback {
  ambulo__direct *direct;
  nlopt_opt opt;
  ambulo__sparse_rows *set;
} callback;

typedef struct callbacks {
  callback objective, rows[AMBULO__DIRECT_SETS];
} callbacks;

ambulo_status ambulo__direct_create(ambulo__direct *d, ambulo__pool *pool) {
  size_t n = (size_t)d->problem->variables;
  int largest = 1;
  for (int s = 0; s < d->sets; s++) {
    if (d->set[s]->count > largest) largest = d->set[s]->count;
  }
  d->start = ambulo__pool_doubles(pool, n);
  d->x = ambulo__pool_doubles(pool, n);
  d->w = ambulo__pool_doubles(pool, n);
  d->gradient = ambulo__pool_doubles(pool, n);
  d->last_x = ambulo__pool_doubles(pool, n);
  d->best_x = ambulo__pool_doubles(pool, n);
  d->values = ambulo__pool_doubles(pool, (size_t)largest);
  d->best_objective = d->best_violation = HUGE_VAL;
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* worst over all sets, relative to the sizes of the rows */
static double violation_of(ambulo__direct *d) {
  const ambulo__table_row *table = d->problem->table.rows;
  double worst = 0.0;
  for (int s = 0; s < d->sets; s++) {
    const ambulo__sparse_rows *set = d->set[s];
    ambulo__sparse_rows_values(set, d->workspace, d->values);
    for (int i = 0; i < set->count; i++) {
      double value = d->is_equality[s] ? fabs(d->values[i]) : ambulo__worse(0.0, d->values[i]);
      worst = ambulo__worse(worst, value / (fabs(set->scale[i]) * table[set->row[i]].size));
    }
  }
  return worst;
}

static void keep_best(ambulo__direct *d) {
  double violation = violation_of(d), objective = d->workspace->objective;
  double tolerance = d->run->options->feasibility_tolerance;
  int feasible = violation <= tolerance, was = d->best_violation <= tolerance;
  int better = feasible && was ? objective < d->best_objective : violation < d->best_violation;
  if (!better) return;
  ambulo__run_forgive(d->run);
  d->best_violation = violation;
  d->best_objective = objective;
  memcpy(d->best_x, d->x, (size_t)d->problem->variables * sizeof *d->x);
  if (!d->whitener)
    (void)ambulo__run_iteration(d->run, d->problem->definition.intervals, objective, violation,
                                NAN);
}

/* evaluates at w; 0 when the values are finite. Values that are not, and gradients of them, give
 * the point up: HUGE_VAL never looks like a descent. */
static int move_to(ambulo__direct *d, const double *w) {
  size_t n = (size_t)d->problem->variables;
  memcpy(d->x, w, n * sizeof *w);
  if (d->whitener) ambulo__band_backward(d->whitener, d->x);
  for (size_t j = 0; j < n; j++) d->x[j] += d->start[j];
  if (!ambulo__evaluate(d->workspace, d->x)) return 0;
  ambulo__run_fault(d->run, &d->workspace->fault);
  return 1;
}

static int reached(const ambulo__direct *d) {
  return d->best_violation <= AMBULO__DIRECT_REACHED * d->run->options->feasibility_tolerance;
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
  ambulo__run_count(d->run);
  int failed = move_to(d, w);
  if (!failed && gradient && !d->nearest) {
    failed = ambulo__gradient(d->workspace, d->objective_scale, NULL, gradient) != AMBULO_OK;
    if (failed) ambulo__run_fault(d->run, &d->workspace->fault);
    if (d->whitener) ambulo__band_forward(d->whitener, gradient);
  }
  if (!failed) keep_best(d);
  if (d->run->stopped || (d->nearest && reached(d))) nlopt_force_stop(c->opt);
  if (gradient && failed) memset(gradient, 0, n * sizeof *gradient);
  if (failed) return HUGE_VAL;
  if (!gradient) memcpy(d->last_x, d->x, n * sizeof *d->x);
  if (d->nearest) return distance(n, w, gradient);
  return d->objective_scale * d->workspace->objective;
}

static void rows(unsigned m, double *result, unsigned n, const double *w, double *gradient,
                 void *data) {
  callback *c = data;
  ambulo__direct *d = c->direct;
  int failed = move_to(d, w);
  if (!failed && gradient) failed = ambulo__evaluate_jacobian(d->workspace, d->x) != AMBULO_OK;
  if (gradient) memset(gradient, 0, (size_t)m * (size_t)n * sizeof *gradient);
  if (!failed && gradient) {
    failed = ambulo__sparse_rows_fill(c->set, d->workspace, 0) != AMBULO_OK;
    if (failed) ambulo__run_fault(d->run, &d->workspace->fault);
  }
  if (failed) {
    for (unsigned i = 0; i < m; i++) result[i] = AMBULO__DIRECT_FAILED_ROW;
    return;
  }
  ambulo__sparse_rows_values(c->set, d->workspace, result);
  if (!gradient) return;
  for (unsigned i = 0; i < m; i++) {
    double *row = gradient + (size_t)i * (size_t)n;
    const double *value = ambulo__sparse_rows_gradient(c->set, (int)i) - c->set->start[i];
    for (int e = c->set->start[i]; e < c->set->start[i + 1]; e++)
      row[c->set->column[e]] += value[e];
    if (d->whitener) ambulo__band_forward(d->whitener, row);
  }
}

/* bytes of SLSQP's and AUGLAG's dense work, roughly */
static double memory_of(const ambulo__direct *d, ambulo_algorithm algorithm) {
  double n = d->problem->variables, m = 0.0;
  for (int s = 0; s < d->sets; s++) m += d->set[s]->count;
  return 8.0 * (algorithm == AMBULO_AUGLAG ? m * n : 4.0 * n * n + 4.0 * m * n);
}

static int equalities_of(const ambulo__direct *d) {
  int count = 0;
  for (int s = 0; s < d->sets; s++) count += d->is_equality[s] ? d->set[s]->count : 0;
  return count;
}

static nlopt_opt create_optimizer(unsigned n, ambulo_algorithm algorithm, int evaluations) {
  nlopt_opt opt = nlopt_create(algorithm == AMBULO_AUGLAG ? NLOPT_AUGLAG : NLOPT_LD_SLSQP, n);
  if (!opt) return NULL;
  int failed = nlopt_set_maxeval(opt, evaluations) < 0 ||
               nlopt_set_ftol_rel(opt, AMBULO__DIRECT_VALUE) < 0 ||
               nlopt_set_xtol_rel(opt, AMBULO__DIRECT_POINT) < 0;
  if (!failed && algorithm == AMBULO_AUGLAG) {
    nlopt_opt local = nlopt_create(NLOPT_LD_LBFGS, n);
    failed = !local || nlopt_set_maxeval(local, evaluations / 10 + 50) < 0 ||
             nlopt_set_ftol_rel(local, AMBULO__DIRECT_INNER) < 0 ||
             nlopt_set_xtol_rel(local, AMBULO__DIRECT_INNER) < 0 ||
             nlopt_set_vector_storage(local, AMBULO__STORED_VECTORS) < 0 ||
             !ambulo__nlopt_can_copy(n) || nlopt_set_local_optimizer(opt, local) < 0;
    nlopt_destroy(local);
  }
  if (!failed) return opt;
  nlopt_destroy(opt);
  return NULL;
}

static int add_sets(ambulo__direct *d, nlopt_opt opt, callback *rows_of) {
  for (int s = 0; s < d->sets; s++) {
    ambulo__sparse_rows *set = d->set[s];
    if (set->count == 0) continue;
    callback c = {d, opt, set};
    rows_of[s] = c;
    unsigned m = (unsigned)set->count;
    for (int i = 0; i < set->count; i++) d->values[i] = AMBULO__DIRECT_ROW;
    int added = d->is_equality[s]
                    ? nlopt_add_equality_mconstraint(opt, m, rows, &rows_of[s], d->values)
                    : nlopt_add_inequality_mconstraint(opt, m, rows, &rows_of[s], d->values);
    if (added < 0) return added;
  }
  return NLOPT_SUCCESS;
}

const char *ambulo__nlopt_name(int result) {
  switch (result) {
  case NLOPT_FAILURE:
    return "FAILURE";
  case NLOPT_INVALID_ARGS:
    return "INVALID_ARGS";
  case NLOPT_OUT_OF_MEMORY:
    return "OUT_OF_MEMORY";
  case NLOPT_ROUNDOFF_LIMITED:
    return "ROUNDOFF_LIMITED";
  case NLOPT_FORCED_STOP:
    return "FORCED_STOP";
  case NLOPT_SUCCESS:
    return "SUCCESS";
  case NLOPT_STOPVAL_REACHED:
    return "STOPVAL_REACHED";
  case NLOPT_FTOL_REACHED:
    return "FTOL_REACHED";
  case NLOPT_XTOL_REACHED:
    return "XTOL_REACHED";
  case NLOPT_MAXEVAL_REACHED:
    return "MAXEVAL_REACHED";
  case NLOPT_MAXTIME_REACHED:
    return "MAXTIME_REACHED";
  default:
    return "unknown result";
  }
}

ambulo_status ambulo__direct_minimize(ambulo__direct *d, ambulo_algorithm algorithm,
                                      int evaluations) {
  unsigned n = (unsigned)d->problem->variables;
  if (memory_of(d, algorithm) > AMBULO__DIRECT_MEMORY) return AMBULO_E_LIMIT;
  if (equalities_of(d) >= d->problem->variables) {
    d->message = "not called: as many equality rows as unknowns";
    d->result = NLOPT_INVALID_ARGS;
    return AMBULO_OK;
  }
  nlopt_opt opt = create_optimizer(n, algorithm, evaluations);
  if (!opt) return AMBULO_E_MEMORY;
  callbacks s = {0};
  s.objective.direct = d;
  s.objective.opt = opt;
  double least, begin = ambulo__seconds_now(), inside = d->workspace->seconds_evaluate;
  int evaluations_before = d->run->evaluations;
  d->result = nlopt_set_min_objective(opt, objective, &s.objective);
  if (d->result >= 0) d->result = add_sets(d, opt, s.rows);
  memset(d->w, 0, n * sizeof *d->w);
  if (d->result >= 0) d->result = nlopt_optimize(opt, d->w, &least);
  d->message = ambulo__nlopt_name(d->result);
  nlopt_destroy(opt);
  inside = d->workspace->seconds_evaluate - inside;
  d->run->nlopt.inner += d->run->evaluations - evaluations_before;
  ambulo__run_nlopt(d->run, d->result, d->message, ambulo__seconds_now() - begin - inside);
  return d->result == NLOPT_OUT_OF_MEMORY ? AMBULO_E_MEMORY : AMBULO_OK;
}
