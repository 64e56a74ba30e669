/* contact/swing.c - see swing.h. */
#include "contact/swing.h"
#include "base/arithmetic.h"
#include "contact/contact_image.h"
#include "contact/loading.h"

int ambulo__swing_contacts(const ambulo_problem_definition *d, int foot, double time,
                           ambulo_contact *from, ambulo_contact *to) {
  int last = ambulo__image_periods(d), has_from = 0, has_to = 0;
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last; period <= last; period++) {
      ambulo_contact image = ambulo__contact_image(d, i, period);
      if (image.foot != foot) continue;
      if (image.to <= time + AMBULO__INSTANT && (!has_from || image.to > from->to)) {
        *from = image;
        has_from = 1;
      } else if (image.from >= time - AMBULO__INSTANT && (!has_to || image.from < to->from)) {
        *to = image;
        has_to = 1;
      }
    }
  }
  if (!has_from && has_to) *from = *to;
  if (!has_to && has_from) *to = *from;
  return has_from || has_to;
}

int ambulo__swing_source(const ambulo_problem_definition *d, const ambulo_contact *image,
                         int *period) {
  int last = ambulo__image_periods(d);
  for (int i = 0; i < d->contact_count; i++) {
    for (*period = -last; *period <= last; (*period)++) {
      ambulo__span span = ambulo__image_span(d, i, *period);
      if (ambulo__image_effector(d, i, *period) == image->foot && span.from == image->from &&
          span.to == image->to)
        return i;
    }
  }
  return -1;
}

ambulo__contact_frame ambulo__surface_below(const ambulo_problem_definition *d, int foot,
                                            double time) {
  ambulo_contact from = {.foot = foot}, to = from;
  const ambulo_contact *contact = ambulo__contact_of(d, foot, time);
  if (contact) return ambulo__contact_frame_of(d, contact);
  (void)ambulo__swing_contacts(d, foot, time, &from, &to);
  return ambulo__contact_frame_of(d, to.place[2] < from.place[2] ? &to : &from);
}
