/* problem/force_rate.c - how fast the forces on contacts change.
 *
 *     u = (f(t_k+1) - f(t_k)) / (dt r m g),   r = 10 / s,   one residual per contact slot, axis and
 *     interval, booked on its first node (1: ten body weights a second)
 *
 * What shares the load among contacts prices forces, not their changes: loading fast would be free.
 */
#include "problem/term.h"

#include <math.h>

static const double reference_rate = 10.0; /* body weights per s: people's fastest at strike */

int ambulo__force_rate_forms(const ambulo__term_context *context, int node) {
  return node + 1 < context->nodes ? 3 * context->channels.slots : 0;
}

/* (13.k) (f_k+1 - f_k) / (dt 10 m g) */
void ambulo__force_rate_form(const ambulo__term_context *context, int node, int j,
                             ambulo__form *form) {
  const double *g = ambulo_model_gravity(context->model);
  double weight = ambulo_model_mass(context->model) * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  double step = context->times[node + 1] - context->times[node];
  double factor = 1.0 / (reference_rate * weight * step);
  int channel = ambulo__channel_foot_force(&context->channels, j / 3, j % 3);
  double now = ambulo__frame_value(context, node, channel);
  double next = ambulo__frame_value(context, node + 1, channel);
  form->u = form->difference = factor * (next - now);
  ambulo__form_add(form, channel, 0, -factor);
  ambulo__form_add(form, channel, 1, factor);
}
