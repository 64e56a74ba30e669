/* problem/gradient.c - gradient of a weighted sum of objective and rows: one reverse sweep.
 *
 * L = s J + sum_r lambda_r c_r. With y the channels and w their adjoints dL/dy, mirrored
 * block by block from evaluate.c:
 *
 *   terms:     w_c(k) += s * weight * w_k phi'(u) scale, which evaluate.c leaves behind for s = 1
 *   rows:      w_c(k) += lambda_r * coefficient          (unknowns: straight into dL/dx)
 *   mechanics: (gq, gqd, gqdd) = reverse sweep of (tau, M, F, points) with their adjoints
 *   basis:     dL/dx = B0' (gq + w_q) + B1' (gqd + w_qd) + B2' (gqdd + w_qdd)
 */
#include "base/worst.h"
#include "problem/adjoint.h"
#include "problem/fault.h"
#include "problem/states.h"

/* from the adjoints of the channels to the gradient */
static void pull_back(ambulo_workspace *workspace, double *gradient) {
  const ambulo_problem *p = workspace->problem;
  size_t stride = (size_t)workspace->channel_count * AMBULO__LANES;
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  double *w = workspace->weight;
  for (int block = 0; block < p->blocks; block++) ambulo__adjoint_block(workspace, block);
  ambulo__lane_map_transpose(p->map, w, w + d8, w + 2 * d8, NULL, stride, gradient);
}

/* (L) B_0'g_q + B_1'g_qd + B_2'g_qdd */
ambulo_status ambulo__gradient(ambulo_workspace *workspace, double objective_weight,
                               const double *row_weights, double *gradient) {
  double start = ambulo__seconds_now();
  size_t n = (size_t)workspace->problem->variables;
  ambulo__adjoint_begin(workspace, objective_weight, gradient);
  if (row_weights) ambulo__adjoint_rows(workspace, row_weights, gradient);
  pull_back(workspace, gradient);
  int finite = ambulo__all_finite(gradient, n);
  if (!finite) ambulo__fault_of_gradient(workspace, objective_weight, row_weights, gradient);
  workspace->seconds_evaluate += ambulo__seconds_now() - start;
  return finite ? AMBULO_OK : AMBULO_E_NUMERIC;
}

ambulo_status ambulo__term_gradient(ambulo_workspace *workspace, int term, double *gradient) {
  ambulo__adjoint_clear(workspace, gradient);
  ambulo__adjoint_term(workspace, term, 1.0);
  pull_back(workspace, gradient);
  if (ambulo__all_finite(gradient, (size_t)workspace->problem->variables)) return AMBULO_OK;
  ambulo__fault_of_term_gradient(workspace, term, gradient);
  return AMBULO_E_NUMERIC;
}
