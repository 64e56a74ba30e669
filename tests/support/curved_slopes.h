/* tests/support/curved_slopes.h - slopes of rows that are not linear, by differences. */
#ifndef AMBULO_TESTS_CURVED_SLOPES_H
#define AMBULO_TESTS_CURVED_SLOPES_H

#include "contact/curved.h"

#include <stddef.h>

/* central difference of the row's value by channel c; y is as before */
static inline double slope_by_difference(const ambulo__curved *row, double *y, int c, double h) {
  const double here = y[c];
  y[c] = here + h;
  double more = ambulo__curved_value(row, y, 1, NULL);
  y[c] = here - h;
  double less = ambulo__curved_value(row, y, 1, NULL);
  y[c] = here;
  return (more - less) / (2.0 * h);
}

#endif
