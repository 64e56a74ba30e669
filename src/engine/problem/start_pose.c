/* problem/start_pose.c - the motion that a solve begins at: at rest, all coordinates at their
 * defaults.
 *
 * Weights of values sum to one in every basis, so that control points which stand for values are
 * the pose itself, and those which stand for rates (Hermite) are zero.
 */
#include "problem/problem.h"

void ambulo__start_pose(const ambulo_problem *p, double *x) {
  for (int c = 0; c < p->control_points; c++) {
    int is_value;
    (void)ambulo__basis_abscissa(p->basis, c, &is_value);
    for (int i = 0; i < p->coordinates; i++)
      x[c * p->coordinates + i] = is_value ? p->model->coordinates[i].default_value : 0.0;
  }
}
