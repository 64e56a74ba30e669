/* method/polish.h - the last micrometres: Newton steps on the rows. */
#ifndef AMBULO_METHOD_POLISH_H
#define AMBULO_METHOD_POLISH_H

#include "method/engine.h"

typedef struct ambulo__polish_scratch {
  double *x; /* [n]: the point so far */
} ambulo__polish_scratch;

ambulo_status ambulo__polish_create(ambulo__engine *engine);

/* Moves x by a few Newton steps until the inequalities hold; 1 on
 * success, else x stays: also when the objective rises by more than the multipliers foretell,
 * unless `anyhow`. engine->reached must belong to x; its multipliers become the iterate's. */
int ambulo__polish(ambulo__engine *engine, int anyhow, double *x);

#endif
