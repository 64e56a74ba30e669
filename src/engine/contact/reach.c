/* contact/reach.c - contacts that the body can span.
 *
 * Whatever the angles, two points of a tree are no further apart than
 *
 *     reach = |p_a| + sum over the links between them of sqrt(a^2 + d^2) + |p_b|
 *
 * (each DH transform moves the origin by that much; p_a, p_b in their link frames). The
 * links are those from each point up to, not including, their common ancestor. A
 * prismatic joint among them can stretch without bound: no check.
 *
 * Compared are the points that two contacts hold (contact/foot_outline.h), whenever two
 * different feet or patches are down at the same time or hand over to each other. With a contact
 * tolerance each point may stand off its place by that much in every direction.
 */
#include "contact/foot_outline.h"
#include "base/arithmetic.h"
#include "contact/effector.h"
#include "contact/gait.h"

#include <math.h>
#include <stdio.h>

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
