/* solver/audit.h - how good a point is, recomputed from its unknowns alone. */
#ifndef AMBULO_SOLVER_AUDIT_H
#define AMBULO_SOLVER_AUDIT_H

#include "method/engine.h"
#include "solver/result.h"

/* Fills result (x must be set): objective, terms, rows, violations per family,
 * multipliers, KKT residual, rank, and what is not finite. `engine` belongs to the same
 * problem; its state is used up. A run that was stopped and is late (run.h) gets what takes one
 * evaluation, the rest stays unknown. E_MEMORY. */
ambulo_status ambulo__audit(ambulo__engine *engine, const ambulo_options *options,
                            ambulo_result *result);

/* Of a point that no engine could be made for: objective, terms, rows, violations. What it takes
 * gradients for stays unknown. E_MEMORY. */
ambulo_status ambulo__audit_values(ambulo_workspace *workspace, ambulo_result *result);

/* Violation of one row's value: |c| or max(0, -c); infinite when it is not finite. */
double ambulo__row_violation(const ambulo_problem *problem, int row, double value);
/* The same with its names. */
ambulo_violation ambulo__violation_of(const ambulo_problem *problem, int row, double value);

#endif
