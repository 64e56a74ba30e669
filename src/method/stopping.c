/* method/stopping.c - see stopping.h */
#include "method/stopping.h"

#include <math.h>

enum {
  STALL = 15,      /* points without progress */
  LONG_SETTLED = 3 /* points without a change end a solve whose gradient is not small */
};
static const double value_change = 1e-5; /* relative */
static const double value_floor = 1e-9;  /* scaled objective */
static const double vanished = 1e-3;     /* of the first f: an objective that goes to zero */
static const double nothing = 1e-6;      /* of f for the motionless body: the same, of terms without
                                            a measure of their own (engine.c) */
static const double moving = 1e-3;       /* relative change of f that is progress */
static const double gradient_small = 3e-5;
static const double polishable = 1e-5;    /* violation, relative to the sizes of the rows */
static const double polish_reach = 1e-5;  /* the same, where polishing may start */
static const double stalled_reach = 1e-2; /* the same, where nothing else helps */
static const double loose_violation = 1e-2, loose_change = 1e-2; /* on coarse grids */
static const double penalty_largest = 3000.0, penalty_last = 3e5;

ambulo__stopping ambulo__stopping_begin(int loose) {
  return (ambulo__stopping){.loose = loose,
                            .objective = HUGE_VAL,
                            .least_violation = HUGE_VAL,
                            .halved = HUGE_VAL,
                            .penalty_limit = penalty_largest};
}

static int has_vanished(const ambulo__engine *e, const ambulo__stopping *s) {
  double objective = fabs(e->reached.objective); /* terms of the caller may be negative */
  if (e->negligible < 0.0) return objective <= nothing * e->objective_scale * e->at_rest;
  return objective <= vanished * s->first && objective <= e->objective_scale * e->negligible;
}

/* follows the point; whether its objective has settled, and how */
static ambulo_ending settle(ambulo__stopping *s, const ambulo__engine *e, double tolerance) {
  const ambulo__trial *point = &e->reached;
  double change = fabs(point->objective - s->objective), violation = point->violation;
  double relative = s->loose ? loose_change : value_change;
  int steady = change <= fmax(relative * fabs(point->objective), value_floor);
  int small = point->gradient_norm <= gradient_small * fmax(1.0, fabs(point->objective));
  int near = violation <= fmax(tolerance, polishable);
  s->settled = near && steady ? s->settled + 1 : 0;
  if (s->points++ == 0) s->first = fabs(point->objective);
  s->objective = point->objective;
  s->since_better++;
  if (violation < 0.9 * s->least_violation || change > moving * fabs(point->objective))
    s->since_better = 0;
  s->least_violation = fmin(s->least_violation, violation);
  s->since_halved++;
  if (violation < 0.5 * s->halved) {
    s->halved = violation;
    s->since_halved = 0;
  }
  if (s->settled >= 1 && (small || s->loose)) return AMBULO_ENDING_CONVERGED;
  if (near && has_vanished(e, s)) return AMBULO_ENDING_VANISHED;
  return s->settled >= LONG_SETTLED ? AMBULO_ENDING_SETTLED : AMBULO_ENDING_NONE;
}

/* at the bound of the penalty, and the rows do not give way: a higher bound; 1 when there is none
 */
static int raise_limit(ambulo__stopping *s) {
  if (s->penalty_limit >= penalty_last) return 1;
  s->penalty_limit *= 10.0;
  s->since_better = s->since_halved = 0;
  return 0;
}

ambulo_ending ambulo__stopping_test(ambulo__stopping *s, ambulo__engine *e, double *x) {
  double tolerance = s->loose ? loose_violation : e->run->options->feasibility_tolerance;
  ambulo_ending settled = settle(s, e, tolerance);
  double violation = e->reached.violation;
  int bound = e->rho >= 0.999 * s->penalty_limit;
  if (violation <= tolerance) return settled;
  int stalled = bound && s->since_better > STALL;
  double reach = stalled ? stalled_reach : polish_reach;
  if ((settled || stalled) && violation <= reach && ambulo__polish(e, x))
    return settled ? settled : AMBULO_ENDING_STALLED;
  int slow = stalled || (bound && s->since_halved > STALL);
  return slow && raise_limit(s) && stalled ? AMBULO_ENDING_STALLED : AMBULO_ENDING_NONE;
}

void ambulo__stopping_cut(const ambulo__stopping *s, ambulo__engine *e, double *x) {
  if (s->loose || !(e->reached.value < HUGE_VAL) || e->reached.violation > stalled_reach) return;
  (void)ambulo__polish(e, x);
}
