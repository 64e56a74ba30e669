/* gait/schedule.c - which contact is active at which node; contradictions in time.
 *
 * A node at t belongs to a contact when from <= t < to, both within 1e-9 s; a contact
 * that ends at the duration includes it. On a grid on events a node at t also belongs to what held
 * just before t. Overlaps and gaps are found on the time axis,
 * not only at the nodes: a finer grid must not turn a legal schedule into an illegal one.
 */
#include "gait/contact_frame.h"
#include "gait/gait.h"
#include "base/instant.h"

#include <math.h>

#define REFUSE(list, hint, ...)                                                                    \
  ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere, hint, __VA_ARGS__)

int ambulo__contact_holds(const ambulo_contact *contact, double duration, double time) {
  if (time < contact->from - AMBULO__INSTANT) return 0;
  if (time < contact->to - AMBULO__INSTANT) return 1;
  return contact->to >= duration - AMBULO__INSTANT && time <= duration + AMBULO__INSTANT;
}

static ambulo_status check_contact(const ambulo_problem_definition *definition, int index,
                                   ambulo_diagnostics *list) {
  const ambulo_contact *c = &definition->contacts[index];
  double duration = definition->duration;
  int feet = ambulo_model_foot_count(definition->model);
  if (c->foot < 0 || c->foot >= feet) {
    return REFUSE(list, NULL, "contacts[%d]: no foot %d; the model '%s' has %d", index, c->foot,
                  ambulo_model_name(definition->model), feet);
  }
  const char *foot = ambulo_model_foot(definition->model, c->foot)->name;
  if ((int)c->mode < AMBULO_CONTACT_HEEL || (int)c->mode > AMBULO_CONTACT_TOE) {
    return REFUSE(list, NULL,
                  "contacts[%d]: foot '%s' in unknown mode %d; expected heel, flat or toe", index,
                  foot, (int)c->mode);
  }
  if (!isfinite(c->place[0]) || !isfinite(c->place[1]) || !isfinite(c->place[2])) {
    return REFUSE(list, NULL,
                  "contacts[%d]: foot '%s' has the foothold (%g, %g, %g) m; expected finite "
                  "lengths",
                  index, foot, c->place[0], c->place[1], c->place[2]);
  }
  if (!ambulo__contact_normal_is_legal(c->normal) || !isfinite(c->heading)) {
    return REFUSE(list, NULL,
                  "contacts[%d]: foot '%s' stands on the normal (%g, %g, %g), turned by %g rad; "
                  "expected a finite normal, up to 60 degrees from up, and a finite angle",
                  index, foot, c->normal[0], c->normal[1], c->normal[2], c->heading);
  }
  if (!(c->from >= -AMBULO__INSTANT) || !(c->to <= duration + AMBULO__INSTANT)) {
    return REFUSE(list, NULL,
                  "contacts[%d]: foot '%s' from %.6g s to %.6g s; expected times in 0 to "
                  "%.6g s",
                  index, foot, c->from, c->to, duration);
  }
  int at_end = c->from == c->to && c->to >= duration - AMBULO__INSTANT;
  if (!(c->from < c->to) && !at_end) {
    return REFUSE(list, NULL, "contacts[%d]: foot '%s' from %.6g s to %.6g s; expected from < to",
                  index, foot, c->from, c->to);
  }
  return AMBULO_OK;
}

static ambulo_status check_overlaps(const ambulo_problem_definition *definition,
                                    ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < definition->contact_count; i++) {
    for (int j = i + 1; j < definition->contact_count; j++) {
      const ambulo_contact *a = &definition->contacts[i], *b = &definition->contacts[j];
      if (a->foot != b->foot) continue;
      double common = fmin(a->to, b->to) - fmax(a->from, b->from);
      int both_at_end = common == 0.0 && a->to == b->to && (a->from == a->to || b->from == b->to);
      if (common <= AMBULO__INSTANT && !both_at_end) continue;
      status = REFUSE(list, NULL,
                      "contacts[%d] and contacts[%d] overlap on foot '%s': %.6g s to %.6g s and "
                      "%.6g s to %.6g s; expected one contact of a foot at a time",
                      i, j, ambulo_model_foot(definition->model, a->foot)->name, a->from, a->to,
                      b->from, b->to);
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
    status = REFUSE(list, "rows on contacts, zmp and ground_reaction need support at all times",
                    "contacts: no foot touches the ground from %.6g s to %.6g s; "
                    "expected at least one contact at every time",
                    time, next);
    time = next;
  }
  return status;
}

/* the contact of `foot` just before `time`; -1: in the air */
static int contact_before(const ambulo_problem_definition *d, int foot, double time) {
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    if (c->foot == foot && c->from < time - AMBULO__INSTANT && time <= c->to + AMBULO__INSTANT)
      return i;
  }
  return -1;
}

void ambulo__schedule_before(const ambulo_problem_definition *d, const double *times, int nodes,
                             const int *active, int *before) {
  int feet = ambulo_model_foot_count(d->model);
  for (int foot = 0; foot < feet; foot++) before[foot] = active[foot];
  for (int i = feet; i < nodes * feet; i++)
    before[i] = contact_before(d, i % feet, times[i / feet]);
}

/* one zero-moment point and one plane serve level ground only */
static ambulo_status check_level(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  int two_step = d->ground_reaction.kind == AMBULO_REACTION_TWO_STEP;
  if ((!two_step && d->support == AMBULO_SUPPORT_OFF) || ambulo__contacts_are_level(d))
    return AMBULO_OK;
  return REFUSE(list, "ground_reaction: {kind: shared} stands on contacts of any place",
                "contacts: footholds of different height, slope or heading do not go with %s; "
                "expected level ground",
                two_step ? "ground_reaction: {kind: two_step}" : "constraints.zmp");
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
  int needs_support = definition->ground_penetration || definition->foot_strike ||
                      definition->support != AMBULO_SUPPORT_OFF ||
                      definition->ground_reaction.kind != AMBULO_REACTION_NONE;
  ambulo_status gaps = needs_support ? check_gaps(definition, diagnostics) : AMBULO_OK;
  if (!status) status = gaps;
  if (status) return status;
  status = check_level(definition, diagnostics);
  if (status) return status;
  int feet = ambulo_model_foot_count(definition->model);
  for (int k = 0; k < nodes; k++) {
    for (int foot = 0; foot < feet; foot++) active[k * feet + foot] = -1;
    for (int i = 0; i < definition->contact_count; i++) {
      const ambulo_contact *c = &definition->contacts[i];
      if (ambulo__contact_holds(c, definition->duration, times[k])) active[k * feet + c->foot] = i;
    }
  }
  return AMBULO_OK;
}
