/* show/gait_forces.c - forces on each foot and on each patch in contact, in body weights: upward
 * and forward.
 *
 * A foot's side is that of its heel at q = 0: of two left where it stands further along left.
 */
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "contact/effector.h"
#include "model/neutral_pose.h"
#include "show/gait_chart.h"
#include "show/svg.h"

enum { MOST_CURVES = 16 };

/* the curves: effectors and the colours that they have */
typedef struct curves {
  int count, effector[MOST_CURVES], column[MOST_CURVES];
  ambulo__side side[MOST_CURVES];
} curves;

static double along_left(const ambulo_model *model, int foot) {
  double r[3];
  ambulo__neutral_point(model, model->feet[foot].heel_center, r);
  return r[0] * model->left[0] + r[1] * model->left[1] + r[2] * model->left[2];
}

static ambulo__side side_of(const ambulo_model *model, int effector) {
  int patch = ambulo__effector_patch(model, effector);
  if (patch >= 0) return ambulo__gait_patch_side(model, patch);
  double other = model->foot_count == 2 ? along_left(model, 1 - effector) : 0.0;
  return along_left(model, effector) > other ? AMBULO__LEFT : AMBULO__RIGHT;
}

static curves curves_of(const ambulo__stride *s) {
  curves all = {.count = 0};
  for (int e = 0; e < s->feet + s->patches && all.count < MOST_CURVES; e++) {
    if (!ambulo__gait_shows(s, e)) continue;
    all.effector[all.count] = e;
    all.side[all.count] = side_of(s->model, e);
    all.column[all.count] = all.count;
    all.count++;
  }
  return all;
}

static double force_along(const ambulo__stride *s, int k, int effector, const double direction[3]) {
  int patch = ambulo__effector_patch(s->model, effector);
  if (patch < 0) return ambulo__stride_force(s, k, effector, direction);
  return ambulo__dot(ambulo__stride_patch_force(s, k, patch), direction) /
         ambulo__model_weight(s->model);
}

/* the people's, behind the two feet */
static void draw_people(ambulo__gait_chart *c, const char *name, ambulo__gait_people *people,
                        ambulo__text_buffer *text) {
  ambulo__people_curve right = ambulo__people_force(people, name, AMBULO__RIGHT);
  ambulo__people_curve left = ambulo__people_force(people, name, AMBULO__LEFT);
  ambulo__chart_widen(c, &right);
  ambulo__chart_widen(c, &left);
  ambulo__chart_grid(c, text);
  int both = ambulo__chart_alike(c, &left, &right);
  if (!both) ambulo__chart_people(c, &right, 0, text);
  ambulo__chart_people(c, &left, both, text);
  people->shown[left.file] += left.curve != NULL;
}

static void draw_force(ambulo__gait_chart *c, const curves *all, const char *name, double *values,
                       ambulo__gait_people *people, ambulo__text_buffer *text) {
  const ambulo__stride *s = c->stride;
  int upward = strcmp(name, "up") == 0;
  const double *direction = upward ? s->model->up : s->model->forward;
  for (int k = 0; k < s->samples; k++) {
    for (int i = 0; i < all->count; i++)
      values[k * all->count + i] = force_along(s, k, all->effector[i], direction);
  }
  ambulo__svg_label(text, "panel", c->box.x, c->box.y - 14.0,
                    people->per_kg
                        ? upward ? "Ground reaction upward, N/kg" : "Ground reaction forward, N/kg"
                    : upward ? "Ground reaction upward, body weights"
                             : "Ground reaction forward, body weights");
  ambulo__chart_range(c, all->column, all->count);
  draw_people(c, name, people, text);
  for (int i = all->count - 1; i >= 0; i--) ambulo__chart_curve(c, i, all->side[i], text);
  ambulo__chart_axis(c, text);
}

ambulo_status ambulo__gait_forces(const ambulo__stride *stride, const ambulo__panel *panel,
                                  const ambulo__gait_style *style, ambulo__gait_people *people,
                                  ambulo__text_buffer *text) {
  const double label_room = 44.0, gap = 30.0;
  curves all = curves_of(stride);
  if (all.count == 0) return AMBULO_OK;
  size_t count = (size_t)stride->samples * (size_t)all.count;
  double *values = ambulo__alloc(&text->allocator, count, sizeof *values);
  if (!values) return AMBULO_E_MEMORY;
  double width = 0.5 * (panel->width - gap) - label_room;
  double mass = ambulo__gait_mass(stride->model);
  ambulo__gait_chart up = {.box = {panel->x + label_room, panel->y, width, panel->height,
                                   style->percent ? 100.0 : stride->duration},
                           .stride = stride,
                           .values = values,
                           .columns = all.count,
                           .factor =
                               style->per_kg ? ambulo__model_weight(stride->model) / mass : 1.0,
                           .cycles = style->percent ? people : NULL};
  ambulo__gait_chart ahead = up;
  ahead.box.x += width + label_room + gap;
  draw_force(&up, &all, "up", values, people, text);
  draw_force(&ahead, &all, "forward", values, people, text);
  ambulo__free(&text->allocator, values);
  return AMBULO_OK;
}
