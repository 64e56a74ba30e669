/* study/outputs.h - one collected output of a result folder.
 *
 * "audit.violation.worst": a path into summary.json ("objective" alone: its total).
 * "max(tau.knee_angle_r)", min, mean (over time, trapezoids), range: of a column of motion.csv. */
#ifndef AMBULO_STUDY_OUTPUTS_H
#define AMBULO_STUDY_OUTPUTS_H

#include "base/alloc.h"
#include "base/diagnostics.h"

typedef enum ambulo__output_kind {
  AMBULO__OUTPUT_NONE, /* the result has no such thing */
  AMBULO__OUTPUT_NUMBER,
  AMBULO__OUTPUT_TEXT
} ambulo__output_kind;

typedef struct ambulo__output {
  ambulo__output_kind kind;
  double number;
  char text[200]; /* as it is written: also of a number */
} ambulo__output;

/* Fills value[count] from the folder of a case; what the result does not have is NONE. Errors,
 * which leave value[] as it is: E_IO, E_PARSE, E_SCHEMA (a file that an output is in cannot be
 * read), E_MEMORY. */
ambulo_status ambulo__outputs_of(const char *directory, const char *id, char *const *output,
                                 int count, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo__output *value);

/* The name that an output without a value most likely means: a key of the case's summary, a
 * column of its motion. 0: nothing near, or a file that could not be read: it is only a hint. */
int ambulo__output_nearest(const char *directory, const char *id, const char *output,
                           const ambulo_allocator *allocator, char *near, size_t size);

#endif
