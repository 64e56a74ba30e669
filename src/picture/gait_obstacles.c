/* picture/gait_obstacles.c - see gait_obstacles.h. */
#include "picture/gait_obstacles.h"

#include "base/vector.h"
#include "gait/collision.h"

#include <math.h>

static const double across = 1e-6; /* m */

static void widen(ambulo__outline *o, double forward, double up, double radius) {
  o->from = fmin(o->from, forward - radius);
  o->to = fmax(o->to, forward + radius);
  o->low = fmin(o->low, up - radius);
  o->high = fmax(o->high, up + radius);
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
