/* mechanics/lagrangian_state.h - what the reference recursion leaves in its scratch: the states of
 * the links, in order, in complex numbers (lagrangian.c). */
#ifndef AMBULO_MECHANICS_LAGRANGIAN_STATE_H
#define AMBULO_MECHANICS_LAGRANGIAN_STATE_H

#include <complex.h>

typedef double complex scalar;

typedef struct matrix {
  scalar e[3][4];
} matrix;

typedef struct link_state {
  matrix t, t1, t2;     /* T, T', T'' */
  matrix a, b, c;       /* A, B, C */
  scalar d[4][3], e[4]; /* D, E */
} link_state;

#endif
