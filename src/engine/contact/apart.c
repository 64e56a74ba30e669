/* contact/apart.c - see apart.h. */
#include "contact/apart.h"
#include "base/arithmetic.h"

#include <math.h>

/* what is level of the vector from one point to another */
static void level(const ambulo__apart *a, const double *y, int stride, int from, int to,
                  double out[3]) {
  for (int i = 0; i < 3; i++) out[i] = y[(to + i) * stride] - y[(from + i) * stride];
  double rise = ambulo__dot(a->up, out);
  for (int i = 0; i < 3; i++) out[i] -= rise * a->up[i];
}

/* (14.g) (|e|^2 - D^2) / (2 D) */
double ambulo__apart_value(const ambulo__apart *apart, const double *y, int stride, double *slope) {
  double along[3], e[3];
  level(apart, y, stride, apart->from, apart->to, along);
  level(apart, y, stride, apart->from, apart->point, e);
  double length = ambulo__dot(along, along), s = ambulo__dot(e, along);
  s = length > 0.0 ? fmin(1.0, fmax(0.0, s / length)) : 0.0;
  for (int i = 0; i < 3; i++) e[i] -= s * along[i];
  for (int i = 0; slope && i < 3; i++) {
    slope[apart->point + i] += e[i] / apart->distance;
    slope[apart->from + i] -= (1.0 - s) * e[i] / apart->distance;
    slope[apart->to + i] -= s * e[i] / apart->distance;
  }
  return 0.5 * (ambulo__dot(e, e) / apart->distance - apart->distance);
}
