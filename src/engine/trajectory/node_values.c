/* trajectory/node_values.c - motions given by values at nodes: central differences, and cubic
 * pieces with rates.
 *
 * Central differences: node values with one ghost node at each end.
 *
 * Unknowns q_-1, q_0, ..., q_N, q_N+1 (control point c = node c - 1), h = T / N (s):
 *
 *     qd_i  = (q_i+1 - q_i-1) / (2 h)                                                 (18)
 *     qdd_i = (q_i+1 - 2 q_i + q_i-1) / h^2                                           (19)
 *
 * Between nodes i and i + 1, at t = (i + s) h, the maps are blended (1 - s) : s. The
 * scheme defines no third derivative. */
#include "trajectory/basis.h"

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
                                                                  abscissa};

/* piecewise cubic through node values and node rates.
 *
 * Unknowns q_0, h qd_0, q_1, h qd_1, ..., with h = T / N (s). The seed's unknowns are the
 * rates themselves; scaled by h all unknowns have the unit of q. In interval i, with
 * s = (t - t_i) / h:
 *
 *     q_a(t) = c_0 + c_1 s + c_2 s^2 + c_3 s^3                                        (20)
 *     c_0 = q_i                         c_1 = h qd_i
 *     c_2 = -3 q_i - 2 h qd_i + 3 q_i+1 - h qd_i+1
 *     c_3 =  2 q_i +   h qd_i - 2 q_i+1 + h qd_i+1                                    (21)
 *     qdd_i = q_a''(t_i) = 2 c_2 / h^2                                                (22)
 *
 * The second derivative jumps at nodes: a node takes the interval to its right (22), the
 * last node the one to its left. */

static int hermite_control_points(int degree, int intervals) {
  (void)degree;
  return 2 * (intervals + 1);
}

static int hermite_span(int degree, int intervals) {
  (void)degree;
  (void)intervals;
  return 4;
}

/* (21): rows are c_0..c_3, columns q_i, h qd_i, q_i+1, h qd_i+1 */
static const double coefficient[4][4] = {
    {1, 0, 0, 0}, {0, 1, 0, 0}, {-3, -2, 3, -1}, {2, 1, -2, 1}};

/* (20) (21) (22) cubic of the interval */
static void hermite_at(const ambulo__basis *basis, int interval, double t,
                       ambulo__basis_point *point) {
  double h = basis->duration / basis->intervals;
  double start = basis->breakpoints[interval];
  double s = (t - start) / (basis->breakpoints[interval + 1] - start);
  /* derivatives of the powers of s, with respect to t */
  double power[4][4] = {{1, s, s * s, s * s * s},
                        {0, 1 / h, 2 * s / h, 3 * s * s / h},
                        {0, 0, 2 / (h * h), 6 * s / (h * h)},
                        {0, 0, 0, 6 / (h * h * h)}};
  for (int order = 0; order <= 3; order++) {
    for (int k = 0; k < 4; k++) {
      double sum = 0.0;
      for (int m = 0; m < 4; m++) sum += power[order][m] * coefficient[m][k];
      point->weight[order][k] = sum;
    }
  }
  point->first = point->jerk_first = 2 * interval;
  point->span = point->jerk_span = 4;
}

static double hermite_abscissa(const ambulo__basis *basis, int c, int *is_value) {
  *is_value = c % 2 == 0;
  return basis->breakpoints[c / 2];
}

const ambulo__basis_methods ambulo__hermite_methods = {hermite_control_points, hermite_span,
                                                       hermite_at, hermite_abscissa};
