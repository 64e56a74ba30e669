/* contact/contacts.c - see effector.h. */
#include "contact/contacts.h"

#include "base/arithmetic.h"
#include "base/sized.h"
#include "contact/row_families.h"
#include "model/model.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <string.h>

int ambulo__effector_count(const ambulo_model *model) {
  return model->foot_count + model->patch_count;
}

int ambulo__effector_of(const ambulo_model *model, const ambulo_contact *contact) {
  return contact->foot >= 0 ? contact->foot : model->foot_count + contact->patch;
}

int ambulo__effector_patch(const ambulo_model *model, int effector) {
  return effector < model->foot_count ? -1 : effector - model->foot_count;
}

int ambulo__effector_mirror(const ambulo_model *model, int effector) {
  int patch = ambulo__effector_patch(model, effector);
  return patch < 0 ? model->feet[effector].mirror
                   : model->foot_count + model->patches[patch].mirror;
}

const char *ambulo__effector_kind(const ambulo_model *model, int effector) {
  return effector < model->foot_count ? "foot" : "patch";
}

const char *ambulo__effector_name(const ambulo_model *model, int effector) {
  int patch = ambulo__effector_patch(model, effector);
  return patch < 0 ? model->feet[effector].name : model->patches[patch].name;
}

int ambulo__effector_is_known(const ambulo_model *model, const ambulo_contact *contact) {
  if (contact->mode == AMBULO_CONTACT_PATCH)
    return contact->foot == -1 && contact->patch >= 0 && contact->patch < model->patch_count;
  return contact->foot >= 0 && contact->foot < model->foot_count;
}

int ambulo__patch_is_used(const ambulo_problem_definition *d, int patch) {
  int mirror = d->ends == AMBULO_ENDS_MIRRORED ? d->model->patches[patch].mirror : patch;
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    if (c->foot < 0 && (c->patch == patch || c->patch == mirror)) return 1;
  }
  return 0;
}

int ambulo__holds_patches(const ambulo_problem_definition *d) {
  for (int i = 0; i < d->contact_count; i++)
    if (d->contacts[i].foot < 0) return 1;
  return 0;
}

/* contacts, k periods of the motion later.
 *
 *     from, to + k T,   place + k (travel, 0, rise),   with mirrored ends and odd k of the mirror
 *     foot or patch, with place_l, normal_l and heading of the opposite sign
 *
 * Two periods before and after hold whatever touches the motion: no stance or swing of a gait is
 * longer than a stride.
 */

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

/* which contact holds a foot or patch when, and how long it is down or in the
 * air.
 *
 * Schedules are cut at 0 and T. A motion that repeats goes on beyond both: its contacts are
 * repeated a period earlier and later, of the mirror foot when the ends are mirrored.
 */

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

/* a regular walk as a list of contacts.
 *
 * Step s = ..., -1, 0, 1, ... strikes at t_s with the foot that alternates from
 * `first_foot`; its foothold is (start + x_s, +-W / 2), + for the foot that stands
 * further left at q = 0. Steps to odd strikes last Ts and are L long, those to even ones
 * Ts' and L' (as long as the others unless told):
 *
 *     t_s = ceil(s / 2) Ts + floor(s / 2) Ts',   x_s likewise,   stride S = Ts + Ts'
 *
 *     on its heel   from  t_s + heel_strike S   to  t_s + foot_flat S    (forefoot: on its toes)
 *     flat          from  t_s + foot_flat S     to  t_s + heel_off S
 *     on its toes   from  t_s + heel_off S      to  t_s + toe_off S
 *
 * Spans are cut to [0, t_steps]; empty ones are left out, except that a foot which comes
 * down exactly at the end is in contact at that instant.
 */

enum { MOST_STEPS = 1000 };

static int gait_is_legal(const ambulo_model *model, const ambulo_gait *gait) {
  double lengths[] = {gait->step_length, gait->step_width, gait->start};
  for (int i = 0; i < 3; i++) {
    if (!isfinite(lengths[i])) return 0;
  }
  return model->foot_count == 2 && gait->first_foot >= 0 && gait->first_foot < 2 &&
         (gait->forefoot == 0 || gait->forefoot == 1) && gait->steps >= 1 &&
         gait->steps <= MOST_STEPS && gait->step_time > 0.0 && isfinite(gait->step_time) &&
         !isinf(gait->other_step_length) &&
         (isnan(gait->other_step_time) ||
          (gait->other_step_time > 0.0 && isfinite(gait->other_step_time))) &&
         gait->step_width >= 0.0 && gait->heel_strike > -0.5 &&
         gait->heel_strike <= gait->foot_flat && gait->foot_flat <= gait->heel_off &&
         gait->heel_off <= gait->toe_off && gait->toe_off < gait->heel_strike + 1.0;
}

/* sum of `odd` over the odd and `even` over the even steps up to step s; negative before step 0 */
static double up_to_step(int s, double odd, double even) {
  int evens = s >= 0 ? s / 2 : -((1 - s) / 2);
  return (double)(s - evens) * odd + (double)evens * even;
}

double ambulo__gait_strike(const ambulo_gait *gait, int step) {
  double other = isnan(gait->other_step_time) ? gait->step_time : gait->other_step_time;
  return up_to_step(step, gait->step_time, other);
}

double ambulo__gait_place(const ambulo_gait *gait, int step) {
  double other = isnan(gait->other_step_length) ? gait->step_length : gait->other_step_length;
  return up_to_step(step, gait->step_length, other);
}

/* the foot that stands further left at q = 0 */
static int left_foot(const ambulo_model *model) {
  double along[2] = {0.0, 0.0};
  for (int foot = 0; foot < 2; foot++) {
    double r[3];
    ambulo__neutral_point(model, model->feet[foot].heel_center, r);
    for (int axis = 0; axis < 3; axis++) along[foot] += model->left[axis] * r[axis];
  }
  return along[1] > along[0];
}

typedef struct writer {
  char *contacts;
  size_t size; /* of one, as the caller's header has it */
  int capacity, count;
  double duration;
} writer;

static void write_span(writer *w, ambulo_contact contact) {
  int lands_at_end = fabs(contact.from - w->duration) <= AMBULO__INSTANT;
  if (contact.to <= AMBULO__INSTANT || contact.from > w->duration + AMBULO__INSTANT) return;
  contact.from = fmax(contact.from, 0.0);
  contact.to = fmin(contact.to, w->duration);
  if (lands_at_end && contact.to > w->duration - AMBULO__INSTANT) {
    contact.from = contact.to = w->duration;
  } else if (contact.to - contact.from <= AMBULO__INSTANT) {
    return;
  }
  if (w->count < w->capacity) memcpy(w->contacts + (size_t)w->count * w->size, &contact, w->size);
  w->count++;
}

ambulo_status ambulo_gait_expand(const ambulo_model *model, const ambulo_gait *gait,
                                 ambulo_contact *contacts, int capacity, int *count) {
  ambulo_gait own;
  if (!model || !gait || !count || (!contacts && capacity > 0)) return AMBULO_E_ARGUMENT;
  if (!AMBULO__OWN(ambulo_gait, &own, gait) ||
      !ambulo__sized_item(own.contact_size, sizeof *contacts))
    return AMBULO_E_ARGUMENT;
  gait = &own;
  if (!gait_is_legal(model, gait)) return AMBULO_E_ARGUMENT;
  writer w = {(char *)contacts, own.contact_size, capacity, 0,
              ambulo__gait_strike(gait, gait->steps)};
  double stride = ambulo__gait_strike(gait, 2);
  const double fraction[] = {gait->heel_strike, gait->foot_flat, gait->heel_off, gait->toe_off};
  int left = left_foot(model);
  ambulo_contact_mode landing = gait->forefoot ? AMBULO_CONTACT_TOE : AMBULO_CONTACT_HEEL;
  /* a foot is down for less than one stride and strikes at most half a stride early */
  for (int step = -3; step <= gait->steps + 1; step++) {
    int foot = step % 2 == 0 ? gait->first_foot : 1 - gait->first_foot;
    double strike = ambulo__gait_strike(gait, step);
    double side = foot == left ? 0.5 : -0.5;
    for (int mode = AMBULO_CONTACT_HEEL; mode <= AMBULO_CONTACT_TOE; mode++) {
      ambulo_contact contact = {
          .foot = foot,
          .mode = mode == AMBULO_CONTACT_HEEL ? landing : (ambulo_contact_mode)mode,
          .from = strike + fraction[mode - AMBULO_CONTACT_HEEL] * stride,
          .to = strike + fraction[mode - AMBULO_CONTACT_HEEL + 1] * stride,
          .place = {gait->start + ambulo__gait_place(gait, step), side * gait->step_width},
          .patch = -1};
      if (contact.to - contact.from > AMBULO__INSTANT) write_span(&w, contact);
    }
  }
  *count = w.count;
  return w.count > capacity ? AMBULO_E_LIMIT : AMBULO_OK;
}
