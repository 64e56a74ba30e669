/* trajectory/quadrature.h - Gauss-Legendre rule with 8 points on [-1, 1].
 *
 * Exact for polynomials up to degree 15: products of two splines of degree 7. The rule is
 * symmetric; only the positive half is stored (Abramowitz & Stegun, table 25.4). */
#ifndef AMBULO_TRAJECTORY_QUADRATURE_H
#define AMBULO_TRAJECTORY_QUADRATURE_H

#define AMBULO__GAUSS_POINTS 8

/* Point g of the rule, carried to [start, end]: time and weight. */
static inline double ambulo__gauss_time(int g, double start, double end, double *weight) {
  static const double abscissa[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                     0.9602898564975362};
  static const double factor[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                   0.1012285362903763};
  double half = 0.5 * (end - start);
  double side = g < 4 ? abscissa[g] : -abscissa[g - 4];
  *weight = half * factor[g % 4];
  return 0.5 * (start + end) + half * side;
}

#endif
