/* study/sweep_axes.c - axes of a sweep file: lists, ranges, samples, tables.
 *
 * Samples come from a generator of our own, so that a seed means the same everywhere: a 64-bit
 * linear congruential generator (Knuth, The Art of Computer Programming 2, 3.3.4; constants of
 * MMIX), its upper 53 bits as a fraction. Latin hypercube: every axis is cut into as many equal
 * strata as there are samples, each used once, in an order shuffled by axis (McKay, Beckman &
 * Conover, Technometrics 21, 1979). */
#include "base/numtext.h"
#include "formats/atomic_file.h"
#include "formats/foreign_format.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "formats/sheet.h"
#include "study/study.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_TABLE_BYTES = 64 << 20 };

ambulo__spot ambulo__spot_of(const ambulo__yaml_node *node) {
  ambulo__place place = ambulo__yaml_place(node);
  return (ambulo__spot){place.line, place.column, 0};
}

ambulo__place ambulo__spot_place(const ambulo_sweep *s, ambulo__spot spot) {
  return (ambulo__place){spot.in_table ? s->table : s->path, spot.line, spot.column, NULL};
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

/* number k of an axis, as the file has it; 0: a word */
static int number_of(const ambulo__axis *axis, int k, double *number) {
  const char *text = strchr(axis->value[k].override, '=') + 1;
  return ambulo__parse_double(text, strlen(text), number);
}

/* numbers that only rise, or only fall */
static int is_ordered(const ambulo__axis *axis) {
  double before = 0.0, next = 0.0;
  int rising = 0, falling = 0;
  for (int k = 0; k < axis->count; k++) {
    if (!number_of(axis, k, &next)) return 0;
    rising += k > 0 && next > before;
    falling += k > 0 && next < before;
    before = next;
  }
  return axis->count > 1 && (rising == axis->count - 1 || falling == axis->count - 1);
}

int ambulo__sweep_find_chain(const ambulo_sweep *s) {
  int found = -1;
  for (int i = 0; i < s->axes; i++)
    if (is_ordered(&s->axis[i]) && (found < 0 || s->axis[i].count >= s->axis[found].count))
      found = i;
  return found;
}

static ambulo_status make_room(const ambulo_sweep *sweep, ambulo__axis *axis, ambulo__spot spot) {
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

static ambulo_status add_text(ambulo_sweep *sweep, ambulo__axis *axis, const char *text,
                              size_t length, ambulo__spot spot) {
  ambulo_status status = make_room(sweep, axis, spot);
  if (status) return status;
  size_t key = strlen(axis->key);
  char *copy = ambulo__alloc(&sweep->allocator, key + length + 2, 1);
  if (!copy) return AMBULO_E_MEMORY;
  memcpy(copy, axis->key, key);
  copy[key] = '=';
  memcpy(copy + key + 1, text, length);
  ambulo__axis_value *value = &axis->value[axis->count++];
  *value = (ambulo__axis_value){.override = copy, .spot = spot};
  return ambulo__sweep_hash_value(sweep, copy + key + 1, &value->file);
}

const char *ambulo__axis_text(const ambulo__axis *axis, int value) {
  return axis->value[value].override + strlen(axis->key) + 1;
}

static ambulo_status add_number(ambulo_sweep *sweep, ambulo__axis *axis, double value,
                                ambulo__spot spot) {
  const ambulo__number number = ambulo__number_text(value);
  return add_text(sweep, axis, number.text, strlen(number.text), spot);
}

ambulo_status ambulo__axis_add_node(ambulo_sweep *sweep, ambulo__axis *axis,
                                    const ambulo__yaml_node *node) {
  if (!ambulo__yaml_is(node, AMBULO__YAML_SCALAR))
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, "lists stand in quotes: \"[12, 24]\"",
                              "a value of '%s' is a list or a mapping; expected a text",
                              axis->name);
  const char *text = ambulo__yaml_text(node);
  return text[0] ? add_text(sweep, axis, text, strlen(text), ambulo__spot_of(node))
                 : ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL, "no value of '%s'; expected one",
                                      axis->name);
}

/* [first, last, step], both ends included where a step lands on them, or [first, last, count] */
static ambulo_status add_range(ambulo_sweep *sweep, ambulo__axis *axis,
                               const ambulo__yaml_node *node, int by_count) {
  double r[3];
  if (!ambulo__yaml_numbers(node, 3, r)) return AMBULO_E_SCHEMA;
  double count = by_count ? r[2] : floor((r[1] - r[0]) / r[2] + 1e-9) + 1.0;
  if (!(count >= 1.0 && count <= AMBULO__AXIS_VALUES) || count != floor(count))
    return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                              "[%g, %g, %g] has no values; expected [first, last, %s]", r[0], r[1],
                              r[2], by_count ? "count" : "step");
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < (int)count && !status; i++) {
    double fraction = count > 1.0 ? i / (count - 1.0) : 0.0;
    double value = by_count ? r[0] + fraction * (r[1] - r[0]) : r[0] + i * r[2];
    /* rounded to what a person would have written: 0.8 + 2 * 0.1 is 1 */
    if (!by_count) value = round(value * 1e12) / 1e12;
    status = add_number(sweep, axis, value, ambulo__spot_of(node));
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

/* key, name, label and unit of an axis */
static ambulo_status read_head(ambulo_sweep *sweep, const ambulo__yaml_node *node,
                               ambulo__axis **axis) {
  const ambulo__yaml_node *key = ambulo__yaml_require(node, "key");
  const char *name = ambulo__yaml_text(ambulo__yaml_get(node, "name"));
  const char *path = ambulo__yaml_text(key);
  if (!ambulo__yaml_is(key, AMBULO__YAML_SCALAR)) return AMBULO_E_SCHEMA;
  ambulo_status status = ambulo__sweep_add_axis(sweep, name, path, ambulo__spot_of(key), axis);
  if (status || !*axis) return status;
  status = ambulo__sweep_copy(sweep, ambulo__yaml_get(node, "label"), &(*axis)->label);
  if (!status) status = ambulo__sweep_copy(sweep, ambulo__yaml_get(node, "unit"), &(*axis)->unit);
  return status;
}

static ambulo_status read_axis(ambulo_sweep *sweep, const ambulo__yaml_node *node) {
  ambulo__axis *axis = NULL;
  ambulo_status status = read_head(sweep, node, &axis);
  if (status || !axis) return status;
  const ambulo__yaml_node *values = ambulo__yaml_get(node, "values");
  const ambulo__yaml_node *range = ambulo__yaml_get(node, "range");
  const ambulo__yaml_node *linspace = ambulo__yaml_get(node, "linspace");
  if ((values != NULL) + (range != NULL) + (linspace != NULL) != 1)
    status = ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                                "axis '%s' needs one of 'values', 'range', 'linspace'", axis->name);
  else
    status = values ? add_list(sweep, axis, values)
                    : add_range(sweep, axis, range ? range : linspace, linspace != NULL);
  return ambulo__sweep_close(node, status);
}

/* one group an axis, or one for all */
static ambulo_status group_axes(ambulo_sweep *s, const ambulo__yaml_node *node, int zip) {
  for (int i = 0; i < s->axes; i++) {
    if (zip && i > 0) {
      if (s->axis[i].count != s->axis[0].count)
        return ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                                  "combine: zip needs axes of one length; '%s' has %d values, "
                                  "'%s' has %d",
                                  s->axis[i].name, s->axis[i].count, s->axis[0].name,
                                  s->axis[0].count);
      s->group[0].axes++;
      continue;
    }
    ambulo__axis_group group = {i, 1, s->axis[i].count};
    s->group[s->groups++] = group;
  }
  s->zipped = zip ? s->axes : 0;
  return AMBULO_OK;
}

/* ----------------------------------------------------------------- samples */

typedef unsigned long long generator;

static double fraction(generator *g) {
  *g = *g * 6364136223846793005ULL + 1442695040888963407ULL;
  return (double)(*g >> 11) / 9007199254740992.0;
}

static ambulo_status sample_axis(ambulo_sweep *sweep, const ambulo__yaml_node *node, int samples,
                                 int latin, generator *g) {
  int whole = ambulo__yaml_boolean(ambulo__yaml_get(node, "whole"), 0);
  double range[2];
  ambulo__axis *axis = NULL;
  if (!ambulo__yaml_numbers(ambulo__yaml_require(node, "range"), 2, range)) return AMBULO_E_SCHEMA;
  ambulo_status status = read_head(sweep, node, &axis);
  if (status || !axis) return status;
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
    status = add_number(sweep, axis, value, axis->spot);
  }
  ambulo__free(&sweep->allocator, order);
  return ambulo__sweep_close(node, status);
}

static ambulo_status read_samples(ambulo_sweep *sweep, const ambulo__yaml_node *node, int latin) {
  int samples =
      ambulo__yaml_integer(ambulo__yaml_require(node, "samples"), 1, AMBULO__AXIS_VALUES, 1);
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

/* ------------------------------------------------------------------- tables */

static ambulo_status fault(const ambulo_sweep *s, ambulo__spot spot, const char *what) {
  return ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, ambulo__spot_place(s, spot), NULL, "%s",
                       what);
}

static ambulo_status add_columns(ambulo_sweep *s, ambulo__axis_group *group,
                                 const ambulo__table_line *line) {
  ambulo__table_cell cell;
  size_t position = 0;
  while (ambulo__table_next_cell(line, AMBULO__CELLS_COMMA, &position, &cell)) {
    char key[AMBULO__SWEEP_TEXT];
    ambulo__spot spot = {line->number, cell.column, 1};
    ambulo__axis *axis;
    if (cell.length == 0 || cell.length >= sizeof key)
      return fault(s, spot, "a column has no name; expected a key of the problem");
    memcpy(key, cell.start, cell.length);
    key[cell.length] = '\0';
    ambulo_status status = ambulo__sweep_add_axis(s, "", key, spot, &axis);
    if (status) return status;
    group->axes++;
  }
  return AMBULO_OK;
}

/* a column holds numbers or words, as its first cell does */
static ambulo_status check_cell(const ambulo_sweep *s, const ambulo__axis *axis,
                                const ambulo__table_cell *cell, ambulo__spot spot) {
  double number;
  if (cell->length == 0) return fault(s, spot, "the cell is empty; expected a value");
  if (axis->count == 0) return AMBULO_OK;
  const char *first = ambulo__axis_text(axis, 0);
  int numbers = ambulo__parse_double(first, strlen(first), &number);
  if (numbers == ambulo__parse_double(cell->start, cell->length, &number)) return AMBULO_OK;
  return ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, ambulo__spot_place(s, spot), NULL,
                       "got '%.*s' in column '%s', which begins with '%s' in line %d; expected %s",
                       cell->length < 40 ? (int)cell->length : 40, cell->start, axis->key, first,
                       axis->value[0].spot.line, numbers ? "a number" : "a word");
}

static ambulo_status add_row(ambulo_sweep *s, ambulo__axis_group *group,
                             const ambulo__table_line *line) {
  ambulo__table_cell cell;
  size_t position = 0;
  int column = 0, cells = ambulo__table_count_cells(line, AMBULO__CELLS_COMMA);
  ambulo__spot spot = {line->number, 1, 1};
  if (cells != group->axes)
    return ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, ambulo__spot_place(s, spot), NULL,
                         "the row has %d cells; expected %d, as the header", cells, group->axes);
  while (ambulo__table_next_cell(line, AMBULO__CELLS_COMMA, &position, &cell)) {
    ambulo__axis *axis = &s->axis[group->first + column++];
    spot.column = cell.column;
    ambulo_status status = check_cell(s, axis, &cell, spot);
    if (!status) status = add_text(s, axis, cell.start, cell.length, spot);
    if (status) return status;
  }
  group->count++;
  return AMBULO_OK;
}

static ambulo_status read_lines(ambulo_sweep *s, const char *text, size_t length) {
  ambulo__axis_group *group = &s->group[s->groups];
  ambulo__table_line line = {NULL, 0, 0, 0};
  ambulo_status status = AMBULO_OK;
  int header = 1;
  group->first = s->axes;
  while (!status && ambulo__table_next_line(text, length, &line)) {
    if (ambulo__table_line_is_empty(&line) || line.start[0] == '#') continue;
    status = header ? add_columns(s, group, &line) : add_row(s, group, &line);
    header = 0;
  }
  if (group->axes > 0) s->groups++;
  if (status || group->count > 0) return status;
  return fault(s, (ambulo__spot){line.number, 1, 1},
               "no row below the header; expected at least one");
}

/* one column an axis, one row a case */
static ambulo_status read_table(ambulo_sweep *s, const ambulo__yaml_node *node) {
  const char *name = ambulo__yaml_file_name(node);
  char *text = NULL;
  size_t length = 0;
  if (!name[0]) return AMBULO_E_SCHEMA;
  ambulo_status status = ambulo__named_file(&s->allocator, s->path, name, ambulo__yaml_place(node),
                                            s->diagnostics, &s->table);
  if (status) return status;
  status =
      ambulo__read_file(s->table, MOST_TABLE_BYTES, &s->allocator, s->diagnostics, &text, &length);
  if (!status)
    status = ambulo__refuse_foreign(text, length, AMBULO__TAKES_CSV, s->table, s->diagnostics);
  if (status)
    status = ambulo__yaml_error(node, status, NULL, "the table '%s' could not be read", s->table);
  else
    status = read_lines(s, text, length);
  ambulo__free(&s->allocator, text);
  return status;
}

ambulo_status ambulo__sweep_read_axes(ambulo_sweep *s, const ambulo__yaml_node *root) {
  static const char *const ways[] = {"grid", "zip"};
  const ambulo__yaml_node *axes = ambulo__yaml_get(root, "axes");
  int zip = ambulo__yaml_choice(ambulo__yaml_get(root, "combine"), ways, 2, 0);
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < ambulo__yaml_items(axes) && !status; i++)
    status = read_axis(s, ambulo__yaml_item(axes, i));
  if (!status) status = group_axes(s, axes, zip);
  const ambulo__yaml_node *table = ambulo__yaml_get(root, "table");
  const ambulo__yaml_node *latin = ambulo__yaml_get(root, "latin_hypercube");
  const ambulo__yaml_node *random = ambulo__yaml_get(root, "random");
  if (!status && table) status = read_table(s, table);
  if (!status && latin) status = read_samples(s, latin, 1);
  if (!status && random) status = read_samples(s, random, 0);
  return status;
}
