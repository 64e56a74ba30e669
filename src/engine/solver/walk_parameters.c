/* solver/walk_parameters.c - lengths and times of a walk: what one key of `gait`, `time` or
 * `ends` moves when the other keys of the file stay.
 *
 * Step s = ceil(s/2) odd + floor(s/2) even steps (contact/expand.c); its foothold is x_s along
 * forward and +-W / 2 to the side; the whole walk is x_steps long and lasts T:
 *
 *     step length L    sum dL/dplace_f dx_s/dL + dL/dtravel dx_steps/dL + dL/dT dT/dL
 *                      dT/dL = dx_steps/dL / v where the time follows from a speed v
 *     step time S      steps dL/dT; at a speed v that the length follows from, L = v S, also v
 * dL/dL speed v          dL/dT dT/dv, dT/dv = -T / v where the length follows from it too, as
 * sqrt(v), L' = dL/dv = L / (2 v), or as H (c + s (u - 0.31)), u = v / sqrt(g H), L' = H s /
 * sqrt(g H): dT/dv = (steps L' - T) / v, and dL/dL L'; where it follows from it and a time, dL/dL S
 * alone. Of such a function, dL/dc = H, dL/ds = H (u - 0.31), as of a step length.
 * step width W     sum dL/dplace_l place_l / W
 *
 * Each of them but the width adds dL/dv dv/dp through phases by speed (time_parameters.c), where
 * v = x_steps / T: dv/dp = (dx_steps/dp - v dT/dp) / T; without those dL/dv it is left out.
 *
 * T has no partial where other times stay in seconds: contacts that are listed, breakpoints, steps
 * of two times, references, functions of the caller, times of reaches, and on a grid on events
 * those of what hands hold.
 */
#include "solver/sensitivity_parameters.h"

#include "contact/contact_frame.h"
#include "contact/gait.h"
#include "contact/hold_times.h"

#include "base/arithmetic.h"

#include <math.h>
#include <stdio.h>

/* odd and even steps up to step s */
static void count_steps(int s, double count[2]) {
  const ambulo_gait marked = {.step_length = 1.0, .other_step_length = 2.0};
  count[1] = ambulo__gait_place(&marked, s) - s;
  count[0] = s - count[1];
}

/* the step whose stance the middle of a contact lies in */
static int step_of(const ambulo_gait *gait, const ambulo_contact *contact) {
  double middle = 0.5 * (contact->from + contact->to), stride = ambulo__gait_strike(gait, 2);
  for (int s = -3; s <= gait->steps + 1; s++) {
    int foot = s % 2 == 0 ? gait->first_foot : 1 - gait->first_foot;
    double since = middle - ambulo__gait_strike(gait, s);
    if (foot == contact->foot && since >= gait->heel_strike * stride - 1e-9 &&
        since <= gait->toe_off * stride + 1e-9)
      return s;
  }
  return 0;
}

/* dL/dp through footholds and travel, of the length of odd (0) and of even steps (1) */
static void by_lengths(const ambulo__parameters *p, double by[2]) {
  const ambulo_problem_definition *d = &p->problem->definition;
  const ambulo_gait *gait = &p->problem->keys.walk;
  double count[2];
  by[0] = by[1] = 0.0;
  for (int c = 0; c < d->contact_count; c++) {
    count_steps(step_of(gait, &d->contacts[c]), count);
    for (int k = 0; k < 2; k++) by[k] += count[k] * p->partials->place[2 * c];
  }
  count_steps(gait->steps, count);
  for (int k = 0; k < 2 && !p->problem->keys.travel; k++) by[k] += count[k] * p->partials->travel;
}

/* a time in seconds that the motion comes to: where rows are asked for, or where the grid has the
 * ramps of what hands hold; one at its end would be inside, were it longer */
static int has_times(const ambulo_problem_definition *d, int on_events) {
  double time[4], end = d->duration + AMBULO__INSTANT;
  int count = 0;
  for (int i = 0; i < d->reach_count; i++)
    count += d->reaches[i].from > AMBULO__INSTANT || d->reaches[i].to < end;
  for (int i = 0; i < d->hold_count; i++) {
    int at_end = d->holds[i].to < end && !ambulo__hold_falls(&d->holds[i], d->duration);
    count += at_end || (on_events && ambulo__hold_events(&d->holds[i], d->duration, time) > 0);
  }
  return count > 0;
}

static int moves_with_duration(const ambulo_problem *problem) {
  const ambulo_problem_definition *d = &problem->definition;
  int follows = d->user_row_count > 0 || d->breakpoints || d->node_times || d->tube_count > 0 ||
                has_times(d, problem->before != NULL);
  for (int t = 0; t < d->term_count; t++) follows |= d->terms[t].function || d->terms[t].reference;
  if (d->contact_count > 0)
    follows |= !problem->keys.gait || (problem->keys.rule.time_kind == AMBULO__TIME_GIVEN &&
                                       !isnan(problem->keys.rule.time[1]));
  return !follows;
}

/* step length = speed * step time: neither key of time moves alone */
static int length_follows(const ambulo__problem_keys *keys) {
  return keys->speed && !(keys->rule.length_kind == AMBULO__LENGTH_GIVEN) &&
         ((keys->rule.time_kind == AMBULO__TIME_OF_DURATION) ||
          (keys->rule.time_kind == AMBULO__TIME_GIVEN && isnan(keys->rule.time[1])) ||
          (keys->rule.time_kind == AMBULO__TIME_GIVEN && !isnan(keys->rule.time[1])));
}

/* df*_dp with what phases by speed bring; NaN: there is none. `longer` dT/dp, `further` dx/dp */
static double with_phases(const ambulo__parameters *p, double by, double longer, double further) {
  const ambulo__problem_keys *keys = &p->problem->keys;
  double duration = p->problem->definition.duration;
  if (!keys->gait) return by;
  double speed = ambulo__gait_place(&keys->walk, keys->walk.steps) / duration;
  double faster = (further - speed * longer) / duration;
  return fabs(faster) <= 1e-12 ? by : by + faster * ambulo__phases_by_speed(p);
}

static void add_time(ambulo__parameters *p, double by_length) {
  const ambulo__problem_keys *keys = &p->problem->keys;
  const ambulo_gait *gait = &keys->walk;
  double duration = p->problem->definition.duration, steps = gait->steps;
  double speed = length_follows(keys) ? ambulo__gait_place(gait, gait->steps) / duration : 0.0;
  int in_steps = keys->gait && !(keys->rule.time_kind == AMBULO__TIME_OF_DURATION);
  double by = p->partials->duration + (speed > 0.0 ? by_length * speed / steps : 0.0);
  by = with_phases(p, by, 1.0, speed);
  if (!isfinite(by)) return;
  if (in_steps) {
    ambulo__parameter_add(p, AMBULO__TIME, gait->step_time, steps * by, "step time",
                          "gait.step_time");
  } else {
    ambulo__parameter_add(p, AMBULO__TIME, duration, by, "duration", "time.duration");
  }
  ambulo__parameter_travels(p, in_steps ? steps * speed : speed);
}

static void add_speed(ambulo__parameters *p, double by_length) {
  const ambulo__problem_keys *keys = &p->problem->keys;
  const ambulo_gait *gait = &keys->walk;
  double duration = p->problem->definition.duration, steps = gait->steps;
  double speed = ambulo__gait_place(gait, gait->steps) / duration, by = 0.0, length = 0.0;
  if (length_follows(keys)) {
    length = duration / steps;
  } else {
    length = (keys->rule.length_kind == AMBULO__LENGTH_GIVEN) ? 0.0
             : (keys->rule.length_kind == AMBULO__LENGTH_FUNCTION)
                 ? (keys->rule.length_slope * ambulo_model_stature(p->problem->model)) /
                       ambulo__speed_unit(p->problem->model)
                 : gait->step_length / (2.0 * speed);
    by = p->partials->duration * (steps * length - duration) / speed;
  }
  by += length * by_length + ambulo__phases_by_speed(p);
  if (!isfinite(by)) return;
  ambulo__parameter_add(p, AMBULO__SPEED, speed, by, "speed", "gait.speed");
  ambulo__parameter_travels(p, length * steps);
}

/* the keys of time, one of which decides */
static void add_times(ambulo__parameters *p, double by_length) {
  const ambulo__problem_keys *keys = &p->problem->keys;
  int moves = moves_with_duration(p->problem);
  int by_time = !keys->gait || (keys->rule.time_kind == AMBULO__TIME_OF_DURATION) ||
                (keys->rule.time_kind == AMBULO__TIME_GIVEN && isnan(keys->rule.time[1]));
  if (moves && by_time) add_time(p, by_length);
  if (length_follows(keys) || (moves && !by_time)) add_speed(p, by_length);
}

/* `by`: by 1 m of each step */
static void add_length_function(ambulo__parameters *p, double by) {
  const ambulo__problem_keys *keys = &p->problem->keys;
  double stature = ambulo_model_stature(p->problem->model), steps = keys->walk.steps;
  double beyond =
      ambulo__speed_number(p->problem->model, ambulo__gait_speed(&p->problem->keys.walk)) -
      AMBULO__COMFORTABLE_NUMBER;
  ambulo__parameter_add(p, AMBULO__RATIO, keys->rule.length_comfortable, stature * by,
                        "step length at a comfortable speed", "gait.step_length.comfortable");
  ambulo__parameter_travels(p, steps * stature);
  ambulo__parameter_add(p, AMBULO__RATIO, keys->rule.length_slope, stature * beyond * by,
                        "step length by speed", "gait.step_length.slope");
  ambulo__parameter_travels(p, steps * stature * beyond);
}

static void add_lengths(ambulo__parameters *p, const double by[2]) {
  const ambulo__problem_keys *keys = &p->problem->keys;
  const ambulo_gait *gait = &keys->walk;
  int follows_speed = keys->speed && !(keys->rule.time_kind == AMBULO__TIME_OF_DURATION) &&
                      !(keys->rule.time_kind == AMBULO__TIME_GIVEN && isnan(keys->rule.time[1])) &&
                      !(keys->rule.time_kind == AMBULO__TIME_GIVEN && !isnan(keys->rule.time[1]));
  if ((!(keys->rule.length_kind == AMBULO__LENGTH_GIVEN) &&
       !(keys->rule.length_kind == AMBULO__LENGTH_FUNCTION)) ||
      (follows_speed && !moves_with_duration(p->problem)))
    return;
  double slower = 0.0, count[2];
  if (follows_speed)
    slower = p->partials->duration * p->problem->definition.duration /
             ambulo__gait_place(gait, gait->steps);
  count_steps(gait->steps, count);
  double faster = with_phases(p, 0.0, 0.0, follows_speed ? 0.0 : 1.0); /* of 1 m of the walk */
  if (!isfinite(faster)) return;
  if ((keys->rule.length_kind == AMBULO__LENGTH_FUNCTION)) {
    add_length_function(p, by[0] + by[1] + (slower + faster) * gait->steps);
    return;
  }
  if (!keys->lengths) {
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, gait->step_length,
                          by[0] + by[1] + (slower + faster) * gait->steps, "step length",
                          "gait.step_length");
    ambulo__parameter_travels(p, gait->steps);
    return;
  }
  ambulo__parameter_add(p, AMBULO__STEP_LENGTH, gait->step_length,
                        by[0] + (slower + faster) * count[0], "length of odd steps",
                        "gait.step_length[0]");
  ambulo__parameter_travels(p, count[0]);
  ambulo__parameter_add(p, AMBULO__STEP_LENGTH, gait->other_step_length,
                        by[1] + (slower + faster) * count[1], "length of even steps",
                        "gait.step_length[1]");
  ambulo__parameter_travels(p, count[1]);
}

static void add_width(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  double width = p->problem->keys.walk.step_width, by = 0.0;
  if (!(width > 0.0)) return;
  for (int c = 0; c < d->contact_count; c++)
    by += p->partials->place[2 * c + 1] * d->contacts[c].place[1] / width;
  ambulo__parameter_add(p, AMBULO__STEP_LENGTH, width, by, "step width", "gait.step_width");
}

/* (S.11) sum dL/dplace dplace/dL + dL/dtravel dtravel/dL + dL/dT dx/dL / v; ends.travel takes the
 * place of the gait's */
void ambulo__parameters_of_walk(ambulo__parameters *p) {
  const ambulo_problem *problem = p->problem;
  double by[2] = {0.0, 0.0};
  if (problem->keys.gait) {
    by_lengths(p, by);
    add_lengths(p, by);
    add_width(p);
  } else {
    ambulo__parameters_of_footholds(p);
  }
  add_times(p, by[0] + by[1]);
  if (problem->definition.ends == AMBULO_ENDS_FREE || (problem->keys.gait && !problem->keys.travel))
    return;
  for (int i = 0; i < p->count; i++) p->list[i].travel = 0.0;
  if (!problem->keys.gait && ambulo__footholds_meet(&problem->definition)) return;
  if (isfinite(p->partials->travel)) {
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, problem->definition.travel, p->partials->travel,
                          "travel", "ends.travel");
    ambulo__parameter_travels(p, 1.0);
  }
  int on_level = problem->definition.contact_count > 0 &&
                 ambulo__contacts_are_level(&problem->definition); /* and stays on it */
  if (on_level || !isfinite(p->partials->end_rise)) return;
  ambulo__parameter_add(p, AMBULO__STEP_LENGTH, problem->definition.rise, p->partials->end_rise,
                        "rise", "ends.rise");
}
