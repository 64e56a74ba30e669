/* problem/ground_force_term.c - the total ground reaction stays near the body weight.
 *
 *     u_j = F_j / (m g) - n_j,   F the root force (15'), n the unit vector against gravity
 */
#include "problem/term.h"

#include <math.h>

/* (13.i) F / (m g) - n */
void ambulo__ground_force_form(const ambulo__term_context *context, int node, int axis,
                               ambulo__form *form) {
  const double *g = ambulo_model_gravity(context->model);
  double size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  double weight = ambulo_model_mass(context->model) * size;
  int channel = ambulo__channel_force(&context->channels, axis);
  form->u = ambulo__frame_value(context, node, channel) / weight + g[axis] / size;
  ambulo__form_add(form, channel, 0, 1.0 / weight);
}
