/* method/retraction.c - points on the equalities' surface, and gradients along it.
 *
 * Around the iterate x_k with metric H, gradients J_k of the local equalities h and the border
 * rows C, a point y_0 is carried to
 *
 *     y = R(y_0):   h(y) = 0,   C y = b,   y - y_0 in H^-1 range(J_k', C')
 *
 * by chord steps with the factor held (kkt.h); a pass solves J_k d = -h only nearly, but
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
 * GMRES. With M nearly J_k'S J_k across the surface, |J_k z|^2 in S is what the next pass would
 * take off z, squared in the metric, where |z|^2 = z . (G + J'l). Once that is little, the next pass
 * is done with J_k in the place of J, which saves its sweep: what is left is smaller by the share
 * that J has moved.
 */
#include "method/retraction.h"
#include "method/engine_point.h"
#include "method/parameters.h"

#include <math.h>
#include <string.h>

ambulo_status ambulo__retraction_create(ambulo__engine *e) {
  ambulo__pool *pool = &e->pool;
  int n = e->setup->n, equalities = e->setup->equalities;
  ambulo__retraction *r = ambulo__pool_blocks(pool, 1, sizeof *r);
  if (!r) return AMBULO_E_MEMORY;
  e->retraction = r;
  r->tolerance = fmin(AMBULO__RETRACTION_TOLERANCE,
                      AMBULO__RETRACTION_SHARE * e->run->options->feasibility_tolerance);
  r->adjoint_tolerance = AMBULO__ADJOINT_TOLERANCE;
  r->step = ambulo__pool_doubles(pool, (size_t)n);
  r->gradient = ambulo__pool_doubles(pool, (size_t)n);
  r->along = ambulo__pool_doubles(pool, (size_t)equalities);
  r->force = ambulo__pool_doubles(pool, (size_t)equalities);
  r->balanced = ambulo__pool_doubles(pool, (size_t)equalities);
  r->border = ambulo__pool_doubles(pool, (size_t)e->setup->borders);
  ambulo_status status = ambulo__mixing_create(pool, n, equalities, &r->points);
  if (!status) status = ambulo__mixing_create(pool, equalities, equalities, &r->adjoint);
  return pool->failed ? AMBULO_E_MEMORY : status;
}

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
  for (int k = 0; k < AMBULO__CHORD_STEPS; k++) {
    if (ambulo__evaluate(e->workspace, y)) {
      ambulo__run_fault(e->run, &e->workspace->fault);
      return 0;
    }
    double error = ambulo__engine_equality_error(e);
    if (error <= e->retraction->tolerance) return 1;
    if (least <= AMBULO__ROUNDING && error > 0.5 * least)
      return 1; /* as near as rounding lets it */
    if (isnan(error)) return 0;
    least = fmin(least, error);
    chord(e, y);
    for (int j = 0; j < e->setup->n; j++) {
      if (!isfinite(y[j])) return 0;
    }
  }
  return 0;
}

/* one pass of (A): z, and S J_k z and its weighted form, whose square is *left; the right-hand side
 * in the scratch's gradient */
static ambulo_status adjoint_pass(ambulo__engine *e, double scale, const double *p, const double *l,
                                  double *z, double *left) {
  ambulo__retraction *r = e->retraction;
  ambulo__kkt *kkt = &e->linearized.kkt;
  ambulo_status status = ambulo__engine_gradient(e, scale, p, l, r->gradient);
  if (status) return status;
  double begin = ambulo__seconds_now();
  memcpy(z, r->gradient, (size_t)e->setup->n * sizeof *z);
  ambulo__kkt_pass(kkt, z, NULL, NULL);
  ambulo__sparse_rows_multiply(&e->setup->rows->equality, z, r->along);
  *left = 0.0;
  for (int i = 0; i < e->setup->equalities; i++) {
    r->force[i] = -kkt->penalty[i] * r->along[i];
    r->balanced[i] = sqrt(kkt->penalty[i]) * r->along[i];
    *left += r->balanced[i] * r->balanced[i];
  }
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  return AMBULO_OK;
}

/* the next pass with J_k in the place of J: no sweep */
static void adjoint_chord(ambulo__engine *e, double *z) {
  ambulo__retraction *r = e->retraction;
  double begin = ambulo__seconds_now();
  memset(r->step, 0, (size_t)e->setup->n * sizeof *r->step);
  ambulo__sparse_rows_add_transpose(&e->setup->rows->equality, 1.0, r->force, r->step);
  ambulo__kkt_pass(&e->linearized.kkt, r->step, NULL, NULL);
  for (int j = 0; j < e->setup->n; j++) z[j] += r->step[j];
  e->run->seconds_linear += ambulo__seconds_now() - begin;
}

/* (P.9) H z + C'm = G + J'l */
ambulo_status ambulo__reduced_gradient(ambulo__engine *e, double scale, const double *p, double *l,
                                       double *z) {
  ambulo__retraction *r = e->retraction;
  ambulo__mixing_reset(&r->adjoint);
  for (int k = 0; k < AMBULO__ADJOINT_PASSES; k++) {
    double left, size = 0.0;
    ambulo_status status = adjoint_pass(e, scale, p, l, z, &left);
    if (status || e->setup->equalities == 0) return status;
    for (int i = 0; i < e->setup->equalities; i++) l[i] += r->force[i];
    for (int j = 0; j < e->setup->n; j++) size += z[j] * r->gradient[j];
    double limit = r->adjoint_tolerance * sqrt(fabs(size)) + AMBULO__ADJOINT_FLOOR;
    if (left <= limit * limit) {
      adjoint_chord(e, z);
      break;
    }
    ambulo__mixing_apply(&r->adjoint, r->balanced, l);
  }
  return AMBULO_OK;
}
