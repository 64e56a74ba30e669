/* show/case_table.h - forms of cases, and a table for each of what fills them (case_data.h).
 *
 *     [{"tree": FORM, "columns": [COLUMN, ...]}, ...]
 *
 * A column has the values of one leaf, a row for each case of the form in their order: [v, ...];
 * [v] where all are the same; {"of": j, "by": r} where they are r times those of column j before
 * it, as lengths of bones are of the stature. */
#ifndef AMBULO_SHOW_CASE_TABLE_H
#define AMBULO_SHOW_CASE_TABLE_H

#include "show/case_data.h"

/* Appends the list; form[i] is the number of case i's. Errors: E_MEMORY. */
ambulo_status ambulo__case_table(ambulo__text_buffer *out, const ambulo__case_data *cases,
                                 int count, int *form);

#endif
