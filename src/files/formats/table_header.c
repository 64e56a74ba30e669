/* formats/table_header.c - see table_header.h. */
#include "formats/table_header.h"

#include <limits.h>
#include <math.h>
#include <string.h>
#include <strings.h>

#include "base/numtext.h"

/* characters of a bad value that are repeated in a message */
enum { QUOTED = 40 };

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

int ambulo__table_cell_is(const ambulo__table_cell *cell, const char *word) {
  return cell->length == strlen(word) && strncasecmp(cell->start, word, cell->length) == 0;
}

static ambulo__place place_of(const header_reader *reader, const ambulo__table_cell *value) {
  ambulo__place place = {
      .file = reader->file, .line = reader->line->number, .column = value->column};
  return place;
}

static int quoted_length(const ambulo__table_cell *cell) {
  return cell->length < QUOTED ? (int)cell->length : QUOTED;
}

static ambulo_status read_count(const header_reader *reader, const ambulo__table_cell *value,
                                long long *count) {
  if (ambulo__parse_integer(value->start, value->length, 0, INT_MAX, count)) return AMBULO_OK;
  return ambulo__error(reader->diagnostics, AMBULO_E_SCHEMA, place_of(reader, value), NULL,
                       "not a count (got '%.*s'); expected a whole number", quoted_length(value),
                       value->start);
}

static ambulo_status read_degrees(const header_reader *reader, const ambulo__table_cell *value) {
  int yes = ambulo__table_cell_is(value, "yes");
  if (!yes && !ambulo__table_cell_is(value, "no"))
    return ambulo__error(reader->diagnostics, AMBULO_E_SCHEMA, place_of(reader, value), NULL,
                         "inDegrees is '%.*s'; expected yes or no", quoted_length(value),
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
  if (ambulo__table_cell_is(&key, "datarows"))
    return read_count(reader, &value, &reader->header->declared_rows);
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
    return read_count(reader, &value, &reader->header->declared_rows);
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

/* "# ambulo motion: mass M kg, gravity X Y Z m/s^2 ..." (formats/motion_csv.c) */
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
