/* show/gait_obstacles.c - see gait_obstacles.h. */
#include "show/gait_obstacles.h"

#include "base/vector.h"
#include "contact/collision.h"
#include "show/svg.h"

#include <math.h>

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
