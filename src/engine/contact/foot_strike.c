/* contact/foot_strike.c - a loaded foot stays on its foothold ("foot strike").
 *
 *     f . (r - place) = 0,   l . (r - place) = 0,   m
 *
 * of the point that the contact holds (contact/foot_outline.h); a flat foot also keeps its
 * toe centre straight ahead, l . (r_toe - place) = 0: the heading. f and l are the axes of the
 * contact's surface (contact/contact_frame.h). Rows along left are
 * left out where no coordinate can move the point sideways.
 */
#include "contact/bounded.h"
#include "contact/contact_frame.h"
#include "contact/foot_outline.h"

static void place_row(const ambulo__gait_context *context, int node, int point, const char *detail,
                      const double direction[3], const double place[3], ambulo__row_table *table) {
  double constant = 0.0;
  for (int i = 0; i < 3; i++) constant -= direction[i] * place[i];
  ambulo__row_begin(table, AMBULO__KIND_FOOT_STRIKE, context->model->points[point].name, detail,
                    AMBULO__METRES, AMBULO_EQUAL, node, context->times[node], constant);
  for (int axis = 0; axis < 3; axis++) {
    ambulo__row_term_add(table, node, ambulo__channel_point(&context->channels, point, axis),
                         direction[axis]);
  }
}

static void contact_rows(const ambulo__gait_context *context, int node,
                         const ambulo_contact *contact, const ambulo__foot_outline *outline,
                         ambulo__row_table *table) {
  ambulo__contact_frame frame = ambulo__contact_frame_of(context->definition, contact);
  double place[3];
  int point = ambulo__contact_point(context->definition, outline, contact, place);
  place_row(context, node, point, "forward", frame.forward, place, table);
  if (!outline->moves_sideways) return;
  place_row(context, node, point, "left", frame.left, place, table);
  if (contact->mode != AMBULO_CONTACT_FLAT) return;
  int toe = context->model->feet[contact->foot].toe_center;
  place_row(context, node, toe, "heading", frame.left, place, table);
}

/* both hold the flat foot, or the same point on the same foothold: what the other says, this one
 * says
 */
static int covers(const ambulo_contact *one, const ambulo_contact *other) {
  if (!ambulo__contacts_same_place(one, other)) return 0;
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
