/* method/engine.c - setting up a solve on one grid; shared small steps. */
#include "method/engine.h"
#include "method/parameters.h"

#include "base/worst.h"
#include "nlp/fault.h"
#include "nlp/user_term.h"

#include "gait/bounds.h"

#include <math.h>
#include <string.h>

/* A coordinate whose range is wide (the way a walker travels) may move further at once. */
static double cap_of(const ambulo_problem *problem, int i) {
  const ambulo_coordinate *c = &problem->model->coordinates[i];
  ambulo__bounds bounds = ambulo__bounds_of(&problem->definition, i, AMBULO_LIMITED_POSITION);
  if (c->type == AMBULO_REVOLUTE) return AMBULO__USUAL_CAP;
  double width = bounds.high.value - bounds.low.value;
  return isfinite(width) ? fmax(AMBULO__USUAL_CAP, AMBULO__RANGE_CAP * width) : HUGE_VAL;
}

static ambulo_status create_trial(ambulo__engine *e, ambulo__trial *trial) {
  trial->value = HUGE_VAL;
  trial->x = ambulo__pool_doubles(&e->pool, (size_t)e->n);
  trial->excess = ambulo__pool_doubles(&e->pool, (size_t)e->inequalities);
  trial->multiplier = ambulo__pool_doubles(&e->pool, (size_t)e->inequalities);
  trial->equality_multiplier = ambulo__pool_doubles(&e->pool, (size_t)e->equalities);
  return e->pool.failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

static void create_vectors(ambulo__engine *e) {
  ambulo__pool *pool = &e->pool;
  size_t n = (size_t)e->n, m = (size_t)e->inequalities, q = (size_t)e->equalities;
  double **long_vectors[] = {&e->center,       &e->gradient,   &e->step,           &e->total,
                             &e->curved,       &e->previous,   &e->previous_right, &e->w,
                             &e->curved_total, &e->w_gradient, &e->iterate,        &e->best_total,
                             &e->best_curved};
  for (size_t i = 0; i < sizeof long_vectors / sizeof *long_vectors; i++)
    *long_vectors[i] = ambulo__pool_doubles(pool, n);
  e->lambda = ambulo__pool_doubles(pool, m);
  e->along = ambulo__pool_doubles(pool, m);
  e->linear = ambulo__pool_doubles(pool, m);
  e->active = ambulo__pool_ints(pool, m);
  e->added = ambulo__pool_ints(pool, m);
  e->best_linear = ambulo__pool_doubles(pool, m);
  e->active_next = ambulo__pool_ints(pool, m);
  e->equality_multiplier = ambulo__pool_doubles(pool, q);
  e->h = ambulo__pool_doubles(pool, q);
  e->dual = ambulo__pool_doubles(pool, q);
  e->balanced = ambulo__pool_doubles(pool, q);
  e->b = ambulo__pool_doubles(pool, (size_t)e->borders);
  e->border_multiplier = ambulo__pool_doubles(pool, (size_t)e->borders);
  e->row_weight = ambulo__pool_doubles(pool, (size_t)e->problem->rows);
  e->negligible_term = ambulo__pool_doubles(pool, (size_t)e->problem->definition.term_count);
  e->cap = ambulo__pool_doubles(pool, (size_t)e->problem->coordinates);
}

/* An objective of terms that cannot be negative is at its lower bound, for all purposes, when each
 * of them is this small beside its value for the motionless body. Multipliers and gradient vanish
 * there together, and their ratio says nothing. Distances to a reference have no such measure: a
 * motionless body is far from it by any standard. */
static double negligible_objective(ambulo__engine *e) {
  const ambulo_problem_definition *d = &e->problem->definition;
  double tolerance = e->run->options->optimality_tolerance;
  if (ambulo__evaluate(e->workspace, e->center)) return -1.0; /* zeros so far */
  e->at_rest = fabs(e->workspace->objective);
  for (int t = 0; t < d->term_count; t++) {
    if (ambulo__is_user_term(&d->terms[t]) || d->terms[t].kind == AMBULO_TRACKING) return -1.0;
  }
  for (int t = 0; t < d->term_count; t++) {
    e->negligible_term[t] = tolerance * e->workspace->term_value[t];
  }
  return tolerance * e->workspace->objective;
}

int ambulo__engine_at_lower_bound(const ambulo__engine *e) {
  for (int t = 0; t < e->problem->definition.term_count; t++) {
    if (e->negligible < 0.0 || e->workspace->term_value[t] > e->negligible_term[t]) return 0;
  }
  return e->negligible >= 0.0;
}

/* Of an objective without curvature (linear terms of the caller): the factor that gives its
 * gradient at the start the length 1 in the metric, where those of walks have 1 to 2.5. */
static double scale_by_gradient(ambulo__engine *e, const double *start) {
  const ambulo_problem *p = e->problem;
  double sum = 0.0;
  if (ambulo__evaluate_jacobian(e->workspace, start) ||
      ambulo__gradient(e->workspace, 1.0, NULL, e->gradient))
    return 1.0;
  ambulo__metric_fill(&e->metric, e->workspace, 0.0, &e->base);
  ambulo__band_add_diagonal(&e->base, p->definition.duration / ambulo__basis_intervals(p->basis));
  if (ambulo__band_factor(&e->base)) return 1.0;
  ambulo__band_forward(&e->base, e->gradient);
  for (int j = 0; j < e->n; j++) sum += e->gradient[j] * e->gradient[j];
  return sum > 0.0 && isfinite(sum) ? 1.0 / sqrt(sum) : 1.0;
}

static ambulo_status create_parts(ambulo__engine *e, const double *start,
                                  ambulo_diagnostics *diagnostics) {
  const ambulo_problem *p = e->problem;
  ambulo__pool *pool = &e->pool;
  const double *zero = ambulo__pool_doubles(pool, (size_t)p->variables);
  if (!zero) return AMBULO_E_MEMORY;
  if (ambulo__evaluate(e->workspace, zero) == AMBULO_OK) start = zero;
  ambulo_status status =
      ambulo__rows_split_create(p, e->workspace, start, e->run, pool, diagnostics, &e->rows);
  if (status) return status;
  e->n = p->variables;
  e->equalities = e->rows.equality.count;
  e->inequalities = e->rows.inequality.count;
  e->borders = e->rows.border.count;
  int kd = ambulo__metric_diagonals(p);
  status = ambulo__metric_create(p, pool, &e->metric);
  if (!status) status = ambulo__band_create(pool, e->n, kd, &e->base);
  if (!status) status = ambulo__band_create(pool, e->n, kd, &e->whitener);
  if (!status) status = ambulo__kkt_create(&e->rows.equality, &e->rows.border, kd, pool, &e->kkt);
  if (!status) status = ambulo__mixing_create(pool, e->n, e->equalities, &e->retraction);
  if (!status) status = ambulo__mixing_create(pool, e->equalities, e->equalities, &e->adjoint);
  if (status) return status;
  create_vectors(e);
  status = create_trial(e, &e->held);
  if (!status) status = create_trial(e, &e->reached);
  if (status) return status;
  for (int i = 0; i < p->coordinates; i++) e->cap[i] = cap_of(p, i);
  e->objective_scale = ambulo__metric_objective_scale(&e->metric, e->workspace);
  if (e->objective_scale == 0.0) e->objective_scale = scale_by_gradient(e, start);
  e->adjoint_tolerance = AMBULO__ADJOINT_TOLERANCE;
  e->retraction_tolerance = fmin(AMBULO__RETRACTION_TOLERANCE,
                                 AMBULO__RETRACTION_SHARE * e->run->options->feasibility_tolerance);
  e->carried_objective = -1.0;
  e->negligible = negligible_objective(e);
  return AMBULO_OK;
}

ambulo_status ambulo__engine_create(const ambulo_problem *problem, const double *start,
                                    const ambulo_allocator *allocator, ambulo__run *run,
                                    ambulo_diagnostics *diagnostics, ambulo__engine **engine) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__engine *e = ambulo__alloc(&own, 1, sizeof *e);
  if (!e) return AMBULO_E_MEMORY;
  ambulo__pool_init(&e->pool, &own);
  e->problem = problem;
  e->run = run;
  ambulo_status status = ambulo_workspace_create(problem, &own, &e->workspace);
  if (!status) status = create_parts(e, start, diagnostics);
  if (status) {
    ambulo__engine_free(e);
    return status;
  }
  *engine = e;
  return AMBULO_OK;
}

void ambulo__engine_free(ambulo__engine *e) {
  if (!e) return;
  ambulo_allocator a = e->pool.allocator;
  if (e->workspace && e->run) e->run->seconds_evaluate += e->workspace->seconds_evaluate;
  ambulo_workspace_free(e->workspace);
  ambulo__pool_clear(&e->pool);
  ambulo__free(&a, e);
}

/* worst of a set of equalities whose values are there, relative to the sizes of the rows */
static double worst_equality(const ambulo__engine *e, const ambulo__sparse_rows *rows,
                             const double *value) {
  const ambulo__table_row *table = e->problem->table.rows;
  double worst = 0.0;
  for (int i = 0; i < rows->count; i++)
    worst = ambulo__worse(worst, fabs(value[i]) / table[rows->row[i]].size);
  return worst;
}

double ambulo__engine_equality_error(ambulo__engine *e) {
  ambulo__sparse_rows_values(&e->rows.equality, e->workspace, e->h);
  ambulo__sparse_rows_values(&e->rows.border, e->workspace, e->b);
  return ambulo__worse(worst_equality(e, &e->rows.equality, e->h),
                       worst_equality(e, &e->rows.border, e->b));
}

double ambulo__engine_excess(const ambulo__engine *e, double *excess) {
  const ambulo__sparse_rows *rows = &e->rows.inequality;
  const ambulo__table_row *table = e->problem->table.rows;
  double worst = 0.0;
  ambulo__sparse_rows_values(rows, e->workspace, excess);
  for (int i = 0; i < e->inequalities; i++) {
    if (excess[i] <= 0.0) continue;
    worst = ambulo__worse(worst, excess[i] / (-rows->scale[i] * table[rows->row[i]].size));
  }
  return worst;
}

ambulo_status ambulo__engine_gradient(ambulo__engine *e, const double *p, const double *l,
                                      double *gradient) {
  memset(e->row_weight, 0, (size_t)e->problem->rows * sizeof *e->row_weight);
  for (int i = 0; p && i < e->inequalities; i++)
    e->row_weight[e->rows.inequality.row[i]] = e->rows.inequality.scale[i] * p[i];
  for (int i = 0; l && i < e->equalities; i++)
    e->row_weight[e->rows.equality.row[i]] = e->rows.equality.scale[i] * l[i];
  ambulo_status status =
      ambulo__gradient(e->workspace, e->objective_scale, e->row_weight, gradient);
  if (status) ambulo__run_fault(e->run, &e->workspace->fault);
  return status;
}

int ambulo__engine_fill_metric(ambulo__engine *e, double mu) {
  ambulo__metric_fill(&e->metric, e->workspace, e->objective_scale, &e->base);
  ambulo__band_add_diagonal(&e->base, mu);
  double largest = ambulo__band_largest(&e->base);
  if (isfinite(largest)) return 0;
  ambulo__fault_of_curvature(e->workspace, largest);
  ambulo__run_fault(e->run, &e->workspace->fault);
  return 1;
}

double ambulo__engine_step_limit(const ambulo__engine *e, const double *step, double share) {
  int d = e->problem->coordinates;
  double largest = 0.0;
  for (int j = 0; j < e->n; j++) largest = ambulo__worse(largest, fabs(step[j]) / e->cap[j % d]);
  return largest <= share ? 1.0 : share / largest;
}
