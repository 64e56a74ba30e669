/* trajectory/central_difference.c - node values with one ghost node at each end.
 *
 * Unknowns q_-1, q_0, ..., q_N, q_N+1 (control point c = node c - 1), h = T / N (s):
 *
 *     qd_i  = (q_i+1 - q_i-1) / (2 h)                                                 (18)
 *     qdd_i = (q_i+1 - 2 q_i + q_i-1) / h^2                                           (19)
 *
 * Between nodes i and i + 1, at t = (i + s) h, the maps are blended (1 - s) : s. The
 * scheme defines no third derivative. */
#include "trajectory/basis_methods.h"

static int control_points(int degree, int intervals) {
  (void)degree;
  return intervals + 3;
}

static int span(int degree, int intervals) {
  (void)degree;
  (void)intervals;
  return 4;
}

/* adds `factor` times the map of the node whose control points start at w[0] */
static void add_node(double factor, double h, int offset, ambulo__basis_point *point) {
  point->weight[0][offset + 1] += factor;
  point->weight[1][offset] -= factor / (2.0 * h);
  point->weight[1][offset + 2] += factor / (2.0 * h);
  point->weight[2][offset] += factor / (h * h);
  point->weight[2][offset + 1] -= 2.0 * factor / (h * h);
  point->weight[2][offset + 2] += factor / (h * h);
}

/* (18) (19) differences of the neighbours */
static void at(const ambulo__basis *basis, int interval, double t, ambulo__basis_point *point) {
  double h = basis->duration / basis->intervals;
  double start = basis->breakpoints[interval];
  double s = t == start ? 0.0 : (t - start) / (basis->breakpoints[interval + 1] - start);
  if (s < 1.0) add_node(1.0 - s, h, 0, point);
  if (s > 0.0) add_node(s, h, 1, point);
  point->first = interval;
  point->span = 4;
}

static double abscissa(const ambulo__basis *basis, int c, int *is_value) {
  double h = basis->duration / basis->intervals;
  *is_value = 1;
  return h * (c - 1);
}

const ambulo__basis_methods ambulo__central_difference_methods = {control_points, span, at,
                                                                  abscissa, NULL};
