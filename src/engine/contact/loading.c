/* contact/loading.c - transfer of the load from the rear to the front foot.
 *
 * Schedules are cut at 0 and T. A motion that repeats goes on beyond both: its contacts are
 * repeated a period earlier and later, of the mirror foot when the ends are mirrored, so that a
 * double support that begins before t = 0 has its true length.
 *
 * With u = (t - strike of the front foot) / (toe-off of the rear foot - strike), the share of the
 * front foot is
 *   early   a = 1 - (1 - u)^e          smooth   a = u^2 (3 - 2 u)          linear   a = u
 *           a' = e (1 - u)^(e - 1)              a' = 6 u (1 - u)                    a' = 1
 * e = 1.4 follows the vertical forces that people show in double support (Winter, Biomechanics
 * and Motor Control of Human Movement). Nominal centres of pressure: the heel of the front foot,
 * 0.02 m ahead of the toe centre (ball) of the rear foot; D is their difference.
 */
#include "contact/loading.h"
#include "base/instant.h"

#include "contact/effector.h"
#include "contact/gait.h"

#include <math.h>

static const double rear_ahead = 0.02; /* m of a body of 1.75 m */

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

static double share_of_front(const ambulo_ground_reaction *reaction, double u) {
  u = fmin(1.0, fmax(0.0, u));
  switch (reaction->transfer) {
  case AMBULO_TRANSFER_EARLY:
    return 1.0 - pow(1.0 - u, reaction->exponent);
  case AMBULO_TRANSFER_SMOOTH:
    return u * u * (3.0 - 2.0 * u);
  case AMBULO_TRANSFER_LINEAR:
  case AMBULO_TRANSFER_NOT_SET:
    break;
  }
  return u;
}

static double slope_of_front(const ambulo_ground_reaction *reaction, double u) {
  if (u < 0.0 || u > 1.0) return 0.0;
  switch (reaction->transfer) {
  case AMBULO_TRANSFER_EARLY:
    return reaction->exponent * pow(1.0 - u, reaction->exponent - 1.0);
  case AMBULO_TRANSFER_SMOOTH:
    return 6.0 * u * (1.0 - u);
  case AMBULO_TRANSFER_LINEAR:
  case AMBULO_TRANSFER_NOT_SET:
    break;
  }
  return 1.0;
}

/* the foot that came down later; of two at once the one that stays longer, then the one ahead */
static int front_foot(const ambulo__span span[2], const ambulo_contact *const contact[2]) {
  double keys[3] = {span[1].from - span[0].from, span[1].to - span[0].to,
                    contact[1]->place[0] - contact[0]->place[0]};
  for (int i = 0; i < 3; i++) {
    if (fabs(keys[i]) > AMBULO__INSTANT) return keys[i] > 0.0;
  }
  return 0;
}

static ambulo__load double_support(const ambulo_problem_definition *d,
                                   const ambulo__foot_outline *outlines, double time,
                                   const ambulo__span span[2],
                                   const ambulo_contact *const contact[2]) {
  ambulo__load load;
  int front = front_foot(span, contact), rear = 1 - front;
  double length = span[rear].to - span[front].from;
  double u = length > AMBULO__INSTANT ? (time - span[front].from) / length : 1.0;
  load.share[front] = share_of_front(&d->ground_reaction, u);
  load.share[rear] = 1.0 - load.share[front];
  double sign = front == 0 ? 1.0 : -1.0;
  double rear_end =
      contact[rear]->place[0] + outlines[rear].length + rear_ahead * ambulo__model_size(d->model);
  load.apart[0] = sign * (contact[front]->place[0] - rear_end);
  load.apart[1] = contact[0]->place[1] - contact[1]->place[1];
  return load;
}

/* (W.5) share of the front foot, early in double support: 1 - (1 - u)^e */
ambulo__load ambulo__load_at(const ambulo_problem_definition *d,
                             const ambulo__foot_outline *outlines, double time) {
  ambulo__span span[2];
  int loaded[2];
  for (int foot = 0; foot < 2; foot++)
    loaded[foot] = ambulo__loaded_span(d, foot, time, &span[foot]);
  if (loaded[0] && loaded[1]) {
    const ambulo_contact *contact[2] = {ambulo__contact_of(d, 0, time),
                                        ambulo__contact_of(d, 1, time)};
    return double_support(d, outlines, time, span, contact);
  }
  ambulo__load load = {{loaded[1] ? 0.0 : 1.0, loaded[1] ? 1.0 : 0.0}, {0.0, 0.0}};
  return load;
}

/* u' = (t' - (1 - u) from' - u to') / length */
ambulo__share_slopes ambulo__load_slopes_at(const ambulo_problem_definition *d, double time) {
  ambulo__share_slopes slopes = {0.0, 0.0, 0.0, -1, -1};
  ambulo__span span[2];
  for (int foot = 0; foot < 2; foot++)
    if (!ambulo__loaded_span(d, foot, time, &span[foot])) return slopes;
  const ambulo_contact *contact[2] = {ambulo__contact_of(d, 0, time),
                                      ambulo__contact_of(d, 1, time)};
  int front = front_foot(span, contact), rear = 1 - front;
  double length = span[rear].to - span[front].from;
  if (!(length > AMBULO__INSTANT)) return slopes;
  double u = (time - span[front].from) / length;
  double slope = (front == 0 ? 1.0 : -1.0) * slope_of_front(&d->ground_reaction, u) / length;
  slopes.by_time = slope;
  slopes.by_begin = -(1.0 - u) * slope;
  slopes.by_end = -u * slope;
  slopes.begins = span[front].begins;
  slopes.ends = span[rear].ends;
  return slopes;
}

ambulo__roll ambulo__heel_roll_at(const ambulo_problem_definition *d, const ambulo_contact *contact,
                                  double time) {
  ambulo__span span = {.from = contact->from, .begins = (int)(contact - d->contacts)};
  (void)ambulo__loaded_span(d, contact->foot, time, &span);
  double rolling = contact->to - span.from;
  ambulo__roll roll = {rolling > 0.0 ? (time - span.from) / rolling : 0.0, rolling, span.begins};
  return roll;
}
