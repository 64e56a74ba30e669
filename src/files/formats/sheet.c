/* formats/sheet.c - lines and cells of a text; a CSV file as cells. */
#include "formats/sheet.h"

#include "base/numtext.h"
#include "formats/foreign_format.h"
#include "formats/read_file.h"

#include <string.h>
#include <strings.h>

static int is_blank(char c) {
  return c == ' ' || c == '\t';
}

int ambulo__table_next_line(const char *text, size_t length, ambulo__table_line *line) {
  size_t start = line->next;
  if (line->number == 0 && length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) start = 3;
  if (start >= length) return 0;
  const char *end = memchr(text + start, '\n', length - start);
  size_t stop = end ? (size_t)(end - text) : length;
  line->next = end ? stop + 1 : length;
  if (stop > start && text[stop - 1] == '\r') stop--;
  line->start = text + start;
  line->length = stop - start;
  line->number++;
  return 1;
}

static int rest_is_blank(const ambulo__table_line *line, size_t from) {
  for (size_t i = from; i < line->length; i++) {
    if (!is_blank(line->start[i])) return 0;
  }
  return 1;
}

int ambulo__table_line_is_empty(const ambulo__table_line *line) {
  return rest_is_blank(line, 0);
}

/* cell = line[from, to) without blanks around it and without a pair of quotes */
static void set_cell(const ambulo__table_line *line, size_t from, size_t to,
                     ambulo__table_cell *cell) {
  const char *text = line->start;
  while (from < to && is_blank(text[from])) from++;
  while (to > from && is_blank(text[to - 1])) to--;
  if (to - from >= 2 && text[from] == '"' && text[to - 1] == '"') {
    from++;
    to--;
  }
  cell->start = text + from;
  cell->length = to - from;
  cell->column = (int)from + 1;
}

/* position of the separator that ends the cell at `from`, or the line's length; separators
 * within quotes do not count */
static size_t find_separator(const ambulo__table_line *line, size_t from, char separator) {
  int quoted = 0;
  for (size_t i = from; i < line->length; i++) {
    if (line->start[i] == '"') quoted = !quoted;
    if (!quoted && line->start[i] == separator) return i;
  }
  return line->length;
}

static int next_blank_cell(const ambulo__table_line *line, size_t *position,
                           ambulo__table_cell *cell) {
  size_t from = *position;
  while (from < line->length && is_blank(line->start[from])) from++;
  size_t to = from;
  while (to < line->length && !is_blank(line->start[to])) to++;
  if (to == from) return 0;
  set_cell(line, from, to, cell);
  *position = to;
  return 1;
}

int ambulo__table_next_cell(const ambulo__table_line *line, ambulo__table_cells cells,
                            size_t *position, ambulo__table_cell *cell) {
  if (cells == AMBULO__CELLS_BLANK) return next_blank_cell(line, position, cell);
  char separator = cells == AMBULO__CELLS_COMMA ? ',' : '\t';
  /* one past the end marks that the last cell has been given */
  if (*position > line->length) return 0;
  if (cells == AMBULO__CELLS_TAB && rest_is_blank(line, *position)) return 0;
  size_t stop = find_separator(line, *position, separator);
  set_cell(line, *position, stop, cell);
  *position = stop + 1;
  return 1;
}

int ambulo__table_quoted(const ambulo__table_cell *cell) {
  enum { MOST = 40 };
  return cell->length < MOST ? (int)cell->length : MOST;
}

int ambulo__table_cell_is(const ambulo__table_cell *cell, const char *word) {
  return cell->length == strlen(word) && strncasecmp(cell->start, word, cell->length) == 0;
}

int ambulo__table_count_cells(const ambulo__table_line *line, ambulo__table_cells cells) {
  size_t position = 0;
  ambulo__table_cell cell;
  int count = 0;
  while (ambulo__table_next_cell(line, cells, &position, &cell)) count++;
  return count;
}

/* ---------------------------------------------------------------- a CSV file */

enum { MAX_BYTES = 64 * 1024 * 1024, MAX_CELLS = 4000000 };

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
  int length = at ? ambulo__table_quoted(at) : 0;
  return ambulo__error(diagnostics, AMBULO_E_SCHEMA, ambulo__sheet_place(sheet, line, cell), NULL,
                       "%s is '%.*s'; expected a finite number", what, length,
                       length ? at->start : "");
}
