/* solver/better.h - of two points, which one the audit prefers. */
#ifndef AMBULO_SOLVER_BETTER_H
#define AMBULO_SOLVER_BETTER_H

#include "ambulo/solve.h"

/* *better: 1 when the audit finds x better than `before`, with fewer faults and no dearer for it.
 * E_MEMORY and other failures of the audit: *better is 0. */
ambulo_status ambulo__is_better(const ambulo_problem *problem, const ambulo_options *options,
                                const double *before, const double *x,
                                const ambulo_allocator *allocator, int *better);

#endif
