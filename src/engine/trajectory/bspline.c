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
 *
 * Tangents (a dot) when t and the knots move: with m = N_j,k-1 / (u_j+k - u_j),
 *
 *     m. = (N_j,k-1. - m (u_j+k. - u_j.)) / (u_j+k - u_j),
 *     (a). = (t. - u_j.) m_j + (t - u_j) m_j. + (u_j+k+1. - t.) m_j+1 + (u_j+k+1 - t) m_j+1.,
 *     (b). = k (m_j. - m_j+1.)                                                        (c)
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

/* t and the knots that matter on one interval, with what they move by */
typedef struct moving {
  const double *knots;
  double t, rate, knot_rate[2 * AMBULO__MAX_DEGREE]; /* [i]: of knot first + i */
  int first, s;
} moving;

static moving moving_at(const ambulo__basis *basis, int interval, double t, double rate,
                        const double *breakpoint_rates) {
  int p = basis->degree;
  moving m = {
      .knots = basis->knots, .t = t, .rate = rate, .first = interval + 1, .s = p + interval};
  for (int i = 0; breakpoint_rates && i < 2 * p; i++) {
    int b = interval + 1 + i - p;
    m.knot_rate[i] = b <= 0 || b >= basis->intervals ? 0.0 : breakpoint_rates[b];
  }
  return m;
}

static int is_still(const moving *m, int degree) {
  int still = m->rate == 0.0;
  for (int i = 0; i < 2 * degree; i++) still &= m->knot_rate[i] == 0.0;
  return still;
}

/* N_j,k-1 over its knots' distance, and the tangent of that */
static double share(const moving *m, int j, int k, double n, double n_rate, double *rate) {
  double distance = m->knots[j + k] - m->knots[j], value = n / distance;
  double stretch = m->knot_rate[j + k - m->first] - m->knot_rate[j - m->first];
  *rate = (n_rate - value * stretch) / distance;
  return value;
}

/* (c): raise_degree with the tangents */
static void raise_both(const moving *m, int k, int differentiate, double *w, double *w_rate) {
  w[k] = w_rate[k] = 0.0;
  for (int i = k; i >= 0; i--) {
    int j = m->s - k + i;
    double own = 0.0, own_rate = 0.0, next = 0.0, next_rate = 0.0;
    if (i > 0) own = share(m, j, k, w[i - 1], w_rate[i - 1], &own_rate);
    if (i < k) next = share(m, j + 1, k, w[i], w_rate[i], &next_rate);
    w[i] = k * (own - next);
    w_rate[i] = k * (own_rate - next_rate);
    if (differentiate) continue;
    w[i] = w_rate[i] = 0.0;
    if (i > 0) {
      w[i] += (m->t - m->knots[j]) * own;
      w_rate[i] += (m->rate - m->knot_rate[j - m->first]) * own + (m->t - m->knots[j]) * own_rate;
    }
    if (i < k) {
      double left = m->knots[j + k + 1] - m->t;
      w[i] += left * next;
      w_rate[i] += (m->knot_rate[j + k + 1 - m->first] - m->rate) * next + left * next_rate;
    }
  }
}

/* (23) by what moves t and the breakpoints */
static void tangent(const ambulo__basis *basis, int interval, double t, double rate,
                    const double *breakpoint_rates, ambulo__basis_point *out) {
  int p = basis->degree;
  moving m = moving_at(basis, interval, t, rate, breakpoint_rates);
  for (int order = 0; order <= 2 && !is_still(&m, p); order++) {
    double w[AMBULO__MAX_SPAN] = {1.0};
    for (int k = 1; k <= p; k++) raise_both(&m, k, k > p - order, w, out->weight[order]);
  }
  out->first = interval;
  out->span = p + 1;
}

/* Greville abscissa: mean of the inner knots of N_c,p; a spline with P_c = that is q = t */
static double abscissa(const ambulo__basis *basis, int c, int *is_value) {
  double sum = 0.0;
  for (int k = 1; k <= basis->degree; k++) sum += basis->knots[c + k];
  *is_value = 1;
  return sum / basis->degree;
}

const ambulo__basis_methods ambulo__bspline_methods = {control_points, span, at, abscissa, tangent};
