/* method/joint_squares.c - see joint_squares.h. */
#include "method/joint_squares.h"

#include <math.h>

enum { ORDERS = 3 };

static void add_light(ambulo__joint_squares *s, const double m[ORDERS]) {
  for (int a = 0, at = 0; a < ORDERS; a++) {
    for (int b = 0; b <= a; b++) s->light[at++] += m[a] * m[b];
  }
}

void ambulo__joint_squares_add(ambulo__joint_squares *s, double tau, const double motion[ORDERS]) {
  double length = sqrt(s->tau * s->tau + tau * tau), rest[ORDERS], c = 1.0, z = 0.0;
  if (length != 0.0) { /* NaN, too, which the factorization meets */
    c = s->tau / length;
    z = tau / length;
  }
  for (int o = 0; o < ORDERS; o++) {
    rest[o] = c * motion[o] - z * s->motion[o];
    s->motion[o] = c * s->motion[o] + z * motion[o];
  }
  s->tau = length;
  add_light(s, rest);
}

int ambulo__joint_squares_light(const ambulo__joint_squares *s, const ambulo__basis_point *point,
                                double *form) {
  int any = 0, at = 0;
  for (int e = 0; e < ORDERS * (ORDERS + 1) / 2; e++) any |= s->light[e] != 0.0;
  if (!any) return 0;
  const double *l = s->light;
  for (int c = 0; c < point->span; c++) {
    const double q = point->weight[0][c], qd = point->weight[1][c], qdd = point->weight[2][c];
    const double by_q = l[0] * q + l[1] * qd + l[3] * qdd;
    const double by_qd = l[1] * q + l[2] * qd + l[4] * qdd;
    const double by_qdd = l[3] * q + l[4] * qd + l[5] * qdd;
    for (int b = 0; b <= c; b++)
      form[at++] =
          by_q * point->weight[0][b] + by_qd * point->weight[1][b] + by_qdd * point->weight[2][b];
  }
  return 1;
}
