/* mechanics/lagrangian.h - the reference recursion: transformation matrices, Eqs. (4)-(12), for one
 * state. The tests compare everything else with it.
 *
 * It allocates nothing: `scratch` has ambulo__lagrangian_scratch_size(model) bytes, aligned for
 * double.
 */
#ifndef AMBULO_MECHANICS_LAGRANGIAN_H
#define AMBULO_MECHANICS_LAGRANGIAN_H

#include "ambulo/mechanics.h"

#include <complex.h>

size_t ambulo__lagrangian_scratch_size(const ambulo_model *model);
/* A, B, C forward (Eqs. 4-6), D and E backward (Eqs. 11-12), tau by Eq. (10). is_complex: q, qd,
 * qdd and the outputs are pairs (re, im), the memory layout of double complex, for derivatives by
 * complex steps. Errors: E_ARGUMENT, E_NUMERIC. */
ambulo_status ambulo__lagrangian(int is_complex, const ambulo_model *model, const double *q,
                                 const double *qd, const double *qdd, const ambulo_outputs *outputs,
                                 void *scratch);

/* What it leaves in its scratch: the states of the links, in order, in complex numbers. */

typedef double complex scalar;

typedef struct matrix {
  scalar e[3][4];
} matrix;

typedef struct link_state {
  matrix t, t1, t2;     /* T, T', T'' */
  scalar slope;         /* of the joint's value by the coordinate that moves it */
  matrix a, b, c;       /* A, B, C */
  scalar d[4][3], e[4]; /* D, E */
} link_state;

#endif
