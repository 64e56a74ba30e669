/* judge/dense_force.c - the ground's normal force between the nodes.
 *
 *     | n.F(t) - ((1 - s) n.F(a) + s n.F(b)) | / m g,   a <= t <= b neighbouring nodes,
 *     s = (t - a) / (b - a)                                              body weights
 *
 * The straight line, because that is what motion.csv says: it has the nodes, and who draws it,
 * integrates it by trapezoids or compares it with a force plate joins them so. (A denser table,
 * --samples, has the true force; the accelerations behind it are just as free between the nodes.)
 * Of all contacts together, from the root wrench, and with ground reaction of each foot.
 */
#include "gait/contact_load.h"
#include "judge/dense.h"

#include <math.h>

typedef struct force {
  const ambulo__dense *dense;
  const char *subject;
  int foot; /* -1: all of it */
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

/* of a foot, the sum of its contacts */
static double normal_at(const force *f, int node) {
  const ambulo__channels *channels = &f->dense->problem->channels;
  if (f->foot < 0) return upward_at(f, node, ambulo__channel_force(channels, 0));
  double sum = 0.0;
  for (int slot = 0; slot < channels->slots; slot++)
    if (f->slots.foot[slot] == f->foot)
      sum += upward_at(f, node, ambulo__channel_foot_force(channels, slot, 0));
  return sum;
}

static void visit_force(const force *f, ambulo__dense_visitor visit, void *user) {
  const ambulo__dense *dense = f->dense;
  int index = ambulo__dense_rule_of_force(), samples = dense->samples;
  const ambulo__dense_rule *rule = ambulo__dense_rule_at(index);
  ambulo__dense_sample sample = {.rule = index,
                                 .family = ambulo__row_family(rule->kind),
                                 .subject = f->subject,
                                 .detail = "normal",
                                 .unit = ambulo__measure_text(rule->measure),
                                 .tolerance = rule->tolerance};
  for (int k = 0; k < dense->problem->nodes; k++) {
    double a = normal_at(f, k * samples);
    double b = k + 1 < dense->problem->nodes ? normal_at(f, (k + 1) * samples) : a;
    for (int i = 0; i < samples && k * samples + i < dense->fine->nodes; i++) {
      double line = a + (b - a) * i / samples;
      sample.time = dense->fine->times[k * samples + i];
      sample.value = fabs(normal_at(f, k * samples + i) - line);
      visit(user, &sample);
    }
  }
}

/* (A.2b) normal force beside what is linear between its nodes */
void ambulo__dense_force(const ambulo__dense *dense, ambulo__dense_visitor visit, void *user) {
  const ambulo_problem *p = dense->problem;
  force f = {.dense = dense,
             .subject = "total",
             .foot = -1,
             .weight = ambulo__model_weight(p->model),
             .slots = ambulo__slots_of(p->model)};
  if (p->definition.contact_count == 0 || !(f.weight > 0.0)) return;
  visit_force(&f, visit, user);
  for (f.foot = 0; f.foot < p->channels.feet; f.foot++) {
    f.subject = p->model->feet[f.foot].name;
    visit_force(&f, visit, user);
  }
}
