/* contact/mirror_check.c - what mirrored ends ask of a body: one step stands for both.
 *
 *   body     is its own mirror image (model/mirror_image.h)
 *   limits   what the limits of two partners leave in both halves (contact/row_families.h) is not
 * empty, where limits are rows tubes    two partners that both have a half width have the same; one
 * that the reference lacks may be free on one side, for the reference is that of one step
 *
 *   patches  that are in contact: the partner's middle is the mirror image at q = 0, on a link that
 *            moves with the partner coordinate, and of the same size
 *
 * Terms: problem/mirror_terms.c. Footholds: contact/footholds.c.
 */
#include "contact/contacts.h"
#include "contact/devices.h"
#include "contact/row_families.h"
#include "base/numtext.h"
#include "model/mirror_image.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <string.h>

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
  /* too little room for the travel: contact/ends.c says so */
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

/* devices on the two sides of the body.
 *
 * In the mirror image q_m = s q_i. A device at coordinate i becomes one at m with
 *
 *     rest_m = s rest,  pretension_m = s pretension,  amount_m = s amount,  above <-> below if s <
 * 0
 *
 * A point of a link becomes one of the link that the partner of its mover moves: the place that at
 * q = 0 is the reflection of its own in the plane through up and forward. Strides become those of
 * the partner foot.
 */

#define MIRROR_DEVICES_REFUSE(list, ...)                                                           \
  ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere, AMBULO__BOTH_SIDES, __VA_ARGS__)

/* the coordinate that moves a link; -1: none */
static int mirror_devices_mover_of(const ambulo_model *m, int link) {
  while (link >= 0 && m->links[link].coordinate < 0) link = m->links[link].parent;
  return link < 0 ? -1 : m->links[link].coordinate;
}

static void reflect(const ambulo_model *m, double place[3]) {
  double aside = 0.0;
  for (int i = 0; i < 3; i++) aside += place[i] * m->left[i];
  for (int i = 0; i < 3; i++) place[i] -= 2.0 * aside * m->left[i];
}

static void mirror_point(const ambulo_model *m, int *link, double position[3]) {
  int mover = mirror_devices_mover_of(m, *link);
  double place[3];
  if (mover < 0) return;
  ambulo__neutral_place(m, *link, position, place);
  reflect(m, place);
  *link = m->coordinate_link[m->coordinates[mover].mirror];
  ambulo__neutral_local(m, *link, place, position);
}

static ambulo_device turned(ambulo_device device) {
  static const ambulo_device_side sides[] = {[AMBULO_DEVICE_BOTH] = AMBULO_DEVICE_BOTH,
                                             [AMBULO_DEVICE_ABOVE] = AMBULO_DEVICE_BELOW,
                                             [AMBULO_DEVICE_BELOW] = AMBULO_DEVICE_ABOVE};
  device.rest = -device.rest;
  device.pretension = -device.pretension;
  device.amount = -device.amount;
  device.side = sides[device.side];
  return device;
}

/* (D.9) */
ambulo_device ambulo__device_mirrored(const ambulo_model *m, const ambulo_device *device) {
  ambulo_device image = *device;
  if (device->foot >= 0) image.foot = ambulo__effector_mirror(m, device->foot);
  if (device->coordinate < 0) {
    for (int end = 0; end < 2; end++) mirror_point(m, &image.link[end], image.position[end]);
    return image;
  }
  const ambulo_coordinate *c = &m->coordinates[device->coordinate];
  image.coordinate = c->mirror;
  return c->mirror_sign < 0.0 ? turned(image) : image;
}

/* ------------------------------------------------------------------- check */

static int same(double a, double b) {
  return a == b || fabs(a - b) <= AMBULO__MIRROR_TOLERANCE * fmax(fabs(a), fabs(b));
}

static int same_place(const ambulo_model *m, int link, const double position[3], int other_link,
                      const double other[3]) {
  double own[3], its[3], square = 0.0;
  ambulo__neutral_place(m, link, position, own);
  ambulo__neutral_place(m, other_link, other, its);
  for (int i = 0; i < 3; i++) square += (own[i] - its[i]) * (own[i] - its[i]);
  return sqrt(square) <= 1e-6 &&
         mirror_devices_mover_of(m, link) == mirror_devices_mover_of(m, other_link);
}

int ambulo__places_mirror(const ambulo_model *m, int link, const double position[3], int other_link,
                          const double other[3]) {
  double image[3];
  memcpy(image, position, sizeof image);
  mirror_point(m, &link, image);
  return same_place(m, link, image, other_link, other);
}

static int same_point(const ambulo_model *m, const ambulo_device *a, int end,
                      const ambulo_device *b, int other) {
  return same_place(m, a->link[end], a->position[end], b->link[other], b->position[other]);
}

static int same_site(const ambulo_model *m, const ambulo_device *a, const ambulo_device *b) {
  if (a->coordinate != b->coordinate) return 0;
  if (a->coordinate >= 0) return 1;
  return (same_point(m, a, 0, b, 0) && same_point(m, a, 1, b, 1)) ||
         (same_point(m, a, 0, b, 1) && same_point(m, a, 1, b, 0));
}

static int same_law(const ambulo_device *a, const ambulo_device *b) {
  if (a->kind != b->kind) return 0;
  switch (a->kind) {
  case AMBULO_DEVICE_SPRING:
    return same(a->stiffness, b->stiffness) && same(a->rest, b->rest) &&
           same(a->pretension, b->pretension) && a->side == b->side &&
           (a->side == AMBULO_DEVICE_BOTH || same(a->smoothing, b->smoothing));
  case AMBULO_DEVICE_DAMPER:
    return same(a->damping, b->damping);
  case AMBULO_DEVICE_KIND_NOT_SET:
  case AMBULO_DEVICE_ACTUATOR:
    break;
  }
  if (a->clock != b->clock || !same(a->amount, b->amount)) return 0;
  if (a->clock == AMBULO_DEVICE_CONSTANT) return 1;
  if (a->point_count != b->point_count) return 0;
  for (int i = 0; i < a->point_count; i++) {
    if (!same(a->points[i][0], b->points[i][0]) || !same(a->points[i][1], b->points[i][1]))
      return 0;
  }
  return 1;
}

static int same_clock(const ambulo_device *a, const ambulo_device *b) {
  int by_stride = a->kind == AMBULO_DEVICE_ACTUATOR && a->clock == AMBULO_DEVICE_BY_STRIDE;
  if (a->clutch != b->clutch) return 0;
  if ((a->clutch || by_stride) && a->foot != b->foot) return 0;
  return !a->clutch || (same(a->from, b->from) && same(a->to, b->to) && same(a->ramp, b->ramp));
}

static int is_like(const ambulo_model *m, const ambulo_device *a, const ambulo_device *b) {
  return same_site(m, a, b) && same_law(a, b) && same_clock(a, b);
}

static int count_like(const ambulo_problem_definition *d, const ambulo_device *one) {
  int count = 0;
  for (int i = 0; i < d->device_count; i++) count += is_like(d->model, one, &d->devices[i]);
  return count;
}

/* of several that are alike, the one that is as far down among them as the device is among its own
 */
int ambulo__device_partner(const ambulo_problem_definition *d, int device, double *sign) {
  const ambulo_device *own = &d->devices[device];
  ambulo_device image = ambulo__device_mirrored(d->model, own);
  int before = 0;
  *sign = own->coordinate >= 0 ? d->model->coordinates[own->coordinate].mirror_sign : 1.0;
  for (int i = 0; i < device; i++) before += is_like(d->model, own, &d->devices[i]);
  for (int i = 0; i < d->device_count; i++) {
    if (is_like(d->model, &image, &d->devices[i]) && before-- == 0) return i;
  }
  return -1;
}

ambulo_status ambulo__devices_mirror_check(const ambulo_problem_definition *d,
                                           ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  if (d->ends != AMBULO_ENDS_MIRRORED) return AMBULO_OK;
  for (int i = 0; i < d->device_count; i++) {
    ambulo_device image = ambulo__device_mirrored(d->model, &d->devices[i]);
    if (count_like(d, &image) == count_like(d, &d->devices[i])) continue;
    status = MIRROR_DEVICES_REFUSE(
        list,
        "devices[%d]: '%s' has no equal on the other side of the body; expected 'mirror: "
        "true', or a device of the same numbers there, with mirrored ends",
        i, d->devices[i].name);
  }
  return status;
}
