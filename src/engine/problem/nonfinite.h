/* problem/nonfinite.h - which value or derivative is not finite, once one was seen.
 *
 * Looking for it costs a few evaluations. The functions write workspace->fault.
 */
#ifndef AMBULO_PROBLEM_NONFINITE_H
#define AMBULO_PROBLEM_NONFINITE_H

#include "problem/nlp.h"

/* After an evaluation with a row or an objective that is not finite. */
void ambulo__fault_of_values(ambulo_workspace *workspace);
/* After a gradient that is not finite; the arguments as in ambulo__gradient. */
void ambulo__fault_of_gradient(ambulo_workspace *workspace, double objective_weight,
                               const double *row_weights, const double *gradient);
/* second derivatives of the objective, sizes that are not finite */
void ambulo__fault_of_curvature(ambulo_workspace *workspace, double value);
void ambulo__fault_of_term_gradient(ambulo_workspace *workspace, int term, const double *gradient);
/* A row whose derivative by unknown `variable` is `value`. */
void ambulo__fault_of_row(ambulo_workspace *workspace, int row, int variable, double value);

#endif
