/* contact/collision_rows.c - rows of capsules that keep clear, and of points that come to places.
 *
 * A place p = (along f, along l, up) stands in the world at p_0 f + p_1 l + (p_2 + h) n, with the
 * ground's height h. A box with heading psi has the axes
 *
 *     cos(psi) f + sin(psi) l,   cos(psi) l - sin(psi) f,   n
 *
 * D is the radii, the margin and what parts that pass come nearer between two nodes than at them
 * (contact/clearance.c), which vanishes on a fine grid.
 *
 * A reach holds the point r along each axis a of f, l, n within a tolerance e, at every node of its
 * times:
 *
 *     -e <= a . r - a . w <= e             at a place in the world: w as p above        m
 *     -e <= a . (r - r') - p_a <= e        p from another point r': no height enters    m
 *
 * and without a tolerance by one equation each, the same form = 0.
 */
#include "base/arithmetic.h"
#include "contact/rows.h"
#include "contact/row_families.h"

#include <math.h>

#define REFUSE(diagnostics, ...)                                                                   \
  ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL, __VA_ARGS__)

void ambulo__world_place(const ambulo_problem_definition *d, const double place[3],
                         double world[3]) {
  const ambulo_model *m = d->model;
  for (int i = 0; i < 3; i++)
    world[i] =
        place[0] * m->forward[i] + place[1] * m->left[i] + (place[2] + d->ground_height) * m->up[i];
}

double ambulo__capsule_weight(const ambulo_capsule *capsule) {
  double u[3];
  for (int i = 0; i < 3; i++) u[i] = capsule->to[i] - capsule->from[i];
  return ambulo__solid_weight(sqrt(ambulo__dot(u, u)), capsule->radius);
}

static int channel_of(const ambulo__gait_context *context, int capsule) {
  return ambulo__channel_point(&context->channels, context->model->capsule_point[capsule], 0);
}

/* ----------------------------------------------------------------- one another */

ambulo__solid ambulo__solid_of_pair(const ambulo_problem_definition *d, ambulo_capsule_pair pair) {
  const ambulo_capsule *one = &d->model->capsules[pair.one];
  const ambulo_capsule *other = &d->model->capsules[pair.other];
  ambulo__solid solid = {
      .kind = AMBULO__SOLID_MOVING, .about = -1, .radius = one->radius + other->radius};
  solid.distance = solid.radius + d->collision.margin + ambulo__passing_allowance(d);
  solid.weight[0] = ambulo__capsule_weight(one);
  solid.weight[1] = ambulo__capsule_weight(other);
  return solid;
}

static const double settling = 0.2; /* s */

/* what pairs that overlap in the rest pose need not keep near the ends of a motion, which may be
 * that pose, of what passing parts are allowed for */
static double rest_allowance(const ambulo_problem_definition *d, double t) {
  double share = fmin(1.0, fmin(t, d->duration - t) / settling);
  return d->ends == AMBULO_ENDS_FREE ? (1.0 - share) * ambulo__passing_allowance(d) : 0.0;
}

/* (14.h) of pairs; those that overlap in the rest pose, arms that hang beside the thighs, may
 * overlap as far as there, less the margin */
ambulo_status ambulo__collision_rows(const ambulo__gait_context *context,
                                     const ambulo_allocator *allocator, ambulo__row_table *table) {
  const ambulo_problem_definition *d = context->definition;
  const ambulo_capsule *capsules = context->model->capsules;
  int nodes = ambulo__distinct_nodes(context, AMBULO__OF_PLACES);
  for (int k = 0; d->collision.mode != AMBULO_COLLISION_OFF && k < d->collision.pair_count; k++) {
    const ambulo_capsule_pair *pair = &d->collision.pairs[k];
    ambulo__solid solid = ambulo__solid_of_pair(d, *pair);
    double rest = 0.0;
    ambulo_status status = ambulo__rest_overlap(context->model, *pair, allocator, &rest);
    if (status) return status;
    double distance = solid.distance;
    solid.one = channel_of(context, pair->one);
    solid.other = channel_of(context, pair->other);
    for (int node = 0; node < nodes; node++) {
      double t = context->times[node];
      solid.distance = rest > 0.0 ? distance - rest - rest_allowance(d, t) : distance;
      ambulo__row_solid(table, AMBULO__KIND_COLLISION, capsules[pair->one].name,
                        capsules[pair->other].name, node, t, &solid);
    }
  }
  return AMBULO_OK;
}

/* ------------------------------------------------------------------- obstacles */

static void place_box(const ambulo_problem_definition *d, const ambulo_obstacle *obstacle,
                      ambulo__solid *solid) {
  const ambulo_model *m = d->model;
  double c = cos(obstacle->heading), s = sin(obstacle->heading);
  ambulo__world_place(d, obstacle->center, solid->center);
  for (int i = 0; i < 3; i++) {
    solid->half[i] = obstacle->half[i];
    solid->axes[0][i] = c * m->forward[i] + s * m->left[i];
    solid->axes[1][i] = c * m->left[i] - s * m->forward[i];
    solid->axes[2][i] = m->up[i];
  }
}

ambulo__solid ambulo__solid_of_obstacle(const ambulo_problem_definition *d, int index) {
  const ambulo_obstacle *obstacle = &d->obstacles[index];
  ambulo__solid solid = {.about = index};
  if (obstacle->shape == AMBULO_OBSTACLE_BOX) {
    solid.kind = AMBULO__SOLID_BOX;
    place_box(d, obstacle, &solid);
    return solid;
  }
  solid.kind = AMBULO__SOLID_CAPSULE;
  solid.radius = obstacle->radius;
  ambulo__world_place(d, obstacle->from, solid.ends[0]);
  ambulo__world_place(d, obstacle->to, solid.ends[1]);
  return solid;
}

ambulo__solid ambulo__solid_near_obstacle(const ambulo_problem_definition *d, int index,
                                          int capsule) {
  const ambulo_capsule *own = &d->model->capsules[capsule];
  ambulo__solid solid = ambulo__solid_of_obstacle(d, index);
  solid.radius += own->radius;
  solid.distance = solid.radius + d->obstacles[index].margin + ambulo__passing_allowance(d);
  solid.weight[0] = ambulo__capsule_weight(own);
  if (solid.kind == AMBULO__SOLID_CAPSULE) solid.weight[1] = solid.weight[0];
  return solid;
}

int ambulo__obstacle_capsules(const ambulo_problem_definition *d, int index) {
  const ambulo_obstacle *obstacle = &d->obstacles[index];
  return obstacle->capsules ? obstacle->capsule_count : d->model->capsule_count;
}

int ambulo__obstacle_capsule(const ambulo_problem_definition *d, int index, int i) {
  const ambulo_obstacle *obstacle = &d->obstacles[index];
  return obstacle->capsules ? obstacle->capsules[i] : i;
}

/* (14.h) of obstacles */
void ambulo__obstacle_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  const ambulo_problem_definition *d = context->definition;
  for (int o = 0; o < d->obstacle_count; o++) {
    for (int i = 0; i < ambulo__obstacle_capsules(d, o); i++) {
      int capsule = ambulo__obstacle_capsule(d, o, i);
      ambulo__solid solid = ambulo__solid_near_obstacle(d, o, capsule);
      solid.one = channel_of(context, capsule);
      for (int node = 0; node < context->nodes; node++)
        ambulo__row_solid(table, AMBULO__KIND_OBSTACLE, context->model->capsules[capsule].name,
                          d->obstacles[o].name, node, context->times[node], &solid);
    }
  }
}

/* ----------------------------------------------------------------------- reach */

static void at_node(const ambulo__gait_context *context, const ambulo_reach *reach, int node,
                    ambulo__row_table *table) {
  static const char *const exact[] = {"forward", "left", "up"};
  static const char *const lower[] = {"forward lower", "left lower", "up lower"};
  static const char *const upper[] = {"forward upper", "left upper", "up upper"};
  const ambulo_model *m = context->model;
  const double *axes[] = {m->forward, m->left, m->up};
  const char *subject = m->points[reach->point].name;
  int first = ambulo__channel_point(&context->channels, reach->point, 0);
  int other = ambulo__channel_point(&context->channels, reach->about, 0);
  double world[3];
  ambulo__world_place(context->definition, reach->place, world);
  for (int k = 0; k < 3; k++) {
    ambulo__linear form = {.constant = -ambulo__dot(axes[k], world)};
    if (reach->is_relative) form.constant = -reach->place[k];
    ambulo__linear_add(&form, first, axes[k], 1.0);
    if (reach->is_relative) ambulo__linear_add(&form, other, axes[k], -1.0);
    ambulo__bounded_name name = {AMBULO__KIND_REACH, subject, lower[k], upper[k], AMBULO__METRES};
    if (reach->tolerance > 0.0) {
      ambulo__bounded_rows(context, node, &name, &form, -reach->tolerance, reach->tolerance, table);
      continue;
    }
    ambulo__row_begin(table, AMBULO__KIND_REACH, subject, exact[k], AMBULO__METRES, AMBULO_EQUAL,
                      node, context->times[node], form.constant);
    for (int t = 0; t < form.count; t++)
      ambulo__row_term_add(table, node, form.channel[t], form.coefficient[t]);
  }
}

/* (14.i) */
ambulo_status ambulo__reach_rows(const ambulo__gait_context *context, ambulo__row_table *table,
                                 ambulo_diagnostics *diagnostics) {
  const ambulo_problem_definition *d = context->definition;
  ambulo_status status = AMBULO_OK;
  for (int r = 0; r < d->reach_count; r++) {
    const ambulo_reach *reach = &d->reaches[r];
    int found = 0, nearest = 0;
    for (int node = 0; node < context->nodes; node++) {
      double t = context->times[node];
      if (fabs(t - reach->from) < fabs(context->times[nearest] - reach->from)) nearest = node;
      if (t < reach->from - AMBULO__INSTANT || t > reach->to + AMBULO__INSTANT) continue;
      at_node(context, reach, node, table);
      found = 1;
    }
    if (!found)
      status = REFUSE(diagnostics,
                      "constraints.reach[%d]: no node from %g s to %g s, the nearest is at %g s; "
                      "expected the time of a node, or grid: events, which puts one there",
                      r, reach->from, reach->to, context->times[nearest]);
  }
  return status;
}
