/* method/refine.h - continuation: coarse grids first. */
#ifndef AMBULO_METHOD_REFINE_H
#define AMBULO_METHOD_REFINE_H

#include "method/engine.h"

/* Solves the engine's problem on coarser grids, each from the one before, and carries the last
 * solution over to x by knot insertion, its multipliers to the engine. *levels: whether any was
 * solved (0: x is as it was). Errors: E_MEMORY. */
ambulo_status ambulo__refine(ambulo__engine *engine, const ambulo_allocator *allocator, double *x,
                             int *levels);

/* multipliers of one grid, for another.
 *
 * The multiplier of a row that holds all along is a density over time, times the time of its node.
 * Taken as such from a coarse grid, linear in time between its nodes, it tells the finer grid which
 * rows carry a force, and how much.
 */

typedef struct ambulo__saved_row {
  unsigned long long series; /* the same for rows of one family, subject and detail */
  double time, density;      /* s; of the multiplier, objective not scaled */
} ambulo__saved_row;

typedef struct ambulo__saved_multipliers {
  ambulo__saved_row *row; /* [count], by series and time */
  int count;
  double interval;  /* s, between nodes */
  double objective; /* not scaled */
} ambulo__saved_multipliers;

/* The multipliers that the engine ended with. E_MEMORY. */
ambulo_status ambulo__multipliers_save(const ambulo__engine *engine,
                                       const ambulo_allocator *allocator,
                                       ambulo__saved_multipliers *carried);
/* Sets the engine's multipliers; what the other grid has no rows for starts at zero. */
void ambulo__multipliers_transfer(const ambulo__saved_multipliers *carried, ambulo__engine *engine);
void ambulo__multipliers_free(const ambulo_allocator *allocator,
                              ambulo__saved_multipliers *carried);

#endif
