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

double ambulo__at_ease(const ambulo_coordinate *about) {
  static const double margin = 0.1; /* of the range */
  double room = about->range[1] - about->range[0], value = about->default_value;
  if (!isfinite(room)) return value;
  return fmin(fmax(value, about->range[0] + margin * room), about->range[1] - margin * room);
}

/* One step; its length, rad. With the pull c toward the pose at ease, q0, the least of |e - J dq|^2
 * + c |q
 * + dq - q0|^2 is J^T (J J^T + c 1)^-1 (e + J (q - q0)) - (q - q0). */
static double step(const ambulo__figure *figure, int segment, const double error[3], double *q) {
  static const double damping = 1e-4, pull = 1e-2;
  int count = figure->map.count[segment], pulled = segment >= AMBULO__UPPER_ARM;
  double axis[AMBULO__SEGMENT_COORDINATES][3], m[3][3] = {{0.0}}, x[3], length = 0.0;
  for (int i = 0; i < 3; i++) {
    m[i][i] = pulled ? pull : damping;
    x[i] = error[i];
  }
  for (int g = 0; g < count; g++) {
    int c = figure->map.coordinate[segment][g];
    double point[3], away = pulled ? q[c] - ambulo__at_ease(&figure->model->coordinates[c]) : 0.0;
    ambulo__figure_axis(figure, c, point, axis[g]);
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) m[i][j] += axis[g][i] * axis[g][j];
      x[i] += axis[g][i] * away;
    }
  }
  solve(m, x);
  for (int g = 0; g < count; g++) {
    int c = figure->map.coordinate[segment][g];
    double away = pulled ? q[c] - ambulo__at_ease(&figure->model->coordinates[c]) : 0.0;
    double change = ambulo__dot(axis[g], x) - away;
    q[c] += change;
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
