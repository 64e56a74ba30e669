/* method/model_step.c - the step that foresees which rows become active.
 *
 * At the centre y, with g = grad f, H0 = H_GN + mu I, excesses v with gradients J,
 * multipliers lambda and penalty rho, the augmented Lagrangian is modelled by
 *
 *     phi(d) = g.d + d' H0 d / 2 + sum_i max(0, lambda_i + rho (v + J d)_i)^2 / (2 rho)
 *
 * subject to J_e d = 0, C d = 0: convex and piecewise quadratic. Semismooth Newton, or primal-dual
 * active sets: with a set A of rows, solve
 *
 *     [ H0 + rho J_A'J_A   J_e' C' ]        [ -(g + H0 d + J_A'(lambda + rho (v + J d))) ]
 *     [ J_e, C                  0  ] step = [                     0                      ]
 *
 * and let A be the rows with lambda + rho (v + J d) > 0 at the new d. Three things make it short:
 *
 *   start   A is the set that the last model step ended with; its rows count with whatever force
 *           they have, which is where a full step from d = 0 with that set leads
 *   steps   are full while phi stays below the larger of its last two values: sets settle in a few
 *           of them. When it does not, or after some, back to the best point: from there the step
 *           is the exact minimum of phi along it (phi' is monotone and piecewise linear)
 *   end     when A repeats, or when a step brought less than a thousandth of the whole gain
 *
 * Rows that come or go are added to or taken from the band; it is factored only when one did. No
 * evaluation but the first is needed. The metric of the iterations that follow is the one with this
 * predicted A: rows that the step is about to meet are felt before they are hit, which is what
 * plain Gauss-Newton steps lack.
 */
#include "method/engine.h"
#include "method/parameters.h"
#include "base/worst.h"

#include <math.h>
#include <string.h>

static double square(double x) {
  return x * x;
}

static double dot(const double *a, const double *b, int n) {
  double sum = 0.0;
  for (int j = 0; j < n; j++) sum += a[j] * b[j];
  return sum;
}

/* ---------------------------------------------------------------------- phi */

/* phi at total + t step */
static double value_at(const ambulo__engine *e, double t) {
  double smooth = 0.0, sum = 0.0;
  for (int j = 0; j < e->n; j++) {
    double d = e->total[j] + t * e->step[j];
    smooth += d * (e->gradient[j] + 0.5 * (e->curved_total[j] + t * e->curved[j]));
  }
  for (int i = 0; i < e->inequalities; i++) {
    double force = e->lambda[i] + e->rho * (e->linear[i] + t * e->along[i]);
    if (force > 0.0) sum += square(force);
  }
  return smooth + sum / (2.0 * e->rho);
}

/* phi' along the step at t, and phi'' */
static double slope_at(const ambulo__engine *e, const double smooth[2], double t,
                       double *curvature) {
  double slope = 0.0, second = 0.0;
  for (int i = 0; i < e->inequalities; i++) {
    double force = e->lambda[i] + e->rho * (e->linear[i] + t * e->along[i]);
    double on = force > 0.0 ? e->along[i] : 0.0;
    slope += on * force;
    second += on * on;
  }
  *curvature = smooth[1] + e->rho * second;
  return smooth[0] + smooth[1] * t + slope;
}

/* the minimum of phi along the step, at most the whole of it: by Newton's method within a bracket.
 * Beyond there is nothing but the rounding of a step that is next to none */
static double exact_step(const ambulo__engine *e) {
  double smooth[2] = {dot(e->step, e->gradient, e->n) + dot(e->step, e->curved_total, e->n),
                      dot(e->step, e->curved, e->n)};
  double low = 0.0, high = 1.0, t = 1.0, curvature;
  double zero = AMBULO__MODEL_LEVEL * fabs(slope_at(e, smooth, 0.0, &curvature));
  if (slope_at(e, smooth, 1.0, &curvature) <= zero) return 1.0;
  for (int k = 0; k < AMBULO__MODEL_SEARCH; k++) {
    double slope = slope_at(e, smooth, t, &curvature);
    if (fabs(slope) <= zero) break;
    if (slope > 0.0) {
      high = t;
    } else {
      low = t;
    }
    t -= slope / curvature;
    if (!(t > low && t < high)) t = 0.5 * (low + high);
  }
  return t;
}

/* ----------------------------------------------------------------- active set */

/* the rows with a force at the step so far, into active; how many changed */
static int mark_active(ambulo__engine *e) {
  int changed = 0;
  for (int i = 0; i < e->inequalities; i++) {
    int is = e->lambda[i] + e->rho * e->linear[i] > 0.0;
    changed += is != e->active[i];
    e->active[i] = is;
  }
  return changed;
}

/* H0 + rho J_A'J_A into the whitener, not yet factored; 1 when it is another matrix than before */
static int assemble(ambulo__engine *e) {
  int moved = !e->assembled;
  if (!e->assembled) {
    ambulo__band_copy(&e->base, &e->whitener);
    memset(e->added, 0, (size_t)e->inequalities * sizeof *e->added);
    e->assembled = 1;
  }
  for (int i = 0; i < e->inequalities; i++) {
    if (e->active[i] == e->added[i]) continue;
    ambulo__band_add_sparse(&e->whitener, &e->rows.inequality, i, e->active[i] ? e->rho : -e->rho);
    e->added[i] = e->active[i];
    moved = 1;
  }
  return moved;
}

/* -------------------------------------------------------------------- one step */

/* The step for the active set; *slope: minus the product of phi's gradient with it. 1 when it
 * cannot be factored. */
static int direction(ambulo__engine *e, double *slope) {
  if (assemble(e) && ambulo__kkt_factor(&e->kkt, &e->whitener)) return 1;
  for (int i = 0; i < e->inequalities; i++)
    e->held.multiplier[i] = e->active[i] ? e->lambda[i] + e->rho * e->linear[i] : 0.0;
  for (int j = 0; j < e->n; j++) e->previous[j] = -(e->gradient[j] + e->curved_total[j]);
  ambulo__sparse_rows_add_transpose(&e->rows.inequality, -1.0, e->held.multiplier, e->previous);
  ambulo__kkt_solve(&e->kkt, e->previous, NULL, NULL, e->step, e->equality_multiplier,
                    e->border_multiplier);
  ambulo__band_multiply(&e->base, e->step, e->curved);
  ambulo__sparse_rows_multiply(&e->rows.inequality, e->step, e->along);
  *slope = dot(e->previous, e->step, e->n);
  return 0;
}

static void take(ambulo__engine *e, double t) {
  for (int j = 0; j < e->n; j++) {
    e->total[j] += t * e->step[j];
    e->curved_total[j] += t * e->curved[j];
  }
  for (int i = 0; i < e->inequalities; i++) e->linear[i] += t * e->along[i];
}

/* what is known of phi on the way */
typedef struct descent {
  double start, value, before, least; /* phi at 0, now, one step ago, at the best point */
  int searching;                      /* line searches from now on */
  double tolerance;                   /* enough, or exact */
} descent;

static void keep(ambulo__engine *e, descent *d) {
  if (!(d->value < d->least)) return;
  d->least = d->value;
  memcpy(e->best_total, e->total, (size_t)e->n * sizeof *e->total);
  memcpy(e->best_curved, e->curved_total, (size_t)e->n * sizeof *e->total);
  memcpy(e->best_linear, e->linear, (size_t)e->inequalities * sizeof *e->linear);
}

static void go_back(ambulo__engine *e, descent *d) {
  d->value = d->least;
  memcpy(e->total, e->best_total, (size_t)e->n * sizeof *e->total);
  memcpy(e->curved_total, e->best_curved, (size_t)e->n * sizeof *e->total);
  memcpy(e->linear, e->best_linear, (size_t)e->inequalities * sizeof *e->linear);
}

/* k-th step; 1 when the model is solved, -1 when a factorization failed, else 0 */
static int newton(ambulo__engine *e, int k, descent *d) {
  double slope, t = 1.0;
  if (direction(e, &slope)) return -1;
  double now = value_at(e, 1.0);
  if (!d->searching && k > 0 &&
      (now > fmax(d->before, d->value) || k >= AMBULO__MODEL_FULL_STEPS)) {
    d->searching = 1;
    go_back(e, d);
    (void)mark_active(e);
    return 0;
  }
  if (d->searching) {
    t = exact_step(e);
    now = value_at(e, t);
  }
  take(e, t);
  d->before = d->value;
  d->value = now;
  int better = now < d->least, whole = t >= 1.0;
  keep(e, d);
  double gained = d->start - d->least;
  int changed = mark_active(e);
  if (changed == 0 && whole) return 1;
  if (!better) return 0;
  if (k > 0 && fabs(d->before - now) < d->tolerance * gained) return 1;
  return slope < AMBULO__MODEL_EXACT * gained;
}

int ambulo__model_minimize(ambulo__engine *e, int roughly, double *phi) {
  size_t bytes = (size_t)e->n * sizeof *e->total;
  int settled = 0;
  memset(e->total, 0, bytes);
  memset(e->curved_total, 0, bytes);
  memset(e->along, 0, (size_t)e->inequalities * sizeof *e->along);
  e->assembled = 0;
  if (!roughly || !e->warm) (void)mark_active(e);
  e->warm = 0;
  descent d = {.before = HUGE_VAL,
               .least = HUGE_VAL,
               .searching = !roughly,
               .tolerance = roughly ? AMBULO__MODEL_ENOUGH : AMBULO__MODEL_EXACT};
  d.start = d.value = value_at(e, 0.0);
  keep(e, &d);
  for (int k = 0; k < AMBULO__MODEL_STEPS && settled == 0; k++) {
    (void)ambulo__run_poll(e->run); /* one step of a large problem takes seconds */
    settled = ambulo__run_late(e->run) ? -1 : newton(e, k, &d);
  }
  if (settled < 0) return -1;
  /* never where the minimum itself is wanted: next to it phi is rounding, and d = 0 says that there
   * is nothing left to gain */
  if (roughly && d.value > d.least) go_back(e, &d);
  for (int i = 0; i < e->inequalities; i++)
    e->held.multiplier[i] = ambulo__worse(0.0, e->lambda[i] + e->rho * e->linear[i]);
  *phi = d.least - d.start;
  return 0;
}

/* the metric of the rows that were active when the KKT matrix was factored */
static int finish(ambulo__engine *e) {
  memcpy(e->active, e->added, (size_t)e->inequalities * sizeof *e->active);
  if (e->equalities > 0) return ambulo__band_factor(&e->whitener);
  ambulo__band_copy_factor(&e->kkt.factor, &e->whitener);
  return 0;
}

static int not_finite(ambulo__engine *e) {
  ambulo__run_fault(e->run, &e->workspace->fault);
  return 2;
}

/* (P.5) the active set that phi foresees */
int ambulo__model_step(ambulo__engine *e, double *predicted) {
  if (ambulo__evaluate_jacobian(e->workspace, e->center)) return not_finite(e);
  if (ambulo__engine_gradient(e, NULL, NULL, e->gradient)) return 2;
  double begin = ambulo__seconds_now();
  if (ambulo__sparse_rows_fill(&e->rows.equality, e->workspace, 0) ||
      ambulo__sparse_rows_fill(&e->rows.inequality, e->workspace, 0))
    return not_finite(e);
  ambulo__engine_excess(e, e->linear);
  if (ambulo__engine_fill_metric(e, e->mu)) return 2;
  int failed = ambulo__model_minimize(e, 1, predicted) || finish(e);
  e->warm = !failed && *predicted < 0.0;
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  return failed;
}
