/* solver/pipeline.c - the method on one grid: restore, then refresh and minimize in turn.
 *
 *     mu = mu_0 T/K, rho = 10, lambda = 0; rho = 3000 where the start nearly satisfies the rows: a
 *     weaker penalty would let go of them, and the solve would wander off into another valley
 *     restore
 *     repeat
 *         model step d, metric L L'                            (model_step.c)
 *         t = min(1, 0.5 rad / largest change); F(t L'd) until it descends, t <- 0.4 t
 *         NLopt from there, a few evaluations of F             (inner.c, augmented.c)
 *         mu halved when F fell by more than 1.5 times what the model said (it is too stiff),
 *         doubled when the step brought less than a tenth of it
 *         lambda <- max(0, lambda + rho v)
 *         rho <- min(3000, 2 rho) when max |max(v, -lambda/rho)| did not halve; a stall
 *         at the bound raises the bound tenfold, twice at most
 *     until f has settled, the reduced gradient is small, and v <= tolerance, or small enough
 *     for a few Newton steps on the rows                   (polish.c); f has also settled
 *     when it has fallen to a thousandth of its first value and is negligible (engine.c). At most
 * options->maximum_iterations refreshes; run->ending says which of these ended the loop
 *
 * Equalities hold all along: every point is a retracted one.
 */
#include "solver/engine.h"
#include "base/worst.h"

#include <math.h>
#include <string.h>

enum {
  INNER_EVALUATIONS = 8,
  MAX_BACKTRACKS = 6,
  MAX_DAMPINGS = 6,
  STALL = 15,
  LONG_SETTLED = 3 /* refreshes without a change end a solve whose gradient is not small */
};
/* mu_0. Central differences want less: with 0.3 they take two to three times the refreshes at
 * N = 12, for a minimum that is lower by a tenth. */
static const double mu_start = 0.3, mu_start_differences = 0.06;
static const double mu_least = 0.03, mu_largest = 3.0; /* times mu_0 T/K */
static const double rho_start = 10.0, rho_largest = 3000.0, rho_factor = 2.0;
static const double rho_last = 3e5; /* when the rows do not give way */
static const double step_cap = 0.5; /* rad, m */
static const double restored = 1e-6;
static const double value_change = 1e-5; /* relative */
static const double value_floor = 1e-9;  /* scaled objective */
static const double vanished = 1e-3;     /* of the first f: an objective that goes to zero */
static const double nothing = 1e-6; /* of f for the motionless body: the same, of terms without a
                                       measure of their own (engine.c) */
static const double moving = 1e-3;  /* relative change of f that is progress */
static const double gradient_small = 1e-4;
static const double polishable = 1e-5;   /* excess, row's own unit */
static const double polish_reach = 1e-2; /* the same, when nothing else helps */
static const double loose_violation = 1e-3, loose_change = 1e-3; /* on coarse grids */

typedef struct progress {
  double objective, measure, least_violation;
  int settled, since_better, loose, refreshes;
  double rho_limit;
  double first;   /* f after the first refresh */
  double damping; /* mu at the beginning */
} progress;

/* F before the step, after it, and what the model made of it (<= 0) */
typedef struct descent {
  double start, searched, predicted;
} descent;

/* largest |max(v, -lambda / rho)|: infeasibility and complementarity in one */
static double measure(const ambulo__engine *e, const double *excess) {
  double worst = 0.0;
  for (int i = 0; i < e->inequalities; i++)
    worst = ambulo__worse(worst, fabs(ambulo__worse(excess[i], -e->lambda[i] / e->rho)));
  return worst;
}

/* the model step, mu raised until it can be factored; why it could not be, or none */
static ambulo_ending model(ambulo__engine *e, double *predicted) {
  for (int trial = 0; trial < MAX_DAMPINGS; trial++) {
    int failed = ambulo__model_step(e, predicted);
    if (failed == 0) return AMBULO_ENDING_NONE;
    if (failed == 2) return AMBULO_ENDING_NOT_FINITE;
    e->mu *= 10.0;
  }
  return AMBULO_ENDING_BREAKDOWN;
}

/* w = t L'd with the first t that descends; zero when none does */
static void line_search(ambulo__engine *e, descent *d, double *w) {
  size_t n = (size_t)e->n;
  double t = ambulo__engine_step_limit(e, e->total, step_cap);
  e->has_held = 0;
  e->ceiling = -HUGE_VAL;
  memset(w, 0, n * sizeof *w);
  d->start = d->searched = ambulo__augmented(e, w, NULL);
  if (!(e->held.value < HUGE_VAL)) d->start = d->searched = HUGE_VAL;
  ambulo__band_upper_multiply(&e->whitener, e->total);
  for (int trial = 0; trial < MAX_BACKTRACKS; trial++) {
    for (size_t j = 0; j < n; j++) w[j] = t * e->total[j];
    double f = ambulo__augmented(e, w, NULL);
    double enough = d->start + 1e-4 * t * d->predicted + 1e-12 * fabs(d->start);
    if (e->held.value < HUGE_VAL && (f <= enough || isinf(d->start))) {
      d->searched = f;
      return;
    }
    t *= 0.4;
  }
  memset(w, 0, n * sizeof *w);
}

/* how well the model foretold the descent says whether it is damped too much */
static void update_damping(ambulo__engine *e, const progress *p, const descent *d) {
  double promised = fmin(d->predicted, -1e-14);
  double by_step = (d->searched - d->start) / promised;
  double in_all = (e->best.value - d->start) / promised;
  if (in_all > 1.5 && by_step > 0.5) e->mu = fmax(mu_least * p->damping, 0.5 * e->mu);
  if (by_step < 0.1) e->mu = fmax(e->mu, fmin(mu_largest * p->damping, 2.0 * e->mu));
}

static void update_multipliers(ambulo__engine *e, progress *p) {
  double now = measure(e, e->best.excess);
  memcpy(e->lambda, e->best.multiplier, (size_t)e->inequalities * sizeof *e->lambda);
  memcpy(e->equality_multiplier, e->best.equality_multiplier,
         (size_t)e->equalities * sizeof *e->equality_multiplier);
  if (now > 0.5 * p->measure && now > 1e-7 && e->rho < p->rho_limit)
    e->rho = fmin(p->rho_limit, rho_factor * e->rho);
  p->measure = now;
}

/* Relative tests never end a solve whose objective goes to zero (nodes whose forces can all
 * vanish): then its size counts, beside that of the motionless body. */
static int has_vanished(const ambulo__engine *e, const progress *p) {
  double objective = fabs(e->best.objective); /* terms of the caller may be negative */
  if (e->negligible < 0.0) return objective <= nothing * e->objective_scale * e->at_rest;
  return objective <= vanished * p->first && objective <= e->objective_scale * e->negligible;
}

/* Follows the best point; why the loop is to end, or none. */
static ambulo_ending finished(ambulo__engine *e, progress *p, double *x) {
  const ambulo__trial *best = &e->best;
  double change = fabs(best->objective - p->objective), violation = best->violation;
  double tolerance = p->loose ? loose_violation : e->run->options->feasibility_tolerance;
  double relative = p->loose ? loose_change : value_change;
  int steady = change <= fmax(relative * fabs(best->objective), value_floor);
  int small = best->gradient_norm <= gradient_small * fmax(1.0, fabs(best->objective));
  int near = violation <= fmax(tolerance, polishable);
  p->settled = near && steady ? p->settled + 1 : 0;
  if (p->refreshes++ == 0) p->first = fabs(best->objective);
  p->objective = best->objective;
  p->since_better++;
  if (violation < 0.9 * p->least_violation || change > moving * fabs(best->objective))
    p->since_better = 0;
  p->least_violation = fmin(p->least_violation, violation);
  int stalled = e->rho >= p->rho_limit && p->since_better > STALL;
  ambulo_ending settled = AMBULO_ENDING_NONE;
  if (p->settled >= 1 && (small || p->loose)) {
    settled = AMBULO_ENDING_CONVERGED;
  } else if (near && has_vanished(e, p)) {
    settled = AMBULO_ENDING_VANISHED;
  } else if (p->settled >= LONG_SETTLED) {
    settled = AMBULO_ENDING_SETTLED;
  }
  if (violation <= tolerance) return settled;
  if (!settled && !stalled) return AMBULO_ENDING_NONE;
  if (violation <= polish_reach && ambulo__polish(e, x))
    return settled ? settled : AMBULO_ENDING_STALLED;
  if (!stalled) return AMBULO_ENDING_NONE;
  if (p->rho_limit >= rho_last) return AMBULO_ENDING_STALLED;
  p->rho_limit *= 10.0;
  p->since_better = 0;
  return AMBULO_ENDING_NONE;
}

/* one refresh; *ending: why there is nothing more to do, or none. E_MEMORY. */
static ambulo_status refresh(ambulo__engine *e, ambulo__inner_kind kind, progress *p, double *w,
                             double *x, ambulo_ending *ending) {
  descent d;
  memcpy(e->center, x, (size_t)e->n * sizeof *x);
  *ending = model(e, &d.predicted);
  if (*ending) return AMBULO_OK;
  e->best.value = HUGE_VAL;
  line_search(e, &d, w);
  ambulo_status status = ambulo__inner_minimize(e, kind, w, INNER_EVALUATIONS);
  if (status) return status;
  if (!(e->best.value < HUGE_VAL)) {
    *ending = AMBULO_ENDING_NO_DESCENT;
    return AMBULO_OK;
  }
  ambulo__run_forgive(e->run);
  memcpy(x, e->best.x, (size_t)e->n * sizeof *x);
  update_damping(e, p, &d);
  update_multipliers(e, p);
  e->run->iterations++;
  int stop =
      ambulo__run_progress(e->run, e->best.objective / e->objective_scale, e->best.violation);
  *ending = finished(e, p, x);
  if (!*ending && stop) *ending = AMBULO_ENDING_CALLER;
  return AMBULO_OK;
}

/* restores, then refreshes until something ends it */
static ambulo_status iterate(ambulo__engine *e, ambulo__inner_kind kind, progress *p, double *x,
                             ambulo_ending *ending) {
  double error;
  ambulo_status status = ambulo__restore(e, x, &error);
  if (status || !(error <= restored)) {
    *ending = status == AMBULO_E_NUMERIC ? AMBULO_ENDING_NOT_FINITE : AMBULO_ENDING_NOT_RESTORED;
    return status;
  }
  for (int k = 0; !status && !*ending && !ambulo__run_over(e->run); k++) {
    if (k == e->run->options->maximum_iterations) {
      *ending = AMBULO_ENDING_ITERATIONS;
    } else {
      status = refresh(e, kind, p, e->iterate, x, ending);
    }
  }
  return status;
}

ambulo_status ambulo__pipeline(ambulo__engine *e, ambulo__inner_kind kind, ambulo__stage stage,
                               double *x) {
  const ambulo_problem *p = e->problem;
  int loose = stage == AMBULO__COARSE;
  double interval = p->definition.duration / (double)ambulo__basis_intervals(p->basis);
  progress state = {.objective = HUGE_VAL,
                    .measure = HUGE_VAL,
                    .least_violation = HUGE_VAL,
                    .loose = loose,
                    .rho_limit = rho_largest};
  ambulo_ending ending = AMBULO_ENDING_NONE;
  int differences = p->definition.discretization == AMBULO_CENTRAL_DIFFERENCE;
  e->mu = state.damping = (differences ? mu_start_differences : mu_start) * interval;
  e->rho = stage == AMBULO__NEAR ? rho_largest : rho_start;
  e->best.value = HUGE_VAL;
  memset(e->lambda, 0, (size_t)e->inequalities * sizeof *e->lambda);
  memset(e->equality_multiplier, 0, (size_t)e->equalities * sizeof *e->equality_multiplier);
  ambulo_status status = iterate(e, kind, &state, x, &ending);
  int cut = e->run->stopped || ending == AMBULO_ENDING_ITERATIONS;
  /* out of iterations or of time: what can still be had at once */
  if (!status && cut && !loose && e->best.value < HUGE_VAL && e->best.violation <= polish_reach)
    (void)ambulo__polish(e, x);
  if (ending) ambulo__run_end(e->run, ending);
  return status;
}
