/* people/filtering.h - a low-pass filter that a user asked for, on the rows of a file. */
#ifndef AMBULO_PEOPLE_FILTERING_H
#define AMBULO_PEOPLE_FILTERING_H

#include "base/alloc.h"
#include "base/diagnostics.h"

typedef struct ambulo__filtering {
  const double *time; /* [rows], in units of time_unit seconds */
  int rows;
  double time_unit;
  double cutoff;             /* Hz */
  int order;                 /* of the whole filter (trajectory/butterworth.h) */
  const char *option, *file; /* for messages */
  ambulo_diagnostics *diagnostics;
} ambulo__filtering;

/* Filters values[rows][columns]. Rows must be equally spaced, but for rounding of the times (a
 * tenth of a step), and the cut-off below half their rate. Errors: E_SCHEMA, E_MEMORY. */
ambulo_status ambulo__filter(const ambulo__filtering *filtering, double *values, int columns,
                             const ambulo_allocator *allocator);

#endif
