/* mechanics/lagrangian.h - the reference recursion: transformation matrices, Eqs. (4)-(12), for one
 * state. The tests compare everything else with it.
 *
 * It allocates nothing: `scratch` has ambulo__lagrangian_scratch_size(model) bytes, aligned for
 * double. The complex form takes interleaved (re, im) pairs everywhere, which is the memory layout
 * of double complex, and serves complex-step derivatives.
 */
#ifndef AMBULO_MECHANICS_LAGRANGIAN_H
#define AMBULO_MECHANICS_LAGRANGIAN_H

#include "ambulo/mechanics.h"

#include <complex.h>

size_t ambulo__lagrangian_scratch_size(const ambulo_model *model);
/* A, B, C forward (Eqs. 4-6), D and E backward (Eqs. 11-12), tau by Eq. (10). */
ambulo_status ambulo__lagrangian_inverse_dynamics(const ambulo_model *model, const double *q,
                                                  const double *qd, const double *qdd,
                                                  const ambulo_outputs *outputs, void *scratch);
ambulo_status ambulo__lagrangian_inverse_dynamics_complex(const ambulo_model *model,
                                                          const double *q, const double *qd,
                                                          const double *qdd,
                                                          const ambulo_outputs *outputs,
                                                          void *scratch);
/* Kinetic and potential energy, J, the latter zero at the world's origin: dE/dt = qd . tau. */
ambulo_status ambulo__lagrangian_energy(const ambulo_model *model, const double *q,
                                        const double *qd, double *kinetic, double *potential,
                                        void *scratch);

/* what the reference recursion leaves in its scratch: the states of
 * the links, in order, in complex numbers (lagrangian.c). */

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
