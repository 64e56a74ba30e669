/* solver/candidates.c - see candidates.h. */
#include "solver/candidates.h"
#include "base/arithmetic.h"
#include "method/point.h"

#include <math.h>
#include <string.h>

/* relative change of the objective that rows which hold better may cost beside the start */
static const double start_advantage = 1e-6;

static ambulo_status create_one(ambulo__candidate *c, ambulo__engine *e) {
  c->x = ambulo__pool_doubles(&e->pool, (size_t)e->setup->n);
  c->violation = c->objective = HUGE_VAL;
  return c->x ? AMBULO_OK : AMBULO_E_MEMORY;
}

ambulo_status ambulo__candidates_create(ambulo__candidates *c, ambulo__engine *e) {
  c->n = e->setup->n;
  c->tolerance = e->run->options->feasibility_tolerance;
  ambulo_status status = create_one(&c->start, e);
  return status ? status : create_one(&c->found, e);
}

double ambulo__violation_at(ambulo__engine *e, const double *x) {
  if (ambulo__evaluate(e->workspace, x)) return HUGE_VAL;
  double error = ambulo__engine_equality_error(e);
  return ambulo__worse(error, ambulo__engine_excess(e, e->measured.excess));
}

/* x is one point of several, measured at the workspace */
static void keep(ambulo__candidate *c, const ambulo__engine *e, const double *x, double violation) {
  memcpy(c->x, x, (size_t)e->setup->n * sizeof *x);
  c->violation = violation;
  c->objective = e->workspace->objective;
}

void ambulo__candidates_offer_start(ambulo__candidates *c, ambulo__engine *e, const double *x) {
  double violation = ambulo__violation_at(e, x);
  if (violation < HUGE_VAL) keep(&c->start, e, x, violation);
}

void ambulo__candidates_offer(ambulo__candidates *c, ambulo__engine *e, const double *x) {
  double violation = ambulo__violation_at(e, x), objective = e->workspace->objective;
  int valid = violation <= c->tolerance, was = c->found.violation <= c->tolerance;
  if (!(violation < HUGE_VAL)) return;
  if (valid && was ? objective < c->found.objective : violation < c->found.violation)
    keep(&c->found, e, x, violation);
}

int ambulo__candidates_solved(const ambulo__candidates *c) {
  return c->found.violation <= c->tolerance;
}

int ambulo__candidates_take(const ambulo__candidates *c, double *x) {
  const ambulo__candidate *start = &c->start, *found = &c->found;
  double slack = start_advantage * fabs(start->objective);
  int valid = start->violation <= c->tolerance;
  if (start->violation <= found->violation) slack = 0.0;
  int start_wins =
      valid && (!ambulo__candidates_solved(c) || start->objective < found->objective - slack);
  const ambulo__candidate *best = start_wins ? start : found;
  if (best->violation < HUGE_VAL) memcpy(x, best->x, (size_t)c->n * sizeof *x);
  return start_wins;
}
