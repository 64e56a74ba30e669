/* contact/segment_box.c - see segment_box.h.
 *
 * (V) Between the at most six s at which the segment crosses the plane of a face, the function of s
 * is a parabola: of those outside of faces k, sides sigma_k,
 *
 *     half its slope  =  w (s - 1/2) + sum_k u_k (a_k + s u_k - sigma_k h_k),   u = b - a
 *
 * It rises, so that the minimum lies in the first piece at whose end it is not negative.
 *
 * (P) With x the segment's points, m its middle, sigma the sign of n.m, the overlap along n is
 *
 *     face k:   h_k - min of sigma x_k over both ends               (the other end is nearer out)
 *     n = u x e_k / |u x e_k|:   sum_j h_j |n_j| - sigma n.m
 *
 * In the second the segment leaves over an edge along e_k, whose point is crossed at the s where
 * (x(s) - c) . (e_k x n) = 0, c a point of the edge: there the segment has to move, and its ends
 * with the shares 1 - s and s. Segments along an edge have no such n. */
#include "contact/segment_box.h"
#include "base/arithmetic.h"

#include <math.h>

static const double along_an_edge = 1e-12; /* |u x e_k|^2 / |u|^2 */

/* ------------------------------------------------------------------ outside */

/* which side of face k x is beyond: -1, 1, or 0 */
static double side(double x, double half) {
  return x > half ? 1.0 : x < -half ? -1.0 : 0.0;
}

/* the s in (0, 1) where faces' planes are crossed, rising: breaks[6]; returns how many */
static int crossings(const double a[3], const double u[3], const double half[3], double *breaks) {
  int count = 0;
  for (int i = 0; i < 6; i++) {
    int k = i / 2;
    double s = u[k] == 0.0 ? -1.0 : ((i % 2 ? half[k] : -half[k]) - a[k]) / u[k];
    if (!(s > 0.0 && s < 1.0)) continue;
    int at = count++;
    for (; at > 0 && breaks[at - 1] > s; at--) breaks[at] = breaks[at - 1];
    breaks[at] = s;
  }
  return count;
}

/* the minimum of the parabola that holds around `middle`, of all s */
static double parabola(const double a[3], const double u[3], const double half[3], double weight,
                       double middle) {
  double square = weight, linear = 0.5 * weight;
  for (int k = 0; k < 3; k++) {
    double sigma = side(a[k] + middle * u[k], half[k]);
    if (sigma == 0.0) continue;
    square += u[k] * u[k];
    linear -= u[k] * (a[k] - sigma * half[k]);
  }
  return linear / square;
}

ambulo__box_nearest ambulo__box_nearest_of(double ends[2][3], const double half[3], double weight) {
  double u[3], breaks[6], from = 0.0;
  const double *a = ends[0];
  ambulo__box_nearest n = {.at = 1.0};
  for (int k = 0; k < 3; k++) u[k] = ends[1][k] - a[k];
  int count = crossings(a, u, half, breaks);
  for (int i = 0; i <= count; i++) {
    double to = i < count ? breaks[i] : 1.0;
    double s = parabola(a, u, half, weight, 0.5 * (from + to));
    if (s <= to) {
      n.at = fmax(s, from);
      break;
    }
    from = to;
  }
  n.value = weight * (n.at - 0.5) * (n.at - 0.5);
  for (int k = 0; k < 3; k++) {
    double x = a[k] + n.at * u[k], sigma = side(x, half[k]);
    n.o[k] = sigma == 0.0 ? 0.0 : x - sigma * half[k];
    n.value += n.o[k] * n.o[k];
  }
  return n;
}

/* ------------------------------------------------------------------- inside */

typedef struct way {
  double depth, out[3], share[2];
} way;

static way through_face(double ends[2][3], const double half[3], int k) {
  way w = {.out = {0.0}};
  double sigma = ends[0][k] + ends[1][k] < 0.0 ? -1.0 : 1.0;
  int end = sigma * ends[0][k] <= sigma * ends[1][k] ? 0 : 1;
  w.depth = half[k] - sigma * ends[end][k];
  w.out[k] = sigma;
  w.share[end] = 1.0;
  return w;
}

/* over an edge along axis k; 0 if the segment is along it */
static int over_edge(double ends[2][3], const double half[3], int k, way *w) {
  double axis[3] = {0.0}, u[3], n[3], across[3], middle = 0.0, reach = 0.0, offset = 0.0;
  axis[k] = 1.0;
  for (int i = 0; i < 3; i++) u[i] = ends[1][i] - ends[0][i];
  ambulo__cross(u, axis, n);
  double square = ambulo__dot(n, n), size = sqrt(square);
  if (square <= along_an_edge * ambulo__dot(u, u)) return 0;
  for (int i = 0; i < 3; i++) {
    n[i] /= size;
    middle += 0.5 * n[i] * (ends[0][i] + ends[1][i]);
    reach += half[i] * fabs(n[i]);
  }
  double sigma = middle < 0.0 ? -1.0 : 1.0;
  ambulo__cross(axis, n, across);
  for (int i = 0; i < 3; i++) {
    double corner = i == k ? 0.0 : copysign(half[i], sigma * n[i]);
    offset += across[i] * (ends[0][i] - corner);
    w->out[i] = sigma * n[i];
  }
  w->share[1] = -offset / ambulo__dot(across, u);
  w->share[0] = 1.0 - w->share[1];
  w->depth = reach - sigma * middle;
  return 1;
}

/* (14.h) P */
double ambulo__box_depth(double ends[2][3], const double half[3], double out[3], double share[2]) {
  way best = through_face(ends, half, 0);
  for (int k = 1; k < 6; k++) {
    way other = {.depth = 0.0};
    if (k < 3) other = through_face(ends, half, k);
    if (k >= 3 && !over_edge(ends, half, k - 3, &other)) continue;
    if (other.depth < best.depth) best = other;
  }
  if (!(best.depth > 0.0)) return 0.0;
  for (int i = 0; i < 3; i++) out[i] = best.out[i];
  for (int i = 0; i < 2; i++) share[i] = best.share[i];
  return best.depth;
}
