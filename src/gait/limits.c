/* gait/limits.c - joint angle, speed and torque limits.
 *
 *     lower: y - lo >= 0,   upper: hi - y >= 0,   y one of q (rad, m), qd, tau
 *
 * at every node, for finite limits only. A range of no width is one equation. Joint
 * limits may instead stand on the unknowns that are values: with B-splines the curve
 * lies in the convex hull of its control points, so such rows hold at all times. A
 * coordinate that is fixed has them there in any case: more nodes than control points
 * would repeat its equations, those less well conditioned the further they are apart.
 */
#include "gait/gait.h"

#include <math.h>

typedef struct limit {
  const char *family, *subject, *unit;
  double low, high;
  int node; /* -1: on an unknown */
  double time;
  int channel; /* or index of the unknown */
} limit;

static void limit_row(const limit *l, const char *detail, ambulo_relation relation, double sign,
                      double bound, ambulo__row_table *table) {
  ambulo__row_begin(table, l->family, l->subject, detail, l->unit, relation, l->node, l->time,
                    -sign * bound);
  ambulo__row_term_add(table, l->node, l->channel, sign);
}

static void add_limit(const limit *l, ambulo__row_table *table) {
  if (l->low == l->high) {
    limit_row(l, "fixed", AMBULO_EQUAL, 1.0, l->low, table);
    return;
  }
  if (isfinite(l->low)) limit_row(l, "lower", AMBULO_NOT_NEGATIVE, 1.0, l->low, table);
  if (isfinite(l->high)) limit_row(l, "upper", AMBULO_NOT_NEGATIVE, -1.0, l->high, table);
}

static int revolute(const ambulo_coordinate *coordinate) {
  return coordinate->type == AMBULO_REVOLUTE;
}

static int fixed_by_points(const ambulo__gait_frame *frame, int i) {
  const double *range = frame->model->coordinates[i].range;
  return range[0] == range[1] && ambulo__basis_get_kind(frame->basis) == AMBULO__BSPLINE;
}

static void node_limits(const ambulo__gait_frame *frame, int node, ambulo__row_table *table) {
  const ambulo_problem_definition *definition = frame->definition;
  for (int i = 0; i < frame->model->coordinate_count; i++) {
    const ambulo_coordinate *c = &frame->model->coordinates[i];
    limit l = {.subject = c->name, .node = node, .time = frame->times[node]};
    if (definition->joint_limits == AMBULO_LIMIT_NODES && !fixed_by_points(frame, i)) {
      l.family = "joint_limit";
      l.unit = revolute(c) ? "rad" : "m";
      l.low = c->range[0];
      l.high = c->range[1];
      l.channel = ambulo__channel_q(&frame->channels, i);
      add_limit(&l, table);
    }
    if (definition->speed_limits) {
      l.family = "speed_limit";
      l.unit = revolute(c) ? "rad/s" : "m/s";
      l.low = c->speed[0];
      l.high = c->speed[1];
      l.channel = ambulo__channel_qd(&frame->channels, i);
      add_limit(&l, table);
    }
    if (definition->torque_limits) {
      l.family = "torque_limit";
      l.unit = revolute(c) ? "N m" : "N";
      l.low = c->torque[0];
      l.high = c->torque[1];
      l.channel = ambulo__channel_tau(&frame->channels, i);
      add_limit(&l, table);
    }
  }
}

static void control_point_limits(const ambulo__gait_frame *frame, int fixed_only,
                                 ambulo__row_table *table) {
  int coordinates = frame->model->coordinate_count;
  int points = ambulo__basis_control_points(frame->basis);
  for (int p = 0; p < points; p++) {
    int is_value = 0;
    double time = ambulo__basis_abscissa(frame->basis, p, &is_value);
    if (!is_value) continue;
    for (int i = 0; i < coordinates; i++) {
      if (fixed_only && !fixed_by_points(frame, i)) continue;
      const ambulo_coordinate *c = &frame->model->coordinates[i];
      limit l = {.family = "joint_limit",
                 .subject = c->name,
                 .unit = revolute(c) ? "rad" : "m",
                 .low = c->range[0],
                 .high = c->range[1],
                 .node = -1,
                 .time = time,
                 .channel = p * coordinates + i};
      add_limit(&l, table);
    }
  }
}

void ambulo__limit_rows(const ambulo__gait_frame *frame, ambulo__row_table *table) {
  for (int node = 0; node < frame->nodes; node++) node_limits(frame, node, table);
  ambulo_limit_mode mode = frame->definition->joint_limits;
  if (mode != AMBULO_LIMIT_OFF) control_point_limits(frame, mode == AMBULO_LIMIT_NODES, table);
}
