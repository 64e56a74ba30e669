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
#include "contact/gait.h"
#include "model/neutral_pose.h"

#include <math.h>

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
