/* contact/schedule.c - which contact is active at which node; contradictions in time.
 *
 * A node at t belongs to a contact when from <= t < to, both within 1e-9 s; a contact
 * that ends at the duration includes it. On a grid on events a node at t also belongs to what held
 * just before t. Overlaps and gaps are found on the time axis,
 * not only at the nodes: a finer grid must not turn a legal schedule into an illegal one.
 */
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "contact/row_families.h"

#include <math.h>
#include <stdio.h>

#define REFUSE(list, hint, ...)                                                                    \
  ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere, hint, __VA_ARGS__)

static ambulo_status check_effector(const ambulo_problem_definition *d, int index,
                                    ambulo_diagnostics *list) {
  const ambulo_contact *c = &d->contacts[index];
  const char *model = ambulo_model_name(d->model);
  if (ambulo__effector_is_known(d->model, c)) return AMBULO_OK;
  if (!ambulo__mode_is_of_patch(c->mode))
    return REFUSE(list, NULL, "contacts[%d]: no foot %d; the model '%s' has %d", index, c->foot,
                  model, ambulo_model_foot_count(d->model));
  if (c->foot != -1)
    return REFUSE(list, NULL, "contacts[%d]: foot %d in mode patch; expected foot -1", index,
                  c->foot);
  return REFUSE(list, NULL, "contacts[%d]: no patch %d; the model '%s' has %d", index, c->patch,
                model, ambulo_model_patch_count(d->model));
}

static int normal_is_legal(const ambulo_contact *c) {
  if (c->foot >= 0) return ambulo__contact_normal_is_legal(c->normal);
  return isfinite(c->normal[0]) && isfinite(c->normal[1]) && isfinite(c->normal[2]);
}

static ambulo_status check_contact(const ambulo_problem_definition *definition, int index,
                                   ambulo_diagnostics *list) {
  const ambulo_contact *c = &definition->contacts[index];
  double duration = definition->duration;
  ambulo_status status = check_effector(definition, index, list);
  if (status) return status;
  int effector = ambulo__effector_of(definition->model, c);
  const char *kind = ambulo__effector_kind(definition->model, effector);
  const char *name = ambulo__effector_name(definition->model, effector);
  if (!ambulo__mode_of(c->mode)) {
    return REFUSE(list, NULL,
                  "contacts[%d]: the mode of foot '%s' is %s (got %d); expected heel, flat or toe",
                  index, name, c->mode ? "unknown" : "not set", (int)c->mode);
  }
  if (c->foot >= 0 && c->mode != AMBULO_CONTACT_FLAT &&
      ambulo__foot_is_point(ambulo_model_foot(definition->model, c->foot))) {
    return REFUSE(list, NULL, "contacts[%d]: the point foot '%s' is %s; expected mode flat", index,
                  name, ambulo__mode_of(c->mode)->posture);
  }
  if (!isfinite(c->place[0]) || !isfinite(c->place[1]) || !isfinite(c->place[2])) {
    return REFUSE(list, NULL,
                  "contacts[%d]: %s '%s' has the %s (%g, %g, %g) m; expected finite lengths", index,
                  kind, name, c->foot >= 0 ? "foothold" : "place", c->place[0], c->place[1],
                  c->place[2]);
  }
  if (!normal_is_legal(c) || !isfinite(c->heading)) {
    return REFUSE(list, NULL,
                  "contacts[%d]: %s '%s' stands on the normal (%g, %g, %g), turned by %g rad; "
                  "expected a finite normal%s, and a finite angle",
                  index, kind, name, c->normal[0], c->normal[1], c->normal[2], c->heading,
                  c->foot >= 0 ? ", up to 60 degrees from up" : "");
  }
  if (!(c->from >= -AMBULO__INSTANT) || !(c->to <= duration + AMBULO__INSTANT)) {
    return REFUSE(list, NULL,
                  "contacts[%d]: %s '%s' from %.6g s to %.6g s; expected times in 0 to %.6g s",
                  index, kind, name, c->from, c->to, duration);
  }
  int at_end = c->from == c->to && c->to >= duration - AMBULO__INSTANT;
  if (!(c->from < c->to) && !at_end) {
    return REFUSE(list, NULL, "contacts[%d]: %s '%s' from %.6g s to %.6g s; expected from < to",
                  index, kind, name, c->from, c->to);
  }
  return AMBULO_OK;
}

static ambulo_status check_overlaps(const ambulo_problem_definition *definition,
                                    ambulo_diagnostics *list) {
  const ambulo_model *model = definition->model;
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < definition->contact_count; i++) {
    for (int j = i + 1; j < definition->contact_count; j++) {
      const ambulo_contact *a = &definition->contacts[i], *b = &definition->contacts[j];
      int effector = ambulo__effector_of(model, a);
      if (ambulo__effector_of(model, b) != effector) continue;
      double common = fmin(a->to, b->to) - fmax(a->from, b->from);
      int both_at_end = common == 0.0 && a->to == b->to && (a->from == a->to || b->from == b->to);
      if (common <= AMBULO__INSTANT && !both_at_end) continue;
      const char *kind = ambulo__effector_kind(model, effector);
      status = REFUSE(list, NULL,
                      "contacts[%d] and contacts[%d] overlap on %s '%s': %.6g s to %.6g s and "
                      "%.6g s to %.6g s; expected one contact of a %s at a time",
                      i, j, kind, ambulo__effector_name(model, effector), a->from, a->to, b->from,
                      b->to, kind);
    }
  }
  return status;
}

/* The end of support that begins before `time` and lasts through it; `time` if none does. */
static double support_after(const ambulo_problem_definition *definition, double time) {
  double end = time;
  for (int i = 0; i < definition->contact_count; i++) {
    const ambulo_contact *c = &definition->contacts[i];
    if (c->from <= time + AMBULO__INSTANT && c->to > end) end = c->to;
  }
  return end;
}

static double next_contact(const ambulo_problem_definition *definition, double time) {
  double next = definition->duration;
  for (int i = 0; i < definition->contact_count; i++) {
    double from = definition->contacts[i].from;
    if (from > time && from < next) next = from;
  }
  return next;
}

/* contacts that share the load leave a body that nothing touches in flight */
static ambulo_status check_flight(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo__span flight;
  if (!(d->minimum_force > 0.0) || !ambulo__flight_span(d, &flight)) return AMBULO_OK;
  return REFUSE(list, "'--set ground_reaction.minimum_force=null' leaves it out",
                "ground_reaction.minimum_force: nothing presses on the ground from %.6g s to %.6g "
                "s, where the body is in flight (got %g body weights); expected none",
                flight.from, flight.to, d->minimum_force);
}

static ambulo_status check_gaps(const ambulo_problem_definition *definition,
                                ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  double time = 0.0;
  while (time < definition->duration - AMBULO__INSTANT) {
    double end = support_after(definition, time);
    if (end > time) {
      time = end;
      continue;
    }
    double next = next_contact(definition, time + AMBULO__INSTANT);
    status = REFUSE(list,
                    "rows on contacts, zmp and ground_reaction need support at all times; with "
                    "ground_reaction: {kind: shared} and no zmp the body may fly",
                    "contacts: no foot%s touches the ground from %.6g s to %.6g s; "
                    "expected at least one contact at every time",
                    definition->model->patch_count ? " and no patch" : "", time, next);
    time = next;
  }
  return status;
}

static ambulo_status check_support(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  if (d->support == AMBULO_SUPPORT_OFF && d->ground_reaction.kind == AMBULO_REACTION_SHARED)
    return check_flight(d, list);
  int is_needed = d->ground_penetration || d->foot_strike || d->support != AMBULO_SUPPORT_OFF ||
                  d->ground_reaction.kind != AMBULO_REACTION_NONE;
  return is_needed ? check_gaps(d, list) : AMBULO_OK;
}

void ambulo__schedule_before(const ambulo_problem_definition *d, const double *times, int nodes,
                             const int *active, int *before) {
  int feet = ambulo_model_foot_count(d->model);
  for (int foot = 0; foot < feet; foot++) before[foot] = active[foot];
  for (int i = feet; i < nodes * feet; i++) {
    const ambulo_contact *contact = ambulo__contact_before(d, i % feet, times[i / feet]);
    before[i] = contact ? (int)(contact - d->contacts) : -1;
  }
}

/* one zero-moment point and one plane serve feet on level ground only */
static ambulo_status check_level(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  if (d->support == AMBULO_SUPPORT_OFF) return AMBULO_OK;
  for (int i = 0; i < d->contact_count; i++) {
    if (d->contacts[i].foot >= 0) continue;
    return REFUSE(list, "ground_reaction: {kind: shared} takes contacts of patches",
                  "contacts[%d]: patch '%s' does not go with constraints.zmp; expected feet alone",
                  i, d->model->patches[d->contacts[i].patch].name);
  }
  if (ambulo__contacts_are_level(d)) return AMBULO_OK;
  return REFUSE(list, "ground_reaction: {kind: shared} stands on contacts of any place",
                "contacts: footholds of different height, slope or heading do not go with "
                "constraints.zmp; expected level ground");
}

ambulo_status ambulo__schedule_fill(const ambulo_problem_definition *definition,
                                    const double *times, int nodes, int *active,
                                    ambulo_diagnostics *diagnostics) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < definition->contact_count; i++) {
    ambulo_status one = check_contact(definition, i, diagnostics);
    if (one) status = one;
  }
  if (status) return status;
  status = check_overlaps(definition, diagnostics);
  ambulo_status support = check_support(definition, diagnostics);
  if (!status) status = support;
  if (status) return status;
  status = check_level(definition, diagnostics);
  if (status) return status;
  int feet = ambulo_model_foot_count(definition->model);
  for (int k = 0; k < nodes; k++) {
    for (int foot = 0; foot < feet; foot++) active[k * feet + foot] = -1;
    for (int i = 0; i < definition->contact_count; i++) {
      const ambulo_contact *c = &definition->contacts[i];
      if (c->foot >= 0 && ambulo__contact_holds(c, definition->duration, times[k]))
        active[k * feet + c->foot] = i;
    }
  }
  return AMBULO_OK;
}
