/* contact/ground.c - no corner of a foot below the ground ("ground penetration").
 *
 *     height = n . (r - p)  = 0 (corner in contact)  or >= 0 (otherwise),  m
 *
 * at every node, with p and n the place and normal of the foot's contact, of a foot in the air of
 * the lower one of the two between which it swings (contact/contact_frame.h: what is between them
 * its clearance has to pass). A loaded foot that is held within a tolerance has none
 * (contact/contact_tube.c).
 * The four corners of a flat spatial sole are coplanar, so one of its
 * four rows depends on the others; the solver's rank check drops it.
 */
#include "contact/bounded.h"
#include "contact/foot_outline.h"
#include "contact/swing.h"

static void height_row(const ambulo__gait_context *context, int node, int point,
                       ambulo_relation relation, const ambulo__contact_frame *surface,
                       ambulo__row_table *table) {
  double constant = 0.0;
  for (int i = 0; i < 3; i++) constant -= surface->up[i] * surface->origin[i];
  ambulo__row_begin(table, AMBULO__KIND_GROUND_PENETRATION, context->model->points[point].name,
                    "height", AMBULO__METRES, relation, node, context->times[node], constant);
  for (int axis = 0; axis < 3; axis++) {
    ambulo__row_term_add(table, node, ambulo__channel_point(&context->channels, point, axis),
                         surface->up[axis]);
  }
}

/* one row a corner: where it is down in one of two phases, the equation of that one holds in both
 */
static void foot_rows(const ambulo__gait_context *context, int node, int foot,
                      const ambulo__phases_of_foot *phases, const ambulo__foot_outline *outline,
                      ambulo__row_table *table) {
  const ambulo_problem_definition *d = context->definition;
  ambulo__contact_frame surface = ambulo__surface_below(d, foot, context->times[node]);
  int in_air = 0;
  for (int i = 0; i < phases->count; i++) {
    in_air |= phases->contact[i] < 0;
    if (phases->contact[i] >= 0)
      surface = ambulo__contact_frame_of(d, &d->contacts[phases->contact[i]]);
  }
  if (phases->count == 0 || (!in_air && d->contact_tolerance > 0.0)) return;
  for (int c = 0; c < outline->count; c++) {
    int down = 0;
    for (int i = 0; i < phases->count && !(d->contact_tolerance > 0.0); i++) {
      int contact = phases->contact[i];
      down |=
          contact >= 0 && ambulo__corner_in_contact(d->contacts[contact].mode, outline->is_heel[c]);
    }
    height_row(context, node, outline->point[c], down ? AMBULO_EQUAL : AMBULO_NOT_NEGATIVE,
               &surface, table);
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
      foot_rows(context, node, foot, &phases, &outlines[foot], table);
    }
  }
  ambulo__free(&table->allocator, outlines);
}
