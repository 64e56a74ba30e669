/* problem/strength.c - active torque as a share of what the joint can give at its angle.
 *
 *     active_i = tau_i - offset_i - passive_i(q_i),   u_i = scale_i active_i / strength_i(q_i)
 *
 * passive: b1 exp(k1 q) + b2 exp(k2 q), strength: peak cos(c2 (q - c3)) with one set of
 * constants for each direction (Anderson, Madigan & Nussbaum, J Biomech 40, 2007, Eqs. 1-2,
 * isometric part). u is continuous through active = 0, where the direction changes, and so is
 * the slope of every phi with phi'(0) = 0.
 *     du/dtau = scale / s,  du/dq = -scale passive' / s - u s' / s
 */
#include "problem/term.h"

/* (13.d) u: active torque over strength */
void ambulo__strength_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                           int i, ambulo__form *form) {
  double scale = ambulo__term_scale(term, i);
  if (scale == 0.0) return;
  int tau_channel = ambulo__channel_tau(&context->channels, i);
  int q_channel = ambulo__channel_q(&context->channels, i);
  double q = ambulo__frame_value(context, node, q_channel);
  double active = ambulo__frame_value(context, node, tau_channel);
  if (term->offset) active -= term->offset[i];
  double passive_slope = 0.0, strength = 1.0, strength_slope = 0.0;
  if (term->passive) active -= ambulo__passive_torque(&term->passive[4 * i], q, &passive_slope);
  if (term->strength) {
    const double *curve = &term->strength[6 * i + (active >= 0.0 ? 0 : 3)];
    if (curve[0] > 0.0) strength = ambulo__strength(curve, q, &strength_slope);
  }
  form->u = scale * active / strength;
  ambulo__form_add(form, tau_channel, 0, scale / strength);
  double slope = -scale * passive_slope / strength - form->u * strength_slope / strength;
  if (slope != 0.0) ambulo__form_add(form, q_channel, 0, slope);
}
