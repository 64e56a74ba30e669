/* show/gait_surroundings.c - what is drawn beside the body, seen from the side
 * (gait_surroundings.h): the ground, obstacles and places to reach, what hands hold.
 *
 * The surface of a contact at p with normal u rises by -u_f / u_n per metre forward. Two surfaces
 * that follow each other meet at the riser between their footholds.
 */
#include "show/gait_surroundings.h"

#include "base/arithmetic.h"
#include "contact/row_families.h"
#include "contact/contacts.h"
#include "contact/schedule.h"
#include "show/gait_svg.h"
#include "show/svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PERIODS_BEFORE = 2, PERIODS_AFTER = 3 };

static const double same_place = 1e-6; /* m */
static const double gap_below = 3.0;   /* px */

static int is_level(const ambulo_problem_definition *d) {
  if (d->rise != 0.0) return 0;
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    if (c->foot >= 0 && (c->place[2] != 0.0 || c->normal[0] != 0.0 || c->normal[1] != 0.0))
      return 0;
  }
  return 1;
}

static void add(ambulo__gait_ground *ground, const ambulo_contact *c, double forward, double up) {
  double slope = c->normal[2] > 0.0 ? -c->normal[0] / c->normal[2] : 0.0;
  ambulo__surface s = {.at = c->place[0] + forward, .height = c->place[2] + up, .slope = slope};
  for (int i = 0; i < ground->count; i++) {
    const ambulo__surface *other = &ground->surface[i];
    if (fabs(other->at - s.at) < same_place && fabs(other->height - s.height) < same_place) return;
  }
  ground->surface[ground->count++] = s;
}

static int by_place(const void *a, const void *b) {
  const ambulo__surface *one = a, *other = b;
  return (one->at > other->at) - (one->at < other->at);
}

/* of those that stand on the ground; there is one where it is not level */
static int first_foot(const ambulo_problem_definition *d) {
  int i = 0;
  while (d->contacts[i].foot < 0) i++;
  return d->contacts[i].foot;
}

ambulo_status ambulo__gait_ground_create(const ambulo_problem *problem,
                                         const ambulo_allocator *allocator,
                                         ambulo__gait_ground *ground) {
  const ambulo_problem_definition *d = &problem->definition;
  ambulo__gait_ground g = {.allocator = ambulo__allocator_or_default(allocator)};
  *ground = g;
  if (d->contact_count == 0 || is_level(d)) return AMBULO_OK;
  int before = d->ends == AMBULO_ENDS_FREE ? 0 : PERIODS_BEFORE;
  int after = d->ends == AMBULO_ENDS_FREE ? 0 : PERIODS_AFTER;
  size_t most = (size_t)(1 + before + after) * (size_t)d->contact_count;
  g.surface = ambulo__alloc(&g.allocator, most, sizeof *g.surface);
  if (!g.surface) return AMBULO_E_MEMORY;
  for (int period = -before; period <= after; period++)
    for (int i = 0; i < d->contact_count; i++)
      if (d->contacts[i].foot >= 0) add(&g, &d->contacts[i], period * d->travel, period * d->rise);
  *ground = g;
  if (g.count == 0) return AMBULO_OK; /* nothing stands on the ground */
  qsort(g.surface, (size_t)g.count, sizeof *g.surface, by_place);
  double reach = ambulo__foot_reach(d->model, first_foot(d));
  g.surface[0].from = -INFINITY;
  for (int i = 1; i < g.count; i++)
    g.surface[i].from = g.surface[i - 1].to =
        ambulo__riser_between(g.surface[i - 1].at, reach, g.surface[i].at);
  g.surface[g.count - 1].to = INFINITY;
  *ground = g;
  return AMBULO_OK;
}

void ambulo__gait_ground_free(ambulo__gait_ground *ground) {
  ambulo__free(&ground->allocator, ground->surface);
}

double ambulo__ground_slope(const ambulo_model *m) {
  return atan2(-ambulo__dot(m->forward, m->gravity), -ambulo__dot(m->up, m->gravity));
}

double ambulo__surface_height(const ambulo__surface *surface, double x) {
  return surface->height + surface->slope * (x - surface->at);
}

/* from left to right */
static void trace_ground(const ambulo__gait_ground *ground, const ambulo__figure_view *v,
                         double half, double lowest, ambulo__text_buffer *text) {
  int begun = 0;
  for (int i = 0; i < ground->count; i++) {
    const ambulo__surface *p = &ground->surface[i];
    double x[2] = {fmax(p->from, v->origin - half / v->scale),
                   fmin(p->to, v->origin + half / v->scale)};
    for (int e = 0; e < 2 && x[0] <= x[1]; e++) {
      double right = v->x + v->scale * (x[e] - v->origin);
      double down = v->base - v->scale * ambulo__surface_height(p, x[e]);
      /* what is far below the picture has no place in it */
      down = fmin(down, lowest);
      if (begun++)
        ambulo__svg_path_line(text, right, down);
      else
        ambulo__svg_path_move(text, right, down);
    }
  }
}

void ambulo__gait_ground_draw(const ambulo__gait_ground *ground, const ambulo__figure_view *v,
                              double half, double bottom, ambulo__text_buffer *text) {
  if (!isfinite(v->x + v->origin)) return;
  ambulo__svg_path_begin(text, "soil");
  trace_ground(ground, v, half, bottom - gap_below, text);
  ambulo__svg_path_line(text, v->x + half, bottom);
  ambulo__svg_path_line(text, v->x - half, bottom);
  ambulo__svg_path_end(text);
  ambulo__svg_path_begin(text, "edge");
  trace_ground(ground, v, half, bottom - gap_below, text);
  ambulo__svg_path_end(text);
}

static const double across = 1e-6; /* m */
static const double ring = 5.0;    /* px */

/* comparisons, not fmin and fmax: as a reduction over corners those stop gcc 12 for aarch64 with an
 * internal error */
static void widen(ambulo__outline *o, double forward, double up, double radius) {
  if (forward - radius < o->from) o->from = forward - radius;
  if (forward + radius > o->to) o->to = forward + radius;
  if (up - radius < o->low) o->low = up - radius;
  if (up + radius > o->high) o->high = up + radius;
}

ambulo__outline ambulo__obstacle_outline(const ambulo_problem *p, int obstacle) {
  ambulo__outline o = {INFINITY, -INFINITY, INFINITY, -INFINITY, 0};
  ambulo__solid solid = ambulo__solid_of_obstacle(&p->definition, obstacle);
  const ambulo_model *m = p->model;
  double ground = p->definition.ground_height;
  if (solid.kind == AMBULO__SOLID_CAPSULE) {
    for (int e = 0; e < 2; e++)
      widen(&o, ambulo__dot(m->forward, solid.ends[e]), ambulo__dot(m->up, solid.ends[e]) - ground,
            solid.radius);
    o.is_round = fmax(o.to - o.from, o.high - o.low) < 2.0 * solid.radius + across;
    return o;
  }
  for (int corner = 0; corner < 8; corner++) {
    double r[3];
    for (int i = 0; i < 3; i++) {
      r[i] = solid.center[i];
      for (int k = 0; k < 3; k++)
        r[i] += (corner >> k & 1 ? 1.0 : -1.0) * solid.half[k] * solid.axes[k][i];
    }
    widen(&o, ambulo__dot(m->forward, r), ambulo__dot(m->up, r) - ground, 0.0);
  }
  return o;
}

int ambulo__obstacles_widen(const ambulo_problem *p, double origin, double half, double *left,
                            double *right) {
  double from = *left, to = *right;
  for (int i = 0; i < p->definition.obstacle_count; i++) {
    ambulo__outline o = ambulo__obstacle_outline(p, i);
    if (o.to - origin < -half || o.from - origin > half) continue;
    from = fmin(from, fmax(o.from - origin, -half));
    to = fmax(to, fmin(o.to - origin, half));
  }
  int wider = from < *left || to > *right;
  *left = from;
  *right = to;
  return wider;
}

static void draw_outline(const ambulo__outline *o, const ambulo__figure_view *v,
                         ambulo__text_buffer *text) {
  double from = fmax(o->from - v->origin, -v->half), to = fmin(o->to - v->origin, v->half);
  double middle = 0.5 * (o->from + o->to) - v->origin, top = v->base - v->scale * o->high;
  if (o->is_round && fabs(middle) <= v->half)
    ambulo__svg_circle(text, "obstacle", v->x + v->scale * middle,
                       v->base - 0.5 * v->scale * (o->low + o->high),
                       0.5 * v->scale * (o->high - o->low));
  if (!o->is_round && to > from)
    ambulo__svg_rectangle(text, "obstacle", v->x + v->scale * from, top, v->scale * (to - from),
                          v->scale * (o->high - o->low));
}

void ambulo__gait_obstacles_draw(const ambulo_problem *p, const ambulo__figure_view *v,
                                 ambulo__text_buffer *text) {
  for (int i = 0; i < p->definition.obstacle_count; i++) {
    ambulo__outline outline = ambulo__obstacle_outline(p, i);
    draw_outline(&outline, v, text);
  }
  for (int i = 0; i < p->definition.reach_count; i++) {
    const ambulo_reach *reach = &p->definition.reaches[i];
    if (reach->is_relative) continue;
    if (v->time < reach->from - 0.5 * v->apart || v->time >= reach->to + 0.5 * v->apart) continue;
    ambulo__svg_circle(text, "place", v->x + v->scale * (reach->place[0] - v->origin),
                       v->base - v->scale * reach->place[2], ring);
  }
}

void ambulo__gait_patches_draw(const ambulo__stride *stride, const ambulo__pose *pose,
                               const ambulo__figure_view *v, ambulo__text_buffer *text) {
  static const char *const styles[] = {"trunk-mark", "left-mark", "right-mark"};
  const ambulo_model *m = stride->model;
  const ambulo_problem_definition *d = &stride->problem->definition;
  for (int i = 0; i < m->patch_count; i++) {
    const ambulo_contact *contact = ambulo__stride_contact(stride, m->foot_count + i, v->time);
    if (!contact) continue;
    const ambulo_point *point = &m->points[m->patches[i].point];
    ambulo__contact_frame frame = ambulo__contact_frame_of(d, contact);
    double long_half = m->patches[i].size[0] * v->scale, world[3];
    double dx = long_half * ambulo__dot(m->forward, frame.forward);
    double dy = long_half * ambulo__dot(m->up, frame.forward);
    ambulo__pose_point(pose, point->link, point->position, world);
    double x = v->x + v->scale * (ambulo__dot(m->forward, world) - v->origin);
    double y = v->base - v->scale * (ambulo__dot(m->up, world) - d->ground_height);
    if (isfinite(x + y))
      ambulo__svg_line(text, styles[ambulo__gait_patch_side(m, i)], x - dx, y + dy, x + dx, y - dy);
  }
}

/*
 * A box is an upright rectangle about its centre of mass, of its size or, without one, of that of
 * other loads of its mass (gait_worn.c). What hands push has an arrow: 1 m for 500 N of `force`.
 */

static const double meters_per_newton = 1.0 / 500.0, barb = 6.0; /* barb: px */
static const double seen_from = 0.05; /* of the window: an arrow is drawn */

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
  double width = scale * hold->size[0], height = scale * hold->size[2], half[3];
  int has_size = width > 0.0 && height > 0.0;
  if (!has_size && !(hold->mass > 0.0)) return;
  ambulo__load_half_size(hold->mass, half);
  if (!has_size) width = 2.0 * scale * half[0];
  if (!has_size) height = 2.0 * scale * half[2];
  ambulo__svg_rectangle(text, has_size ? "box" : "load", x - 0.5 * width, y - 0.5 * height, width,
                        height);
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
