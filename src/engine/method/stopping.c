/* method/stopping.c - see stopping.h */
#include "method/stopping.h"
#include "method/parameters.h"
#include "method/polish.h"

#include <math.h>

ambulo__stopping ambulo__stopping_begin(int loose) {
  return (ambulo__stopping){.loose = loose,
                            .objective = HUGE_VAL,
                            .least_violation = HUGE_VAL,
                            .halved = HUGE_VAL,
                            .penalty_limit = AMBULO__PENALTY_LIMIT};
}

static int has_vanished(const ambulo__engine *e, const ambulo__stopping *s) {
  double objective = fabs(e->reached.objective); /* terms of the caller may be negative */
  if (e->setup->negligible < 0.0)
    return objective <= AMBULO__VANISHED_AT_REST * e->setup->objective_scale * e->setup->at_rest;
  return objective <= AMBULO__VANISHED * s->first &&
         objective <= e->setup->objective_scale * e->setup->negligible;
}

/* follows the point; whether its objective has settled, and how */
static ambulo_ending settle(ambulo__stopping *s, const ambulo__engine *e, double tolerance) {
  const ambulo_options *o = e->run->options;
  const ambulo__trial *point = &e->reached;
  double change = fabs(point->objective - s->objective), violation = point->violation;
  double relative = s->loose ? AMBULO__COARSE_CHANGE : AMBULO__VALUE_CHANGE;
  int steady = change <= relative * fabs(point->objective);
  double enough =
      s->loose ? AMBULO__COARSE_GRADIENT : AMBULO__GRADIENT_SMALL * o->optimality_tolerance;
  int small = point->gradient_norm <= enough * fmax(1.0, fabs(point->objective));
  int near = violation <= fmax(tolerance, AMBULO__NEAR_VIOLATION);
  s->settled = near && steady ? s->settled + 1 : 0;
  if (s->points++ == 0) s->first = fabs(point->objective);
  s->objective = point->objective;
  s->since_better++;
  if (violation < AMBULO__VIOLATION_BETTER * s->least_violation ||
      change > AMBULO__VALUE_MOVING * fabs(point->objective))
    s->since_better = 0;
  s->least_violation = fmin(s->least_violation, violation);
  s->since_halved++;
  if (violation < 0.5 * s->halved) {
    s->halved = violation;
    s->since_halved = 0;
  }
  if (s->settled >= 1 && small) return AMBULO_ENDING_CONVERGED;
  if (has_vanished(e, s)) return AMBULO_ENDING_VANISHED;
  return s->settled >= AMBULO__PATIENCE ? AMBULO_ENDING_SETTLED : AMBULO_ENDING_NONE;
}

/* at the bound of the penalty, and the rows do not give way: a higher bound; 1 when there is none
 */
static int raise_limit(ambulo__stopping *s) {
  if (s->penalty_limit >= AMBULO__PENALTY_LAST) return 1;
  s->penalty_limit *= AMBULO__PENALTY_STEP;
  s->since_better = s->since_halved = 0;
  return 0;
}

ambulo_ending ambulo__stopping_test(ambulo__stopping *s, ambulo__engine *e, double *x) {
  double tolerance = s->loose ? AMBULO__ROUGH_VIOLATION : e->run->options->feasibility_tolerance;
  ambulo_ending settled = settle(s, e, tolerance);
  double violation = e->reached.violation;
  int bound = e->iterate.rho >= 0.999 * s->penalty_limit;
  if (violation <= tolerance) return settled;
  if (s->loose) {
    int idle = s->since_better > s->since_halved ? s->since_better : s->since_halved;
    return bound && idle > AMBULO__PATIENCE ? AMBULO_ENDING_STALLED : AMBULO_ENDING_NONE;
  }
  int stalled = bound && s->since_better > AMBULO__STALL;
  double reach = stalled ? AMBULO__ROUGH_VIOLATION : AMBULO__NEAR_VIOLATION;
  if ((settled || stalled) && violation <= reach && ambulo__polish(e, stalled, x))
    return settled ? settled : AMBULO_ENDING_STALLED;
  int slow = stalled || (bound && s->since_halved > AMBULO__STALL);
  return slow && raise_limit(s) && stalled ? AMBULO_ENDING_STALLED : AMBULO_ENDING_NONE;
}

void ambulo__stopping_cut(const ambulo__stopping *s, ambulo__engine *e, double *x) {
  if (s->loose || !(e->reached.value < HUGE_VAL) || e->reached.violation > AMBULO__ROUGH_VIOLATION)
    return;
  (void)ambulo__polish(e, 1, x);
}
