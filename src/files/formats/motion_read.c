/* formats/motion_read.c - text of a motion to a table (motion_file.h).
 *
 * Three steps: the lines before the column names (STO keys, CSV comments), the names, the
 * rows. Every fault is reported with line and column, and reading goes on after it. */
#include "base/numtext.h"
#include "formats/foreign_format.h"
#include "formats/motion_file.h"
#include "formats/read_file.h"

#include <math.h>
#include <string.h>

typedef struct table_reader {
  const char *text;
  size_t length;
  const char *file;
  int is_sto;
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  ambulo_status status;      /* of the first fault */
  ambulo__table_line line;   /* the line being read */
  ambulo__table_cells cells; /* of data rows */
  int gaps;                  /* 1: any cell may be "nan" */
  ambulo__table_header header;
  char **names; /* [name_count], without time */
  int name_count;
  ambulo__motion *motion;
  int has_previous_time;
  double previous_time; /* of the row above */
  int repeated;         /* rows left out that say the same as the row above */
} table_reader;

static ambulo__place here(const table_reader *reader, int column) {
  ambulo__place place = {.file = reader->file, .line = reader->line.number, .column = column};
  return place;
}

static void fault(table_reader *reader, ambulo_status status) {
  if (reader->status == AMBULO_OK) reader->status = status;
}

/* next line that is neither empty nor (in CSV) a comment */
static int next_row(table_reader *reader) {
  while (ambulo__table_next_line(reader->text, reader->length, &reader->line)) {
    if (ambulo__table_line_is_empty(&reader->line)) continue;
    if (!reader->is_sto && reader->line.start[0] == '#') continue;
    return 1;
  }
  return 0;
}

/* ---------------------------------------------- lines above the column names */

static void take_header_line(table_reader *reader) {
  ambulo_status status = ambulo__table_header_take(&reader->line, reader->is_sto, reader->file,
                                                   reader->diagnostics, &reader->header);
  if (status) fault(reader, status);
}

static int is_end_of_header(const ambulo__table_line *line) {
  size_t position = 0;
  ambulo__table_cell word, more;
  return ambulo__table_next_cell(line, AMBULO__CELLS_BLANK, &position, &word) &&
         ambulo__table_cell_is(&word, "endheader") &&
         !ambulo__table_next_cell(line, AMBULO__CELLS_BLANK, &position, &more);
}

static ambulo_status read_sto_header(table_reader *reader) {
  while (ambulo__table_next_line(reader->text, reader->length, &reader->line)) {
    if (is_end_of_header(&reader->line)) return reader->status;
    take_header_line(reader);
  }
  fault(reader, ambulo__error(reader->diagnostics, AMBULO_E_PARSE, here(reader, 1), NULL,
                              "no 'endheader' line; expected an OpenSim header"));
  return reader->status;
}

/* comments anywhere may state the unit; they are looked at once, before the rows */
static void read_csv_comments(table_reader *reader) {
  ambulo__table_line start = reader->line;
  while (ambulo__table_next_line(reader->text, reader->length, &reader->line))
    take_header_line(reader);
  reader->line = start;
}

/* --------------------------------------------------------------------- names */

static void check_name(table_reader *reader, const ambulo__table_cell *cell, const char *name) {
  if (cell->length == 0 || cell->length > AMBULO__MOTION_MAX_NAME) {
    fault(reader, ambulo__error(reader->diagnostics, AMBULO_E_SCHEMA, here(reader, cell->column),
                                NULL, "column name of %zu characters; expected 1 to %d",
                                cell->length, AMBULO__MOTION_MAX_NAME));
  }
  for (size_t i = 0; i < cell->length; i++) {
    unsigned char c = (unsigned char)cell->start[i];
    if (c >= ' ' && c != 127 && c != ',' && c != '"') continue;
    fault(reader, ambulo__error(reader->diagnostics, AMBULO_E_SCHEMA, here(reader, cell->column),
                                NULL, "column name '%.*s' contains the character 0x%02x",
                                ambulo__table_quoted(cell), cell->start, c));
    break;
  }
  for (int c = 0; c < reader->name_count; c++) {
    if (strcmp(reader->names[c], name) != 0) continue;
    fault(reader, ambulo__error(reader->diagnostics, AMBULO_E_SCHEMA, here(reader, cell->column),
                                NULL, "duplicate column '%.*s' (also column %d)",
                                ambulo__table_quoted(cell), name, c + 2));
    break;
  }
}

static ambulo_status add_name(table_reader *reader, const ambulo__table_cell *cell) {
  char *name = ambulo__alloc(reader->allocator, cell->length + 1, 1);
  if (!name) return AMBULO_E_MEMORY;
  memcpy(name, cell->start, cell->length);
  check_name(reader, cell, name);
  reader->names[reader->name_count++] = name;
  return AMBULO_OK;
}

static ambulo_status read_names(table_reader *reader) {
  ambulo__place start = {.file = reader->file};
  if (!next_row(reader)) {
    return ambulo__error(reader->diagnostics, AMBULO_E_PARSE, start, NULL,
                         "no column names; expected a header row that starts with 'time'");
  }
  const ambulo__table_line *line = &reader->line;
  ambulo__table_cells cells = reader->cells;
  if (reader->is_sto && memchr(line->start, '\t', line->length)) cells = AMBULO__CELLS_TAB;
  int count = ambulo__table_count_cells(line, cells);
  if (count > AMBULO__MOTION_MAX_COLUMNS) {
    return ambulo__error(reader->diagnostics, AMBULO_E_LIMIT, here(reader, 1), NULL,
                         "%d columns; expected at most %d", count, AMBULO__MOTION_MAX_COLUMNS);
  }
  reader->names = ambulo__alloc(reader->allocator, (size_t)count, sizeof *reader->names);
  if (!reader->names) return AMBULO_E_MEMORY;
  size_t position = 0;
  ambulo__table_cell cell = {.start = ""};
  if (!ambulo__table_next_cell(line, cells, &position, &cell) ||
      !ambulo__table_cell_is(&cell, "time")) {
    /* hardly a motion at all: the rows would only be noise */
    return ambulo__error(reader->diagnostics, AMBULO_E_SCHEMA, here(reader, 1),
                         "a motion is a table (CSV, STO or MOT) of times and named columns",
                         "the first column is '%.*s'; expected 'time'", ambulo__table_quoted(&cell),
                         cell.start);
  }
  while (ambulo__table_next_cell(line, cells, &position, &cell)) {
    ambulo_status status = add_name(reader, &cell);
    if (status) return status;
  }
  return AMBULO_OK;
}

/* ---------------------------------------------------------------------- rows */

/* "nan" where there may be gaps, or in a column of points that need not exist: no load on the foot,
 * no weight on the ground */
static int is_missing_point(const table_reader *reader, const ambulo__table_cell *cell,
                            int column) {
  if (column < 0 || !ambulo__table_cell_is(cell, "nan")) return 0;
  if (reader->gaps) return 1;
  const char *name = reader->names[column];
  return strncmp(name, "cop.", 4) == 0 || strncmp(name, "zmp.", 4) == 0;
}

/* 1 and *value, or 0 with a fault reported; column -1 is the time */
static int read_number(table_reader *reader, const ambulo__table_cell *cell, int column,
                       double *value) {
  if (ambulo__parse_double(cell->start, cell->length, value)) return 1;
  if (is_missing_point(reader, cell, column)) {
    *value = (double)NAN;
    return 1;
  }
  fault(reader,
        ambulo__error(reader->diagnostics, AMBULO_E_SCHEMA, here(reader, cell->column), NULL,
                      "column '%s': not a number (got '%.*s'); expected a finite number",
                      column < 0 ? "time" : reader->names[column], ambulo__table_quoted(cell),
                      cell->start));
  return 0;
}

/* Whether the time may stand in the next row: it increases, or an STO says it twice (OpenSim's
 * tools repeat the last row of a run), and then the rest of the row has to be the same. */
static void check_time(table_reader *reader, const ambulo__table_cell *cell, double time,
                       int same_row) {
  if (!reader->has_previous_time || time > reader->previous_time || same_row) return;
  fault(reader,
        ambulo__error(reader->diagnostics, AMBULO_E_SCHEMA, here(reader, cell->column), NULL,
                      "time does not increase (got '%.*s'); expected more than in "
                      "the row before",
                      ambulo__table_quoted(cell), cell->start));
}

/* row `row` says what the one before says, but for the last digits of ten that are printed */
static int is_same(const table_reader *reader, int row) {
  const ambulo__motion *m = reader->motion;
  const double *values = m->values + (size_t)row * (size_t)m->columns;
  if (!reader->is_sto || row == 0 || !(m->time[row] == m->time[row - 1])) return 0;
  for (int c = 0; c < m->columns; c++) {
    double before = values[c - m->columns];
    double size = 1e-3 + fmax(fabs(values[c]), fabs(before));
    int same = fabs(values[c] - before) <= 1e-8 * size;
    if (!same && !(isnan(values[c]) && isnan(before))) return 0;
  }
  return 1;
}

/* 1 if the row counts */
static int read_row(table_reader *reader, int row) {
  ambulo__motion *motion = reader->motion;
  int count = ambulo__table_count_cells(&reader->line, reader->cells);
  if (count != motion->columns + 1) {
    fault(reader, ambulo__error(reader->diagnostics, AMBULO_E_PARSE, here(reader, 1), NULL,
                                "row with %d cells; expected %d", count, motion->columns + 1));
    reader->has_previous_time = 0;
    return 1;
  }
  size_t position = 0;
  int known = 0;
  ambulo__table_cell cell, time_cell = {0};
  double *values = motion->values + (size_t)row * (size_t)motion->columns;
  for (int c = -1; ambulo__table_next_cell(&reader->line, reader->cells, &position, &cell); c++) {
    if (c < 0) {
      time_cell = cell;
      known = read_number(reader, &cell, c, &motion->time[row]);
    } else {
      (void)read_number(reader, &cell, c, &values[c]);
    }
  }
  int same = known && is_same(reader, row);
  if (known) check_time(reader, &time_cell, motion->time[row], same);
  reader->has_previous_time = known;
  reader->previous_time = motion->time[row];
  return !same;
}

static int count_rows(const table_reader *reader) {
  table_reader copy = *reader;
  int rows = 0;
  while (next_row(&copy)) rows++;
  return rows;
}

static ambulo_status read_rows(table_reader *reader) {
  int rows = count_rows(reader);
  ambulo__place start = {.file = reader->file};
  if (rows == 0) {
    return ambulo__error(reader->diagnostics, AMBULO_E_PARSE, start, NULL,
                         "no rows; expected at least one below the column names");
  }
  ambulo_status status =
      ambulo__motion_create(rows, reader->name_count, (const char *const *)reader->names,
                            reader->allocator, &reader->motion);
  if (status) return status;
  /* SIMM's angles are in degrees, and OpenSim takes them so without inDegrees or version */
  int simm = reader->is_sto && !reader->header.unit_stated && !reader->header.has_version;
  reader->motion->in_degrees = reader->header.in_degrees || simm;
  reader->motion->unit_stated = reader->header.unit_stated;
  reader->motion->declared_columns = (int)reader->header.declared_columns;
  reader->motion->body_mass = reader->header.body_mass;
  memcpy(reader->motion->gravity, reader->header.gravity, sizeof reader->header.gravity);
  int kept = 0;
  while (next_row(reader)) kept += read_row(reader, kept);
  reader->motion->rows = kept;
  if (kept < rows)
    ambulo__warning(reader->diagnostics, start, NULL,
                    "%d rows say the same as the row before, time and all: they are left out",
                    rows - kept);
  ambulo__place declared = {.file = reader->file, .line = reader->header.rows_line};
  if (reader->header.declared_rows >= 0 && reader->header.declared_rows < rows)
    ambulo__warning(reader->diagnostics, declared, NULL,
                    "%d rows, where nRows says %lld: all are taken", rows,
                    reader->header.declared_rows);
  if (reader->header.declared_rows > rows) {
    fault(reader, ambulo__error(reader->diagnostics, AMBULO_E_PARSE, declared,
                                "where the file is whole, write its number of rows behind nRows=",
                                "%d rows; expected %lld (nRows): the file may be cut off", rows,
                                reader->header.declared_rows));
  }
  return AMBULO_OK;
}

/* ------------------------------------------------------------------ the whole */

static ambulo_status check_size(table_reader *reader) {
  ambulo__place start = {.file = reader->file};
  if (reader->length <= AMBULO__MOTION_MAX_BYTES) return AMBULO_OK;
  return ambulo__error(reader->diagnostics, AMBULO_E_LIMIT, start, NULL,
                       "text too large (got %zu bytes); expected at most %zu", reader->length,
                       AMBULO__MOTION_MAX_BYTES);
}

static ambulo_status check_bytes(table_reader *reader) {
  ambulo__table_line line = {0};
  while (ambulo__table_next_line(reader->text, reader->length, &line)) {
    const char *nul = memchr(line.start, '\0', line.length);
    if (!nul) continue;
    ambulo__place place = {reader->file, line.number, (int)(nul - line.start) + 1, NULL};
    return ambulo__error(reader->diagnostics, AMBULO_E_PARSE, place, NULL,
                         "NUL byte; expected text");
  }
  return AMBULO_OK;
}

static int looks_like_sto(const table_reader *reader) {
  ambulo__table_line line = {0};
  while (ambulo__table_next_line(reader->text, reader->length, &line)) {
    if (is_end_of_header(&line)) return 1;
  }
  return 0;
}

static ambulo_status read_table(table_reader *reader, ambulo__motion_format format) {
  ambulo_status status = check_size(reader); /* before anything looks at the text */
  if (!status)
    status = ambulo__refuse_foreign(reader->text, reader->length, AMBULO__TAKES_MOTION,
                                    reader->file, reader->diagnostics);
  if (!status) status = check_bytes(reader);
  if (status) return status;
  reader->is_sto =
      format == AMBULO__MOTION_AUTO ? looks_like_sto(reader) : format == AMBULO__MOTION_STO;
  reader->cells = reader->is_sto ? AMBULO__CELLS_BLANK : AMBULO__CELLS_COMMA;
  if (!reader->is_sto) read_csv_comments(reader);
  if (reader->is_sto) status = read_sto_header(reader);
  if (!status) status = read_names(reader);
  if (!status) status = read_rows(reader);
  return status ? status : reader->status;
}

ambulo_status ambulo__table_read(const char *text, size_t length, const char *name,
                                 ambulo__motion_format format, int gaps,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__motion **motion) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  table_reader reader = {.text = text,
                         .length = length,
                         .file = name,
                         .allocator = &own,
                         .diagnostics = diagnostics,
                         .gaps = gaps,
                         .header = ambulo__table_header_default()};
  ambulo_status status = read_table(&reader, format);
  for (int c = 0; c < reader.name_count; c++) ambulo__free(&own, reader.names[c]);
  ambulo__free(&own, reader.names);
  if (status) {
    ambulo__motion_free(reader.motion);
    return status;
  }
  *motion = reader.motion;
  return AMBULO_OK;
}

ambulo_status ambulo__motion_read_input(ambulo__inputs *inputs, const char *path, int gaps,
                                        const ambulo_allocator *allocator,
                                        ambulo_diagnostics *diagnostics, ambulo__motion **motion) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  char *text = NULL;
  size_t length = 0;
  ambulo_status status = ambulo__inputs_read(inputs, path, AMBULO__MOTION_MAX_BYTES, &own,
                                             diagnostics, &text, &length);
  if (status) return status;
  status = ambulo__table_read(text, length, path, ambulo__motion_format_of(path), gaps, &own,
                              diagnostics, motion);
  ambulo__free(&own, text);
  return status;
}

ambulo_status ambulo__motion_read(const char *path, int gaps, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo__motion **motion) {
  return ambulo__motion_read_input(NULL, path, gaps, allocator, diagnostics, motion);
}
