/* problem/joint_curves.c - torques of joints as functions of their angle.
 *
 *   passive torque   b1 exp(k1 q) + b2 exp(k2 q), N m
 *   strength         peak cos(c2 (q - c3)), N m; below a tenth of the peak it bends over to
 *                    stay positive: with x = cos(..), y = x for x >= 0.1 and
 *                    y = 0.1 exp((x - 0.1) / 0.1) below (value and slope continuous)
 *
 * Source: Anderson, Madigan & Nussbaum, J Biomech 40 (2007) 3105-3113, Eqs. 1-2; the bend
 * is ours, because the cosine turns negative at angles that were never measured.
 */
#include "problem/term.h"

#include <math.h>

static const double least_share = 0.1;

/* (13.e) passive torque */
double ambulo__passive_torque(const double curve[4], double q, double *derivative) {
  double first = curve[0] * exp(curve[1] * q), second = curve[2] * exp(curve[3] * q);
  *derivative = curve[1] * first + curve[3] * second;
  return first + second;
}

/* (13.e) strength at an angle and a rate */
double ambulo__strength(const double curve[3], double q, double *derivative) {
  double angle = curve[1] * (q - curve[2]);
  double share = cos(angle), slope = -curve[1] * sin(angle);
  if (share < least_share) {
    share = least_share * exp((share - least_share) / least_share);
    slope *= share / least_share;
  }
  *derivative = curve[0] * slope;
  return curve[0] * share;
}
