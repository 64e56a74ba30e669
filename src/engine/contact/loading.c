/* contact/loading.c - which contact holds a foot or patch when, and how long it is down or in the
 * air.
 *
 * Schedules are cut at 0 and T. A motion that repeats goes on beyond both: its contacts are
 * repeated a period earlier and later, of the mirror foot when the ends are mirrored.
 */
#include "contact/loading.h"
#include "base/arithmetic.h"

#include "contact/effector.h"

#include <math.h>

int ambulo__contact_holds(const ambulo_contact *contact, double duration, double time) {
  if (time < contact->from - AMBULO__INSTANT) return 0;
  if (time < contact->to - AMBULO__INSTANT) return 1;
  return contact->to >= duration - AMBULO__INSTANT && time <= duration + AMBULO__INSTANT;
}

const ambulo_contact *ambulo__contact_of(const ambulo_problem_definition *d, int effector,
                                         double time) {
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    if (ambulo__effector_of(d->model, c) == effector && ambulo__contact_holds(c, d->duration, time))
      return c;
  }
  return NULL;
}

const ambulo_contact *ambulo__contact_before(const ambulo_problem_definition *d, int effector,
                                             double time) {
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    if (ambulo__effector_of(d->model, c) == effector && c->from < time - AMBULO__INSTANT &&
        time <= c->to + AMBULO__INSTANT)
      return c;
  }
  return NULL;
}

int ambulo__loaded_span(const ambulo_problem_definition *d, int effector, double time,
                        ambulo__span *span) {
  const ambulo_contact *contact = ambulo__contact_of(d, effector, time);
  if (!contact) return 0;
  int own = (int)(contact - d->contacts);
  *span = ambulo__uninterrupted(d, effector, AMBULO__ANY_MODE, ambulo__image_span(d, own, 0));
  return 1;
}

ambulo__span ambulo__air_span(const ambulo_problem_definition *d, int foot, double time) {
  int last = ambulo__image_periods(d);
  ambulo__span air = {-(last + 1) * d->duration, (last + 2) * d->duration, -1, -1};
  if (last == 0) air = (ambulo__span){0.0, d->duration, -1, -1};
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last; period <= last; period++) {
      ambulo__span image = ambulo__image_span(d, i, period);
      if (ambulo__image_effector(d, i, period) != foot) continue;
      if (image.to <= time + AMBULO__INSTANT && image.to > air.from) {
        air.from = image.to;
        air.begins = i;
      }
      if (image.from >= time - AMBULO__INSTANT && image.from < air.to) {
        air.to = image.from;
        air.ends = i;
      }
    }
  }
  return air;
}
