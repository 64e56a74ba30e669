/* trajectory/basis_methods.h - what each discretization supplies behind basis.h. */
#ifndef AMBULO_TRAJECTORY_BASIS_METHODS_H
#define AMBULO_TRAJECTORY_BASIS_METHODS_H

#include "trajectory/basis.h"

typedef struct ambulo__basis_methods {
  int (*control_points)(int degree, int intervals);
  int (*span)(int degree, int intervals);
  /* The map at t, which lies in interval `interval` (t == breakpoint[interval] when it
   * stands on one). *point is cleared; all weights from point->first on, untrimmed. */
  void (*at)(const ambulo__basis *basis, int interval, double t, ambulo__basis_point *point);
  double (*abscissa)(const ambulo__basis *basis, int c, int *is_value);
  /* Orders 0..2 of the map's tangent; rates of the breakpoints may be NULL, for zero. NULL: of
   * other discretizations. */
  void (*tangent)(const ambulo__basis *basis, int interval, double t, double rate,
                  const double *breakpoint_rates, ambulo__basis_point *tangent);
} ambulo__basis_methods;

extern const ambulo__basis_methods ambulo__bspline_methods;
extern const ambulo__basis_methods ambulo__central_difference_methods;
extern const ambulo__basis_methods ambulo__hermite_methods;

struct ambulo__basis {
  ambulo_allocator allocator;
  const ambulo__basis_methods *methods;
  ambulo__basis_kind kind;
  int degree, intervals, control_points, span;
  double duration;     /* s */
  double *breakpoints; /* [intervals + 1], s */
  double *knots;       /* B-spline: clamped, [intervals + 1 + 2 degree]; NULL otherwise */
};

#endif
