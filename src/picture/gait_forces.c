/* picture/gait_forces.c - forces of the ground on each foot, in body weights: upward and forward.
 *
 * A foot's side is that of its heel at q = 0: left where it stands further along left. */
#include <math.h>

#include "model/neutral_pose.h"
#include "picture/gait_chart.h"
#include "picture/svg.h"

enum { MOST_FEET = 2 };

static double along_left(const ambulo_model *model, int foot) {
  double r[3];
  ambulo__neutral_point(model, model->feet[foot].heel_center, r);
  return r[0] * model->left[0] + r[1] * model->left[1] + r[2] * model->left[2];
}

static void draw_force(ambulo__gait_chart *c, const double direction[3], double *values,
                       const char *title, ambulo__text_buffer *text) {
  const ambulo__stride *s = c->stride;
  const int columns[MOST_FEET] = {0, 1};
  int left = along_left(s->model, 1) > along_left(s->model, 0);
  for (int k = 0; k < s->samples; k++) {
    for (int foot = 0; foot < s->feet; foot++)
      values[k * s->feet + foot] = ambulo__stride_force(s, k, foot, direction);
  }
  ambulo__svg_label(text, "panel", c->box.x, c->box.y - 14.0, title);
  ambulo__chart_range(c, columns, s->feet);
  ambulo__chart_grid(c, text);
  for (int foot = s->feet - 1; foot >= 0; foot--)
    ambulo__chart_curve(c, foot, foot == left ? AMBULO__LEFT : AMBULO__RIGHT, text);
  ambulo__panel axis = c->box;
  axis.y += c->box.height;
  ambulo__time_axis(&axis, 4, "s", text);
}

ambulo_status ambulo__gait_forces(const ambulo__stride *stride, const ambulo__panel *panel,
                                  ambulo__text_buffer *text) {
  const double label_room = 44.0, gap = 30.0;
  if (stride->feet != MOST_FEET) return AMBULO_OK;
  size_t count = (size_t)stride->samples * MOST_FEET;
  double *values = ambulo__alloc(&text->allocator, count, sizeof *values);
  if (!values) return AMBULO_E_MEMORY;
  double width = 0.5 * (panel->width - gap) - label_room;
  ambulo__gait_chart up = {
      .box = {panel->x + label_room, panel->y, width, panel->height, stride->duration},
      .stride = stride,
      .values = values,
      .columns = stride->feet,
      .factor = 1.0};
  ambulo__gait_chart ahead = up;
  ahead.box.x += width + label_room + gap;
  draw_force(&up, stride->model->up, values, "Ground reaction upward, body weights", text);
  draw_force(&ahead, stride->model->forward, values, "Ground reaction forward, body weights", text);
  ambulo__free(&text->allocator, values);
  return AMBULO_OK;
}
