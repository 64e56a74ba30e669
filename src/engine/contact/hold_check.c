/* contact/hold_check.c - what is wrong with what hands hold, by name. */
#include "contact/devices.h"
#include "contact/holds.h"

#include "base/arithmetic.h"
#include "contact/hold_times.h"
#include "model/model.h"

#include <math.h>
#include <string.h>

static const double largest = 1e6, longest = 100.0; /* N, kg; m */

#define REFUSE(list, ...) ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere, NULL, __VA_ARGS__)

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
    return REFUSE(list, "load '%s' is held by points %d and %d; expected points of the model",
                  h->name, h->hand[0], h->hand[1]);
  const ambulo_point *one = &d->model->points[h->hand[0]];
  if (pair && h->hand[0] == h->hand[1])
    return REFUSE(list, "load '%s' is held by '%s' twice; expected two points", h->name, one->name);
  if (!pair && (h->inertia != 0.0 || !all_within(h->center, 0.0)))
    return REFUSE(list,
                  "load '%s' has an inertia or a center, but one hand, '%s'; expected two hands",
                  h->name, one->name);
  return AMBULO_OK;
}

static ambulo_status check_numbers(const ambulo_problem_definition *d, int i,
                                   ambulo_diagnostics *list) {
  const ambulo_hold *h = &d->holds[i];
  if (!(h->mass >= 0.0 && h->mass <= largest) || !(h->inertia >= 0.0 && h->inertia <= largest))
    return REFUSE(list, "load '%s': mass %g kg, inertia %g kg m^2; expected 0 to %g", h->name,
                  h->mass, h->inertia, largest);
  if (!all_within(h->center, longest) || !all_within(h->size, longest) ||
      !all_within(h->force, largest))
    return REFUSE(list, "load '%s': a center, size or force beyond %g m or %g N", h->name, longest,
                  largest);
  if (h->mass == 0.0 && h->inertia == 0.0 && all_within(h->force, 0.0))
    return REFUSE(list, "load '%s' has neither mass nor force; expected one of them", h->name);
  return AMBULO_OK;
}

static ambulo_status check_window(const ambulo_problem_definition *d, int i,
                                  ambulo_diagnostics *list) {
  const ambulo_hold *h = &d->holds[i];
  double from = fmax(h->from, 0.0), to = fmin(h->to, d->duration), time[4];
  int ramps = ambulo__hold_events(h, d->duration, time) / 2;
  if (!(h->from < d->duration) || !(h->to > 0.0) || !(from < to))
    return REFUSE(list, "load '%s' is held from %g s to %g s; expected times within 0 to %g s",
                  h->name, h->from, h->to, d->duration);
  if (!(h->ramp > 0.0) || ramps * h->ramp > to - from + AMBULO__INSTANT)
    return REFUSE(list,
                  "load '%s' is taken up and set down over %g s each; expected above 0, and no "
                  "more than the %g s for which it is held",
                  h->name, h->ramp, to - from);
  return AMBULO_OK;
}

static ambulo_status check_name(const ambulo_problem_definition *d, int i,
                                ambulo_diagnostics *list) {
  const char *name = d->holds[i].name;
  if (!name || !name[0]) return REFUSE(list, "a load in hands without a name");
  for (int k = 0; k < i; k++)
    if (d->holds[k].name && strcmp(d->holds[k].name, name) == 0)
      return REFUSE(list, "two loads in hands are named '%s'; expected different names", name);
  return AMBULO_OK;
}

ambulo_status ambulo__holds_check(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < d->hold_count; i++) {
    ambulo_status one = check_name(d, i, list);
    if (!one) one = check_hands(d, i, list);
    if (!one) one = check_numbers(d, i, list);
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
      return REFUSE(list,
                    "load '%s' is held from %g s to %g s; with mirrored ends expected all along",
                    h->name, h->from, fmin(h->to, d->duration));
    if (h->center[1] != 0.0 || h->force[1] != 0.0 ||
        !ambulo__places_mirror(d->model, one->link, one->position, other->link, other->position))
      return REFUSE(list,
                    "load '%s' is not its own mirror image; with mirrored ends expected points "
                    "that are mirror images, and a center and a force without a part to the side",
                    h->name);
  }
  return AMBULO_OK;
}
