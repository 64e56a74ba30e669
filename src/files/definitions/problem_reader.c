/* definitions/problem_reader.c - what sections of a problem file are read with: memory, file names,
 * members of structures by their tables (problem/members.h), lists, names of the model. */
#include "definitions/problem_reader.h"

#include "formats/paths.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* A block is a header in this list, then the memory handed out. */
struct ambulo__reader_block {
  ambulo__reader_block *next;
  max_align_t memory[];
};

void *ambulo__reader_alloc(ambulo__problem_reader *reader, size_t count, size_t size) {
  size_t bytes = count * size;
  int overflows = size != 0 && bytes / size != count;
  ambulo__reader_block *block = overflows || bytes > SIZE_MAX - sizeof *block
                                    ? NULL
                                    : ambulo__alloc(&reader->allocator, 1, sizeof *block + bytes);
  if (!block) {
    reader->failure = AMBULO_E_MEMORY;
    if (reader->document) ambulo__yaml_out_of_memory(reader->document);
    return NULL;
  }
  block->next = reader->blocks;
  reader->blocks = block;
  return block->memory;
}

static const char *copy_text(ambulo__problem_reader *reader, const char *text) {
  size_t size = strlen(text) + 1;
  char *copy = ambulo__reader_alloc(reader, size, 1);
  if (copy) memcpy(copy, text, size);
  return copy;
}

static const char *beside(ambulo__problem_reader *reader, const char *name) {
  size_t directory = strlen(reader->directory), length = strlen(name);
  if (name[0] == '/' || directory == 0) return name;
  int slash = reader->directory[directory - 1] != '/';
  char *path = ambulo__reader_alloc(reader, directory + (size_t)slash + length + 1, 1);
  if (!path) return NULL;
  memcpy(path, reader->directory, directory);
  if (slash) path[directory] = '/';
  memcpy(path + directory + slash, name, length);
  return path;
}

const char *ambulo__reader_path(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                const char *name) {
  const char *path = beside(reader, name);
  char *shipped = NULL;
  if (!path) return NULL;
  if (ambulo__shipped_path(&reader->allocator, path, name, &shipped)) {
    reader->failure = AMBULO_E_MEMORY;
    return NULL;
  }
  /* what is away for a moment is missed, and no other is taken for it */
  int is_other =
      shipped && reader->inputs.expected && !ambulo__inputs_find(reader->inputs.expected, shipped);
  if (is_other) ambulo__free(&reader->allocator, shipped);
  if (!shipped || is_other) return path;
  ambulo__note_shipped(reader->diagnostics, ambulo__yaml_place(node), name, shipped);
  path = copy_text(reader, shipped);
  ambulo__free(&reader->allocator, shipped);
  return path;
}

void ambulo__reader_clear(ambulo__problem_reader *reader) {
  ambulo__reader_block *block = reader->blocks;
  while (block) {
    ambulo__reader_block *next = block->next;
    ambulo__free(&reader->allocator, block);
    block = next;
  }
  reader->blocks = NULL;
  ambulo_muscles_free(reader->muscles);
  reader->muscles = NULL;
  ambulo_model_free(reader->model);
  reader->model = NULL;
  ambulo__text_free(&reader->inputs.read);
}

const ambulo__yaml_node *ambulo__reader_section(const ambulo__yaml_node *root, const char *key) {
  const ambulo__yaml_node *node = ambulo__yaml_get(root, key);
  if (!node || ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) return node;
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "'%s' is not a mapping; expected keys",
                           key);
  return NULL;
}

/* ------------------------------------------------------------------------ numbers */

double ambulo__read_plain_angle(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                double fallback) {
  if (!node) return fallback;
  if (reader->radians == 0.0) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "an angle, but the file does not state its unit; expected 'angles: "
                             "degrees' or 'angles: radians'");
    return fallback;
  }
  return reader->radians * ambulo__yaml_number(node, 0.0);
}

double ambulo__read_coordinate_value(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                     int i) {
  const ambulo_coordinate *c = ambulo_model_coordinate(reader->model, i);
  double value = ambulo__yaml_number(node, 0.0);
  if (c->type != AMBULO_REVOLUTE) return value;
  if (reader->radians == 0.0) {
    if (!reader->asked_for_unit) {
      (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                               "'%s' is an angle, but the file does not state its unit; expected "
                               "'angles: degrees' or 'angles: radians'",
                               c->name);
    }
    reader->asked_for_unit = 1;
    return 0.0;
  }
  if (reader->radians == 1.0 && fabs(value) > 6.2832) {
    ambulo__yaml_warning(node, "write 'angles: degrees' if these are degrees",
                         "%g for '%s' is more than a whole turn in radians", value, c->name);
  }
  return reader->radians * value;
}

/* a number, or the word `off` */
static double read_bound(const ambulo__yaml_node *node, const ambulo__member *m, double fallback) {
  static const char *const words[] = {"off"};
  const char *text = ambulo__yaml_text(node);
  if (!text[0]) return fallback;
  if (text[0] != 'o') return ambulo__yaml_number_in(node, m->low, m->high, fallback);
  (void)ambulo__yaml_choice(node, words, 1, 0);
  return AMBULO_OFF;
}

static void read_row(const ambulo__yaml_node *node, const ambulo__member *m, double *values) {
  double read[8] = {0.0};
  const char *unit = ambulo__quantity_unit(m->quantity), *blank = unit[0] ? " " : "";
  if (!node || m->count > 8) return;
  memcpy(read, values, (size_t)m->count * sizeof *values);
  if (!ambulo__yaml_numbers_over(node, m->count, read)) return;
  for (int k = 0; k < m->count; k++) {
    if (read[k] >= m->low && read[k] <= m->high) continue;
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "%g; expected %g to %g", read[k], m->low,
                             m->high);
    return;
  }
  if (m->flags & AMBULO__RISING && !(read[0] < read[1])) {
    (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL, "[%g, %g]%s%s; expected lower < upper",
                             read[0], read[1], blank, unit);
    return;
  }
  memcpy(values, read, (size_t)m->count * sizeof *values);
}

/* ------------------------------------------------------------------------ members */

static int read_integer(const ambulo__yaml_node *node, const ambulo__member *m, int value) {
  if (m->type == AMBULO__FLAG && m->words)
    return ambulo__yaml_choice(node, m->words, m->word_count, value) % 2;
  if (m->type == AMBULO__FLAG) return ambulo__yaml_boolean(node, value);
  if (m->type == AMBULO__INTEGER)
    return ambulo__yaml_integer(node, (int)m->low, (int)m->high, value);
  return m->first_word + ambulo__yaml_choice(node, m->words, m->word_count, value - m->first_word);
}

static void read_member(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                        const ambulo__member *m, void *at) {
  double *number = at;
  const char **text = at;
  switch (m->type) {
  case AMBULO__NUMBER:
    if (m->count > 1)
      read_row(node, m, number);
    else if (m->flags & AMBULO__MAY_BE_OFF)
      *number = read_bound(node, m, *number);
    else
      *number = ambulo__yaml_number_in(node, m->low, m->high, *number);
    break;
  case AMBULO__FILE_ANGLE:
    *number = ambulo__read_plain_angle(reader, node, *number);
    break;
  case AMBULO__INTEGER:
  case AMBULO__FLAG:
  case AMBULO__CHOICE:
    *(int *)at = read_integer(node, m, *(int *)at);
    break;
  case AMBULO__TEXT:
    *text = ambulo__yaml_name(node);
    break;
  case AMBULO__INDEX:
  case AMBULO__NUMBER_ARRAY:
  case AMBULO__INDEX_ARRAY:
  case AMBULO__ITEMS:
  case AMBULO__PART:
  case AMBULO__BORROWED:
    break;
  }
}

void ambulo__read_members(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                          const ambulo__structure *structure, const char *prefix, void *item) {
  size_t length = strlen(prefix);
  for (int i = 0; i < structure->count; i++) {
    const ambulo__member *m = &structure->members[i];
    if (!m->key || m->flags & AMBULO__READ_APART || m->type > AMBULO__TEXT) continue;
    const char *key = m->key + length;
    if (strncmp(m->key, prefix, length) != 0 || strchr(key, '.')) continue;
    const ambulo__yaml_node *value =
        m->flags & AMBULO__REQUIRED ? ambulo__yaml_require(node, key) : ambulo__yaml_get(node, key);
    read_member(reader, value, m, (char *)item + m->at);
  }
}

void ambulo__read_member(ambulo__problem_reader *reader, const ambulo__yaml_node *value,
                         const ambulo__structure *structure, const char *key, void *item) {
  for (int i = 0; i < structure->count; i++) {
    const ambulo__member *m = &structure->members[i];
    if (m->key && strcmp(m->key, key) == 0) read_member(reader, value, m, (char *)item + m->at);
  }
}

/* "name, center, half_size" */
static void list_keys(const ambulo__structure *structure, char *text, size_t size) {
  text[0] = '\0';
  for (int i = 0; i < structure->count; i++) {
    const char *key = structure->members[i].key;
    size_t used = strlen(text);
    if (key && !strchr(key, '.'))
      (void)snprintf(text + used, size - used, "%s%s", used ? ", " : "", key);
  }
}

void *ambulo__read_items(ambulo__problem_reader *reader, const ambulo__yaml_node *list,
                         const ambulo__structure *structure, int least, int most,
                         ambulo__item_reader *read, int *count) {
  const char *point = strrchr(structure->key, '.'), *name = point ? point + 1 : structure->key;
  *count = 0;
  if (!list) return NULL;
  if (!ambulo__yaml_is(list, AMBULO__YAML_SEQUENCE)) {
    char keys[240];
    list_keys(structure, keys, sizeof keys);
    (void)ambulo__yaml_error(list, AMBULO_E_SCHEMA, NULL,
                             "'%s' is not a list; expected a list of {%s}", name, keys);
    return NULL;
  }
  int given = ambulo__yaml_items(list);
  if (given < least || given > most) {
    (void)ambulo__yaml_error(list, given > most ? AMBULO_E_LIMIT : AMBULO_E_SCHEMA, NULL,
                             "%d %s; expected %d to %d", given, name, least, most);
    return NULL;
  }
  char *items = ambulo__reader_alloc(reader, (size_t)given, structure->size);
  for (int i = 0; items && i < given; i++) {
    void *item = items + (size_t)i * structure->size;
    ambulo__members_fill(structure, item);
    read(reader, ambulo__yaml_item(list, i), item);
  }
  *count = items ? given : 0;
  return items;
}

/* -------------------------------------------------------------------------- names */

static const char *name_of(const ambulo_model *m, ambulo__named kind, int i) {
  switch (kind) {
  case AMBULO__NAMED_LINK:
    return m->links[i].name;
  case AMBULO__NAMED_COORDINATE:
    return m->coordinates[i].name;
  case AMBULO__NAMED_POINT:
    return m->points[i].name;
  case AMBULO__NAMED_FOOT:
    return m->feet[i].name;
  case AMBULO__NAMED_CAPSULE:
    return m->capsules[i].name;
  }
  return "";
}

int ambulo__read_name_of(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                         ambulo__named kind) {
  return ambulo__find_name_of(reader, node, ambulo__yaml_name(node), kind);
}

int ambulo__find_name_of(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                         const char *name, ambulo__named kind) {
  static const char *const words[] = {"link", "coordinate", "point", "foot", "capsule"};
  const ambulo_model *m = reader->model;
  const int counts[] = {m->link_count, m->coordinate_count, m->point_count, m->foot_count,
                        m->capsule_count};
  const char *what = words[kind];
  size_t count = (size_t)counts[kind];
  if (!name[0]) return -1;
  const char **names = ambulo__reader_alloc(reader, count, sizeof *names);
  if (!names) return -1;
  for (size_t i = 0; i < count; i++) {
    names[i] = name_of(m, kind, (int)i);
    if (strcmp(names[i], name) == 0) return (int)i;
  }
  char hint[100];
  const char *nearest = ambulo__nearest(name, names, count);
  if (nearest)
    (void)snprintf(hint, sizeof hint, "did you mean '%s'?", nearest);
  else
    (void)snprintf(hint, sizeof hint, "'ambulo info' of the model lists its %ss", what);
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, hint,
                           "unknown %s (got '%s'); expected a %s of the model%s", what, name, what,
                           count ? "" : ", which has none");
  return -1;
}
