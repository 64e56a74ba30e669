/* contact/solid.c - see solid.h. */
#include "contact/solid.h"
#include "base/arithmetic.h"
#include "contact/segment_box.h"
#include "contact/segments.h"

#include <math.h>
#include <string.h>

static const double epsilon = 1e-3;
static const double no_weight = 1e-6; /* of a weight: 1e-5 m at most */

double ambulo__solid_weight(double length, double radius) {
  return epsilon * (length * length + radius * radius);
}

double ambulo__solid_excess(const ambulo__solid *solid) {
  return 0.25 * (solid->weight[0] + solid->weight[1]);
}

/* a capsule's ends, 6 channels */
static void read_ends(const double *y, int first, int stride, double ends[2][3]) {
  for (int i = 0; i < 6; i++) ends[i / 3][i % 3] = y[(first + i) * stride];
}

/* slopes of sqrt(V) by the ends of both, and sqrt(V) */
typedef struct apart {
  double value;
  double slope[4][3]; /* a, b; c, d */
} apart;

static void spread(const double e[3], double size, double at, double sign, double slope[2][3]) {
  for (int i = 0; i < 3 && size > 0.0; i++) {
    slope[0][i] = sign * (1.0 - at) * e[i] / size;
    slope[1][i] = sign * at * e[i] / size;
  }
}

static apart from_capsule(double ends[2][3], double other[2][3], const double weight[2]) {
  apart d = {.slope = {{0.0}}};
  ambulo__segment_nearest n = ambulo__segments_nearest(ends, other, weight);
  d.value = sqrt(n.value);
  spread(n.e, d.value, n.at[0], 1.0, d.slope);
  spread(n.e, d.value, n.at[1], -1.0, d.slope + 2);
  return d;
}

/* in the box's axes, and its slopes back; those by the ends of c, d stay 0 */
static apart from_box(const ambulo__solid *solid, double ends[2][3], double weight) {
  double own[2][3], turned[2][3] = {{0.0}}, out[3] = {0.0}, share[2] = {0.0};
  apart d = {.slope = {{0.0}}};
  for (int end = 0; end < 2; end++) {
    double from[3];
    for (int i = 0; i < 3; i++) from[i] = ends[end][i] - solid->center[i];
    for (int k = 0; k < 3; k++) own[end][k] = ambulo__dot(solid->axes[k], from);
  }
  ambulo__box_nearest n = ambulo__box_nearest_of(own, solid->half, weight);
  double depth = ambulo__box_depth(own, solid->half, out, share);
  double size = sqrt(n.value);
  spread(n.o, size, n.at, 1.0, turned);
  for (int end = 0; end < 2; end++) {
    for (int k = 0; k < 3; k++) turned[end][k] += share[end] * out[k]; /* -dP/dx */
    for (int i = 0; i < 3; i++) {
      for (int k = 0; k < 3; k++) d.slope[end][i] += solid->axes[k][i] * turned[end][k];
    }
  }
  d.value = size - depth;
  return d;
}

static apart apart_of(const ambulo__solid *solid, const double *y, int stride,
                      const double weight[2]) {
  double ends[2][3], other[2][3];
  read_ends(y, solid->one, stride, ends);
  if (solid->kind == AMBULO__SOLID_BOX) return from_box(solid, ends, weight[0]);
  memcpy(other, solid->ends, sizeof other);
  if (solid->kind == AMBULO__SOLID_MOVING) read_ends(y, solid->other, stride, other);
  return from_capsule(ends, other, weight);
}

/* (14.h) */
double ambulo__solid_value(const ambulo__solid *solid, const double *y, int stride, double *slope) {
  apart d = apart_of(solid, y, stride, solid->weight);
  for (int i = 0; slope && i < 6; i++) {
    slope[solid->one + i] += d.slope[i / 3][i % 3];
    if (solid->kind == AMBULO__SOLID_MOVING) slope[solid->other + i] += d.slope[2 + i / 3][i % 3];
  }
  return d.value - sqrt(solid->distance * solid->distance + ambulo__solid_excess(solid));
}

int ambulo__solid_channels(const ambulo__solid *solid, int channel[AMBULO__SOLID_CHANNELS]) {
  int moving = solid->kind == AMBULO__SOLID_MOVING;
  for (int i = 0; i < 6; i++) {
    channel[i] = solid->one + i;
    if (moving) channel[6 + i] = solid->other + i;
  }
  return moving ? 12 : 6;
}

double ambulo__solid_gap(const ambulo__solid *solid, const double *y, int stride) {
  double weight[2] = {no_weight * solid->weight[0], no_weight * solid->weight[1]};
  return apart_of(solid, y, stride, weight).value - solid->radius;
}

void ambulo__solid_by_place(const ambulo__solid *solid, const double *y, int stride,
                            double by_place[2][3]) {
  apart d = apart_of(solid, y, stride, solid->weight);
  memset(by_place, 0, 6 * sizeof by_place[0][0]);
  for (int i = 0; i < 3; i++) {
    if (solid->kind == AMBULO__SOLID_BOX) by_place[0][i] = -(d.slope[0][i] + d.slope[1][i]);
    for (int end = 0; end < 2 && solid->kind == AMBULO__SOLID_CAPSULE; end++)
      by_place[end][i] = d.slope[2 + end][i];
  }
}
