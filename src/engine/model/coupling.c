/* model/coupling.c - functions of coupled joints.
 *
 * The cubic spline through (x_i, y_i) with steps h_i = x_(i+1) - x_i and slopes of chords
 * m_i = (y_(i+1) - y_i)/h_i has second derivatives 6 s_i with
 *
 *     h_(i-1) s_(i-1) + 2 (h_(i-1) + h_i) s_i + h_i s_(i+1) = m_i - m_(i-1)
 *
 * and is closed at both ends by the third derivative of the cubic through the four points there
 * (Forsythe, Malcolm & Moler 1977), 6 times its third divided difference D:
 *
 *     s_1 - s_0 = h_0 D_0,      s_n - s_(n-1) = h_(n-1) D_n
 *
 * Three points: a parabola (both differences are zero). Two: the line. From x_i on, t = x - x_i,
 *
 *     f = y_i + t (m_i - h_i (s_(i+1) + 2 s_i)) + 3 s_i t^2 + (s_(i+1) - s_i)/h_i t^3
 *
 * Beyond its ends it goes straight on. That is OpenSim's SimmSpline. f'' is continuous between the
 * ends and jumps to zero there; f''' jumps at every point.
 */
#include "model/coupling.h"

#include <math.h>
#include <stddef.h>

static double x_of(const double *points, int i) {
  return points[2 * i];
}

static double y_of(const double *points, int i) {
  return points[2 * i + 1];
}

/* third divided difference of the points i .. i + 3; 0 where there are not so many */
static double third(const double *points, int count, int i) {
  double d[4];
  if (count < 4) return 0.0;
  for (int k = 0; k < 4; k++) d[k] = y_of(points, i + k);
  for (int order = 1; order < 4; order++)
    for (int k = 0; k + order < 4; k++)
      d[k] = (d[k + 1] - d[k]) / (x_of(points, i + k + order) - x_of(points, i + k));
  return d[0];
}

static double chord(const double *points, int i) {
  return (y_of(points, i + 1) - y_of(points, i)) / (x_of(points, i + 1) - x_of(points, i));
}

/* s_i, by elimination from the top, where the second coefficient of piece i will stand; the third
 * is working room */
static void curvatures(const double *points, int count, ambulo__piece *p) {
  enum { s = 2, work = 3 };
  int n = count - 1;
  double h = x_of(points, 1) - x_of(points, 0);
  /* -s_0 + s_1 = h_0 D_0, times h_0 to be symmetric */
  double diagonal = -h;
  p[0].c[s] = h * h * third(points, count, 0) / diagonal;
  p[0].c[work] = h / diagonal;
  for (int i = 1; i <= n; i++) {
    double before = x_of(points, i) - x_of(points, i - 1), right;
    if (i < n) {
      double behind = x_of(points, i + 1) - x_of(points, i);
      diagonal = 2.0 * (before + behind);
      right = chord(points, i) - chord(points, i - 1);
      h = behind;
    } else { /* s_(n-1) - s_n = -h D_n */
      diagonal = -before;
      right = -before * before * third(points, count, n - 3);
    }
    double pivot = diagonal - before * p[i - 1].c[work];
    p[i].c[work] = h / pivot;
    p[i].c[s] = (right - before * p[i - 1].c[s]) / pivot;
  }
  for (int i = n - 1; i >= 0; i--) p[i].c[s] -= p[i].c[work] * p[i + 1].c[s];
}

static ambulo__piece straight(double from, double at, double value, double slope) {
  return (ambulo__piece){from, at, {value, slope, 0.0, 0.0, 0.0}};
}

/* (K.0) Piece 0 stands before the first point, piece i + 1 begins at point i. */
void ambulo__spline_fill(const double *points, int count, ambulo__piece *p) {
  int n = count - 1;
  if (count > 2) {
    curvatures(points, count, p);
  } else {
    p[0].c[2] = p[1].c[2] = 0.0;
  }
  double h = x_of(points, n) - x_of(points, n - 1), end = x_of(points, n);
  double last = chord(points, n - 1) + h * (p[n - 1].c[2] + 2.0 * p[n].c[2]);
  p[count] = straight(nextafter(end, HUGE_VAL), end, y_of(points, n), last);
  for (int i = n - 1; i >= 0; i--) {
    double x = x_of(points, i), s = p[i].c[2], next = p[i + 1].c[2];
    h = x_of(points, i + 1) - x;
    p[i + 1] = (ambulo__piece){
        x,
        x,
        {y_of(points, i), chord(points, i) - h * (next + 2.0 * s), 3.0 * s, (next - s) / h, 0.0}};
  }
  p[0] = straight(-HUGE_VAL, x_of(points, 0), y_of(points, 0), p[1].c[1]);
}

int ambulo__coupling_count(const ambulo_link *link) {
  return link->knot_count > 0 ? link->knot_count + 1 : 1;
}

void ambulo__coupling_fill(const ambulo_link *link, ambulo__piece *pieces) {
  if (link->knot_count > 0) {
    ambulo__spline_fill(link->knots[0], link->knot_count, pieces);
    return;
  }
  *pieces = straight(-HUGE_VAL, 0.0, 0.0, 0.0);
  for (int i = 0; i < AMBULO__COUPLING_TERMS; i++) pieces->c[i] = link->polynomial[i];
}

const ambulo__piece *ambulo__coupling_piece(const ambulo__coupling *coupling, double x) {
  int low = 0, above = coupling->count;
  while (above - low > 1) {
    int middle = low + (above - low) / 2;
    if (x >= coupling->pieces[middle].from) {
      low = middle;
    } else {
      above = middle;
    }
  }
  return &coupling->pieces[low];
}

double ambulo__coupling_value(const ambulo__coupling *coupling, double x,
                              double slope[AMBULO__COUPLING_SLOPES]) {
  const ambulo__piece *piece = ambulo__coupling_piece(coupling, x);
  const double *c = piece->c, t = x - piece->at;
  if (slope) {
    slope[0] = c[1] + t * (2.0 * c[2] + t * (3.0 * c[3] + t * 4.0 * c[4]));
    slope[1] = 2.0 * c[2] + t * (6.0 * c[3] + t * 12.0 * c[4]);
    slope[2] = 6.0 * c[3] + t * 24.0 * c[4];
  }
  return c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4])));
}
