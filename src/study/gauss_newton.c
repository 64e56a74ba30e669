/* study/gauss_newton.c - Gauss-Newton on residual curves, by differences (trial.h).
 *
 * An iteration at u, whose residuals are r:
 *
 *   1. Column i of J is (r(u + h e_i) - r) / h, h one step toward the file's own value (the other
 * way at a bound). All columns are solved at once.
 *   2. A change |r(u + h e_i) - r| > 0.6 |r| + 0.2, or a solve that fails, is a jump into another
 *      valley and no derivative: the other side is tried, and where it jumps too the column is 0;
 *      unless both changes are each other's opposite, which is a steep slope (central difference).
 *   3. Steps of four dampings (damped_step.h) with that J, no longer than four steps in any
 *      parameter and within its bounds; a parameter at its bound that would leave it stands still.
 *   4. The best of all trials is the next u, if it is still better with the solutions that zero
 * finds there where those are the better ones (refresh). Where none is, the damping grows and h
 *      shrinks; h also follows how much each parameter changes (adapt_reach).
 *
 * Residuals and not the distance, because a distance alone hides that two curves moved against each
 * other; differences and not smaller than a step, because an inner solve knows its motion to some
 * thousandths only. */
#include "study/damped_step.h"
#include "study/fit_trial.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { DAMPINGS = 4, MOST_IDLE = 2, MOST_ATTEMPTS = 3 };

static const double jump_share = 0.6, jump_floor = 0.2, longest = 4.0;
static const double damping_start = 0.03, damping_least = 1e-4, damping_most = 2.0;
static const double shrink = 0.6, least_gain = 1e-6, most_curvature = 0.7;
static const double change_floor = 0.05, least_reach = 0.1, nothing = 1e-6;

typedef struct newton {
  const ambulo__fit_task *task;
  ambulo__fit_trial *best;
  ambulo__fit_trial *side, *other; /* [parameters] one and the other side */
  ambulo__fit_trial *candidate;    /* [DAMPINGS] */
  double *jacobian;                /* [parameters][residuals] */
  double *h;                       /* [parameters] way to side; 0: dropped */
  unsigned char *is_free;          /* [parameters] */
  double *reach;                   /* [parameters] length of differences, in steps */
  double damping;
  int stopped;
  ambulo__fit_step step;
} newton;

static ambulo_status evaluate(newton *g, ambulo__fit_trial *trials, int count) {
  if (count == 0) return AMBULO_OK;
  ambulo_status status = g->task->evaluate(g->task->user, g->best, trials, count);
  for (int i = 0; i < count && !status; i++) {
    if (!trials[i].complete) g->stopped = 1;
    trials[i].cost = ambulo__fit_cost(g->task, &trials[i]);
  }
  return status;
}

/* ------------------------------------------------------------------- Jacobian */

/* the longer of what is left to each side, at most `reach`; toward 0 where both are free */
static double choose_side(const newton *g, int i) {
  double u = g->best->u[i], reach = g->reach[i];
  double up = g->task->upper[i] - u, down = u - g->task->lower[i];
  double first = u > 0.0 ? -1.0 : 1.0, room = first > 0.0 ? up : down;
  if (room >= reach) return first * reach;
  double back = first > 0.0 ? down : up;
  if (back > room) return -first * fmin(back, reach);
  return first * room;
}

/* |r(t) - r|; infinite where other conditions are solved */
static double change_of(const newton *g, const ambulo__fit_trial *t) {
  double squares = 0.0;
  for (int c = 0; c < g->task->sizes.conditions; c++)
    if (t->solved[c] != g->best->solved[c]) return (double)INFINITY;
  for (int k = 0; k < g->task->sizes.residuals; k++) {
    double change = t->residual[k] - g->best->residual[k];
    squares += change * change;
  }
  return sqrt(squares);
}

static int is_jump(const newton *g, const ambulo__fit_trial *t) {
  return change_of(g, t) > jump_share * sqrt(g->best->distance) + jump_floor;
}

/* Differences that change the motion more than what is left to be explained become shorter for the
 * next iteration, those that hardly change it longer again. */
static void adapt_reach(newton *g) {
  double r = sqrt(g->best->distance);
  for (int i = 0; i < g->task->sizes.parameters; i++) {
    double change = change_of(g, &g->side[i]);
    if (change > 0.5 * r + change_floor) g->reach[i] = fmax(least_reach, 0.5 * g->reach[i]);
    if (change < 0.1 * r) g->reach[i] = fmin(1.0, 2.0 * g->reach[i]);
  }
}

static void place(const newton *g, ambulo__fit_trial *t, int i, double h, const char *side) {
  memcpy(t->u, g->best->u, (size_t)g->task->sizes.parameters * sizeof *t->u);
  t->u[i] += h;
  (void)snprintf(t->label, sizeof t->label, "parameter %d %s", i + 1, side);
}

static void fill_column(newton *g, int i, const ambulo__fit_trial *t, double h) {
  size_t m = (size_t)g->task->sizes.residuals;
  double *column = g->jacobian + (size_t)i * m;
  for (size_t k = 0; k < m; k++) column[k] = (t->residual[k] - g->best->residual[k]) / h;
}

/* Whether the changes to both sides are each other's opposite but for curvature: a steep slope and
 * no jump. */
static int is_steep(const newton *g, const ambulo__fit_trial *a, const ambulo__fit_trial *b) {
  double both = 0.0, one = 0.0, other = 0.0;
  for (int c = 0; c < g->task->sizes.conditions; c++)
    if (a->solved[c] != g->best->solved[c] || b->solved[c] != g->best->solved[c]) return 0;
  for (int k = 0; k < g->task->sizes.residuals; k++) {
    double up = a->residual[k] - g->best->residual[k], down = b->residual[k] - g->best->residual[k];
    both += (up + down) * (up + down);
    one += up * up;
    other += down * down;
  }
  return both < most_curvature * most_curvature * fmax(one, other);
}

/* (r(a) - r(b)) / h: central */
static void fill_between(newton *g, int i, const ambulo__fit_trial *a, const ambulo__fit_trial *b,
                         double h) {
  size_t m = (size_t)g->task->sizes.residuals;
  double *column = g->jacobian + (size_t)i * m;
  for (size_t k = 0; k < m; k++) column[k] = (a->residual[k] - b->residual[k]) / h;
}

/* no derivative is known: the column stays 0 */
static void drop(newton *g, int i) {
  g->h[i] = 0.0;
  g->step.dropped++;
}

/* the other side of those that jumped; which[count]: their parameters */
static ambulo_status try_others(newton *g, const int *which, int count) {
  double back[AMBULO__FIT_PARAMETERS];
  int asked[AMBULO__FIT_PARAMETERS], asked_count = 0;
  for (int k = 0; k < count; k++) {
    int i = which[k];
    double u = g->best->u[i], to = u - copysign(g->reach[i], g->h[i]);
    double h = fmin(g->task->upper[i], fmax(g->task->lower[i], to)) - u;
    if (fabs(h) < 0.25 * g->reach[i]) {
      drop(g, i);
      continue;
    }
    back[asked_count] = h;
    asked[asked_count] = i;
    place(g, &g->other[asked_count++], i, h, "the other way");
  }
  ambulo_status status = evaluate(g, g->other, asked_count);
  for (int k = 0; k < asked_count && !status && !g->stopped; k++) {
    int i = asked[k];
    if (!is_jump(g, &g->other[k]))
      fill_column(g, i, &g->other[k], back[k]);
    else if (is_steep(g, &g->side[i], &g->other[k]))
      fill_between(g, i, &g->side[i], &g->other[k], g->h[i] - back[k]);
    else
      drop(g, i);
  }
  return status;
}

static ambulo_status differentiate(newton *g) {
  int n = g->task->sizes.parameters, jumped[AMBULO__FIT_PARAMETERS], jumps = 0;
  memset(g->jacobian, 0, (size_t)n * (size_t)g->task->sizes.residuals * sizeof *g->jacobian);
  for (int i = 0; i < n; i++) {
    g->h[i] = choose_side(g, i);
    place(g, &g->side[i], i, g->h[i], g->h[i] > 0.0 ? "up" : "down");
    g->other[i].complete = 0; /* those of an earlier iteration do not count */
  }
  ambulo_status status = evaluate(g, g->side, n);
  if (status || g->stopped) return status;
  for (int i = 0; i < n; i++) {
    if (is_jump(g, &g->side[i]))
      jumped[jumps++] = i;
    else
      fill_column(g, i, &g->side[i], g->h[i]);
  }
  status = try_others(g, jumped, jumps);
  adapt_reach(g);
  return status;
}

/* a condition without any solution, here and around; -1: none */
static int find_stuck(const newton *g) {
  for (int c = 0; c < g->task->sizes.conditions; c++) {
    int solved = g->best->solved[c] || g->best->index[c] < 0;
    for (int i = 0; i < g->task->sizes.parameters; i++) solved |= g->side[i].solved[c];
    if (!solved) return c;
  }
  return -1;
}

/* --------------------------------------------------------------------- steps */

static void find_free(newton *g) {
  size_t m = (size_t)g->task->sizes.residuals;
  int n = g->task->sizes.parameters;
  for (int i = 0; i < n; i++) {
    double slope = g->task->ridge / n * g->best->u[i],
           width = g->task->upper[i] - g->task->lower[i];
    for (size_t k = 0; k < m; k++) slope += g->jacobian[(size_t)i * m + k] * g->best->residual[k];
    int low = g->best->u[i] <= g->task->lower[i] + 1e-9 * width;
    int high = g->best->u[i] >= g->task->upper[i] - 1e-9 * width;
    g->is_free[i] = !(low && slope > 0.0) && !(high && slope < 0.0);
  }
}

static double damping_of(const newton *g, int k) {
  static const double factors[DAMPINGS] = {0.2, 1.0, 5.0, 25.0};
  return g->damping * factors[k];
}

static ambulo_status try_candidates(newton *g) {
  int n = g->task->sizes.parameters;
  double d[AMBULO__FIT_PARAMETERS];
  find_free(g);
  ambulo__damped_system system = {g->task->sizes.residuals, n,          g->jacobian,
                                  g->best->residual,        g->best->u, g->is_free,
                                  g->task->ridge / n};
  for (int k = 0; k < DAMPINGS; k++) {
    ambulo__fit_trial *t = &g->candidate[k];
    ambulo_status status = ambulo__damped_step(&system, damping_of(g, k), g->task->allocator, d);
    if (status && status != AMBULO_E_NUMERIC) return status;
    if (status) memset(d, 0, sizeof d); /* nothing moves: all columns are zero */
    for (int i = 0; i < n; i++) {
      double to = g->best->u[i] + fmin(longest, fmax(-longest, d[i]));
      t->u[i] = fmin(g->task->upper[i], fmax(g->task->lower[i], to));
    }
    (void)snprintf(t->label, sizeof t->label, "damping %.3g", damping_of(g, k));
  }
  return evaluate(g, g->candidate, DAMPINGS);
}

/* The best trial of the iteration that is not tried yet, and the damping it came from (NaN: it is a
 * side of a difference); NULL: none is better than where the iteration began. */
static ambulo__fit_trial *find_winner(newton *g, double *damping) {
  int n = g->task->sizes.parameters;
  ambulo__fit_trial *winner = NULL;
  double least = g->best->cost * (1.0 - least_gain);
  for (int k = 0; k < DAMPINGS + 2 * n; k++) {
    int i = k - DAMPINGS;
    ambulo__fit_trial *t = i < 0 ? &g->candidate[k] : i < n ? &g->side[i] : &g->other[i - n];
    if (!t->complete || !(t->cost < least)) continue;
    winner = t;
    least = t->cost;
    *damping = i < 0 ? damping_of(g, k) : (double)NAN;
  }
  return winner;
}

/* Moves to the best trial whose solutions are still better after those from zero were looked at, if
 * there is one among the first; 1 in *better then. */
static ambulo_status accept(newton *g, int *better) {
  double damping = (double)NAN;
  g->step.accepted = "none";
  *better = 0;
  for (int attempt = 0; attempt < MOST_ATTEMPTS && !*better && !g->stopped; attempt++) {
    ambulo__fit_trial *winner = find_winner(g, &damping);
    if (!winner) break;
    ambulo_status status = g->task->refresh(g->task->user, winner);
    if (status) return status;
    winner->cost = ambulo__fit_cost(g->task, winner);
    *better = winner->cost < g->best->cost * (1.0 - least_gain);
    winner->complete = 0; /* tried */
    if (!*better) continue;
    g->step.accepted = isnan(damping) ? "difference" : "candidate";
    ambulo__fit_trial_copy(&g->task->sizes, winner, g->best);
    g->best->complete = 1;
  }
  if (!*better) damping = (double)NAN;
  double next = isnan(damping) ? (*better ? 5.0 : 10.0) * g->damping : damping;
  g->damping = fmin(damping_most, fmax(damping_least, next));
  for (int i = 0; i < g->task->sizes.parameters && !*better; i++)
    g->reach[i] = fmax(least_reach, shrink * g->reach[i]);
  g->step.damping = damping;
  g->step.distance = g->best->distance;
  g->step.cost = g->best->cost;
  return AMBULO_OK;
}

/* ------------------------------------------------------------------------ run */

static void measure(const newton *g, double *sensitivity) {
  size_t m = (size_t)g->task->sizes.residuals;
  for (int i = 0; i < g->task->sizes.parameters; i++) {
    double squares = 0.0;
    for (size_t k = 0; k < m; k++) {
      double entry = g->jacobian[(size_t)i * m + k];
      squares += entry * entry;
    }
    sensitivity[i] = g->h[i] != 0.0 ? sqrt(squares) : (double)NAN;
  }
}

static ambulo_status iterate(newton *g, double *sensitivity, ambulo_fit_ending *ending,
                             int *stuck) {
  int idle = 0;
  *ending = AMBULO_FIT_ITERATIONS;
  for (int iteration = 0; iteration < g->task->iterations; iteration++) {
    double before = g->best->cost;
    g->step = (ambulo__fit_step){.accepted = "none"};
    ambulo_status status = differentiate(g);
    if (!status && !g->stopped) {
      measure(g, sensitivity);
      *stuck = find_stuck(g);
      if (*stuck >= 0) *ending = AMBULO_FIT_STUCK;
      if (*stuck >= 0) return AMBULO_OK;
      status = try_candidates(g);
    }
    if (status) return status;
    if (g->stopped) *ending = AMBULO_FIT_INTERRUPTED;
    if (g->stopped) return AMBULO_OK;
    int better = 0;
    status = accept(g, &better);
    idle = better && before - g->best->cost > g->task->tolerance * before ? 0 : idle + 1;
    if (!status) status = g->task->note(g->task->user, &g->step);
    if (status) return status;
    int ends = idle == MOST_IDLE || g->best->distance < nothing;
    if (ends) *ending = AMBULO_FIT_CONVERGED;
    if (ends) return AMBULO_OK;
  }
  return AMBULO_OK;
}

ambulo_status ambulo__fit_gauss_newton(const ambulo__fit_task *task, ambulo__fit_trial *best,
                                       double *sensitivity, ambulo_fit_ending *ending, int *stuck) {
  size_t n = (size_t)task->sizes.parameters;
  const ambulo_allocator *a = task->allocator;
  newton g = {.task = task, .best = best, .damping = damping_start};
  for (size_t i = 0; i < n; i++) sensitivity[i] = (double)NAN;
  *stuck = -1;
  g.side = ambulo__fit_trials_make(&task->sizes, (int)n, a);
  g.other = ambulo__fit_trials_make(&task->sizes, (int)n, a);
  g.candidate = ambulo__fit_trials_make(&task->sizes, DAMPINGS, a);
  g.jacobian = ambulo__alloc(a, n * (size_t)task->sizes.residuals, sizeof *g.jacobian);
  g.h = ambulo__alloc(a, n, sizeof *g.h);
  g.is_free = ambulo__alloc(a, n, 1);
  g.reach = ambulo__alloc(a, n, sizeof *g.reach);
  for (size_t i = 0; g.reach && i < n; i++) g.reach[i] = 1.0;
  ambulo_status status = AMBULO_E_MEMORY;
  if (g.side && g.other && g.candidate && g.jacobian && g.h && g.is_free && g.reach)
    status = iterate(&g, sensitivity, ending, stuck);
  ambulo__free(a, g.side);
  ambulo__free(a, g.other);
  ambulo__free(a, g.candidate);
  ambulo__free(a, g.jacobian);
  ambulo__free(a, g.h);
  ambulo__free(a, g.is_free);
  ambulo__free(a, g.reach);
  return status;
}
