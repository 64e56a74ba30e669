/* linear/mixing.h - Anderson mixing of a fixed-point iteration. */
#ifndef AMBULO_LINEAR_MIXING_H
#define AMBULO_LINEAR_MIXING_H

#include "linear/pool.h"

#define AMBULO__MIXING_DEPTH 5

typedef struct ambulo__mixing {
  int points, residuals; /* lengths */
  int count, next;       /* pairs held; where the next goes */
  double *point[AMBULO__MIXING_DEPTH];
  double *residual[AMBULO__MIXING_DEPTH];
} ambulo__mixing;

ambulo_status ambulo__mixing_create(ambulo__pool *pool, int points, int residuals,
                                    ambulo__mixing *mixing);
void ambulo__mixing_reset(ambulo__mixing *mixing);
/* Given the image of an iterate under the fixed-point map and the iterate's residual,
 * replaces the image by the mixture of the last images whose residuals cancel best.
 * Coefficients sum to one. */
void ambulo__mixing_apply(ambulo__mixing *mixing, const double *residual, double *image);

#endif
