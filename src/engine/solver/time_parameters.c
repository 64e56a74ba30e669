/* solver/time_parameters.c - phases of a gait and times of listed contacts, on a grid on
 * events.
 *
 * Phase f of the stride S moves an event of each step (contact/expand.c), t = t_s + f S:
 *
 *     dL/df = S sum dL/de over the events that are there
 *
 * There is none on other grids, where rows come and go as an event passes a node; where an event
 * of another phase, or 0 or T, is at the same time, so that nodes come or go (ends of listed
 * contacts at one time move together); nor for what stays in seconds while nodes move: references,
 * tubes, functions of the caller.
 *
 * A phase by speed, f = comfortable + slope (v / sqrt(g H) - 0.31), has df/dcomfortable = 1, and
 * brings dL/dv = dL/df slope / sqrt(g H) to all that changes the speed.
 */
#include "solver/sensitivity_parameters.h"

#include "base/arithmetic.h"
#include "contact/gait.h"
#include "contact/phases.h"

#include <math.h>
#include <stdio.h>

enum {
  PHASES = AMBULO__PHASES,
  FIRST_STEP = -3
}; /* steps that reach into the motion: contact/expand.c */

typedef struct stride {
  const ambulo__parameters *p;
  const ambulo_gait *gait;
  double phase[PHASES], duration;
} stride;

static double time_of(const stride *s, int step, int phase) {
  return ambulo__gait_strike(s->gait, step) + s->phase[phase] * s->duration;
}

static int same_time(double a, double b) {
  return fabs(a - b) <= AMBULO__INSTANT;
}

/* 1 if another phase has an event at `time` */
static int is_shared(const stride *s, int phase, double time) {
  for (int step = FIRST_STEP; step <= s->gait->steps + 1; step++) {
    for (int other = 0; other < PHASES; other++)
      if (other != phase && same_time(time_of(s, step, other), time)) return 1;
  }
  return 0;
}

/* dL/de at `time`, which nothing but `phase` moves; NaN */
static double pull_at(const stride *s, int phase, double time) {
  const ambulo__partials *by = s->p->partials;
  const ambulo__events events = {by->events, by->event_time};
  int event = ambulo__event_at(&events, time);
  return event < 0 || is_shared(s, phase, time) ? (double)NAN : by->event[event];
}

static double pull_of(const stride *s, int phase) {
  double end = s->p->problem->definition.duration, sum = 0.0;
  for (int step = FIRST_STEP; step <= s->gait->steps + 1; step++) {
    double time = time_of(s, step, phase);
    if (time >= -AMBULO__INSTANT && time <= end + AMBULO__INSTANT)
      sum += s->duration * pull_at(s, phase, time);
  }
  return sum;
}

static stride stride_of(const ambulo__parameters *p) {
  const ambulo_gait *gait = &p->problem->keys.walk;
  return (stride){p,
                  gait,
                  {gait->heel_strike, gait->foot_flat, gait->heel_off, gait->toe_off},
                  ambulo__gait_strike(gait, 2)};
}

/* something stays in seconds while nodes move, or they do not move */
static int stays(const ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  int some = d->user_row_count > 0 || d->tube_count > 0 || p->partials->events == 0;
  for (int t = 0; t < d->term_count; t++) some |= d->terms[t].function || d->terms[t].reference;
  return some;
}

double ambulo__phases_by_speed(const ambulo__parameters *p) {
  const ambulo__problem_keys *keys = &p->problem->keys;
  const stride s = stride_of(p);
  double sum = 0.0;
  for (int phase = 0; phase < PHASES; phase++) {
    if (!keys->rule.phase_kind[phase] || keys->rule.phase_slope[phase] == 0.0) continue;
    sum += stays(p) ? (double)NAN : pull_of(&s, phase) * keys->rule.phase_slope[phase];
  }
  return sum == 0.0 ? 0.0 : sum / ambulo__speed_unit(p->problem->model);
}

/* (S.14) S sum dL/de */
static void add_phases(ambulo__parameters *p) {
  static const char *const keys[PHASES] = {"heel_strike", "foot_flat", "heel_off", "toe_off"};
  static const char *const words[PHASES] = {"heel strike", "foot flat", "heel off", "toe-off"};
  const ambulo__problem_keys *of = &p->problem->keys;
  const stride s = stride_of(p);
  for (int phase = 0; phase < PHASES; phase++) {
    double pull = pull_of(&s, phase),
           beyond =
               ambulo__speed_number(p->problem->model, ambulo__gait_speed(&p->problem->keys.walk)) -
               AMBULO__COMFORTABLE_NUMBER;
    if (!isfinite(pull) || of->rule.phase_kind[phase] == AMBULO__PHASE_OF_PEOPLE) continue;
    double value = s.phase[phase] - of->rule.phase_slope[phase] * beyond;
    ambulo__parameter_add(p, AMBULO__STRIDE_SHARE,
                          of->rule.phase_kind[phase] ? value : s.phase[phase], pull, words[phase],
                          "gait.phases.%s%s", keys[phase],
                          of->rule.phase_kind[phase] ? ".comfortable" : "");
  }
}

static double end_of(const ambulo_problem_definition *d, int end) {
  return end % 2 ? d->contacts[end / 2].to : d->contacts[end / 2].from;
}

/* "end of contact 0 and start of contact 1" */
static void name_ends(const ambulo_problem_definition *d, int first,
                      char label[AMBULO__PARAMETER_TEXT]) {
  static const char *const words[2] = {"start", "end"};
  size_t used = 0;
  for (int end = first; end < 2 * d->contact_count; end++) {
    if (!same_time(end_of(d, end), end_of(d, first)) || used >= AMBULO__PARAMETER_TEXT) continue;
    int length = snprintf(label + used, AMBULO__PARAMETER_TEXT - used, "%s%s of contact %d",
                          used ? " and " : "", words[end % 2], end / 2);
    used += (size_t)length;
  }
}

/* an end of a contact, with those of others that are there: the first of them has the name */
static void add_contact_time(ambulo__parameters *p, int first) {
  static const char *const keys[2] = {"from", "to"};
  const ambulo_problem_definition *d = &p->problem->definition;
  const ambulo__events events = {p->partials->events, p->partials->event_time};
  double time = end_of(d, first);
  int event = ambulo__event_at(&events, time), count = p->count;
  char label[AMBULO__PARAMETER_TEXT];
  if (event < 0 || !isfinite(p->partials->event[event])) return;
  for (int end = 0; end < first; end++)
    if (same_time(end_of(d, end), time)) return;
  name_ends(d, first, label);
  ambulo__parameter_add(p, AMBULO__EVENT_TIME, time, p->partials->event[event], label,
                        "contacts[%d].%s", first / 2, keys[first % 2]);
  for (int end = first + 1; end < 2 * d->contact_count && p->count > count; end++)
    if (same_time(end_of(d, end), time))
      ambulo__parameter_with(p, 1.0, "contacts[%d].%s", end / 2, keys[end % 2]);
}

void ambulo__parameters_of_events(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  if (stays(p)) return;
  if (p->problem->keys.gait) {
    add_phases(p);
    return;
  }
  for (int end = 0; end < 2 * d->contact_count; end++) add_contact_time(p, end);
}
