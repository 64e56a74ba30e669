/* solver/refine.h - continuation: coarse grids first. */
#ifndef AMBULO_SOLVER_REFINE_H
#define AMBULO_SOLVER_REFINE_H

#include "solver/engine.h"

/* Solves the problem on coarser grids, each from the one before, and carries the last
 * solution over to x by knot insertion. *levels: how many were solved (0: x is as it was).
 * Errors: E_MEMORY. */
ambulo_status ambulo__refine(const ambulo_problem *problem, const ambulo_allocator *allocator,
                             ambulo__run *run, double *x, int *levels);

#endif
