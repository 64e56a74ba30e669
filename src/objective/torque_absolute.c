/* objective/torque_absolute.c - smoothed absolute torque (the seed's Fig. 5b).
 *
 *     phi(u) = sqrt(u^2 + s^2) - s,   phi' = u / sqrt(u^2 + s^2)
 *
 * tends to |u| as s -> 0; s > 0 keeps it smooth at u = 0. The curvature handed out is
 * phi'(u) / u = 1 / sqrt(u^2 + s^2), that of the parabola which touches phi at u and
 * lies above it everywhere (concavity of sqrt in u^2): reweighted least squares. The
 * true phi'' = s^2 / (u^2 + s^2)^(3/2) nearly vanishes away from 0.
 *
 * Written as u^2 / (sqrt(u^2 + s^2) + s), phi loses no digits for small u.
 */
#include "objective/term.h"

#include <math.h>

ambulo__residual ambulo__torque_absolute(double u, double smoothing) {
  double root = hypot(u, smoothing);
  ambulo__residual r = {u * (u / (root + smoothing)), u / root, 1.0 / root};
  return r;
}
