/* method/trial.h - a point of the augmented Lagrangian and what belongs to it. */
#ifndef AMBULO_METHOD_TRIAL_H
#define AMBULO_METHOD_TRIAL_H

#include "linear/pool.h"

typedef struct ambulo__trial {
  int n, inequalities, equalities;
  double value;                /* augmented Lagrangian; not < HUGE_VAL: none */
  double objective;            /* f, scaled */
  double violation;            /* worst inequality, relative to its size */
  double gradient_norm;        /* of the reduced, whitened gradient; < 0: not computed */
  double *x;                   /* [n] */
  double *excess;              /* [inequalities] */
  double *multiplier;          /* [inequalities]: max(0, lambda + rho v) */
  double *equality_multiplier; /* [equalities]: once the gradient is there */
} ambulo__trial;

/* A point without a value. E_MEMORY. */
ambulo_status ambulo__trial_create(int n, int inequalities, int equalities, ambulo__pool *pool,
                                   ambulo__trial *trial);
/* Between two of one size. */
void ambulo__trial_copy(const ambulo__trial *from, ambulo__trial *to);

#endif
