/* contact/mirror_check.c - what mirrored ends ask of a body: one step stands for both.
 *
 *   body     is its own mirror image (model/mirror_image.h)
 *   limits   what the limits of two partners leave in both halves (contact/bounds.h) is not empty,
 *            where limits are rows
 *   tubes    two partners that both have a half width have the same; one that the reference lacks
 *            may be free on one side, for the reference is that of one step
 *
 *   patches  that are in contact: the partner's middle is the mirror image at q = 0, on a link that
 *            moves with the partner coordinate, and of the same size
 *
 * Terms: problem/mirror_terms.c. Footholds: contact/schedule_ends.c.
 */
#include "contact/bounds.h"
#include "contact/effector.h"
#include "contact/gait.h"
#include "model/mirror_image.h"
#include "model/neutral_pose.h"

#include <math.h>

#define REFUSE(list, ...)                                                                          \
  ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere, AMBULO__BOTH_SIDES, __VA_ARGS__)

static const char *const keys[] = {[AMBULO_LIMITED_POSITION] = "joint_limits",
                                   [AMBULO_LIMITED_SPEED] = "speed_limits",
                                   [AMBULO_LIMITED_TORQUE] = "torque_limits"};
static const char *const words[] = {[AMBULO_LIMITED_POSITION] = "range",
                                    [AMBULO_LIMITED_SPEED] = "speed limits",
                                    [AMBULO_LIMITED_TORQUE] = "torque limits"};

static const char *unit_of(const ambulo_coordinate *c, ambulo_limited what) {
  return ambulo__measure_text(ambulo__row_measure(ambulo__row_kind_of_limit(what), c->type, 0));
}

static ambulo_status check_limits(const ambulo_problem_definition *d, int i, ambulo_limited what,
                                  ambulo_diagnostics *list) {
  const ambulo_coordinate *c = &d->model->coordinates[i];
  const ambulo_coordinate *m = &d->model->coordinates[c->mirror];
  ambulo__bounds b = ambulo__bounds_of(d, i, what);
  int travels = what == AMBULO_LIMITED_POSITION && fabs(ambulo__end_shift(d, i)) > 1e-9;
  /* too little room for the travel: contact/end_check.c says so */
  if (!(b.low.value > b.high.value) || travels) return AMBULO_OK;
  const char *unit = unit_of(c, what);
  const double *own = ambulo__limits_of(c, what), *other = ambulo__limits_of(m, what);
  if (m == c)
    return REFUSE(list,
                  "constraints.%s: the %s of '%s', %.6g to %.6g %s, and its mirror image, %.6g to "
                  "%.6g %s, have nothing in common; mirrored ends keep both",
                  keys[what], words[what], c->name, own[0], own[1], unit, -own[1], -own[0], unit);
  return REFUSE(list,
                "constraints.%s: the %s of '%s', %.6g to %.6g %s, and that of its mirror partner "
                "'%s', %.6g to %.6g %s%s, have nothing in common; mirrored ends keep both",
                keys[what], words[what], c->name, own[0], own[1], unit, m->name, other[0], other[1],
                unit, c->mirror_sign < 0.0 ? " with the opposite sign" : "");
}

static ambulo_status check_tubes(const ambulo_problem_definition *d, int i,
                                 ambulo_diagnostics *list) {
  const ambulo_coordinate *c = &d->model->coordinates[i];
  ambulo_status status = AMBULO_OK;
  for (int t = 0; t < d->tube_count; t++) {
    double own = d->tubes[t].half_width[i], other = d->tubes[t].half_width[c->mirror];
    if (!isfinite(own) || !isfinite(other)) continue;
    if (fabs(own - other) <= AMBULO__MIRROR_TOLERANCE * fmax(own, other)) continue;
    int digits = ambulo__digits_apart(own, other);
    const char *unit = unit_of(c, AMBULO_LIMITED_POSITION);
    status = REFUSE(list,
                    "constraints.tubes[%d]: the half width of '%s' is %.*g %s, that of its mirror "
                    "partner '%s' %.*g %s; expected the same with mirrored ends, or none on one "
                    "side",
                    t, c->name, digits, own, unit, d->model->coordinates[c->mirror].name, digits,
                    other, unit);
  }
  return status;
}

/* the coordinate that moves a point; -1: none */
static int mover_of(const ambulo_model *m, int point) {
  int link = m->points[point].link;
  while (link >= 0 && m->links[link].coordinate < 0) link = m->links[link].parent;
  return link < 0 ? -1 : m->links[link].coordinate;
}

/* how far the middle of one patch is from the mirror image of the other's, m */
static double off_image(const ambulo_model *m, const ambulo_patch *own, const ambulo_patch *other) {
  double a[3], b[3], aside = 0.0, square = 0.0;
  ambulo__neutral_point(m, own->point, a);
  ambulo__neutral_point(m, other->point, b);
  for (int i = 0; i < 3; i++) aside += a[i] * m->left[i];
  for (int i = 0; i < 3; i++) {
    double apart = a[i] - 2.0 * aside * m->left[i] - b[i];
    square += apart * apart;
  }
  return sqrt(square);
}

static ambulo_status check_patch(const ambulo_problem_definition *d, int i,
                                 ambulo_diagnostics *list) {
  const ambulo_model *m = d->model;
  const ambulo_patch *own = &m->patches[i], *other = &m->patches[own->mirror];
  int mover = mover_of(m, own->point), image = mover_of(m, other->point);
  double off = off_image(m, own, other);
  if (image != (mover < 0 ? -1 : m->coordinates[mover].mirror))
    return REFUSE(list,
                  "ends.kind: mirrored ends, but patch '%s' moves with '%s' and its mirror image "
                  "'%s' with '%s'; expected mirror partners",
                  own->name, mover < 0 ? "the world" : m->coordinates[mover].name, other->name,
                  image < 0 ? "the world" : m->coordinates[image].name);
  if (off > 1e-6 || own->size[0] != other->size[0] || own->size[1] != other->size[1])
    return REFUSE(list,
                  "ends.kind: mirrored ends, but patch '%s' (%.6g by %.6g m) is not the mirror "
                  "image of '%s' (%.6g by %.6g m), by %.3g m at q = 0; expected the same place on "
                  "the other side, and the same size",
                  own->name, 2.0 * own->size[0], 2.0 * own->size[1], other->name,
                  2.0 * other->size[0], 2.0 * other->size[1], off);
  return AMBULO_OK;
}

ambulo_status ambulo__mirror_check(const ambulo_problem_definition *d,
                                   const ambulo_allocator *allocator, ambulo_diagnostics *list) {
  static const ambulo__mirror_words body = {AMBULO_E_PROBLEM, "ends.kind: mirrored ends, but ",
                                            AMBULO__BOTH_SIDES};
  if (d->ends != AMBULO_ENDS_MIRRORED) return AMBULO_OK;
  int asked[3] = {d->joint_limits != AMBULO_LIMIT_OFF, d->speed_limits, d->torque_limits};
  ambulo_status status = ambulo__mirror_image_check(d->model, &body, allocator, list);
  if (status == AMBULO_E_MEMORY) return status;
  for (int i = 0; i < d->model->coordinate_count; i++) {
    if (d->model->coordinates[i].mirror < i) continue;
    for (int k = 0; k < 3; k++) {
      ambulo_limited what = (ambulo_limited)(AMBULO_LIMITED_POSITION + k);
      if (asked[k] && check_limits(d, i, what, list)) status = AMBULO_E_PROBLEM;
    }
    if (check_tubes(d, i, list)) status = AMBULO_E_PROBLEM;
  }
  for (int i = 0; i < d->model->patch_count; i++) {
    if (d->model->patches[i].mirror < i || !ambulo__patch_is_used(d, i)) continue;
    if (check_patch(d, i, list)) status = AMBULO_E_PROBLEM;
  }
  return status;
}
