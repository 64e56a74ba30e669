/* solver/dense_slip.c - how far loaded points of feet and patches move along the ground between
 * nodes.
 *
 * A corner is loaded while a contact of its foot has it down (contact/contacts.h). With a and b
 * the nodes before and after t at which the corner stands loaded on the same foothold,
 *
 *     slip(t) = | t-part of  r(t) - ((1 - s) r(a) + s r(b)) |,   s = (t - a) / (b - a)        m
 *
 * the part along the ground of the distance from where the nodes have it. Before the first such
 * node, and after the last one until the contact ends, that node's place stands for the line: rows
 * hold for from <= t < to, so a toe is free from its last loaded node until toe-off (on a grid on
 * events the last loaded node is toe-off). Movements
 * from node to node are not slip: rows hold those, exactly or within contact_tolerance. A corner
 * that has no node while it is loaded moves away from where it came down. On its heel and on its
 * toes a foot with arcs rolls: how far it slips there the rows of its contact say. A patch in
 * contact is loaded in its middle, and slips along its own surface.
 */
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "solver/dense.h"

#include <math.h>
#include <stdlib.h>

enum { SEARCH = 2 }; /* nodes to either side: moved events lie up to one interval away */

typedef struct corner {
  const ambulo__dense *dense;
  int effector, point, is_heel, rolls;
  ambulo__dense_visitor visit;
  void *user;
} corner;

static const ambulo_contact *loading(const ambulo_problem *p, const corner *c, int index) {
  if (index < 0) return NULL;
  const ambulo_contact *contact = &p->definition.contacts[index];
  if (c->rolls && contact->mode != AMBULO_CONTACT_FLAT) return NULL;
  return ambulo__corner_in_contact(contact->mode, c->is_heel) ? contact : NULL;
}

/* on a grid on events a node has the corner loaded also when it is unloaded there */
static const ambulo_contact *contact_at(const ambulo_problem *p, const corner *c, int node) {
  int at = node * p->model->foot_count + c->effector;
  if (c->effector >= p->model->foot_count) {
    const ambulo_problem_definition *d = &p->definition;
    const ambulo_contact *now = ambulo__contact_of(d, c->effector, p->times[node]);
    if (now || !p->before) return now;
    return ambulo__contact_before(d, c->effector, p->times[node]);
  }
  const ambulo_contact *contact = loading(p, c, p->active[at]);
  return contact || !p->before ? contact : loading(p, c, p->before[at]);
}

/* r of the corner at a time between nodes of the finer grid */
static void place_at(const corner *c, double time, double r[3]) {
  const ambulo__dense *dense = c->dense;
  const ambulo_problem *fine = dense->fine;
  double s;
  int left = ambulo__node_at(fine, time, &s);
  for (int axis = 0; axis < 3; axis++) {
    int channel = ambulo__channel_point(&fine->channels, c->point, axis);
    double a = ambulo__dense_channel(dense, left, channel);
    double b = ambulo__dense_channel(dense, left + 1, channel);
    r[axis] = s == 0.0 ? a : s == 1.0 ? b : a + s * (b - a);
  }
}

/* the nearest node from `node` on in direction `step` that has the corner on that foothold; -1 */
static int holding_node(const corner *c, int node, int step, const ambulo_contact *there) {
  const ambulo_problem *p = c->dense->problem;
  for (int k = node; k >= 0 && k < p->nodes && abs(k - node) < SEARCH; k += step) {
    const ambulo_contact *contact = contact_at(p, c, k);
    if (contact &&
        hypot(hypot(contact->place[0] - there->place[0], contact->place[1] - there->place[1]),
              contact->place[2] - there->place[2]) < 1e-9)
      return k;
  }
  return -1;
}

/* where the nodes have the corner at `time`; 0 if no node does */
static int held_place(const corner *c, double time, const ambulo_contact *contact, double r[3]) {
  const ambulo_problem *p = c->dense->problem;
  double part;
  int node = ambulo__node_at(p, time, &part);
  int on_next = time >= p->times[node + 1] - AMBULO__INSTANT;
  int on_node = time <= p->times[node] + AMBULO__INSTANT;
  int a = holding_node(c, on_next ? node + 1 : node, -1, contact);
  int b = holding_node(c, on_node ? node : node + 1, 1, contact);
  double ra[3], rb[3];
  if (a < 0 && b < 0) return 0;
  place_at(c, p->times[a < 0 ? b : a], ra);
  place_at(c, p->times[b < 0 ? a : b], rb);
  double s = a >= 0 && b > a ? (time - p->times[a]) / (p->times[b] - p->times[a]) : 0.0;
  for (int axis = 0; axis < 3; axis++) r[axis] = ra[axis] + s * (rb[axis] - ra[axis]);
  return 1;
}

static void visit_time(const corner *c, double time, const ambulo_contact *contact,
                       const double first[3]) {
  const ambulo_model *model = c->dense->problem->model;
  const double *up = model->up;
  ambulo__contact_frame frame;
  double r[3], held[3], normal = 0.0, square = 0.0;
  if (contact->foot < 0) {
    frame = ambulo__contact_frame_of(&c->dense->problem->definition, contact);
    up = frame.up;
  }
  place_at(c, time, r);
  if (!held_place(c, time, contact, held))
    for (int i = 0; i < 3; i++) held[i] = first[i];
  for (int i = 0; i < 3; i++) normal += (r[i] - held[i]) * up[i];
  for (int i = 0; i < 3; i++) {
    double along = r[i] - held[i] - normal * up[i];
    square += along * along;
  }
  int index = ambulo__dense_rule_of_slip();
  const ambulo__dense_rule *rule = ambulo__dense_rule_at(index);
  ambulo__dense_sample sample = {.rule = index,
                                 .family = ambulo__row_family(rule->kind),
                                 .subject = model->points[c->point].name,
                                 .detail = "along the ground",
                                 .unit = ambulo__measure_text(rule->measure),
                                 .time = time,
                                 .value = sqrt(square),
                                 .tolerance = rule->tolerance};
  c->visit(c->user, &sample);
}

/* one uninterrupted loading, from finer node `j` on; returns the first node after it */
static int visit_loading(const corner *c, int j) {
  const ambulo_problem *fine = c->dense->fine;
  const ambulo_contact *contact = contact_at(fine, c, j), *last = contact;
  double first[3];
  place_at(c, fmax(contact->from, j > 0 ? fine->times[j - 1] : 0.0), first);
  if (contact->from < fine->times[j]) visit_time(c, contact->from, contact, first);
  for (; j < fine->nodes && (contact = contact_at(fine, c, j)) != NULL; j++) {
    visit_time(c, fine->times[j], contact, first);
    last = contact;
  }
  if (j < fine->nodes && last->to <= fine->times[j] + AMBULO__INSTANT)
    visit_time(c, last->to, last, first);
  return j;
}

static void visit_corner(const corner *c) {
  const ambulo_problem *fine = c->dense->fine;
  for (int j = 0; j < fine->nodes;) j = contact_at(fine, c, j) ? visit_loading(c, j) : j + 1;
}

/* (A.2a) way along the ground between two nodes that hold */
void ambulo__dense_slip(const ambulo__dense *dense, ambulo__dense_visitor visit, void *user) {
  const ambulo_problem *fine = dense->fine;
  const ambulo_model *model = fine->model;
  for (int foot = 0; fine->definition.contact_count && foot < model->foot_count; foot++) {
    ambulo__foot_outline outline = ambulo__foot_outline_of(model, foot);
    for (int i = 0; i < outline.count; i++) {
      corner c = {dense, foot, outline.point[i], outline.is_heel[i], outline.has_arcs, visit, user};
      visit_corner(&c);
    }
  }
  for (int p = 0; p < model->patch_count; p++) {
    corner c = {dense, model->foot_count + p, model->patches[p].point, 0, 0, visit, user};
    visit_corner(&c);
  }
}
