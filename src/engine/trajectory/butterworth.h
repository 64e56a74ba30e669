/* trajectory/butterworth.h - low-pass Butterworth filter without phase shift. */
#ifndef AMBULO_TRAJECTORY_BUTTERWORTH_H
#define AMBULO_TRAJECTORY_BUTTERWORTH_H

#include "base/alloc.h"

#define AMBULO__FILTER_MOST_ORDER 8

/* Filters every column of values[rows][columns] in place. rate: rows per second; cutoff: Hz, where
 * the gain of the whole filter is 1/sqrt(2) (-3 dB), 0 < cutoff < rate / 2; order: of the whole
 * filter, 2, 4, 6 or 8: half of it forward, half of it backward in time. At least 2 rows.
 * Errors: E_ARGUMENT, E_MEMORY (values as they were). */
ambulo_status ambulo__butterworth(double *values, int rows, int columns, double rate, double cutoff,
                                  int order, const ambulo_allocator *allocator);

#endif
