/* contact/contact_image.c - contacts, k periods of the motion later.
 *
 *     from, to + k T,   place + k (travel, 0, rise),   with mirrored ends and odd k of the mirror
 *     foot or patch, with place_l, normal_l and heading of the opposite sign
 *
 * Two periods before and after hold whatever touches the motion: no stance or swing of a gait is
 * longer than a stride.
 */
#include "contact/contact_image.h"
#include "base/arithmetic.h"
#include "contact/effector.h"
#include "model/model.h"

#include <math.h>

enum { PERIODS = 2 };

int ambulo__image_periods(const ambulo_problem_definition *d) {
  return d->ends == AMBULO_ENDS_FREE ? 0 : PERIODS;
}

static int is_mirrored(const ambulo_problem_definition *d, int period) {
  return d->ends == AMBULO_ENDS_MIRRORED && period % 2 != 0;
}

int ambulo__image_effector(const ambulo_problem_definition *d, int index, int period) {
  int effector = ambulo__effector_of(d->model, &d->contacts[index]);
  return is_mirrored(d, period) ? ambulo__effector_mirror(d->model, effector) : effector;
}

ambulo__span ambulo__image_span(const ambulo_problem_definition *d, int index, int period) {
  double later = period * d->duration;
  return (ambulo__span){d->contacts[index].from + later, d->contacts[index].to + later, index,
                        index};
}

ambulo_contact ambulo__contact_image(const ambulo_problem_definition *d, int index, int period) {
  ambulo_contact image = d->contacts[index];
  ambulo__span span = ambulo__image_span(d, index, period);
  double side = is_mirrored(d, period) ? -1.0 : 1.0;
  int effector = ambulo__image_effector(d, index, period);
  if (image.foot >= 0) {
    image.foot = effector;
  } else {
    image.patch = ambulo__effector_patch(d->model, effector);
  }
  image.from = span.from;
  image.to = span.to;
  image.place[0] += period * d->travel;
  image.place[1] *= side;
  image.place[2] += period * d->rise;
  image.normal[1] *= side;
  image.heading *= side;
  return image;
}

/* joins one more contact to the span; 0: none touches it from outside */
static int grow(const ambulo_problem_definition *d, int effector, int modes, ambulo__span *span) {
  int last = ambulo__image_periods(d);
  for (int i = 0; i < d->contact_count; i++) {
    if (!(modes & 1 << d->contacts[i].mode)) continue;
    for (int period = -last; period <= last; period++) {
      ambulo__span image = ambulo__image_span(d, i, period);
      int touches =
          image.from <= span->to + AMBULO__INSTANT && image.to >= span->from - AMBULO__INSTANT;
      int reaches =
          image.from < span->from - AMBULO__INSTANT || image.to > span->to + AMBULO__INSTANT;
      if (!touches || !reaches || ambulo__image_effector(d, i, period) != effector) continue;
      if (image.from < span->from) {
        span->from = image.from;
        span->begins = i;
      }
      if (image.to > span->to) {
        span->to = image.to;
        span->ends = i;
      }
      return 1;
    }
  }
  return 0;
}

ambulo__span ambulo__uninterrupted(const ambulo_problem_definition *d, int effector, int modes,
                                   ambulo__span span) {
  while (grow(d, effector, modes, &span)) continue;
  return span;
}
