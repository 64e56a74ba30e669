/* problem/shapes.c - the scalar functions phi(u) that terms are made of.
 *
 *   squared     u^2                                   phi' = 2 u, phi'' = 2
 *   absolute    sqrt(u^2 + s^2) - s                   phi' = u / sqrt(u^2 + s^2)
 *   power law   (u^2 + s^2)^(p/2) - s^p, p >= 2       phi' = p u (u^2 + s^2)^(p/2 - 1)
 *                        phi'' = p (u^2 + s^2)^(p/2 - 1) (1 + (p - 2) u^2 / (u^2 + s^2))
 *
 * The smoothed absolute value tends to |u| as s -> 0 (the seed's Fig. 5b). The curvature
 * handed out for it is phi'(u) / u = 1 / sqrt(u^2 + s^2), that of the parabola which touches
 * phi at u and lies above it everywhere (concavity of sqrt in u^2): reweighted least squares.
 * Written as u^2 / (sqrt(u^2 + s^2) + s), phi loses no digits for small u.
 */
#include "problem/term.h"

#include <math.h>

/* (13.a) u^2 */
ambulo__residual ambulo__squared(double u) {
  ambulo__residual r = {u * u, 2.0 * u, 2.0};
  return r;
}

/* (13.b) sqrt(u^2 + s^2) - s */
ambulo__residual ambulo__absolute(double u, double smoothing) {
  double square = u * u + smoothing * smoothing;
  /* where squares neither overflow nor vanish, which a root is quicker for */
  double root = square > 1e-280 && square < 1e280 ? sqrt(square) : hypot(u, smoothing);
  ambulo__residual r = {u * (u / (root + smoothing)), u / root, 1.0 / root};
  return r;
}

double ambulo__power_least(double power, double smoothing) {
  return power == 3.0 ? smoothing * smoothing * smoothing : pow(smoothing, power);
}

/* (13.d) (u^2 + s^2)^(p/2) - s^p */
ambulo__residual ambulo__power_law(double u, double power, double smoothing, double least) {
  double square = u * u + smoothing * smoothing;
  double lower = power == 3.0 ? sqrt(square) : pow(square, 0.5 * power - 1.0);
  double share = square > 0.0 ? u * u / square : 0.0;
  ambulo__residual r = {square * lower - least, power * u * lower,
                        power * lower * (1.0 + (power - 2.0) * share)};
  return r;
}
