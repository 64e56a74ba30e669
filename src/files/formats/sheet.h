/* formats/sheet.h - a table's text, line by line and cell by cell; and a CSV file as cells that
 * know where they stand. */
#ifndef AMBULO_FORMATS_SHEET_H
#define AMBULO_FORMATS_SHEET_H

#include "base/alloc.h"
#include "base/diagnostics.h"

#include <stddef.h>

/* A line without its end; `next` is where the following one starts. */
typedef struct ambulo__table_line {
  const char *start;
  size_t length;
  int number; /* 1-based */
  size_t next;
} ambulo__table_line;

/* How cells are separated. */
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
/* 1 if the cell is the word, whatever the case. */
int ambulo__table_cell_is(const ambulo__table_cell *cell, const char *word);
/* Characters of a bad cell that a message repeats. */
int ambulo__table_quoted(const ambulo__table_cell *cell);
int ambulo__table_count_cells(const ambulo__table_line *line, ambulo__table_cells cells);

typedef struct ambulo__sheet_line {
  int number;     /* 1-based line of the file */
  int first_cell; /* index into cells */
  int cell_count;
} ambulo__sheet_line;

/* Lines that are empty, begin with '#' or hold nothing but commas are left out. */
typedef struct ambulo__sheet {
  ambulo_allocator allocator;
  const char *file; /* borrowed */
  char *text;
  ambulo__sheet_line *lines;
  int line_count;
  ambulo__table_cell *cells;
} ambulo__sheet;

/* Fills *sheet, which ambulo__sheet_free releases. Errors: E_IO, E_LIMIT (64 MiB, 4 million cells),
 * E_PARSE (no lines), E_MEMORY. `path` must outlive the sheet. */
ambulo_status ambulo__sheet_read(const char *path, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo__sheet *sheet);
void ambulo__sheet_free(ambulo__sheet *sheet); /* accepts a zero-filled one */

/* NULL where the line has no such cell. */
const ambulo__table_cell *ambulo__sheet_cell(const ambulo__sheet *sheet, int line, int cell);
/* Cell with exactly this text in a line, or -1. */
int ambulo__sheet_find(const ambulo__sheet *sheet, int line, const char *text);
/* The same where the text must not stand twice: *cell, or E_SCHEMA at the second one. */
ambulo_status ambulo__sheet_find_one(const ambulo__sheet *sheet, int line, const char *text,
                                     ambulo_diagnostics *diagnostics, int *cell);
int ambulo__cell_is(const ambulo__table_cell *cell, const char *text);
/* A finite number, or an E_SCHEMA with file, line and column (`what` names the quantity). */
ambulo_status ambulo__sheet_number(const ambulo__sheet *sheet, int line, int cell, const char *what,
                                   ambulo_diagnostics *diagnostics, double *value);
/* Position of a cell (of the line, when there is no such cell). */
ambulo__place ambulo__sheet_place(const ambulo__sheet *sheet, int line, int cell);

#endif
