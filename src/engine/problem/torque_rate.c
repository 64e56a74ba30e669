/* problem/torque_rate.c - how fast joint torques change.
 *
 *     u_i = scale_i (tau_i(t_k+1) - tau_i(t_k)) / (t_k+1 - t_k),   one residual per interval,
 *     booked on its first node (N m/s times scale)
 */
#include "problem/term.h"

/* (13.g) (tau_k+1 - tau_k) / dt */
void ambulo__torque_rate_form(const ambulo_term *term, const ambulo__term_context *context,
                              int node, int i, ambulo__form *form) {
  double step = context->times[node + 1] - context->times[node];
  double factor = ambulo__term_scale(term, i) / step;
  if (factor == 0.0) return;
  int channel = ambulo__channel_tau(&context->channels, i);
  double now = ambulo__frame_value(context, node, channel);
  double next = ambulo__frame_value(context, node + 1, channel);
  form->u = form->difference = factor * (next - now);
  ambulo__form_add(form, channel, 0, -factor);
  ambulo__form_add(form, channel, 1, factor);
}
