/* contact/limits.c - joint angle, speed and torque limits.
 *
 *     lower: y - lo >= 0,   upper: hi - y >= 0,   y one of q (rad, m), qd, tau
 *
 * at every node, for finite limits only. A range of no width is one equation. Joint
 * limits may instead stand on the unknowns that are values: with B-splines the curve
 * lies in the convex hull of its control points, so such rows hold at all times. A
 * coordinate that is fixed has them there in any case: more nodes than control points
 * would repeat its equations, those less well conditioned the further they are apart.
 *
 * lo and hi are those of contact/bounds.h. Where a limit of the mirror partner is the narrower one,
 * the row carries its name and the time T later at which it comes to it.
 */
#include "contact/bounds.h"
#include "contact/gait.h"

#include <math.h>

typedef struct limit {
  ambulo__row_kind kind;
  ambulo__measure measure;
  ambulo__bounds bounds;
  int coordinate;
  int node; /* -1: on an unknown */
  double time;
  int channel; /* or index of the unknown */
} limit;

static void limit_row(const ambulo__gait_context *context, const limit *l,
                      const ambulo__bound *bound, const char *detail, ambulo_relation relation,
                      double sign, ambulo__row_table *table) {
  ambulo__row_begin(table, l->kind, context->model->coordinates[bound->owner].name, detail,
                    l->measure, relation, l->node, l->time + bound->later, -sign * bound->value);
  ambulo__row_term_add(table, l->node, l->channel, sign);
}

static void add_limit(const ambulo__gait_context *context, const limit *l,
                      ambulo__row_table *table) {
  static const char *const details[] = {"lower", "upper"};
  const ambulo__bound *low = &l->bounds.low, *high = &l->bounds.high;
  if (low->value == high->value) {
    const ambulo__bound *bound = high->owner == l->coordinate ? high : low;
    limit_row(context, l, bound, "fixed", AMBULO_EQUAL, 1.0, table);
    return;
  }
  if (isfinite(low->value))
    limit_row(context, l, low, details[low->is_upper], AMBULO_NOT_NEGATIVE, 1.0, table);
  if (isfinite(high->value))
    limit_row(context, l, high, details[high->is_upper], AMBULO_NOT_NEGATIVE, -1.0, table);
}

static int fixed_by_points(const ambulo__gait_context *context, int i) {
  ambulo__bounds b = ambulo__bounds_of(context->definition, i, AMBULO_LIMITED_POSITION);
  return b.low.value == b.high.value && ambulo__basis_get_kind(context->basis) == AMBULO__BSPLINE;
}

static void node_limits(const ambulo__gait_context *context, int node, ambulo__row_table *table) {
  const ambulo_problem_definition *definition = context->definition;
  const ambulo__channels *channels = &context->channels;
  for (int i = 0; i < context->model->coordinate_count; i++) {
    int asked[3] = {definition->joint_limits == AMBULO_LIMIT_NODES && !fixed_by_points(context, i),
                    definition->speed_limits, definition->torque_limits};
    int channel[3] = {ambulo__channel_q(channels, i), ambulo__channel_qd(channels, i),
                      ambulo__channel_tau(channels, i)};
    for (int k = 0; k < 3; k++) {
      ambulo_limited what = (ambulo_limited)(AMBULO_LIMITED_POSITION + k);
      if (!asked[k]) continue;
      ambulo__row_kind kind = ambulo__row_kind_of_limit(what);
      limit l = {kind,
                 ambulo__row_measure(kind, context->model->coordinates[i].type, 0),
                 ambulo__bounds_of(definition, i, what),
                 i,
                 node,
                 context->times[node],
                 channel[k]};
      add_limit(context, &l, table);
    }
  }
}

static void control_point_limits(const ambulo__gait_context *context, int fixed_only,
                                 ambulo__row_table *table) {
  int coordinates = context->model->coordinate_count;
  int points = ambulo__basis_control_points(context->basis);
  for (int p = 0; p < points; p++) {
    int is_value = 0;
    double time = ambulo__basis_abscissa(context->basis, p, &is_value);
    if (!is_value) continue;
    for (int i = 0; i < coordinates; i++) {
      if (fixed_only && !fixed_by_points(context, i)) continue;
      ambulo__row_kind kind = AMBULO__KIND_JOINT_LIMIT;
      limit l = {kind,
                 ambulo__row_measure(kind, context->model->coordinates[i].type, 0),
                 ambulo__bounds_of(context->definition, i, AMBULO_LIMITED_POSITION),
                 i,
                 -1,
                 time,
                 p * coordinates + i};
      add_limit(context, &l, table);
    }
  }
}

/* (14.c) limits of q, qd and tau, each side a row */
void ambulo__limit_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  for (int node = 0; node < context->nodes; node++) node_limits(context, node, table);
  ambulo_limit_mode mode = context->definition->joint_limits;
  if (mode != AMBULO_LIMIT_OFF) control_point_limits(context, mode == AMBULO_LIMIT_NODES, table);
}
