/* formats/motion_file.c - the table of motion_file.h: memory, names, units. */
#include "formats/motion_file.h"

#include "base/numtext.h"

#include <limits.h>
#include <math.h>
#include <string.h>
#include <strings.h>

ambulo_status ambulo__motion_create(int rows, int columns, const char *const *names,
                                    const ambulo_allocator *allocator, ambulo__motion **motion) {
  if (rows < 0 || columns < 0 || (columns > 0 && !names) || !motion) return AMBULO_E_ARGUMENT;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__motion *m = ambulo__alloc(&own, 1, sizeof *m);
  if (!m) return AMBULO_E_MEMORY;
  m->allocator = own;
  m->rows = rows;
  m->columns = columns;
  m->declared_columns = -1;
  m->body_mass = (double)NAN;
  m->time = ambulo__alloc(&own, (size_t)rows, sizeof *m->time);
  m->values = ambulo__alloc(&own, (size_t)rows * (size_t)columns, sizeof *m->values);
  m->names = ambulo__alloc(&own, (size_t)columns, sizeof *m->names);
  int complete = m->time && m->values && m->names;
  for (int c = 0; complete && c < columns; c++) {
    m->names[c] = ambulo__strdup(&own, names[c]);
    complete = m->names[c] != NULL;
  }
  if (!complete) {
    ambulo__motion_free(m);
    return AMBULO_E_MEMORY;
  }
  *motion = m;
  return AMBULO_OK;
}

void ambulo__motion_free(ambulo__motion *motion) {
  if (!motion) return;
  ambulo_allocator allocator = motion->allocator;
  for (int c = 0; motion->names && c < motion->columns; c++) {
    ambulo__free(&allocator, motion->names[c]);
  }
  ambulo__free(&allocator, motion->names);
  ambulo__free(&allocator, motion->time);
  ambulo__free(&allocator, motion->values);
  ambulo__free(&allocator, motion);
}

ambulo__motion_format ambulo__motion_format_of(const char *name) {
  const char *dot = strrchr(name, '.');
  if (!dot) return AMBULO__MOTION_AUTO;
  if (strcasecmp(dot, ".csv") == 0) return AMBULO__MOTION_CSV;
  if (strcasecmp(dot, ".sto") == 0 || strcasecmp(dot, ".mot") == 0) return AMBULO__MOTION_STO;
  return AMBULO__MOTION_AUTO;
}

int ambulo__motion_column(const ambulo__motion *motion, const char *name) {
  for (int c = 0; c < motion->columns; c++) {
    if (strcmp(motion->names[c], name) == 0) return c;
  }
  return -1;
}

void ambulo__motion_to_radians(ambulo__motion *motion, const unsigned char *is_angle) {
  if (!motion->in_degrees) return;
  const double radian = 3.14159265358979323846 / 180.0;
  for (int r = 0; r < motion->rows; r++) {
    double *row = motion->values + (size_t)r * (size_t)motion->columns;
    for (int c = 0; c < motion->columns; c++) {
      if (is_angle[c]) row[c] *= radian;
    }
  }
  motion->in_degrees = 0;
}

/* ------------------------------------------------- lines above the column names */

typedef struct header_reader {
  const ambulo__table_line *line;
  const char *file;
  ambulo_diagnostics *diagnostics;
  ambulo__table_header *header;
} header_reader;

ambulo__table_header ambulo__table_header_default(void) {
  ambulo__table_header header = {
      .declared_rows = -1, .declared_columns = -1, .body_mass = (double)NAN};
  return header;
}

static ambulo__place place_of(const header_reader *reader, const ambulo__table_cell *value) {
  ambulo__place place = {
      .file = reader->file, .line = reader->line->number, .column = value->column};
  return place;
}

static ambulo_status read_count(const header_reader *reader, const ambulo__table_cell *value,
                                long long *count) {
  if (ambulo__parse_integer(value->start, value->length, 0, INT_MAX, count)) return AMBULO_OK;
  return ambulo__error(reader->diagnostics, AMBULO_E_SCHEMA, place_of(reader, value), NULL,
                       "not a count (got '%.*s'); expected a whole number",
                       ambulo__table_quoted(value), value->start);
}

static ambulo_status read_rows(const header_reader *reader, const ambulo__table_cell *value) {
  reader->header->rows_line = reader->line->number;
  return read_count(reader, value, &reader->header->declared_rows);
}

static ambulo_status read_degrees(const header_reader *reader, const ambulo__table_cell *value) {
  int yes = ambulo__table_cell_is(value, "yes");
  if (!yes && !ambulo__table_cell_is(value, "no"))
    return ambulo__error(reader->diagnostics, AMBULO_E_SCHEMA, place_of(reader, value), NULL,
                         "inDegrees is '%.*s'; expected yes or no", ambulo__table_quoted(value),
                         value->start);
  reader->header->in_degrees = yes;
  reader->header->unit_stated = 1;
  return AMBULO_OK;
}

/* SIMM's "datarows 8" */
static ambulo_status read_words(const header_reader *reader) {
  size_t position = 0;
  ambulo__table_cell key, value, rest;
  if (!ambulo__table_next_cell(reader->line, AMBULO__CELLS_BLANK, &position, &key) ||
      !ambulo__table_next_cell(reader->line, AMBULO__CELLS_BLANK, &position, &value) ||
      ambulo__table_next_cell(reader->line, AMBULO__CELLS_BLANK, &position, &rest))
    return AMBULO_OK;
  if (ambulo__table_cell_is(&key, "datarows")) return read_rows(reader, &value);
  if (ambulo__table_cell_is(&key, "datacolumns"))
    return read_count(reader, &value, &reader->header->declared_columns);
  return AMBULO_OK;
}

/* line[from..): "key = value" */
static ambulo_status read_key(const header_reader *reader, size_t from, int is_sto) {
  const ambulo__table_line *line = reader->line;
  const char *equals = memchr(line->start + from, '=', line->length - from);
  if (!equals) return is_sto ? read_words(reader) : AMBULO_OK;
  size_t split = (size_t)(equals - line->start), position = 0;
  ambulo__table_line left = {.start = line->start + from, .length = split - from};
  ambulo__table_line right = {.start = equals + 1, .length = line->length - split - 1};
  ambulo__table_cell key, value;
  if (!ambulo__table_next_cell(&left, AMBULO__CELLS_BLANK, &position, &key)) return AMBULO_OK;
  position = 0;
  if (!ambulo__table_next_cell(&right, AMBULO__CELLS_BLANK, &position, &value)) {
    value = (ambulo__table_cell){.start = "", .column = 1};
  }
  value.column += (int)split + 1;
  if (ambulo__table_cell_is(&key, "inDegrees")) return read_degrees(reader, &value);
  if (!is_sto) return AMBULO_OK;
  if (ambulo__table_cell_is(&key, "version")) reader->header->has_version = 1;
  if (ambulo__table_cell_is(&key, "nRows") || ambulo__table_cell_is(&key, "datarows"))
    return read_rows(reader, &value);
  if (ambulo__table_cell_is(&key, "nColumns") || ambulo__table_cell_is(&key, "datacolumns"))
    return read_count(reader, &value, &reader->header->declared_columns);
  return AMBULO_OK;
}

/* what OpenSim wrote before it wrote inDegrees, and still does beside it */
static void read_sentence(const header_reader *reader) {
  static const char *const words[] = {"angles", "are", "in"};
  size_t position = 0;
  ambulo__table_cell cell;
  for (int i = 0; i < 4; i++) {
    if (!ambulo__table_next_cell(reader->line, AMBULO__CELLS_BLANK, &position, &cell)) return;
    if (i < 3 && !ambulo__table_cell_is(&cell, words[i])) return;
  }
  while (cell.length > 0 && cell.start[cell.length - 1] == '.') cell.length--;
  int degrees = ambulo__table_cell_is(&cell, "degrees");
  if (reader->header->unit_stated || (!degrees && !ambulo__table_cell_is(&cell, "radians"))) return;
  reader->header->in_degrees = degrees;
  reader->header->unit_stated = 1;
}

/* "# ambulo motion: mass M kg, gravity X Y Z m/s^2 ..." (formats/motion_write.c) */
static void read_origin(const header_reader *reader) {
  static const char *const words[] = {"#", "ambulo", "motion:", "mass", NULL, "kg,", "gravity"};
  double numbers[4] = {0.0, 0.0, 0.0, 0.0};
  size_t position = 0;
  ambulo__table_cell cell;
  for (int i = 0, known = 0; i < 10; i++) {
    const char *word = i < 7 ? words[i] : NULL;
    if (!ambulo__table_next_cell(reader->line, AMBULO__CELLS_BLANK, &position, &cell)) return;
    if (word ? !ambulo__table_cell_is(&cell, word)
             : !ambulo__parse_double(cell.start, cell.length, &numbers[known++]))
      return;
  }
  reader->header->body_mass = numbers[0];
  memcpy(reader->header->gravity, numbers + 1, sizeof reader->header->gravity);
}

ambulo_status ambulo__table_header_take(const ambulo__table_line *line, int is_sto,
                                        const char *file, ambulo_diagnostics *diagnostics,
                                        ambulo__table_header *header) {
  header_reader reader = {line, file, diagnostics, header};
  if (is_sto) {
    read_sentence(&reader);
    return read_key(&reader, 0, 1);
  }
  if (line->length == 0 || line->start[0] != '#') return AMBULO_OK;
  if (line->number == 1) read_origin(&reader);
  return read_key(&reader, 1, 0);
}

/* -------------------------------------------- columns that belong to a coordinate */

static int is_joined(const char *column, const char *before, const char *name, const char *after) {
  size_t head = strlen(before), length = strlen(name);
  return strncmp(column, before, head) == 0 && strncmp(column + head, name, length) == 0 &&
         strcmp(column + head + length, after) == 0;
}

/* ".../NAME" followed by `ending` */
static int is_path(const char *column, const char *name, const char *ending) {
  size_t length = strlen(column), size = strlen(name), tail = strlen(ending);
  if (length < size + tail + 1 || strncmp(column, "/forceset/", 10) == 0) return 0;
  const char *at = column + length - tail - size;
  return at[-1] == '/' && is_joined(at, "", name, ending);
}

int ambulo__motion_names(const char *column, const char *name, ambulo__motion_order order) {
  switch (order) {
  case AMBULO__ORDER_VALUE:
    return is_joined(column, "", name, "") || is_joined(column, "q.", name, "") ||
           is_path(column, name, "") || is_path(column, name, "/value");
  case AMBULO__ORDER_RATE:
    return is_joined(column, "qd.", name, "") || is_joined(column, "", name, "_u") ||
           is_path(column, name, "/speed");
  case AMBULO__ORDER_ACCELERATION:
    break;
  }
  return is_joined(column, "qdd.", name, "") || is_path(column, name, "/accel") ||
         is_path(column, name, "/acceleration");
}

int ambulo__motion_is_value(const char *column) {
  size_t length = strlen(column);
  if (strncmp(column, "q.", 2) == 0) return 1;
  return strncmp(column, "/jointset/", 10) == 0 && length > 6 &&
         strcmp(column + length - 6, "/value") == 0;
}

/* first row in which two columns differ, or -1 */
static int first_difference(const ambulo__motion *motion, int a, int b) {
  for (int k = 0; k < motion->rows; k++) {
    const double *row = motion->values + (size_t)k * (size_t)motion->columns;
    if (!(row[a] == row[b])) return k;
  }
  return -1;
}

ambulo_status ambulo__motion_find(const ambulo__motion *motion, const char *file,
                                  const char *coordinate, ambulo__motion_order order,
                                  ambulo_diagnostics *diagnostics, int *column) {
  int found = -1;
  for (int c = 0; c < motion->columns; c++) {
    if (!coordinate[0] || !ambulo__motion_names(motion->names[c], coordinate, order)) continue;
    int row = found < 0 ? -1 : first_difference(motion, found, c);
    if (row >= 0) {
      ambulo__place place = {.file = file};
      const double *values = motion->values + (size_t)row * (size_t)motion->columns;
      return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, "take one of them out of the file",
                           "the columns '%s' and '%s' both stand for coordinate '%s' and differ "
                           "(%g and %g at t = %g s)",
                           motion->names[found], motion->names[c], coordinate, values[found],
                           values[c], motion->time[row]);
    }
    if (found < 0) found = c;
  }
  *column = found;
  return AMBULO_OK;
}

static const double turn = 6.283185307179586;

double ambulo__largest_plausible(const ambulo_coordinate *c) {
  double reach = fmax(fabs(c->range[0]), fabs(c->range[1]));
  int angle = c->type == AMBULO_REVOLUTE;
  if (!isfinite(reach)) return angle ? 10.0 * turn : (double)INFINITY;
  return angle ? fmax(fmin(10.0 * reach, turn), 2.0 * reach) : 10.0 * reach;
}
