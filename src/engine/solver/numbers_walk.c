/* solver/numbers_walk.c - when and where a body steps, by the keys of `gait`, `contacts`, `time`
 * and `ends`.
 *
 * A key of a gait moves what follows from it (contact/schedule.h); a key of a listed contact moves
 * that contact, and those that have to go along:
 *
 *   - Contacts of a foot that follow each other on one foothold stay on one: one alone would put
 *     the foot in two places at once. The key is that of the first in the list.
 *   - Contacts that begin or end at one time go on doing so.
 *   - Where the motion repeats, a foothold at T is one at 0 that has travelled: neither is listed,
 *     nor travel and rise, for none of them can move alone.
 *   - On level ground height, heading and normal are not listed: rows change in a jump as it is
 *     left (contact/clearance.c).
 *
 * Times are listed on grids on events alone: on others rows come and go as an event passes a node.
 * A duration is not listed where other times stay in seconds: contacts that are listed,
 * breakpoints, steps of two times, references, functions of the caller, times of reaches, and on a
 * grid on events those of what hands hold. Neither is what moves the speed, where phases go with
 * it and something stays in seconds.
 */
#include "solver/sensitivity.h"

#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "contact/schedule.h"
#include "contact/devices.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ------------------------------------------------------------ times that stay */

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

static int of_two_times(const ambulo__gait_rule *rule) {
  return rule->time_kind == AMBULO__TIME_GIVEN && !isnan(rule->time[1]);
}

/* references, tubes, functions of the caller */
static int has_curves(const ambulo_problem_definition *d) {
  int some = d->user_row_count > 0 || d->tube_count > 0;
  for (int t = 0; t < d->term_count; t++)
    some |= d->terms[t].function || ambulo__term_follows(&d->terms[t]);
  return some;
}

static int moves_with_duration(const ambulo_problem *problem) {
  const ambulo_problem_definition *d = &problem->definition;
  int stays =
      has_curves(d) || d->breakpoints || d->node_times || has_times(d, problem->before != NULL);
  if (d->contact_count > 0) stays |= !problem->keys.gait || of_two_times(&problem->keys.rule);
  return !stays;
}

/* nodes go along with events, and nothing stays in seconds */
static int events_move(const ambulo_problem *problem) {
  const ambulo_problem_definition *d = &problem->definition;
  return d->grid == AMBULO_GRID_EVENTS && !d->node_times && !has_curves(d);
}

static int phases_stay_with_speed(const ambulo_problem *problem) {
  const ambulo__gait_rule *rule = &problem->keys.rule;
  int some = 0;
  for (int i = 0; i < AMBULO__PHASES; i++)
    some |= rule->phase_kind[i] != AMBULO__PHASE_SHARE && rule->phase_slope[i] != 0.0;
  return !some || events_move(problem);
}

/* ----------------------------------------------------------------------- gait */

static void add_lengths(ambulo__parameters *p) {
  ambulo__gait_rule *rule = &p->variant.rule;
  int speed_stays = rule->time_kind == AMBULO__TIME_OF_SPEED;
  if (speed_stays && !moves_with_duration(p->problem)) return;
  if (!speed_stays && !phases_stay_with_speed(p->problem)) return;
  if (rule->length_kind == AMBULO__LENGTH_FUNCTION) {
    ambulo__parameter_add(p, AMBULO__RATIO, &rule->length_comfortable,
                          "step length at a comfortable speed", "gait.step_length.comfortable");
    ambulo__parameter_within(p, 0.0, 5.0);
    ambulo__parameter_add(p, AMBULO__RATIO, &rule->length_slope, "step length by speed",
                          "gait.step_length.slope");
    ambulo__parameter_within(p, -10.0, 10.0);
  } else if (rule->length_kind == AMBULO__LENGTH_GIVEN && !p->problem->keys.lengths) {
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &rule->length[0], "step length",
                          "gait.step_length");
    ambulo__parameter_within(p, -10.0, 10.0);
  } else if (rule->length_kind == AMBULO__LENGTH_GIVEN) {
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &rule->length[0], "length of odd steps",
                          "gait.step_length[0]");
    if (!isnan(rule->length[1]))
      ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &rule->length[1], "length of even steps",
                            "gait.step_length[1]");
  }
}

static void add_width(ambulo__parameters *p) {
  double width = p->problem->keys.walk.step_width;
  if (!(width > 0.0)) return;
  ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &p->variant.rule.width, "step width",
                        "gait.step_width");
  ambulo__parameter_within(p, 0.0, 10.0);
  if (p->failed) return;
  p->list[p->count - 1].value = width;
  ambulo__parameter_sized(p, p->problem->keys.longer);
}

static void add_phases(ambulo__parameters *p) {
  static const char *const keys[AMBULO__PHASES] = {"heel_strike", "foot_flat", "heel_off",
                                                   "toe_off"};
  static const char *const words[AMBULO__PHASES] = {"heel strike", "foot flat", "heel off",
                                                    "toe-off"};
  ambulo__gait_rule *rule = &p->variant.rule;
  if (!events_move(p->problem)) return;
  p->next.moves_events = 1;
  for (int i = 0; i < AMBULO__PHASES; i++) {
    if (rule->phase_kind[i] == AMBULO__PHASE_OF_PEOPLE) continue;
    ambulo__parameter_add(p, AMBULO__STRIDE_SHARE, &rule->phase[i], words[i], "gait.phases.%s%s",
                          keys[i], rule->phase_kind[i] ? ".comfortable" : "");
    ambulo__parameter_within(p, -0.49, i == 0 ? 0.49 : 1.0);
  }
  p->next.moves_events = 0;
}

/* of the keys of time the one that decides */
static void add_times_of_gait(ambulo__parameters *p) {
  ambulo__gait_rule *rule = &p->variant.rule;
  int length_follows = rule->length_kind == AMBULO__LENGTH_OF_TIME;
  int moves = moves_with_duration(p->problem), phases_stay = phases_stay_with_speed(p->problem);
  if (rule->time_kind == AMBULO__TIME_OF_DURATION && moves && (length_follows || phases_stay)) {
    ambulo__parameter_add(p, AMBULO__TIME, &rule->duration, "duration", "time.duration");
    ambulo__parameter_within(p, 1e-6, 1e6);
  }
  if (rule->time_kind == AMBULO__TIME_GIVEN && moves && (length_follows || phases_stay)) {
    ambulo__parameter_add(p, AMBULO__TIME, &rule->time[0], "step time", "gait.step_time");
    ambulo__parameter_within(p, 1e-3, 1e3);
  }
  if (phases_stay && (length_follows || (moves && rule->time_kind == AMBULO__TIME_OF_SPEED))) {
    ambulo__parameter_add(p, AMBULO__SPEED, &rule->speed, "speed", "gait.speed");
    ambulo__parameter_within(p, 1e-3, 100.0);
  }
}

static void add_gait(ambulo__parameters *p) {
  add_lengths(p);
  add_width(p);
  add_times_of_gait(p);
  add_phases(p);
}

/* ------------------------------------------------------------------ footholds */

/* contacts on one place, as long as they follow each other */
typedef struct foothold {
  ambulo__parameters *p;
  const ambulo_contact *first;
  double from, to;
} foothold;

static int is_there(const foothold *f, const ambulo_contact *c) {
  return c->foot == f->first->foot && (c->foot >= 0 || c->patch == f->first->patch) &&
         ambulo__contacts_same_place(c, f->first) && c->from <= f->to + AMBULO__INSTANT &&
         c->to >= f->from - AMBULO__INSTANT;
}

static foothold foothold_of(ambulo__parameters *p, int contact) {
  const ambulo_problem_definition *d = &p->problem->definition;
  foothold f = {p, &d->contacts[contact], d->contacts[contact].from, d->contacts[contact].to};
  for (int c = 0; c < d->contact_count; c++) {
    const ambulo_contact *other = &d->contacts[c];
    if (!is_there(&f, other) || (other->from >= f.from && other->to <= f.to)) continue;
    f.from = fmin(f.from, other->from);
    f.to = fmax(f.to, other->to);
    c = -1;
  }
  return f;
}

static int is_first(const foothold *f) {
  const ambulo_contact *contacts = f->p->problem->definition.contacts;
  for (const ambulo_contact *c = contacts; c < f->first; c++)
    if (is_there(f, c)) return 0;
  return 1;
}

/* 1 if contact `late` holds at T where `early`, at 0, has to be again */
static int meet(const ambulo_problem_definition *d, const ambulo_contact *late,
                const ambulo_contact *early) {
  int foot = early->foot, mirrored = d->ends == AMBULO_ENDS_MIRRORED;
  if (d->ends == AMBULO_ENDS_FREE || early->from > AMBULO__INSTANT ||
      late->to < d->duration - AMBULO__INSTANT || (late->foot < 0) != (foot < 0))
    return 0;
  if (foot < 0)
    return late->patch == (mirrored ? d->model->patches[early->patch].mirror : early->patch);
  return late->foot == (mirrored ? d->model->feet[foot].mirror : foot);
}

static int footholds_meet(const ambulo_problem_definition *d) {
  for (int late = 0; late < d->contact_count; late++)
    for (int early = 0; early < d->contact_count; early++)
      if (meet(d, &d->contacts[late], &d->contacts[early])) return 1;
  return 0;
}

/* 1 if another foothold has to go along */
static int is_bound(const foothold *f) {
  const ambulo_problem_definition *d = &f->p->problem->definition;
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *own = &d->contacts[i];
    for (int k = 0; is_there(f, own) && k < d->contact_count; k++) {
      const ambulo_contact *other = &d->contacts[k];
      if (!is_there(f, other) && (meet(d, own, other) || meet(d, other, own))) return 1;
    }
  }
  return 0;
}

/* number k of a member of the foothold's contacts */
static void add_of_foothold(const foothold *f, const ambulo__member *m, int k) {
  const ambulo_problem_definition *d = &f->p->problem->definition;
  char *own = (char *)ambulo__variant_own(f->p->variant.definition.contacts),
       label[AMBULO__PARAMETER_TEXT];
  char key[40];
  int first = (int)(f->first - d->contacts), count = f->p->count;
  ambulo__member_label(m, k, "", label);
  (void)snprintf(label + strlen(label), sizeof label - strlen(label), " %d", first);
  (void)snprintf(key, sizeof key, m->count > 1 ? "%s[%d]" : "%s", m->key, k);
  for (int c = first; c < d->contact_count; c++) {
    double *at = (double *)(void *)(own + (size_t)c * sizeof *d->contacts + m->at) + k;
    if (c == first)
      ambulo__parameter_add(f->p, m->quantity, at, label, "contacts[%d].%s", first, key);
    else if (is_there(f, &d->contacts[c]) && f->p->count > count)
      ambulo__parameter_with(f->p, 1.0, at, "contacts[%d].%s", c, key);
  }
}

/* place, normal and heading; on level ground nothing that would leave it */
static void add_foothold(const foothold *f, int level) {
  const ambulo__structure *s = &ambulo__contact_members;
  const double *n = f->first->normal;
  int tilted = n[0] != 0.0 || n[1] != 0.0 || n[2] != 0.0;
  for (int i = 0; i < s->count; i++) {
    const ambulo__member *m = &s->members[i];
    int of_place = m->at == offsetof(ambulo_contact, place);
    if (!m->label || m->quantity == AMBULO__EVENT_TIME || (level && !of_place) ||
        (m->at == offsetof(ambulo_contact, normal) && !tilted))
      continue;
    for (int k = 0; k < (level ? 2 : m->count); k++) add_of_foothold(f, m, k);
  }
}

static void add_footholds(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  p->next.moves_events = 1;
  for (int c = 0; c < d->contact_count; c++) {
    foothold f = foothold_of(p, c);
    int level = f.first->foot >= 0 && ambulo__contacts_are_level(d);
    if (is_first(&f) && !is_bound(&f)) add_foothold(&f, level);
  }
  p->next.moves_events = 0;
}

/* ---------------------------------------------------------- times of contacts */

static double *end_of(ambulo_contact *contacts, int end) {
  return end % 2 ? &contacts[end / 2].to : &contacts[end / 2].from;
}

static int same_time(double a, double b) {
  return fabs(a - b) <= AMBULO__INSTANT;
}

/* "end of contact 0 and start of contact 1" */
static void name_ends(ambulo_contact *contacts, int ends, int first,
                      char label[AMBULO__PARAMETER_TEXT]) {
  static const char *const words[2] = {"start", "end"};
  size_t used = 0;
  for (int end = first; end < ends; end++) {
    if (!same_time(*end_of(contacts, end), *end_of(contacts, first)) ||
        used >= AMBULO__PARAMETER_TEXT)
      continue;
    int length = snprintf(label + used, AMBULO__PARAMETER_TEXT - used, "%s%s of contact %d",
                          used ? " and " : "", words[end % 2], end / 2);
    used += (size_t)length;
  }
}

/* an end inside the motion, with those of others that are there: the first has the name */
static void add_contact_time(ambulo__parameters *p, int first) {
  static const char *const keys[2] = {"from", "to"};
  const ambulo_problem_definition *d = &p->problem->definition;
  ambulo_contact *contacts = ambulo__variant_own(p->variant.definition.contacts);
  double *at = end_of(contacts, first);
  int ends = 2 * d->contact_count, count = p->count;
  char label[AMBULO__PARAMETER_TEXT];
  if (*at <= AMBULO__INSTANT || *at >= d->duration - AMBULO__INSTANT) return;
  for (int end = 0; end < first; end++)
    if (same_time(*end_of(contacts, end), *at)) return;
  name_ends(contacts, ends, first, label);
  ambulo__parameter_add(p, AMBULO__EVENT_TIME, at, label, "contacts[%d].%s", first / 2,
                        keys[first % 2]);
  for (int end = first + 1; end < ends && p->count > count; end++)
    if (same_time(*end_of(contacts, end), *at))
      ambulo__parameter_with(p, 1.0, end_of(contacts, end), "contacts[%d].%s", end / 2,
                             keys[end % 2]);
}

static void add_contact_times(ambulo__parameters *p) {
  if (!events_move(p->problem)) return;
  p->next.moves_events = 1;
  for (int end = 0; end < 2 * p->problem->definition.contact_count; end++) add_contact_time(p, end);
  p->next.moves_events = 0;
}

/* ----------------------------------------------------------------------- ends */

static void add_travel(ambulo__parameters *p) {
  const ambulo_problem_definition *d = &p->problem->definition;
  const ambulo__problem_keys *keys = &p->problem->keys;
  int on_level = d->contact_count > 0 && ambulo__contacts_are_level(d); /* and stays on it */
  if (d->ends == AMBULO_ENDS_FREE || (keys->gait && !keys->travel)) return;
  if (!keys->gait && footholds_meet(d)) return;
  ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &p->variant.definition.travel, "travel",
                        "ends.travel");
  if (!on_level)
    ambulo__parameter_add(p, AMBULO__STEP_LENGTH, &p->variant.definition.rise, "rise", "ends.rise");
}

static void add_end_values(ambulo__parameters *p) {
  static const char *const keys[] = {"", "_speed", "_acceleration"};
  static const char *const words[] = {"", "speed of ", "acceleration of "};
  static const ambulo__quantity turning[] = {AMBULO__ANGLE, AMBULO__TURNING_SPEED,
                                             AMBULO__TURNING_JOLT};
  static const ambulo__quantity sliding[] = {AMBULO__STEP_LENGTH, AMBULO__SPEED, AMBULO__JOLT};
  const ambulo_problem_definition *d = &p->problem->definition;
  ambulo_end_value *values = ambulo__variant_own(p->variant.definition.end_values);
  char label[AMBULO__PARAMETER_TEXT];
  for (int e = 0; e < d->end_value_count; e++) {
    ambulo_end_value *end = &values[e];
    const ambulo_coordinate *c = &d->model->coordinates[end->coordinate];
    (void)snprintf(label, sizeof label, "%s %s%s", end->final ? "final" : "initial",
                   words[end->order], c->name);
    ambulo__parameter_add(p, c->type == AMBULO_REVOLUTE ? turning[end->order] : sliding[end->order],
                          &end->value, label, "ends.%s%s.%s", end->final ? "final" : "initial",
                          keys[end->order], c->name);
  }
}

void ambulo__parameters_of_walk(ambulo__parameters *p) {
  if (p->problem->keys.gait) {
    add_gait(p);
  } else {
    add_footholds(p);
    add_contact_times(p);
    if (moves_with_duration(p->problem))
      ambulo__parameter_add(p, AMBULO__TIME, &p->variant.definition.duration, "duration",
                            "time.duration");
  }
  add_travel(p);
  add_end_values(p);
}
