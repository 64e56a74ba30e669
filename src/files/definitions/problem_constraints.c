/* definitions/problem_constraints.c - `constraints:`, `ends:` and `obstacles:` of a problem file.
 */
#include "contact/row_families.h"
#include "definitions/problem_reader.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---------------------------------------------------------------- constraints */

static void read_strike_pitch(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  double *pitch = reader->definition.strike_pitch;
  if (!node) return;
  if (!ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) || ambulo__yaml_items(node) != 2) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "'strike_pitch' is not a list of two angles");
    return;
  }
  for (int i = 0; i < 2; i++)
    pitch[i] = ambulo__read_plain_angle(reader, ambulo__yaml_item(node, i), 0.0);
  if (pitch[0] < pitch[1] && fabs(pitch[0]) < 1.5 && fabs(pitch[1]) < 1.5) return;
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                           "from %g to %g rad; expected two rising angles of less than 1.5 rad",
                           pitch[0], pitch[1]);
}

void ambulo__read_constraints(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo_problem_definition *d = &reader->definition;
  if (!section) return;
  ambulo__read_members(reader, section, &ambulo__definition_members, "constraints.", d);
  read_strike_pitch(reader, ambulo__yaml_get(section, "strike_pitch"));
  const ambulo__yaml_node *clearance = ambulo__reader_section(section, "clearance");
  if (clearance)
    ambulo__read_members(reader, clearance, &ambulo__clearance_members, "", &d->clearance);
  ambulo__yaml_close(clearance);
  ambulo__yaml_expect(section, "tubes");     /* read with the schedule known */
  ambulo__yaml_expect(section, "collision"); /* with the model known */
  ambulo__yaml_expect(section, "reach");
  ambulo__yaml_close(section);
}

/* ----------------------------------------------------------------------- ends */

/* mappings of coordinate names to values, `default` for those not named */
static void read_end_values(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  static const char *const keys[] = {"initial", "initial_speed", "initial_acceleration",
                                     "final",   "final_speed",   "final_acceleration"};
  ambulo_problem_definition *d = &reader->definition;
  int coordinates = ambulo_model_coordinate_count(reader->model);
  ambulo_end_value *values = ambulo__reader_alloc(reader, 6 * (size_t)coordinates, sizeof *values);
  for (int k = 0; values && k < 6; k++) {
    const ambulo__yaml_node *mapping = ambulo__reader_section(section, keys[k]);
    const ambulo__yaml_node *others = ambulo__yaml_get(mapping, "default");
    for (int i = 0; mapping && i < coordinates; i++) {
      const ambulo__yaml_node *node =
          ambulo__yaml_get(mapping, ambulo_model_coordinate(reader->model, i)->name);
      if (!node) node = others;
      if (!node) continue;
      values[d->end_value_count++] =
          (ambulo_end_value){i, k % 3, k / 3, ambulo__read_coordinate_value(reader, node, i)};
    }
    ambulo__yaml_close(mapping);
  }
  d->end_values = values;
}

/* Feet alternate: after an odd number of steps the other one leads, and the motion can only go on
 * as its mirror image; after an even number as itself. */
static void check_steps(const ambulo__problem_reader *reader, const ambulo__yaml_node *kind) {
  ambulo_ends ends = reader->definition.ends;
  int odd = reader->keys.steps % 2;
  if (reader->keys.steps == 0 || ends == AMBULO_ENDS_FREE) return;
  if (odd != (ends == AMBULO_ENDS_MIRRORED))
    (void)ambulo__yaml_error(kind, AMBULO_E_PROBLEM,
                             odd ? "ends: {kind: mirrored}, or an even number of steps"
                                 : "ends: {kind: periodic}, or an odd number of steps",
                             "%s ends with %d step%s; expected an %s number, after which %s",
                             odd ? "periodic" : "mirrored", reader->keys.steps,
                             reader->keys.steps == 1 ? "" : "s", odd ? "even" : "odd",
                             odd ? "the same foot strikes again" : "the other foot strikes");
  else if (odd && reader->keys.unlike_steps)
    (void)ambulo__yaml_error(kind, AMBULO_E_PROBLEM,
                             "ends: {kind: periodic} with an even number of steps",
                             "mirrored ends make each step the mirror image of the one before, but "
                             "the gait has steps of two lengths or times; expected equal steps");
}

/* keys of ends that match: a height is not given for nothing, an order may stay in the file */
static void check_idle(const ambulo__yaml_node *section, double rise) {
  const ambulo__yaml_node *order = ambulo__yaml_get(section, "order");
  if (order)
    ambulo__yaml_warning(order, NULL,
                         "'order' has no effect with free ends; it belongs to kind "
                         "periodic or mirrored");
  if (rise != 0.0)
    (void)ambulo__yaml_error(ambulo__yaml_get(section, "rise"), AMBULO_E_PROBLEM, NULL,
                             "a rise of %g m with free ends, which do nothing with it; expected "
                             "'kind: periodic' or 'kind: mirrored' beside it",
                             rise);
}

void ambulo__read_ends(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  static const char *const kinds[] = {"free", "periodic", "mirrored"};
  ambulo_problem_definition *d = &reader->definition;
  if (!section) return;
  ambulo__read_members(reader, section, &ambulo__definition_members, "ends.", d);
  const ambulo__yaml_node *given = ambulo__yaml_get(section, "kind");
  int kind = ambulo__yaml_choice(given, kinds, 3, given ? -1 : 0); /* -1: that was said */
  d->ends = kind < 0 ? AMBULO_ENDS_FREE : (ambulo_ends)kind;
  check_steps(reader, ambulo__yaml_get(section, "kind"));
  reader->keys.travel = ambulo__yaml_get(section, "travel") != NULL;
  if (kind == 0) check_idle(section, d->rise);
  read_end_values(reader, section);
  ambulo__yaml_close(section);
}

/* -------------------------------------------------- collision, reach and obstacles */

static const double usual_margin = 0.01; /* m, of obstacles */

enum { MOST_ITEMS = 10000 };

static int find_capsule(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  return ambulo__read_name_of(reader, node, AMBULO__NAMED_CAPSULE);
}

/* a list, or an error and NULL */
static const ambulo__yaml_node *list_of(const ambulo__yaml_node *node, const char *what) {
  if (!node || ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE)) return node;
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "expected a list of %s", what);
  return NULL;
}

/* ------------------------------------------------------------------ collision */

/* a pair that overlaps as the body stands cannot hold there */
static void warn_of_overlap(ambulo__problem_reader *reader, const ambulo__yaml_node *item,
                            ambulo_capsule_pair pair) {
  const ambulo_capsule *capsules = reader->model->capsules;
  double gap = 0.0;
  ambulo_status status = ambulo__rest_gap(reader->model, pair, &reader->allocator, &gap);
  if (status) reader->failure = status;
  if (status || gap >= 0.0) return;
  ambulo__yaml_warning(item, "'pairs: automatic' leaves such pairs out",
                       "'%s' and '%s' overlap by %.3g m in the rest pose", capsules[pair.one].name,
                       capsules[pair.other].name, -gap);
}

static int read_pair(ambulo__problem_reader *reader, const ambulo__yaml_node *item,
                     ambulo_capsule_pair *pair) {
  if (!ambulo__yaml_is(item, AMBULO__YAML_SEQUENCE) || ambulo__yaml_items(item) != 2) {
    (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL,
                             "expected the names of two capsules, such as [shank_l, shank_r]");
    return 0;
  }
  pair->one = find_capsule(reader, ambulo__yaml_item(item, 0));
  pair->other = find_capsule(reader, ambulo__yaml_item(item, 1));
  if (pair->one < 0 || pair->other < 0) return 0;
  if (pair->one != pair->other) {
    warn_of_overlap(reader, item, *pair);
    return 1;
  }
  (void)ambulo__yaml_error(item, AMBULO_E_PROBLEM, NULL,
                           "a capsule and itself (got '%s' twice); expected two capsules",
                           reader->model->capsules[pair->one].name);
  return 0;
}

static void read_pairs(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                       ambulo_collision *collision) {
  static const char *const words[] = {"automatic", "off"};
  if (!node || ambulo__yaml_is(node, AMBULO__YAML_SCALAR)) {
    collision->mode =
        ambulo__yaml_choice(node, words, 2, 0) ? AMBULO_COLLISION_OFF : AMBULO_COLLISION_AUTOMATIC;
    return;
  }
  if (!list_of(node, "pairs of capsules, or 'automatic'")) return;
  int count = ambulo__yaml_items(node), good = 0;
  if (count == 0)
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "an empty list; expected pairs of capsules, 'automatic' or 'off'");
  ambulo_capsule_pair *pairs = ambulo__reader_alloc(reader, (size_t)count, sizeof *pairs);
  for (int i = 0; pairs && i < count; i++)
    good += read_pair(reader, ambulo__yaml_item(node, i), &pairs[good]);
  collision->mode = AMBULO_COLLISION_PAIRS;
  collision->pairs = pairs;
  collision->pair_count = good;
}

/* a word, or pairs and margin; absent: the default of the members, automatic */
static void read_collision(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo_collision *collision = &reader->definition.collision;
  if (!section) return;
  int is_word = ambulo__yaml_is(section, AMBULO__YAML_SCALAR);
  if (!is_word) ambulo__read_members(reader, section, &ambulo__collision_members, "", collision);
  read_pairs(reader, is_word ? section : ambulo__yaml_get(section, "pairs"), collision);
  if (collision->mode == AMBULO_COLLISION_AUTOMATIC && reader->model->capsule_count == 0)
    (void)ambulo__yaml_error(section, AMBULO_E_PROBLEM, NULL,
                             "constraints.collision: the model '%s' has no capsules; expected some "
                             "in the model file",
                             reader->model->name);
  if (!is_word) ambulo__yaml_close(section);
}

/* ---------------------------------------------------------------------- reach */

/* `at`: a time, or [from, to] */
static void read_times(const ambulo__yaml_node *node, ambulo_reach *reach) {
  double times[2] = {0.0, 0.0};
  if (ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE)) {
    (void)ambulo__yaml_numbers(node, 2, times);
  } else {
    times[0] = times[1] = ambulo__yaml_number(node, 0.0);
  }
  reach->from = times[0];
  reach->to = times[1];
}

static void read_reach(ambulo__problem_reader *reader, const ambulo__yaml_node *item, void *out) {
  ambulo_reach *reach = out;
  int point =
      ambulo__read_name_of(reader, ambulo__yaml_require(item, "point"), AMBULO__NAMED_POINT);
  reach->point = point < 0 ? 0 : point; /* that was said */
  const ambulo__yaml_node *other = ambulo__yaml_get(item, "relative_to");
  reach->about = ambulo__read_name_of(reader, other, AMBULO__NAMED_POINT);
  reach->is_relative = reach->about >= 0;
  ambulo__read_members(reader, item, &ambulo__reach_members, "", reach);
  if (!other || ambulo__yaml_get(item, "at")) read_times(ambulo__yaml_require(item, "at"), reach);
  ambulo__yaml_close(item);
}

/* ------------------------------------------------------------------ obstacles */

static void read_shape(ambulo__problem_reader *reader, const ambulo__yaml_node *item,
                       ambulo_obstacle *obstacle) {
  static const char *const of_box[] = {"center", "half_size"};
  static const char *const of_capsule[] = {"from", "to", "radius"};
  int is_capsule = ambulo__yaml_get(item, "radius") != NULL || ambulo__yaml_get(item, "to") != NULL;
  const char *const *keys = is_capsule ? of_capsule : of_box;
  for (int k = 0; k < (is_capsule ? 3 : 2); k++)
    ambulo__read_member(reader, ambulo__yaml_require(item, keys[k]), &ambulo__obstacle_members,
                        keys[k], obstacle);
  if (is_capsule)
    obstacle->shape = AMBULO_OBSTACLE_CAPSULE;
  else
    ambulo__read_member(reader, ambulo__yaml_get(item, "heading"), &ambulo__obstacle_members,
                        "heading", obstacle);
}

static void read_capsules(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                          ambulo_obstacle *obstacle) {
  static const char *const words[] = {"all"};
  if (!node || ambulo__yaml_is(node, AMBULO__YAML_SCALAR)) {
    (void)ambulo__yaml_choice(node, words, 1, 0);
    return;
  }
  if (!list_of(node, "capsules, or 'all'")) return;
  int count = ambulo__yaml_items(node), good = 0;
  int *capsules = ambulo__reader_alloc(reader, (size_t)count + 1, sizeof *capsules);
  for (int i = 0; capsules && i < count; i++) {
    capsules[good] = find_capsule(reader, ambulo__yaml_item(node, i));
    good += capsules[good] >= 0;
  }
  if (count == 0)
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "an empty list; expected names of capsules, or 'all'");
  obstacle->capsules = good ? capsules : NULL;
  obstacle->capsule_count = good;
}

static void read_obstacle(ambulo__problem_reader *reader, const ambulo__yaml_node *item,
                          void *out) {
  ambulo_obstacle *obstacle = out;
  obstacle->margin = usual_margin;
  ambulo__read_members(reader, item, &ambulo__obstacle_members, "", obstacle);
  read_shape(reader, item, obstacle);
  read_capsules(reader, ambulo__yaml_get(item, "capsules"), obstacle);
  ambulo__yaml_close(item);
}

void ambulo__read_bodies(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  ambulo_problem_definition *d = &reader->definition;
  const ambulo__yaml_node *section = ambulo__yaml_get(root, "constraints");
  if (ambulo__yaml_is(section, AMBULO__YAML_MAPPING)) {
    read_collision(reader, ambulo__yaml_get(section, "collision"));
    d->reaches =
        ambulo__read_items(reader, ambulo__yaml_get(section, "reach"), &ambulo__reach_members, 0,
                           MOST_ITEMS, read_reach, &d->reach_count);
  }
  d->obstacles =
      ambulo__read_items(reader, ambulo__yaml_get(root, "obstacles"), &ambulo__obstacle_members, 0,
                         MOST_ITEMS, read_obstacle, &d->obstacle_count);
}
