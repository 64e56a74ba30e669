/* contact/bounded.c - pairs of inequality rows (bounded.h). */
#include "contact/bounded.h"
#include "contact/effector.h"
#include "contact/loading.h"

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

/* the contact of an effector at a node, -1 in the air; patches are few, and found by their times */
static int contact_at(const ambulo__gait_context *context, int effector, int node) {
  const ambulo_problem_definition *d = context->definition;
  int feet = context->model->foot_count;
  if (effector < feet) return context->active[node * feet + effector];
  const ambulo_contact *contact = ambulo__contact_of(d, effector, context->times[node]);
  return contact ? (int)(contact - d->contacts) : -1;
}

/* just before a node, where that counts too */
static int contact_before(const ambulo__gait_context *context, int effector, int node) {
  const ambulo_problem_definition *d = context->definition;
  int feet = context->model->foot_count;
  if (!context->before || (effector >= feet && node == 0))
    return contact_at(context, effector, node);
  if (effector < feet) return context->before[node * feet + effector];
  const ambulo_contact *contact = ambulo__contact_before(d, effector, context->times[node]);
  return contact ? (int)(contact - d->contacts) : -1;
}

/* 1 if what an effector does up to T is not what it goes on with, which is what the first node has
 */
static int ends_at_last(const ambulo__gait_context *context, int effector, int before) {
  const ambulo_problem_definition *d = context->definition;
  int mirrored = d->ends == AMBULO_ENDS_MIRRORED;
  int image = mirrored ? ambulo__effector_mirror(context->model, effector) : effector;
  int next = contact_at(context, image, 0);
  if (before < 0 || next < 0) return before != next;
  return d->contacts[before].mode != d->contacts[next].mode;
}

ambulo__phases_of_foot ambulo__phases_at(const ambulo__gait_context *context, int order, int node,
                                         int effector) {
  int now = contact_at(context, effector, node);
  int before = contact_before(context, effector, node);
  ambulo__phases_of_foot phases = {0, {before, now}};
  if (node >= ambulo__distinct_nodes(context, order)) {
    phases.count = context->before != NULL && ends_at_last(context, effector, before);
    return phases;
  }
  phases.count = before == now ? 1 : 2;
  return phases;
}

int ambulo__distinct_nodes(const ambulo__gait_context *context, int order) {
  const ambulo_problem_definition *d = context->definition;
  int repeats = d->ends != AMBULO_ENDS_FREE && d->ends_order >= order &&
                (d->ground_reaction.kind != AMBULO_REACTION_NONE || d->contact_tolerance > 0.0);
  return repeats ? context->nodes - 1 : context->nodes;
}
