/* contact/foot_frame.c - direction cosines of a foot (foot_frame.h). */
#include "contact/foot_frame.h"

#include "model/neutral_pose.h"

#include <math.h>

/* direction . (to - from) / |to - from|, the distance taken at q = 0 */
static ambulo__linear cosine(const ambulo__gait_context *context, int from, int to,
                             const double direction[3]) {
  ambulo__linear form = {.count = 0};
  double a[3], b[3], square = 0.0;
  ambulo__neutral_point(context->model, from, a);
  ambulo__neutral_point(context->model, to, b);
  for (int i = 0; i < 3; i++) square += (b[i] - a[i]) * (b[i] - a[i]);
  double factor = square > 0.0 ? 1.0 / sqrt(square) : 0.0;
  ambulo__linear_add(&form, ambulo__channel_point(&context->channels, to, 0), direction, factor);
  ambulo__linear_add(&form, ambulo__channel_point(&context->channels, from, 0), direction, -factor);
  return form;
}

ambulo__linear ambulo__foot_yaw(const ambulo__gait_context *context, int foot,
                                const double left[3]) {
  const ambulo_foot *f = &context->model->feet[foot];
  return cosine(context, f->heel_center, f->toe_center, left);
}

ambulo__linear ambulo__foot_pitch(const ambulo__gait_context *context, int foot,
                                  const double up[3]) {
  const ambulo_foot *f = &context->model->feet[foot];
  return cosine(context, f->heel_center, f->toe_center, up);
}

ambulo__linear ambulo__foot_roll(const ambulo__gait_context *context, int foot,
                                 const double up[3]) {
  const ambulo_model *model = context->model;
  const int *corner = model->feet[foot].heel;
  ambulo__linear none = {.count = 0};
  if (corner[1] < 0) return none;
  double a[3], b[3], across = 0.0;
  ambulo__neutral_point(model, corner[0], a);
  ambulo__neutral_point(model, corner[1], b);
  for (int i = 0; i < 3; i++) across += model->left[i] * (b[i] - a[i]);
  return across >= 0.0 ? cosine(context, corner[0], corner[1], up)
                       : cosine(context, corner[1], corner[0], up);
}

double ambulo__foot_length(const ambulo_model *model, int foot) {
  double a[3], b[3], square = 0.0;
  ambulo__neutral_point(model, model->feet[foot].heel_center, a);
  ambulo__neutral_point(model, model->feet[foot].toe_center, b);
  for (int i = 0; i < 3; i++) square += (b[i] - a[i]) * (b[i] - a[i]);
  return sqrt(square);
}
