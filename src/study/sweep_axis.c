/* study/sweep_axis.c - axes of a sweep: found, added, given one value after the other. */
#include "formats/file_steps.h"
#include "base/numtext.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "formats/text_hash.h"
#include "study/sweep.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_FILE_BYTES = 16 << 20 };

ambulo__spot ambulo__spot_of(const ambulo__yaml_node *node) {
  ambulo__place place = ambulo__yaml_place(node);
  return (ambulo__spot){place.line, place.column, 0};
}

ambulo__place ambulo__spot_place(const ambulo_sweep *sweep, ambulo__spot spot) {
  return (ambulo__place){spot.in_table ? sweep->table : sweep->path, spot.line, spot.column, NULL};
}

ambulo_status ambulo__sweep_add_axis(ambulo_sweep *sweep, const char *name, const char *key,
                                     ambulo__spot spot, ambulo__axis **axis) {
  ambulo__place place = ambulo__spot_place(sweep, spot);
  if (!key[0] || strchr(key, '='))
    return ambulo__error(sweep->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "no key that can be set (got '%.60s'); expected a path such as "
                         "time.duration",
                         key);
  if (sweep->axes == AMBULO__SWEEP_AXES)
    return ambulo__error(sweep->diagnostics, AMBULO_E_LIMIT, place, NULL,
                         "more than %d axes; expected at most %d", AMBULO__SWEEP_AXES,
                         AMBULO__SWEEP_AXES);
  ambulo__axis *made = &sweep->axis[sweep->axes++];
  made->key = ambulo__strdup(&sweep->allocator, key);
  made->name = ambulo__strdup(&sweep->allocator, name[0] ? name : key);
  made->spot = spot;
  *axis = made;
  return made->key && made->name ? AMBULO_OK : AMBULO_E_MEMORY;
}

int ambulo__sweep_find_axis(const ambulo_sweep *sweep, const char *name) {
  for (int i = 0; i < sweep->axes; i++)
    if (strcmp(sweep->axis[i].name, name) == 0) return i;
  return -1;
}

/* A value is a word, a number, a name of a file, or whatever else. *yes: a file of this name is
 * there. That nobody can tell is an error: another key would be computed. */
static ambulo_status is_file(const ambulo_sweep *sweep, const char *path, int *yes) {
  struct stat entry;
  *yes = 0;
  if (stat(path, &entry) == 0) {
    *yes = S_ISREG(entry.st_mode) && entry.st_size <= MOST_FILE_BYTES;
    return AMBULO_OK;
  }
  int none = errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG || errno == ELOOP;
  return none ? AMBULO_OK : ambulo__io_error(sweep->diagnostics, path, "inspect");
}

/* as the reader of problems finds it, without a word: it may be no file at all */
static ambulo_status path_of_value(const ambulo_sweep *sweep, const char *base, const char *name,
                                   char **path) {
  const ambulo__place nowhere = {NULL, 0, 0, NULL};
  return ambulo__named_file(&sweep->allocator, base, name, nowhere, NULL, path);
}

ambulo_status ambulo__sweep_hash_value(const ambulo_sweep *sweep, const char *name,
                                       unsigned long long *hash) {
  double number;
  *hash = 0;
  if (!name[0] || ambulo__parse_double(name, strlen(name), &number)) return AMBULO_OK;
  const char *base = sweep->base ? sweep->base : sweep->path;
  char *path = NULL, *text = NULL;
  size_t length = 0;
  int yes = 0;
  ambulo_status status = path_of_value(sweep, base, name, &path);
  if (!status) status = is_file(sweep, path, &yes);
  if (yes) {
    status = ambulo__read_file(path, MOST_FILE_BYTES, &sweep->allocator, sweep->diagnostics, &text,
                               &length);
    if (!status) *hash = ambulo__hash_text(AMBULO__HASH_START, text);
  }
  ambulo__free(&sweep->allocator, text);
  ambulo__free(&sweep->allocator, path);
  return status;
}

static ambulo_status grow(const ambulo_sweep *sweep, ambulo__axis *axis, ambulo__spot spot) {
  const ambulo_allocator *a = &sweep->allocator;
  if (axis->count == AMBULO__AXIS_VALUES)
    return ambulo__error(sweep->diagnostics, AMBULO_E_LIMIT, ambulo__spot_place(sweep, spot), NULL,
                         "more than %d values of '%s'; expected at most %d", AMBULO__AXIS_VALUES,
                         axis->name, AMBULO__AXIS_VALUES);
  if (axis->count < axis->capacity) return AMBULO_OK;
  int capacity = axis->capacity ? 2 * axis->capacity : 8;
  ambulo__axis_value *value = ambulo__realloc(a, axis->value, (size_t)capacity, sizeof *value);
  if (!value) return AMBULO_E_MEMORY;
  axis->value = value;
  axis->capacity = capacity;
  return AMBULO_OK;
}

ambulo_status ambulo__axis_add_text(ambulo_sweep *sweep, ambulo__axis *axis, const char *text,
                                    size_t length, ambulo__spot spot) {
  ambulo_status status = grow(sweep, axis, spot);
  if (status) return status;
  size_t key = strlen(axis->key);
  char *copy = ambulo__alloc(&sweep->allocator, key + length + 2, 1);
  if (!copy) return AMBULO_E_MEMORY;
  memcpy(copy, axis->key, key);
  copy[key] = '=';
  memcpy(copy + key + 1, text, length);
  ambulo__axis_value *value = &axis->value[axis->count++];
  *value = (ambulo__axis_value){copy, 0, spot};
  return ambulo__sweep_hash_value(sweep, copy + key + 1, &value->file);
}

const char *ambulo__axis_text(const ambulo__axis *axis, int value) {
  return axis->value[value].override + strlen(axis->key) + 1;
}

ambulo_status ambulo__axis_add_number(ambulo_sweep *sweep, ambulo__axis *axis, double value,
                                      ambulo__spot spot) {
  char text[AMBULO__NUMTEXT_SIZE];
  size_t length = ambulo__print_double(text, value);
  return ambulo__axis_add_text(sweep, axis, text, length, spot);
}

ambulo_status ambulo__axis_add_node(ambulo_sweep *sweep, ambulo__axis *axis,
                                    const ambulo__yaml_node *node) {
  if (!ambulo__yaml_is(node, AMBULO__YAML_SCALAR))
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, "lists stand in quotes: \"[12, 24]\"",
                              "a value of '%s' is a list or a mapping; expected a text",
                              axis->name);
  const char *text = ambulo__yaml_text(node);
  return text[0] ? ambulo__axis_add_text(sweep, axis, text, strlen(text), ambulo__spot_of(node))
                 : ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "no value of '%s'; expected one",
                                      axis->name);
}
