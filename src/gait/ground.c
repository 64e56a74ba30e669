/* gait/ground.c - no corner of a foot below the ground ("ground penetration").
 *
 *     height = n . r - h  = 0 (corner in contact)  or >= 0 (otherwise),  m
 *
 * at every node; a loaded foot that is held within a tolerance has none (gait/contact_tube.c).
 * The four corners of a flat spatial sole are coplanar, so one of its
 * four rows depends on the others; the solver's rank check drops it.
 */
#include "gait/bounded.h"
#include "gait/foot_outline.h"

static void height_row(const ambulo__gait_context *context, int node, int point,
                       ambulo_relation relation, ambulo__row_table *table) {
  ambulo__row_begin(table, AMBULO__KIND_GROUND_PENETRATION, context->model->points[point].name,
                    "height", AMBULO__METRES, relation, node, context->times[node],
                    -context->definition->ground_height);
  for (int axis = 0; axis < 3; axis++) {
    ambulo__row_term_add(table, node, ambulo__channel_point(&context->channels, point, axis),
                         context->model->up[axis]);
  }
}

/* one row a corner: where it is down in one of two phases, the equation of that one holds in both
 */
static void foot_rows(const ambulo__gait_context *context, int node,
                      const ambulo__phases_of_foot *phases, const ambulo__foot_outline *outline,
                      ambulo__row_table *table) {
  const ambulo_problem_definition *d = context->definition;
  int in_air = 0;
  for (int i = 0; i < phases->count; i++) in_air |= phases->contact[i] < 0;
  if (phases->count == 0 || (!in_air && d->contact_tolerance > 0.0)) return;
  for (int c = 0; c < outline->count; c++) {
    int down = 0;
    for (int i = 0; i < phases->count && !(d->contact_tolerance > 0.0); i++) {
      int contact = phases->contact[i];
      down |=
          contact >= 0 && ambulo__corner_in_contact(d->contacts[contact].mode, outline->is_heel[c]);
    }
    height_row(context, node, outline->point[c], down ? AMBULO_EQUAL : AMBULO_NOT_NEGATIVE, table);
  }
}

/* (14.a) n.r - h = 0 in contact, >= 0 otherwise */
void ambulo__ground_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  int feet = context->model->foot_count;
  ambulo__foot_outline *outlines = ambulo__foot_outlines(context->model, &table->allocator);
  if (!outlines) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  for (int node = 0; node < context->nodes; node++) {
    for (int foot = 0; foot < feet; foot++) {
      ambulo__phases_of_foot phases = ambulo__phases_at(context, AMBULO__OF_PLACES, node, foot);
      foot_rows(context, node, &phases, &outlines[foot], table);
    }
  }
  ambulo__free(&table->allocator, outlines);
}
