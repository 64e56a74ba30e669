/* contact/load_check.c - what is wrong with devices, by name. */
#include "base/arithmetic.h"
#include "contact/devices.h"
#include "model/model.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double largest = 1e9;

#define REFUSE(list, ...) ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere, NULL, __VA_ARGS__)

/* A number of a device with what it may be. */
typedef struct number {
  const char *what, *unit;
  double value, low, high;
} number;

static int is_within(const number *n) {
  return n->value >= n->low && n->value <= n->high;
}

static ambulo_status check_numbers(int i, const ambulo_device *device, const number *numbers,
                                   int count, ambulo_diagnostics *list) {
  for (int k = 0; k < count; k++) {
    const number *n = &numbers[k];
    if (is_within(n)) continue;
    return REFUSE(list, "devices[%d].%s of '%s' is %g%s; expected %g to %g%s", i, n->what,
                  device->name, n->value, n->unit, n->low, n->high, n->unit);
  }
  return AMBULO_OK;
}

static ambulo_status check_law(int i, const ambulo_device *v, ambulo_diagnostics *list) {
  const number spring[] = {{"stiffness", "", v->stiffness, 0.0, largest},
                           {"rest", "", v->rest, -largest, largest},
                           {"pretension", "", v->pretension, -largest, largest},
                           {"smoothing", "", v->smoothing, 1e-9, largest}};
  const number damper[] = {{"damping", "", v->damping, 0.0, largest}};
  const number actuator[] = {{"amount", "", v->amount, -largest, largest}};
  switch (v->kind) {
  case AMBULO_DEVICE_SPRING:
    if (v->side < AMBULO_DEVICE_BOTH || v->side > AMBULO_DEVICE_BELOW)
      return REFUSE(list, "devices[%d]: the side of '%s' is %s (got %d); expected one of its three",
                    i, v->name, v->side ? "unknown" : "not set", (int)v->side);
    return check_numbers(i, v, spring, v->side == AMBULO_DEVICE_BOTH ? 3 : 4, list);
  case AMBULO_DEVICE_DAMPER:
    return check_numbers(i, v, damper, 1, list);
  case AMBULO_DEVICE_ACTUATOR:
    return check_numbers(i, v, actuator, 1, list);
  case AMBULO_DEVICE_KIND_NOT_SET:
    break;
  }
  return REFUSE(list,
                "devices[%d]: the kind of '%s' is %s (got %d); expected an ambulo_device_kind", i,
                v->name, v->kind ? "unknown" : "not set", (int)v->kind);
}

static int is_by_stride(const ambulo_device *v) {
  return v->clutch || (v->kind == AMBULO_DEVICE_ACTUATOR && v->clock == AMBULO_DEVICE_BY_STRIDE);
}

static ambulo_status check_points(int i, const ambulo_device *v, ambulo_diagnostics *list) {
  if (v->kind != AMBULO_DEVICE_ACTUATOR || v->clock == AMBULO_DEVICE_CONSTANT) return AMBULO_OK;
  if (v->clock != AMBULO_DEVICE_BY_TIME && v->clock != AMBULO_DEVICE_BY_STRIDE)
    return REFUSE(list, "devices[%d]: the clock of '%s' is %s (got %d); expected one of its three",
                  i, v->name, v->clock ? "unknown" : "not set", (int)v->clock);
  if (v->point_count < 1 || !v->points)
    return REFUSE(list, "devices[%d]: '%s' has no points; expected at least one", i, v->name);
  for (int k = 0; k < v->point_count; k++) {
    const double *point = v->points[k];
    int finite = fabs(point[0]) <= largest && fabs(point[1]) <= largest;
    if (finite && (k == 0 || point[0] > v->points[k - 1][0])) continue;
    return REFUSE(list, "devices[%d].points[%d] of '%s' is at %g; expected rising numbers", i, k,
                  v->name, point[0]);
  }
  double first = v->points[0][0], last = v->points[v->point_count - 1][0];
  if (v->clock == AMBULO_DEVICE_BY_STRIDE && !(first >= 0.0 && last < 1.0))
    return REFUSE(list,
                  "devices[%d].points of '%s' are from %g to %g of the stride; expected from 0 to "
                  "less than 1, where it begins anew",
                  i, v->name, first, last);
  return AMBULO_OK;
}

static ambulo_status check_clutch(int i, const ambulo_device *v, ambulo_diagnostics *list) {
  if (!v->clutch) return AMBULO_OK;
  double length = v->to - v->from - floor(v->to - v->from);
  const number ends[] = {{"engaged.from", " of the stride", v->from, 0.0, 1.0},
                         {"engaged.to", " of the stride", v->to, 0.0, 1.0}};
  ambulo_status status = check_numbers(i, v, ends, 2, list);
  if (status) return status;
  if (length == 0.0)
    return REFUSE(
        list, "devices[%d].engaged of '%s' is from %g to %g of the stride; expected a part of it",
        i, v->name, v->from, v->to);
  if (v->ramp >= 1e-6 && v->ramp <= 0.5 * length) return AMBULO_OK;
  return REFUSE(list,
                "devices[%d].engaged.ramp of '%s' is %g of the stride; expected up to half of what "
                "it is engaged for, %g",
                i, v->name, v->ramp, 0.5 * length);
}

static ambulo_status check_driven(const ambulo_model *m, int i, const ambulo_device *v,
                                  int coordinate, ambulo_diagnostics *list) {
  if (m->coordinates[coordinate].actuated || !ambulo__carries_whole_body(m, coordinate))
    return AMBULO_OK;
  return REFUSE(
      list,
      "devices[%d]: '%s' would act on '%s', which moves the whole body; expected something "
      "between parts of the body",
      i, v->name, m->coordinates[coordinate].name);
}

/* what moves `link` below `common` */
static ambulo_status check_movers(const ambulo_model *m, int i, const ambulo_device *v, int link,
                                  int common, int *movers, ambulo_diagnostics *list) {
  for (; link != common; link = m->links[link].parent) {
    int coordinate = ambulo__moved_by(m, link);
    if (coordinate < 0) continue;
    ambulo_status status = check_driven(m, i, v, coordinate, list);
    if (status) return status;
    ++*movers;
  }
  return AMBULO_OK;
}

static ambulo_status check_between(const ambulo_model *m, int i, const ambulo_device *v,
                                   ambulo_diagnostics *list) {
  int movers = 0;
  for (int end = 0; end < 2; end++) {
    const double *p = v->position[end];
    if (v->link[end] < 0 || v->link[end] >= m->link_count)
      return REFUSE(list, "devices[%d]: '%s' is fixed to link %d; the model has %d", i, v->name,
                    v->link[end], m->link_count);
    if (!(fabs(p[0]) <= 100.0 && fabs(p[1]) <= 100.0 && fabs(p[2]) <= 100.0))
      return REFUSE(list,
                    "devices[%d]: '%s' is fixed at [%g, %g, %g] m of '%s'; expected a place on it",
                    i, v->name, p[0], p[1], p[2], m->links[v->link[end]].name);
  }
  int common = ambulo__path_common(m, v->link);
  for (int end = 0; end < 2; end++) {
    ambulo_status status = check_movers(m, i, v, v->link[end], common, &movers, list);
    if (status) return status;
  }
  if (movers > 0) return AMBULO_OK;
  return REFUSE(list,
                "devices[%d]: '%s' is between '%s' and '%s', which do not move against each other",
                i, v->name, m->links[v->link[0]].name, m->links[v->link[1]].name);
}

static ambulo_status check_site(const ambulo_model *m, int i, const ambulo_device *v,
                                ambulo_diagnostics *list) {
  if (v->coordinate < 0) return check_between(m, i, v, list);
  if (v->coordinate >= m->coordinate_count)
    return REFUSE(list, "devices[%d]: '%s' acts at coordinate %d; the model has %d", i, v->name,
                  v->coordinate, m->coordinate_count);
  return check_driven(m, i, v, v->coordinate, list);
}

static ambulo_status check_name(const ambulo_problem_definition *d, int i,
                                ambulo_diagnostics *list) {
  const char *name = d->devices[i].name;
  if (!name || !name[0]) return REFUSE(list, "devices[%d] has no name", i);
  for (int k = 0; k < i; k++) {
    if (d->devices[k].name && strcmp(d->devices[k].name, name) == 0)
      return REFUSE(list, "devices[%d]: there are two named '%s'; expected a name of its own", i,
                    name);
  }
  return AMBULO_OK;
}

static ambulo_status check_foot(const ambulo_problem_definition *d, int i,
                                ambulo_diagnostics *list) {
  const ambulo_device *v = &d->devices[i];
  if (!is_by_stride(v)) return AMBULO_OK;
  if (v->foot < 0 || v->foot >= d->model->foot_count)
    return REFUSE(list, "devices[%d]: '%s' goes by the stride of foot %d; the model has %d", i,
                  v->name, v->foot, d->model->foot_count);
  if (d->ends != AMBULO_ENDS_FREE) return AMBULO_OK;
  return REFUSE(list,
                "devices[%d]: '%s' goes by the stride of a foot, and the ends are free; expected a "
                "motion that repeats, with periodic or mirrored ends",
                i, v->name);
}

ambulo_status ambulo__devices_check(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < d->device_count; i++) {
    const ambulo_device *v = &d->devices[i];
    ambulo_status one = check_name(d, i, list);
    if (!one) one = check_law(i, v, list);
    if (!one) one = check_points(i, v, list);
    if (!one) one = check_clutch(i, v, list);
    if (!one) one = check_site(d->model, i, v, list);
    if (!one) one = check_foot(d, i, list);
    if (one) status = one;
  }
  return status;
}

ambulo_status ambulo__devices_check_strides(const ambulo_problem_definition *d,
                                            ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < d->device_count; i++) {
    const ambulo_device *v = &d->devices[i];
    ambulo__stride_now now;
    if (!is_by_stride(v) || ambulo__stride_at(d, v->foot, 0.0, &now)) continue;
    status = REFUSE(list,
                    "devices[%d]: '%s' goes by the stride of '%s', which does not strike; expected "
                    "contacts with which it comes down",
                    i, v->name, d->model->feet[v->foot].name);
  }
  return status;
}

/* what is wrong with what hands hold, by name. */

static const double hold_check_largest = 1e6, longest = 100.0; /* N, kg; m */

#define HOLD_CHECK_REFUSE(list, ...)                                                               \
  ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere, NULL, __VA_ARGS__)

static int is_point(const ambulo_model *m, int point) {
  return point >= 0 && point < m->point_count;
}

static int all_within(const double *v, double most) {
  for (int k = 0; k < 3; k++)
    if (!(fabs(v[k]) <= most)) return 0;
  return 1;
}

static ambulo_status check_hands(const ambulo_problem_definition *d, int i,
                                 ambulo_diagnostics *list) {
  const ambulo_hold *h = &d->holds[i];
  int pair = h->hand[1] >= 0;
  if (!is_point(d->model, h->hand[0]) || (pair && !is_point(d->model, h->hand[1])))
    return HOLD_CHECK_REFUSE(list,
                             "load '%s' is held by points %d and %d; expected points of the model",
                             h->name, h->hand[0], h->hand[1]);
  const ambulo_point *one = &d->model->points[h->hand[0]];
  if (pair && h->hand[0] == h->hand[1])
    return HOLD_CHECK_REFUSE(list, "load '%s' is held by '%s' twice; expected two points", h->name,
                             one->name);
  if (!pair && (h->inertia != 0.0 || !all_within(h->center, 0.0)))
    return HOLD_CHECK_REFUSE(
        list, "load '%s' has an inertia or a center, but one hand, '%s'; expected two hands",
        h->name, one->name);
  for (int hand = 0; hand < 1 + pair; hand++) {
    const ambulo_point *point = &d->model->points[h->hand[hand]];
    int link = point->link;
    while (link >= 0 && d->model->links[link].coupled_to < 0) link = d->model->links[link].parent;
    if (link >= 0)
      return HOLD_CHECK_REFUSE(list,
                               "load '%s' is held by '%s', which hangs on the coupled joint '%s'; "
                               "expected points that no coupled joint carries",
                               h->name, point->name, d->model->links[link].name);
  }
  return AMBULO_OK;
}

static ambulo_status hold_check_check_numbers(const ambulo_problem_definition *d, int i,
                                              ambulo_diagnostics *list) {
  const ambulo_hold *h = &d->holds[i];
  if (!(h->mass >= 0.0 && h->mass <= hold_check_largest) ||
      !(h->inertia >= 0.0 && h->inertia <= hold_check_largest))
    return HOLD_CHECK_REFUSE(list, "load '%s': mass %g kg, inertia %g kg m^2; expected 0 to %g",
                             h->name, h->mass, h->inertia, hold_check_largest);
  if (!all_within(h->center, longest) || !all_within(h->size, longest) ||
      !all_within(h->force, hold_check_largest))
    return HOLD_CHECK_REFUSE(list, "load '%s': a center, size or force beyond %g m or %g N",
                             h->name, longest, hold_check_largest);
  if (h->mass == 0.0 && h->inertia == 0.0 && all_within(h->force, 0.0))
    return HOLD_CHECK_REFUSE(list, "load '%s' has neither mass nor force; expected one of them",
                             h->name);
  return AMBULO_OK;
}

static ambulo_status check_window(const ambulo_problem_definition *d, int i,
                                  ambulo_diagnostics *list) {
  const ambulo_hold *h = &d->holds[i];
  double from = fmax(h->from, 0.0), to = fmin(h->to, d->duration), time[4];
  int ramps = ambulo__hold_events(h, d->duration, time) / 2;
  if (!(h->from < d->duration) || !(h->to > 0.0) || !(from < to))
    return HOLD_CHECK_REFUSE(list,
                             "load '%s' is held from %g s to %g s; expected times within 0 to %g s",
                             h->name, h->from, h->to, d->duration);
  if (!(h->ramp > 0.0) || ramps * h->ramp > to - from + AMBULO__INSTANT)
    return HOLD_CHECK_REFUSE(
        list,
        "load '%s' is taken up and set down over %g s each; expected above 0, and no "
        "more than the %g s for which it is held",
        h->name, h->ramp, to - from);
  return AMBULO_OK;
}

static ambulo_status hold_check_check_name(const ambulo_problem_definition *d, int i,
                                           ambulo_diagnostics *list) {
  const char *name = d->holds[i].name;
  if (!name || !name[0]) return HOLD_CHECK_REFUSE(list, "a load in hands without a name");
  for (int k = 0; k < i; k++)
    if (d->holds[k].name && strcmp(d->holds[k].name, name) == 0)
      return HOLD_CHECK_REFUSE(list, "two loads in hands are named '%s'; expected different names",
                               name);
  return AMBULO_OK;
}

ambulo_status ambulo__holds_check(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < d->hold_count; i++) {
    ambulo_status one = hold_check_check_name(d, i, list);
    if (!one) one = check_hands(d, i, list);
    if (!one) one = hold_check_check_numbers(d, i, list);
    if (!one) one = check_window(d, i, list);
    if (one) status = one;
  }
  return status;
}

ambulo_status ambulo__holds_mirror_check(const ambulo_problem_definition *d,
                                         ambulo_diagnostics *list) {
  if (d->ends != AMBULO_ENDS_MIRRORED) return AMBULO_OK;
  for (int i = 0; i < d->hold_count; i++) {
    const ambulo_hold *h = &d->holds[i];
    double time[4];
    const ambulo_point *one = &d->model->points[h->hand[0]];
    const ambulo_point *other = &d->model->points[h->hand[h->hand[1] >= 0]];
    if (ambulo__hold_events(h, d->duration, time) > 0)
      return HOLD_CHECK_REFUSE(
          list, "load '%s' is held from %g s to %g s; with mirrored ends expected all along",
          h->name, h->from, fmin(h->to, d->duration));
    if (h->center[1] != 0.0 || h->force[1] != 0.0 ||
        !ambulo__places_mirror(d->model, one->link, one->position, other->link, other->position))
      return HOLD_CHECK_REFUSE(
          list,
          "load '%s' is not its own mirror image; with mirrored ends expected points "
          "that are mirror images, and a center and a force without a part to the side",
          h->name);
  }
  return AMBULO_OK;
}
