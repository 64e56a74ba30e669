/* import/rigid.c - rigid placements (rigid.h). */
#include "import/rigid.h"

#include <math.h>
#include <string.h>

#include "model/placement.h"

ambulo__rigid ambulo__rigid_identity(void) {
  return (ambulo__rigid){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
}

ambulo__rigid ambulo__rigid_shift(const double p[3]) {
  ambulo__rigid a = ambulo__rigid_identity();
  memcpy(a.p, p, sizeof a.p);
  return a;
}

ambulo__rigid ambulo__rigid_turned(const ambulo__rigid *a) {
  ambulo__rigid turned = *a;
  turned.p[0] = turned.p[1] = turned.p[2] = 0.0;
  return turned;
}

/* R = c 1 + s [u]x + (1 - c) u u' (Rodrigues); sine and cosine of right angles are exact */
ambulo__rigid ambulo__rigid_turn(const double u[3], double angle) {
  double c = cos(angle), s = sin(angle);
  if (fabs(c) < 1e-15) c = 0.0;
  if (fabs(s) < 1e-15) s = 0.0;
  ambulo__rigid a = ambulo__rigid_identity();
  const double cross[3][3] = {{0, -u[2], u[1]}, {u[2], 0, -u[0]}, {-u[1], u[0], 0}};
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      a.r[i][k] = c * (i == k) + s * cross[i][k] + (1.0 - c) * u[i] * u[k];
  return a;
}

void ambulo__rigid_vector(const ambulo__rigid *a, const double v[3], double out[3]) {
  for (int i = 0; i < 3; i++) out[i] = a->r[i][0] * v[0] + a->r[i][1] * v[1] + a->r[i][2] * v[2];
}

void ambulo__rigid_back(const ambulo__rigid *a, const double v[3], double out[3]) {
  for (int i = 0; i < 3; i++) out[i] = a->r[0][i] * v[0] + a->r[1][i] * v[1] + a->r[2][i] * v[2];
}

void ambulo__rigid_point(const ambulo__rigid *a, const double x[3], double out[3]) {
  ambulo__rigid_vector(a, x, out);
  for (int i = 0; i < 3; i++) out[i] += a->p[i];
}

ambulo__rigid ambulo__rigid_step(int slides, const double axis[3], double value) {
  const double p[3] = {value * axis[0], value * axis[1], value * axis[2]};
  return slides ? ambulo__rigid_shift(p) : ambulo__rigid_turn(axis, value);
}

ambulo__rigid ambulo__rigid_times(const ambulo__rigid *a, const ambulo__rigid *b) {
  ambulo__rigid c;
  ambulo__rigid_point(a, b->p, c.p);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      c.r[i][k] = a->r[i][0] * b->r[0][k] + a->r[i][1] * b->r[1][k] + a->r[i][2] * b->r[2][k];
  return c;
}

ambulo__rigid ambulo__rigid_inverse(const ambulo__rigid *a) {
  ambulo__rigid b;
  double p[3];
  ambulo__rigid_back(a, a->p, p);
  for (int i = 0; i < 3; i++) {
    b.p[i] = -p[i];
    for (int k = 0; k < 3; k++) b.r[i][k] = a->r[k][i];
  }
  return b;
}

ambulo__rigid ambulo__rigid_of_rpy(const double p[3], const double rpy[3]) {
  ambulo__rigid a = ambulo__rigid_shift(p);
  ambulo__rotation_of_rpy(rpy, a.r);
  return a;
}

ambulo__rigid ambulo__rigid_of_xyz(const double p[3], const double angles[3]) {
  ambulo__rigid a = ambulo__rigid_shift(p);
  for (int i = 0; i < 3; i++) {
    const double axis[3] = {i == 0, i == 1, i == 2};
    ambulo__rigid turn = ambulo__rigid_turn(axis, angles[i]);
    a = ambulo__rigid_times(&a, &turn);
  }
  return a;
}

int ambulo__rotation_of_quaternion(const double q[4], double r[3][3]) {
  double size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(size > 1e-12) || !isfinite(size)) return 0;
  double w = q[0] / size, x = q[1] / size, y = q[2] / size, z = q[3] / size;
  const double rotation[3][3] = {
      {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
      {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
      {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
  memcpy(r, rotation, sizeof rotation);
  return 1;
}

void ambulo__inertia_turn(const double r[3][3], const double inertia[6], double out[6]) {
  static const int entry[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int e = 0; e < 6; e++) {
    out[e] = 0.0;
    for (int u = 0; u < 3; u++)
      for (int v = 0; v < 3; v++) out[e] += r[row[e]][u] * inertia[entry[u][v]] * r[column[e]][v];
  }
}

double ambulo__normalize(double v[3]) {
  double most = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
  if (!(most > 0.0) || !isfinite(most)) return 0.0;
  double u[3] = {v[0] / most, v[1] / most, v[2] / most};
  double size = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  for (int i = 0; i < 3; i++) v[i] = u[i] / size;
  return most * size;
}
