/* people/force_columns.c - groups of columns by their names (force_columns.h). */
#include "people/force_columns.h"

#include "mechanics/pose.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

typedef enum part { FORCE, POINT, TORQUE, FREE_MOMENT, MOMENT } part;

/* a column's name, taken apart */
typedef struct label {
  part part;
  int axis;                   /* of all but FREE_MOMENT */
  const char *before, *after; /* tag: around the words */
  size_t before_length, after_length;
  int own; /* grf., cop., free_moment., moment. */
} label;

static int axis_of(char letter) {
  const char *axes = "xyzXYZ", *at = letter ? strchr(axes, letter) : NULL;
  return at ? (int)(at - axes) % 3 : -1;
}

/* grf.NAME.x, cop.NAME.x, free_moment.NAME, moment.NAME.x */
static int read_own(const char *name, label *l) {
  static const char *const prefixes[] = {"grf.", "cop.", "free_moment.", "moment."};
  static const part parts[] = {FORCE, POINT, FREE_MOMENT, MOMENT};
  for (int i = 0; i < 4; i++) {
    size_t head = strlen(prefixes[i]), length = strlen(name),
           tail = parts[i] == FREE_MOMENT ? 0 : 2;
    if (strncmp(name, prefixes[i], head) != 0 || length <= head + tail) continue;
    if (tail && (name[length - 2] != '.' || axis_of(name[length - 1]) < 0)) continue;
    *l = (label){.part = parts[i], .own = 1, .after = name + head};
    l->axis = tail ? axis_of(name[length - 1]) : 0;
    l->after_length = length - head - tail;
    return 1;
  }
  return 0;
}

/* where a word of its own begins in the name */
static const char *find_word(const char *name, const char *word) {
  size_t length = strlen(word);
  for (const char *at = name; *at; at++) {
    if (strncasecmp(at, word, length) != 0 || isalpha((unsigned char)at[length])) continue;
    if (at == name || strchr("_. /-", at[-1])) return at;
  }
  return NULL;
}

/* the last piece, "vx", "pz" or "x": which part of the load, along which axis */
static int read_component(const char *piece, size_t length, int torque_word, label *l) {
  l->axis = length > 0 ? axis_of(piece[length - 1]) : -1;
  if (l->axis < 0 || length > 2) return 0;
  char letter = (char)(length == 2 ? piece[0] | 0x20 : torque_word ? 'm' : 'v');
  if (!strchr("vfpmt", letter)) return 0;
  l->part = letter == 'p' ? POINT : letter == 'm' || letter == 't' || torque_word ? TORQUE : FORCE;
  return !(torque_word && letter == 'p');
}

/* [tag_]ground_force[_tag]_vx and its kin */
static int read_common(const char *name, label *l) {
  static const char *const words[] = {"ground_force", "ground_torque", "ground_moment"};
  const char *at = NULL;
  int word = 0;
  for (; word < 3 && !at; word++) at = find_word(name, words[word]);
  if (!at) return 0;
  *l = (label){.before = name, .before_length = (size_t)(at - name)};
  while (l->before_length > 0 && strchr("_. /-", name[l->before_length - 1])) l->before_length--;
  const char *rest = at + strlen(words[word - 1]), *last = strrchr(rest, '_');
  if (!last || !read_component(last + 1, strlen(last + 1), word > 1, l)) return 0;
  while (rest < last && *rest == '_') rest++;
  l->after = rest;
  l->after_length = (size_t)(last - rest);
  return 1;
}

static void name_group(const label *l, ambulo__force_group *group) {
  int before = (int)l->before_length, after = (int)l->after_length;
  if (l->own) {
    (void)snprintf(group->name, sizeof group->name, "grf.%.*s", after, l->after);
    (void)snprintf(group->tag, sizeof group->tag, "%.*s", after, l->after);
    return;
  }
  (void)snprintf(group->name, sizeof group->name, "%.*s%sground_force%s%.*s", before, l->before,
                 before ? "_" : "", after ? "_" : "", after, l->after);
  (void)snprintf(group->tag, sizeof group->tag, "%.*s%s%.*s", before, l->before,
                 before && after ? "_" : "", after, l->after);
}

static ambulo__force_group empty_group(void) {
  ambulo__force_group group = {.foot = -1, .free_moment = -1};
  for (int i = 0; i < 3; i++)
    group.force[i] = group.point[i] = group.torque[i] = group.moment[i] = -1;
  return group;
}

static int *place_of(ambulo__force_group *group, const label *l) {
  switch (l->part) {
  case FORCE:
    return &group->force[l->axis];
  case POINT:
    return &group->point[l->axis];
  case TORQUE:
    return &group->torque[l->axis];
  case MOMENT:
    return &group->moment[l->axis];
  case FREE_MOMENT:
    break;
  }
  return &group->free_moment;
}

static ambulo_status grow(ambulo__force_columns *c, const ambulo__force_group *group) {
  ambulo__force_group *groups =
      ambulo__realloc(&c->allocator, c->groups, (size_t)c->count + 1, sizeof *groups);
  if (!groups) return AMBULO_E_MEMORY;
  c->groups = groups;
  groups[c->count++] = *group;
  return AMBULO_OK;
}

static ambulo_status take_column(ambulo__force_columns *c, int column,
                                 ambulo_diagnostics *diagnostics) {
  const char *const *names = (const char *const *)c->table->names;
  label l;
  ambulo__force_group group = empty_group();
  if (!read_own(names[column], &l) && !read_common(names[column], &l)) return AMBULO_OK;
  name_group(&l, &group);
  int at = 0;
  while (at < c->count && strcasecmp(c->groups[at].name, group.name) != 0) at++;
  if (at == c->count) {
    ambulo_status status = grow(c, &group);
    if (status) return status;
  }
  int *place = place_of(&c->groups[at], &l);
  if (*place >= 0) {
    ambulo__place where = {.file = c->file};
    return ambulo__error(diagnostics, AMBULO_E_SCHEMA, where, NULL,
                         "the columns '%s' and '%s' are the same component of '%s'", names[*place],
                         names[column], c->groups[at].name);
  }
  *place = column;
  return AMBULO_OK;
}

static int has_any(const int columns[3]) {
  return columns[0] >= 0 || columns[1] >= 0 || columns[2] >= 0;
}

/* a column "moment.NAME.x" beside no force of that name is something else */
static void drop_bare_moments(ambulo__force_columns *c) {
  int kept = 0;
  for (int i = 0; i < c->count; i++) {
    const ambulo__force_group *g = &c->groups[i];
    int bare = has_any(g->moment) && !has_any(g->force) && !has_any(g->point) &&
               !has_any(g->torque) && g->free_moment < 0;
    if (!bare) c->groups[kept++] = *g;
  }
  c->count = kept;
}

ambulo_status ambulo__force_columns_find(const ambulo__motion *table, const char *file,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics,
                                         ambulo__force_columns *columns) {
  ambulo__force_columns c = {
      .allocator = ambulo__allocator_or_default(allocator), .table = table, .file = file};
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < table->columns && !status; i++) status = take_column(&c, i, diagnostics);
  drop_bare_moments(&c);
  if (status) {
    ambulo__force_columns_free(&c);
  } else {
    *columns = c;
  }
  return status;
}

void ambulo__force_columns_free(ambulo__force_columns *columns) {
  ambulo__free(&columns->allocator, columns->groups);
  columns->groups = NULL;
  columns->count = 0;
}

static int is_text(const char *text, size_t length, const char *name) {
  return strlen(name) == length && strncasecmp(text, name, length) == 0;
}

int ambulo__force_group_named(const ambulo__force_columns *columns, const char *name,
                              size_t length) {
  int tagged = -1, tags = 0;
  for (int i = 0; i < columns->count; i++) {
    const ambulo__force_group *group = &columns->groups[i];
    if (is_text(name, length, group->name)) return i;
    if (!is_text(name, length, group->tag)) continue;
    tagged = i;
    tags++;
  }
  return tags == 1 && length > 0 ? tagged : -1;
}

/* columns PREFIXx, PREFIXy, PREFIXz, or PREFIX1 .. 3 as OpenSim flattens vectors; their number */
static int find_components(const ambulo__motion *table, const char *prefix, size_t length,
                           int columns[3]) {
  static const char *const endings[] = {"xyz", "123"};
  char name[AMBULO__MOTION_MAX_NAME + 2];
  int found = 0;
  for (int i = 0; i < 3; i++) columns[i] = -1;
  if (length == 0 || length >= sizeof name - 2) return 0;
  for (int way = 0; way < 2 && found == 0; way++) {
    for (int i = 0; i < 3; i++) {
      (void)snprintf(name, sizeof name, "%.*s%c", (int)length, prefix, endings[way][i]);
      columns[i] = ambulo__motion_column(table, name);
      found += columns[i] >= 0;
    }
  }
  return found;
}

ambulo_status ambulo__force_group_add(ambulo__force_columns *c, const char *text, size_t length,
                                      ambulo_diagnostics *diagnostics, int *index) {
  ambulo__force_group group = empty_group();
  ambulo__place place = {.file = c->file};
  int *parts[] = {group.force, group.point, group.torque};
  const char *at = text, *end = text + length;
  for (int i = 0; i < 3 && at <= end; i++) {
    const char *colon = memchr(at, ':', (size_t)(end - at));
    size_t size = (size_t)((colon && i < 2 ? colon : end) - at);
    int found = find_components(c->table, at, size, parts[i]);
    if (found == 0 && (size > 0 || i == 0))
      return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                           "no columns '%.*sx', '%.*sy', '%.*sz'", (int)size, at, (int)size, at,
                           (int)size, at);
    at += size + 1;
  }
  (void)snprintf(group.name, sizeof group.name, "%.*s",
                 length < sizeof group.name ? (int)length : (int)sizeof group.name - 1, text);
  ambulo_status status = grow(c, &group);
  if (!status) *index = c->count - 1;
  return status;
}

/* components that a group of force columns lacks (force_columns.h). */

ambulo_status ambulo__idle_axis(const ambulo_model *model, const ambulo_allocator *allocator,
                                int *axis) {
  static const double world[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const double *left = ambulo_model_left(model);
  ambulo__pose pose = {.model = NULL};
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  int lateral = -1, planar = 1;
  for (int i = 0; i < 3; i++) {
    if (fabs(left[i]) > 1.0 - 1e-9) lateral = i;
  }
  double *q = ambulo__alloc(&own, (size_t)ambulo_model_coordinate_count(model), sizeof *q);
  if (!q) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__pose_create(model, &own, &pose);
  if (!status) {
    /* axes that are all lateral in one pose are so in every pose */
    ambulo__pose_at(&pose, q);
    for (int i = 0; i < ambulo_model_link_count(model); i++) {
      const ambulo_link *link = ambulo_model_link(model, i);
      const double *frame = link->parent < 0 ? world : pose.frames + 12 * (size_t)link->parent;
      double along = fabs(frame[2] * left[0] + frame[6] * left[1] + frame[10] * left[2]);
      if (link->type == AMBULO_REVOLUTE) planar &= along > 1.0 - 1e-9;
      if (link->type == AMBULO_PRISMATIC) planar &= along < 1e-9;
    }
    *axis = planar ? lateral : -1;
    ambulo__pose_free(&pose);
  }
  ambulo__free(&own, q);
  return status;
}

/* how many of the axes in `mask` have no column, and their letters */
static int missing(const int columns[3], int mask, char letters[8]) {
  int count = 0;
  letters[0] = '\0';
  for (int i = 0; i < 3; i++) {
    if (columns[i] >= 0 || !(mask & 1 << i)) continue;
    size_t used = strlen(letters);
    (void)snprintf(letters + used, 8 - used, "%s%c", count ? ", " : "", "xyz"[i]);
    count++;
  }
  return count;
}

/* bit of the axis that points up; 0 if none does */
static int upward(const ambulo_model *model) {
  const double *up = ambulo_model_up(model);
  for (int i = 0; i < 3; i++) {
    if (fabs(up[i]) > 1.0 - 1e-9) return 1 << i;
  }
  return 0;
}

static void check_points(const ambulo__force_group *group, const ambulo_model *model, int mask,
                         const char *file, ambulo__doubts *doubts) {
  ambulo__place place = {.file = file};
  const char *foot = ambulo_model_foot(model, group->foot)->name;
  int up = upward(model) & mask, aside = mask & ~up;
  char letters[8];
  if (group->point[0] < 0 && group->point[1] < 0 && group->point[2] < 0) return;
  if (missing(group->point, up, letters))
    ambulo__note(doubts->diagnostics, place,
                 "'%s' of foot '%s' has no %s of its points; they are taken to be on the ground",
                 group->name, foot, letters);
  if (missing(group->point, aside, letters))
    ambulo__doubt(doubts, file, "a column of zeros says that it is zero",
                  "'%s' of foot '%s' lacks the %s of its points; it is taken as 0", group->name,
                  foot, letters);
}

static ambulo_status check(const ambulo__force_columns *c, const ambulo__force_group *group,
                           const ambulo_model *model, int mask, ambulo__doubts *doubts) {
  ambulo__place place = {.file = c->file};
  const char *foot = ambulo_model_foot(model, group->foot)->name;
  char letters[8];
  int lacking = missing(group->force, mask, letters), all = mask == 7 ? 3 : 2;
  if (lacking == all)
    return ambulo__error(doubts->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "'%s' of foot '%s' has no columns of force", group->name, foot);
  if (lacking > 0)
    ambulo__doubt(doubts, c->file, "a column of zeros says that it is zero",
                  "'%s' of foot '%s' lacks the %s of its force; it is taken as 0", group->name,
                  foot, letters);
  int short_of = missing(group->moment, 7, letters);
  if (short_of == 0) return AMBULO_OK;
  if (short_of < 3)
    ambulo__doubt(doubts, c->file, "its points and its free moment are taken",
                  "'%s' of foot '%s' lacks the %s of its moment; the others are left out",
                  group->name, foot, letters);
  check_points(group, model, mask, c->file, doubts);
  if (group->free_moment < 0 && missing(group->torque, 7, letters) == 3)
    ambulo__note(doubts->diagnostics, place,
                 "'%s' of foot '%s' has no torques; its free moment is taken as 0", group->name,
                 foot);
  return AMBULO_OK;
}

ambulo_status ambulo__force_columns_complete(const ambulo__force_columns *columns,
                                             const ambulo_model *model, ambulo__doubts *doubts) {
  int idle = -1;
  ambulo_status status = ambulo__idle_axis(model, &columns->allocator, &idle);
  int mask = idle < 0 ? 7 : 7 & ~(1 << idle);
  for (int i = 0; i < columns->count && !status; i++) {
    if (columns->groups[i].foot >= 0)
      status = check(columns, &columns->groups[i], model, mask, doubts);
  }
  return status;
}
