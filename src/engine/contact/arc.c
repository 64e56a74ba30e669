/* contact/arc.c - see arc.h. With s = n . (t - h) / L,
 *
 *     de/dC = f,   de/dt = -de/dh = r n / (L sqrt(1 - s^2))
 *     d(F_n d)/dM = -l,   d(F_n d)/dC = -F_n f,   d(F_n d)/dF = f . (p - C) n
 */
#include "contact/arc.h"

#include <math.h>

static const double steepest = 0.97; /* sine beyond which asin goes on straight */

static double dot(const double a[3], const double *y, int first, int stride) {
  double sum = 0.0;
  for (int i = 0; i < 3; i++) sum += a[i] * y[(first + i) * stride];
  return sum;
}

static void add(double *slope, int first, const double a[3], double factor) {
  for (int i = 0; slope && i < 3; i++) slope[first + i] += factor * a[i];
}

static double angle(double sine, double *derivative) {
  double s = fmin(steepest, fmax(-steepest, sine));
  *derivative = 1.0 / sqrt(1.0 - s * s);
  return asin(s) + (sine - s) * *derivative;
}

/* (R.1) e0 -+ e */
static double rolling(const ambulo__arc *a, const double *y, int stride, double *slope) {
  double derivative,
      sine = (dot(a->up, y, a->toe, stride) - dot(a->up, y, a->heel, stride)) / a->length;
  double theta = angle(sine, &derivative), tilt = a->sign * a->radius * derivative / a->length;
  add(slope, a->center, a->forward, a->sign);
  add(slope, a->toe, a->up, tilt);
  add(slope, a->heel, a->up, -tilt);
  return a->room + a->sign * (dot(a->forward, y, a->center, stride) - a->flat + a->radius * theta);
}

/* (R.2) a + (e0 F_n -+ F_n d) / (m g) */
static double pressure(const ambulo__arc *a, const double *y, int stride, double *slope) {
  double normal = dot(a->up, y, a->force, stride), turn = dot(a->left, y, a->moment, stride);
  double apart = a->along - dot(a->forward, y, a->center, stride);
  add(slope, a->force, a->up, (a->room + a->sign * apart) / a->weight);
  add(slope, a->moment, a->left, -a->sign / a->weight);
  add(slope, a->center, a->forward, -a->sign * normal / a->weight);
  return a->slack + (a->room * normal + a->sign * (normal * apart - turn)) / a->weight;
}

double ambulo__arc_value(const ambulo__arc *arc, const double *y, int stride, double *slope) {
  return arc->force < 0 ? rolling(arc, y, stride, slope) : pressure(arc, y, stride, slope);
}

int ambulo__arc_channels(const ambulo__arc *arc, int channel[AMBULO__ARC_CHANNELS]) {
  int first[3] = {arc->center, arc->heel, arc->toe};
  if (arc->force >= 0) {
    first[1] = arc->force;
    first[2] = arc->moment;
  }
  for (int i = 0; i < AMBULO__ARC_CHANNELS; i++) channel[i] = first[i / 3] + i % 3;
  return AMBULO__ARC_CHANNELS;
}
