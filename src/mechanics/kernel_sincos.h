/* mechanics/kernel_sincos.h - sine and cosine, lane by lane.
 *
 * x = n pi/2 + r with n the nearest whole number, |r| <= pi/4 (Cody & Waite 1980): pi/2 is split
 * into 33 + 33 + 53 bits, so that n times the first two parts is exact for |n| < 2^20, and the
 * rounding of the second subtraction is carried into the third. On the reduced range, with
 * z = r^2,
 *   sin r = r + r z P(z),   cos r = 1 - z (1/2 - z Q(z))
 * P and Q of degree 5 interpolate at Chebyshev nodes; the error of the approximation is below
 * 2^-56. With the rounding of the sums the results are within 2 units in the last place for
 * |x| <= 1e5 (AMBULO__SINCOS_LIMIT); callers look after that.
 *
 * n is rounded by adding 1.5 2^52, which leaves it in the low bits of the sum.
 */
#ifndef AMBULO_MECHANICS_KERNEL_SINCOS_H
#define AMBULO_MECHANICS_KERNEL_SINCOS_H

#include "mechanics/kernel_wide.h"

#define AMBULO__SINCOS_LIMIT 1e5

AMBULO__INLINE wide magnitude(wide x) {
  return (wide)((wide_bits)x & INT64_MAX);
}

AMBULO__INLINE wide_bits pick(wide_bits mask, wide a, wide b) {
  return (mask & (wide_bits)a) | (~mask & (wide_bits)b);
}

AMBULO__INLINE void sincos_wide(wide x, wide *sine, wide *cosine) {
  const double shift = 0x1.8p52;
  wide sum = x * 0.6366197723675814 + shift;
  wide n = sum - shift;
  wide_bits quadrant = (wide_bits)sum;
  wide a = x - n * 1.5707963267341256;
  wide b = a - n * 6.077100506303966e-11;
  wide r = b + (((a - b) - n * 6.077100506303966e-11) - n * 2.0222662487959506e-21);
  wide z = r * r;
  wide p = z * 1.591810123027412e-10 - 2.5051131455427946e-08;
  p = p * z + 2.755731610068303e-06;
  p = p * z - 0.0001984126983675497;
  p = p * z + 0.008333333333330946;
  p = p * z - 0.16666666666666666;
  wide q = z * -1.1382614868556325e-11 + 2.0876146024689747e-09;
  q = q * z - 2.7557317270560326e-07;
  q = q * z + 2.4801587298763433e-05;
  q = q * z - 0.0013888888888887395;
  q = q * z + 0.041666666666666664;
  wide s = r + (r * z) * p;
  wide c = 1.0 - z * (0.5 - z * q);
  wide_bits odd = -(quadrant & 1), sine_sign = quadrant << 62, cosine_sign = (quadrant + 1) << 62;
  *sine = (wide)(pick(odd, c, s) ^ (sine_sign & INT64_MIN));
  *cosine = (wide)(pick(odd, s, c) ^ (cosine_sign & INT64_MIN));
}

#endif
