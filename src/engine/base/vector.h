/* base/vector.h - three numbers along three axes; and the smooth step from 0 to 1. */
#ifndef AMBULO_BASE_VECTOR_H
#define AMBULO_BASE_VECTOR_H

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

#endif
