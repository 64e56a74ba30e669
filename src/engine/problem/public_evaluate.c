/* problem/public_evaluate.c - evaluation behind the public names (ambulo/evaluate.h). */
#include "problem/fault.h"
#include "problem/nlp.h"

#include <math.h>
#include <string.h>

ambulo_status ambulo_problem_evaluate(const ambulo_problem *p, ambulo_workspace *workspace,
                                      const double *x, double *objective, double *terms,
                                      double *rows) {
  if (!p || !workspace || workspace->problem != p || !x) return AMBULO_E_ARGUMENT;
  ambulo_status status = ambulo__evaluate(workspace, x);
  if (status) return status;
  if (objective) *objective = workspace->objective;
  if (terms) memcpy(terms, workspace->term_value, (size_t)p->definition.term_count * sizeof *terms);
  if (rows) memcpy(rows, workspace->row_value, (size_t)p->rows * sizeof *rows);
  return AMBULO_OK;
}

ambulo_status ambulo_problem_gradient(const ambulo_problem *p, ambulo_workspace *workspace,
                                      const double *x, double objective_weight,
                                      const double *row_weights, double *gradient) {
  if (!p || !workspace || workspace->problem != p || !x || !gradient) return AMBULO_E_ARGUMENT;
  ambulo_status status = ambulo__evaluate(workspace, x);
  if (status) return status;
  return ambulo__gradient(workspace, objective_weight, row_weights, gradient);
}

ambulo_status ambulo_problem_row_gradient(const ambulo_problem *p, ambulo_workspace *workspace,
                                          const double *x, int row, double *gradient) {
  if (!p || !workspace || workspace->problem != p || !x || !gradient) return AMBULO_E_ARGUMENT;
  if (row < 0 || row >= p->rows) return AMBULO_E_ARGUMENT;
  ambulo_status status = ambulo__evaluate_jacobian(workspace, x);
  if (status) return status;
  memset(gradient, 0, (size_t)p->variables * sizeof *gradient);
  ambulo__row_add_gradient(workspace, row, 1.0, gradient);
  for (int j = 0; j < p->variables; j++) {
    if (isfinite(gradient[j])) continue;
    ambulo__fault_of_row(workspace, row, j, gradient[j]);
    return AMBULO_E_NUMERIC;
  }
  return AMBULO_OK;
}

const ambulo_fault *ambulo_workspace_fault(const ambulo_workspace *workspace) {
  return &workspace->fault;
}
