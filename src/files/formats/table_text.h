/* formats/table_text.h - a table's text, line by line and cell by cell. */
#ifndef AMBULO_FORMATS_TABLE_TEXT_H
#define AMBULO_FORMATS_TABLE_TEXT_H

#include <stddef.h>

/* A line without its end; `next` is where the following one starts. */
typedef struct ambulo__table_line {
  const char *start;
  size_t length;
  int number; /* 1-based */
  size_t next;
} ambulo__table_line;

/* How cells are told apart. */
typedef enum ambulo__table_cells {
  AMBULO__CELLS_COMMA,
  AMBULO__CELLS_TAB,  /* empty cells at the end are ignored */
  AMBULO__CELLS_BLANK /* runs of tabs and spaces */
} ambulo__table_cells;

typedef struct ambulo__table_cell {
  const char *start;
  size_t length;
  int column; /* 1-based character column of the cell in its line */
} ambulo__table_cell;

/* Line after *line (first call: a zero-filled line); 0 at the end of the text. LF or CRLF;
 * a byte-order mark before the first line is skipped. */
int ambulo__table_next_line(const char *text, size_t length, ambulo__table_line *line);
/* Nothing but blanks. */
int ambulo__table_line_is_empty(const ambulo__table_line *line);

/* Cell after position *position in the line (first call: 0), trimmed of blanks and of one
 * pair of double quotes; 0 when there is none left. A comma at the end is followed by an
 * empty cell. */
int ambulo__table_next_cell(const ambulo__table_line *line, ambulo__table_cells cells,
                            size_t *position, ambulo__table_cell *cell);
int ambulo__table_count_cells(const ambulo__table_line *line, ambulo__table_cells cells);

#endif
