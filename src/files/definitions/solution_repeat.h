/* definitions/solution_repeat.h - one period of a motion, repeated over a longer problem. */
#ifndef AMBULO_DEFINITIONS_SOLUTION_REPEAT_H
#define AMBULO_DEFINITIONS_SOLUTION_REPEAT_H

#include "problem/nlp.h"

/* x [variables of p] from `points` [control points of `one`][d], d the coordinates of p, `one`
 * lasting T / count. `ends` periodic or mirrored says how one period follows the other; how far it
 * carries the root is read off the motion itself. Errors: E_MEMORY, E_NUMERIC. */
ambulo_status ambulo__solution_repeat(const ambulo__basis *one, const double *points, int count,
                                      ambulo_ends ends, const ambulo_problem *p,
                                      const ambulo_allocator *allocator, double *x);

#endif
