/* contact/gait.c - a regular walk as a list of contacts.
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
#include "contact/schedule.h"

#include "base/arithmetic.h"
#include "base/sized.h"
#include "model/model.h"
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
    int is_point =
        ambulo__foot_is_point(&model->feet[foot]); /* stands on it from strike to toe-off */
    for (int mode = AMBULO_CONTACT_HEEL; mode <= AMBULO_CONTACT_TOE; mode++) {
      if (is_point && mode != AMBULO_CONTACT_FLAT) continue;
      ambulo_contact contact = {
          .foot = foot,
          .mode = mode == AMBULO_CONTACT_HEEL ? landing : (ambulo_contact_mode)mode,
          .from = strike + fraction[is_point ? 0 : mode - AMBULO_CONTACT_HEEL] * stride,
          .to = strike + fraction[is_point ? 3 : mode - AMBULO_CONTACT_HEEL + 1] * stride,
          .place = {gait->start + ambulo__gait_place(gait, step), side * gait->step_width},
          .patch = -1};
      if (contact.to - contact.from > AMBULO__INSTANT) write_span(&w, contact);
    }
  }
  *count = w.count;
  return w.count > capacity ? AMBULO_E_LIMIT : AMBULO_OK;
}

/* ------------------------------------------------------- what is asked for */

double ambulo__speed_unit(const ambulo_model *model) {
  const double *g = model->gravity;
  double unit = sqrt(sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) * fmax(model->stature, 0.0));
  return unit > 0.0 ? unit : 0.0;
}

double ambulo__gait_speed(const ambulo_gait *gait) {
  return ambulo__gait_place(gait, gait->steps) / ambulo__gait_strike(gait, gait->steps);
}

double ambulo__speed_number(const ambulo_model *model, double speed) {
  double unit = ambulo__speed_unit(model);
  return unit > 0.0 && isfinite(speed) ? speed / unit : AMBULO__COMFORTABLE_NUMBER;
}

/* distance of the heel centres along left at q = 0, m */
static double neutral_width(const ambulo_model *model) {
  if (model->foot_count != 2) return 0.0;
  double width = 0.0;
  for (int foot = 0; foot < 2; foot++) {
    double r[3];
    ambulo__neutral_point(model, model->feet[foot].heel_center, r);
    for (int axis = 0; axis < 3; axis++) width += (foot ? -1.0 : 1.0) * model->left[axis] * r[axis];
  }
  return fabs(width);
}

/* mean of the steps where times are given, else NaN */
static double given_step_time(const ambulo__gait_rule *rule) {
  const double steps = (double)rule->fixed.steps;
  const ambulo_gait timed = {.step_time = rule->time[0], .other_step_time = rule->time[1]};
  if (rule->time_kind == AMBULO__TIME_OF_DURATION) return rule->duration / steps;
  return ambulo__gait_strike(&timed, rule->fixed.steps) / steps;
}

static double length_of(const ambulo__gait_rule *rule, const ambulo_model *model) {
  const double walk_ratio = 0.0035, usual = 1.75; /* statures per (step / min) at m */
  double stature = model->stature, beyond;
  switch (rule->length_kind) {
  case AMBULO__LENGTH_FUNCTION:
    beyond = ambulo__speed_number(model, rule->speed) - AMBULO__COMFORTABLE_NUMBER;
    return stature * (rule->length_comfortable + rule->length_slope * beyond);
  case AMBULO__LENGTH_OF_TIME:
    return rule->speed * given_step_time(rule);
  case AMBULO__LENGTH_OF_PEOPLE:
    return sqrt(60.0 * rule->speed * walk_ratio * stature * sqrt(stature / usual));
  case AMBULO__LENGTH_GIVEN:
    break;
  }
  return rule->length[0];
}

void ambulo__gait_follow(const ambulo__gait_rule *rule, const ambulo_model *model,
                         ambulo_gait *gait) {
  ambulo_gait own = rule->fixed;
  double *const phase[AMBULO__PHASES] = {&own.heel_strike, &own.foot_flat, &own.heel_off,
                                         &own.toe_off};
  own.step_length = length_of(rule, model);
  own.other_step_length = rule->length_kind == AMBULO__LENGTH_GIVEN ? rule->length[1] : (double)NAN;
  own.other_step_time = (double)NAN;
  if (rule->time_kind == AMBULO__TIME_GIVEN) {
    own.step_time = rule->time[0];
    own.other_step_time = rule->time[1];
  } else if (rule->time_kind == AMBULO__TIME_OF_DURATION) {
    own.step_time = rule->duration / (double)own.steps;
  } else {
    own.step_time = ambulo__gait_place(&own, own.steps) / (rule->speed * (double)own.steps);
  }
  own.step_width = isnan(rule->width) ? neutral_width(model) : rule->width;
  double beyond =
      ambulo__speed_number(model, ambulo__gait_speed(&own)) - AMBULO__COMFORTABLE_NUMBER;
  for (int i = 0; i < AMBULO__PHASES; i++) {
    int moves = rule->phase_kind[i] != AMBULO__PHASE_SHARE;
    *phase[i] = rule->phase[i] + (moves ? rule->phase_slope[i] * beyond : 0.0);
  }
  *gait = own;
}

/* ------------------------------------------------------- what it asks of legs */

/* the links from the foot to the first one that another foot hangs on too, not included */
static int is_shared(const ambulo_model *model, int link) {
  int feet = 0;
  for (int f = 0; f < model->foot_count; f++) {
    int i = model->points[model->feet[f].heel_center].link;
    while (i >= 0 && i != link) i = model->links[i].parent;
    feet += i == link;
  }
  return feet > 1;
}

/* straight: sqrt(a^2 + d^2) of each link; d of the uppermost only moves the joint along its axis */
static double leg_length(const ambulo_model *model, int foot) {
  const ambulo_point *heel = &model->points[model->feet[foot].heel_center];
  const double *p = heel->position;
  double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  for (int i = heel->link; i >= 0 && !is_shared(model, i); i = model->links[i].parent) {
    const ambulo_link *link = &model->links[i];
    int first = link->parent < 0 || is_shared(model, link->parent);
    if (link->type == AMBULO_PRISMATIC) return 0.0; /* as long as it likes */
    length += first ? fabs(link->a) : hypot(link->a, link->d);
  }
  return length;
}

/* along forward, of feet that are down together or hand over */
static double longest_step(const ambulo_problem_definition *d) {
  double longest = 0.0;
  for (int i = 0; i < d->contact_count; i++) {
    for (int j = 0; j < i; j++) {
      const ambulo_contact *a = &d->contacts[i], *b = &d->contacts[j];
      if (a->foot < 0 || b->foot < 0 || a->foot == b->foot ||
          fmin(a->to, b->to) < fmax(a->from, b->from) - AMBULO__INSTANT)
        continue;
      longest = fmax(longest, fabs(a->place[0] - b->place[0]));
    }
  }
  return longest;
}

ambulo__task ambulo__task_of(const ambulo_problem_definition *d) {
  const ambulo_model *model = d->model;
  ambulo__task task = {0};
  double along = 0.0, against = 0.0;
  for (int f = 0; f < model->foot_count; f++) task.leg = fmax(task.leg, leg_length(model, f));
  if (model->foot_count < 2 || d->contact_count == 0 || !(task.leg > 0.0)) return (ambulo__task){0};
  for (int k = 0; k < 3; k++) {
    along -= model->gravity[k] * model->forward[k];
    against -= model->gravity[k] * model->up[k];
  }
  task.is_gait = 1;
  task.gravity = hypot(along, against);
  task.step = longest_step(d);
  if (d->ends == AMBULO_ENDS_FREE || !(task.gravity > 0.0)) return task;
  task.speed = fabs(d->travel) / d->duration;
  task.froude = task.speed * task.speed / (task.gravity * task.leg);
  task.grade = along / against;
  if (task.speed > 0.0) task.step_time = task.step / task.speed;
  return task;
}
