/* retarget/segments.c - see segments.h. */
#include "retarget/segments.h"

#include "import/body_tree.h"

#include <ctype.h>
#include <fnmatch.h>
#include <string.h>

enum { MOST_COORDINATES = 4096 }; /* as many as a model has links */

static const char *const names[AMBULO__SEGMENTS] = {
    "pelvis", "torso",  "thigh_r",     "thigh_l",     "shank_r",   "shank_l",
    "foot_r", "foot_l", "upper_arm_r", "upper_arm_l", "forearm_r", "forearm_l",
};

static const int parents[AMBULO__SEGMENTS] = {
    -1, AMBULO__PELVIS, AMBULO__PELVIS, AMBULO__PELVIS, 2, 3, 4, 5, AMBULO__TORSO, AMBULO__TORSO, 8,
    9};

int ambulo__segment_above(int segment) {
  return parents[segment];
}

const char *ambulo__segment_word(int segment) {
  return names[segment];
}

/* ------------------------------------------------------------------ built-in table */

/* The first pattern that fits a name in small letters decides; -1: of none of the segments. Ambulo,
 * OpenSim and MuJoCo; SMPL; BVH of CMU and Mixamo; robots, whose limbs may be numbered (Talos). */
static const struct {
  const char *pattern;
  int segment;
} builtin[] = {
    {"*wrist*", -1},
    {"*hand*", -1},
    {"*finger*", -1},
    {"*thumb*", -1},
    {"*toe*", -1},
    {"*mtp*", -1},
    {"*head*", -1},
    {"*neck*", -1},
    {"*pro_sup*", -1},
    {"*collar*", -1},
    {"*clav*", -1},
    {"*gripper*", -1},
    {"*beta*", -1},
    {"*elbow*", AMBULO__FOREARM},
    {"*forearm*", AMBULO__FOREARM},
    {"*lower_arm*", AMBULO__FOREARM},
    {"arm_*_4*", AMBULO__FOREARM},
    {"arm_*_[567]*", -1},
    {"*shoulder*", AMBULO__UPPER_ARM},
    {"*arm*", AMBULO__UPPER_ARM},
    {"leg_*_[123]*", AMBULO__THIGH},
    {"leg_*_4*", AMBULO__SHANK},
    {"leg_*_[56]*", AMBULO__FOOT},
    {"*hip*", AMBULO__THIGH},
    {"*upleg*", AMBULO__THIGH},
    {"*thigh*", AMBULO__THIGH},
    {"*ankle*", AMBULO__FOOT},
    {"*subtalar*", AMBULO__FOOT},
    {"*foot*", AMBULO__FOOT},
    {"*knee*", AMBULO__SHANK},
    {"*shin*", AMBULO__SHANK},
    {"*shank*", AMBULO__SHANK},
    {"*leg*", AMBULO__SHANK},
    {"*lumbar*", AMBULO__TORSO},
    {"*waist*", AMBULO__TORSO},
    {"*torso*", AMBULO__TORSO},
    {"*trunk*", AMBULO__TORSO},
    {"*spine*", AMBULO__TORSO},
    {"*back*", AMBULO__TORSO},
    {"*chest*", AMBULO__TORSO},
    {"*abdomen*", AMBULO__TORSO},
};

int ambulo__segment_of(const char *name) {
  char small[AMBULO__NUMTEXT_SIZE * 4];
  size_t length = 0;
  for (; name[length] && length + 1 < sizeof small; length++)
    small[length] = (char)tolower((unsigned char)name[length]);
  small[length] = '\0';
  for (size_t i = 0; i < sizeof builtin / sizeof *builtin; i++) {
    if (fnmatch(builtin[i].pattern, small, 0) != 0) continue;
    int segment = builtin[i].segment;
    char side = ambulo__side_of(name);
    if (segment <= AMBULO__TORSO) return segment;
    return side ? segment + (side == 'l') : -1;
  }
  return -1;
}

static void add(ambulo__segment_map *map, int segment, int coordinate) {
  int *count = &map->count[segment];
  if (*count < AMBULO__SEGMENT_COORDINATES) map->coordinate[segment][(*count)++] = coordinate;
}

/* 1 where a link carries nothing but one other */
static int is_passed(const ambulo_model *model, int link, int *child) {
  int children = 0;
  for (int i = link + 1; i < model->link_count; i++) {
    if (model->links[i].parent != link) continue;
    children++;
    *child = i;
  }
  return children == 1 && model->links[link].mass <= 0.0;
}

/* what the pelvis hangs on: of[coordinate] becomes AMBULO__PELVIS */
static void find_root(const ambulo_model *model, ambulo__segment_map *map, unsigned char *of_root) {
  for (int link = 0, next = 0, more = model->link_count > 0; more; link = next) {
    more = is_passed(model, link, &next);
    int c = model->links[link].coordinate;
    if (c < 0) continue;
    of_root[c] = 1;
    if (model->links[link].type == AMBULO_REVOLUTE)
      add(map, AMBULO__PELVIS, c);
    else if (map->slides < 3)
      map->slide[map->slides++] = c;
  }
}

/* ------------------------------------------------------------------- given table */

static void take_named(const ambulo_model *model, const ambulo__yaml_node *list, int segment,
                       ambulo__segment_map *map) {
  unsigned char taken[MOST_COORDINATES] = {0};
  int most = MOST_COORDINATES;
  map->count[segment] = 0;
  for (int i = 0; i < ambulo__yaml_items(list); i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(list, i);
    const char *pattern = ambulo__yaml_text(item);
    int found = 0;
    for (int c = 0; c < model->coordinate_count && c < most; c++) {
      if (fnmatch(pattern, model->coordinates[c].name, 0) != 0) continue;
      found = taken[c] = 1;
    }
    if (!found)
      (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL,
                               "model '%s' has no coordinate '%s'; expected one of those that "
                               "'ambulo info' lists",
                               model->name, pattern);
  }
  for (int c = 0; c < model->coordinate_count && c < most; c++)
    if (taken[c] && model->coordinates[c].type == AMBULO_REVOLUTE) add(map, segment, c);
}

void ambulo__segments_find(const ambulo_model *model, const ambulo__yaml_node *table,
                           ambulo__segment_map *map) {
  unsigned char of_root[MOST_COORDINATES] = {0};
  *map = (ambulo__segment_map){.slides = 0};
  find_root(model, map, of_root);
  for (int c = 0; c < model->coordinate_count && c < MOST_COORDINATES; c++) {
    const ambulo_coordinate *about = &model->coordinates[c];
    if (of_root[c] || about->type != AMBULO_REVOLUTE) continue;
    int segment = ambulo__segment_of(about->name);
    if (segment >= 0) add(map, segment, c);
  }
  for (int segment = AMBULO__TORSO; segment < AMBULO__SEGMENTS; segment++) {
    const ambulo__yaml_node *list = ambulo__yaml_get(table, names[segment]);
    if (list) take_named(model, list, segment, map);
  }
  ambulo__yaml_close(table);
}

ambulo_status ambulo__segments_check(const ambulo_model *model, const ambulo__segment_map *map,
                                     const char *what, ambulo_diagnostics *diagnostics) {
  for (int segment = 0; segment < AMBULO__UPPER_ARM; segment++) {
    if (segment == AMBULO__TORSO || map->count[segment] > 0) continue;
    return ambulo__error(
        diagnostics, AMBULO_E_MODEL, ambulo__nowhere, "--map FILE names the coordinates",
        "no coordinate of %s '%s' turns its %s; expected names such as hip_flexion_r, "
        "right_knee_joint",
        what, model->name, names[segment]);
  }
  return AMBULO_OK;
}

void ambulo__segments_print(const ambulo_model *model, const ambulo__segment_map *map,
                            ambulo__text_buffer *text) {
  for (int segment = AMBULO__TORSO; segment < AMBULO__SEGMENTS; segment++) {
    ambulo__text_append_format(text, "  %s: [", names[segment]);
    for (int i = 0; i < map->count[segment]; i++)
      ambulo__text_append_format(text, "%s%s", i ? ", " : "",
                                 model->coordinates[map->coordinate[segment][i]].name);
    ambulo__text_append(text, "]\n");
  }
}
