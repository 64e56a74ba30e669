/* contact/limits.c - limits in both halves of a mirrored stride (bounds.h). */
#include "contact/row_families.h"

#include "ambulo/mechanics.h"
#include "base/arithmetic.h"
#include "mechanics/lagrangian.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double rounding = 1e-9; /* m: what right angles leave of a travel across them */

const double *ambulo__limits_of(const ambulo_coordinate *c, ambulo_limited what) {
  if (what == AMBULO_LIMITED_SPEED) return c->speed;
  return what == AMBULO_LIMITED_TORQUE ? c->torque : c->range;
}

static ambulo__bound own(const double *limit, int coordinate, int is_upper) {
  ambulo__bound bound = {limit[is_upper], coordinate, is_upper, limit[is_upper], 0.0};
  return bound;
}

/* what a limit of the partner m leaves to i: s y_i + shift = limit */
static ambulo__bound image(const double *limit, int partner, int is_upper, double sign,
                           double shift, double duration) {
  ambulo__bound bound = {sign * (limit[is_upper] - shift), partner, is_upper, limit[is_upper],
                         duration};
  return bound;
}

double ambulo__end_shift(const ambulo_problem_definition *definition, int i) {
  const ambulo_model *model = definition->model;
  if (definition->ends == AMBULO_ENDS_FREE || !ambulo__is_root_translation(model, i)) return 0.0;
  double axis[3], along = 0.0, upward = 0.0;
  ambulo__neutral_axis(model, i, axis);
  for (int k = 0; k < 3; k++) {
    along += axis[k] * model->forward[k];
    upward += axis[k] * model->up[k];
  }
  return definition->travel * along + definition->rise * upward;
}

ambulo__bounds ambulo__bounds_of(const ambulo_problem_definition *d, int i, ambulo_limited what) {
  const ambulo_coordinate *c = &d->model->coordinates[i];
  const double *limit = ambulo__limits_of(c, what);
  ambulo__bounds b = {own(limit, i, 0), own(limit, i, 1)};
  if (d->ends != AMBULO_ENDS_MIRRORED) return b;
  int m = c->mirror, turned = c->mirror_sign < 0.0;
  double shift = what == AMBULO_LIMITED_POSITION ? ambulo__end_shift(d, m) : 0.0;
  if (fabs(shift) < rounding) shift = 0.0;
  limit = ambulo__limits_of(&d->model->coordinates[m], what);
  ambulo__bound low = image(limit, m, turned, c->mirror_sign, shift, d->duration);
  ambulo__bound high = image(limit, m, !turned, c->mirror_sign, shift, d->duration);
  if (low.value > b.low.value) b.low = low;
  if (high.value < b.high.value) b.high = high;
  return b;
}

double ambulo__limit_given(const ambulo_model *model, const ambulo__table_row *row) {
  int i = ambulo_model_find_coordinate(model, row->subject);
  int is_upper = !strcmp(row->detail, "upper");
  int what = ambulo__row_kind_entry_of(row->kind)->limited;
  if (i < 0 || what == AMBULO__NOT_LIMITED) return is_upper ? row->constant : -row->constant;
  return ambulo__limits_of(&model->coordinates[i], (ambulo_limited)what)[is_upper];
}

void ambulo__bounds_whose(const ambulo_model *model, const ambulo__bounds *bounds,
                          char text[AMBULO__WHOSE_SIZE]) {
  const ambulo__bound *both[2] = {&bounds->low, &bounds->high};
  text[0] = '\0';
  for (int k = 0; k < 2; k++) {
    const ambulo__bound *b = both[k];
    size_t used = strlen(text);
    if (b->later == 0.0) continue;
    (void)snprintf(text + used, AMBULO__WHOSE_SIZE - used,
                   " (the %s end by the %s limit of %s, %.6g, in the mirrored half)",
                   k ? "upper" : "lower", b->is_upper ? "upper" : "lower",
                   model->coordinates[b->owner].name, b->given);
  }
}

/* joint angle, speed and torque limits.
 *
 *     lower: y - lo >= 0,   upper: hi - y >= 0,   y one of q (rad, m), qd, tau
 *
 * at every node, for finite limits only. A range of no width is one equation. Joint
 * limits may instead stand on the unknowns that are values: with B-splines the curve
 * lies in the convex hull of its control points, so such rows hold at all times. A
 * coordinate that is fixed has them there in any case: more nodes than control points
 * would repeat its equations, those less well conditioned the further they are apart.
 *
 * lo and hi are those of contact/row_families.h. Where a limit of the mirror partner is the
 * narrower one, the row carries its name and the time T later at which it comes to it.
 */

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

/* the motion stays close to a reference.
 *
 *     lower: q - (r(t) - w) >= 0,   upper: (r(t) + w) - q >= 0        (rad, m)
 *
 * at every node, for the coordinates with a finite half width w; r is linear between the
 * samples of the reference. A tube of no width is one equation.
 */

static const double furthest = 1e6; /* rad, m: of a reference */

ambulo_status ambulo__tubes_check(const ambulo_problem_definition *definition,
                                  ambulo_diagnostics *diagnostics) {
  size_t coordinates = (size_t)ambulo_model_coordinate_count(definition->model);
  for (int t = 0; t < definition->tube_count; t++) {
    const ambulo_tube *tube = &definition->tubes[t];
    if (tube->samples < 2 || !tube->reference || !tube->half_width)
      return ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL,
                           "constraints.tubes[%d]: %d samples, %s reference; expected at least 2 "
                           "and half widths",
                           t, tube->samples, tube->reference ? "a" : "no");
    for (size_t i = 0; i < coordinates; i++) {
      if (tube->half_width[i] >= 0.0) continue;
      return ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL,
                           "constraints.tubes[%d]: half width %g of '%s'; expected at least 0", t,
                           tube->half_width[i],
                           ambulo_model_coordinate(definition->model, (int)i)->name);
    }
    for (size_t i = 0; i < (size_t)tube->samples * coordinates; i++) {
      if (fabs(tube->reference[i]) <= furthest || !isfinite(tube->half_width[i % coordinates]))
        continue;
      return ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL,
                           "constraints.tubes[%d]: the reference of '%s' is %g; expected -%g to %g",
                           t,
                           ambulo_model_coordinate(definition->model, (int)(i % coordinates))->name,
                           tube->reference[i], furthest, furthest);
    }
  }
  return AMBULO_OK;
}

static double reference_at(const ambulo_tube *tube, int coordinates, int i, double share) {
  double position = share * (double)(tube->samples - 1);
  int left = (int)floor(position + 1e-9);
  if (left > tube->samples - 2) left = tube->samples - 2;
  double fraction = position - (double)left;
  const double *r = tube->reference + (size_t)left * (size_t)coordinates + (size_t)i;
  return r[0] + fraction * (r[coordinates] - r[0]);
}

static void tube_row(const ambulo__gait_context *context, int node, int i, const char *detail,
                     ambulo_relation relation, double sign, double bound,
                     ambulo__row_table *table) {
  const ambulo_coordinate *c = &context->model->coordinates[i];
  ambulo__row_begin(table, AMBULO__KIND_TRACKING_TUBE, c->name, detail,
                    ambulo__row_measure(AMBULO__KIND_TRACKING_TUBE, c->type, 0), relation, node,
                    context->times[node], -sign * bound);
  ambulo__row_term_add(table, node, ambulo__channel_q(&context->channels, i), sign);
}

void ambulo__tube_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  const ambulo_problem_definition *definition = context->definition;
  int coordinates = context->model->coordinate_count;
  for (int t = 0; t < definition->tube_count; t++) {
    const ambulo_tube *tube = &definition->tubes[t];
    for (int node = 0; node < context->nodes; node++) {
      double share = context->times[node] / definition->duration;
      for (int i = 0; i < coordinates; i++) {
        double width = tube->half_width[i];
        if (!isfinite(width)) continue;
        double r = reference_at(tube, coordinates, i, share);
        if (width == 0.0) {
          tube_row(context, node, i, "on", AMBULO_EQUAL, 1.0, r, table);
        } else {
          tube_row(context, node, i, "lower", AMBULO_NOT_NEGATIVE, 1.0, r - width, table);
          tube_row(context, node, i, "upper", AMBULO_NOT_NEGATIVE, -1.0, r + width, table);
        }
      }
    }
  }
}

/* can the joints carry the body at rest?
 *
 * Standing still in the neutral pose (q = 0), half the weight on each foot, both centres of
 * pressure under the centre of mass. The height z_f of that point of foot f gives the torques:
 *
 *     tau_i = tau_i(gravity alone) - sum_f (m g / 2) dz_f / dq_i
 *
 * by central differences, exact enough for a comparison. The centre of mass follows from the
 * root wrench: F = m g n, M = r x F. A torque beyond its limits is a warning, not an error: a
 * motion need not pass through this pose. Each joint is held against the model's own limits, also
 * with mirrored ends (contact/row_families.h): this pose is symmetric, so its partner is held
 * against its own as well.
 */

static const double step = 1e-5; /* rad, m */

typedef struct standing {
  const ambulo_model *model;
  double *q, *zero, *tau, *torque, *wrench, *points;
  void *scratch;
} standing;

static ambulo_status evaluate(const standing *s) {
  return ambulo__lagrangian(
      0, s->model, s->q, s->zero, s->zero,
      &(ambulo_outputs){
          .size = sizeof(ambulo_outputs), .tau = s->tau, .wrench = s->wrench, .points = s->points},
      s->scratch);
}

/* place of the centre of pressure between heel (0) and toe (1) of a foot */
static double pressure_at(const standing *s, const ambulo_foot *foot) {
  const ambulo_model *m = s->model;
  const double *heel = s->points + 3 * foot->heel_center, *toe = s->points + 3 * foot->toe_center;
  /* l . (r x F) = r . (F x l) = |F| r . (n x l) = -|F| r . f */
  double center = -ambulo__dot(m->left, s->wrench) / ambulo__dot(m->up, s->wrench + 3);
  return (center - ambulo__dot(m->forward, heel)) /
         (ambulo__dot(m->forward, toe) - ambulo__dot(m->forward, heel));
}

static double height(const standing *s, const ambulo_foot *foot, double share) {
  const double *heel = s->points + 3 * foot->heel_center, *toe = s->points + 3 * foot->toe_center;
  const double *up = s->model->up;
  return (1.0 - share) * ambulo__dot(up, heel) + share * ambulo__dot(up, toe);
}

/* torque = tau - the feet's part; 1 when the centre of mass stands over both feet */
static ambulo_status stand(standing *s, int *over) {
  const ambulo_model *m = s->model;
  ambulo_status status = evaluate(s);
  if (status) return status;
  double half = 0.5 * ambulo__dot(m->up, s->wrench + 3), share[2] = {0.0, 0.0};
  *over = 1;
  for (int f = 0; f < 2; f++) {
    share[f] = pressure_at(s, &m->feet[f]);
    if (!(share[f] >= 0.0 && share[f] <= 1.0)) *over = 0;
  }
  for (int i = 0; i < m->coordinate_count; i++) s->torque[i] = s->tau[i];
  for (int i = 0; i < m->coordinate_count; i++) {
    for (int side = -1; side <= 1; side += 2) {
      s->q[i] = (double)side * step;
      status = evaluate(s);
      if (status) return status;
      for (int f = 0; f < 2; f++)
        s->torque[i] -= (double)side * half * height(s, &m->feet[f], share[f]) / (2.0 * step);
    }
    s->q[i] = 0.0;
  }
  return AMBULO_OK;
}

static void compare(const standing *s, ambulo_diagnostics *list) {
  for (int i = 0; i < s->model->coordinate_count; i++) {
    const ambulo_coordinate *c = &s->model->coordinates[i];
    const char *unit =
        ambulo__measure_text(ambulo__row_measure(AMBULO__KIND_TORQUE_LIMIT, c->type, 0));
    double tolerance = 1e-3 * fmax(1.0, fabs(s->torque[i]));
    double needed = fabs(s->torque[i]) < 1e-6 ? 0.0 : s->torque[i];
    if (s->torque[i] >= c->torque[0] - tolerance && s->torque[i] <= c->torque[1] + tolerance)
      continue;
    ambulo__warning(list, ambulo__nowhere,
                    "widen the torque limits in the model, or torque_limits: false",
                    "%s needs %.4g %s to carry the body standing still; its torque limits are %.4g "
                    "to %.4g %s",
                    c->name, needed, unit, c->torque[0], c->torque[1], unit);
  }
}

ambulo_status ambulo__strength_check(const ambulo_problem_definition *d,
                                     const ambulo_allocator *allocator, ambulo_diagnostics *list) {
  const ambulo_model *m = d->model;
  int over = 0;
  if (d->ground_reaction.kind == AMBULO_REACTION_NONE || !d->torque_limits || m->foot_count != 2)
    return AMBULO_OK;
  size_t n = (size_t)m->coordinate_count;
  standing s = {.model = m};
  s.q = ambulo__alloc(allocator, 4 * n + 6 + 3 * (size_t)m->point_count, sizeof *s.q);
  s.scratch = ambulo__alloc_aligned(allocator, 1, ambulo__lagrangian_scratch_size(m));
  ambulo_status status = s.q && s.scratch ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) {
    s.zero = s.q + n;
    s.tau = s.zero + n;
    s.torque = s.tau + n;
    s.wrench = s.torque + n;
    s.points = s.wrench + 6;
    status = stand(&s, &over);
  }
  if (!status && over) compare(&s, list);
  ambulo__free(allocator, s.q);
  ambulo__free_aligned(allocator, s.scratch);
  return status;
}
