/* method/stopping.c - see pipeline.h */
#include "method/pipeline.h"

#include "method/equalities.h"
#include "method/model_step.h"
#include "method/parameters.h"
#include "method/point.h"

#include <math.h>
#include <string.h>

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
  s->still = change == 0.0 && violation == s->violation ? s->still + 1 : 0;
  s->violation = violation;
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
  s->since_better = s->since_halved = s->still = 0;
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
  int stalled = bound && (s->since_better > AMBULO__STALL || s->still >= AMBULO__PATIENCE);
  double reach = stalled ? AMBULO__ROUGH_VIOLATION : AMBULO__NEAR_VIOLATION;
  int fresh = stalled || s->still == 0; /* a point that stays was polished */
  if ((settled || stalled) && violation <= reach && fresh && ambulo__polish(e, stalled, x))
    return settled ? settled : AMBULO_ENDING_STALLED;
  int slow = stalled || (bound && s->since_halved > AMBULO__STALL);
  return slow && raise_limit(s) && stalled ? AMBULO_ENDING_STALLED : AMBULO_ENDING_NONE;
}

void ambulo__stopping_cut(const ambulo__stopping *s, ambulo__engine *e, double *x) {
  if (s->loose || !(e->reached.value < HUGE_VAL) || e->reached.violation > AMBULO__ROUGH_VIOLATION)
    return;
  (void)ambulo__polish(e, 1, x);
}

/* the last micrometres.
 *
 * An augmented Lagrangian approaches the inequalities linearly, and slowly where active rows
 * nearly depend on each other. Once the objective has settled and the excesses are small,
 * the nearest point of the linearized feasible set
 *
 *     minimize d' H0 d / 2   subject to   J_e d = 0, C d = 0, v + J d <= 0,
 *                                         = 0 where the multiplier is positive
 *
 * is a few Newton steps from a feasible point; the objective moves by multiplier * excess.
 * Solved by the model of model_step.c with a large penalty, the multipliers, and an
 * objective gradient - J' lambda that balances them: rows with a force then pull both ways. The
 * penalty is relative to what the metric opposes to each row: on fine grids rows on accelerations
 * are so much longer than rows on places that a common one either lets go of these or drowns the
 * metric in the rounding of its factor.
 */

/* Row i, its excess and multiplier with `factor` times the scale that they have in the solve. */
static void rescale(ambulo__engine *e, int i, double factor) {
  ambulo__sparse_rows *rows = &e->linearized.rows.inequality;
  double scale = -factor / e->setup->rows->size[i], change = scale / rows->scale[i];
  ambulo__sparse_rows_set_scale(rows, i, scale);
  e->quadratic->linear[i] *= change;
  e->iterate.lambda[i] /= change;
}

/* Rows of length 1 in the diagonal D of the metric, J D^-1 J' = 1: one penalty is then as good as
 * equality for all of them on every grid, and drowns the metric on none. */
static void normalize(ambulo__engine *e) {
  const ambulo__linearized *at = &e->linearized;
  for (int i = 0; i < e->setup->inequalities; i++) {
    double length = ambulo__band_row_length(&at->base, &at->rows.inequality, i);
    if (length > 0.0) rescale(e, i, 1.0 / length);
  }
}

/* one step from the iterate, whose excesses are in the model, to x; 0 on success */
static int step(ambulo__engine *e, double rho, double *x) {
  ambulo__linearized *at = &e->linearized;
  ambulo__quadratic *q = e->quadratic;
  double decrease;
  if (ambulo__sparse_rows_fill(&at->rows.equality, e->workspace, 0) ||
      ambulo__sparse_rows_fill(&at->rows.inequality, e->workspace, 0))
    return 1;
  if (ambulo__engine_fill_metric(e, AMBULO__POLISH_DAMPING * e->iterate.mu)) return 1;
  memset(q->gradient, 0, (size_t)e->setup->n * sizeof *q->gradient);
  ambulo__sparse_rows_add_transpose(&at->rows.inequality, -1.0, e->iterate.lambda, q->gradient);
  normalize(e);
  int failed = ambulo__model_minimize(e, rho, 0, &decrease);
  for (int i = 0; i < e->setup->inequalities; i++) rescale(e, i, 1.0);
  if (failed) return 1;
  for (int j = 0; j < e->setup->n; j++) x[j] = e->iterate.x[j] + q->total[j];
  return !ambulo__retract(e, x);
}

/* whether the point in the workspace costs more than the rows' multipliers predicted */
static int costs_more(const ambulo__engine *e) {
  const ambulo__trial *from = &e->reached;
  double predicted = AMBULO__VALUE_CHANGE * fabs(from->objective);
  for (int i = 0; i < e->setup->inequalities; i++)
    predicted += AMBULO__POLISH_RISE * from->multiplier[i] * fabs(from->excess[i]);
  return e->setup->objective_scale * e->workspace->objective - from->objective > predicted;
}

int ambulo__polish(ambulo__engine *e, int anyhow, double *x) {
  const ambulo__setup *s = e->setup;
  ambulo__iterate *iterate = &e->iterate;
  double *moved = e->polished, begin = ambulo__seconds_now();
  double target = e->run->options->feasibility_tolerance;
  size_t bytes = (size_t)s->n * sizeof *x;
  int done = 0;
  double rho = AMBULO__POLISH_PENALTY;
  memcpy(moved, x, bytes);
  for (int k = 0; k < AMBULO__POLISH_STEPS && !done; k++) {
    memcpy(iterate->x, moved, bytes);
    memcpy(iterate->lambda, e->reached.multiplier,
           (size_t)s->inequalities * sizeof *iterate->lambda);
    if (ambulo__evaluate_jacobian(e->workspace, iterate->x)) break;
    double worst = ambulo__engine_excess(e, e->quadratic->linear);
    done = worst <= target;
    if (done ? !anyhow && costs_more(e) : step(e, rho, moved)) {
      done = 0;
      break;
    }
    rho *= AMBULO__PENALTY_STEP;
  }
  memcpy(iterate->equality_multiplier, e->reached.equality_multiplier,
         (size_t)s->equalities * sizeof *iterate->equality_multiplier);
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  if (done) memcpy(x, iterate->x, bytes);
  return done;
}
