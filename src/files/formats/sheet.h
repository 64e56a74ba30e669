/* formats/sheet.h - a CSV file as cells of text that know where they stand. */
#ifndef AMBULO_FORMATS_SHEET_H
#define AMBULO_FORMATS_SHEET_H

#include "base/alloc.h"
#include "base/diagnostics.h"
#include "formats/table_text.h"

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
