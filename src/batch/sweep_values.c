/* batch/sweep_values.c - what an axis takes: lists, ranges, samples.
 *
 * Samples come from a generator of our own, so that a seed means the same everywhere: a 64-bit
 * linear congruential generator (Knuth, The Art of Computer Programming 2, 3.3.4; constants of
 * MMIX), its upper 53 bits as a fraction. Latin hypercube: every axis is cut into as many equal
 * strata as there are samples, each used once, in an order shuffled by axis (McKay, Beckman &
 * Conover, Technometrics 21, 1979). */
#include "base/file_steps.h"
#include "base/numtext.h"
#include "base/read_file.h"
#include "batch/paths.h"
#include "batch/sweep.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_VALUES = 1000000, MOST_FILE_BYTES = 16 << 20 };

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

/* *hash of the regular file that a value names, seen from the base problem; 0: no such file */
static ambulo_status hash_named_file(const ambulo_sweep *sweep, const char *name,
                                     unsigned long long *hash) {
  double number;
  *hash = 0;
  if (!name[0] || ambulo__parse_double(name, strlen(name), &number)) return AMBULO_OK;
  const char *base = sweep->base ? sweep->base : sweep->path;
  char *path = ambulo__sibling_path(&sweep->allocator, base, name), *text = NULL;
  size_t length = 0;
  int yes = 0;
  ambulo_status status = path ? is_file(sweep, path, &yes) : AMBULO_E_MEMORY;
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
  if (axis->count == MOST_VALUES)
    return ambulo__error(sweep->diagnostics, AMBULO_E_LIMIT, ambulo__spot_place(sweep, spot), NULL,
                         "more than %d values of '%s'; expected at most %d", MOST_VALUES,
                         axis->name, MOST_VALUES);
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
  return hash_named_file(sweep, copy + key + 1, &value->file);
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

/* [first, last, step], both ends included where a step lands on them */
static ambulo_status add_range(ambulo_sweep *sweep, ambulo__axis *axis,
                               const ambulo__yaml_node *node) {
  double r[3];
  if (!ambulo__yaml_numbers(node, 3, r)) return AMBULO_E_SCHEMA;
  double steps = floor((r[1] - r[0]) / r[2] + 1e-9);
  if (r[2] == 0.0 || !(steps >= 0.0) || steps > MOST_VALUES)
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                              "range [%g, %g, %g] has no values; expected [first, last, step]",
                              r[0], r[1], r[2]);
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i <= (int)steps && !status; i++) {
    /* rounded to what a person would have written: 0.8 + 2 * 0.1 is 1 */
    double value = r[0] + i * r[2];
    status =
        ambulo__axis_add_number(sweep, axis, round(value * 1e12) / 1e12, ambulo__spot_of(node));
  }
  return status;
}

static ambulo_status add_linspace(ambulo_sweep *sweep, ambulo__axis *axis,
                                  const ambulo__yaml_node *node) {
  double r[3];
  if (!ambulo__yaml_numbers(node, 3, r)) return AMBULO_E_SCHEMA;
  int count = r[2] >= 1.0 && r[2] <= MOST_VALUES ? (int)r[2] : 0;
  if (count < 1 || (double)count != r[2])
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                              "linspace asks for %g values; expected [first, last, count]", r[2]);
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < count && !status; i++) {
    double fraction = count > 1 ? (double)i / (count - 1) : 0.0;
    status = ambulo__axis_add_number(sweep, axis, r[0] + fraction * (r[1] - r[0]),
                                     ambulo__spot_of(node));
  }
  return status;
}

static ambulo_status add_list(ambulo_sweep *sweep, ambulo__axis *axis,
                              const ambulo__yaml_node *node) {
  int list = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE);
  int count = list ? ambulo__yaml_items(node) : 0;
  if (count < 1)
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                              "'values' of '%s' %s; expected a list of one or more values",
                              axis->name, list ? "is empty" : "is not a list");
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < count && !status; i++)
    status = ambulo__axis_add_node(sweep, axis, ambulo__yaml_item(node, i));
  return status;
}

ambulo_status ambulo__sweep_read_values(ambulo_sweep *sweep, ambulo__axis *axis,
                                        const ambulo__yaml_node *node) {
  const ambulo__yaml_node *values = ambulo__yaml_get(node, "values");
  const ambulo__yaml_node *range = ambulo__yaml_get(node, "range");
  const ambulo__yaml_node *linspace = ambulo__yaml_get(node, "linspace");
  if ((values != NULL) + (range != NULL) + (linspace != NULL) != 1)
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                              "axis '%s' needs one of 'values', 'range', 'linspace'", axis->name);
  if (values) return add_list(sweep, axis, values);
  return range ? add_range(sweep, axis, range) : add_linspace(sweep, axis, linspace);
}

/* ----------------------------------------------------------------- samples */

typedef unsigned long long generator;

static double fraction(generator *g) {
  *g = *g * 6364136223846793005ULL + 1442695040888963407ULL;
  return (double)(*g >> 11) / 9007199254740992.0;
}

static ambulo_status sample_axis(ambulo_sweep *sweep, const ambulo__yaml_node *node, int samples,
                                 int latin, generator *g) {
  const ambulo__yaml_node *key = ambulo__yaml_require(node, "key");
  const char *name = ambulo__yaml_text(ambulo__yaml_get(node, "name"));
  int whole = ambulo__yaml_boolean(ambulo__yaml_get(node, "whole"), 0);
  double range[2];
  ambulo__axis *axis = NULL;
  const char *path = ambulo__yaml_text(key);
  if (!ambulo__yaml_numbers(ambulo__yaml_require(node, "range"), 2, range) ||
      !ambulo__yaml_is(key, AMBULO__YAML_SCALAR))
    return AMBULO_E_SCHEMA;
  ambulo_status status = ambulo__sweep_add_axis(sweep, name, path, ambulo__spot_of(key), &axis);
  if (status || !axis) return status;
  status = ambulo__sweep_read_label(sweep, axis, node);
  int *order = ambulo__alloc(&sweep->allocator, (size_t)samples, sizeof *order);
  if (!order) return AMBULO_E_MEMORY;
  for (int i = 0; i < samples; i++) order[i] = i;
  for (int i = samples - 1; latin && i > 0; i--) {
    int j = (int)(fraction(g) * (i + 1)), kept = order[i];
    order[i] = order[j];
    order[j] = kept;
  }
  for (int i = 0; i < samples && !status; i++) {
    double u = fraction(g), place = latin ? (order[i] + u) / samples : u;
    double value = range[0] + place * (range[1] - range[0] + whole);
    if (whole) value = fmin(floor(value), range[1]);
    status = ambulo__axis_add_number(sweep, axis, value, ambulo__spot_of(key));
  }
  ambulo__free(&sweep->allocator, order);
  return ambulo__sweep_close(node, status);
}

ambulo_status ambulo__sweep_read_samples(ambulo_sweep *sweep, const ambulo__yaml_node *node,
                                         int latin) {
  int samples = ambulo__yaml_integer(ambulo__yaml_require(node, "samples"), 1, MOST_VALUES, 1);
  int seed = ambulo__yaml_integer(ambulo__yaml_require(node, "seed"), 0, 2000000000, 0);
  const ambulo__yaml_node *axes = ambulo__yaml_require(node, "axes");
  ambulo__axis_group *group = &sweep->group[sweep->groups];
  group->first = sweep->axes;
  group->count = samples;
  generator g = (generator)seed * 2862933555777941757ULL + 3037000493ULL;
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < ambulo__yaml_items(axes) && !status; i++)
    status = sample_axis(sweep, ambulo__yaml_item(axes, i), samples, latin, &g);
  group->axes = sweep->axes - group->first;
  if (!status && axes && group->axes == 0)
    status = ambulo__yaml_error(axes, AMBULO_E_SCHEMA, NULL, "no axis; expected at least one");
  if (group->axes > 0) sweep->groups++;
  return ambulo__sweep_close(node, status);
}
