/* gait/foot_strike.c - a loaded foot stays on its foothold ("foot strike").
 *
 *     f . r - place_f = 0,   l . r - place_l = 0,   m
 *
 * of the point that the contact holds (gait/foot_outline.h); a flat foot also keeps its
 * toe centre straight ahead, l . r_toe - place_l = 0: the heading. Rows along left are
 * left out where no coordinate can move the point sideways.
 */
#include "gait/bounded.h"
#include "gait/foot_outline.h"

static void place_row(const ambulo__gait_context *context, int node, int point, const char *detail,
                      const double direction[3], double place, ambulo__row_table *table) {
  ambulo__row_begin(table, AMBULO__KIND_FOOT_STRIKE, context->model->points[point].name, detail,
                    AMBULO__METRES, AMBULO_EQUAL, node, context->times[node], -place);
  for (int axis = 0; axis < 3; axis++) {
    ambulo__row_term_add(table, node, ambulo__channel_point(&context->channels, point, axis),
                         direction[axis]);
  }
}

static void contact_rows(const ambulo__gait_context *context, int node,
                         const ambulo_contact *contact, const ambulo__foot_outline *outline,
                         ambulo__row_table *table) {
  const ambulo_model *model = context->model;
  double place[2];
  int point = ambulo__contact_point(model, outline, contact, place);
  place_row(context, node, point, "forward", model->forward, place[0], table);
  if (!outline->moves_sideways) return;
  place_row(context, node, point, "left", model->left, place[1], table);
  if (contact->mode != AMBULO_CONTACT_FLAT) return;
  int toe = model->feet[contact->foot].toe_center;
  place_row(context, node, toe, "heading", model->left, place[1], table);
}

/* both hold the flat foot, or the same point on the same foothold: what the other says, this one
 * says
 */
static int covers(const ambulo_contact *one, const ambulo_contact *other) {
  if (one->place[0] != other->place[0] || one->place[1] != other->place[1]) return 0;
  return one->mode == AMBULO_CONTACT_FLAT || one->mode == other->mode;
}

/* a contact that the other of the node's two covers has no rows of its own */
static int is_covered(const ambulo__gait_context *context, const ambulo__phases_of_foot *phases,
                      int i) {
  const ambulo_contact *contacts = context->definition->contacts;
  if (phases->count < 2 || phases->contact[1 - i] < 0) return 0;
  return covers(&contacts[phases->contact[1 - i]], &contacts[phases->contact[i]]);
}

/* (14.b) r - foothold = 0 while a corner is down */
void ambulo__foot_strike_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  int feet = context->model->foot_count;
  ambulo__foot_outline *outlines = ambulo__foot_outlines(context->model, &table->allocator);
  if (!outlines) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  for (int node = 0; node < context->nodes; node++) {
    for (int foot = 0; foot < feet; foot++) {
      ambulo__phases_of_foot phases = ambulo__phases_at(context, AMBULO__OF_PLACES, node, foot);
      for (int i = 0; i < phases.count; i++) {
        int contact = phases.contact[i];
        if (contact < 0 || is_covered(context, &phases, i)) continue;
        table->before = ambulo__phase_is_before(context, i);
        contact_rows(context, node, &context->definition->contacts[contact], &outlines[foot],
                     table);
      }
    }
  }
  table->before = 0;
  ambulo__free(&table->allocator, outlines);
}
