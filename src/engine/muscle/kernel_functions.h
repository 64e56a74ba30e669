/* muscle/kernel_functions.h - comparisons, exponentials and logarithms, lane by lane.
 *
 * e^x: x = n ln 2 + r with n the nearest whole number, |r| <= 0.347, and the series of e^r to
 * r^13; ln 2 is split into 33 + 53 bits, so that n times the first part is exact. Within 2e-16 of
 * e^x for |x| <= 700, where x is held.
 * ln x, x >= 1 and below 2^1023: x = 2^n m with m in [sqrt(1/2), sqrt 2), ln m = 2 atanh z with
 * z = (m - 1) / (m + 1), |z| <= 0.172, by its series to z^21.
 */
#ifndef AMBULO_MUSCLE_KERNEL_FUNCTIONS_H
#define AMBULO_MUSCLE_KERNEL_FUNCTIONS_H

#include "mechanics/kernel_wide.h"

AMBULO__INLINE wide choose(wide_bits which, wide yes, wide no) {
  return (wide)((which & (wide_bits)yes) | (~which & (wide_bits)no));
}

AMBULO__INLINE int any(wide_bits which) {
  int64_t bits = 0;
  for (int lane = 0; lane < AMBULO__WIDTH; lane++) bits |= which[lane];
  return bits != 0;
}

/* Masks. On processors without a blend (two lanes) gcc 12 fails on the comparison of vectors. */
AMBULO__INLINE wide_bits below(wide a, wide b) {
#if AMBULO__WIDTH == 2
  return (wide_bits){-(int64_t)(a[0] < b[0]), -(int64_t)(a[1] < b[1])};
#else
  return (wide_bits)(a < b);
#endif
}

AMBULO__INLINE wide absolute(wide x) {
  return (wide)((wide_bits)x & INT64_MAX);
}

AMBULO__INLINE wide larger(wide a, wide b) {
  return choose(below(a, b), b, a);
}

AMBULO__INLINE wide smaller(wide a, wide b) {
  return choose(below(b, a), b, a);
}

AMBULO__INLINE wide exponential(wide x) {
  const double shift = 0x1.8p52;
  static const double series[] = {1.0 / 479001600,
                                  1.0 / 39916800,
                                  1.0 / 3628800,
                                  1.0 / 362880,
                                  1.0 / 40320,
                                  1.0 / 5040,
                                  1.0 / 720,
                                  1.0 / 120,
                                  1.0 / 24,
                                  1.0 / 6,
                                  0.5,
                                  1.0,
                                  1.0};
  x = smaller(larger(x, spread(-700.0)), spread(700.0));
  wide sum = x * 1.4426950408889634 + shift, n = sum - shift;
  wide r = (x - n * 0.69314718036912382) - n * 1.9082149292705877e-10;
  wide y = spread(1.0 / 6227020800);
  for (int k = 0; k < 13; k++) y = y * r + series[k];
  wide_bits exponent = ((wide_bits)sum - (wide_bits)spread(shift) + 1023) << 52;
  return y * (wide)exponent;
}

AMBULO__INLINE wide logarithm(wide x) {
  const double shift = 0x1.8p52;
  wide_bits n = (((wide_bits)x >> 52) & 2047) - 1022;
  wide m = (wide)(((wide_bits)x & 0xfffffffffffffLL) | 0x3fe0000000000000LL);
  wide_bits low = below(m, spread(0.70710678118654752));
  m = choose(low, m * 2.0, m);
  n = n + low; /* a mask is -1 */
  wide z = (m - 1.0) / (m + 1.0), zz = z * z, sum = spread(1.0 / 21.0);
  for (int k = 19; k > 0; k -= 2) sum = sum * zz + 1.0 / k;
  wide whole = (wide)((wide_bits)spread(shift) + n) - shift;
  return 2.0 * z * sum + whole * 0.69314718055994531;
}

#endif
