/* contact/segments.c - see segments.h.
 *
 * With u = b - a, v_ = d - c, r = a - c, the function is |r + s u - t v_|^2 + .., and its slopes by
 * s and t, halved, vanish where
 *
 *     A s - B t = p      A = u.u + w,    p = w / 2 - r.u
 *     C t - B s = q      C = v_.v_ + v,  q = v / 2 + r.v_      B = u.v_
 *
 * A C - B^2 > 0. If that is outside the square of s and t, the minimum is on one of its four sides,
 * where one of the two is 0 or 1 and the other follows from its own equation, cut to [0, 1]. */
#include "contact/segments.h"
#include "base/arithmetic.h"

#include <math.h>

typedef struct system {
  double a, b, c, p, q;
  double r[3], u[3], v[3], weight[2];
} system;

static double cut(double x) {
  return fmin(1.0, fmax(0.0, x));
}

static ambulo__segment_nearest at(const system *m, double s, double t) {
  ambulo__segment_nearest n = {.at = {s, t}};
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
