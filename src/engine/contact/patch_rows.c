/* contact/patch_rows.c - patches that are held in place ("contact").
 *
 * With r the middle of a patch in contact, p its place, f, l, n the axes of its surface
 * (contact/contact_frame.h) and e the contact tolerance:
 *
 *     -e <= f.(r - p) <= e,   -e <= n.(r - p) <= e,   -e <= l.(r - p) <= e         m
 *
 * and without a tolerance f.(r - p) = n.(r - p) = l.(r - p) = 0. How the link is turned is free.
 * The rows along left are left out where no coordinate can move the link sideways. A patch that is
 * not in contact has no rows.
 */
#include "contact/patch_rows.h"
#include "contact/bounded.h"
#include "contact/contact_frame.h"
#include "contact/effector.h"
#include "model/neutral_pose.h"

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

static void contact_rows(const held *h, const ambulo_contact *contact) {
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
        contact_rows(&h, &context->definition->contacts[phases.contact[i]]);
      }
    }
  }
  table->before = 0;
}
