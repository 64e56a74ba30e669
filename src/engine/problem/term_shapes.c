/* problem/term_shapes.c - what the laws of terms are made of: scalar functions, curves of joints,
 * and residuals in several channels (term.h). */
#include "problem/term.h"

#include "base/lanes.h"

#include <math.h>

/* ---------------------------------------------------------------------- shapes */

/* The scalar functions phi(u) that terms are made of.
 *
 *   squared     u^2                                   phi' = 2 u, phi'' = 2
 *   absolute    sqrt(u^2 + s^2) - s                   phi' = u / sqrt(u^2 + s^2)
 *   power law   (u^2 + s^2)^(p/2) - s^p, p >= 2       phi' = p u (u^2 + s^2)^(p/2 - 1)
 *                        phi'' = p (u^2 + s^2)^(p/2 - 1) (1 + (p - 2) u^2 / (u^2 + s^2))
 *
 *   two prices  (1 + n)/2 (sqrt(u^2 + s^2) - s) + (1 - n)/2 u, n <= 1: what is positive at 1,
 *               what is negative at n: phi' = (1 + n)/2 u / sqrt(u^2 + s^2) + (1 - n)/2
 *
 * The smoothed absolute value tends to |u| as s -> 0 (the seed's Fig. 5b). The curvature
 * handed out for it is phi'(u) / u = 1 / sqrt(u^2 + s^2), that of the parabola which touches
 * phi at u and lies above it everywhere (concavity of sqrt in u^2): reweighted least squares. Of
 * two prices it is (1 + n)/2 of that: what is linear in u has none.
 * Written as u^2 / (sqrt(u^2 + s^2) + s), phi loses no digits for small u.
 */

/* (13.a) u^2 */
ambulo__residual ambulo__squared(double u) {
  ambulo__residual r = {u * u, 2.0 * u, 2.0};
  return r;
}

/* (13.b) sqrt(u^2 + s^2) - s */
ambulo__residual ambulo__absolute(double u, double smoothing) {
  double square = u * u + smoothing * smoothing;
  /* where squares neither overflow nor vanish, which a root is quicker for */
  double root = square > 1e-280 && square < 1e280 ? sqrt(square) : hypot(u, smoothing);
  ambulo__residual r = {u * (u / (root + smoothing)), u / root, 1.0 / root};
  return r;
}

/* (13.o) (1 + n)/2 (sqrt(u^2 + s^2) - s) + (1 - n)/2 u */
ambulo__residual ambulo__two_prices(double u, double smoothing, double negative) {
  ambulo__residual r = ambulo__absolute(u, smoothing);
  double even = 0.5 * (1.0 + negative), odd = 0.5 * (1.0 - negative);
  if (negative == 1.0) return r;
  return (ambulo__residual){even * r.value + odd * u, even * r.slope + odd, even * r.curvature};
}

double ambulo__power_least(double power, double smoothing) {
  return power == 3.0 ? smoothing * smoothing * smoothing : pow(smoothing, power);
}

/* (13.d) (u^2 + s^2)^(p/2) - s^p */
ambulo__residual ambulo__power_law(double u, double power, double smoothing, double least) {
  double square = u * u + smoothing * smoothing;
  double lower = power == 3.0 ? sqrt(square) : pow(square, 0.5 * power - 1.0);
  double share = square > 0.0 ? u * u / square : 0.0;
  ambulo__residual r = {square * lower - least, power * u * lower,
                        power * lower * (1.0 + (power - 2.0) * share)};
  return r;
}

/* -------------------------------------------------------- curves of joints */

/* Torques of joints as functions of their angle.
 *
 *   passive torque   b1 exp(k1 q) + b2 exp(k2 q), N m
 *   strength         peak cos(c2 (q - c3)), N m; below a tenth of the peak it bends over to
 *                    stay positive: with x = cos(..), y = x for x >= 0.1 and
 *                    y = 0.1 exp((x - 0.1) / 0.1) below (value and slope continuous)
 *
 * Source: Anderson, Madigan & Nussbaum, J Biomech 40 (2007) 3105-3113, Eqs. 1-2; the bend
 * is ours, because the cosine turns negative at angles that were never measured.
 */

static const double least_share = 0.1;

/* (13.e) passive torque */
double ambulo__passive_torque(const double curve[4], double q, double *derivative) {
  double first = curve[0] * exp(curve[1] * q), second = curve[2] * exp(curve[3] * q);
  *derivative = curve[1] * first + curve[3] * second;
  return first + second;
}

/* (13.e) strength at an angle and a rate */
double ambulo__strength(const double curve[3], double q, double *derivative) {
  double angle = curve[1] * (q - curve[2]);
  double share = cos(angle), slope = -curve[1] * sin(angle);
  if (share < least_share) {
    share = least_share * exp((share - least_share) / least_share);
    slope *= share / least_share;
  }
  *derivative = curve[0] * slope;
  return curve[0] * share;
}

/* ------------------------------------------------- residuals in several channels */

double ambulo__term_scale(const ambulo_term *term, int i) {
  return term->scale ? term->scale[i] : 1.0;
}

double ambulo__frame_value(const ambulo__term_context *context, int node, int channel) {
  return context->lanes[ambulo__lane_index(node, context->channel_count, channel)];
}

void ambulo__form_add(ambulo__form *form, int channel, int ahead, double slope) {
  if (form->count == AMBULO__FORM_CHANNELS) {
    form->u = NAN;
    return;
  }
  form->channel[form->count] = channel;
  form->ahead[form->count] = ahead;
  form->slope[form->count] = slope;
  form->count++;
}

double ambulo__air_part(const ambulo__term_context *context, int node, int foot) {
  int at = node * ambulo_model_foot_count(context->model) + foot, in_air = context->active[at] < 0;
  if (!context->before || (context->before[at] < 0) == in_air) return in_air;
  const double *t = context->times;
  double before = node > 0 ? t[node] - t[node - 1] : 0.0;
  double after = node + 1 < context->nodes ? t[node + 1] - t[node] : 0.0;
  return (in_air ? after : before) / (before + after);
}
