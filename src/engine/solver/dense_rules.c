/* solver/dense_rules.c - the table of dense_rules.h.
 *
 * Tolerances: 1 mm, 0.005 rad, 0.02 body weights, 2 % of a speed or torque limit. Rows
 * on centres of pressure have the load in them, as (17') counts zero-moment points by the force:
 * 5 cm under 0.4 % of the weight are 0.2 mm.
 *
 * Orders: of what lies between two nodes that both hold a row, and beside events, on the safe side
 * of what bench/bench_dense.c sees on the shipped problems, so that what is predicted from them
 * comes true there (docs/results.md has the measured ones).
 */
#include "solver/dense_rules.h"

#include <math.h>

enum { SLIP, FORCE };

#define REMEDY(name) AMBULO__REMEDY_##name

static const ambulo__dense_rule rules[AMBULO__DENSE_RULES] = {
    /* kind, measure, tolerance; order_alone, order_both, order_landing; of_limit, at_events */
    {AMBULO__KIND_SLIP, AMBULO__METRES, 0.001, 1.5, 1.5, 2.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_GROUND_FORCE, AMBULO__BODY_WEIGHTS, 0.02, 1.0, 0.0, 1.0, 0, 0, REMEDY(TOLERANCE)},
    {AMBULO__KIND_GROUND_PENETRATION, AMBULO__METRES, 0.001, 1.5, 1.5, 2.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_FOOT_STRIKE, AMBULO__METRES, 0.001, 1.5, 1.5, 2.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_CONTACT, AMBULO__METRES, 0.001, 1.5, 1.5, 2.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_CONTACT, AMBULO__RADIANS, 0.005, 1.5, 1.5, 1.5, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_CLEARANCE, AMBULO__METRES, 0.001, 1.5, 1.5, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_CLEARANCE, AMBULO__RADIANS, 0.005, 1.5, 1.5, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_ZMP, AMBULO__METRES, 0.001, 0.0, 0.0, 1.0, 0, 1, REMEDY(TRANSFER)},
    {AMBULO__KIND_NORMAL_FORCE, AMBULO__BODY_WEIGHTS, 0.02, 1.0, 0.0, 1.0, 0, 1, REMEDY(TOLERANCE)},
    {AMBULO__KIND_PRESSURE, AMBULO__METRES, 0.001, 1.0, 0.0, 0.75, 0, 1, REMEDY(TOLERANCE)},
    {AMBULO__KIND_FRICTION, AMBULO__BODY_WEIGHTS, 0.02, 1.0, 0.0, 1.0, 0, 1, REMEDY(TOLERANCE)},
    {AMBULO__KIND_FREE_MOMENT, AMBULO__METRES, 0.001, 1.5, 0.0, 1.0, 0, 1, REMEDY(TOLERANCE)},
    {AMBULO__KIND_FLIGHT, AMBULO__BODY_WEIGHTS, 0.02, 1.0, 0.0, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_FLIGHT, AMBULO__METRES, 0.02, 1.0, 0.0, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_JOINT_LIMIT, AMBULO__RADIANS, 0.005, 1.5, 0.0, 1.0, 0, 0, REMEDY(CONTROL_POINTS)},
    {AMBULO__KIND_JOINT_LIMIT, AMBULO__METRES, 0.001, 1.5, 0.0, 1.0, 0, 0, REMEDY(CONTROL_POINTS)},
    {AMBULO__KIND_SPEED_LIMIT, AMBULO__OTHER_MEASURE, 0.02, 1.5, 0.0, 1.0, 1, 0, REMEDY(TOLERANCE)},
    {AMBULO__KIND_TORQUE_LIMIT, AMBULO__OTHER_MEASURE, 0.02, 1.0, 0.0, 1.0, 1, 0,
     REMEDY(TOLERANCE)},
    {AMBULO__KIND_COLLISION, AMBULO__METRES, 0.001, 1.5, 1.5, 1.0, 0, 0, REMEDY(NONE)},
    {AMBULO__KIND_OBSTACLE, AMBULO__METRES, 0.001, 1.5, 1.5, 1.0, 0, 0, REMEDY(NONE)},
    {AMBULO__KIND_REACH, AMBULO__METRES, 0.001, 1.5, 1.5, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_TRACKING_TUBE, AMBULO__RADIANS, 0.005, 1.5, 1.5, 1.0, 0, 0, REMEDY(NONE)},
    {AMBULO__KIND_TRACKING_TUBE, AMBULO__METRES, 0.001, 1.5, 1.5, 1.0, 0, 0, REMEDY(NONE)},
};

const ambulo__dense_rule *ambulo__dense_rule_at(int index) {
  return &rules[index];
}

static int covers(const ambulo__dense_rule *rule, const ambulo__table_row *row) {
  return rule->kind == row->kind &&
         (rule->measure == AMBULO__OTHER_MEASURE || rule->measure == row->measure);
}

int ambulo__dense_rule_of_row(const ambulo__table_row *row) {
  int i = 0;
  while (i < AMBULO__DENSE_RULES && !covers(&rules[i], row)) i++;
  return i < AMBULO__DENSE_RULES ? i : -1;
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
  double weight = ambulo__model_weight(model);
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
