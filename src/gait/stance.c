/* gait/stance.c - see stance.h. */
#include "gait/stance.h"
#include "base/instant.h"
#include "model/model.h"

#include <math.h>

enum { PERIODS = 2 };

typedef struct image {
  int foot;
  ambulo_contact_mode mode;
  ambulo__span span;
} image;

static int last_period(const ambulo_problem_definition *d) {
  return d->ends == AMBULO_ENDS_FREE ? 0 : PERIODS;
}

/* contact i, `period` periods later */
static image image_of(const ambulo_problem_definition *d, int i, int period) {
  const ambulo_contact *c = &d->contacts[i];
  int mirrored = d->ends == AMBULO_ENDS_MIRRORED && period % 2 != 0;
  double later = period * d->duration;
  return (image){mirrored ? d->model->feet[c->foot].mirror : c->foot,
                 c->mode,
                 {.from = c->from + later, .to = c->to + later}};
}

/* Joins one more image of the foot, of `mode` unless -1, to the span; 0: none touches it from
 * outside. */
static int grow(const ambulo_problem_definition *d, int foot, int mode, ambulo__span *span) {
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last_period(d); period <= last_period(d); period++) {
      image c = image_of(d, i, period);
      if (c.foot != foot || (mode >= 0 && (int)c.mode != mode)) continue;
      if (c.span.from > span->to + AMBULO__INSTANT || c.span.to < span->from - AMBULO__INSTANT)
        continue;
      if (c.span.from >= span->from - AMBULO__INSTANT && c.span.to <= span->to + AMBULO__INSTANT)
        continue;
      span->from = fmin(span->from, c.span.from);
      span->to = fmax(span->to, c.span.to);
      return 1;
    }
  }
  return 0;
}

static ambulo__span grown(const ambulo_problem_definition *d, int foot, int mode,
                          ambulo__span span) {
  while (grow(d, foot, mode, &span)) continue;
  return span;
}

/* without beginning or end where the motion is cut */
static ambulo__span opened(const ambulo_problem_definition *d, ambulo__span span) {
  if (d->ends != AMBULO_ENDS_FREE) return span;
  if (span.from <= AMBULO__INSTANT) span.from = -INFINITY;
  if (span.to >= d->duration - AMBULO__INSTANT) span.to = INFINITY;
  return span;
}

/* `other`, of another foot, may hold where the stance begins or ends */
static void meet(ambulo__stance *s, double middle, ambulo__span other) {
  int at_begin = other.from < s->from - AMBULO__INSTANT && other.to > s->from + AMBULO__INSTANT;
  int at_end = other.to > s->to + AMBULO__INSTANT && other.from < s->to - AMBULO__INSTANT;
  double leaves = other.to < s->to ? other.to : middle;
  double comes = other.from > s->from ? other.from : middle;
  if (at_begin && (s->leaves == -INFINITY || leaves < s->leaves)) s->leaves = leaves;
  if (at_end && (s->comes == INFINITY || comes > s->comes)) s->comes = comes;
}

/* mode of the part that ends or begins at `time`; -1 */
static int mode_at(const ambulo_problem_definition *d, int foot, double time, int begins) {
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last_period(d); period <= last_period(d); period++) {
      image c = image_of(d, i, period);
      double end = begins ? c.span.from : c.span.to;
      if (c.foot == foot && fabs(end - time) <= AMBULO__INSTANT) return (int)c.mode;
    }
  }
  return -1;
}

ambulo__stance ambulo__stance_of(const ambulo_problem_definition *d,
                                 const ambulo_contact *contact) {
  ambulo__span own = {.from = contact->from, .to = contact->to},
               whole = grown(d, contact->foot, -1, own);
  ambulo__span open = opened(d, whole);
  ambulo__stance s = {.from = open.from, .to = open.to, .leaves = -INFINITY, .comes = INFINITY};
  double middle = 0.5 * (whole.from + whole.to);
  s.phase = grown(d, contact->foot, (int)contact->mode, own);
  s.before = mode_at(d, contact->foot, s.phase.from, 0);
  s.after = mode_at(d, contact->foot, s.phase.to, 1);
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last_period(d); period <= last_period(d); period++) {
      image c = image_of(d, i, period);
      if (c.foot != contact->foot) meet(&s, middle, opened(d, grown(d, c.foot, -1, c.span)));
    }
  }
  return s;
}
