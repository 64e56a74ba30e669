/* method/slsqp.c - see slsqp.h.
 *
 *     x = start + L^-T w     L L' the metric of the model step at `start`
 *
 * From x carried onto the equalities, calls of SLSQP on all rows with dense gradients, each from
 * the best point of the last: SLSQP stops with ROUNDOFF_LIMITED, or with success at points that are
 * not feasible, and a new call starts with a fresh quadratic model, the identity, which in w is the
 * metric.
 *
 * NLopt is kept from harm (docs/equations.md, "the solver"): a non-finite value becomes HUGE_VAL,
 * with rows that are finite; its answers are not believed: the best point is kept here; evaluation
 * limit and tolerances are always set; equalities are counted against the unknowns before SLSQP is
 * called; stop requests are polled in every callback.
 */
#include "method/slsqp.h"

#include "base/arithmetic.h"
#include "method/equalities.h"
#include "method/model_step.h"
#include "method/parameters.h"
#include "method/pipeline.h"
#include "method/point.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>

enum { SETS = 3 }; /* equalities, border rows, inequalities as excesses <= 0 */

typedef struct direct {
  ambulo__engine *engine;
  ambulo__sparse_rows *set[SETS];
  double *start, *x, *w; /* [n] */
  double *values;        /* [largest set] */
  double *best_x;        /* [n]: feasible: lowest objective; else smallest violation */
  double best_objective, best_violation; /* HUGE_VAL: none yet */
  const char *message;                   /* NLopt's name of its result */
} direct;

typedef struct callback {
  direct *direct;
  nlopt_opt opt;
  ambulo__sparse_rows *set;
} callback;

static ambulo_status create(ambulo__engine *e, direct *d) {
  ambulo__row_roles *rows = &e->linearized.rows;
  size_t n = (size_t)e->setup->n, largest = 1;
  *d = (direct){.engine = e,
                .set = {&rows->equality, &rows->border, &rows->inequality},
                .best_objective = HUGE_VAL,
                .best_violation = HUGE_VAL,
                .message = "not called"};
  for (int s = 0; s < SETS; s++) {
    if ((size_t)d->set[s]->count > largest) largest = (size_t)d->set[s]->count;
  }
  double **vectors[] = {&d->start, &d->x, &d->w, &d->best_x};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
    *vectors[i] = ambulo__pool_doubles(&e->pool, n);
  d->values = ambulo__pool_doubles(&e->pool, largest);
  return e->pool.failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

static int is_equality(int set) {
  return set < SETS - 1;
}

static size_t bytes_of(const direct *d) {
  return (size_t)d->engine->setup->n * sizeof *d->start;
}

static int is_feasible(const direct *d) {
  return d->best_violation <= d->engine->run->options->feasibility_tolerance;
}

/* --------------------------------------------------------------- what NLopt asks */

/* worst over all sets, relative to the sizes of the rows */
static double violation_of(direct *d) {
  const ambulo__table_row *table = d->engine->setup->problem->table.rows;
  double worst = 0.0;
  for (int s = 0; s < SETS; s++) {
    const ambulo__sparse_rows *set = d->set[s];
    ambulo__sparse_rows_values(set, d->engine->workspace, d->values);
    for (int i = 0; i < set->count; i++) {
      double value = is_equality(s) ? fabs(d->values[i]) : ambulo__worse(0.0, d->values[i]);
      worst = ambulo__worse(worst, value / (fabs(set->scale[i]) * table[set->row[i]].size));
    }
  }
  return worst;
}

static void keep_best(direct *d) {
  double violation = violation_of(d), objective = d->engine->workspace->objective;
  int feasible = violation <= d->engine->run->options->feasibility_tolerance;
  int better =
      feasible && is_feasible(d) ? objective < d->best_objective : violation < d->best_violation;
  if (!better) return;
  ambulo__run_forgive(d->engine->run);
  d->best_violation = violation;
  d->best_objective = objective;
  memcpy(d->best_x, d->x, bytes_of(d));
  d->engine->run->point = d->best_x;
  (void)ambulo__run_progress(d->engine->run, objective, violation); /* NLopt may be long silent */
}

/* evaluates at w; 0 when the values are finite. Points where they are not, or where gradients are
 * not, are rejected: HUGE_VAL never looks like a descent. */
static int move_to(direct *d, const double *w) {
  ambulo__engine *e = d->engine;
  memcpy(d->x, w, bytes_of(d));
  ambulo__band_backward(&e->linearized.whitener, d->x);
  for (int j = 0; j < e->setup->n; j++) d->x[j] += d->start[j];
  if (!ambulo__evaluate(e->workspace, d->x)) return 0;
  ambulo__run_fault(e->run, &e->workspace->fault);
  return 1;
}

static double objective(unsigned n, const double *w, double *gradient, void *data) {
  callback *c = data;
  ambulo__engine *e = c->direct->engine;
  ambulo__run_count(e->run);
  int failed = move_to(c->direct, w);
  if (!failed && gradient) {
    failed = ambulo__engine_gradient(e, e->setup->objective_scale, NULL, NULL, gradient) != 0;
    ambulo__band_forward(&e->linearized.whitener, gradient);
  }
  if (!failed) keep_best(c->direct);
  if (e->run->stopped) nlopt_force_stop(c->opt);
  if (gradient && failed) memset(gradient, 0, n * sizeof *gradient);
  return failed ? HUGE_VAL : e->setup->objective_scale * e->workspace->objective;
}

static void rows(unsigned m, double *result, unsigned n, const double *w, double *gradient,
                 void *data) {
  callback *c = data;
  ambulo__engine *e = c->direct->engine;
  int failed = move_to(c->direct, w);
  if (!failed && gradient)
    failed = ambulo__evaluate_jacobian(e->workspace, c->direct->x) != AMBULO_OK;
  if (gradient) memset(gradient, 0, (size_t)m * (size_t)n * sizeof *gradient);
  if (!failed && gradient) {
    failed = ambulo__sparse_rows_fill(c->set, e->workspace, 0) != AMBULO_OK;
    if (failed) ambulo__run_fault(e->run, &e->workspace->fault);
  }
  if (failed) {
    for (unsigned i = 0; i < m; i++) result[i] = 1.0;
    return;
  }
  ambulo__sparse_rows_values(c->set, e->workspace, result);
  for (unsigned i = 0; i < m && gradient; i++) {
    double *row = gradient + (size_t)i * (size_t)n;
    const double *value = ambulo__sparse_rows_gradient(c->set, (int)i) - c->set->start[i];
    for (int k = c->set->start[i]; k < c->set->start[i + 1]; k++)
      row[c->set->column[k]] += value[k];
    ambulo__band_forward(&e->linearized.whitener, row);
  }
}

/* ------------------------------------------------------------------------- calls */

static int add_sets(direct *d, nlopt_opt opt, callback *rows_of) {
  for (int s = 0; s < SETS; s++) {
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

/* from start, with the whitener there */
static ambulo_status minimize(direct *d) {
  ambulo__run *run = d->engine->run;
  unsigned n = (unsigned)d->engine->setup->n;
  nlopt_opt opt = nlopt_create(NLOPT_LD_SLSQP, n);
  if (!opt) return AMBULO_E_MEMORY;
  callback of_objective = {d, opt, NULL}, of_rows[SETS];
  double least, begin = ambulo__seconds_now(), inside = d->engine->workspace->seconds_evaluate;
  int before = run->evaluations;
  int result = nlopt_set_min_objective(opt, objective, &of_objective);
  if (result >= 0) result = nlopt_set_maxeval(opt, AMBULO__CALL_EVALUATIONS);
  if (result >= 0) result = nlopt_set_ftol_rel(opt, AMBULO__ROUNDING);
  if (result >= 0) result = nlopt_set_xtol_rel(opt, AMBULO__ROUNDING);
  if (result >= 0) result = add_sets(d, opt, of_rows);
  memset(d->w, 0, n * sizeof *d->w);
  if (result >= 0) result = nlopt_optimize(opt, d->w, &least);
  nlopt_destroy(opt);
  inside = d->engine->workspace->seconds_evaluate - inside;
  run->nlopt.inner += run->evaluations - before;
  ambulo__run_nlopt(run, result, ambulo__seconds_now() - begin - inside);
  d->message = run->nlopt.result_name;
  return result == NLOPT_OUT_OF_MEMORY ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* a call from start, and whether it ends the solve: the objective has settled at a feasible point,
 * or the violation has not fallen for `*idle` calls */
static ambulo_status call(direct *d, int *idle, ambulo_ending *ending) {
  ambulo__run *run = d->engine->run;
  double predicted, before = d->best_objective, violation = d->best_violation;
  memcpy(d->engine->iterate.x, d->start, bytes_of(d));
  int failed = ambulo__model_step(d->engine, &predicted);
  if (failed) {
    *ending = failed == 2 ? AMBULO_ENDING_NOT_FINITE : AMBULO_ENDING_BREAKDOWN;
    return AMBULO_OK;
  }
  ambulo_status status = minimize(d);
  if (status) return status;
  double change = fabs(d->best_objective - before);
  int feasible = is_feasible(d);
  run->iterations++;
  *idle = feasible || d->best_violation < AMBULO__VIOLATION_BETTER * violation ? 0 : *idle + 1;
  if (*idle == AMBULO__PATIENCE) *ending = AMBULO_ENDING_STALLED;
  if (!(d->best_violation < HUGE_VAL)) *ending = AMBULO_ENDING_NO_DESCENT;
  if (feasible && before < HUGE_VAL && change <= AMBULO__HALF_DIGITS * (fabs(before) + 1e-12))
    *ending = AMBULO_ENDING_SETTLED;
  memcpy(d->start, d->best_x, bytes_of(d));
  (void)ambulo__run_iteration(run, d->engine->setup->problem->definition.intervals,
                              d->best_objective, d->best_violation, NAN);
  return AMBULO_OK;
}

/* calls from x until one of them, or the run, ends them; x: the best point */
static ambulo_status calls(direct *d, double *x) {
  ambulo__run *run = d->engine->run;
  ambulo_ending ending = AMBULO_ENDING_NONE;
  double error;
  int idle = 0;
  ambulo_status status = ambulo__restore(d->engine, x, &error);
  if (status == AMBULO_E_NUMERIC) ending = AMBULO_ENDING_NOT_FINITE;
  memcpy(d->start, x, bytes_of(d));
  for (int k = 0; !status && !ending && !run->stopped; k++) {
    if (k == run->options->maximum_iterations) {
      ending = AMBULO_ENDING_ITERATIONS;
    } else {
      status = call(d, &idle, &ending);
    }
  }
  if (ending) ambulo__run_end(run, ending);
  if (!status && d->best_violation < HUGE_VAL) memcpy(x, d->best_x, bytes_of(d));
  run->point = x;
  return status;
}

ambulo_status ambulo__solve_slsqp(ambulo__engine *e, ambulo_diagnostics *diagnostics, double *x,
                                  const char **message) {
  ambulo_status near = ambulo__near_all(e, x);
  if (near) return near;
  const ambulo__setup *s = e->setup;
  double n = s->n, m = s->equalities + s->borders + s->inequalities;
  if (8.0 * (4.0 * n * n + 4.0 * m * n) > AMBULO__DIRECT_MEMORY) /* roughly */
    return ambulo__error(diagnostics, AMBULO_E_LIMIT, ambulo__nowhere, "use solver.algorithm: auto",
                         "%d unknowns and %d rows need more memory than 4 GB in dense form", s->n,
                         s->problem->rows);
  *message = "not called: as many equality rows as unknowns";
  if (s->equalities + s->borders >= s->n) {
    ambulo__run_end(e->run, AMBULO_ENDING_NO_DESCENT);
    return AMBULO_OK;
  }
  e->iterate.mu = AMBULO__DAMPING_START * s->problem->definition.duration /
                  (double)ambulo__basis_intervals(s->problem->basis);
  e->iterate.rho = AMBULO__PENALTY_START;
  direct d;
  ambulo_status status = create(e, &d);
  if (!status) status = calls(&d, x);
  *message = d.message;
  return status;
}
