/* trajectory/bspline.c - clamped B-splines, degree p = 3..7 (Eq. 23).
 *
 *     q(t) = sum_j N_j,p(t) P_j,   n = intervals + p control points P_j
 *
 * Knots u_0 = ... = u_p = 0, then the inner breakpoints, then u_n = ... = u_n+p = T (s).
 * The seed writes N_j,4 for the cubic: its second index is the order p + 1.
 *
 * Cox-de Boor, degree k from degree k - 1 on u_s <= t < u_s+1 (only j = s-k..s differ
 * from zero):
 *
 *     N_j,k  = (t - u_j) / (u_j+k - u_j) N_j,k-1
 *            + (u_j+k+1 - t) / (u_j+k+1 - u_j+1) N_j+1,k-1                            (a)
 *     DN_j,k = k / (u_j+k - u_j) N_j,k-1 - k / (u_j+k+1 - u_j+1) N_j+1,k-1           (b)
 *
 * (b) stays true when both sides are differentiated further, so D^o N_j,p takes p - o
 * steps of (a) and then o steps of (b). On a breakpoint the factor t - u_s = 0 makes the
 * last weight of orders 0 .. p - 1 exactly zero.
 */
#include "trajectory/basis.h"

static int control_points(int degree, int intervals) {
  return intervals + degree;
}

static int span(int degree, int intervals) {
  (void)intervals;
  return degree + 1;
}

/* (23): degree k - 1 -> k, in place: w[0..k-1] hold j = s-k+1..s, afterwards w[0..k] j = s-k..s */
static void raise_degree(const double *knots, int s, int k, double t, int differentiate,
                         double *w) {
  w[k] = 0.0;
  for (int i = k; i >= 0; i--) {
    int j = s - k + i;
    /* own = N_j,k-1 (absent for i = 0), next = N_j+1,k-1 (absent for i = k) */
    double own = i > 0 ? w[i - 1] / (knots[j + k] - knots[j]) : 0.0;
    double next = i < k ? w[i] / (knots[j + k + 1] - knots[j + 1]) : 0.0;
    w[i] = differentiate ? k * (own - next) : (t - knots[j]) * own + (knots[j + k + 1] - t) * next;
  }
}

/* (23) N_j,p from N_j,p-1 */
static void at(const ambulo__basis *basis, int interval, double t, ambulo__basis_point *point) {
  int p = basis->degree;
  int s = p + interval;
  for (int order = 0; order <= 3; order++) {
    double *w = point->weight[order];
    w[0] = 1.0;
    for (int k = 1; k <= p; k++) raise_degree(basis->knots, s, k, t, k > p - order, w);
  }
  point->first = point->jerk_first = interval;
  point->span = point->jerk_span = p + 1;
}

/* Greville abscissa: mean of the inner knots of N_c,p; a spline with P_c = that is q = t */
static double abscissa(const ambulo__basis *basis, int c, int *is_value) {
  double sum = 0.0;
  for (int k = 1; k <= basis->degree; k++) sum += basis->knots[c + k];
  *is_value = 1;
  return sum / basis->degree;
}

const ambulo__basis_methods ambulo__bspline_methods = {control_points, span, at, abscissa};
