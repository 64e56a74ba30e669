/* method/augmented.h - the function that NLopt's inner solver minimizes, and its last point. */
#ifndef AMBULO_METHOD_AUGMENTED_H
#define AMBULO_METHOD_AUGMENTED_H

#include "method/engine.h"

/* The last point, kept because objective and rows are asked for separately. */
typedef struct ambulo__held {
  ambulo__trial trial;
  double *w, *gradient; /* [n]: the point, whitened; the gradient by w */
  int is_there;         /* 0: none, or one around another iterate */
  int has_gradient;
  double ceiling; /* highest value since the iterate was set */
} ambulo__held;

ambulo_status ambulo__held_create(ambulo__engine *engine);
/* The iterate, its multipliers or the whitener are others: nothing is known around them. */
void ambulo__held_forget(ambulo__engine *engine);

/* Augmented Lagrangian at retract(x_k + L^-T w); the point in engine->held. gradient [n] may be
 * NULL. A point that cannot be reached, or where something is not finite, has a finite value above
 * that of the iterate. */
double ambulo__augmented(ambulo__engine *engine, const double *w, double *gradient);

#endif
