/* contact/expand.c - a regular walk as a list of contacts.
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
#include "contact/gait.h"
#include "base/sized.h"
#include "base/arithmetic.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <string.h>

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
