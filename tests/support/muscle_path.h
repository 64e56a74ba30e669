/* tests/support/muscle_path.h - a muscle's length and its slopes, term by term. */
#ifndef AMBULO_TESTS_MUSCLE_PATH_H
#define AMBULO_TESTS_MUSCLE_PATH_H

#include "ambulo/muscles.h"

#include <math.h>

/* by: the index among the muscle's coordinates of the slope, m/rad; -1: the length itself, m */
static inline double path_of(const ambulo_muscle *m, const double *q, int by) {
  double sum = 0.0;
  for (int t = 0; t < m->term_count; t++) {
    double term = m->length[t];
    for (int i = 0; i < m->coordinate_count; i++) {
      int e = m->exponents[t][i];
      if (i == by) term *= e == 0 ? 0.0 : e * pow(q[m->coordinates[i]], e - 1);
      if (i != by) term *= pow(q[m->coordinates[i]], e);
    }
    sum += term;
  }
  return sum;
}

#endif
