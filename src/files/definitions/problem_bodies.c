/* definitions/problem_bodies.c - `constraints.collision`, `constraints.reach` and `obstacles`. */
#include "definitions/problem_reader.h"

#include "contact/collision.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double most_margin = 1.0;   /* m */
static const double usual_margin = 0.01; /* m */
static const double farthest = 1000.0;   /* m */

/* ---------------------------------------------------------------------- names */

typedef const char *(*name_getter)(const ambulo_model *model, int index);

static const char *capsule_name(const ambulo_model *model, int i) {
  return model->capsules[i].name;
}

static const char *point_name(const ambulo_model *model, int i) {
  return model->points[i].name;
}

/* the index of a name that stands at a node; -1 after an error with the nearest one */
static int find(ambulo__problem_reader *reader, const ambulo__yaml_node *node, const char *kind,
                int count, name_getter name_of) {
  const char *name = ambulo__yaml_name(node);
  if (!name[0]) return -1;
  const char **names = ambulo__reader_alloc(reader, (size_t)count, sizeof *names);
  if (!names) return -1;
  char hint[100];
  for (int i = 0; i < count; i++) {
    names[i] = name_of(reader->model, i);
    if (!strcmp(names[i], name)) return i;
  }
  const char *nearest = ambulo__nearest(name, names, (size_t)count);
  if (nearest) (void)snprintf(hint, sizeof hint, "did you mean '%s'?", nearest);
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, nearest ? hint : NULL,
                           "unknown %s (got '%s'); expected a %s of the model%s", kind, name, kind,
                           count ? "" : ", which has none");
  return -1;
}

static int find_capsule(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  return find(reader, node, "capsule", reader->model->capsule_count, capsule_name);
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

static void read_collision(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo_collision *collision = &reader->definition.collision;
  if (!section) return;
  collision->margin =
      ambulo__yaml_number_in(ambulo__yaml_get(section, "margin"), 0.0, most_margin, usual_margin);
  read_pairs(reader, ambulo__yaml_get(section, "pairs"), collision);
  ambulo__yaml_close(section);
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

static void read_reach(ambulo__problem_reader *reader, const ambulo__yaml_node *item,
                       ambulo_reach *reach) {
  reach->point = find(reader, ambulo__yaml_require(item, "point"), "point",
                      reader->model->point_count, point_name);
  if (reach->point < 0) reach->point = 0; /* that was said */
  const ambulo__yaml_node *other = ambulo__yaml_get(item, "relative_to");
  if (other) {
    reach->about = find(reader, other, "point", reader->model->point_count, point_name);
    reach->is_relative = reach->about >= 0;
  }
  (void)ambulo__yaml_numbers(ambulo__yaml_require(item, "place"), 3, reach->place);
  reach->to = INFINITY;
  if (!other || ambulo__yaml_get(item, "at")) read_times(ambulo__yaml_require(item, "at"), reach);
  reach->tolerance = ambulo__yaml_number_in(ambulo__yaml_get(item, "tolerance"), 0.0, 1.0, 0.0);
  ambulo__yaml_close(item);
}

static void read_reaches(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  const ambulo__yaml_node *list = list_of(node, "{point, place, at, tolerance}");
  if (!list) return;
  int count = ambulo__yaml_items(list);
  ambulo_reach *reaches = ambulo__reader_alloc(reader, (size_t)count, sizeof *reaches);
  for (int i = 0; reaches && i < count; i++)
    read_reach(reader, ambulo__yaml_item(list, i), &reaches[i]);
  reader->definition.reaches = reaches;
  reader->definition.reach_count = reaches ? count : 0;
}

/* ------------------------------------------------------------------ obstacles */

static void read_sizes(const ambulo__yaml_node *node, double half[3]) {
  if (!ambulo__yaml_numbers(node, 3, half)) return;
  for (int i = 0; i < 3; i++) {
    if (half[i] > 0.0 && half[i] <= farthest) continue;
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "half a size of %g m; expected more than 0, at most %g m", half[i],
                             farthest);
    half[i] = 1.0;
  }
}

static void read_shape(ambulo__problem_reader *reader, const ambulo__yaml_node *item,
                       ambulo_obstacle *obstacle) {
  int is_capsule = ambulo__yaml_get(item, "radius") != NULL || ambulo__yaml_get(item, "to") != NULL;
  if (is_capsule) {
    obstacle->shape = AMBULO_OBSTACLE_CAPSULE;
    (void)ambulo__yaml_numbers(ambulo__yaml_require(item, "from"), 3, obstacle->from);
    (void)ambulo__yaml_numbers(ambulo__yaml_require(item, "to"), 3, obstacle->to);
    obstacle->radius =
        ambulo__yaml_number_in(ambulo__yaml_require(item, "radius"), 1e-4, farthest, 1.0);
    return;
  }
  obstacle->shape = AMBULO_OBSTACLE_BOX;
  (void)ambulo__yaml_numbers(ambulo__yaml_require(item, "center"), 3, obstacle->center);
  read_sizes(ambulo__yaml_require(item, "half_size"), obstacle->half);
  obstacle->heading = ambulo__read_plain_angle(reader, ambulo__yaml_get(item, "heading"), 0.0);
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
                          ambulo_obstacle *obstacle) {
  obstacle->name = ambulo__yaml_name(ambulo__yaml_require(item, "name"));
  read_shape(reader, item, obstacle);
  obstacle->margin =
      ambulo__yaml_number_in(ambulo__yaml_get(item, "margin"), 0.0, most_margin, usual_margin);
  read_capsules(reader, ambulo__yaml_get(item, "capsules"), obstacle);
  ambulo__yaml_close(item);
}

void ambulo__read_bodies(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  const ambulo__yaml_node *section = ambulo__yaml_get(root, "constraints");
  if (ambulo__yaml_is(section, AMBULO__YAML_MAPPING)) {
    read_collision(reader, ambulo__yaml_get(section, "collision"));
    read_reaches(reader, ambulo__yaml_get(section, "reach"));
  }
  const ambulo__yaml_node *list = list_of(ambulo__yaml_get(root, "obstacles"), "obstacles");
  if (!list) return;
  int count = ambulo__yaml_items(list);
  ambulo_obstacle *obstacles = ambulo__reader_alloc(reader, (size_t)count, sizeof *obstacles);
  for (int i = 0; obstacles && i < count; i++)
    read_obstacle(reader, ambulo__yaml_item(list, i), &obstacles[i]);
  reader->definition.obstacles = obstacles;
  reader->definition.obstacle_count = obstacles ? count : 0;
}
