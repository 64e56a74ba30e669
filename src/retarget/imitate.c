/* retarget/imitate.c - see imitate.h. */
#include "retarget/imitate.h"

#include "base/arithmetic.h"

#include <math.h>

/* (J J' + m) x = e; positive definite: no pivots */
static void solve(double m[3][3], double x[3]) {
  for (int k = 0; k < 3; k++) {
    for (int i = k + 1; i < 3; i++) {
      double factor = m[i][k] / m[k][k];
      for (int j = k; j < 3; j++) m[i][j] -= factor * m[k][j];
      x[i] -= factor * x[k];
    }
  }
  for (int i = 2; i >= 0; i--) {
    for (int j = i + 1; j < 3; j++) x[i] -= m[i][j] * x[j];
    x[i] /= m[i][i];
  }
}

/* one step; its length, rad */
static double step(const ambulo__figure *figure, int segment, const double error[3], double *q) {
  static const double damping = 1e-4;
  int count = figure->map.count[segment];
  double axis[AMBULO__SEGMENT_COORDINATES][3], m[3][3] = {{0.0}}, x[3], length = 0.0;
  for (int g = 0; g < count; g++) {
    double point[3];
    ambulo__figure_axis(figure, figure->map.coordinate[segment][g], point, axis[g]);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) m[i][j] += axis[g][i] * axis[g][j];
  }
  for (int i = 0; i < 3; i++) {
    m[i][i] += damping;
    x[i] = error[i];
  }
  solve(m, x);
  for (int g = 0; g < count; g++) {
    double change = ambulo__dot(axis[g], x);
    q[figure->map.coordinate[segment][g]] += change;
    length += fabs(change);
  }
  return length;
}

static ambulo__rigid goal_of(const ambulo__posture *goal, const ambulo__posture *now, int segment) {
  if (segment < AMBULO__UPPER_ARM) return goal->turn[segment];
  ambulo__rigid back = ambulo__rigid_inverse(&goal->turn[AMBULO__TORSO]);
  ambulo__rigid lean = ambulo__rigid_times(&now->turn[AMBULO__TORSO], &back);
  return ambulo__rigid_times(&lean, &goal->turn[segment]);
}

static double follow(ambulo__figure *figure, const ambulo__posture *goal, int segment, double *q) {
  enum { STEPS = 20 };
  static const double small = 1e-9;
  double error[3], moved = 1.0;
  for (int k = 0; k < STEPS && moved > small; k++) {
    ambulo__posture now;
    ambulo__figure_at(figure, q, &now);
    ambulo__rigid there = goal_of(goal, &now, segment);
    ambulo__rigid back = ambulo__rigid_inverse(&now.turn[segment]);
    ambulo__rigid left = ambulo__rigid_times(&there, &back);
    ambulo__turn_vector(&left, error);
    moved = step(figure, segment, error, q);
  }
  return sqrt(ambulo__dot(error, error));
}

void ambulo__imitate(ambulo__figure *figure, const ambulo__posture *goal, double *q,
                     double miss[AMBULO__SEGMENTS]) {
  for (int s = 0; s < AMBULO__SEGMENTS; s++)
    miss[s] = figure->link[s] < 0 ? 0.0 : follow(figure, goal, s, q);
}
