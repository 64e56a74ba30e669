/* formats/table_text.c - splitting; see table_text.h. */
#include "formats/table_text.h"

#include <string.h>

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

int ambulo__table_line_is_empty(const ambulo__table_line *line) {
  for (size_t i = 0; i < line->length; i++) {
    if (!is_blank(line->start[i])) return 0;
  }
  return 1;
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

static int rest_is_blank(const ambulo__table_line *line, size_t from) {
  for (size_t i = from; i < line->length; i++) {
    if (!is_blank(line->start[i])) return 0;
  }
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

int ambulo__table_count_cells(const ambulo__table_line *line, ambulo__table_cells cells) {
  size_t position = 0;
  ambulo__table_cell cell;
  int count = 0;
  while (ambulo__table_next_cell(line, cells, &position, &cell)) count++;
  return count;
}
