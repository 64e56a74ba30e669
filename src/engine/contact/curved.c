/* contact/curved.c - rows that are not linear (curved.h). Of an arc, with s = n . (t - h) / L,
 *
 *     de/dC = f,   de/dt = -de/dh = r n / (L sqrt(1 - s^2))
 *     d(F_n d)/dM = -l,   d(F_n d)/dC = -F_n f,   d(F_n d)/dF = f . (p - C) n
 *     da/dF = -2 a x / (k m g) n,   x = F_n / (k m g)
 */
#include "contact/curved.h"

#include "base/arithmetic.h"

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

static const double light = 0.028; /* k: at a twentieth of the weight, 4 % of a0 is left */

/* (R.2) a + (e0 F_n -+ F_n d) / (m g) */
static double pressure(const ambulo__arc *a, const double *y, int stride, double *slope) {
  double normal = dot(a->up, y, a->force, stride), turn = dot(a->left, y, a->moment, stride);
  double apart = a->along - dot(a->forward, y, a->center, stride);
  double x = normal / (light * a->weight), allowed = a->slack * exp(-x * x);
  add(slope, a->force, a->up, (a->room + a->sign * apart - 2.0 * allowed * x / light) / a->weight);
  add(slope, a->moment, a->left, -a->sign / a->weight);
  add(slope, a->center, a->forward, -a->sign * normal / a->weight);
  return allowed + (a->room * normal + a->sign * (normal * apart - turn)) / a->weight;
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

/* N in *normal, T */
static void split(const ambulo__cone *cone, const double *y, int stride, double *normal,
                  double level_part[3]) {
  *normal = dot(cone->up, y, cone->force, stride) / cone->weight;
  for (int i = 0; i < 3; i++)
    level_part[i] = y[(cone->force + i) * stride] / cone->weight - *normal * cone->up[i];
}

/* (W.9) mu N + s - sqrt(|T|^2 + s^2) */
double ambulo__cone_value(const ambulo__cone *cone, const double *y, int stride, double *slope) {
  double normal, drag[3], s = cone->smoothing;
  split(cone, y, stride, &normal, drag);
  double length = sqrt(ambulo__dot(drag, drag) + s * s);
  add(slope, cone->force, cone->up, cone->friction / cone->weight);
  add(slope, cone->force, drag, -1.0 / (length * cone->weight));
  return cone->friction * normal + s - length;
}

void ambulo__cone_curvature(const ambulo__cone *cone, const double *y, int stride,
                            double rows[2][3]) {
  double normal, drag[3], s = cone->smoothing;
  split(cone, y, stride, &normal, drag);
  double square = ambulo__dot(drag, drag), length = sqrt(square + s * s);
  double across = 1.0 / (sqrt(length) * cone->weight), along = across * s / length;
  if (square <= 1e-12 * s * s) { /* any level direction: both are alike */
    int least = fabs(cone->up[0]) < fabs(cone->up[1]) ? 0 : 1;
    for (int i = 0; i < 3; i++) drag[i] = (i == least) - cone->up[least] * cone->up[i];
  }
  double norm = sqrt(ambulo__dot(drag, drag));
  for (int i = 0; i < 3; i++) drag[i] /= norm;
  cross(cone->up, drag, rows[0]);
  for (int i = 0; i < 3; i++) {
    rows[0][i] *= across;
    rows[1][i] = along * drag[i];
  }
}
