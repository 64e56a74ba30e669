/* tests/trajectory/basis_fixture.h - bases under test and curves to hold them against. */
#ifndef AMBULO_TESTS_BASIS_FIXTURE_H
#define AMBULO_TESTS_BASIS_FIXTURE_H

#include "support/test.h"
#include "trajectory/basis.h"

/* breakpoints of very different spacing on [0, 2] */
static const double uneven_knots[6] = {0.0, 0.1, 0.7, 0.75, 1.6, 2.0};

static inline ambulo__basis *make_basis(ambulo__basis_kind kind, int degree, int intervals,
                                        double duration, const double *knots) {
  ambulo__basis *basis = NULL;
  ambulo_status status =
      ambulo__basis_create(kind, degree, intervals, duration, knots, NULL, &basis);
  assert_int_equal(status, AMBULO_OK);
  return basis;
}

/* D^order of the single curve with control points x at t */
static inline double curve(const ambulo__basis *basis, const double *x, double t, int order) {
  ambulo__basis_point point;
  ambulo__basis_at(basis, t, &point);
  int first = order == 3 ? point.jerk_first : point.first;
  int span = order == 3 ? point.jerk_span : point.span;
  double sum = 0.0;
  for (int k = 0; k < span; k++) sum += point.weight[order][k] * x[first + k];
  return sum;
}

/* the same numbers on every machine, in [-1, 1] */
static inline void fill_pseudo_random(double *x, int count, unsigned seed) {
  unsigned state = seed * 2654435761u + 12345u;
  for (int i = 0; i < count; i++) {
    state = state * 1664525u + 1013904223u;
    x[i] = (double)(state >> 8) / 8388608.0 - 1.0;
  }
}

#endif
