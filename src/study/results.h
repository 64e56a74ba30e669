/* study/results.h - what the cases of a batch folder gave: one table, a row for each case. */
#ifndef AMBULO_STUDY_RESULTS_H
#define AMBULO_STUDY_RESULTS_H

#include "study/batch.h"

/* ------------------------------------------------------------------- outputs.c */

typedef enum ambulo__output_kind {
  AMBULO__OUTPUT_NONE, /* the result has no such thing */
  AMBULO__OUTPUT_NUMBER,
  AMBULO__OUTPUT_TEXT
} ambulo__output_kind;

typedef struct ambulo__output {
  ambulo__output_kind kind;
  double number;
  char text[200]; /* as it is written: also of a number; "": none */
} ambulo__output;

/* Fills value[count] from the folder of a case; what the result does not have is NONE.
 * "audit.violation.worst": a path into summary.json ("objective" alone: its total).
 * "max(tau.knee_angle_r)", min, mean (over time, trapezoids), range: of a column of motion.csv.
 * Errors, which leave value[] as it is: E_IO, E_PARSE, E_SCHEMA (a file that an output is in cannot
 * be read), E_MEMORY. */
ambulo_status ambulo__outputs_of(const char *directory, const char *id, const char *const *output,
                                 int count, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo__output *value);
/* The name that an output without a value most likely means: a key of the case's summary, a
 * column of its motion. 0: nothing near, or a file that could not be read: it is only a hint. */
int ambulo__output_nearest(const char *directory, const char *id, const char *output,
                           const ambulo_allocator *allocator, char *near, size_t size);
/* Fills value, total and solved of a point of a front whose files are intact; weight is set. Errors
 * as of ambulo__outputs_of. */
ambulo_status ambulo__front_read_point(const char *directory, const char *id,
                                       const ambulo__front *front,
                                       const ambulo_allocator *allocator,
                                       ambulo_diagnostics *diagnostics, ambulo__front_point *point);

/* ------------------------------------------------------------------- results.c */

/* Columns behind id, name and state: axes; of a front its terms without their weights, where the
 * point stands, its place, what is better; outputs. */
typedef struct ambulo__table {
  const char *directory;
  ambulo_sweep *study;
  ambulo__front front; /* judged; of no points where the study has none */
  ambulo__front_report report;
  int columns, outputs;   /* of the columns, the last so many */
  const char **title;     /* [columns] */
  ambulo__damage *damage; /* [cases] of a front: what could not be read of a point; "": all could */
} ambulo__table;

/* How much of a case is looked at. */
typedef enum ambulo__depth {
  AMBULO__RECORDS, /* its record alone */
  AMBULO__FILES,   /* every file that the record names: whether it is what was written */
  AMBULO__CELLS    /* and what stands in the columns */
} ambulo__depth;

typedef struct ambulo__row {
  int index;
  const char *id, *name, *state; /* state: of the record, or missing, stale, corrupt */
  int valid;                     /* it has a valid solution */
  const char **cell;             /* [columns]; "": none */
  const ambulo__damage *damage;  /* of a corrupt case, else NULL */
} ambulo__row;

/* Errors: as of ambulo__study_load. close accepts a table that was not opened, zero-filled. With
 * `depth` AMBULO__CELLS a front is read and judged. */
ambulo_status ambulo__table_open(const char *directory, ambulo__depth depth,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo__table *table);
void ambulo__table_close(ambulo__table *table);
/* Calls `take` for each case in order. Stops at the first failure of `take`, or where memory runs
 * out (E_MEMORY): a lack of memory never makes a case missing or corrupt. census (may be NULL) is
 * counted. */
ambulo_status ambulo__table_rows(const ambulo__table *table, ambulo__depth depth,
                                 ambulo_status (*take)(void *user, const ambulo__row *row),
                                 void *user, ambulo_batch_census *census);

/* Warns of a row with damage, which is left out. */
void ambulo__row_warn(const ambulo__table *table, const ambulo__row *row,
                      ambulo_diagnostics *diagnostics);

/* front_run.c: fills the census, and warns of what a reader of the front has to know: gaps that
 * refuse to close, terms that are not at odds, anchors without a solution. E_MEMORY. */
ambulo_status ambulo__front_census(const ambulo__table *table, ambulo_diagnostics *diagnostics,
                                   ambulo_front_census *census);

#endif
