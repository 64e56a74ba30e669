/* problem/upright_term.c - the line from one point of the body to another stays vertical.
 *
 *     u_j = (p_to - p_from) . e_j / L,   e_0 = l x u,  e_1 = l,  u = -g / |g|, l left
 *
 * the horizontal direction cosines of the line (e_0 is the walking direction, level also where
 * the ground is not); L its length at q = 0. Where both points belong to one rigid
 * segment (hip centre and head of lower_body_18) that is its length, and u_j are direction cosines;
 * over several joints (hips and head of a whole body) it is a scale, and u_j how far the one is
 * off the other's plumb line, in lengths.
 */
#include "model/neutral_pose.h"
#include "problem/term.h"

#include <math.h>

double ambulo__upright_length(const ambulo_model *model, const int point[2]) {
  double a[3], b[3];
  ambulo__neutral_point(model, point[0], a);
  ambulo__neutral_point(model, point[1], b);
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
              (a[2] - b[2]) * (a[2] - b[2]));
}

/* e_0 or e_1: both unit, since gravity is perpendicular to left */
static void horizontal(const ambulo_model *model, int j, double e[3]) {
  const double *g = ambulo_model_gravity(model), *l = ambulo_model_left(model);
  double size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  for (int i = 0; i < 3; i++) {
    int a = (i + 1) % 3, b = (i + 2) % 3;
    e[i] = j == 1 ? l[i] : (l[b] * g[a] - l[a] * g[b]) / size;
  }
}

/* (13.h) horizontal direction cosines of a line of the body */
void ambulo__upright_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                          int j, ambulo__form *form) {
  double e[3];
  horizontal(context->model, j, e);
  double length = ambulo__upright_length(context->model, term->point);
  for (int end = 0; end < 2; end++) {
    double sign = end ? 1.0 : -1.0;
    for (int axis = 0; axis < 3; axis++) {
      double slope = sign * e[axis] / length;
      if (slope == 0.0) continue;
      int channel = ambulo__channel_point(&context->channels, term->point[end], axis);
      form->u += slope * ambulo__frame_value(context, node, channel);
      ambulo__form_add(form, channel, 0, slope);
    }
  }
}
