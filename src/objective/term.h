/* objective/term.h - objective terms as functions of channels.
 *
 * A term is a sum over nodes and channels of scalar functions phi of one scaled
 * residual u = scale (channel - offset):
 *
 *     J_term = weight * sum_k w_k sum_i phi(u_ik),    w_k trapezoidal, s
 *
 * so its gradient and its (Gauss-Newton) curvature are diagonal in channel space:
 *     slope = weight w_k phi'(u) scale,   curvature = weight w_k phi''(u) scale^2 >= 0.
 * phi'' of the absolute torque is replaced by phi'(u)/u, the curvature of the
 * quadratic that majorizes it (iteratively reweighted least squares).
 *
 * User terms are arbitrary functions of a node; they offer a gradient only, and
 * contribute no curvature.
 */
#ifndef AMBULO_OBJECTIVE_TERM_H
#define AMBULO_OBJECTIVE_TERM_H

#include "ambulo/problem.h"
#include "gait/channels.h"

/* One scalar residual of a term. */
typedef struct ambulo__residual {
  double value, slope, curvature;   /* phi, phi', phi'' of u */
} ambulo__residual;

/* phi of each kind at u. */
ambulo__residual ambulo__torque_squared(double u);
ambulo__residual ambulo__torque_absolute(double u, double smoothing);
ambulo__residual ambulo__acceleration(double u);
ambulo__residual ambulo__tracking(double u);

/* What the evaluation needs to know about a term. */
typedef struct ambulo__term_info {
  const char *name;     /* as written in problem files */
  int uses_tau, uses_qdd, uses_q;
} ambulo__term_info;
const ambulo__term_info *ambulo__term_info_of(ambulo_term_kind kind);  /* NULL if unknown */

/* The residual of `term` on coordinate i: its channel, scale, offset at node k. */
int ambulo__term_channel(const ambulo_term *term, const ambulo__channels *channels, int i);
double ambulo__term_scale(const ambulo_term *term, int i);
double ambulo__term_offset(const ambulo_term *term, int coordinates, int node, int i);
ambulo__residual ambulo__term_residual(const ambulo_term *term, double u);

#endif
