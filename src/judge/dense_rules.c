/* judge/dense_rules.c - the table of dense_rules.h.
 *
 * Tolerances: 1 mm, 0.005 rad, 0.02 body weights, 2 % of a speed or torque limit. Centres of
 * pressure count by the share of the load that the foot carries, as (17') counts zero-moment points
 * by the force: 5 cm under 0.4 % of the weight are 0.2 mm.
 *
 * Orders: of what lies between two nodes that both hold a row, and beside events, on the safe side
 * of what bench/bench_dense.c sees on the shipped problems, so that what is foretold from them
 * comes true there (docs/results.md has the measured ones).
 */
#include "judge/dense_rules.h"

#include <math.h>
#include <string.h>

enum { SLIP, FORCE };

#define REMEDY(name) AMBULO__REMEDY_##name

static const ambulo__dense_rule rules[AMBULO__DENSE_RULES] = {
    /* family, unit, tolerance; order_alone, order_both, order_landing; of_limit, by_load, at_events
     */
    {"slip", "m", 0.001, 1.5, 1.5, 2.0, 0, 0, 1, REMEDY(NONE)},
    {"ground_force", "body weights", 0.02, 1.0, 0.0, 1.0, 0, 0, 0, REMEDY(TOLERANCE)},
    {"ground_penetration", "m", 0.001, 1.5, 1.5, 2.0, 0, 0, 1, REMEDY(NONE)},
    {"foot_strike", "m", 0.001, 1.5, 1.5, 2.0, 0, 0, 1, REMEDY(NONE)},
    {"contact", "m", 0.001, 1.5, 1.5, 2.0, 0, 0, 1, REMEDY(NONE)},
    {"contact", "rad", 0.005, 1.5, 1.5, 1.5, 0, 0, 1, REMEDY(NONE)},
    {"clearance", "m", 0.001, 1.5, 1.5, 1.0, 0, 0, 1, REMEDY(NONE)},
    {"clearance", "rad", 0.005, 1.5, 1.5, 1.0, 0, 0, 1, REMEDY(NONE)},
    {"zmp", "m", 0.001, 0.0, 0.0, 1.0, 0, 0, 1, REMEDY(TRANSFER)},
    {"normal_force", "body weights", 0.02, 1.0, 0.0, 1.0, 0, 0, 1, REMEDY(TOLERANCE)},
    {"pressure", "m", 0.001, 1.0, 0.0, 0.75, 0, 1, 1, REMEDY(TOLERANCE)},
    {"friction", "body weights", 0.02, 1.0, 0.0, 1.0, 0, 0, 1, REMEDY(TOLERANCE)},
    {"free_moment", "m", 0.001, 1.5, 0.0, 1.0, 0, 0, 1, REMEDY(TOLERANCE)},
    {"joint_limit", "rad", 0.005, 1.5, 0.0, 1.0, 0, 0, 0, REMEDY(CONTROL_POINTS)},
    {"joint_limit", "m", 0.001, 1.5, 0.0, 1.0, 0, 0, 0, REMEDY(CONTROL_POINTS)},
    {"speed_limit", NULL, 0.02, 1.5, 0.0, 1.0, 1, 0, 0, REMEDY(TOLERANCE)},
    {"torque_limit", NULL, 0.02, 1.0, 0.0, 1.0, 1, 0, 0, REMEDY(TOLERANCE)},
    {"tracking_tube", "rad", 0.005, 1.5, 1.5, 1.0, 0, 0, 0, REMEDY(NONE)},
    {"tracking_tube", "m", 0.001, 1.5, 1.5, 1.0, 0, 0, 0, REMEDY(NONE)},
    /* families that are not named above, by their unit */
    {NULL, "m", 0.001, 1.0, 0.0, 1.0, 0, 0, 1, REMEDY(NONE)},
    {NULL, "rad", 0.005, 1.0, 0.0, 1.0, 0, 0, 1, REMEDY(NONE)},
    {NULL, "body weights", 0.02, 1.0, 0.0, 1.0, 0, 0, 1, REMEDY(NONE)},
    {NULL, NULL, 1e-6, 1.0, 0.0, 1.0, 0, 0, 1, REMEDY(NONE)},
};

static const char *const on_ends[] = {"initial_state", "final_state", "periodic", "mirrored"};

const ambulo__dense_rule *ambulo__dense_rule_at(int index) {
  return &rules[index];
}

static int matches(const char *wanted, const char *name) {
  return !wanted || strcmp(wanted, name) == 0;
}

int ambulo__dense_rule_of_row(const ambulo__table_row *row) {
  for (size_t i = 0; i < sizeof on_ends / sizeof *on_ends; i++) {
    if (strcmp(row->family, on_ends[i]) == 0) return -1;
  }
  int i = 0;
  while (!matches(rules[i].family, row->family) || !matches(rules[i].unit, row->unit)) i++;
  return i;
}

int ambulo__dense_rule_of_slip(void) {
  return SLIP;
}
int ambulo__dense_rule_of_force(void) {
  return FORCE;
}

/* of a limit on a quantity that may not be anything but zero */
static double size_of_none(const ambulo_model *model, const ambulo_coordinate *c, int is_torque) {
  if (!is_torque) return 1.0;
  const double *g = model->gravity;
  double weight = model->mass * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  double size = c->type == AMBULO_REVOLUTE ? 0.1 * weight : weight;
  return size > 0.0 ? size : 1.0;
}

double ambulo__dense_limit_size(const ambulo_problem *p, const ambulo__table_row *row) {
  int channel = p->table.terms[row->first_term].channel;
  int is_torque = channel >= ambulo__channel_tau(&p->channels, 0);
  int first =
      is_torque ? ambulo__channel_tau(&p->channels, 0) : ambulo__channel_qd(&p->channels, 0);
  const ambulo_coordinate *c = &p->model->coordinates[channel - first];
  const double *bounds = is_torque ? c->torque : c->speed;
  double size = 0.0;
  for (int i = 0; i < 2; i++) {
    if (isfinite(bounds[i])) size = fmax(size, fabs(bounds[i]));
  }
  return size > 0.0 ? size : size_of_none(p->model, c, is_torque);
}
