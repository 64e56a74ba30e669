/* base/arithmetic.h - vectors of three numbers, the smooth step, equal times, and the worst of many
 * numbers.
 *
 * fmax(a, NaN) is a, and a > NaN is false: a norm or a maximum written with either passes a NaN for
 * zero. House rule: norms and maxima go through the functions below.
 */
#ifndef AMBULO_BASE_ARITHMETIC_H
#define AMBULO_BASE_ARITHMETIC_H

#include <math.h>
#include <stddef.h>

/* s; times that are no further apart are equal. Contacts, nodes and events come from decimal
 * numbers and from divisions of the duration, which agree to rounding only. No step of a motion is
 * near it.
 */
#define AMBULO__INSTANT 1e-9

static inline double ambulo__dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* out = a x b; out is neither of them. */
static inline void ambulo__cross(const double a[3], const double b[3], double out[3]) {
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    out[i] = a[j] * b[k] - a[k] * b[j];
  }
}

/* out += factor a x b; out is neither of them. */
static inline void ambulo__add_cross(const double a[3], const double b[3], double factor,
                                     double out[3]) {
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    out[i] += factor * (a[j] * b[k] - a[k] * b[j]);
  }
}

/* u^2 (3 - 2 u), u cut to [0, 1]. */
static inline double ambulo__smooth_step(double u) {
  u = u > 1.0 ? 1.0 : u > 0.0 ? u : 0.0;
  return u * u * (3.0 - 2.0 * u);
}

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
