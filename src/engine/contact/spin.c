/* contact/spin.c - see spin.h. */
#include "contact/spin.h"

static void read(const double *y, int first, int stride, double v[3]) {
  for (int i = 0; i < 3; i++) v[i] = y[(first + i) * stride];
}

static void cross(const double a[3], const double b[3], double c[3]) {
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    c[i] = a[j] * b[k] - a[k] * b[j];
  }
}

/* (F.2) b +- a . (M - r x F) / W */
double ambulo__spin_value(const ambulo__spin *spin, const double *y, int stride, double *slope) {
  double moment[3], force[3], center[3], arm[3], push[3], sum = 0.0;
  double factor = spin->sign / spin->weight;
  read(y, spin->moment, stride, moment);
  read(y, spin->force, stride, force);
  read(y, spin->center, stride, center);
  cross(spin->axis, center, arm);
  cross(force, spin->axis, push);
  for (int i = 0; i < 3; i++) sum += spin->axis[i] * moment[i] - arm[i] * force[i];
  for (int i = 0; slope && i < 3; i++) {
    slope[spin->moment + i] += factor * spin->axis[i];
    slope[spin->force + i] -= factor * arm[i];
    slope[spin->center + i] -= factor * push[i];
  }
  return spin->bound + factor * sum;
}
