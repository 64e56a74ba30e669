/* show/gait_ground.c - see gait_ground.h.
 *
 * The surface of a contact at p with normal u rises by -u_f / u_n per metre forward. Two surfaces
 * that follow each other meet at the riser between their footholds.
 */
#include "show/gait_ground.h"

#include <math.h>
#include <stdlib.h>

#include "base/vector.h"
#include "contact/foot_outline.h"
#include "contact/step_edge.h"

enum { PERIODS_BEFORE = 2, PERIODS_AFTER = 3 };

static const double same_place = 1e-6; /* m */

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
