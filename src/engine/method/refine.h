/* method/refine.h - continuation: coarse grids first. */
#ifndef AMBULO_METHOD_REFINE_H
#define AMBULO_METHOD_REFINE_H

#include "method/engine.h"

/* Solves the engine's problem on coarser grids, each from the one before, and carries the last
 * solution over to x by knot insertion, its multipliers to the engine. *levels: whether any was
 * solved (0: x is as it was). Errors: E_MEMORY. */
ambulo_status ambulo__refine(ambulo__engine *engine, const ambulo_allocator *allocator, double *x,
                             int *levels);

#endif
