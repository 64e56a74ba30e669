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

/* contacts that the body can span.
 *
 * Whatever the angles, two points of a tree are no further apart than
 *
 *     reach = |p_a| + sum over the links between them of sqrt(a^2 + d^2) + |p_b|
 *
 * (each DH transform moves the origin by that much; p_a, p_b in their link frames). The
 * links are those from each point up to, not including, their common ancestor. A
 * prismatic joint among them can stretch without bound: no check.
 *
 * Compared are the points that two contacts hold (contact/contacts.h), whenever two
 * different feet or patches are down at the same time or hand over to each other. With a contact
 * tolerance each point may stand off its place by that much in every direction.
 */

static const double length_tolerance = 1e-9; /* m */

static int depth_of(const ambulo_model *model, int link) {
  int depth = 0;
  for (int i = link; i >= 0; i = model->links[i].parent) depth++;
  return depth;
}

static double link_length(const ambulo_link *link) {
  return link->type == AMBULO_PRISMATIC ? INFINITY : hypot(link->a, link->d);
}

static double point_offset(const ambulo_model *model, int point) {
  const double *p = model->points[point].position;
  return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

static double reach_between(const ambulo_model *model, int a, int b) {
  double reach = point_offset(model, a) + point_offset(model, b);
  int i = model->points[a].link, j = model->points[b].link;
  int depth_i = depth_of(model, i), depth_j = depth_of(model, j);
  while (i != j) {
    int climb_i = depth_i >= depth_j, climb_j = depth_j >= depth_i;
    if (climb_i) {
      reach += link_length(&model->links[i]);
      i = model->links[i].parent;
      depth_i--;
    }
    if (climb_j) {
      reach += link_length(&model->links[j]);
      j = model->links[j].parent;
      depth_j--;
    }
  }
  return reach;
}

/* the first node at which both contacts hold, or the instant of the hand-over */
static double common_time(const double *times, int nodes, int feet, const int *active, int i,
                          const ambulo_contact *a, int j, const ambulo_contact *b) {
  for (int k = 0; k < nodes; k++) {
    const int *at = active + k * feet;
    if (a->foot < 0 || b->foot < 0) break;
    if (at[a->foot] == i && at[b->foot] == j) return times[k];
  }
  return fmax(a->from, b->from);
}

static int point_of(const ambulo_problem_definition *definition, const ambulo_contact *contact,
                    double place[3]) {
  ambulo__foot_outline outline = {.length = 0.0};
  if (contact->foot >= 0) outline = ambulo__foot_outline_of(definition->model, contact->foot);
  return ambulo__contact_point(definition, &outline, contact, place);
}

static ambulo_status check_pair(const ambulo_problem_definition *definition, int i, int j,
                                double time, ambulo_diagnostics *diagnostics) {
  const ambulo_model *model = definition->model;
  const ambulo_contact *a = &definition->contacts[i], *b = &definition->contacts[j];
  double place_a[3], place_b[3];
  int effector_a = ambulo__effector_of(model, a), effector_b = ambulo__effector_of(model, b);
  int point_a = point_of(definition, a, place_a), point_b = point_of(definition, b, place_b);
  double square = 0.0;
  for (int k = 0; k < 3; k++) square += (place_a[k] - place_b[k]) * (place_a[k] - place_b[k]);
  double distance = sqrt(square);
  double slack = 2.0 * sqrt(3.0) * fmax(definition->contact_tolerance, 0.0);
  double reach = reach_between(model, point_a, point_b) + slack;
  if (distance <= reach + length_tolerance) return AMBULO_OK;
  char hint[80];
  int feet = a->foot >= 0 && b->foot >= 0;
  (void)snprintf(hint, sizeof hint, "%s by %.3g m or more",
                 feet ? "shorten the step" : "bring the places closer", distance - reach);
  return ambulo__error(
      diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, hint,
      "contacts[%d] (%s '%s') and contacts[%d] (%s '%s') are out of reach at "
      "t = %.6g s: %.4g m apart; expected at most %.4g m, the %s length",
      i, ambulo__effector_kind(model, effector_a), ambulo__effector_name(model, effector_a), j,
      ambulo__effector_kind(model, effector_b), ambulo__effector_name(model, effector_b), time,
      distance, reach, feet ? "legs'" : "links'");
}

/* (REACH) neighbouring footholds within the reach of both legs */
ambulo_status ambulo__schedule_check_reach(const ambulo_problem_definition *definition,
                                           const double *times, int nodes, const int *active,
                                           ambulo_diagnostics *diagnostics) {
  ambulo_status status = AMBULO_OK;
  int feet = ambulo_model_foot_count(definition->model);
  if (!definition->foot_strike && !(definition->contact_tolerance > 0.0)) return AMBULO_OK;
  for (int i = 0; i < definition->contact_count; i++) {
    for (int j = i + 1; j < definition->contact_count; j++) {
      const ambulo_contact *a = &definition->contacts[i], *b = &definition->contacts[j];
      if (ambulo__effector_of(definition->model, a) == ambulo__effector_of(definition->model, b))
        continue;
      if (fmin(a->to, b->to) < fmax(a->from, b->from) - AMBULO__INSTANT) continue;
      double time = common_time(times, nodes, feet, active, i, a, j, b);
      ambulo_status one = check_pair(definition, i, j, time, diagnostics);
      if (one) status = one;
    }
  }
  return status;
}
