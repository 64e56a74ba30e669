/* solver/model_step.c - the step that foresees which rows become active.
 *
 * At the centre y, with g = grad f, H0 = H_GN + mu I, excesses v with gradients J,
 * multipliers lambda and penalty rho, the augmented Lagrangian is modelled by
 *
 *     phi(d) = g.d + d' H0 d / 2 + sum_i max(0, lambda_i + rho (v + J d)_i)^2 / (2 rho)
 *
 * subject to J_e d = 0, C d = 0: convex and piecewise quadratic. Semismooth Newton:
 * with A = { lambda + rho (v + J d) > 0 } solve
 *
 *     [ H0 + rho J_A'J_A   J_e' C' ]        [ -grad phi(d) ]
 *     [ J_e, C                  0  ] step = [       0      ]
 *
 * Armijo on phi, until A repeats. No evaluation but the first is needed. The metric of the
 * iterations that follow is the one with this predicted A: rows that the step is about to
 * meet are felt before they are hit, which is what plain Gauss-Newton steps lack.
 */
#include "solver/engine.h"
#include "base/worst.h"

#include <math.h>
#include <string.h>

enum { MAX_NEWTON = 15, MAX_HALVINGS = 12 };
static const double armijo = 0.1;
static const double decrease_floor = 1e-8;

static double square(double x) {
  return x * x;
}

static double dot(const double *a, const double *b, int n) {
  double sum = 0.0;
  for (int j = 0; j < n; j++) sum += a[j] * b[j];
  return sum;
}

/* penalty part of phi at linear + t along */
static double penalty(const ambulo__engine *e, double t) {
  double sum = 0.0;
  for (int i = 0; i < e->inequalities; i++) {
    double force = e->lambda[i] + e->rho * (e->linear[i] + t * e->along[i]);
    if (force > 0.0) sum += square(force);
  }
  return sum / (2.0 * e->rho);
}

static int mark_active(const ambulo__engine *e, int *active) {
  int changed = 0;
  for (int i = 0; i < e->inequalities; i++) {
    active[i] = e->lambda[i] + e->rho * e->linear[i] > 0.0;
    changed |= active[i] != e->active[i];
  }
  return changed;
}

/* H0 + rho J_A'J_A for the marked rows into the whitener, not yet factored */
static void assemble(ambulo__engine *e) {
  ambulo__band_copy(&e->base, &e->whitener);
  for (int i = 0; i < e->inequalities; i++) {
    if (e->active[i]) ambulo__band_add_sparse(&e->whitener, &e->rows.inequality, i, e->rho);
  }
}

/* minus the gradient of phi at the step taken so far, into engine->previous */
static void slope(ambulo__engine *e) {
  for (int i = 0; i < e->inequalities; i++)
    e->held.multiplier[i] = ambulo__worse(0.0, e->lambda[i] + e->rho * e->linear[i]);
  for (int j = 0; j < e->n; j++) e->previous[j] = -(e->gradient[j] + e->curved_total[j]);
  ambulo__sparse_rows_add_transpose(&e->rows.inequality, -1.0, e->held.multiplier, e->previous);
}

/* value of phi without its penalty part at total + t step */
static double smooth_part(const ambulo__engine *e, double t) {
  double sum = 0.0;
  for (int j = 0; j < e->n; j++) {
    double d = e->total[j] + t * e->step[j];
    sum += d * (e->gradient[j] + 0.5 * (e->curved_total[j] + t * e->curved[j]));
  }
  return sum;
}

/* one Newton step; returns 1 when the model is solved, -1 when a factorization failed */
static int newton(ambulo__engine *e, double start, double *phi) {
  assemble(e);
  if (ambulo__kkt_factor(&e->kkt, &e->whitener)) return -1;
  slope(e);
  ambulo__kkt_solve(&e->kkt, e->previous, NULL, NULL, e->step, e->equality_multiplier,
                    e->border_multiplier);
  ambulo__band_multiply(&e->base, e->step, e->curved);
  ambulo__sparse_rows_multiply(&e->rows.inequality, e->step, e->along);
  double decrease = dot(e->previous, e->step, e->n), t = 1.0, value = *phi;
  for (int trial = 0; trial < MAX_HALVINGS; trial++) {
    value = smooth_part(e, t) + penalty(e, t);
    if (value <= *phi - armijo * t * decrease) break;
    t *= 0.5;
  }
  for (int j = 0; j < e->n; j++) {
    e->total[j] += t * e->step[j];
    e->curved_total[j] += t * e->curved[j];
  }
  for (int i = 0; i < e->inequalities; i++) e->linear[i] += t * e->along[i];
  *phi = value;
  int changed = mark_active(e, e->active_next);
  if (!changed && t == 1.0) return 1;
  memcpy(e->active, e->active_next, (size_t)e->inequalities * sizeof *e->active);
  double gained = fmax(1e-12, start - value);
  return decrease < decrease_floor * gained || decrease < 1e-10 * fmax(1.0, fabs(value)) ? 2 : 0;
}

/* final metric; the KKT factor is renewed when the active set is not the one it has */
static int finish(ambulo__engine *e, int settled) {
  assemble(e);
  if (!settled && ambulo__kkt_factor(&e->kkt, &e->whitener)) return 1;
  return ambulo__band_factor(&e->whitener);
}

int ambulo__model_minimize(ambulo__engine *e, double *phi) {
  int settled = 0;
  memset(e->total, 0, (size_t)e->n * sizeof *e->total);
  memset(e->curved_total, 0, (size_t)e->n * sizeof *e->curved_total);
  mark_active(e, e->active_next);
  memcpy(e->active, e->active_next, (size_t)e->inequalities * sizeof *e->active);
  memset(e->along, 0, (size_t)e->inequalities * sizeof *e->along);
  double start = penalty(e, 0.0), value = start;
  for (int k = 0; k < MAX_NEWTON && settled == 0; k++) {
    (void)ambulo__run_poll(e->run); /* one step of a large problem takes seconds */
    settled = ambulo__run_late(e->run) ? -1 : newton(e, start, &value);
  }
  *phi = value - start;
  return settled == 0 ? 2 : settled;
}

static int not_finite(ambulo__engine *e) {
  ambulo__run_fault(e->run, &e->workspace->fault);
  return 2;
}

int ambulo__model_step(ambulo__engine *e, double *predicted) {
  if (ambulo__evaluate_jacobian(e->workspace, e->center)) return not_finite(e);
  if (ambulo__engine_gradient(e, NULL, NULL, e->gradient)) return 2;
  double begin = ambulo__seconds_now();
  if (ambulo__sparse_rows_fill(&e->rows.equality, e->workspace, 0) ||
      ambulo__sparse_rows_fill(&e->rows.inequality, e->workspace, 0))
    return not_finite(e);
  ambulo__engine_excess(e, e->linear);
  if (ambulo__engine_fill_metric(e, e->mu)) return 2;
  int settled = ambulo__model_minimize(e, predicted);
  int failed = settled < 0 || finish(e, settled == 1);
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  return failed;
}
