/* problem/device_effort.c - what devices do, where that is to cost something too.
 *
 *     u_i = scale_i E_i,   E_i the effort of device i, N m or N
 */
#include "problem/term.h"

int ambulo__device_effort_forms(const ambulo__term_context *context) {
  return context->channels.devices;
}

/* (13.l) scale E */
void ambulo__device_effort_form(const ambulo_term *term, const ambulo__term_context *context,
                                int node, int i, ambulo__form *form) {
  double scale = term->device_scale ? term->device_scale[i] : 1.0;
  int channel = ambulo__channel_effort(&context->channels, i);
  if (scale == 0.0) return;
  form->u = scale * ambulo__frame_value(context, node, channel);
  ambulo__form_add(form, channel, 0, scale);
}
