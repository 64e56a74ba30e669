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
#include <string.h>

#define REFUSE(diagnostics, ...)                                                                   \
  ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL, __VA_ARGS__)

void ambulo__world_place(const ambulo_problem_definition *d, const double place[3],
                         double world[3]) {
  const ambulo_model *m = d->model;
  for (int i = 0; i < 3; i++)
    world[i] =
        place[0] * m->forward[i] + place[1] * m->left[i] + (place[2] + d->ground_height) * m->up[i];
}

static double length_of(const ambulo_capsule *capsule) {
  double u[3];
  for (int i = 0; i < 3; i++) u[i] = capsule->to[i] - capsule->from[i];
  return sqrt(ambulo__dot(u, u));
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
  solid.weight[0] = ambulo__solid_weight(length_of(one), one->radius);
  solid.weight[1] = ambulo__solid_weight(length_of(other), other->radius);
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
    double gap = 0.0;
    ambulo_status status = ambulo__rest_gap(context->model, *pair, allocator, &gap);
    if (status) return status;
    double distance = solid.distance;
    solid.one = channel_of(context, pair->one);
    solid.other = channel_of(context, pair->other);
    for (int node = 0; node < nodes; node++) {
      double t = context->times[node];
      solid.distance = gap < 0.0 ? distance + gap - rest_allowance(d, t) : distance;
      ambulo__row_solid(table, AMBULO__KIND_COLLISION, capsules[pair->one].name,
                        capsules[pair->other].name, node, t, &solid);
    }
  }
  return AMBULO_OK;
}

/* ---------------------------------------------------------------- boxes in hands */

int ambulo__hold_is_box(const ambulo_problem_definition *d, int hold) {
  const double *size = d->holds[hold].size;
  return size[0] > 0.0 && size[1] > 0.0 && size[2] > 0.0;
}

/* 1: the link is the hand's, or between the hand and where another limb branches off */
static int is_in_arm(const ambulo_model *m, int hand, int link) {
  int at = m->points[hand].link;
  while (at >= 0) {
    if (at == link) return 1;
    int parent = m->links[at].parent, branches = 0;
    for (int l = 0; l < m->link_count; l++) branches += m->links[l].parent == parent;
    if (parent < 0 || branches > 1) return 0;
    at = parent;
  }
  return 0;
}

int ambulo__hold_meets(const ambulo_problem_definition *d, int hold, int capsule) {
  const ambulo_hold *h = &d->holds[hold];
  int link = d->model->capsules[capsule].link;
  return !is_in_arm(d->model, h->hand[0], link) &&
         (h->hand[1] < 0 || !is_in_arm(d->model, h->hand[1], link));
}

static void set_axes(const ambulo_model *m, ambulo__solid *solid) {
  for (int i = 0; i < 3; i++) {
    solid->axes[0][i] = m->forward[i];
    solid->axes[1][i] = m->left[i];
    solid->axes[2][i] = m->up[i];
  }
}

ambulo__solid ambulo__solid_of_hold(const ambulo_problem_definition *d, int hold) {
  const ambulo_hold *h = &d->holds[hold];
  const ambulo_model *m = d->model;
  ambulo__solid solid = {.kind = AMBULO__SOLID_HELD, .about = -1, .held = hold + 1};
  set_axes(m, &solid);
  for (int i = 0; i < 3; i++) {
    solid.half[i] = 0.5 * h->size[i];
    solid.ends[0][i] =
        h->center[0] * m->forward[i] + h->center[1] * m->left[i] + h->center[2] * m->up[i];
  }
  return solid;
}

/* of a box fixed in the world, grown by the one that is carried */
ambulo__solid ambulo__solid_carried(const ambulo__solid *box, const ambulo__solid *fixed,
                                    double distance) {
  ambulo__solid solid = *fixed;
  solid.kind = AMBULO__SOLID_CARRIED;
  solid.held = box->held;
  solid.distance = distance;
  solid.weight[0] = 1e-8; /* a segment without length: its nearest point is its middle */
  memcpy(solid.ends[0], box->ends[0], sizeof solid.ends[0]);
  memcpy(solid.hand, box->hand, sizeof solid.hand);
  for (int k = 0; k < 3; k++) {
    for (int j = 0; j < 3; j++)
      solid.half[k] += box->half[j] * fabs(ambulo__dot(fixed->axes[k], box->axes[j]));
  }
  return solid;
}

int ambulo__ground_is_level(const ambulo_problem_definition *d) {
  for (int c = 0; c < d->contact_count; c++) {
    const double *normal = d->contacts[c].normal;
    int tilted = normal[0] != 0.0 || normal[1] != 0.0;
    if (d->contacts[c].foot >= 0 && (tilted || d->contacts[c].place[2] != 0.0)) return 0;
  }
  return 1;
}

ambulo__solid ambulo__solid_of_ground(const ambulo_problem_definition *d) {
  const double deep = 100.0, middle[3] = {0.0, 0.0, -deep}; /* m */
  ambulo__solid solid = {.kind = AMBULO__SOLID_BOX, .about = -1};
  set_axes(d->model, &solid);
  ambulo__world_place(d, middle, solid.center);
  for (int i = 0; i < 3; i++) solid.half[i] = i < 2 ? 1e4 : deep;
  return solid;
}

/* what share of its distance a box keeps from what it is taken from and set down on: nothing while
 * it is handed over, all once it has been away for as long again */
static double share_away(const ambulo_hold *h, double t) {
  return fmin(1.0, fmax(0.0, fmin(t - h->from, h->to - t) / h->ramp - 1.0));
}

static void carried_rows(const ambulo__gait_context *context, const ambulo__solid *box, int node,
                         ambulo__row_table *table) {
  const ambulo_problem_definition *d = context->definition;
  const char *name = d->holds[box->held - 1].name;
  double t = context->times[node], share = share_away(&d->holds[box->held - 1], t);
  double allowance = 2.0 * ambulo__passing_allowance(d); /* hands are fast */
  for (int o = 0; o < d->obstacle_count; o++) {
    ambulo__solid fixed = ambulo__solid_of_obstacle(d, o);
    if (fixed.kind != AMBULO__SOLID_BOX) continue;
    ambulo__solid solid =
        ambulo__solid_carried(box, &fixed, share * allowance);
    ambulo__row_solid(table, AMBULO__KIND_COLLISION, name, d->obstacles[o].name, node, t, &solid);
  }
  if (!ambulo__ground_is_level(d)) return;
  ambulo__solid ground = ambulo__solid_of_ground(d),
                solid = ambulo__solid_carried(box, &ground, share * allowance);
  ambulo__row_solid(table, AMBULO__KIND_COLLISION, name, "ground", node, t, &solid);
}

/* (14.h) of what hands hold */
static void hold_rows(const ambulo__gait_context *context, int hold, ambulo__row_table *table) {
  const ambulo_problem_definition *d = context->definition;
  const ambulo_hold *h = &d->holds[hold];
  const ambulo_model *m = context->model;
  ambulo__solid box = ambulo__solid_of_hold(d, hold);
  int nodes = ambulo__distinct_nodes(context, AMBULO__OF_PLACES);
  for (int k = 0; k < 2; k++)
    box.hand[k] = h->hand[k] < 0 ? -1 : ambulo__channel_point(&context->channels, h->hand[k], 0);
  for (int node = 0; node < nodes; node++) {
    double t = context->times[node];
    if (t < h->from - AMBULO__INSTANT || t > h->to + AMBULO__INSTANT) continue;
    for (int c = 0; c < m->capsule_count; c++) {
      if (!ambulo__hold_meets(d, hold, c)) continue;
      const ambulo_capsule *own = &m->capsules[c];
      ambulo__solid solid = box;
      solid.one = channel_of(context, c);
      solid.radius = own->radius;
      solid.distance = own->radius + d->collision.margin + ambulo__passing_allowance(d);
      solid.weight[0] = ambulo__solid_weight(length_of(own), own->radius);
      ambulo__row_solid(table, AMBULO__KIND_COLLISION, own->name, h->name, node, t, &solid);
    }
    carried_rows(context, &box, node, table);
  }
}

/* (14.h) boxes in hands keep clear of what they could meet */
void ambulo__hold_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  const ambulo_problem_definition *d = context->definition;
  for (int h = 0; d->collision.mode != AMBULO_COLLISION_OFF && h < d->hold_count; h++) {
    if (ambulo__hold_is_box(d, h)) hold_rows(context, h, table);
  }
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
  solid.weight[0] = ambulo__solid_weight(length_of(own), own->radius);
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
