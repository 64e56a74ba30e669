/* contact/place_rows.c - no corner of a foot below the ground ("ground penetration").
 *
 *     height = n . (r - p)  = 0 (corner in contact)  or >= 0 (otherwise),  m
 *
 * at every node, with p and n the place and normal of the foot's contact, of a foot in the air of
 * the lower one of the two between which it swings (contact/contacts.h: what is between them
 * its clearance has to pass). A loaded foot that is held within a tolerance has none
 * (contact/contact_tube.c).
 * The four corners of a flat spatial sole are coplanar, so one of its
 * four rows depends on the others; the solver's rank check drops it.
 */
#include "contact/row_families.h"

#include "contact/contacts.h"
#include "contact/rows.h"
#include "contact/schedule.h"
#include "model/neutral_pose.h"

#include <math.h>

/* How a foot is turned: direction cosines, as linear forms. */

/* direction . (to - from) / |to - from|, the distance taken at q = 0 */
static ambulo__linear cosine(const ambulo__gait_context *context, int from, int to,
                             const double direction[3]) {
  ambulo__linear form = {.count = 0};
  double a[3], b[3], square = 0.0;
  ambulo__neutral_point(context->model, from, a);
  ambulo__neutral_point(context->model, to, b);
  for (int i = 0; i < 3; i++) square += (b[i] - a[i]) * (b[i] - a[i]);
  double factor = square > 0.0 ? 1.0 / sqrt(square) : 0.0;
  ambulo__linear_add(&form, ambulo__channel_point(&context->channels, to, 0), direction, factor);
  ambulo__linear_add(&form, ambulo__channel_point(&context->channels, from, 0), direction, -factor);
  return form;
}

ambulo__linear ambulo__foot_yaw(const ambulo__gait_context *context, int foot,
                                const double left[3]) {
  const ambulo_foot *f = &context->model->feet[foot];
  return cosine(context, f->heel_center, f->toe_center, left);
}

ambulo__linear ambulo__foot_pitch(const ambulo__gait_context *context, int foot,
                                  const double up[3]) {
  const ambulo_foot *f = &context->model->feet[foot];
  return cosine(context, f->heel_center, f->toe_center, up);
}

ambulo__linear ambulo__foot_roll(const ambulo__gait_context *context, int foot,
                                 const double up[3]) {
  const ambulo_model *model = context->model;
  const int *corner = model->feet[foot].heel;
  ambulo__linear none = {.count = 0};
  if (corner[1] < 0) return none;
  double a[3], b[3], across = 0.0;
  ambulo__neutral_point(model, corner[0], a);
  ambulo__neutral_point(model, corner[1], b);
  for (int i = 0; i < 3; i++) across += model->left[i] * (b[i] - a[i]);
  return across >= 0.0 ? cosine(context, corner[0], corner[1], up)
                       : cosine(context, corner[1], corner[0], up);
}

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

/* a loaded foot stays on its foothold ("foot strike").
 *
 *     f . (r - place) = 0,   l . (r - place) = 0,   m
 *
 * of the point that the contact holds (contact/contacts.h); a flat foot also keeps its
 * toe centre straight ahead, l . (r_toe - place) = 0: the heading. f and l are the axes of the
 * contact's surface (contact/contacts.h). Rows along left are
 * left out where no coordinate can move the point sideways.
 */

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
  if (!ambulo__mode_is_flat(contact->mode) || outline->is_point) return;
  int toe = context->model->feet[contact->foot].toe_center;
  place_row(context, node, toe, "heading", frame.left, place, table);
}

/* both hold the flat foot, or the same point on the same foothold: what the other says, this one
 * says
 */
static int covers(const ambulo_contact *one, const ambulo_contact *other) {
  if (!ambulo__contacts_same_place(one, other)) return 0;
  return ambulo__mode_is_flat(one->mode) || one->mode == other->mode;
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

/* patches that are held in place ("contact").
 *
 * With r the middle of a patch in contact, p its place, f, l, n the axes of its surface
 * (contact/contacts.h) and e the contact tolerance:
 *
 *     -e <= f.(r - p) <= e,   -e <= n.(r - p) <= e,   -e <= l.(r - p) <= e         m
 *
 * and without a tolerance f.(r - p) = n.(r - p) = l.(r - p) = 0. How the link is turned is free.
 * The rows along left are left out where no coordinate can move the link sideways. A patch that is
 * not in contact has no rows.
 */

typedef struct held {
  const ambulo__gait_context *context;
  const ambulo_patch *patch;
  int node;
  ambulo__row_table *table;
} held;

static void along(const held *h, const ambulo__contact_frame *frame, const double direction[3],
                  const char *lower, const char *upper) {
  const ambulo__gait_context *context = h->context;
  double e = context->definition->contact_tolerance;
  ambulo__linear form = {.constant = 0.0};
  for (int i = 0; i < 3; i++) form.constant -= direction[i] * frame->origin[i];
  ambulo__linear_add(&form, ambulo__channel_point(&context->channels, h->patch->point, 0),
                     direction, 1.0);
  if (e > 0.0) {
    ambulo__bounded_name name = {AMBULO__KIND_CONTACT, h->patch->name, lower, upper,
                                 AMBULO__METRES};
    ambulo__bounded_rows(context, h->node, &name, &form, -e, e, h->table);
    return;
  }
  ambulo__row_begin(h->table, AMBULO__KIND_CONTACT, h->patch->name, upper, AMBULO__METRES,
                    AMBULO_EQUAL, h->node, context->times[h->node], form.constant);
  for (int t = 0; t < form.count; t++)
    ambulo__row_term_add(h->table, h->node, form.channel[t], form.coefficient[t]);
}

static void patch_rows_contact_rows(const held *h, const ambulo_contact *contact) {
  const ambulo_model *model = h->context->model;
  ambulo__contact_frame frame = ambulo__contact_frame_of(h->context->definition, contact);
  along(h, &frame, frame.forward, "behind", "ahead");
  along(h, &frame, frame.up, "below", "above");
  if (ambulo__link_moves_sideways(model, model->points[h->patch->point].link))
    along(h, &frame, frame.left, "to the right", "to the left");
}

/* of two contacts that meet at a node one speaks for both where they are at one place */
static int is_said(const ambulo__gait_context *context, const ambulo__phases_of_foot *phases,
                   int i) {
  const ambulo_contact *contacts = context->definition->contacts;
  return i > 0 && phases->contact[0] >= 0 && phases->contact[i] >= 0 &&
         ambulo__contacts_same_place(&contacts[phases->contact[0]], &contacts[phases->contact[i]]);
}

/* (14.f) the middle of a patch on its place */
void ambulo__patch_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  const ambulo_model *model = context->model;
  for (int node = 0; node < context->nodes; node++) {
    for (int p = 0; p < model->patch_count; p++) {
      ambulo__phases_of_foot phases =
          ambulo__phases_at(context, AMBULO__OF_PLACES, node, model->foot_count + p);
      held h = {context, &model->patches[p], node, table};
      for (int i = 0; i < phases.count; i++) {
        if (phases.contact[i] < 0 || is_said(context, &phases, i)) continue;
        table->before = ambulo__phase_is_before(context, i);
        patch_rows_contact_rows(&h, &context->definition->contacts[phases.contact[i]]);
      }
    }
  }
  table->before = 0;
}
