/* formats/sheet.c - lines and cells of a CSV file (sheet.h). */
#include "formats/sheet.h"

#include <string.h>

#include "base/numtext.h"
#include "formats/read_file.h"
#include "formats/foreign_format.h"

enum { MAX_BYTES = 64 * 1024 * 1024, MAX_CELLS = 4000000, QUOTED = 40 };

/* a comment, or no cell with text in it */
static int says_nothing(const ambulo__table_line *line) {
  ambulo__table_cell cell;
  size_t position = 0;
  if (line->length > 0 && line->start[0] == '#') return 1;
  while (ambulo__table_next_cell(line, AMBULO__CELLS_COMMA, &position, &cell)) {
    if (cell.length > 0) return 0;
  }
  return 1;
}

static void count(const char *text, size_t length, int *lines, int *cells) {
  ambulo__table_line line = {.start = NULL};
  *lines = *cells = 0;
  while (*cells <= MAX_CELLS && ambulo__table_next_line(text, length, &line)) {
    if (says_nothing(&line)) continue;
    ++*lines;
    *cells += ambulo__table_count_cells(&line, AMBULO__CELLS_COMMA);
  }
}

static void fill(ambulo__sheet *sheet, size_t length) {
  ambulo__table_line line = {.start = NULL};
  int used = 0;
  while (ambulo__table_next_line(sheet->text, length, &line)) {
    if (says_nothing(&line)) continue;
    ambulo__sheet_line *entry = &sheet->lines[sheet->line_count++];
    size_t position = 0;
    entry->number = line.number;
    entry->first_cell = used;
    while (ambulo__table_next_cell(&line, AMBULO__CELLS_COMMA, &position, &sheet->cells[used]))
      used++;
    entry->cell_count = used - entry->first_cell;
  }
}

ambulo_status ambulo__sheet_read(const char *path, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo__sheet *sheet) {
  ambulo__sheet s = {.allocator = ambulo__allocator_or_default(allocator), .file = path};
  ambulo__place place = {.file = path};
  size_t length = 0;
  int lines, cells;
  ambulo_status status =
      ambulo__read_file(path, MAX_BYTES, &s.allocator, diagnostics, &s.text, &length);
  if (!status)
    status = ambulo__refuse_foreign(s.text, length, AMBULO__TAKES_CSV, path, diagnostics);
  if (status) {
    ambulo__free(&s.allocator, s.text);
    return status;
  }
  count(s.text, length, &lines, &cells);
  if (cells > MAX_CELLS) {
    ambulo__free(&s.allocator, s.text);
    return ambulo__error(diagnostics, AMBULO_E_LIMIT, place, NULL, "%d cells; expected at most %d",
                         cells, MAX_CELLS);
  }
  s.lines = ambulo__alloc(&s.allocator, (size_t)lines, sizeof *s.lines);
  s.cells = ambulo__alloc(&s.allocator, (size_t)cells, sizeof *s.cells);
  if (!s.lines || !s.cells) {
    status = AMBULO_E_MEMORY;
  } else if (lines == 0) {
    status = ambulo__error(diagnostics, AMBULO_E_PARSE, place, NULL,
                           "nothing but blank lines and comments; expected a table");
  } else {
    fill(&s, length);
    *sheet = s;
  }
  if (status) ambulo__sheet_free(&s);
  return status;
}

void ambulo__sheet_free(ambulo__sheet *sheet) {
  ambulo__free(&sheet->allocator, sheet->text);
  ambulo__free(&sheet->allocator, sheet->lines);
  ambulo__free(&sheet->allocator, sheet->cells);
}

const ambulo__table_cell *ambulo__sheet_cell(const ambulo__sheet *sheet, int line, int cell) {
  if (line < 0 || line >= sheet->line_count) return NULL;
  const ambulo__sheet_line *entry = &sheet->lines[line];
  return cell >= 0 && cell < entry->cell_count ? &sheet->cells[entry->first_cell + cell] : NULL;
}

int ambulo__cell_is(const ambulo__table_cell *cell, const char *text) {
  return cell && cell->length == strlen(text) && memcmp(cell->start, text, cell->length) == 0;
}

int ambulo__sheet_find(const ambulo__sheet *sheet, int line, const char *text) {
  for (int i = 0; line < sheet->line_count && i < sheet->lines[line].cell_count; i++) {
    if (ambulo__cell_is(ambulo__sheet_cell(sheet, line, i), text)) return i;
  }
  return -1;
}

ambulo_status ambulo__sheet_find_one(const ambulo__sheet *sheet, int line, const char *text,
                                     ambulo_diagnostics *diagnostics, int *cell) {
  int first = ambulo__sheet_find(sheet, line, text);
  for (int i = first + 1; first >= 0 && i < sheet->lines[line].cell_count; i++) {
    if (ambulo__cell_is(ambulo__sheet_cell(sheet, line, i), text))
      return ambulo__error(diagnostics, AMBULO_E_SCHEMA, ambulo__sheet_place(sheet, line, i), NULL,
                           "duplicate column '%s' (also column %d)", text, first + 1);
  }
  *cell = first;
  return AMBULO_OK;
}

ambulo__place ambulo__sheet_place(const ambulo__sheet *sheet, int line, int cell) {
  const ambulo__table_cell *at = ambulo__sheet_cell(sheet, line, cell);
  ambulo__place place = {.file = sheet->file};
  if (line >= 0 && line < sheet->line_count) {
    place.line = sheet->lines[line].number;
    place.column = at ? at->column : 1;
  }
  return place;
}

ambulo_status ambulo__sheet_number(const ambulo__sheet *sheet, int line, int cell, const char *what,
                                   ambulo_diagnostics *diagnostics, double *value) {
  const ambulo__table_cell *at = ambulo__sheet_cell(sheet, line, cell);
  if (at && ambulo__parse_double(at->start, at->length, value)) return AMBULO_OK;
  int length = !at ? 0 : at->length < QUOTED ? (int)at->length : QUOTED;
  return ambulo__error(diagnostics, AMBULO_E_SCHEMA, ambulo__sheet_place(sheet, line, cell), NULL,
                       "%s is '%.*s'; expected a finite number", what, length,
                       length ? at->start : "");
}
