/* formats/table_header.h - what the lines above the column names state about a table. */
#ifndef AMBULO_FORMATS_TABLE_HEADER_H
#define AMBULO_FORMATS_TABLE_HEADER_H

#include "base/diagnostics.h"
#include "formats/table_text.h"

typedef struct ambulo__table_header {
  int in_degrees, unit_stated;               /* unit of angles, and whether the file says so */
  int has_version;                           /* a line version=...: not of SIMM */
  long long declared_rows, declared_columns; /* -1: not stated */
  double body_mass, gravity[3];              /* kg, m/s^2; mass NaN: not stated */
} ambulo__table_header;

ambulo__table_header ambulo__table_header_default(void);

/* Takes in one line: of an STO or MOT header "key = value" (inDegrees, version, nRows or datarows,
 * nColumns or datacolumns), as SIMM has it "datarows 8", and the sentence "Angles are in degrees.";
 * of a CSV a comment "# inDegrees=yes" and, in its first line, whose motion it is. Anything else is
 * a title or a remark. Errors: E_SCHEMA. */
ambulo_status ambulo__table_header_take(const ambulo__table_line *line, int is_sto,
                                        const char *file, ambulo_diagnostics *diagnostics,
                                        ambulo__table_header *header);

/* 1 if the cell is the word, whatever the case. */
int ambulo__table_cell_is(const ambulo__table_cell *cell, const char *word);

#endif
