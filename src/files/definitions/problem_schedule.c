/* definitions/problem_schedule.c - `gait:` or `contacts:` of a problem file.
 *
 * Duration, number of steps, step time and speed say the same thing twice:
 *     step_time = step_length / speed,   duration = steps * step_time
 * What is missing is computed; what is given must agree. A speed and a time make the length: so a
 * cadence is varied at a given speed. Of a speed alone follow both: people keep
 * the walk ratio of step length and cadence when they walk slower or faster (Sekiya et al. 1996;
 * down to about 1 m/s: Murakami & Otaka 2017), here W = 0.0035 of the stature per step a minute at
 * H = 1.75 m, and as H^1.5, so that bodies of one speed number v / sqrt(g H) make alike steps:
 *     v = L C / 60,   L = W C      =>      L = sqrt(60 v W)
 * Two unlike steps: lists of two lengths, of two times.
 */
#include "definitions/problem_reader.h"

#include "contact/contact_frame.h"
#include "contact/gait.h"
#include "model/neutral_pose.h"

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

/* distance of the heel centres along left at q = 0, m */
static double neutral_width(const ambulo_model *model) {
  if (ambulo_model_foot_count(model) != 2) return 0.0;
  double width = 0.0;
  for (int foot = 0; foot < 2; foot++) {
    double r[3];
    ambulo__neutral_point(model, model->feet[foot].heel_center, r);
    for (int axis = 0; axis < 3; axis++) {
      width += (foot ? -1.0 : 1.0) * model->left[axis] * r[axis];
    }
  }
  return fabs(width);
}

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

/* speed and time of a walk as the file has them, each read once; NaN: not there, or no number */
typedef struct walking_pace {
  double speed;    /* m/s */
  double times[2]; /* s: of odd and of even steps */
} walking_pace;

static int is_list(const ambulo__yaml_node *node) {
  return ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE);
}

static walking_pace read_pace(const ambulo__yaml_node *section) {
  const ambulo__yaml_node *time = ambulo__yaml_get(section, "step_time");
  walking_pace p = {ambulo__yaml_number_in(ambulo__yaml_get(section, "speed"), 1e-3, 100.0, NAN),
                    {NAN, NAN}};
  if (is_list(time)) {
    (void)ambulo__yaml_numbers(time, 2, p.times);
  } else {
    p.times[0] = p.times[1] = ambulo__yaml_number_in(time, 1e-3, 1e3, NAN);
  }
  return p;
}

static double step_time_at(const ambulo_gait *gait, double speed) {
  return ambulo__gait_place(gait, gait->steps) / (speed * (double)gait->steps);
}

static double mean_step_time(const ambulo_gait *gait) {
  return ambulo__gait_strike(gait, gait->steps) / (double)gait->steps;
}

static double read_step_time(const ambulo__problem_reader *reader, const ambulo__yaml_node *section,
                             const walking_pace *pace, const ambulo_gait *gait) {
  const ambulo__yaml_node *time = ambulo__yaml_get(section, "step_time");
  const ambulo__yaml_node *speed = ambulo__yaml_get(section, "speed");
  double by_time = pace->times[0], by_speed = step_time_at(gait, pace->speed);
  double by_duration = reader->definition.duration / (double)gait->steps;
  if (reader->has_duration) {
    check_agreement(time, "step_time", by_time, by_duration);
    check_agreement(speed, "speed", by_speed, by_duration);
    return by_duration;
  }
  if (!time && !speed) {
    (void)ambulo__yaml_error(section, AMBULO_E_SCHEMA, NULL,
                             "no step time; expected one of gait.step_time, gait.speed, "
                             "time.duration");
    return 1.0;
  }
  if (time) check_agreement(speed, "speed", by_speed, by_time);
  return time ? by_time : by_speed;
}

static int phases_are_in_order(const ambulo_gait *gait) {
  return gait->heel_strike <= gait->foot_flat && gait->foot_flat <= gait->heel_off &&
         gait->heel_off <= gait->toe_off && gait->toe_off < gait->heel_strike + 1.0;
}

static void read_phases(ambulo__problem_reader *reader, const ambulo__yaml_node *section,
                        ambulo_gait *gait) {
  const ambulo__yaml_node *node = ambulo__yaml_get(section, "phases");
  double speed = ambulo__gait_place(gait, gait->steps) / ambulo__gait_strike(gait, gait->steps);
  double *const phase[AMBULO__PHASES] = {&gait->heel_strike, &gait->foot_flat, &gait->heel_off,
                                         &gait->toe_off};
  double value[AMBULO__PHASES];
  if (!ambulo__read_phases(reader, node, speed, value)) return;
  for (int i = 0; i < AMBULO__PHASES; i++) *phase[i] = value[i];
  if (!node || phases_are_in_order(gait)) return;
  int moves = 0;
  for (int i = 0; i < AMBULO__PHASES; i++) moves |= reader->keys.by_speed[i] != AMBULO__PHASE_SHARE;
  char hint[80];
  (void)snprintf(hint, sizeof hint, "phases go with the speed, here %.4g sqrt(g H)",
                 reader->keys.speed_number);
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, moves ? hint : NULL,
                           "phases %.6g, %.6g, %.6g, %.6g of a stride; expected heel_strike <= "
                           "foot_flat <= heel_off <= toe_off < heel_strike + 1",
                           gait->heel_strike, gait->foot_flat, gait->heel_off, gait->toe_off);
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

/* two step times: 1 if the file gives them */
static int read_two_times(const ambulo__problem_reader *reader, const ambulo__yaml_node *section,
                          const walking_pace *pace, ambulo_gait *gait) {
  const ambulo__yaml_node *node = ambulo__yaml_get(section, "step_time");
  const double *times = pace->times;
  if (!is_list(node)) return 0;
  gait->step_time = times[0];
  gait->other_step_time = times[1];
  if (!(times[0] >= 1e-3 && times[1] >= 1e-3 && times[0] <= 1e3 && times[1] <= 1e3)) {
    if (!isnan(times[0]) && !isnan(times[1]))
      (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                               "step times %g s and %g s; expected 0.001 to 1000 s", times[0],
                               times[1]);
    gait->step_time = gait->other_step_time = 1.0;
    return 1;
  }
  double mean = mean_step_time(gait);
  if (reader->has_duration)
    check_agreement(node, "step_time", mean, reader->definition.duration / (double)gait->steps);
  check_agreement(ambulo__yaml_get(section, "speed"), "speed", step_time_at(gait, pace->speed),
                  mean);
  return 1;
}

/* mean time of a step where the keys of time say it, else NaN */
static double given_step_time(const ambulo__problem_reader *reader, const walking_pace *pace,
                              int steps) {
  const ambulo_gait timed = {.step_time = pace->times[0], .other_step_time = pace->times[1]};
  if (reader->has_duration) return reader->definition.duration / (double)steps;
  return ambulo__gait_strike(&timed, steps) / (double)steps;
}

/* one length, two, a function of the speed, that of the speed and a time, or that which people
 * choose at the speed */
static void read_step_lengths(ambulo__problem_reader *reader, const ambulo__yaml_node *section,
                              const walking_pace *pace, ambulo_gait *gait) {
  const double walk_ratio = 0.0035, usual = 1.75; /* statures per (step / min) at m */
  const ambulo__yaml_node *node = ambulo__yaml_get(section, "step_length");
  double stature = ambulo_model_stature(reader->model);
  double by_time = pace->speed * given_step_time(reader, pace, gait->steps);
  if (is_list(node)) {
    double lengths[2] = {0.0, 0.0};
    (void)ambulo__yaml_numbers(node, 2, lengths);
    gait->step_length = lengths[0];
    gait->other_step_length = lengths[1] != 0.0 ? lengths[1] : AMBULO_OFF;
  } else if (ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) {
    gait->step_length = ambulo__read_step_length(reader, node, pace->speed);
  } else if (!node && !isnan(by_time)) {
    gait->step_length = by_time;
  } else if (!node && ambulo__yaml_get(section, "speed") && stature > 0.0) {
    double speed = isnan(pace->speed) ? 1.0 : pace->speed;
    gait->step_length = sqrt(60.0 * speed * walk_ratio * stature * sqrt(stature / usual));
  } else {
    gait->step_length =
        ambulo__yaml_number_in(ambulo__yaml_require(section, "step_length"), -10.0, 10.0, 0.0);
  }
}

static int differs(double value, double other) {
  return !isnan(other) && fabs(value - other) > 1e-9 * fabs(value);
}

static void read_gait(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo_gait gait = ambulo_gait_default();
  gait.steps = ambulo__yaml_integer(ambulo__yaml_require(section, "steps"), 1, 1000, 1);
  gait.first_foot = read_foot(reader, ambulo__yaml_require(section, "first_foot"));
  const walking_pace pace = read_pace(section);
  read_step_lengths(reader, section, &pace, &gait);
  static const char *const landings[] = {"heel", "forefoot"};
  gait.forefoot = ambulo__yaml_choice(ambulo__yaml_get(section, "landing"), landings, 2, 0);
  double longer = reader->keys.longer > 0.0 ? reader->keys.longer : 1.0;
  gait.step_width = longer * ambulo__yaml_number_in(ambulo__yaml_get(section, "step_width"), 0.0,
                                                    10.0, neutral_width(reader->model) / longer);
  gait.start = ambulo__yaml_number_in(ambulo__yaml_get(section, "start"), -1e3, 1e3, 0.0);
  if (!read_two_times(reader, section, &pace, &gait))
    gait.step_time = read_step_time(reader, section, &pace, &gait);
  read_phases(reader, section, &gait);
  ambulo__yaml_close(section);
  if (!reader->has_duration) reader->definition.duration = ambulo__gait_strike(&gait, gait.steps);
  reader->definition.travel = ambulo__gait_place(&gait, gait.steps);
  reader->steps = gait.steps;
  reader->unlike_steps = differs(gait.step_time, gait.other_step_time) ||
                         differs(gait.step_length, gait.other_step_length);
  reader->keys.gait = 1;
  reader->keys.steps = gait.steps;
  reader->keys.unlike_steps = reader->unlike_steps;
  reader->keys.speed = ambulo__yaml_get(section, "speed") != NULL;
  const ambulo__yaml_node *length = ambulo__yaml_get(section, "step_length");
  const ambulo__yaml_node *time = ambulo__yaml_get(section, "step_time");
  reader->keys.length = length && !reader->keys.length_function;
  reader->keys.lengths = is_list(length);
  reader->keys.step_time = time && !is_list(time);
  reader->keys.times = is_list(time);
  reader->keys.duration = reader->has_duration;
  reader->keys.walk = gait;
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
