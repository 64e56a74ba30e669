/* solver/dense_samples.c - what happens between the nodes, as samples: violations of rows, slip,
 * normal force; the worst of each rule.
 */
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "contact/row_families.h"
#include "solver/dense.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* -------------------------------------------------------------------- rows */

/* names of obstacles belong to the problem that is judged, those of the finer one go with it */
static const char *detail_of(const ambulo__dense *dense, const ambulo__table_row *row) {
  const ambulo__solid *solid = ambulo__row_solid_of(&dense->fine->table, row);
  int about = solid ? solid->about : -1;
  if (solid && solid->kind == AMBULO__SOLID_HELD)
    return dense->problem->definition.holds[solid->held - 1].name;
  return about < 0 ? row->detail : dense->problem->definition.obstacles[about].name;
}

/* Flight is held tighter at a few nodes, which the finer grid has elsewhere (contact/flight.c). */
static double missed(const ambulo__dense *dense, int r) {
  const ambulo_problem *fine = dense->fine;
  const ambulo__table_row *row = &fine->table.rows[r];
  double value = ambulo__row_violation(fine, r, dense->row_value[r]);
  if (row->kind != AMBULO__KIND_FLIGHT || value == 0.0) return value;
  return fmax(0.0, value - ambulo__flight_room(&fine->definition, &fine->table, row));
}

static const char *subject_of(const ambulo__dense *dense, const ambulo__table_row *row) {
  const ambulo__solid *solid = ambulo__row_solid_of(&dense->fine->table, row);
  if (!solid || solid->kind != AMBULO__SOLID_CARRIED) return row->subject;
  return dense->problem->definition.holds[solid->held - 1].name;
}

static void visit_row(const ambulo__dense *dense, int r, int index, ambulo__dense_visitor visit,
                      void *user) {
  const ambulo_problem *fine = dense->fine;
  const ambulo__table_row *row = &fine->table.rows[r];
  const ambulo__dense_rule *rule = ambulo__dense_rule_at(index);
  ambulo__dense_sample sample = {.rule = index,
                                 .family = row->family,
                                 .subject = subject_of(dense, row),
                                 .detail = detail_of(dense, row),
                                 .unit = row->unit,
                                 .time = row->time,
                                 .value = missed(dense, r),
                                 .tolerance = rule->tolerance};
  if (rule->of_limit) sample.tolerance *= ambulo__dense_limit_size(fine, row);
  visit(user, &sample);
}

/* (A.2) the rows again on the finer grid. Rows on unknowns and rows that join the two ends are the
 * same on every grid and left out. */
void ambulo__dense_rows(const ambulo__dense *dense, ambulo__dense_visitor visit, void *user) {
  const ambulo__row_table *table = &dense->fine->table;
  for (int r = 0; r < table->row_count; r++) {
    const ambulo__table_row *row = &table->rows[r];
    int elsewhere = row->node < 0 || row->kind == AMBULO__KIND_PASSIVE; /* see below */
    int rule = elsewhere ? -1 : ambulo__dense_rule_of_row(row);
    if (rule >= 0) visit_row(dense, r, rule, visit, user);
  }
}

/* -------------------------------------------------------------------- slip */

/* How far loaded points of feet and patches move along the ground between nodes.
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
  if (c->rolls && !ambulo__mode_is_flat(contact->mode)) return NULL;
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
  int index = AMBULO__DENSE_RULE_SLIP;
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

/* ------------------------------------------------------------ normal force */

/* The ground's normal force between the nodes.
 *
 *     | n.F(t) - ((1 - s) n.F(a) + s n.F(b)) | / m g,   a <= t <= b neighbouring nodes,
 *     s = (t - a) / (b - a)                                              body weights
 *
 * The straight line, because that is what motion.csv says: it has the nodes, and who draws it,
 * integrates it by trapezoids or compares it with a force plate joins them so. (A denser table,
 * --samples, has the true force; the accelerations behind it are just as free between the nodes.)
 * Of all contacts together, from the root wrench, and with ground reaction of each foot. A patch
 * may press any way: of one that is in contact at some time all of its force, as |f(t) - ...|.
 */

typedef struct force {
  const ambulo__dense *dense;
  const char *subject;
  int effector; /* contact/contacts.h; -1: all of it */
  double weight;
  ambulo__slots slots;
} force;

static double upward_at(const force *f, int node, int channel) {
  const double *up = f->dense->problem->model->up;
  double sum = 0.0;
  for (int axis = 0; axis < 3; axis++)
    sum += up[axis] * ambulo__dense_channel(f->dense, node, channel + axis);
  return sum / f->weight;
}

/* what counts of the force: its part upwards, then zeros; of a patch all three parts. Of a foot the
 * sum of its contacts. */
static void parts_at(const force *f, int node, double part[3]) {
  const ambulo_model *model = f->dense->problem->model;
  const ambulo__channels *channels = &f->dense->problem->channels;
  part[0] = part[1] = part[2] = 0.0;
  if (f->effector < 0) part[0] = upward_at(f, node, ambulo__channel_force(channels, 0));
  for (int slot = 0; f->effector >= 0 && slot < channels->slots; slot++) {
    int channel = ambulo__channel_foot_force(channels, slot, 0);
    if (f->slots.effector[slot] != f->effector) continue;
    if (f->effector < model->foot_count) part[0] += upward_at(f, node, channel);
    for (int i = 0; i < 3 && f->effector >= model->foot_count; i++)
      part[i] += ambulo__dense_channel(f->dense, node, channel + i) / f->weight;
  }
}

static void visit_force(const force *f, ambulo__dense_visitor visit, void *user) {
  const ambulo__dense *dense = f->dense;
  const ambulo_problem *p = dense->problem;
  int index = AMBULO__DENSE_RULE_FORCE, samples = dense->samples;
  const ambulo__dense_rule *rule = ambulo__dense_rule_at(index);
  ambulo__dense_sample sample = {.rule = index,
                                 .family = ambulo__row_family(rule->kind),
                                 .subject = f->subject,
                                 .detail = f->effector < p->model->foot_count ? "normal" : "",
                                 .unit = ambulo__measure_text(rule->measure),
                                 .tolerance = rule->tolerance};
  for (int k = 0; k < p->nodes; k++) {
    double a[3], b[3], now[3];
    parts_at(f, k * samples, a);
    parts_at(f, (k + 1 < p->nodes ? k + 1 : k) * samples, b);
    for (int i = 0; i < samples && k * samples + i < dense->fine->nodes; i++) {
      double square = 0.0;
      parts_at(f, k * samples + i, now);
      for (int j = 0; j < 3; j++) now[j] -= a[j] + (b[j] - a[j]) * i / samples;
      for (int j = 0; j < 3; j++) square += now[j] * now[j];
      sample.time = dense->fine->times[k * samples + i];
      sample.value = sqrt(square);
      visit(user, &sample);
    }
  }
}

/* (A.2b) normal force beside what is linear between its nodes */
void ambulo__dense_force(const ambulo__dense *dense, ambulo__dense_visitor visit, void *user) {
  const ambulo_problem *p = dense->problem;
  force f = {.dense = dense,
             .subject = "total",
             .effector = -1,
             .weight = ambulo__model_weight(p->model),
             .slots = ambulo__slots_of(&p->definition)};
  if (p->definition.contact_count == 0 || !(f.weight > 0.0)) return;
  visit_force(&f, visit, user);
  int effectors = p->channels.slots ? ambulo__effector_count(p->model) : 0;
  for (f.effector = 0; f.effector < effectors; f.effector++) {
    int patch = ambulo__effector_patch(p->model, f.effector);
    if (patch >= 0 && !ambulo__patch_is_used(&p->definition, patch)) continue;
    f.subject = ambulo__effector_name(p->model, f.effector);
    visit_force(&f, visit, user);
  }
}

/* ----------------------------------------------------------------- passive */

/* (A.2c) |tau| of what nothing drives (contact/passive.c); its tolerance counts in body weights, of
 * a torque times 1 m */
void ambulo__dense_passive(const ambulo__dense *dense, ambulo__dense_visitor visit, void *user) {
  const ambulo_problem *p = dense->problem;
  const double weight = ambulo__model_weight(p->model);
  for (int i = 0; i < p->coordinates; i++) {
    const ambulo_coordinate *c = &p->model->coordinates[i];
    if (!ambulo__is_passive(&p->definition, i)) continue;
    ambulo__table_row row = {.kind = AMBULO__KIND_PASSIVE};
    row.measure = (unsigned char)ambulo__row_measure(AMBULO__KIND_PASSIVE, c->type, 0);
    int rule = ambulo__dense_rule_of_row(&row);
    ambulo__dense_sample sample = {.rule = rule,
                                   .family = ambulo__row_family(AMBULO__KIND_PASSIVE),
                                   .subject = c->name,
                                   .detail = "driven",
                                   .unit = ambulo__measure_text((ambulo__measure)row.measure),
                                   .tolerance = ambulo__dense_rule_at(rule)->tolerance};
    sample.tolerance *= ambulo__measure_size((ambulo__measure)row.measure, weight);
    for (int k = 0; k < dense->fine->nodes; k++) {
      sample.time = dense->fine->times[k];
      sample.value = fabs(ambulo__dense_channel(dense, k, ambulo__channel_tau(&p->channels, i)));
      visit(user, &sample);
    }
  }
}

/* ------------------------------------------------------------------- worst */

typedef struct search {
  const ambulo__dense *dense;
  const ambulo__events *events;
  ambulo__dense_worst *worst;
} search;

/* NaN is worse than any number, and the first one stays */
static int is_worse(double ratio, double than) {
  if (isnan(than)) return 0;
  return isnan(ratio) || ratio > than;
}

static void note(void *user, const ambulo__dense_sample *sample) {
  search *s = user;
  ambulo__dense_entry *entry = &s->worst->entry[sample->rule];
  double ratio = ambulo__dense_ratio(sample);
  if (!entry->present || is_worse(ratio, entry->ratio)) {
    entry->present = 1;
    entry->sample = *sample;
    entry->ratio = ratio;
  }
  if (!is_worse(ratio, entry->between)) return;
  if (ambulo__dense_rule_at(sample->rule)->at_events &&
      ambulo__dense_beside_event(s->dense->problem, s->events, sample->time))
    return;
  entry->between = ratio;
}

/* (A.2) their worst, by family */
void ambulo__dense_worst_of(const ambulo__dense *dense, const ambulo__events *events,
                            ambulo__dense_worst *worst) {
  search s = {dense, events, worst};
  memset(worst, 0, sizeof *worst);
  ambulo__dense_rows(dense, note, &s);
  ambulo__dense_slip(dense, note, &s);
  ambulo__dense_force(dense, note, &s);
  ambulo__dense_passive(dense, note, &s);
}
