/* mechanics/kernel_sincos.h - sine and cosine, lane by lane.
 *
 * x = n pi + r with n the nearest whole number, |r| <= pi/2 (Cody & Waite 1980), so that both only
 * change sign with n: pi is split into 33 + 53 bits, and n times the first part is exact for
 * |n| < 2^20. With z = r^2,
 *   sin r = r + r z P(z),   cos r = 1 - z (1/2 - z Q(z))
 * P and Q of degree 7 and 6 interpolate at Chebyshev nodes; the error of the approximation is below
 * 1e-16. With the rounding of the sums the results are within 4e-16 for |x| <= 1e5
 * (AMBULO__SINCOS_LIMIT); callers look after that. It is the absolute error that counts, since
 * sines and cosines are the entries of orientations: a cosine next to zero does not have all its
 * digits, and in return nothing is exchanged between the two, which costs as much as six terms.
 *
 * n is rounded by adding 1.5 2^52, which leaves it in the low bits of the sum. Angles below sqrt 2
 * need none of this: n is zero, and r is the angle.
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

/* Angles in step, so that none waits for its own chain of multiply-adds. */
enum { sincos_row = AMBULO__WIDTH == AMBULO__LANES ? 4 : 2 };

/* sin r and cos r of `count` angles (known when this is compiled), z = r^2. */
AMBULO__INLINE void sincos_series(int count, const wide *r, const wide *z, wide *sine,
                                  wide *cosine) {
  static const double sines[] = {-7.643970284729239e-13,  1.6058977312086063e-10,
                                 -2.5052107616990352e-08, 2.7557319219163188e-06,
                                 -0.00019841269841254974, 0.008333333333333316,
                                 -0.16666666666666666};
  static const double cosines[] = {-1.1466252242734283e-11, 2.087668155843873e-09,
                                   -2.7557318573361236e-07, 2.4801587298913527e-05,
                                   -0.0013888888888884767,  0.04166666666666666};
  for (int i = 0; i < count; i++) {
    sine[i] = z[i] * 2.7314446164953908e-15 + sines[0];
    cosine[i] = z[i] * 4.6464357088430017e-14 + cosines[0];
  }
  for (int k = 1; k <= 6; k++) {
    for (int i = 0; i < count; i++) sine[i] = sine[i] * z[i] + sines[k];
    for (int i = 0; i < count && k < 6; i++) cosine[i] = cosine[i] * z[i] + cosines[k];
  }
  for (int i = 0; i < count; i++) {
    sine[i] = r[i] + (r[i] * z[i]) * sine[i];
    cosine[i] = 1.0 - z[i] * (0.5 - z[i] * cosine[i]);
  }
}

AMBULO__INLINE void sincos_reduced(int count, const wide *x, wide *sine, wide *cosine) {
  const double shift = 0x1.8p52;
  wide sum[sincos_row], r[sincos_row], z[sincos_row];
  for (int i = 0; i < count; i++) {
    sum[i] = x[i] * 0.3183098861837907 + shift;
    wide n = sum[i] - shift;
    r[i] = (x[i] - n * 3.1415926534682512) - n * 1.2154201013012384e-10;
    z[i] = r[i] * r[i];
  }
  sincos_series(count, r, z, sine, cosine);
  for (int i = 0; i < count; i++) {
    wide_bits sign = (wide_bits)sum[i] << 63;
    sine[i] = (wide)((wide_bits)sine[i] ^ sign);
    cosine[i] = (wide)((wide_bits)cosine[i] ^ sign);
  }
}

/* Whether all angles whose squares are z[0] to z[count - 1] are below sqrt 2: doubles below 2 have
 * bit 62 clear. */
AMBULO__INLINE int sincos_small(int count, const wide *z) {
  wide_bits any = {0};
  int64_t bits = 0;
  for (int i = 0; i < count; i++) any |= (wide_bits)z[i];
  for (int lane = 0; lane < AMBULO__WIDTH; lane++) bits |= any[lane];
  return (bits >> 62) == 0;
}

#endif
