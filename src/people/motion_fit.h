/* people/motion_fit.h - a smooth curve through a sampled motion, with its rates.
 *
 * Inverse dynamics of a measured motion needs qd and qdd: each column is fitted by a spline
 * of degree 3 or 5, which interpolates the samples or smooths them. */
#ifndef AMBULO_PEOPLE_MOTION_FIT_H
#define AMBULO_PEOPLE_MOTION_FIT_H

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

#endif
