/* problem/row_runs.h - the linear rows, laid out for evaluation.
 *
 *     value_r   = constant_r + sum_t coefficient_rt * channel[at_rt]
 *     adjoint[at_rt] += weight_r * coefficient_rt
 *
 * The table (contact/rows.h) says what a row is called and where it stands; that is a hundred
 * bytes of a row, of which a value needs twenty. Here are those alone: rows in the table's order,
 * cut into runs of rows with equally many terms, so that the inner loop has a fixed length.
 *
 * Rows of the caller and rows with a term on an unknown are `odd`: listed, and left to
 * evaluate.c and gradient.c one by one.
 */
#ifndef AMBULO_PROBLEM_ROW_RUNS_H
#define AMBULO_PROBLEM_ROW_RUNS_H

#include "contact/rows.h"

typedef struct ambulo__row_run {
  int first, count;       /* rows of the table */
  int terms, first_entry; /* of each row; entries of the run follow one another */
} ambulo__row_run;

typedef struct ambulo__row_runs {
  ambulo__row_run *runs;
  int run_count;
  double *constant;    /* [rows of the table] */
  double *coefficient; /* [entries] */
  int *at;             /* [entries]: place in an array [blocks][channels][8] */
  int *odd;            /* [odd_count] rows */
  int odd_count;
} ambulo__row_runs;

/* For lanes of `channels` channels. E_MEMORY. The result is freed also when half built. */
ambulo_status ambulo__row_runs_create(const ambulo__row_table *table, int channels,
                                      const ambulo_allocator *allocator, ambulo__row_runs *out);
void ambulo__row_runs_free(const ambulo_allocator *allocator, ambulo__row_runs *runs);

/* Writes value[row] of every row that is not odd. */
void ambulo__row_runs_values(const ambulo__row_runs *runs, const double *channel, double *value);
/* Adds every row that is not odd, times weight[row], to the adjoints of the channels. */
void ambulo__row_runs_adjoint(const ambulo__row_runs *runs, const double *weight, double *adjoint);

#endif
