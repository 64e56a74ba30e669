/* contact/ends.c - the state at the two ends of the motion.
 *
 *   prescribed   D^o q_i(t_e) - value = 0                          unit of D^o q
 *   periodic     s_o (D^o q_i(T) - D^o q_i(0)) - shift_i = 0       rad, m
 *   mirrored     s_o (D^o q_m(T) - sign D^o q_i(0)) - shift_m = 0  rad, m
 *
 * with o = 0 .. ends_order, m the coordinate that takes the place of i in the mirror
 * image. s_0 = 1; s_o = 1 / max_c |D^o B_c(0)| is a time to the power o that turns
 * rates into the size of the control-point differences they stand for, so that all
 * these rows have the unit of q and compare with each other.
 * shift = travel (a . f) + rise (a . n) for the root translations (axis a, forward f, up n) at
 * o = 0.
 */
#include "ambulo/mechanics.h"
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "contact/row_families.h"
#include "contact/schedule.h"
#include "mechanics/lagrangian.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int channel_of(const ambulo__channels *channels, int order, int coordinate) {
  if (order == 0) return ambulo__channel_q(channels, coordinate);
  if (order == 1) return ambulo__channel_qd(channels, coordinate);
  return ambulo__channel_qdd(channels, coordinate);
}

static const char *const order_words[] = {"value", "rate", "acceleration"};

static void prescribed_row(const ambulo__gait_context *context, const ambulo_end_value *end,
                           ambulo__row_table *table) {
  const ambulo_coordinate *c = &context->model->coordinates[end->coordinate];
  ambulo__row_kind kind = end->final ? AMBULO__KIND_FINAL_STATE : AMBULO__KIND_INITIAL_STATE;
  int node = end->final ? context->nodes - 1 : 0;
  ambulo__row_begin(table, kind, c->name, order_words[end->order],
                    ambulo__row_measure(kind, c->type, end->order), AMBULO_EQUAL, node,
                    context->times[node], -end->value);
  ambulo__row_term_add(table, node, channel_of(&context->channels, end->order, end->coordinate),
                       1.0);
}

static double order_scale(const ambulo__gait_context *context, int order) {
  if (order == 0) return 1.0;
  ambulo__basis_point start;
  ambulo__basis_at(context->basis, 0.0, &start);
  double largest = 0.0;
  for (int k = 0; k < start.span; k++) largest = fmax(largest, fabs(start.weight[order][k]));
  return largest > 0.0 ? 1.0 / largest : 1.0;
}

static void matching_row(const ambulo__gait_context *context, int i, int order, int mirrored,
                         ambulo__row_table *table) {
  const ambulo_coordinate *from = &context->model->coordinates[i];
  int target = mirrored ? from->mirror : i;
  double sign = mirrored ? from->mirror_sign : 1.0;
  double scale = order_scale(context, order);
  double shift = order == 0 ? ambulo__end_shift(context->definition, target) : 0.0;
  const ambulo_coordinate *to = &context->model->coordinates[target];
  int last = context->nodes - 1;
  ambulo__row_kind kind = mirrored ? AMBULO__KIND_MIRRORED : AMBULO__KIND_PERIODIC;
  ambulo__row_begin(table, kind, to->name, order_words[order],
                    ambulo__row_measure(kind, to->type, 0), AMBULO_EQUAL, -1, context->times[last],
                    -shift);
  ambulo__row_term_add(table, last, channel_of(&context->channels, order, target), scale);
  ambulo__row_term_add(table, 0, channel_of(&context->channels, order, i), -sign * scale);
}

/* (14.d) what is prescribed, repeated or mirrored at the ends */
void ambulo__end_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  const ambulo_problem_definition *definition = context->definition;
  for (int e = 0; e < definition->end_value_count; e++) {
    prescribed_row(context, &definition->end_values[e], table);
  }
  if (definition->ends == AMBULO_ENDS_FREE) return;
  int mirrored = definition->ends == AMBULO_ENDS_MIRRORED;
  int highest = definition->ends_order < 2 ? definition->ends_order : 2;
  for (int i = 0; i < context->model->coordinate_count; i++) {
    for (int order = 0; order <= highest; order++) {
      matching_row(context, i, order, mirrored, table);
    }
  }
}

/* end values that contradict limits, each other, or the ground.
 *
 *   ranges    lo <= value <= hi where limits are rows
 *   twice     one derivative of a coordinate at one end has one value
 *   matching  periodic: value(T) = value(0) + shift; mirrored: value_m(T) = sign value(0) + shift,
 *             shift = travel along the coordinate's axis at order 0, else 0
 *   travel    shift <= hi - lo where joint limits are rows
 *   speed     a coordinate that has to change by D within T moves at D / T on average: refused
 *             where that is beyond its speed limit
 *   ground    a corner whose whole chain of coordinates is prescribed stands where these put it:
 *             on the ground where the schedule has it down, not below it elsewhere
 */

static const double tolerance = 1e-6; /* m, rad and their rates */

static const char *const end_words[] = {"initial", "final"};
static const char *const order_keys[] = {"", "_speed", "_acceleration"};

#define REFUSE(list, hint, ...)                                                                    \
  ambulo__error(list, AMBULO_E_PROBLEM, ambulo__nowhere, hint, __VA_ARGS__)

static const char *unit_of(const ambulo_coordinate *c, int order) {
  return ambulo__measure_text(ambulo__row_measure(AMBULO__KIND_INITIAL_STATE, c->type, order));
}

/* the prescribed value; 0 when there is none */
static int value_at(const ambulo_problem_definition *d, int coordinate, int order, int final,
                    double *value) {
  for (int e = 0; e < d->end_value_count; e++) {
    const ambulo_end_value *end = &d->end_values[e];
    if (end->coordinate != coordinate || end->order != order || !end->final != !final) continue;
    *value = end->value;
    return 1;
  }
  return 0;
}

static ambulo_status check_range(const ambulo_problem_definition *d, const ambulo_end_value *end,
                                 ambulo_diagnostics *list) {
  const ambulo_coordinate *c = &d->model->coordinates[end->coordinate];
  int asked = end->order == 0   ? d->joint_limits != AMBULO_LIMIT_OFF
              : end->order == 1 ? d->speed_limits
                                : 0;
  ambulo__bounds b = ambulo__bounds_of(
      d, end->coordinate, end->order == 0 ? AMBULO_LIMITED_POSITION : AMBULO_LIMITED_SPEED);
  double low = b.low.value, high = b.high.value;
  if (!asked || (end->value >= low - tolerance && end->value <= high + tolerance)) return AMBULO_OK;
  char whose[AMBULO__WHOSE_SIZE];
  ambulo__bounds_whose(d->model, &b, whose);
  return REFUSE(list,
                end->order ? "change the end value, or set speed_limits: false"
                           : "change the end value, the range in the model, or joint_limits",
                "the %s %s of %s is %.6g %s; expected %.6g to %.6g %s, its limits%s",
                end_words[end->final != 0], order_words[end->order], c->name, end->value,
                unit_of(c, end->order), low, high, unit_of(c, end->order), whose);
}

static ambulo_status check_twice(const ambulo_problem_definition *d, int e,
                                 ambulo_diagnostics *list) {
  const ambulo_end_value *end = &d->end_values[e];
  double first = end->value;
  (void)value_at(d, end->coordinate, end->order, end->final, &first);
  if (fabs(first - end->value) <= tolerance) return AMBULO_OK;
  const ambulo_coordinate *c = &d->model->coordinates[end->coordinate];
  return REFUSE(list, NULL,
                "the %s %s of %s is prescribed twice: %.6g %s and %.6g %s; expected one",
                end_words[end->final != 0], order_words[end->order], c->name, first,
                unit_of(c, end->order), end->value, unit_of(c, end->order));
}

/* ------------------------------------------------------------------ both ends */

static ambulo_status check_matching(const ambulo_problem_definition *d, int i, int order,
                                    ambulo_diagnostics *list) {
  const ambulo_coordinate *from = &d->model->coordinates[i];
  int mirrored = d->ends == AMBULO_ENDS_MIRRORED, to = mirrored ? from->mirror : i;
  double first = 0.0, last = 0.0, sign = mirrored ? from->mirror_sign : 1.0;
  if (!value_at(d, i, order, 0, &first) || !value_at(d, to, order, 1, &last)) return AMBULO_OK;
  double shift = order == 0 ? ambulo__end_shift(d, to) : 0.0, expected = sign * first + shift;
  if (fabs(last - expected) <= tolerance) return AMBULO_OK;
  const char *unit = unit_of(from, order), *final = d->model->coordinates[to].name;
  char hint[200];
  (void)snprintf(hint, sizeof hint,
                 "leave one of the two out, the other follows (--set ends.final%s.%s=null)",
                 order_keys[order], final);
  return REFUSE(
      list, hint,
      "the final %s of %s is %.6g %s, but %s ends with a travel of %.6g m make it %.6g %s "
      "from the initial %s of %s, %.6g %s",
      order_words[order], final, last, unit, mirrored ? "mirrored" : "periodic", d->travel,
      expected, unit, order_words[order], from->name, first, unit);
}

/* how far coordinate i has to move from 0 to T; 0 when that is open */
static double change_of(const ambulo_problem_definition *d, int i) {
  double first = 0.0, last = 0.0;
  if (value_at(d, i, 0, 0, &first) && value_at(d, i, 0, 1, &last)) return last - first;
  return ambulo__end_shift(d, i);
}

static ambulo_status check_change(const ambulo_problem_definition *d, int i,
                                  ambulo_diagnostics *list) {
  const ambulo_coordinate *c = &d->model->coordinates[i];
  double change = change_of(d, i), speed = change / d->duration;
  const char *unit = unit_of(c, 0);
  char whose[AMBULO__WHOSE_SIZE];
  ambulo_status status = AMBULO_OK;
  ambulo__bounds range = ambulo__bounds_of(d, i, AMBULO_LIMITED_POSITION);
  ambulo__bounds speeds = ambulo__bounds_of(d, i, AMBULO_LIMITED_SPEED);
  double low = range.low.value, high = range.high.value;
  if (d->joint_limits != AMBULO_LIMIT_OFF && fabs(change) > fmax(0.0, high - low) + tolerance) {
    ambulo__bounds_whose(d->model, &range, whose);
    status = REFUSE(list, "widen the range in the model, or shorten the travel",
                    "%s has to move by %.6g %s from beginning to end; its range, %.6g to %.6g "
                    "%s%s, is only %.6g %s wide",
                    c->name, change, unit, low, high, unit, whose, fmax(0.0, high - low), unit);
  }
  if (d->speed_limits &&
      (speed > speeds.high.value + tolerance || speed < speeds.low.value - tolerance)) {
    ambulo__bounds_whose(d->model, &speeds, whose);
    status =
        REFUSE(list, "allow a higher speed, more time, or less travel",
               "%s has to move by %.6g %s in %.6g s, at %.6g %s on average; its speed limit is "
               "%.6g %s%s",
               c->name, change, unit, d->duration, speed, unit_of(c, 1),
               speed > 0.0 ? speeds.high.value : speeds.low.value, unit_of(c, 1), whose);
  }
  return status;
}

/* --------------------------------------------------------------------- ground */

/* every coordinate from the world to the point's link is prescribed */
static int is_placed(const ambulo_problem_definition *d, int point, int final) {
  double value;
  for (int i = d->model->points[point].link; i >= 0; i = d->model->links[i].parent) {
    int coordinate = d->model->links[i].coordinate;
    if (coordinate >= 0 && !value_at(d, coordinate, 0, final, &value)) return 0;
  }
  return 1;
}

static ambulo_status check_corner(const ambulo_problem_definition *d, int foot, int point, int down,
                                  int final, const double *place, ambulo_diagnostics *list) {
  const ambulo_model *model = d->model;
  if (!is_placed(d, point, final)) return AMBULO_OK;
  ambulo__contact_frame surface = ambulo__surface_below(d, foot, final ? d->duration : 0.0);
  double height = ambulo__contact_frame_along(&surface, surface.up, place + 3 * point);
  double time = final ? d->duration : 0.0;
  if (down && fabs(height) > tolerance)
    return REFUSE(list, "change the end values, or the contact's time",
                  "the %s state puts %s (foot '%s') %.4g m %s the ground at t = %.6g s, where the "
                  "schedule has it in contact",
                  end_words[final], model->points[point].name, model->feet[foot].name, fabs(height),
                  height > 0.0 ? "above" : "below", time);
  if (!down && height < -tolerance)
    return REFUSE(list, "change the end values",
                  "the %s state puts %s (foot '%s') %.4g m below the ground at t = %.6g s",
                  end_words[final], model->points[point].name, model->feet[foot].name, -height,
                  time);
  return AMBULO_OK;
}

static ambulo_status check_feet(const ambulo_problem_definition *d, const int *active, int final,
                                const double *place, ambulo_diagnostics *list) {
  const ambulo_model *model = d->model;
  ambulo_status status = AMBULO_OK;
  for (int f = 0; f < model->foot_count; f++) {
    const ambulo_foot *foot = &model->feet[f];
    int contact = active[f];
    int corner[4] = {foot->heel[0], foot->heel[1], foot->toe[0], foot->toe[1]};
    for (int k = 0; k < 4; k++) {
      if (corner[k] < 0) continue;
      int down = contact >= 0 && ambulo__corner_in_contact(d->contacts[contact].mode, k < 2);
      ambulo_status one = check_corner(d, f, corner[k], down, final, place, list);
      if (one) status = one;
    }
  }
  return status;
}

static ambulo_status check_ground(const ambulo_problem_definition *d, const int *active, int final,
                                  const ambulo_allocator *allocator, ambulo_diagnostics *list) {
  const ambulo_model *model = d->model;
  size_t n = (size_t)model->coordinate_count, points = (size_t)model->point_count;
  double *state = ambulo__alloc(allocator, 4 * n + 6 + 3 * points, sizeof *state);
  void *scratch = ambulo__alloc_aligned(allocator, 1, ambulo__lagrangian_scratch_size(model));
  ambulo_status status = state && scratch ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) {
    double *place = state + 4 * n + 6;
    for (int i = 0; i < model->coordinate_count; i++) (void)value_at(d, i, 0, final, &state[i]);
    status = ambulo__lagrangian(0, model, state, state + n, state + 2 * n,
                                &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                  .tau = state + 3 * n,
                                                  .wrench = state + 4 * n,
                                                  .points = place},
                                scratch);
    if (!status) status = check_feet(d, active, final, place, list);
  }
  ambulo__free(allocator, state);
  ambulo__free_aligned(allocator, scratch);
  return status;
}

ambulo_status ambulo__ends_check(const ambulo_problem_definition *d, int nodes, const int *active,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK, one;
  for (int e = 0; e < d->end_value_count; e++) {
    one = check_range(d, &d->end_values[e], list);
    if (one) status = one;
    one = check_twice(d, e, list);
    if (one) status = one;
  }
  int orders = d->ends == AMBULO_ENDS_FREE ? -1 : d->ends_order;
  for (int i = 0; i < d->model->coordinate_count; i++) {
    for (int order = 0; order <= orders; order++) {
      one = check_matching(d, i, order, list);
      if (one) status = one;
    }
    one = check_change(d, i, list);
    if (one) status = one;
  }
  if (status || !d->ground_penetration || d->end_value_count == 0) return status;
  for (int final = 0; final <= 1; final++) {
    const int *at = active + (final ? (nodes - 1) * d->model->foot_count : 0);
    one = check_ground(d, at, final, allocator, list);
    if (one) status = one;
  }
  return status;
}
