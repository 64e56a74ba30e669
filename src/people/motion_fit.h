/* people/motion_fit.h - a smooth curve through a sampled motion, with its rates.
 *
 * Inverse dynamics of a measured motion needs qd and qdd: each column is fitted by a spline
 * of degree 3 or 5, which interpolates the samples or smooths them. */
#ifndef AMBULO_PEOPLE_MOTION_FIT_H
#define AMBULO_PEOPLE_MOTION_FIT_H

#include "base/diagnostics.h"
#include "formats/motion_file.h"
#include "trajectory/basis.h"

typedef struct ambulo__motion_fit ambulo__motion_fit;

/* degree 3 or 5; at least degree + 1 rows. cutoff = 0 interpolates; cutoff > 0 (Hz) smooths:
 * a sine of that frequency keeps half its amplitude, slower ones nearly all.
 * Errors: E_ARGUMENT (degree, rows, cutoff, times not increasing), E_MEMORY, E_NUMERIC. */
ambulo_status ambulo__motion_fit_create(const ambulo__motion *motion, int degree, double cutoff,
                                        const ambulo_allocator *allocator,
                                        ambulo__motion_fit **fit);
void ambulo__motion_fit_free(ambulo__motion_fit *fit); /* accepts NULL */

/* The curves at times[count] (the motion's own clock; clamped to its range):
 * q, qd, qdd [count][columns], each may be NULL. */
void ambulo__motion_fit_at(const ambulo__motion_fit *fit, const double *times, int count, double *q,
                           double *qd, double *qdd);

/* A low-pass filter that a user asked for, on the rows of a file. */
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
