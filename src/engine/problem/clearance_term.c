/* problem/clearance_term.c - feet in the air keep a height.
 *
 *     u = max(0, 1 - (n . p - h) / height),   phi = u^2,
 *
 * for the heel centre, the toe centre and, where there is one, the tip of every foot that is
 * in no contact at the node; n up, h the ground, height the one that is asked for. Zero, with
 * zero slope, for a point that is high enough. At a node on an event where a foot leaves the ground
 * or comes down, phi counts for the part of the node's time that it is in the air: u is times the
 * root of that part.
 *     du/dp = -n / height   where u > 0
 */
#include "problem/term.h"

#include <math.h>

enum { POINTS_OF_A_FOOT = 3 };

int ambulo__clearance_forms(const ambulo__term_context *context) {
  return POINTS_OF_A_FOOT * ambulo_model_foot_count(context->model);
}

int ambulo__clearance_foot(int j) {
  return j / POINTS_OF_A_FOOT;
}

double ambulo__air_part(const ambulo__term_context *context, int node, int foot) {
  int at = node * ambulo_model_foot_count(context->model) + foot, in_air = context->active[at] < 0;
  if (!context->before || (context->before[at] < 0) == in_air) return in_air;
  const double *t = context->times;
  double before = node > 0 ? t[node] - t[node - 1] : 0.0;
  double after = node + 1 < context->nodes ? t[node + 1] - t[node] : 0.0;
  return (in_air ? after : before) / (before + after);
}

void ambulo__clearance_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                            int j, ambulo__form *form) {
  int f = ambulo__clearance_foot(j), which = j % POINTS_OF_A_FOOT;
  const ambulo_foot *foot = ambulo_model_foot(context->model, f);
  double part = ambulo__air_part(context, node, f), root = sqrt(part);
  if (part == 0.0 || (which == 2 && !foot->has_tip)) return;
  int point = which == 0 ? foot->heel_center : which == 1 ? foot->toe_center : foot->tip;
  const double *up = ambulo_model_up(context->model);
  double height = -context->ground_height;
  for (int axis = 0; axis < 3; axis++) {
    int channel = ambulo__channel_point(&context->channels, point, axis);
    height += up[axis] * ambulo__frame_value(context, node, channel);
  }
  form->u = root * (1.0 - height / term->height);
  if (form->u <= 0.0) {
    form->u = 0.0;
    return;
  }
  for (int axis = 0; axis < 3; axis++) {
    if (up[axis] == 0.0) continue;
    ambulo__form_add(form, ambulo__channel_point(&context->channels, point, axis), 0,
                     -root * up[axis] / term->height);
  }
}
