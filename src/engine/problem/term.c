/* problem/term.c - terms as functions of channels, by the table of their kinds (term.h). */
#include "problem/term.h"

#include "base/lanes.h"

#include <math.h>

int ambulo__term_has(const ambulo_term *term, int member) {
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  return info && info->members & member;
}

/* ------------------------------------------------------------ simple terms */

int ambulo__term_is_simple(const ambulo_term *term) {
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  if (!info || info->subject == AMBULO__TERM_OF_OTHERS) return 0;
  int has_curves = term->passive || term->strength;
  return !info->form || (info->members & AMBULO__TERM_CURVES && !has_curves);
}

int ambulo__term_is_rate(const ambulo_term *term) {
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  return info && (info->is_rate || (info->members & AMBULO__TERM_TENDON && term->tendon));
}

double ambulo__term_scale(const ambulo_term *term, int i) {
  return term->scale ? term->scale[i] : 1.0;
}

int ambulo__term_channel(const ambulo_term *term, const ambulo__channels *channels, int i) {
  ambulo__term_subject subject = ambulo__term_info_of(term->kind)->subject;
  if (subject == AMBULO__TERM_OF_ACCELERATION) return ambulo__channel_qdd(channels, i);
  if (subject == AMBULO__TERM_OF_POSITION) return ambulo__channel_q(channels, i);
  return ambulo__channel_tau(channels, i);
}

double ambulo__term_offset(const ambulo_term *term, int coordinates, int node, int i) {
  if (ambulo__term_has(term, AMBULO__TERM_REFERENCE))
    return term->reference[(size_t)node * (size_t)coordinates + (size_t)i];
  int has_offset = ambulo__term_has(term, AMBULO__TERM_OFFSET | AMBULO__TERM_REST);
  return has_offset && term->offset ? term->offset[i] : 0.0;
}

double ambulo__term_least(const ambulo_term *term) {
  return ambulo__term_info_of(term->kind)->shape == AMBULO__TERM_POWER_LAW
             ? ambulo__power_least(term->power, term->smoothing)
             : 0.0;
}

/* (13.c) u of the simple terms */
ambulo__residual ambulo__term_residual_from(const ambulo_term *term, double least, double u) {
  ambulo__term_shape shape = ambulo__term_info_of(term->kind)->shape;
  if (shape == AMBULO__TERM_ABSOLUTE) return ambulo__absolute(u, term->smoothing);
  if (shape == AMBULO__TERM_POWER_LAW)
    return ambulo__power_law(u, term->power, term->smoothing, least);
  return ambulo__squared(u);
}

/* (13.c) */
ambulo__residual ambulo__term_residual(const ambulo_term *term, double u) {
  return ambulo__term_residual_from(term, ambulo__term_least(term), u);
}

/* --------------------------------------------------------- composite terms */

int ambulo__term_forms(const ambulo_term *term, const ambulo__term_context *context, int node) {
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  if (!info->forms || (ambulo__term_is_rate(term) && node + 1 >= context->nodes)) return 0;
  return info->forms(context);
}

void ambulo__term_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                       int j, ambulo__form *form) {
  form->u = form->difference = 0.0;
  form->count = 0;
  ambulo__term_info_of(term->kind)->form(term, context, node, j, form);
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

/* ---------------------------------------------------------------------- shapes */

/* The scalar functions phi(u) that terms are made of.
 *
 *   squared     u^2                                   phi' = 2 u, phi'' = 2
 *   absolute    sqrt(u^2 + s^2) - s                   phi' = u / sqrt(u^2 + s^2)
 *   power law   (u^2 + s^2)^(p/2) - s^p, p >= 2       phi' = p u (u^2 + s^2)^(p/2 - 1)
 *                        phi'' = p (u^2 + s^2)^(p/2 - 1) (1 + (p - 2) u^2 / (u^2 + s^2))
 *
 * The smoothed absolute value tends to |u| as s -> 0 (the seed's Fig. 5b). The curvature
 * handed out for it is phi'(u) / u = 1 / sqrt(u^2 + s^2), that of the parabola which touches
 * phi at u and lies above it everywhere (concavity of sqrt in u^2): reweighted least squares.
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

/* --------------------------------------------------- eight nodes of a block at once */

/* Most terms are squares; theirs is a loop of fixed length that a compiler turns into vectors. */

void ambulo__term_lanes(const ambulo_term *term, int coordinates, int node, int nodes, int i,
                        const double *y, double *u) {
  double scale = ambulo__term_scale(term, i);
  double offset[AMBULO__LANES];
  if (ambulo__term_has(
          term,
          AMBULO__TERM_REFERENCE)) { /* the only offset that varies: none beyond the last node */
    for (int l = 0; l < AMBULO__LANES; l++)
      offset[l] = node + l < nodes ? ambulo__term_offset(term, coordinates, node + l, i) : y[l];
  } else {
    double same = ambulo__term_offset(term, coordinates, node, i);
    for (int l = 0; l < AMBULO__LANES; l++) offset[l] = same;
  }
  for (int l = 0; l < AMBULO__LANES; l++) u[l] = scale * (y[l] - offset[l]);
}

void ambulo__term_shapes(const ambulo_term *term, double least, const double *u, double *value,
                         double *slope) {
  if (ambulo__term_info_of(term->kind)->shape == AMBULO__TERM_SQUARED) {
    for (int l = 0; l < AMBULO__LANES; l++) {
      value[l] = u[l] * u[l];
      slope[l] = 2.0 * u[l];
    }
    return;
  }
  for (int l = 0; l < AMBULO__LANES; l++) {
    ambulo__residual residual = ambulo__term_residual_from(term, least, u[l]);
    value[l] = residual.value;
    slope[l] = residual.slope;
  }
}
