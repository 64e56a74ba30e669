/* method/engine.c - setting up a solve on one grid. */
#include "method/engine.h"
#include "contact/row_families.h"
#include "method/augmented.h"
#include "method/model_step.h"
#include "method/parameters.h"
#include "method/pipeline.h"
#include "method/equalities.h"
#include "problem/callbacks.h"

#include <math.h>
#include <string.h>

/* A coordinate whose range is wide (the way a walker travels) may move further at once. */
static double cap_of(const ambulo_problem *problem, int i) {
  const ambulo_coordinate *c = &problem->model->coordinates[i];
  ambulo__bounds bounds = ambulo__bounds_of(&problem->definition, i, AMBULO_LIMITED_POSITION);
  if (c->type == AMBULO_REVOLUTE) return 1.0;
  double width = bounds.high.value - bounds.low.value;
  return isfinite(width) ? fmax(1.0, width) : HUGE_VAL;
}

/* An objective of terms that cannot be negative is at its lower bound, for all purposes, when each
 * of them is this small beside its value for the motionless body. Multipliers and gradient vanish
 * there together, and their ratio says nothing. Distances to a reference have no such measure: a
 * motionless body is far from it by any standard. */
static double negligible_objective(const ambulo__engine *e, const double *zero, ambulo__setup *s) {
  const ambulo_problem_definition *d = &s->problem->definition;
  double tolerance = e->run->options->optimality_tolerance;
  if (ambulo__evaluate(e->workspace, zero)) return -1.0;
  s->at_rest = fabs(e->workspace->objective);
  for (int t = 0; t < d->term_count; t++) {
    if (ambulo__is_user_term(&d->terms[t]) || ambulo__term_follows(&d->terms[t])) return -1.0;
  }
  for (int t = 0; t < d->term_count; t++) {
    s->negligible_term[t] = tolerance * e->workspace->term_value[t];
  }
  return tolerance * e->workspace->objective;
}

/* Of an objective without curvature (linear terms of the caller): the factor that gives its
 * gradient at the start the length 1 in the metric, where those of walks have 1 to 2.5. */
static double scale_by_gradient(ambulo__engine *e, const double *start) {
  const ambulo_problem *p = e->setup->problem;
  ambulo__band *base = &e->linearized.base;
  double sum = 0.0, *gradient = e->quadratic->gradient;
  if (ambulo__evaluate_jacobian(e->workspace, start) ||
      ambulo__gradient(e->workspace, 1.0, NULL, gradient))
    return 1.0;
  ambulo__metric_fill(&e->linearized.metric, e->workspace, 0.0, base);
  ambulo__band_add_diagonal(base, p->definition.duration / ambulo__basis_intervals(p->basis));
  if (ambulo__band_factor(base)) return 1.0;
  ambulo__band_forward(base, gradient);
  for (int j = 0; j < p->variables; j++) sum += gradient[j] * gradient[j];
  return sum > 0.0 && isfinite(sum) ? 1.0 / sqrt(sum) : 1.0;
}

static ambulo_status create_iterate(ambulo__engine *e) {
  const ambulo__setup *s = e->setup;
  ambulo__iterate *iterate = &e->iterate;
  iterate->lambda = ambulo__pool_doubles(&e->pool, (size_t)s->inequalities);
  iterate->equality_multiplier = ambulo__pool_doubles(&e->pool, (size_t)s->equalities);
  iterate->border_multiplier = ambulo__pool_doubles(&e->pool, (size_t)s->borders);
  iterate->carried_objective = -1.0;
  return e->pool.failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

static ambulo_status create_measured(ambulo__engine *e) {
  const ambulo__setup *s = e->setup;
  ambulo__measured *m = &e->measured;
  m->equality = ambulo__pool_doubles(&e->pool, (size_t)s->equalities);
  m->border = ambulo__pool_doubles(&e->pool, (size_t)s->borders);
  m->excess = ambulo__pool_doubles(&e->pool, (size_t)s->inequalities);
  m->row_weight = ambulo__pool_doubles(&e->pool, (size_t)s->problem->rows);
  e->polished = ambulo__pool_doubles(&e->pool, (size_t)s->n);
  return e->pool.failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

static ambulo_status create_matrices(ambulo__engine *e) {
  const ambulo_problem *p = e->setup->problem;
  ambulo__linearized *at = &e->linearized;
  int kd = ambulo__metric_diagonals(p);
  at->filled_at = ambulo__pool_doubles(&e->pool, (size_t)p->variables);
  at->filled_mu = -1.0;
  if (!at->filled_at) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__metric_create(p, &e->pool, &at->metric);
  if (!status) status = ambulo__band_create(&e->pool, p->variables, kd, &at->base);
  if (!status) status = ambulo__band_create(&e->pool, p->variables, kd, &at->whitener);
  if (status) return status;
  return ambulo__kkt_create(&at->rows.equality, &at->rows.border, kd, &e->pool, &at->kkt);
}

/* what each module works with */
static ambulo_status create_parts(ambulo__engine *e) {
  const ambulo__setup *s = e->setup;
  ambulo_status status = create_iterate(e);
  if (!status) status = create_measured(e);
  if (!status) status = create_matrices(e);
  if (!status) status = ambulo__quadratic_create(e);
  if (!status) status = ambulo__retraction_create(e);
  if (!status) status = ambulo__last_point_create(e);
  if (status) return status;
  return ambulo__trial_create(s->n, s->inequalities, s->equalities, &e->pool, &e->reached);
}

/* sizes and roles of the rows, at zero or at the start: *at */
static ambulo_status classify(ambulo__engine *e, ambulo__run *polled, const double **at,
                              ambulo_diagnostics *diagnostics, ambulo__setup *s) {
  const ambulo_problem *p = s->problem;
  ambulo__row_roles *rows = &e->linearized.rows;
  ambulo__pool *pool = &e->pool;
  s->negligible_term = ambulo__pool_doubles(pool, (size_t)p->definition.term_count);
  s->cap = ambulo__pool_doubles(pool, (size_t)p->coordinates);
  e->iterate.x = ambulo__pool_doubles(pool, (size_t)p->variables);
  if (pool->failed) return AMBULO_E_MEMORY;
  if (ambulo__evaluate(e->workspace, e->iterate.x) == AMBULO_OK) *at = e->iterate.x; /* zero */
  ambulo_status status =
      ambulo__row_roles_create(p, e->workspace, *at, polled, pool, diagnostics, rows);
  if (status) return status;
  s->rows = rows;
  s->n = p->variables;
  s->equalities = rows->equality.count;
  s->inequalities = rows->inequality.count;
  s->borders = rows->border.count;
  for (int i = 0; i < p->coordinates; i++) s->cap[i] = cap_of(p, i);
  return AMBULO_OK;
}

/* the set-up is written here, and by nobody else */
static ambulo_status set_up(ambulo__engine *e, const ambulo_problem *problem, ambulo__run *polled,
                            const double *start, ambulo_diagnostics *diagnostics) {
  ambulo__setup *s = ambulo__pool_blocks(&e->pool, 1, sizeof *s);
  if (!s) return AMBULO_E_MEMORY;
  s->problem = problem;
  e->setup = s;
  ambulo_status status = classify(e, polled, &start, diagnostics, s);
  if (!status) status = create_parts(e);
  if (status) return status;
  s->objective_scale = ambulo__metric_objective_scale(&e->linearized.metric, e->workspace);
  if (s->objective_scale == 0.0) s->objective_scale = scale_by_gradient(e, start);
  s->negligible = negligible_objective(e, e->iterate.x, s); /* zero so far */
  return AMBULO_OK;
}

ambulo_status ambulo__engine_create(const ambulo_problem *problem, const double *start,
                                    const ambulo_allocator *allocator, ambulo__run *run,
                                    ambulo_diagnostics *diagnostics, ambulo__engine **engine) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__engine *e = ambulo__alloc(&own, 1, sizeof *e);
  if (!e) return AMBULO_E_MEMORY;
  ambulo__pool_init(&e->pool, &own);
  e->run = run;
  ambulo_status status = ambulo_workspace_create(problem, &own, &e->workspace);
  if (!status) ambulo__row_roles_set_far(e->workspace, start);
  if (!status) status = set_up(e, problem, run, start, diagnostics);
  if (status) {
    ambulo__engine_free(e);
    return status;
  }
  *engine = e;
  return AMBULO_OK;
}

ambulo_status ambulo__engine_renew(ambulo__engine *e, const double *start) {
  const ambulo_problem *problem = e->setup->problem;
  ambulo_allocator allocator = e->pool.allocator;
  ambulo_workspace *workspace = e->workspace;
  ambulo__run *run = e->run;
  ambulo__pool_clear(&e->pool);
  memset(e, 0, sizeof *e);
  ambulo__pool_init(&e->pool, &allocator);
  e->workspace = workspace;
  e->run = run;
  workspace->has_values = workspace->has_jacobian = 0;
  return set_up(e, problem, NULL, start, NULL); /* not to be stopped half-way */
}

void ambulo__engine_free(ambulo__engine *e) {
  if (!e) return;
  ambulo_allocator a = e->pool.allocator;
  if (e->workspace && e->run) e->run->seconds_evaluate += e->workspace->seconds_evaluate;
  ambulo_workspace_free(e->workspace);
  ambulo__pool_clear(&e->pool);
  ambulo__free(&a, e);
}
