/* trajectory/hermite.c - piecewise cubic through node values and node rates.
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
#include "trajectory/basis_methods.h"

static int control_points(int degree, int intervals) {
  (void)degree;
  return 2 * (intervals + 1);
}

static int span(int degree, int intervals) {
  (void)degree;
  (void)intervals;
  return 4;
}

/* (21): rows are c_0..c_3, columns q_i, h qd_i, q_i+1, h qd_i+1 */
static const double coefficient[4][4] = {
    {1, 0, 0, 0}, {0, 1, 0, 0}, {-3, -2, 3, -1}, {2, 1, -2, 1}};

/* (20) (21) (22) cubic of the interval */
static void at(const ambulo__basis *basis, int interval, double t, ambulo__basis_point *point) {
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

static double abscissa(const ambulo__basis *basis, int c, int *is_value) {
  *is_value = c % 2 == 0;
  return basis->breakpoints[c / 2];
}

const ambulo__basis_methods ambulo__hermite_methods = {control_points, span, at, abscissa, NULL};
