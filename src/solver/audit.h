/* solver/audit.h - how good a point is, recomputed from its unknowns alone. */
#ifndef AMBULO_SOLVER_AUDIT_H
#define AMBULO_SOLVER_AUDIT_H

#include "solver/engine.h"
#include "solver/result.h"

/* Fills result (x must be set): objective, terms, rows, violations per family, multipliers, KKT
 * residual, rank. What happens between the nodes: solver/dense_audit.h. `engine` belongs to the
 * same problem; its state is used up. E_MEMORY. */
ambulo_status ambulo__audit(ambulo__engine *engine, const ambulo_options *options,
                            ambulo_result *result);

/* Violation of one row's value: |c| or max(0, -c). */
double ambulo__row_violation(const ambulo_problem *problem, int row, double value);

#endif
