/* show/gait_held.c - see gait_held.h.
 *
 * A box is an upright rectangle about its centre of mass. What hands push, and a load without a
 * size, has an arrow: 1 m for 500 N of `force`, and a disc as other loads have.
 */
#include "show/gait_held.h"

#include "base/vector.h"
#include "contact/hold_times.h"
#include "show/svg.h"

#include <math.h>
#include <string.h>

static const double meters_per_newton = 1.0 / 500.0, barb = 6.0; /* barb: px */
static const double seen_from = 0.05;   /* of the window: an arrow is drawn */
static const double load_radius = 0.02; /* m, of 1 kg: as gait_worn.c */

/* what stands in a row of points, the middle of one or two hands */
static void middle_of(const ambulo_hold *hold, const double *points, double middle[3]) {
  int hands = hold->hand[1] >= 0 ? 2 : 1;
  for (int k = 0; k < 3; k++) {
    middle[k] = 0.0;
    for (int i = 0; i < hands; i++) middle[k] += points[3 * hold->hand[i] + k] / hands;
  }
}

ambulo_status ambulo__held_places_create(const ambulo_problem *p, const double *x,
                                         const ambulo_allocator *allocator,
                                         ambulo__held_places *places) {
  const ambulo_problem_definition *d = &p->definition;
  size_t points = 3 * (size_t)p->model->point_count;
  *places = (ambulo__held_places){.count = 0};
  if (d->hold_count == 0) return AMBULO_OK;
  ambulo_workspace *workspace = NULL;
  double *at = ambulo__alloc(allocator, 2 * points, sizeof *at);
  places->place = ambulo__alloc(allocator, (size_t)d->hold_count, sizeof *places->place);
  ambulo_status status = at && places->place ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__workspace_create_for_values(p, allocator, &workspace);
  for (; !status && places->count < d->hold_count; places->count++) {
    const ambulo_hold *hold = &d->holds[places->count];
    const double times[2] = {fmax(hold->from, 0.0), fmin(hold->to, d->duration)};
    const ambulo_motion motion = {.size = sizeof motion, .points = at};
    status = ambulo_problem_motion(p, workspace, x, 2, times, &motion);
    if (status == AMBULO_E_NUMERIC) status = AMBULO_OK; /* still shown, as far as it goes */
    for (int end = 0; end < 2; end++)
      middle_of(hold, at + (size_t)end * points, places->place[places->count][end]);
  }
  ambulo_workspace_free(workspace);
  ambulo__free(allocator, at);
  return status;
}

static void hand_at(const ambulo_problem *p, const ambulo__pose *pose, int point, double at[3]) {
  const ambulo_point *of = &p->model->points[point];
  ambulo__pose_point(pose, of->link, of->position, at);
}

/* -1 before it is taken up, 1 after it is set down, 0 while it is held, which may be all along */
static int stands(const ambulo_problem *p, const ambulo_hold *hold, double time) {
  if (hold->from > 0.0 && time <= hold->from) return -1;
  return hold->to < p->definition.duration && time >= hold->to;
}

/* the middle of the hands while it is held, else where it stands */
static void place_of(const ambulo_problem *p, const ambulo_hold *hold, const double ends[2][3],
                     const ambulo__pose *pose, double time, double place[3]) {
  int standing = stands(p, hold, time);
  double other[3];
  if (standing != 0) {
    memcpy(place, ends[standing > 0], 3 * sizeof *place);
    return;
  }
  hand_at(p, pose, hold->hand[0], place);
  if (hold->hand[1] < 0) return;
  hand_at(p, pose, hold->hand[1], other);
  for (int k = 0; k < 3; k++) place[k] = 0.5 * (place[k] + other[k]);
}

static void draw_box(const ambulo_hold *hold, double x, double y, double scale,
                     ambulo__text_buffer *text) {
  double width = scale * hold->size[0], height = scale * hold->size[2];
  if (width > 0.0 && height > 0.0)
    ambulo__svg_rectangle(text, "box", x - 0.5 * width, y - 0.5 * height, width, height);
  else if (hold->mass > 0.0)
    ambulo__svg_circle(text, "load", x, y, scale * load_radius * cbrt(hold->mass));
}

static void draw_arrow(const ambulo_hold *hold, double x, double y, double scale,
                       ambulo__text_buffer *text) {
  double forward = hold->force[0], up = hold->force[2], force = hypot(forward, up);
  if (!(force > 0.0)) return;
  double length = scale * meters_per_newton, tip[2] = {x + length * forward, y - length * up};
  double along[2] = {forward / force, -up / force};
  ambulo__svg_line(text, "push", x, y, tip[0], tip[1]);
  for (int side = -1; side <= 1; side += 2)
    ambulo__svg_line(text, "push", tip[0], tip[1],
                     tip[0] - barb * (along[0] + 0.6 * side * along[1]),
                     tip[1] - barb * (along[1] - 0.6 * side * along[0]));
}

void ambulo__gait_held_draw(const ambulo_problem *p, const ambulo__held_places *places,
                            const ambulo__pose *pose, const ambulo__figure_view *v,
                            ambulo__text_buffer *text) {
  const ambulo_model *m = p->model;
  for (int i = 0; i < places->count; i++) {
    const ambulo_hold *hold = &p->definition.holds[i];
    double place[3];
    place_of(p, hold, (const double(*)[3])places->place[i], pose, v->time, place);
    double forward = ambulo__dot(m->forward, place) - v->origin;
    double up = ambulo__dot(m->up, place) - p->definition.ground_height;
    double x = v->x + v->scale * forward, y = v->base - v->scale * up;
    /* what stands is beside other figures too */
    if (!isfinite(x + y) || (stands(p, hold, v->time) != 0 && fabs(forward) > v->half)) continue;
    draw_box(hold, x + v->scale * hold->center[0], y - v->scale * hold->center[2], v->scale, text);
    if (ambulo__hold_window(hold, p->definition.duration, v->time) > seen_from)
      draw_arrow(hold, x, y, v->scale, text);
  }
}
