/* objective/mechanical_power.c - power of each joint per body mass, W/kg.
 *
 *     u_i = scale_i tau_i qd_i / m,   phi the smoothed absolute value: positive and
 *     negative work cost the same.
 *     du/dtau = scale qd / m,  du/dqd = scale tau / m
 */
#include "objective/term.h"

/* (13.f) |tau qd| / m */
void ambulo__mechanical_power_form(const ambulo_term *term, const ambulo__term_context *context,
                                   int node, int i, ambulo__form *form) {
  double factor = ambulo__term_scale(term, i) / ambulo_model_mass(context->model);
  if (factor == 0.0) return;
  int tau_channel = ambulo__channel_tau(&context->channels, i);
  int qd_channel = ambulo__channel_qd(&context->channels, i);
  double tau = ambulo__frame_value(context, node, tau_channel);
  double qd = ambulo__frame_value(context, node, qd_channel);
  form->u = factor * tau * qd;
  ambulo__form_add(form, tau_channel, 0, factor * qd);
  ambulo__form_add(form, qd_channel, 0, factor * tau);
}
