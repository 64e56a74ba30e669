/* definitions/problem_schedule.c - `gait:` or `contacts:` of a problem file.
 *
 * Duration, number of steps, step time and speed say the same thing twice:
 *     step_time = step_length / speed,   duration = steps * step_time
 * What is missing follows (contact/gait_rule.h); what is given must agree. A speed and a time make
 * the length: so a cadence is varied at a given speed. Of a speed alone follow both. Two unlike
 * steps: lists of two lengths, of two times.
 */
#include "definitions/problem_reader.h"

#include "contact/contact_frame.h"
#include "contact/gait.h"

#include <math.h>
#include <stdio.h>

enum { MOST_CONTACTS = 5000 };

/* index of the foot a node names; -1 when there is none */
static int read_foot(const ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  enum { MOST_FEET = 64 };
  const char *names[MOST_FEET];
  int feet = ambulo_model_foot_count(reader->model);
  if (feet > MOST_FEET) feet = MOST_FEET;
  if (feet == 0) {
    if (node)
      (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM,
                               "feet of the model file (docs/model-format.md); of an imported one: "
                               "ambulo import --foot, or --heel and --toe",
                               "the model has no feet");
    return -1;
  }
  for (int i = 0; i < feet; i++) names[i] = ambulo_model_foot(reader->model, i)->name;
  return ambulo__yaml_choice(node, names, feet, -1);
}

/* ------------------------------------------------------------------- contacts */

/* two numbers on the level ground, or three */
static void read_place(const ambulo__yaml_node *node, double place[3]) {
  int given = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) ? ambulo__yaml_items(node) : 0;
  if (!node || given == 2 || given == 3) {
    (void)ambulo__yaml_numbers(node, given, place);
    return;
  }
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                           "'place' is not a list of 2 or 3 lengths: forward, left, up");
}

/* zeros are no choice; those of patches point anywhere */
static void read_normal(const ambulo__yaml_node *node, int is_foot, double normal[3]) {
  if (!ambulo__yaml_numbers(node, 3, normal)) return;
  if (normal[2] != 0.0 && ambulo__contact_normal_is_legal(normal)) return;
  if (!is_foot && (normal[0] != 0.0 || normal[1] != 0.0 || normal[2] != 0.0)) return;
  if (!is_foot) {
    (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                             "a normal of zeros along forward, left and up; expected a direction");
    return;
  }
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                           "a normal of (%g, %g, %g) along forward, left and up; expected one that "
                           "is up to 60 degrees from up",
                           normal[0], normal[1], normal[2]);
}

/* index of the patch a node names; 0 after an error */
static int read_patch(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  int count = ambulo_model_patch_count(reader->model);
  if (count == 0) {
    (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL, "the model has no patches");
    return 0;
  }
  const char **names = ambulo__reader_alloc(reader, (size_t)count, sizeof *names);
  for (int i = 0; names && i < count; i++) names[i] = ambulo_model_patch(reader->model, i)->name;
  return names ? ambulo__yaml_choice(node, names, count, 0) : 0;
}

/* {foot, mode} or {patch} */
static void read_effector(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                          ambulo_contact *contact) {
  static const char *const modes[] = {"heel", "flat", "toe"};
  const ambulo__yaml_node *patch = ambulo__yaml_get(node, "patch");
  if (patch && ambulo__yaml_get(node, "foot"))
    (void)ambulo__yaml_error(patch, AMBULO_E_SCHEMA, NULL,
                             "a contact of both a foot and a patch; expected one of them");
  if (patch && ambulo__yaml_get(node, "mode"))
    (void)ambulo__yaml_error(ambulo__yaml_get(node, "mode"), AMBULO_E_SCHEMA, NULL,
                             "a mode of a patch; expected one with a foot only");
  if (patch) {
    contact->foot = -1;
    contact->mode = AMBULO_CONTACT_PATCH;
    contact->patch = read_patch(reader, patch);
    return;
  }
  contact->foot = read_foot(reader, ambulo__yaml_require(node, "foot"));
  int mode = ambulo__yaml_choice(ambulo__yaml_require(node, "mode"), modes, 3, 1);
  contact->mode = (ambulo_contact_mode)(AMBULO_CONTACT_HEEL + mode);
}

static void read_contact(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                         ambulo_contact *contact) {
  read_effector(reader, node, contact);
  contact->from = ambulo__yaml_number(ambulo__yaml_require(node, "from"), 0.0);
  contact->to = ambulo__yaml_number(ambulo__yaml_require(node, "to"), 0.0);
  read_place(ambulo__yaml_require(node, "place"), contact->place);
  read_normal(ambulo__yaml_get(node, "normal"), contact->foot >= 0, contact->normal);
  contact->heading = ambulo__read_plain_angle(reader, ambulo__yaml_get(node, "heading"), 0.0);
  ambulo__yaml_close(node);
}

static void read_contacts(ambulo__problem_reader *reader, const ambulo__yaml_node *list) {
  if (!ambulo__yaml_is(list, AMBULO__YAML_SEQUENCE)) {
    (void)ambulo__yaml_error(list, AMBULO_E_SCHEMA, NULL,
                             "'contacts' is not a list; expected items with foot, mode, from, to, "
                             "place");
    return;
  }
  int count = ambulo__yaml_items(list);
  if (count > MOST_CONTACTS) {
    (void)ambulo__yaml_error(list, AMBULO_E_LIMIT, NULL, "%d contacts; expected at most %d", count,
                             MOST_CONTACTS);
    return;
  }
  ambulo_contact *contacts = ambulo__reader_alloc(reader, (size_t)count, sizeof *contacts);
  if (!contacts) return;
  for (int i = 0; i < count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    if (ambulo__yaml_is(item, AMBULO__YAML_MAPPING)) {
      read_contact(reader, item, &contacts[i]);
    } else {
      (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL,
                               "a contact is not a mapping; expected foot, mode, from, to, place");
    }
  }
  reader->definition.contacts = contacts;
  reader->definition.contact_count = count;
}

/* ----------------------------------------------------------------------- gait */

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
    ambulo__read_step_length(reader, node);
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
  double by_speed = ambulo__gait_place(gait, gait->steps) / (rule->speed * (double)gait->steps);
  check_agreement(ambulo__yaml_get(section, "speed"), "speed", by_speed, mean);
}

static void expand(ambulo__problem_reader *reader, const ambulo__yaml_node *section,
                   const ambulo_gait *gait) {
  int count = 0;
  ambulo_status status = ambulo_gait_expand(reader->model, gait, NULL, 0, &count);
  if (status == AMBULO_E_ARGUMENT) {
    /* the keys have been checked one by one: what is left is the model, or an earlier error */
    int feet = ambulo_model_foot_count(reader->model);
    if (feet == 2 || feet == 0) return; /* of none it is told at first_foot */
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
  gait.first_foot = read_foot(reader, ambulo__yaml_require(section, "first_foot"));
  gait.forefoot = ambulo__yaml_choice(ambulo__yaml_get(section, "landing"), landings, 2, 0);
  gait.start = ambulo__yaml_number_in(ambulo__yaml_get(section, "start"), -1e3, 1e3, 0.0);
  rule->fixed = gait;
  read_times(reader, section);
  read_lengths(reader, section);
  double longer = keys->longer > 0.0 ? keys->longer : 1.0;
  rule->width =
      longer * ambulo__yaml_number_in(ambulo__yaml_get(section, "step_width"), 0.0, 10.0, NAN);
  const ambulo__yaml_node *phases = ambulo__yaml_get(section, "phases");
  ambulo__read_phases(reader, phases);
  ambulo__gait_follow(rule, reader->model, &gait);
  check_times(reader, section, &gait);
  ambulo__check_phases(reader, phases, &gait);
  ambulo__yaml_close(section);
  if (!reader->has_duration) reader->definition.duration = ambulo__gait_strike(&gait, gait.steps);
  reader->definition.travel = ambulo__gait_place(&gait, gait.steps);
  reader->steps = gait.steps;
  reader->unlike_steps = differs(gait.step_time, gait.other_step_time) ||
                         differs(gait.step_length, gait.other_step_length);
  keys->gait = 1;
  keys->steps = gait.steps;
  keys->unlike_steps = reader->unlike_steps;
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
  if (contacts) read_contacts(reader, contacts);
  if (reader->gait) read_gait(reader, reader->gait);
}
