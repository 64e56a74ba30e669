/* mechanics/kernel_local_angles.h - sines and cosines of all joint angles sign q + shift, into the
 * slots of their frames (plan_local.h): by rows, or by libm if one of them is too large.
 */
#ifndef AMBULO_MECHANICS_KERNEL_LOCAL_ANGLES_H
#define AMBULO_MECHANICS_KERNEL_LOCAL_ANGLES_H

#include <math.h>

#include "mechanics/kernel_sincos.h"

AMBULO__INLINE wide joint_angle(const ambulo__local_angle *angle, const double *q) {
  return angle->sign * load(q + angle->input) + angle->shift;
}

AMBULO__INLINE void store_sincos(const ambulo__local_angle *angle, const wide *s, const wide *c,
                                 double *scratch) {
  for (int k = 0; k < sincos_row; k++) {
    store(scratch + angle[k].at, s[k]);
    store(scratch + angle[k].at + AMBULO__LANES, c[k]);
  }
}

/* A row of angles that are not all small; returns the sum of their squares. */
static __attribute__((noinline)) wide large_local_angles(const ambulo__local_angle *angle,
                                                         const double *q, double *scratch) {
  wide x[sincos_row], s[sincos_row], c[sincos_row], squares = {0};
  for (int k = 0; k < sincos_row; k++) {
    x[k] = joint_angle(&angle[k], q);
    squares += x[k] * x[k];
  }
  sincos_reduced(sincos_row, x, s, c);
  store_sincos(angle, s, c, scratch);
  return squares;
}

/* Sines and cosines of all angles; returns what sincos_inside asks for. */
AMBULO__INLINE wide vector_angles(const ambulo__local_plan *local, const double *q,
                                  double *scratch) {
  wide squares = {0};
  for (int i = 0; i < local->angle_count; i += sincos_row) {
    const ambulo__local_angle *angle = &local->angles[i];
    wide x[sincos_row], z[sincos_row], s[sincos_row], c[sincos_row];
    for (int k = 0; k < sincos_row; k++) {
      x[k] = joint_angle(&angle[k], q);
      z[k] = x[k] * x[k];
    }
    if (sincos_small(sincos_row, z)) {
      sincos_series(sincos_row, x, z, s, c);
      store_sincos(angle, s, c, scratch);
    } else {
      squares += large_local_angles(angle, q, scratch);
    }
  }
  return squares;
}

static __attribute__((noinline)) void libm_local_angles(const ambulo__local_plan *local,
                                                        const double *q, double *scratch) {
  for (int i = 0; i < local->angle_count; i++) {
    const ambulo__local_angle *angle = &local->angles[i];
    for (int lane = 0; lane < AMBULO__WIDTH; lane++) {
      double x = angle->sign * q[angle->input + lane] + angle->shift;
      scratch[angle->at + lane] = sin(x);
      scratch[angle->at + AMBULO__LANES + lane] = cos(x);
    }
  }
}

static void local_angles(const ambulo__local_plan *local, const double *q, double *scratch) {
  if (!sincos_inside(vector_angles(local, q, scratch))) libm_local_angles(local, q, scratch);
}

#endif
