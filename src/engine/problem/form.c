/* problem/form.c - what the forms of composite terms are made with (term.h). */
#include "problem/term.h"

#include "base/lanes.h"

#include <math.h>

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
