/* base/worst.h - the worst of many numbers, without losing the worst kind.
 *
 * fmax(a, NaN) is a, and a > NaN is false: a norm or a worst-of written with either passes a
 * NaN for zero. House rule: norms and worst-ofs go through these.
 */
#ifndef AMBULO_BASE_WORST_H
#define AMBULO_BASE_WORST_H

#include <math.h>
#include <stddef.h>

/* The larger of the two; NaN when either is. */
static inline double ambulo__worse(double a, double b) {
  return a > b || isnan(a) ? a : b;
}

/* Is b worse than the worst so far, a? NaN is worse than any number, and nothing is worse. */
static inline int ambulo__is_worse(double a, double b) {
  return !isnan(a) && !(b <= a);
}

/* Largest |v[i]|, 0 for none; NaN when one is. */
static inline double ambulo__largest(const double *v, size_t count) {
  double worst = 0.0;
  for (size_t i = 0; i < count; i++) worst = ambulo__worse(worst, fabs(v[i]));
  return worst;
}

/* 1 when every v[i] is finite: x * 0 is NaN for what is not. Eight sums side by side, since one
 * waits for itself. */
static inline int ambulo__all_finite(const double *v, size_t count) {
  double sum[8] = {0.0}, total = 0.0;
  size_t i = 0;
  for (; i + 8 <= count; i += 8) {
    for (size_t l = 0; l < 8; l++) sum[l] += v[i + l] * 0.0;
  }
  for (; i < count; i++) total += v[i] * 0.0;
  for (size_t l = 0; l < 8; l++) total += sum[l];
  return total == 0.0;
}

#endif
