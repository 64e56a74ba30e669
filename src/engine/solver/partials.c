/* solver/partials.c - see partials.h. */
#include "solver/partials.h"

#include "problem/nlp.h"

ambulo_status ambulo__partials_create(const ambulo_problem *problem, ambulo__pool *pool,
                                      ambulo__partials *partials) {
  const ambulo_problem_definition *d = &problem->definition;
  size_t n = (size_t)problem->coordinates, terms = (size_t)d->term_count;
  *partials = (ambulo__partials){.place = ambulo__pool_doubles(pool, 2 * (size_t)d->contact_count)};
  partials->rise = ambulo__pool_doubles(pool, (size_t)d->contact_count);
  partials->heading = ambulo__pool_doubles(pool, (size_t)d->contact_count);
  partials->normal = ambulo__pool_doubles(pool, 3 * (size_t)d->contact_count);
  partials->limit = ambulo__pool_doubles(pool, 6 * n);
  partials->end_value = ambulo__pool_doubles(pool, (size_t)d->end_value_count);
  partials->half_width = ambulo__pool_doubles(pool, (size_t)d->tube_count * n);
  partials->weight = ambulo__pool_doubles(pool, terms);
  partials->height = ambulo__pool_doubles(pool, terms);
  partials->scale = ambulo__pool_doubles(pool, terms * n);
  partials->offset = ambulo__pool_doubles(pool, terms * n);
  partials->strength = ambulo__pool_doubles(pool, 2 * terms * n);
  partials->tendon = ambulo__pool_doubles(pool, terms * n);
  partials->price = ambulo__pool_doubles(pool, 2 * terms * n);
  partials->device = ambulo__pool_doubles(pool, (size_t)d->device_count * AMBULO__DEVICE_NUMBERS);
  partials->hold = ambulo__pool_doubles(pool, (size_t)d->hold_count * AMBULO__HOLD_NUMBERS);
  partials->node_time = ambulo__pool_doubles(pool, (size_t)problem->nodes);
  partials->contact_time = ambulo__pool_doubles(pool, 2 * (size_t)d->contact_count);
  partials->obstacle_margin = ambulo__pool_doubles(pool, (size_t)d->obstacle_count);
  partials->obstacle_place = ambulo__pool_doubles(pool, 6 * (size_t)d->obstacle_count);
  partials->reach_place = ambulo__pool_doubles(pool, 3 * (size_t)d->reach_count);
  partials->reach_tolerance = ambulo__pool_doubles(pool, (size_t)d->reach_count);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* dL/dy of every channel; what stands on unknowns goes to the gradient, which nobody asks for */
static ambulo_status take_adjoints(const ambulo__stationary *s, ambulo__pool *pool) {
  const ambulo_problem *p = s->problem;
  double *weights = ambulo__pool_doubles(pool, (size_t)p->rows);
  double *gradient = ambulo__pool_doubles(pool, (size_t)p->variables);
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int r = 0; r < p->rows; r++) weights[r] = -s->multiplier[r];
  ambulo__adjoint_clear(s->workspace, gradient);
  for (int t = 0; t < p->definition.term_count; t++) ambulo__adjoint_term(s->workspace, t, 1.0);
  ambulo__adjoint_rows(s->workspace, weights, gradient);
  return AMBULO_OK;
}

/* (S.1) dL/dp = df/dp - sum lambda dc/dp + sum w dy/dp */
ambulo_status ambulo__partials_at(const ambulo_problem *problem, ambulo_workspace *workspace,
                                  const double *x, const double *multiplier, ambulo__pool *pool,
                                  ambulo__partials *partials) {
  const ambulo__stationary s = {problem, workspace, multiplier};
  ambulo_status status = ambulo__partials_create(problem, pool, partials);
  if (!status) status = ambulo__evaluate(workspace, x);
  if (status) return status;
  ambulo__partials_of_places(&s, partials);
  ambulo__partials_of_bounds(&s, partials);
  ambulo__partials_of_bodies(&s, partials);
  ambulo__partials_of_terms(&s, partials);
  status = ambulo__partials_of_forces(&s, partials);
  if (!status) status = take_adjoints(&s, pool);
  if (!status) status = ambulo__partials_of_devices(&s, pool, partials);
  if (!status) status = ambulo__partials_of_holds(&s, pool, partials);
  if (!status) status = ambulo__partials_of_inertia(&s, pool, partials);
  if (!status) ambulo__partials_of_duration(&s, partials);
  if (!status) status = ambulo__partials_of_events(&s, pool, partials);
  return status;
}
