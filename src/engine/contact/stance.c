/* contact/stance.c - see stance.h. */
#include "contact/stance.h"
#include "base/arithmetic.h"
#include "contact/effector.h"

#include <math.h>

/* without beginning or end where the motion is cut, or the foot is down all the time */
static ambulo__span opened(const ambulo_problem_definition *d, ambulo__span span) {
  if (d->ends == AMBULO_ENDS_FREE) {
    if (span.from <= AMBULO__INSTANT) span.from = -INFINITY;
    if (span.to >= d->duration - AMBULO__INSTANT) span.to = INFINITY;
    return span;
  }
  double stride = (d->ends == AMBULO_ENDS_MIRRORED ? 2.0 : 1.0) * d->duration;
  if (span.to - span.from < stride - AMBULO__INSTANT) return span;
  return (ambulo__span){-INFINITY, INFINITY, -1, -1};
}

/* `other`, of another foot or patch, may hold where the stance begins or ends */
static void meet(ambulo__stance *s, double middle, ambulo__span other) {
  int at_begin = other.from < s->from - AMBULO__INSTANT && other.to > s->from + AMBULO__INSTANT;
  int at_end = other.to > s->to + AMBULO__INSTANT && other.from < s->to - AMBULO__INSTANT;
  double leaves = other.to < s->to ? other.to : middle;
  double comes = other.from > s->from ? other.from : middle;
  if (at_begin && (s->leaves == -INFINITY || leaves < s->leaves)) {
    s->leaves = leaves;
    s->leaves_half_way = !(other.to < s->to);
  }
  if (at_end && (s->comes == INFINITY || comes > s->comes)) {
    s->comes = comes;
    s->comes_half_way = !(other.from > s->from);
  }
}

static int touches(ambulo__span span, double time) {
  return span.from <= time + AMBULO__INSTANT && span.to >= time - AMBULO__INSTANT;
}

static void meet_others(const ambulo_problem_definition *d, int effector, double middle,
                        ambulo__stance *s) {
  int last = ambulo__image_periods(d);
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last; period <= last; period++) {
      ambulo__span span = ambulo__image_span(d, i, period);
      int other = ambulo__image_effector(d, i, period);
      if (other == effector || (!touches(span, s->from) && !touches(span, s->to))) continue;
      meet(s, middle, opened(d, ambulo__uninterrupted(d, other, AMBULO__ANY_MODE, span)));
    }
  }
}

/* mode of the part that ends where the phase begins, or begins where it ends; -1. A contact
 * that begins with the next period has no length at T. */
static int mode_beside(const ambulo_problem_definition *d, int effector, ambulo__span phase,
                       int after) {
  int last = ambulo__image_periods(d);
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last; period <= last; period++) {
      ambulo__span s = ambulo__image_span(d, i, period);
      double apart = after ? s.from - phase.to : s.to - phase.from;
      if (ambulo__image_effector(d, i, period) == effector && fabs(apart) <= AMBULO__INSTANT &&
          s.to - s.from > AMBULO__INSTANT)
        return (int)d->contacts[i].mode;
    }
  }
  return -1;
}

ambulo__span ambulo__stance_in(const ambulo_problem_definition *d, const ambulo_contact *contact,
                               int modes) {
  ambulo__span own = {.from = contact->from, .to = contact->to};
  return opened(d, ambulo__uninterrupted(d, ambulo__effector_of(d->model, contact), modes, own));
}

ambulo__stance ambulo__stance_of(const ambulo_problem_definition *d,
                                 const ambulo_contact *contact) {
  int effector = ambulo__effector_of(d->model, contact);
  ambulo__span own = {.from = contact->from, .to = contact->to};
  ambulo__span whole = ambulo__uninterrupted(d, effector, AMBULO__ANY_MODE, own);
  ambulo__span open = opened(d, whole);
  ambulo__stance s = {.from = open.from, .to = open.to, .leaves = -INFINITY, .comes = INFINITY};
  s.phase = ambulo__uninterrupted(d, effector, 1 << contact->mode, own);
  s.before = mode_beside(d, effector, s.phase, 0);
  s.after = mode_beside(d, effector, s.phase, 1);
  meet_others(d, effector, 0.5 * (whole.from + whole.to), &s);
  return s;
}
