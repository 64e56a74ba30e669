/* solver/dense_force.c - the ground's normal force between the nodes.
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
#include "contact/contacts.h"
#include "solver/dense.h"

#include <math.h>

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
  int index = ambulo__dense_rule_of_force(), samples = dense->samples;
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
