/* solver/audit.h - how good a point is, recomputed from its unknowns alone. */
#ifndef AMBULO_SOLVER_AUDIT_H
#define AMBULO_SOLVER_AUDIT_H

#include "solver/engine.h"
#include "solver/result.h"

/* Fills result (x must be set): objective, terms, rows, violations per family, dense
 * violation, multipliers, KKT residual, rank. `engine` belongs to the same problem; its
 * state is used up. E_MEMORY. */
ambulo_status ambulo__audit(ambulo__engine *engine, const ambulo_options *options,
                            ambulo_result *result);

/* audit_dense.c: violations between the nodes, of inequalities and contacts, on a grid
 * `samples` times as fine with the same trajectory. A worst of NAN (family "") when the
 * finer grid cannot be built. E_MEMORY. */
ambulo_status ambulo__audit_dense(const ambulo_problem *problem, const double *x, int samples,
                                  const ambulo_allocator *allocator, ambulo_violation *worst);

/* Violation of one row's value: |c| or max(0, -c). */
double ambulo__row_violation(const ambulo_problem *problem, int row, double value);

#endif
