/* study/fit_search.c - from the file's parameters to better ones: Levenberg-Marquardt
 * (fit.h).
 *
 * An iteration at u, whose residuals are r:
 *
 *   1. Column i of J is (r(u + h e_i) - r) / h, h = 0.1 (a tenth of a step) toward the file's own
 *      value, or the other way at a bound. All columns are solved at once. Where a condition is
 *      solved at one of the two only, the column is no derivative and becomes 0.
 *   2. NLopt's SLSQP minimizes the model
 *
 *          |r + J d|^2 + (ridge |u + d|^2 + damping trace(J'J) |d|^2) / parameters
 *
 *      within the bounds, |d_i| <= 4, for four dampings. The four u + d are solved at once.
 *      The residual of a guard is 0 while it holds, and its differences do not tell where it
 *      breaks: in the model it is p(v + V d) instead, p being the residual of a guard with the
 *      number v (fit_residual.c) and V the differences of v.
 *   3. The best of all trials is the next u, if it is still better with the solutions that zero
 *      finds there where those are the better ones (refresh). The damping becomes that of the
 *      accepted model; it grows where nothing is better.
 *
 * J of the residuals, and not the gradient of D alone, because J gives the curvature too. SLSQP on
 * D itself, with the same J, ended at a D of 0.076 after 519 solves for 12 prices and phases of
 * models/walk_normal.yaml; this search ends at 0.060 after 147. */
#include "study/fit.h"

#include <math.h>
#include <nlopt.h>
#include <stdio.h>
#include <string.h>

enum { DAMPINGS = 4, MOST_IDLE = 2, MOST_MODEL_EVALUATIONS = 1000 };

static const double difference = 0.1, longest = 4.0; /* of a step, in steps */
static const double damping_start = 0.03, damping_least = 1e-4, damping_most = 2.0;
static const double least_gain = 1e-6, least_distance = 1e-8;

/* a guard of a condition that is solved */
typedef struct guard {
  const ambulo__fit_target *target;
  int condition, row;                          /* of its residual */
  double factor;                               /* of its residual, by the weights */
  double value, slope[AMBULO__FIT_PARAMETERS]; /* v; V, per step */
  double rate;                                 /* of the residual in v, in the model */
} guard;

typedef struct search {
  const ambulo__fit_task *task;
  const ambulo_fit *fit;
  ambulo__fit_trial *best;
  ambulo__fit_trial *trial; /* [parameters + DAMPINGS] differences, then candidates */
  double *jacobian;         /* [parameters][residuals] */
  double *row;              /* [residuals] r + J d */
  guard *guard;             /* [guards] with room for all */
  int guards;
  double trace; /* of J'J */
  double damping, tried[DAMPINGS];
  ambulo__fit_step step;
} search;

/* 1 in *stopped: the caller stopped the run before all were solved */
static ambulo_status evaluate(search *s, ambulo__fit_trial *trials, int count, int *stopped) {
  ambulo_status status = s->task->evaluate(s->task->user, s->best, trials, count);
  for (int i = 0; i < count && !status; i++) {
    if (!trials[i].complete) *stopped = 1;
    trials[i].cost = ambulo__fit_cost(s->fit, &trials[i]);
  }
  return status;
}

/* ------------------------------------------------------------------- Jacobian */

/* the difference of parameter i: toward 0, unless a bound is near */
static double choose_difference(const search *s, int i) {
  double u = s->best->u[i], up = s->fit->parameter[i].upper - u,
         down = u - s->fit->parameter[i].lower;
  int goes_up = u > 0.0 ? down < difference && up > down : up >= difference || up >= down;
  return goes_up ? fmin(difference, up) : -fmin(difference, down);
}

/* the guards of the best trial, without slopes */
static void list_guards(search *s) {
  const ambulo_fit *fit = s->fit;
  s->guards = 0;
  for (int c = 0; c < fit->conditions; c++) {
    const ambulo__fit_condition *condition = &fit->condition[c];
    if (condition->held_out || !s->best->solved[c]) continue;
    for (int k = 0; k < condition->targets; k++) {
      const ambulo__fit_target *t = &condition->target[k];
      const ambulo__fit_curve *curve = &fit->curve[t->curve];
      if (!curve->is_guard) continue;
      guard *g = &s->guard[s->guards++];
      memset(g, 0, sizeof *g);
      g->target = t;
      g->condition = c;
      g->row = condition->first + t->first;
      g->factor = sqrt(condition->weight * curve->weight / fit->weights);
      g->value = s->best->score[c][t->curve].value;
    }
  }
}
/* Returns |column|^2; NaN where it is no derivative. Rows of guards are left to the model. */
static double fill_column(search *s, int i, double h) {
  const ambulo__fit_trial *t = &s->trial[i];
  int residuals = s->fit->residuals, known = 1;
  double *column = s->jacobian + (size_t)i * (size_t)residuals, squares = 0.0;
  for (int c = 0; c < s->fit->conditions; c++)
    known &= t->index[c] < 0 || t->solved[c] == s->best->solved[c];
  for (int k = 0; k < residuals; k++) {
    column[k] = known ? (t->residual[k] - s->best->residual[k]) / h : 0.0;
    squares += column[k] * column[k];
  }
  for (int k = 0; k < s->guards; k++) {
    guard *g = &s->guard[k];
    double value = t->score[g->condition][g->target->curve].value;
    g->slope[i] = known ? (value - g->value) / h : 0.0;
    column[g->row] = 0.0;
  }
  return known ? squares : (double)NAN;
}

static ambulo_status differentiate(search *s, double *sensitivity, int *stopped) {
  int n = s->fit->parameters;
  double h[AMBULO__FIT_PARAMETERS];
  for (int i = 0; i < n; i++) {
    ambulo__fit_trial *t = &s->trial[i];
    h[i] = choose_difference(s, i);
    memcpy(t->u, s->best->u, (size_t)n * sizeof *t->u);
    t->u[i] += h[i];
    (void)snprintf(t->label, sizeof t->label, "parameter %d %s", i + 1, h[i] > 0.0 ? "up" : "down");
  }
  ambulo_status status = evaluate(s, s->trial, n, stopped);
  if (status || *stopped) return status;
  s->trace = 0.0;
  s->step.dropped = 0;
  list_guards(s);
  for (int i = 0; i < n; i++) {
    double squares = fill_column(s, i, h[i]);
    sensitivity[i] = sqrt(squares);
    if (isnan(squares))
      s->step.dropped++;
    else
      s->trace += squares;
  }
  return AMBULO_OK;
}

/* a condition without any solution, here and around; -1: none */
static int find_stuck(const search *s) {
  for (int c = 0; c < s->fit->conditions; c++) {
    int solved = s->best->solved[c] || s->best->index[c] < 0;
    for (int i = 0; i < s->fit->parameters; i++) solved |= s->trial[i].solved[c];
    if (!solved) return c;
  }
  return -1;
}

/* ------------------------------------------------------------------ candidates */

/* rows of guards in the model at d */
static void fill_guards(search *s, const double *d) {
  for (int k = 0; k < s->guards; k++) {
    guard *g = &s->guard[k];
    double value = g->value, slope = 0.0;
    for (int i = 0; i < s->fit->parameters; i++) value += g->slope[i] * d[i];
    s->row[g->row] = g->factor * ambulo__fit_guard(s->fit, g->target, value, &slope);
    g->rate = g->factor * slope;
  }
}

/* the model at d, and its gradient */
static double model(unsigned n, const double *d, double *gradient, void *data) {
  search *s = data;
  size_t residuals = (size_t)s->fit->residuals;
  double ridge = s->fit->ridge / n, damping = s->damping * s->trace / n, value = 0.0;
  memcpy(s->row, s->best->residual, residuals * sizeof *s->row);
  for (unsigned i = 0; i < n; i++)
    for (size_t k = 0; k < residuals; k++) s->row[k] += s->jacobian[i * residuals + k] * d[i];
  fill_guards(s, d);
  for (size_t k = 0; k < residuals; k++) value += s->row[k] * s->row[k];
  for (unsigned i = 0; i < n; i++) {
    double u = s->best->u[i] + d[i], slope = ridge * u + damping * d[i];
    value += ridge * u * u + damping * d[i] * d[i];
    for (size_t k = 0; k < residuals; k++) slope += s->jacobian[i * residuals + k] * s->row[k];
    for (int k = 0; k < s->guards; k++)
      slope += s->guard[k].slope[i] * s->guard[k].rate * s->row[s->guard[k].row];
    if (gradient) gradient[i] = 2.0 * slope;
  }
  return value;
}

/* u [parameters]: the best one and the d of the least model; where NLopt fails, as far as it came
 */
static ambulo_status minimize_model(search *s, double *u) {
  int n = s->fit->parameters;
  const double *from = s->best->u;
  double lower[AMBULO__FIT_PARAMETERS], upper[AMBULO__FIT_PARAMETERS],
      d[AMBULO__FIT_PARAMETERS] = {0.0}, least = 0.0;
  for (int i = 0; i < n; i++) {
    lower[i] = fmin(0.0, fmax(-longest, s->fit->parameter[i].lower - from[i]));
    upper[i] = fmax(0.0, fmin(longest, s->fit->parameter[i].upper - from[i]));
  }
  nlopt_opt opt = nlopt_create(NLOPT_LD_SLSQP, (unsigned)n);
  int failed = !opt || nlopt_set_min_objective(opt, model, s) < 0 ||
               nlopt_set_lower_bounds(opt, lower) < 0 || nlopt_set_upper_bounds(opt, upper) < 0 ||
               nlopt_set_ftol_rel(opt, 1e-10) < 0 ||
               nlopt_set_maxeval(opt, MOST_MODEL_EVALUATIONS) < 0 ||
               nlopt_optimize(opt, d, &least) == NLOPT_OUT_OF_MEMORY;
  nlopt_destroy(opt);
  for (int i = 0; i < n; i++)
    u[i] = fmin(s->fit->parameter[i].upper, fmax(s->fit->parameter[i].lower, from[i] + d[i]));
  return failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

static ambulo_status try_candidates(search *s, int *stopped) {
  static const double factors[DAMPINGS] = {0.2, 1.0, 5.0, 25.0};
  ambulo__fit_trial *candidate = s->trial + s->fit->parameters;
  double damping = s->damping;
  ambulo_status status = AMBULO_OK;
  for (int k = 0; k < DAMPINGS && !status; k++) {
    s->damping = s->tried[k] = factors[k] * damping;
    status = minimize_model(s, candidate[k].u);
    (void)snprintf(candidate[k].label, sizeof candidate[k].label, "damping %.3g", s->damping);
  }
  s->damping = damping;
  return status ? status : evaluate(s, candidate, DAMPINGS, stopped);
}

/* Moves to the best trial, if it is still better after its solutions were refreshed. */
static ambulo_status accept(search *s) {
  int n = s->fit->parameters, winner = -1;
  double least = s->best->cost * (1.0 - least_gain);
  for (int i = 0; i < n + DAMPINGS; i++)
    if (s->trial[i].cost < (winner < 0 ? least : s->trial[winner].cost)) winner = i;
  if (winner >= 0) {
    ambulo_status status = s->task->refresh(s->task->user, &s->trial[winner]);
    if (status) return status;
    s->trial[winner].cost = ambulo__fit_cost(s->fit, &s->trial[winner]);
    if (!(s->trial[winner].cost < least)) winner = -1;
  }
  s->step.damping = winner < n ? (double)NAN : s->tried[winner - n];
  s->step.accepted = winner < 0 ? "none" : winner < n ? "difference" : "candidate";
  if (winner >= 0) ambulo__fit_trial_copy(s->fit, &s->trial[winner], s->best);
  s->damping = winner < 0 ? 10.0 * s->damping : winner < n ? s->damping : s->step.damping;
  s->damping = fmin(damping_most, fmax(damping_least, s->damping));
  s->step.distance = s->best->distance;
  s->step.cost = s->best->cost;
  return AMBULO_OK;
}

/* ------------------------------------------------------------------------ run */

static ambulo_status iterate(search *s, double *sensitivity, ambulo_fit_ending *ending,
                             int *stuck) {
  int idle = 0, stopped = 0;
  *ending = AMBULO_FIT_ITERATIONS;
  for (int iteration = 0; iteration < s->fit->iterations; iteration++) {
    double before = s->best->cost;
    ambulo_status status = differentiate(s, sensitivity, &stopped);
    if (!status && !stopped) {
      *stuck = find_stuck(s);
      if (*stuck >= 0) *ending = AMBULO_FIT_STUCK;
      if (*stuck >= 0) return AMBULO_OK;
      status = try_candidates(s, &stopped);
    }
    if (stopped) *ending = AMBULO_FIT_INTERRUPTED;
    if (status || stopped) return status;
    status = accept(s);
    if (!status) status = s->task->note(s->task->user, &s->step);
    if (status) return status;
    idle = before - s->best->cost > s->fit->tolerance * before ? 0 : idle + 1;
    int ends = idle == MOST_IDLE || s->best->distance < least_distance;
    if (ends) *ending = AMBULO_FIT_CONVERGED;
    if (ends) return AMBULO_OK;
  }
  return AMBULO_OK;
}

ambulo_status ambulo__fit_search(const ambulo__fit_task *task, ambulo__fit_trial *best,
                                 double *sensitivity, ambulo_fit_ending *ending, int *stuck) {
  const ambulo_fit *fit = task->fit;
  size_t n = (size_t)fit->parameters, m = (size_t)fit->residuals;
  const ambulo_allocator *a = task->allocator;
  search s = {.task = task, .fit = fit, .best = best, .damping = damping_start};
  for (size_t i = 0; i < n; i++) sensitivity[i] = (double)NAN;
  *stuck = -1;
  s.trial = ambulo__fit_trials_make(fit, (int)n + DAMPINGS, a);
  s.jacobian = ambulo__alloc(a, n * m, sizeof *s.jacobian);
  s.row = ambulo__alloc(a, m, sizeof *s.row);
  s.guard = ambulo__alloc(a, (size_t)fit->conditions * (size_t)fit->curves, sizeof *s.guard);
  ambulo_status status = AMBULO_E_MEMORY;
  if (s.trial && s.jacobian && s.row && s.guard) status = iterate(&s, sensitivity, ending, stuck);
  ambulo__free(a, s.trial);
  ambulo__free(a, s.jacobian);
  ambulo__free(a, s.row);
  ambulo__free(a, s.guard);
  return status;
}
