/* method/retraction.c - points on the equalities' surface, and gradients along it.
 *
 * Around a centre y_k with metric H, gradients J_k of the local equalities h and the border
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
 * GMRES. |z - z'|^2 in the metric M is (z - z') . (r - r'), r the right-hand sides.
 */
#include "method/engine.h"
#include "method/parameters.h"

#include <math.h>
#include <string.h>

static void chord(ambulo__engine *e, double *y) {
  double begin = ambulo__seconds_now();
  for (int i = 0; i < e->equalities; i++) {
    e->dual[i] = -e->kkt.penalty[i] * e->h[i];
    e->balanced[i] = sqrt(e->kkt.penalty[i]) * e->h[i];
  }
  for (int i = 0; i < e->borders; i++) e->b[i] = -e->b[i];
  memset(e->step, 0, (size_t)e->n * sizeof *e->step);
  ambulo__sparse_rows_add_transpose(&e->rows.equality, 1.0, e->dual, e->step);
  ambulo__kkt_pass(&e->kkt, e->step, e->b, NULL);
  for (int j = 0; j < e->n; j++) y[j] += e->step[j];
  ambulo__mixing_apply(&e->retraction, e->balanced, y);
  e->run->seconds_linear += ambulo__seconds_now() - begin;
}

/* (P.8) chord steps onto h = 0, C y = b */
int ambulo__retract(ambulo__engine *e, double *y) {
  double least = HUGE_VAL;
  ambulo__mixing_reset(&e->retraction);
  for (int k = 0; k < AMBULO__CHORD_STEPS; k++) {
    if (ambulo__evaluate(e->workspace, y)) {
      ambulo__run_fault(e->run, &e->workspace->fault);
      return 0;
    }
    double error = ambulo__engine_equality_error(e);
    if (error <= e->retraction_tolerance) return 1;
    if (least <= AMBULO__ROUNDING && error > 0.5 * least)
      return 1; /* as near as rounding lets it */
    if (isnan(error)) return 0;
    least = fmin(least, error);
    chord(e, y);
    for (int j = 0; j < e->n; j++) {
      if (!isfinite(y[j])) return 0;
    }
  }
  return 0;
}

/* one pass of (A); l moves. Right-hand side in engine->gradient. */
static ambulo_status adjoint_pass(ambulo__engine *e, const double *p, double *z) {
  double *l = e->equality_multiplier;
  ambulo_status status = ambulo__engine_gradient(e, p, l, e->gradient);
  if (status) return status;
  double begin = ambulo__seconds_now();
  memcpy(z, e->gradient, (size_t)e->n * sizeof *z);
  ambulo__kkt_pass(&e->kkt, z, NULL, NULL);
  ambulo__sparse_rows_multiply(&e->rows.equality, z, e->h);
  for (int i = 0; i < e->equalities; i++) {
    l[i] -= e->kkt.penalty[i] * e->h[i];
    e->balanced[i] = sqrt(e->kkt.penalty[i]) * e->h[i];
  }
  ambulo__mixing_apply(&e->adjoint, e->balanced, l);
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  return AMBULO_OK;
}

/* (P.9) H z + C'm = G + J'l */
ambulo_status ambulo__reduced_gradient(ambulo__engine *e, const double *p, double *z) {
  ambulo__mixing_reset(&e->adjoint);
  for (int k = 0; k < AMBULO__ADJOINT_PASSES; k++) {
    ambulo_status status = adjoint_pass(e, p, z);
    if (status) return status;
    double size = 0.0, change = 0.0;
    for (int j = 0; j < e->n; j++) {
      size += z[j] * e->gradient[j];
      change += (z[j] - e->previous[j]) * (e->gradient[j] - e->previous_right[j]);
    }
    memcpy(e->previous, z, (size_t)e->n * sizeof *z);
    memcpy(e->previous_right, e->gradient, (size_t)e->n * sizeof *z);
    if (e->equalities == 0) break;
    double limit = e->adjoint_tolerance * sqrt(fabs(size)) + AMBULO__ADJOINT_FLOOR;
    if (k > 0 && fabs(change) <= limit * limit) break;
  }
  return AMBULO_OK;
}
