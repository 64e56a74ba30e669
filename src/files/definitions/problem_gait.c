/* definitions/problem_gait.c - `gait:` of a problem file: steps, times and phases of a regular
 * walk.
 *
 * Duration, number of steps, step time and speed say the same thing twice:
 *     step_time = step_length / speed,   duration = steps * step_time
 * What is missing follows (contact/schedule.h); what is given must agree. A speed and a time make
 * the length: so a cadence is varied at a given speed. Of a speed alone follow both. Two unlike
 * steps: lists of two lengths, of two times.
 */
#include "contact/row_families.h"
#include "definitions/problem_reader.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---------------------------------------------------------------------- phases */

/* When heel, sole and toes come and go, and steps whose length is a function of the speed: what
 * becomes of them is contact/schedule.h's. When the file says nothing, textbook timing of
 * comfortable walking at every speed (foot flat at 8 %, heel rise after 38 %, toe-off at 62 %;
 * Perry, Gait Analysis, 1992). With `by_speed` the stance is shorter the faster people walk, by 3.5
 * % of the stride for 1 m/s (Kirtley, Whittle & Jefferson, J Biomed Eng 7:282-288, 1985), -0.145
 * for 1 of u at 1.75 m; the heel's rise goes along.
 */

typedef struct phase {
  const char *name;
  double people, slope; /* share of the stride, comfortable and by speed number */
  double least, most;
} phase;
static const phase phases[AMBULO__PHASES] = {{"heel_strike", 0.0, 0.0, -0.49, 0.49},
                                             {"foot_flat", 0.08, 0.0, -0.49, 1.0},
                                             {"heel_off", 0.38, -0.145, -0.49, 1.0},
                                             {"toe_off", 0.62, -0.145, -0.49, 1.0}};
static const char by_speed[] = "by_speed";

/* {comfortable, slope}, both with people's as defaults, or the word alone */
static void read_function(ambulo__gait_rule *rule, const ambulo__yaml_node *node, int i) {
  double value = phases[i].people, slope = phases[i].slope;
  int is_mapping = ambulo__yaml_is(node, AMBULO__YAML_MAPPING);
  if (is_mapping && !ambulo__yaml_get(node, "comfortable") && !ambulo__yaml_get(node, "slope"))
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "a phase without a number; expected comfortable, slope, or both");
  if (is_mapping) {
    value = ambulo__yaml_number_in(ambulo__yaml_get(node, "comfortable"), phases[i].least,
                                   phases[i].most, value);
    slope = ambulo__yaml_number_in(ambulo__yaml_get(node, "slope"), -10.0, 10.0, slope);
    ambulo__yaml_close(node);
  }
  rule->phase_kind[i] = is_mapping ? AMBULO__PHASE_FUNCTION : AMBULO__PHASE_OF_PEOPLE;
  rule->phase[i] = value;
  rule->phase_slope[i] = slope;
}

static void read_phase(ambulo__problem_reader *reader, const ambulo__yaml_node *node, int i) {
  ambulo__gait_rule *rule = &reader->keys.rule;
  if (ambulo__yaml_is(node, AMBULO__YAML_SCALAR) &&
      strcmp(ambulo__yaml_text(node), by_speed) == 0) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, "phases: by_speed is of all four",
                             "got 'by_speed' for one phase; expected a number, or {comfortable, "
                             "slope}");
  } else if (!ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) {
    rule->phase[i] =
        ambulo__yaml_number_in(node, phases[i].least, phases[i].most, phases[i].people);
  } else if (ambulo__speed_unit(reader->model) > 0.0) {
    read_function(rule, node, i);
  } else {
    (void)ambulo__yaml_error(
        node, AMBULO_E_PROBLEM, "give the model a stature, or the phase a number",
        "a phase by speed of a model without stature or gravity; expected a number");
  }
}

static int is_by_speed(const ambulo__yaml_node *node) {
  static const char *const words[] = {by_speed};
  if (!ambulo__yaml_is(node, AMBULO__YAML_SCALAR)) return 0;
  return ambulo__yaml_choice(node, words, 1, -1) == 0;
}

static void read_step_length(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  ambulo__gait_rule *rule = &reader->keys.rule;
  rule->length_kind = AMBULO__LENGTH_FUNCTION;
  rule->length_comfortable =
      ambulo__yaml_number_in(ambulo__yaml_require(node, "comfortable"), 0.0, 5.0, 0.4);
  rule->length_slope =
      ambulo__yaml_number_in(ambulo__yaml_require(node, "slope"), -10.0, 10.0, 0.0);
  ambulo__yaml_close(node);
  if (!(ambulo__speed_unit(reader->model) > 0.0) || isnan(rule->speed)) {
    (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                             "a step length by speed, but %s; expected a length",
                             isnan(rule->speed) ? "no gait.speed" : "no stature or no gravity");
    return;
  }
  double number = ambulo__speed_number(reader->model, rule->speed);
  double length =
      rule->length_comfortable + rule->length_slope * (number - AMBULO__COMFORTABLE_NUMBER);
  if (length > 0.0) return;
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                           "steps of %.4g statures at a speed of %.4g sqrt(g H); expected a "
                           "length above 0",
                           length, number);
}

static void read_phases(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  ambulo__gait_rule *rule = &reader->keys.rule;
  int all_by_speed = is_by_speed(node);
  int is_mapping = ambulo__yaml_is(node, AMBULO__YAML_MAPPING);
  for (int i = 0; i < AMBULO__PHASES; i++) rule->phase[i] = phases[i].people;
  if (all_by_speed && !(ambulo__speed_unit(reader->model) > 0.0)) {
    (void)ambulo__yaml_error(
        node, AMBULO_E_PROBLEM, NULL,
        "phases by speed of a model without stature or gravity; expected four numbers");
    return;
  }
  if (node && !all_by_speed && !is_mapping && !ambulo__yaml_is(node, AMBULO__YAML_SCALAR))
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "'phases' is a list; expected keys, or by_speed");
  for (int i = 0; i < AMBULO__PHASES; i++) {
    if (all_by_speed)
      read_function(rule, node, i);
    else if (is_mapping)
      read_phase(reader, ambulo__yaml_get(node, phases[i].name), i);
  }
  if (is_mapping) ambulo__yaml_close(node);
}

static int are_in_order(const double share[AMBULO__PHASES]) {
  return share[0] <= share[1] && share[1] <= share[2] && share[2] <= share[3] &&
         share[3] < share[0] + 1.0;
}

static void check_phases(const ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                         const ambulo_gait *gait) {
  const double share[AMBULO__PHASES] = {gait->heel_strike, gait->foot_flat, gait->heel_off,
                                        gait->toe_off};
  double number = ambulo__speed_number(reader->model, ambulo__gait_speed(gait));
  int moves = 0, outside = 0;
  if (!node) return;
  for (int i = 0; i < AMBULO__PHASES; i++) {
    if (reader->keys.rule.phase_kind[i] == AMBULO__PHASE_SHARE) continue;
    moves = 1;
    if (share[i] >= phases[i].least && share[i] <= phases[i].most) continue;
    const ambulo__yaml_node *own =
        ambulo__yaml_is(node, AMBULO__YAML_MAPPING) ? ambulo__yaml_get(node, phases[i].name) : node;
    outside = 1;
    (void)ambulo__yaml_error(own, AMBULO_E_PROBLEM, NULL,
                             "%s is at %.4g of the stride at a speed of %.4g sqrt(g H); expected "
                             "%.4g to %.4g",
                             phases[i].name, share[i], number, phases[i].least, phases[i].most);
  }
  if (outside || are_in_order(share)) return;
  char hint[80];
  (void)snprintf(hint, sizeof hint, "phases go with the speed, here %.4g sqrt(g H)", number);
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, moves ? hint : NULL,
                           "phases %.6g, %.6g, %.6g, %.6g of a stride; expected heel_strike <= "
                           "foot_flat <= heel_off <= toe_off < heel_strike + 1",
                           share[0], share[1], share[2], share[3]);
}

/* --------------------------------------------------------------- lengths and times */

static void check_agreement(const ambulo__yaml_node *node, const char *what, double step_time,
                            double other) {
  char hint[96];
  if (!node || !(fabs(step_time - other) > 1e-9 * fabs(other))) return; /* NaN: refused before */
  (void)snprintf(hint, sizeof hint, "expected one of them: '--set gait.%s=null' leaves one out",
                 what);
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, hint,
                           "'%s' makes a step last %.9g s; expected %.9g s, from the other keys",
                           what, step_time, other);
}

static int is_list(const ambulo__yaml_node *node) {
  return ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE);
}

static double mean_step_time(const ambulo_gait *gait) {
  return ambulo__gait_strike(gait, gait->steps) / (double)gait->steps;
}

/* two times, within the bounds of one */
static void read_two_times(const ambulo__yaml_node *node, double times[2]) {
  (void)ambulo__yaml_numbers(node, 2, times);
  if (isnan(times[0]) || isnan(times[1])) return;
  if (times[0] >= 1e-3 && times[1] >= 1e-3 && times[0] <= 1e3 && times[1] <= 1e3) return;
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                           "step times %g s and %g s; expected 0.001 to 1000 s", times[0],
                           times[1]);
}

/* what decides on the times: those of the steps, the duration, or speed and length */
static void read_times(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo__gait_rule *rule = &reader->keys.rule;
  const ambulo__yaml_node *time = ambulo__yaml_get(section, "step_time");
  const ambulo__yaml_node *speed = ambulo__yaml_get(section, "speed");
  rule->speed = ambulo__yaml_number_in(speed, 1e-3, 100.0, NAN);
  rule->duration = reader->definition.duration;
  rule->time[0] = rule->time[1] = NAN;
  if (is_list(time))
    read_two_times(time, rule->time);
  else
    rule->time[0] = ambulo__yaml_number_in(time, 1e-3, 1e3, NAN);
  rule->time_kind = is_list(time)          ? AMBULO__TIME_GIVEN
                    : reader->has_duration ? AMBULO__TIME_OF_DURATION
                    : time                 ? AMBULO__TIME_GIVEN
                                           : AMBULO__TIME_OF_SPEED;
  if (time || speed || reader->has_duration) return;
  (void)ambulo__yaml_error(section, AMBULO_E_SCHEMA, NULL,
                           "no step time; expected one of gait.step_time, gait.speed, "
                           "time.duration");
}

/* one length, two, a function of the speed, that of the speed and a time, or that which people
 * choose at the speed */
static void read_lengths(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo__gait_rule *rule = &reader->keys.rule;
  const ambulo__yaml_node *node = ambulo__yaml_get(section, "step_length");
  int has_speed = ambulo__yaml_get(section, "speed") != NULL;
  rule->length[1] = NAN;
  if (is_list(node)) {
    double lengths[2] = {0.0, 0.0};
    (void)ambulo__yaml_numbers(node, 2, lengths);
    rule->length[0] = lengths[0];
    if (lengths[1] != 0.0) rule->length[1] = lengths[1];
  } else if (ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) {
    read_step_length(reader, node);
  } else if (!node && has_speed && rule->time_kind != AMBULO__TIME_OF_SPEED) {
    rule->length_kind = AMBULO__LENGTH_OF_TIME;
  } else if (!node && has_speed && ambulo_model_stature(reader->model) > 0.0) {
    rule->length_kind = AMBULO__LENGTH_OF_PEOPLE;
  } else {
    rule->length[0] =
        ambulo__yaml_number_in(ambulo__yaml_require(section, "step_length"), -10.0, 10.0, 0.0);
  }
}

/* keys that say the time of a step, too */
static void check_times(const ambulo__problem_reader *reader, const ambulo__yaml_node *section,
                        const ambulo_gait *gait) {
  const ambulo__gait_rule *rule = &reader->keys.rule;
  const ambulo__yaml_node *time = ambulo__yaml_get(section, "step_time");
  double mean = mean_step_time(gait), duration = rule->duration / (double)gait->steps;
  if (is_list(time) && reader->has_duration) check_agreement(time, "step_time", mean, duration);
  if (!is_list(time) && reader->has_duration)
    check_agreement(time, "step_time", rule->time[0], duration);
  if (rule->time_kind == AMBULO__TIME_OF_SPEED) return;
  double implied = ambulo__gait_place(gait, gait->steps) / (rule->speed * (double)gait->steps);
  check_agreement(ambulo__yaml_get(section, "speed"), "speed", implied, mean);
}

static void expand(ambulo__problem_reader *reader, const ambulo__yaml_node *section,
                   const ambulo_gait *gait) {
  int count = 0;
  ambulo_status status = ambulo_gait_expand(reader->model, gait, NULL, 0, &count);
  if (status == AMBULO_E_ARGUMENT) {
    /* the keys have been checked one by one: what is left is the model, or an earlier error */
    int feet = ambulo_model_foot_count(reader->model);
    if (feet == 2 || feet == 0) return; /* none is reported at first_foot */
    (void)ambulo__yaml_error(section, AMBULO_E_PROBLEM, "write the schedule out under 'contacts'",
                             "the model has %d feet; expected 2 for a regular gait", feet);
    return;
  }
  ambulo_contact *contacts = ambulo__reader_alloc(reader, (size_t)count, sizeof *contacts);
  if (!contacts) return;
  status = ambulo_gait_expand(reader->model, gait, contacts, count, &count);
  if (status) reader->failure = AMBULO_E_INTERNAL;
  reader->definition.contacts = contacts;
  reader->definition.contact_count = count;
}

static int differs(double value, double other) {
  return !isnan(other) && fabs(value - other) > 1e-9 * fabs(value);
}

static void read_gait(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  static const char *const landings[] = {"heel", "forefoot"};
  ambulo__problem_keys *keys = &reader->keys;
  ambulo__gait_rule *rule = &keys->rule;
  ambulo_gait gait = ambulo_gait_default();
  gait.steps = ambulo__yaml_integer(ambulo__yaml_require(section, "steps"), 1, 1000, 1);
  gait.first_foot = ambulo__read_foot(reader, ambulo__yaml_require(section, "first_foot"));
  gait.forefoot = ambulo__yaml_choice(ambulo__yaml_get(section, "landing"), landings, 2, 0);
  gait.start = ambulo__yaml_number_in(ambulo__yaml_get(section, "start"), -1e3, 1e3, 0.0);
  rule->fixed = gait;
  read_times(reader, section);
  read_lengths(reader, section);
  double longer = keys->longer > 0.0 ? keys->longer : 1.0;
  rule->width =
      longer * ambulo__yaml_number_in(ambulo__yaml_get(section, "step_width"), 0.0, 10.0, NAN);
  const ambulo__yaml_node *given = ambulo__yaml_get(section, "phases");
  read_phases(reader, given);
  ambulo__gait_follow(rule, reader->model, &gait);
  check_times(reader, section, &gait);
  check_phases(reader, given, &gait);
  ambulo__yaml_close(section);
  if (!reader->has_duration) reader->definition.duration = ambulo__gait_strike(&gait, gait.steps);
  reader->definition.travel = ambulo__gait_place(&gait, gait.steps);
  keys->unlike_steps = differs(gait.step_time, gait.other_step_time) ||
                       differs(gait.step_length, gait.other_step_length);
  keys->gait = 1;
  keys->steps = gait.steps;
  keys->speed = ambulo__yaml_get(section, "speed") != NULL;
  keys->lengths = is_list(ambulo__yaml_get(section, "step_length"));
  keys->walk = gait;
  expand(reader, section, &gait);
}

void ambulo__read_schedule(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  const ambulo__yaml_node *contacts = ambulo__yaml_get(root, "contacts");
  if (contacts && reader->gait) {
    (void)ambulo__yaml_error(contacts, AMBULO_E_SCHEMA, NULL,
                             "both 'gait' and 'contacts' are given; expected one of them");
    return;
  }
  if (contacts) ambulo__read_contacts(reader, contacts);
  if (reader->gait) read_gait(reader, reader->gait);
}
