/* method/restore.h - from anywhere to a point that satisfies the equalities. */
#ifndef AMBULO_METHOD_RESTORE_H
#define AMBULO_METHOD_RESTORE_H

#include "method/engine.h"

typedef struct ambulo__restore_scratch {
  double *best, *step;       /* [n]: the point with the least error so far; d */
  double *equality, *border; /* -h, b - C x: [equalities], [borders] */
  double *multiplier;        /* [equalities]: of the step, which nobody asks for */
} ambulo__restore_scratch;

ambulo_status ambulo__restore_create(ambulo__engine *engine);

/* Damped Newton steps of least length to h = 0, C x = b, with the mu of the iterate. Returns the
 * error left; x moves, the iterate with it. E_NUMERIC when no finite point was found. */
ambulo_status ambulo__restore(ambulo__engine *engine, double *x, double *error);

#endif
