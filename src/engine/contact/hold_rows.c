/* contact/hold_rows.c - rows of boxes in hands, which keep clear (contact/curved.h, 14.h).
 *
 * A box that hands hold keeps clear of all capsules but those of the arms that hold it, of boxes
 * that are obstacles, and of the ground where that is level. It is taken from something and set
 * down on something: while it is handed over, for one ramp, it may touch what stands in the world,
 * and keeps its full distance once it has been away for another ramp.
 */
#include "base/arithmetic.h"
#include "contact/row_families.h"
#include "contact/rows.h"

#include <math.h>
#include <string.h>

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
    ambulo__solid solid = ambulo__solid_carried(box, &fixed, share * allowance);
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
      solid.one = ambulo__channel_point(&context->channels, m->capsule_point[c], 0);
      solid.radius = own->radius;
      solid.distance = own->radius + d->collision.margin + ambulo__passing_allowance(d);
      solid.weight[0] = ambulo__capsule_weight(own);
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

int ambulo__capsule_is_used(const ambulo_problem_definition *d, int capsule) {
  for (int k = 0; d->collision.mode != AMBULO_COLLISION_OFF && k < d->collision.pair_count; k++) {
    if (d->collision.pairs[k].one == capsule || d->collision.pairs[k].other == capsule) return 1;
  }
  for (int h = 0; d->collision.mode != AMBULO_COLLISION_OFF && h < d->hold_count; h++) {
    if (ambulo__hold_is_box(d, h) && ambulo__hold_meets(d, h, capsule)) return 1;
  }
  for (int o = 0; o < d->obstacle_count; o++) {
    const ambulo_obstacle *obstacle = &d->obstacles[o];
    if (!obstacle->capsules) return 1;
    for (int i = 0; i < obstacle->capsule_count; i++) {
      if (obstacle->capsules[i] == capsule) return 1;
    }
  }
  return 0;
}
