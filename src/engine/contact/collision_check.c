/* contact/collision_check.c - capsules that keep clear, obstacles, places to reach: every number.
 */
#include "base/arithmetic.h"
#include "contact/row_families.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <string.h>

#define REFUSE(diagnostics, ...)                                                                   \
  ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL, __VA_ARGS__)

static const double farthest = 1e3;    /* m, of places and sizes */
static const double widest = 10.0;     /* m, of margins and tolerances */
static const double same_place = 1e-6; /* m */

static int is_place(const double place[3]) {
  for (int i = 0; i < 3; i++) {
    if (!(fabs(place[i]) <= farthest)) return 0;
  }
  return 1;
}

static int is_margin(double margin) {
  return margin >= 0.0 && margin <= widest;
}

/* ----------------------------------------------------------------------- pairs */

static int is_capsule(const ambulo_model *m, int index) {
  return index >= 0 && index < m->capsule_count;
}

/* the joint that moves a link; -1: none */
static int mover_of(const ambulo_model *m, int link) {
  while (link >= 0 && m->links[link].coordinate < 0) link = m->links[link].parent;
  return link < 0 ? -1 : m->links[link].coordinate;
}

static ambulo_status check_pair(const ambulo_problem_definition *d, int k,
                                ambulo_diagnostics *list) {
  const ambulo_model *m = d->model;
  const ambulo_capsule_pair *pair = &d->collision.pairs[k];
  if (!is_capsule(m, pair->one) || !is_capsule(m, pair->other))
    return REFUSE(list,
                  "constraints.collision.pairs[%d] names capsules %d and %d; the model '%s' has %d",
                  k, pair->one, pair->other, m->name, m->capsule_count);
  const ambulo_capsule *one = &m->capsules[pair->one], *other = &m->capsules[pair->other];
  if (mover_of(m, one->link) == mover_of(m, other->link))
    return REFUSE(list,
                  "constraints.collision.pairs[%d]: '%s' and '%s' are parts of one rigid body; "
                  "expected capsules that can move against each other",
                  k, one->name, other->name);
  return AMBULO_OK;
}

static ambulo_status check_pairs(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  const ambulo_collision *c = &d->collision;
  if (c->mode == AMBULO_COLLISION_OFF) return AMBULO_OK;
  if (c->mode != AMBULO_COLLISION_PAIRS && c->mode != AMBULO_COLLISION_AUTOMATIC)
    return REFUSE(list, "unknown collision mode %d", (int)c->mode);
  if (c->mode == AMBULO_COLLISION_PAIRS && c->pair_count > 0 && d->model->capsule_count == 0)
    return REFUSE(list,
                  "constraints.collision: the model '%s' has no capsules; expected some in the "
                  "model file",
                  d->model->name);
  if (!is_margin(c->margin))
    status =
        REFUSE(list, "constraints.collision.margin is %g m; expected 0 to %g m", c->margin, widest);
  for (int k = 0; c->mode == AMBULO_COLLISION_PAIRS && k < c->pair_count; k++) {
    ambulo_status one = check_pair(d, k, list);
    if (one) status = one;
  }
  return status;
}

/* ------------------------------------------------------------------- obstacles */

static int sizes_are_good(const ambulo_obstacle *o) {
  if (o->shape == AMBULO_OBSTACLE_CAPSULE)
    return is_place(o->from) && is_place(o->to) && o->radius > 0.0 && o->radius <= farthest;
  return is_place(o->center) && is_place(o->half) && o->half[0] > 0.0 && o->half[1] > 0.0 &&
         o->half[2] > 0.0 && fabs(o->heading) <= 10.0;
}

static ambulo_status check_obstacle(const ambulo_problem_definition *d, int k,
                                    ambulo_diagnostics *list) {
  const ambulo_obstacle *o = &d->obstacles[k];
  if (!o->name || !o->name[0]) return REFUSE(list, "obstacles[%d] has no name", k);
  if (o->shape != AMBULO_OBSTACLE_BOX && o->shape != AMBULO_OBSTACLE_CAPSULE)
    return REFUSE(list, "obstacles[%d] ('%s'): its shape is %s (got %d); expected box or capsule",
                  k, o->name, o->shape ? "unknown" : "not set", (int)o->shape);
  for (int i = 0; i < k; i++) {
    if (d->obstacles[i].name && !strcmp(d->obstacles[i].name, o->name))
      return REFUSE(list, "obstacles[%d] and obstacles[%d] are both named '%s'", i, k, o->name);
  }
  if (!sizes_are_good(o))
    return REFUSE(list,
                  "obstacles[%d] ('%s'): a number is out of range; expected places within %g m, "
                  "and sizes more than 0",
                  k, o->name, farthest);
  if (!is_margin(o->margin))
    return REFUSE(list, "obstacles[%d] ('%s'): margin is %g m; expected 0 to %g m", k, o->name,
                  o->margin, widest);
  if (o->capsules && o->capsule_count < 1)
    return REFUSE(list, "obstacles[%d] ('%s'): an empty list of capsules; expected some, or all", k,
                  o->name);
  for (int i = 0; o->capsules && i < o->capsule_count; i++) {
    if (is_capsule(d->model, o->capsules[i])) continue;
    return REFUSE(list, "obstacles[%d] ('%s') names capsule %d; the model '%s' has %d", k, o->name,
                  o->capsules[i], d->model->name, d->model->capsule_count);
  }
  if (d->model->capsule_count == 0)
    return REFUSE(list,
                  "obstacles[%d] ('%s'): the model '%s' has no capsules that could keep clear of "
                  "it; expected some in the model file",
                  k, o->name, d->model->name);
  return AMBULO_OK;
}

static ambulo_status check_reach(const ambulo_problem_definition *d, int k,
                                 ambulo_diagnostics *list) {
  const ambulo_reach *r = &d->reaches[k];
  if (r->point < 0 || r->point >= d->model->point_count)
    return REFUSE(list, "constraints.reach[%d] names point %d; the model '%s' has %d", k, r->point,
                  d->model->name, d->model->point_count);
  if (r->is_relative && (r->about < 0 || r->about >= d->model->point_count || r->about == r->point))
    return REFUSE(
        list,
        "constraints.reach[%d] is relative to point %d; expected another one of the %d of "
        "the model '%s'",
        k, r->about, d->model->point_count, d->model->name);
  if (!is_place(r->place))
    return REFUSE(list, "constraints.reach[%d]: a place further than %g m away", k, farthest);
  if (!(r->from >= 0.0 && r->to >= r->from &&
        (r->to <= d->duration * (1.0 + 1e-9) || isinf(r->to))))
    return REFUSE(list, "constraints.reach[%d] is from %g s to %g s; expected times in 0 to %g s",
                  k, r->from, r->to, d->duration);
  if (!is_margin(r->tolerance))
    return REFUSE(list, "constraints.reach[%d]: a tolerance of %g m; expected 0 to %g m", k,
                  r->tolerance, widest);
  return AMBULO_OK;
}

ambulo_status ambulo__collision_check(const ambulo_problem_definition *d,
                                      ambulo_diagnostics *list) {
  ambulo_status status = check_pairs(d, list);
  for (int k = 0; k < d->obstacle_count; k++) {
    ambulo_status one = check_obstacle(d, k, list);
    if (one) status = one;
  }
  for (int k = 0; k < d->reach_count; k++) {
    ambulo_status one = check_reach(d, k, list);
    if (one) status = one;
  }
  return status;
}

/* --------------------------------------------------------------- mirrored ends */

/* how far an end of one capsule is from the mirror image of the other's, at q = 0, m */
static double off_image(const ambulo_model *m, const ambulo_capsule *own,
                        const ambulo_capsule *other, int swapped) {
  double square = 0.0;
  for (int end = 0; end < 2; end++) {
    double a[3], b[3], aside = 0.0;
    ambulo__neutral_place(m, own->link, end ? own->to : own->from, a);
    ambulo__neutral_place(m, other->link, end != swapped ? other->to : other->from, b);
    for (int i = 0; i < 3; i++) aside += a[i] * m->left[i];
    for (int i = 0; i < 3; i++) {
      double apart = a[i] - 2.0 * aside * m->left[i] - b[i];
      square += apart * apart;
    }
  }
  return sqrt(square);
}

static ambulo_status check_image(const ambulo_problem_definition *d, int index,
                                 ambulo_diagnostics *list) {
  const ambulo_model *m = d->model;
  const ambulo_capsule *own = &m->capsules[index], *other = &m->capsules[own->mirror];
  int mover = mover_of(m, own->link), image = mover_of(m, other->link);
  double off = fmin(off_image(m, own, other, 0), off_image(m, own, other, 1));
  if (image == (mover < 0 ? -1 : m->coordinates[mover].mirror) && off <= same_place &&
      fabs(own->radius - other->radius) <= same_place)
    return AMBULO_OK;
  return REFUSE(
      list,
      "ends.kind: mirrored ends, but capsule '%s' (radius %.6g m) is not the mirror image "
      "of '%s' (radius %.6g m), by %.3g m at q = 0; expected the same place on the other "
      "side, and the same radius",
      own->name, own->radius, other->name, other->radius, off);
}

/* 1 if one point is the other's image in the plane of progression, at q = 0 and as it moves */
static int are_images(const ambulo_model *m, int one, int other) {
  const ambulo_point *a = &m->points[one], *b = &m->points[other];
  const double *p = m->neutral + (size_t)(3 * one), *q = m->neutral + (size_t)(3 * other);
  int mover = mover_of(m, a->link);
  double square = 0.0, aside = ambulo__dot(p, m->left);
  for (int i = 0; i < 3; i++) {
    double apart = p[i] - 2.0 * aside * m->left[i] - q[i];
    square += apart * apart;
  }
  return mover_of(m, b->link) == (mover < 0 ? -1 : m->coordinates[mover].mirror) &&
         sqrt(square) <= same_place;
}

/* the way from a point to its image, to the side, all along: the image of a step asks for the same
 */
static ambulo_status check_reach_image(const ambulo_problem_definition *d, int k,
                                       ambulo_diagnostics *list) {
  const ambulo_reach *r = &d->reaches[k];
  if (!r->is_relative)
    return REFUSE(list,
                  "ends.kind: mirrored ends, but constraints.reach[%d] asks for a place "
                  "once; expected ends: {kind: free} or {kind: periodic}, or relative_to",
                  k);
  if (are_images(d->model, r->point, r->about) && r->place[0] == 0.0 && r->place[2] == 0.0 &&
      r->from <= AMBULO__INSTANT && r->to >= d->duration - AMBULO__INSTANT)
    return AMBULO_OK;
  return REFUSE(
      list,
      "ends.kind: mirrored ends, but the mirror image of constraints.reach[%d] is another "
      "one; expected the way from a point to its mirror image, straight to the side, "
      "from 0 to %g s",
      k, d->duration);
}

ambulo_status ambulo__collision_mirror_check(const ambulo_problem_definition *d,
                                             ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  if (d->ends != AMBULO_ENDS_MIRRORED) return AMBULO_OK;
  if (d->obstacle_count > 0)
    status = REFUSE(list,
                    "ends.kind: mirrored ends, but obstacle '%s' stands once and the step for "
                    "both; expected ends: {kind: free} or {kind: periodic}",
                    d->obstacles[0].name);
  for (int k = 0; k < d->reach_count; k++) {
    if (check_reach_image(d, k, list)) status = AMBULO_E_PROBLEM;
  }
  for (int i = 0; i < d->model->capsule_count; i++) {
    if (d->model->capsules[i].mirror < i || !ambulo__capsule_is_used(d, i)) continue;
    if (check_image(d, i, list)) status = AMBULO_E_PROBLEM;
  }
  return status;
}
