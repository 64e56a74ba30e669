/* formats/marker_file.c - text of a TRC file to a table (marker_file.h). The first fault ends it.
 */
#include "formats/marker_file.h"

#include "base/numtext.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { LEADING = 2 /* Frame#, Time */ };

typedef struct marker_reader {
  const char *text;
  size_t length;
  const char *file;
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  ambulo__table_line line;
  double metres; /* of a unit of the file */
  long long frames;
  char (*names)[AMBULO__MOTION_MAX_NAME + 1]; /* [columns] */
  int columns;
  ambulo__motion *motion;
} marker_reader;

int ambulo__is_marker_file(const char *name) {
  const char *dot = strrchr(name, '.');
  return dot && strcasecmp(dot, ".trc") == 0;
}

static ambulo__place place_at(const marker_reader *r, int column) {
  return (ambulo__place){.file = r->file, .line = r->line.number, .column = column};
}

static ambulo_status next_line(marker_reader *r, const char *what) {
  if (ambulo__table_next_line(r->text, r->length, &r->line)) return AMBULO_OK;
  return ambulo__error(r->diagnostics, AMBULO_E_PARSE, place_at(r, 0), NULL,
                       "the file ends before %s; expected a TRC file", what);
}

/* the cell `index` of a line; 0: there is none */
static int cell_at(const ambulo__table_line *line, int index, ambulo__table_cell *cell) {
  size_t position = 0;
  for (int i = 0; ambulo__table_next_cell(line, AMBULO__CELLS_TAB, &position, cell); i++)
    if (i == index) return 1;
  return 0;
}

/* ------------------------------------------------------------------ keys, names */

static ambulo_status take_units(marker_reader *r, const ambulo__table_cell *value) {
  static const struct {
    const char *word;
    double metres;
  } units[] = {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"millimeters", 1e-3}, {"meters", 1.0}};
  for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
    if (!ambulo__table_cell_is(value, units[i].word)) continue;
    r->metres = units[i].metres;
    return AMBULO_OK;
  }
  return ambulo__error(r->diagnostics, AMBULO_E_SCHEMA, place_at(r, value->column), NULL,
                       "Units is '%.*s'; expected mm, cm or m", ambulo__table_quoted(value),
                       value->start);
}

static ambulo_status take_frames(marker_reader *r, const ambulo__table_cell *value) {
  if (ambulo__parse_integer(value->start, value->length, 0, INT_MAX, &r->frames)) return AMBULO_OK;
  return ambulo__error(r->diagnostics, AMBULO_E_SCHEMA, place_at(r, value->column), NULL,
                       "NumFrames is '%.*s'; expected a whole number", ambulo__table_quoted(value),
                       value->start);
}

static ambulo_status read_keys(marker_reader *r) {
  ambulo_status status = next_line(r, "its first line");
  if (!status && (r->line.length < 12 || memcmp(r->line.start, "PathFileType", 12) != 0))
    return ambulo__error(r->diagnostics, AMBULO_E_PARSE, place_at(r, 1), NULL,
                         "no PathFileType; expected a TRC file");
  if (!status) status = next_line(r, "its keys");
  ambulo__table_line keys = r->line;
  if (!status) status = next_line(r, "the values of its keys");
  ambulo__table_cell key, value;
  for (int i = 0; !status && cell_at(&keys, i, &key); i++) {
    int has_value = cell_at(&r->line, i, &value);
    if (has_value && ambulo__table_cell_is(&key, "Units")) status = take_units(r, &value);
    if (has_value && ambulo__table_cell_is(&key, "NumFrames")) status = take_frames(r, &value);
  }
  if (!status && r->metres == 0.0)
    return ambulo__error(r->diagnostics, AMBULO_E_SCHEMA, place_at(r, 1), NULL,
                         "no Units; expected mm, cm or m");
  return status;
}

static ambulo_status take_name(marker_reader *r, const ambulo__table_cell *cell, int index) {
  static const char axes[] = "xyz";
  if (cell->length > AMBULO__MOTION_MAX_NAME - 2 || (index - LEADING) % 3 != 0)
    return ambulo__error(r->diagnostics, AMBULO_E_SCHEMA, place_at(r, cell->column), NULL,
                         "marker '%.*s' in column %d; expected each marker over three columns",
                         ambulo__table_quoted(cell), cell->start, index + 1);
  for (int c = 0; c < r->columns; c += 3) {
    if (strlen(r->names[c]) != cell->length + 2 ||
        memcmp(r->names[c], cell->start, cell->length) != 0)
      continue;
    return ambulo__error(r->diagnostics, AMBULO_E_SCHEMA, place_at(r, cell->column), NULL,
                         "marker '%.*s' is there twice", ambulo__table_quoted(cell), cell->start);
  }
  for (int axis = 0; axis < 3; axis++)
    (void)snprintf(r->names[r->columns++], sizeof *r->names, "%.*s.%c", (int)cell->length,
                   cell->start, axes[axis]);
  return AMBULO_OK;
}

static ambulo_status read_names(marker_reader *r) {
  ambulo_status status = next_line(r, "the names of its markers");
  ambulo__table_cell cell;
  if (status) return status;
  if (!cell_at(&r->line, 1, &cell) || !ambulo__table_cell_is(&cell, "Time"))
    return ambulo__error(r->diagnostics, AMBULO_E_SCHEMA, place_at(r, 1), NULL,
                         "the second column is not Time; expected Frame#, Time and the markers");
  int count = ambulo__table_count_cells(&r->line, AMBULO__CELLS_TAB);
  if (count > AMBULO__MOTION_MAX_COLUMNS)
    return ambulo__error(r->diagnostics, AMBULO_E_LIMIT, place_at(r, 1), NULL,
                         "%d columns; expected at most %d", count, AMBULO__MOTION_MAX_COLUMNS);
  r->names = ambulo__alloc(r->allocator, 3 * (size_t)count, sizeof *r->names);
  if (!r->names) return AMBULO_E_MEMORY;
  for (int i = LEADING; !status && cell_at(&r->line, i, &cell); i++)
    if (cell.length > 0) status = take_name(r, &cell, i);
  if (!status && r->columns == 0)
    status = ambulo__error(r->diagnostics, AMBULO_E_SCHEMA, place_at(r, 1), NULL,
                           "no markers behind Time");
  return status ? status : next_line(r, "the line X1, Y1, Z1");
}

/* ------------------------------------------------------------------------- rows */

static int count_rows(const marker_reader *reader) {
  ambulo__table_line line = reader->line;
  int rows = 0;
  while (ambulo__table_next_line(reader->text, reader->length, &line))
    rows += !ambulo__table_line_is_empty(&line);
  return rows;
}

static ambulo_status read_cell(const marker_reader *r, const ambulo__table_cell *cell, int row,
                               int index) {
  ambulo__motion *m = r->motion;
  double value = (double)NAN;
  int is_time = index == 1, gap = cell->length == 0 || ambulo__table_cell_is(cell, "nan");
  if (!(gap && !is_time) && !ambulo__parse_double(cell->start, cell->length, &value))
    return ambulo__error(r->diagnostics, AMBULO_E_SCHEMA, place_at(r, cell->column), NULL,
                         "column '%s': not a number (got '%.*s')",
                         is_time ? "Time" : r->names[index - LEADING], ambulo__table_quoted(cell),
                         cell->start);
  if (!is_time) {
    m->values[(size_t)row * (size_t)m->columns + (size_t)(index - LEADING)] = r->metres * value;
    return AMBULO_OK;
  }
  m->time[row] = value;
  if (row == 0 || value > m->time[row - 1]) return AMBULO_OK;
  return ambulo__error(r->diagnostics, AMBULO_E_SCHEMA, place_at(r, cell->column), NULL,
                       "time does not increase (got '%.*s'); expected more than in the row before",
                       ambulo__table_quoted(cell), cell->start);
}

static ambulo_status read_row(const marker_reader *r, int row) {
  ambulo__motion *m = r->motion;
  ambulo__table_cell cell;
  size_t position = 0;
  ambulo_status status = AMBULO_OK;
  for (int c = 0; c < m->columns; c++)
    m->values[(size_t)row * (size_t)m->columns + (size_t)c] = (double)NAN;
  int index = 0;
  for (; !status && ambulo__table_next_cell(&r->line, AMBULO__CELLS_TAB, &position, &cell); index++)
    if (index > 0 && index < m->columns + LEADING) status = read_cell(r, &cell, row, index);
  if (!status && (index < LEADING || index > m->columns + LEADING))
    return ambulo__error(r->diagnostics, AMBULO_E_PARSE, place_at(r, 1), NULL,
                         "row with %d cells; expected at most %d", index, m->columns + LEADING);
  return status;
}

static ambulo_status read_rows(marker_reader *r) {
  int rows = count_rows(r), row = 0;
  ambulo__place whole = {.file = r->file};
  if (rows == 0 || (r->frames >= 0 && r->frames != rows))
    return ambulo__error(r->diagnostics, AMBULO_E_PARSE, whole, NULL,
                         "%d rows; expected %lld (NumFrames): the file may be cut off", rows,
                         r->frames < 0 ? 1 : r->frames);
  const char **names = ambulo__alloc(r->allocator, (size_t)r->columns, sizeof *names);
  if (!names) return AMBULO_E_MEMORY;
  for (int c = 0; c < r->columns; c++) names[c] = r->names[c];
  ambulo_status status = ambulo__motion_create(rows, r->columns, names, r->allocator, &r->motion);
  ambulo__free(r->allocator, names);
  while (!status && ambulo__table_next_line(r->text, r->length, &r->line))
    if (!ambulo__table_line_is_empty(&r->line)) status = read_row(r, row++);
  return status;
}

/* -------------------------------------------------------------------- the whole */

ambulo_status ambulo__markers_parse(const char *text, size_t length, const char *name,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo__motion **motion) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  marker_reader r = {.text = text,
                     .length = length,
                     .file = name,
                     .allocator = &own,
                     .diagnostics = diagnostics,
                     .frames = -1};
  ambulo_status status = read_keys(&r);
  if (!status) status = read_names(&r);
  if (!status) status = read_rows(&r);
  ambulo__free(&own, r.names);
  if (status) {
    ambulo__motion_free(r.motion);
    return status;
  }
  *motion = r.motion;
  return AMBULO_OK;
}

ambulo_status ambulo__markers_read_input(ambulo__inputs *inputs, const char *path,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics, ambulo__motion **motion) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  char *text = NULL;
  size_t length = 0;
  ambulo_status status = ambulo__inputs_read(inputs, path, AMBULO__MOTION_MAX_BYTES, &own,
                                             diagnostics, &text, &length);
  if (status) return status;
  status = ambulo__markers_parse(text, length, path, &own, diagnostics, motion);
  ambulo__free(&own, text);
  return status;
}
