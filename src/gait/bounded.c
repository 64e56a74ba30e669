/* gait/bounded.c - pairs of inequality rows (bounded.h). */
#include "gait/bounded.h"

#include <math.h>

void ambulo__linear_add(ambulo__linear *form, int first, const double direction[3], double factor) {
  for (int axis = 0; axis < 3; axis++) {
    if (direction[axis] == 0.0) continue;
    if (form->count == AMBULO__FORM_TERMS) {
      form->overflow = 1;
      return;
    }
    form->channel[form->count] = first + axis;
    form->coefficient[form->count++] = factor * direction[axis];
  }
}

static void side(const ambulo__gait_context *context, int node, const ambulo__bounded_name *name,
                 const ambulo__linear *form, double sign, double bound, ambulo__row_table *table) {
  if (!isfinite(bound)) return;
  ambulo__row_begin(table, name->kind, name->subject, sign > 0.0 ? name->lower : name->upper,
                    name->measure, AMBULO_NOT_NEGATIVE, node, context->times[node],
                    sign * (form->constant - bound));
  for (int t = 0; t < form->count; t++)
    ambulo__row_term_add(table, node, form->channel[t], sign * form->coefficient[t]);
}

void ambulo__bounded_rows(const ambulo__gait_context *context, int node,
                          const ambulo__bounded_name *name, const ambulo__linear *form, double low,
                          double high, ambulo__row_table *table) {
  if (form->overflow && !table->status) table->status = AMBULO_E_INTERNAL;
  side(context, node, name, form, 1.0, low, table);
  side(context, node, name, form, -1.0, high, table);
}

int ambulo__distinct_nodes(const ambulo__gait_context *context, int order) {
  const ambulo_problem_definition *d = context->definition;
  int repeats = d->ends != AMBULO_ENDS_FREE && d->ends_order >= order &&
                (d->ground_reaction.kind != AMBULO_REACTION_NONE || d->contact_tolerance > 0.0);
  return repeats ? context->nodes - 1 : context->nodes;
}
