/* contact/footholds.c - places of contacts against each other: within reach of the body, and again
 * where a motion that repeats begins again. */
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "contact/row_families.h"
#include "contact/schedule.h"

#include <math.h>
#include <stdio.h>

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

/* footholds at the end of a motion that repeats against those at its
 * beginning.
 *
 * A foot or patch that is down at T stands where it, or its mirror image when the ends are
 * mirrored, stands at 0, moved on by the travel:
 *
 *     place(T) = (place_f(0) + travel, +-place_l(0), place_n(0) + rise),   m;   - when mirrored
 *     heading(T) = +-heading(0),   normal(T) = (normal_f(0), +-normal_l(0), normal_n(0))
 *
 * It need not be down at both: at T it may strike, or leave the ground. Rows at the last node are
 * left out where they repeat those of the first (contact/rows.h), so a disagreement would be a
 * foot that slides in the last interval. It is what the wrong number of steps comes to, too: after
 * two steps the same foot strikes again, after one the other one does.
 */

static const double tolerance = 1e-6; /* m, rad and their rates */

/* do places enter the rows at all? */
static int uses_places(const ambulo_problem_definition *d) {
  return d->foot_strike || d->contact_tolerance > 0.0 || d->support != AMBULO_SUPPORT_OFF ||
         d->ground_reaction.kind != AMBULO_REACTION_NONE;
}

/* the next contact's surface is that of the first one, moved on */
static int leans_alike(const ambulo_problem_definition *d, const ambulo_contact *first,
                       const ambulo_contact *last) {
  ambulo_contact image = *first;
  double apart = 0.0;
  if (d->ends == AMBULO_ENDS_MIRRORED) image.normal[1] = -image.normal[1];
  image.heading = last->heading;
  ambulo__contact_frame one = ambulo__contact_frame_of(d, &image);
  ambulo__contact_frame other = ambulo__contact_frame_of(d, last);
  for (int i = 0; i < 3; i++) apart = fmax(apart, fabs(one.up[i] - other.up[i]));
  return apart <= tolerance;
}

/* at the same place of the plane: height, heading and slope */
static ambulo_status check_turned(const ambulo_problem_definition *d, const ambulo_contact *first,
                                  const ambulo_contact *last, double up, ambulo_diagnostics *list) {
  double side = d->ends == AMBULO_ENDS_MIRRORED ? -1.0 : 1.0, heading = side * first->heading;
  int effector = ambulo__effector_of(d->model, last);
  const char *kind = ambulo__effector_kind(d->model, effector);
  const char *name = ambulo__effector_name(d->model, effector);
  if (fabs(last->place[2] - up) > tolerance)
    return ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere, "change ends.rise",
                         "ends.rise: %s '%s' stands %.6g m high at t = %.6g s, but ends with a "
                         "rise of %.6g m put it at %.6g m; expected the same height",
                         kind, name, last->place[2], d->duration, d->rise, up);
  if (fabs(last->heading - heading) > tolerance)
    return ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere,
                         "a motion that turns does not repeat itself: leave 'ends.kind' out",
                         "contacts: %s '%s' is turned by %.6g rad at t = %.6g s, and by %.6g rad "
                         "where the motion begins again; expected the same",
                         kind, name, last->heading, d->duration, heading);
  if (!leans_alike(d, first, last))
    return ambulo__error(
        list, AMBULO_E_PROBLEM, ambulo__nowhere, NULL,
        "contacts: %s '%s' stands on the normal (%.6g, %.6g, %.6g) at t = %.6g s, and on (%.6g, "
        "%.6g, %.6g) where the motion begins again; expected the same direction",
        kind, name, last->normal[0], last->normal[1], last->normal[2], d->duration,
        first->normal[0], side * first->normal[1] + 0.0, first->normal[2]); /* no -0 */
  return AMBULO_OK;
}

static ambulo_status check_repeats(const ambulo_problem_definition *d, const ambulo_contact *first,
                                   const ambulo_contact *last, ambulo_diagnostics *list) {
  int mirrored = d->ends == AMBULO_ENDS_MIRRORED;
  double ahead = first->place[0] + d->travel;
  double left = mirrored ? -first->place[1] : first->place[1];
  double up = first->place[2] + d->rise;
  if (fabs(last->place[0] - ahead) <= tolerance && fabs(last->place[1] - left) <= tolerance)
    return check_turned(d, first, last, up, list);
  int one = ambulo__effector_of(d->model, first), other = ambulo__effector_of(d->model, last);
  const char *ends = mirrored ? "mirrored" : "periodic";
  return ambulo__error(
      list, AMBULO_E_PROBLEM, ambulo__nowhere,
      "mirrored ends go with an odd number of equal steps, periodic ends with an even number; or "
      "change the travel",
      "ends.travel: %s '%s' stands at (%.6g, %.6g) m at t = %.6g s, but %s ends with a travel of "
      "%.6g m put it at (%.6g, %.6g) m, from %s '%s' at (%.6g, %.6g) m at t = 0; expected the "
      "same place",
      ambulo__effector_kind(d->model, other), ambulo__effector_name(d->model, other),
      last->place[0], last->place[1], d->duration, ends, d->travel, ahead, left,
      ambulo__effector_kind(d->model, one), ambulo__effector_name(d->model, one), first->place[0],
      first->place[1]);
}

ambulo_status ambulo__schedule_check_ends(const ambulo_problem_definition *d,
                                          ambulo_diagnostics *list) {
  if (d->ends == AMBULO_ENDS_FREE || !uses_places(d)) return AMBULO_OK;
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *last = &d->contacts[i];
    if (last->to < d->duration - AMBULO__INSTANT) continue;
    int effector = ambulo__effector_of(d->model, last);
    if (d->ends == AMBULO_ENDS_MIRRORED) effector = ambulo__effector_mirror(d->model, effector);
    for (int k = 0; k < d->contact_count; k++) {
      const ambulo_contact *first = &d->contacts[k];
      if (ambulo__effector_of(d->model, first) != effector || first->from > AMBULO__INSTANT)
        continue;
      ambulo_status status = check_repeats(d, first, last, list);
      if (status) return status; /* one is enough: the others follow */
    }
  }
  return AMBULO_OK;
}
