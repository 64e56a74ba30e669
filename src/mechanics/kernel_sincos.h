/* mechanics/kernel_sincos.h - sine and cosine, lane by lane.
 *
 * x = n pi + r with n the nearest whole number, |r| <= pi/2 (Cody & Waite 1980), so that both only
 * change sign with n: pi is split into 33 + 53 bits, n times the first part is exact for |n| <
 * 2^20. With z = r^2, sin r = r + r z P(z),   cos r = 1 - z (1/2 - z Q(z)) P and Q of degree 7 and
 * 6 interpolate at Chebyshev nodes; the error of the approximation is below 1e-16. With the
 * rounding of the sums the results are within 4e-16 for |x| <= 1e5 (AMBULO__SINCOS_LIMIT); callers
 * look after that. It is the absolute error that counts, since sines and cosines are the entries of
 * orientations: a cosine next to zero does not have all its digits, and in return nothing is
 * exchanged between the two, which costs as much as six terms.
 *
 * n is rounded by adding 1.5 2^52, which leaves it in the low bits of the sum.
 */
#ifndef AMBULO_MECHANICS_KERNEL_SINCOS_H
#define AMBULO_MECHANICS_KERNEL_SINCOS_H

#include "mechanics/kernel_wide.h"

#define AMBULO__SINCOS_LIMIT 1e5

/* Whether angles whose squares sum up to `squares` are all in the range; a NaN or an infinity among
 * them shows, too. */
AMBULO__INLINE int sincos_inside(wide squares) {
  const double limit = AMBULO__SINCOS_LIMIT * AMBULO__SINCOS_LIMIT;
  int inside = 1;
  for (int lane = 0; lane < AMBULO__WIDTH; lane++) inside &= squares[lane] <= limit;
  return inside;
}

AMBULO__INLINE void sincos_wide(wide x, wide *sine, wide *cosine) {
  const double shift = 0x1.8p52;
  wide sum = x * 0.3183098861837907 + shift;
  wide n = sum - shift;
  wide r = (x - n * 3.1415926534682512) - n * 1.2154201013012384e-10;
  wide z = r * r;
  wide p = z * 2.7314446164953908e-15 - 7.643970284729239e-13;
  p = p * z + 1.6058977312086063e-10;
  p = p * z - 2.5052107616990352e-08;
  p = p * z + 2.7557319219163188e-06;
  p = p * z - 0.00019841269841254974;
  p = p * z + 0.008333333333333316;
  p = p * z - 0.16666666666666666;
  wide q = z * 4.6464357088430017e-14 - 1.1466252242734283e-11;
  q = q * z + 2.087668155843873e-09;
  q = q * z - 2.7557318573361236e-07;
  q = q * z + 2.4801587298913527e-05;
  q = q * z - 0.0013888888888884767;
  q = q * z + 0.04166666666666666;
  wide s = r + (r * z) * p;
  wide c = 1.0 - z * (0.5 - z * q);
  wide_bits sign = (wide_bits)sum << 63;
  *sine = (wide)((wide_bits)s ^ sign);
  *cosine = (wide)((wide_bits)c ^ sign);
}

#endif
