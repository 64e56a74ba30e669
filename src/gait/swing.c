/* gait/swing.c - see swing.h.
 *
 * Contact c, k periods of the motion later:
 *
 *     from, to + k T,   place + k (travel, 0, rise),   with mirrored ends and odd k of the mirror
 *     foot, with place_l, normal_l and heading of the opposite sign
 */
#include "gait/swing.h"
#include "base/instant.h"
#include "gait/gait.h"
#include "gait/loading.h"
#include "model/model.h"

#include <math.h>

enum { PERIODS = 2 };

static int image_of(const ambulo_problem_definition *d, int i, int period, int foot,
                    ambulo_contact *image) {
  const ambulo_contact *c = &d->contacts[i];
  int mirrored = d->ends == AMBULO_ENDS_MIRRORED && period % 2 != 0;
  if ((mirrored ? d->model->feet[c->foot].mirror : c->foot) != foot) return 0;
  double side = mirrored ? -1.0 : 1.0;
  *image = *c;
  image->foot = foot;
  image->from += period * d->duration;
  image->to += period * d->duration;
  image->place[0] += period * d->travel;
  image->place[2] += period * d->rise;
  image->place[1] *= side;
  image->normal[1] *= side;
  image->heading *= side;
  return 1;
}

int ambulo__swing_contacts(const ambulo_problem_definition *d, int foot, double time,
                           ambulo_contact *from, ambulo_contact *to) {
  int last = d->ends == AMBULO_ENDS_FREE ? 0 : PERIODS, has_from = 0, has_to = 0;
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last; period <= last; period++) {
      ambulo_contact image;
      if (!image_of(d, i, period, foot, &image)) continue;
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

ambulo__contact_frame ambulo__surface_below(const ambulo_problem_definition *d, int foot,
                                            double time) {
  ambulo_contact from = {.foot = foot}, to = from;
  const ambulo_contact *contact = ambulo__contact_of(d, foot, time);
  if (contact) return ambulo__contact_frame_of(d, contact);
  (void)ambulo__swing_contacts(d, foot, time, &from, &to);
  return ambulo__contact_frame_of(d, to.place[2] < from.place[2] ? &to : &from);
}
