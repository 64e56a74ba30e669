/* problem/adjoint.h - the pieces of a reverse sweep (problem/gradient.c).
 *
 * workspace->weight holds the adjoints dL/dy of the channels y.
 */
#ifndef AMBULO_PROBLEM_ADJOINT_H
#define AMBULO_PROBLEM_ADJOINT_H

#include "problem/nlp.h"

/* Adjoints and gradient [variables] to zero. */
void ambulo__adjoint_clear(ambulo_workspace *workspace, double *gradient);
/* Those of objective_weight times all terms, at a point that is evaluated, and gradient to zero. */
void ambulo__adjoint_begin(ambulo_workspace *workspace, double objective_weight, double *gradient);
/* Adds one term of the objective, times objective_weight. */
void ambulo__adjoint_term(ambulo_workspace *workspace, int term, double objective_weight);
/* Adds sum_r weights[r] c_r; what stands on unknowns goes to the gradient at once. */
void ambulo__adjoint_rows(ambulo_workspace *workspace, const double *row_weights, double *gradient);
/* Adds the mechanics' reverse sweep to the adjoints of q, qd, qdd of one block. */
void ambulo__adjoint_block(ambulo_workspace *workspace, int block);

#endif
