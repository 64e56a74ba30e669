/* mechanics/plan_mass.c - merging bodies, and factoring their inertia for the kernels.
 *
 * Inertia I (kg m^2) about the centre of mass in the axes of the frame. With mu the smallest
 * eigenvalue of I, I - mu 1 is positive semidefinite of rank two at most, so that
 *   I = mu 1 + d1 u u^T + d2 w w^T,   u = (1, l0, l1),  w = (0, 1, l2)
 * in the frame's axes taken in the order of falling pivots (Cholesky with pivoting). Rotating I
 * into the world then means rotating two vectors; for an inertia that is diagonal in the frame,
 * u and w are two of the frame's axes, and nothing is rotated at all.
 */
#include <math.h>
#include <string.h>

#include "mechanics/plan_build.h"

ambulo__mass ambulo__mass_of_link(const ambulo_link *link, const ambulo__placing *placing) {
  ambulo__mass out;
  const double *in = link->inertia;
  double local[3][3] = {{in[0], in[3], in[4]}, {in[3], in[1], in[5]}, {in[4], in[5], in[2]}};
  out.mass = link->mass;
  for (int i = 0; i < 3; i++) {
    out.com[i] = placing->position[i];
    for (int k = 0; k < 3; k++) out.com[i] += placing->rotation[i][k] * link->com[k];
    for (int j = 0; j < 3; j++) {
      double sum = 0;
      for (int k = 0; k < 3; k++) {
        for (int l = 0; l < 3; l++) {
          sum += placing->rotation[i][k] * local[k][l] * placing->rotation[j][l];
        }
      }
      out.inertia[i][j] = sum;
    }
  }
  return out;
}

/* I += mass (|r|^2 1 - r r^T) */
static void add_steiner(double inertia[3][3], double mass, const double r[3]) {
  double square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      inertia[i][j] += mass * ((i == j ? square : 0) - r[i] * r[j]);
    }
  }
}

void ambulo__mass_add(ambulo__mass *a, const ambulo__mass *b) {
  double total = a->mass + b->mass, to_a[3], to_b[3];
  if (!(total > 0)) return;
  for (int i = 0; i < 3; i++) {
    double com = a->com[i] + b->mass / total * (b->com[i] - a->com[i]);
    to_a[i] = a->com[i] - com;
    to_b[i] = b->com[i] - com;
    a->com[i] = com;
    for (int j = 0; j < 3; j++) a->inertia[i][j] += b->inertia[i][j];
  }
  if (a->mass > 0) add_steiner(a->inertia, a->mass, to_a);
  add_steiner(a->inertia, b->mass, to_b);
  a->mass = total;
}

/* One Jacobi rotation that clears m[p][q]. */
static void jacobi_rotate(double m[3][3], int p, int q) {
  if (m[p][q] == 0) return;
  double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  double t = copysign(1, theta) / (fabs(theta) + sqrt(theta * theta + 1));
  double c = 1 / sqrt(t * t + 1), s = t * c;
  for (int k = 0; k < 3; k++) {
    double x = m[k][p], y = m[k][q];
    m[k][p] = c * x - s * y;
    m[k][q] = s * x + c * y;
  }
  for (int k = 0; k < 3; k++) {
    double x = m[p][k], y = m[q][k];
    m[p][k] = c * x - s * y;
    m[q][k] = s * x + c * y;
  }
}

static double smallest_eigenvalue(const double inertia[3][3]) {
  double m[3][3];
  memcpy(m, inertia, sizeof m);
  for (int sweep = 0; sweep < 12; sweep++) {
    jacobi_rotate(m, 0, 1);
    jacobi_rotate(m, 0, 2);
    jacobi_rotate(m, 1, 2);
  }
  return fmin(m[0][0], fmin(m[1][1], m[2][2]));
}

void ambulo__mass_factor(const ambulo__mass *mass, ambulo__body *body) {
  double b[3][3], scale = mass->inertia[0][0] + mass->inertia[1][1] + mass->inertia[2][2];
  memcpy(b, mass->inertia, sizeof b);
  body->mass = mass->mass;
  memcpy(body->com, mass->com, sizeof body->com);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      if (i != j && fabs(b[i][j]) < 1e-16 * scale) b[i][j] = 0;
    }
  }
  body->base = smallest_eigenvalue((const double(*)[3])b);
  for (int i = 0; i < 3; i++) b[i][i] -= body->base;
  int *order = body->order;
  for (int i = 0; i < 3; i++) order[i] = i;
  int best = b[1][1] > b[0][0] ? 1 : 0;
  if (b[2][2] > b[best][best]) best = 2;
  order[0] = best;
  order[best] = 0;
  double pivot = b[order[0]][order[0]], tiny = 1e-15 * scale;
  body->first = pivot > tiny ? pivot : 0;
  for (int i = 0; i < 2; i++) {
    body->lower[i] = pivot > tiny ? b[order[0]][order[i + 1]] / pivot : 0;
  }
  double rest[2];
  for (int i = 0; i < 2; i++) {
    rest[i] = b[order[i + 1]][order[i + 1]] - body->first * body->lower[i] * body->lower[i];
  }
  if (rest[1] > rest[0]) {
    int axis = order[1];
    double swap = body->lower[0];
    order[1] = order[2];
    order[2] = axis;
    body->lower[0] = body->lower[1];
    body->lower[1] = swap;
    rest[0] = rest[1];
  }
  body->second = rest[0] > tiny ? rest[0] : 0;
  body->lower[2] = 0;
  if (rest[0] > tiny) {
    double off = b[order[1]][order[2]] - body->first * body->lower[0] * body->lower[1];
    body->lower[2] = off / rest[0];
  }
  body->diagonal = body->lower[0] == 0 && body->lower[1] == 0 && body->lower[2] == 0;
}
