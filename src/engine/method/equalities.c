/* method/equalities.c - from anywhere to a point that satisfies the equalities.
 *
 * Newton's method for h(x) = 0, C x = b with the step of least length in the metric
 * H_GN + 10 mu I:
 *
 *     minimize d' H d / 2   subject to   J d = -h,   C d = b - C x
 *
 * damped so that no angle changes by more than 0.3 rad at once. The metric makes the motion
 * that it arrives at a smooth one: a step that bends the motion costs torque.
 */
#include "method/equalities.h"

#include "method/parameters.h"
#include "method/point.h"

#include <math.h>
#include <string.h>

ambulo_status ambulo__retraction_create(ambulo__engine *e) {
  ambulo__pool *pool = &e->pool;
  int n = e->setup->n, equalities = e->setup->equalities;
  ambulo__retraction *r = ambulo__pool_blocks(pool, 1, sizeof *r);
  if (!r) return AMBULO_E_MEMORY;
  e->retraction = r;
  r->tolerance =
      AMBULO__RETRACTION_SHARE * fmin(AMBULO__RESTORED, e->run->options->feasibility_tolerance);
  r->adjoint_tolerance = ambulo__engine_roughness(e);
  double **vectors[] = {&r->step, &r->gradient, &r->previous, &r->previous_gradient, &r->nearest};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
    *vectors[i] = ambulo__pool_doubles(pool, (size_t)n);
  r->along = ambulo__pool_doubles(pool, (size_t)equalities);
  r->force = ambulo__pool_doubles(pool, (size_t)equalities);
  r->balanced = ambulo__pool_doubles(pool, (size_t)equalities);
  r->border = ambulo__pool_doubles(pool, (size_t)e->setup->borders);
  ambulo_status status = ambulo__mixing_create(pool, n, equalities, &r->points);
  if (!status) status = ambulo__mixing_create(pool, equalities, equalities, &r->adjoint);
  return pool->failed ? AMBULO_E_MEMORY : status;
}

/* the step of least length from the point of the workspace; 1 when it cannot be had */
static int direction(ambulo__engine *e, double *d) {
  ambulo__linearized *at = &e->linearized;
  ambulo__retraction *r = e->retraction;
  int equalities = e->setup->equalities, borders = e->setup->borders;
  double begin = ambulo__seconds_now();
  if (ambulo__sparse_rows_fill(&at->rows.equality, e->workspace, 0)) {
    ambulo__run_fault(e->run, &e->workspace->fault);
    return 1;
  }
  int failed = ambulo__engine_fill_metric(e, AMBULO__RESTORE_DAMPING * e->iterate.mu);
  if (!failed) {
    failed = ambulo__kkt_factor(&at->kkt, &at->base);
    e->run->breakdowns += failed;
  }
  if (!failed) {
    for (int i = 0; i < equalities; i++) r->force[i] = -e->measured.equality[i];
    for (int i = 0; i < borders; i++) r->border[i] = -e->measured.border[i];
    memset(r->along, 0, (size_t)equalities * sizeof *r->along);
    ambulo__kkt_solve(&at->kkt, NULL, r->force, r->border, d, r->along, NULL);
  }
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  return failed;
}

/* x + t d with the largest t, halved while the point is not finite; 0 on success */
static int advance(ambulo__engine *e, const double *d, double *x) {
  int n = e->setup->n;
  double *from = e->iterate.x, t = ambulo__step_limit(e->setup, d, AMBULO__RESTORE_STEP_CAP);
  memcpy(from, x, (size_t)n * sizeof *x);
  for (int trial = 0; trial < AMBULO__INNER_STEPS; trial++) {
    for (int j = 0; j < n; j++) x[j] = from[j] + t * d[j];
    if (ambulo__evaluate(e->workspace, x) == AMBULO_OK) return 0;
    ambulo__run_fault(e->run, &e->workspace->fault);
    t *= 0.5;
  }
  memcpy(x, from, (size_t)n * sizeof *x);
  return 1;
}

/* (P.4) Newton steps of least length onto the equalities */
ambulo_status ambulo__restore(ambulo__engine *e, double *x, double *error) {
  ambulo__retraction *r = e->retraction;
  size_t bytes = (size_t)e->setup->n * sizeof *x;
  double least = HUGE_VAL;
  *error = HUGE_VAL;
  for (int k = 0; k < AMBULO__RESTORE_STEPS; k++) {
    ambulo_status status = ambulo__evaluate_jacobian(e->workspace, x);
    if (status) return status;
    *error = ambulo__engine_equality_error(e);
    if (*error < least) {
      least = *error;
      memcpy(r->nearest, x, bytes);
    }
    if (*error < AMBULO__RESTORE_TARGET || ambulo__run_over(e->run)) break;
    if (direction(e, r->step) || advance(e, r->step, x)) break;
  }
  if (least < *error) {
    memcpy(x, r->nearest, bytes);
    *error = least;
  }
  return AMBULO_OK;
}

/* -------------------------------------------------------- points on the surface
 *
 * Around the iterate x_k with metric H, gradients J_k of the local equalities h and the border
 * rows C, a point y_0 is carried to
 *
 *     y = R(y_0):   h(y) = 0,   C y = b,   y - y_0 in H^-1 range(J_k', C')
 *
 * by chord steps with the factor at hand (kkt.h); a pass solves J_k d = -h only nearly, but
 * always moves within H^-1 range(J_k', C'), and h is evaluated anew. Mixing the last
 * iterates (coefficients that sum to one) stays on that plane and copes with a Jacobian
 * that has moved.
 *
 * Derivative: dy = dy_0 - H^-1 (J_k' dn + C' dm) with J dy = 0, C dy = 0 for the Jacobian J
 * at y. Hence, for a function with gradient G at y, the gradient with respect to y_0 is H z,
 *
 *     H z + C' m = G + J' l,     J_k z = 0,   C z = 0                                (A)
 *
 * (l: the retraction's multipliers; at a solution those of the equalities). J' l needs no
 * Jacobian: it is one reverse sweep. With penalties S of kkt.h, iterate
 *
 *     M z + C' m = G + J' l,   l <- l - S J_k z
 *
 * whose error shrinks as J - J_k does; mixed as well, which for this linear problem is
 * GMRES. |z - z'|^2 in the metric M is (z - z') . (r - r'), r the right-hand sides: the change. The
 * next one will be smaller as |J_k z| was, which the pass has measured already: this product is
 * what is asked to be small.
 */

static void chord(ambulo__engine *e, double *y) {
  ambulo__retraction *r = e->retraction;
  ambulo__kkt *kkt = &e->linearized.kkt;
  const double *h = e->measured.equality;
  const int n = e->setup->n;
  double begin = ambulo__seconds_now();
  for (int i = 0; i < e->setup->equalities; i++) {
    r->force[i] = -kkt->penalty[i] * h[i];
    r->balanced[i] = sqrt(kkt->penalty[i]) * h[i];
  }
  for (int i = 0; i < e->setup->borders; i++) r->border[i] = -e->measured.border[i];
  memset(r->step, 0, (size_t)n * sizeof *r->step);
  ambulo__sparse_rows_add_transpose(&e->setup->rows->equality, 1.0, r->force, r->step);
  ambulo__kkt_pass(kkt, r->step, r->border, NULL);
  for (int j = 0; j < n; j++) y[j] += r->step[j];
  ambulo__mixing_apply(&r->points, r->balanced, y);
  e->run->seconds_linear += ambulo__seconds_now() - begin;
}

/* (P.8) chord steps onto h = 0, C y = b */
int ambulo__retract(ambulo__engine *e, double *y) {
  double least = HUGE_VAL;
  ambulo__mixing_reset(&e->retraction->points);
  for (int k = 0; k < AMBULO__INNER_STEPS; k++) {
    if (ambulo__evaluate(e->workspace, y)) {
      ambulo__run_fault(e->run, &e->workspace->fault);
      return 0;
    }
    double error = ambulo__engine_equality_error(e);
    if (error <= e->retraction->tolerance) return 1;
    if (least <= AMBULO__ROUNDING && error > 0.5 * least)
      return 1; /* as near as rounding lets it */
    if (isnan(error)) return 0;
    if (k == AMBULO__INNER_STEPS - 1) return error <= AMBULO__ROUNDING;
    least = fmin(least, error);
    chord(e, y);
    for (int j = 0; j < e->setup->n; j++) {
      if (!isfinite(y[j])) return 0;
    }
  }
  return 0;
}

/* one pass of (A); l moves. Right-hand side in the scratch's gradient; *left: |S^1/2 J_k z|. */
static ambulo_status adjoint_pass(ambulo__engine *e, double scale, const double *p, double *l,
                                  double *z, double *left) {
  ambulo__retraction *r = e->retraction;
  ambulo__kkt *kkt = &e->linearized.kkt;
  ambulo_status status = ambulo__engine_gradient(e, scale, p, l, r->gradient);
  if (status) return status;
  double begin = ambulo__seconds_now(), sum = 0.0;
  memcpy(z, r->gradient, (size_t)e->setup->n * sizeof *z);
  ambulo__kkt_pass(kkt, z, NULL, NULL);
  ambulo__sparse_rows_multiply(&e->setup->rows->equality, z, r->along);
  for (int i = 0; i < e->setup->equalities; i++) {
    l[i] -= kkt->penalty[i] * r->along[i];
    r->balanced[i] = sqrt(kkt->penalty[i]) * r->along[i];
    sum += r->balanced[i] * r->balanced[i];
  }
  *left = sqrt(sum);
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  return AMBULO_OK;
}

/* |z - z'|, and |z| in *size, since the last pass */
static double moved_by(ambulo__retraction *r, int n, const double *z, double *size) {
  double square = 0.0, change = 0.0;
  for (int j = 0; j < n; j++) {
    square += z[j] * r->gradient[j];
    change += (z[j] - r->previous[j]) * (r->gradient[j] - r->previous_gradient[j]);
  }
  memcpy(r->previous, z, (size_t)n * sizeof *z);
  memcpy(r->previous_gradient, r->gradient, (size_t)n * sizeof *z);
  *size = sqrt(fabs(square));
  return sqrt(fabs(change));
}

/* (P.9) H z + C'm = G + J'l */
ambulo_status ambulo__reduced_gradient(ambulo__engine *e, double scale, const double *p, double *l,
                                       double *z) {
  ambulo__retraction *r = e->retraction;
  double before = 0.0, left, size;
  ambulo__mixing_reset(&r->adjoint);
  for (int k = 0; k < AMBULO__INNER_STEPS; k++) {
    ambulo_status status = adjoint_pass(e, scale, p, l, z, &left);
    if (status || e->setup->equalities == 0) return status;
    double change = moved_by(r, e->setup->n, z, &size);
    if (k > 0 && change * fmin(1.0, left / before) <= r->adjoint_tolerance * size) break;
    before = left;
    double begin = ambulo__seconds_now();
    ambulo__mixing_apply(&r->adjoint, r->balanced, l);
    e->run->seconds_linear += ambulo__seconds_now() - begin;
  }
  return AMBULO_OK;
}
