/* solver/starts.h - several starts on a coarse grid, and the valleys in which they end. */
#ifndef AMBULO_SOLVER_STARTS_H
#define AMBULO_SOLVER_STARTS_H

#include "ambulo/solve.h"

typedef struct ambulo__valleys {
  ambulo_starts shown;
  ambulo_basin basin[AMBULO_MOST_STARTS];
} ambulo__valleys;

/* Solves the problem from options->starts starts on a coarse grid. *start, to be freed by the
 * caller with the allocator, is where the best of them ends, carried over to the problem's own
 * grid; NULL where that is where the first one ends, which is the solver's own start, or where none
 * ends at a solution. *valleys, to be freed likewise, is NULL when memory runs out: E_MEMORY. */
ambulo_status ambulo__starts(const ambulo_problem *problem, const ambulo_options *options,
                             const ambulo_allocator *allocator, double **start,
                             ambulo__valleys **valleys);

#endif
