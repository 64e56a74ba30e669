/* contact/capsules.c - the nearest points of segments and boxes, and rows on capsules (capsules.h).
 * With u = b - a, v_ = d - c, r = a - c, the function is |r + s u - t v_|^2 + .., and its slopes by
 * s and t, halved, vanish where
 *
 *     A s - B t = p      A = u.u + w,    p = w / 2 - r.u
 *     C t - B s = q      C = v_.v_ + v,  q = v / 2 + r.v_      B = u.v_
 *
 * A C - B^2 > 0. If that is outside the square of s and t, the minimum is on one of its four sides,
 * where one of the two is 0 or 1 and the other follows from its own equation, cut to [0, 1]. */
#include "contact/curved.h"

#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

typedef struct system {
  double a, b, c, p, q;
  double r[3], u[3], v[3], weight[2];
} system;

static double cut(double x) {
  return fmin(1.0, fmax(0.0, x));
}

static ambulo__segment_nearest at(const system *m, double s, double t) {
  ambulo__segment_nearest n = {.at = {s, t}, .square = {m->a, m->c, m->b}};
  for (int i = 0; i < 3; i++) n.e[i] = m->r[i] + s * m->u[i] - t * m->v[i];
  n.value = ambulo__dot(n.e, n.e) + m->weight[0] * (s - 0.5) * (s - 0.5) +
            m->weight[1] * (t - 0.5) * (t - 0.5);
  return n;
}

static ambulo__segment_nearest on_a_side(const system *m) {
  ambulo__segment_nearest best = at(m, 0.0, cut(m->q / m->c));
  const ambulo__segment_nearest others[3] = {at(m, 1.0, cut((m->q + m->b) / m->c)),
                                             at(m, cut(m->p / m->a), 0.0),
                                             at(m, cut((m->p + m->b) / m->a), 1.0)};
  for (int i = 0; i < 3; i++) {
    if (others[i].value < best.value) best = others[i];
  }
  return best;
}

/* (14.h) V of two segments */
ambulo__segment_nearest ambulo__segments_nearest(double one[2][3], double other[2][3],
                                                 const double weight[2]) {
  system m = {.weight = {weight[0], weight[1]}};
  for (int i = 0; i < 3; i++) {
    m.u[i] = one[1][i] - one[0][i];
    m.v[i] = other[1][i] - other[0][i];
    m.r[i] = one[0][i] - other[0][i];
  }
  m.a = ambulo__dot(m.u, m.u) + weight[0];
  m.b = ambulo__dot(m.u, m.v);
  m.c = ambulo__dot(m.v, m.v) + weight[1];
  m.p = 0.5 * weight[0] - ambulo__dot(m.r, m.u);
  m.q = 0.5 * weight[1] + ambulo__dot(m.r, m.v);
  double determinant = m.a * m.c - m.b * m.b;
  double s = (m.p * m.c + m.b * m.q) / determinant, t = (m.a * m.q + m.b * m.p) / determinant;
  return s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0 ? at(&m, s, t) : on_a_side(&m);
}

/*
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
                       double middle, double *half_curvature) {
  double square = weight, linear = 0.5 * weight;
  for (int k = 0; k < 3; k++) {
    double sigma = side(a[k] + middle * u[k], half[k]);
    if (sigma == 0.0) continue;
    square += u[k] * u[k];
    linear -= u[k] * (a[k] - sigma * half[k]);
  }
  *half_curvature = square;
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
    double s = parabola(a, u, half, weight, 0.5 * (from + to), &n.square);
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
  double e[3], at[2]; /* of a box: o, s, and no t */
  double square[3];   /* A, C, B */
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
  memcpy(d.e, n.e, sizeof d.e);
  memcpy(d.at, n.at, sizeof d.at);
  memcpy(d.square, n.square, sizeof d.square);
  spread(n.e, d.value, n.at[0], 1.0, d.slope);
  spread(n.e, d.value, n.at[1], -1.0, d.slope + 2);
  return d;
}

/* in the box's axes, and its slopes back; those by the ends of c, d stay 0 */
static apart from_box(const ambulo__solid *solid, const double center[3], double ends[2][3],
                      double weight) {
  double own[2][3], turned[2][3] = {{0.0}}, out[3] = {0.0}, share[2] = {0.0};
  apart d = {.slope = {{0.0}}};
  for (int end = 0; end < 2; end++) {
    double from[3];
    for (int i = 0; i < 3; i++) from[i] = ends[end][i] - center[i];
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
  d.at[0] = n.at;
  d.square[0] = n.square;
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 3; k++) d.e[i] += solid->axes[k][i] * n.o[k];
  }
  return d;
}

/* m - o */
static void between_hands(const ambulo__solid *solid, const double *y, int stride,
                          double middle[3]) {
  int hands = solid->hand[1] < 0 ? 1 : 2;
  for (int i = 0; i < 3; i++) {
    middle[i] = 0.0;
    for (int k = 0; k < hands; k++) middle[i] += y[(solid->hand[k] + i) * stride] / hands;
  }
}

static apart apart_of(const ambulo__solid *solid, const double *y, int stride,
                      const double weight[2]) {
  double ends[2][3], other[2][3], middle[3];
  if (solid->kind >= AMBULO__SOLID_HELD) between_hands(solid, y, stride, middle);
  if (solid->kind == AMBULO__SOLID_CARRIED) {
    for (int i = 0; i < 6; i++) ends[i / 3][i % 3] = middle[i % 3] + solid->ends[0][i % 3];
    return from_box(solid, solid->center, ends, weight[0]);
  }
  read_ends(y, solid->one, stride, ends);
  if (solid->kind == AMBULO__SOLID_BOX) return from_box(solid, solid->center, ends, weight[0]);
  if (solid->kind == AMBULO__SOLID_HELD) {
    for (int i = 0; i < 3; i++) middle[i] += solid->ends[0][i];
    return from_box(solid, middle, ends, weight[0]);
  }
  memcpy(other, solid->ends, sizeof other);
  if (solid->kind == AMBULO__SOLID_MOVING) read_ends(y, solid->other, stride, other);
  return from_capsule(ends, other, weight);
}

/* (14.h) */
double ambulo__solid_value(const ambulo__solid *solid, const double *y, int stride, double *slope) {
  apart d = apart_of(solid, y, stride, solid->weight);
  int hands = solid->kind < AMBULO__SOLID_HELD ? 0 : solid->hand[1] < 0 ? 1 : 2;
  double sign = solid->kind == AMBULO__SOLID_CARRIED ? 1.0 : -1.0;
  for (int i = 0; slope && i < 3 * hands; i++)
    slope[solid->hand[i / 3] + i % 3] += sign * (d.slope[0][i % 3] + d.slope[1][i % 3]) / hands;
  for (int i = 0; slope && i < 6 && solid->kind != AMBULO__SOLID_CARRIED; i++) {
    slope[solid->one + i] += d.slope[i / 3][i % 3];
    if (solid->kind == AMBULO__SOLID_MOVING) slope[solid->other + i] += d.slope[2 + i / 3][i % 3];
  }
  return d.value - sqrt(solid->distance * solid->distance + ambulo__solid_excess(solid));
}

/* r = a (-e, e, b e, -b e): ends a, b; c, d */
static void bend(const double e[3], double a, double b, double row[AMBULO__SOLID_CHANNELS]) {
  for (int i = 0; i < 3; i++) {
    row[i] = -a * e[i];
    row[3 + i] = a * e[i];
    row[6 + i] = b * e[i];
    row[9 + i] = -b * e[i];
  }
}

/* (P.2c) */
int ambulo__solid_curvature(const ambulo__solid *solid, const double *y, int stride,
                            double rows[2][AMBULO__SOLID_CHANNELS]) {
  memset(rows, 0, 2 * sizeof *rows);
  apart d = apart_of(solid, y, stride, solid->weight);
  int s_moves = d.at[0] > 0.0 && d.at[0] < 1.0;
  int t_moves = d.at[1] > 0.0 && d.at[1] < 1.0;
  double a = d.square[0], c = d.square[1], b = d.square[2], size = sqrt(ambulo__dot(d.e, d.e));
  int moving = solid->kind == AMBULO__SOLID_MOVING;
  if (solid->kind == AMBULO__SOLID_CARRIED || !(size > 0.0) || (!s_moves && !t_moves)) return 0;
  if (!t_moves) {
    bend(d.e, 1.0 / sqrt(a * size), 0.0, rows[0]);
    return 1;
  }
  if (moving) bend(d.e, 0.0, 1.0 / sqrt(c * size), rows[0]);
  if (!s_moves) return moving;
  double root = sqrt(c / ((a * c - b * b) * size));
  bend(d.e, root, moving ? root * b / c : 0.0, rows[moving]);
  return 1 + moving;
}

int ambulo__solid_channels(const ambulo__solid *solid, int channel[AMBULO__SOLID_CHANNELS]) {
  int first[4], points = 0, count = 0;
  if (solid->kind != AMBULO__SOLID_CARRIED) {
    first[points++] = solid->one;
    first[points++] = solid->one + 3;
  }
  if (solid->kind == AMBULO__SOLID_MOVING) {
    first[points++] = solid->other;
    first[points++] = solid->other + 3;
  }
  for (int k = 0; k < 2 && solid->kind >= AMBULO__SOLID_HELD; k++) {
    if (solid->hand[k] >= 0) first[points++] = solid->hand[k];
  }
  for (; count < 3 * points; count++) channel[count] = first[count / 3] + count % 3;
  return count;
}

double ambulo__solid_gap(const ambulo__solid *solid, const double *y, int stride) {
  double weight[2] = {no_weight * solid->weight[0], no_weight * solid->weight[1]};
  return apart_of(solid, y, stride, weight).value - solid->radius;
}
