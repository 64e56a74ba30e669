/* study/damped_step.h - the step of Gauss-Newton, damped and with a ridge.
 *
 * With J [residuals][parameters] (column-major), r [residuals], u [parameters], the d that
 * minimizes
 *
 *     |r + J d|^2 + ridge |u + d|^2 + damping trace(J'J) / parameters |d|^2
 *
 * over the free parameters; d is 0 at the others. */
#ifndef AMBULO_STUDY_DAMPED_STEP_H
#define AMBULO_STUDY_DAMPED_STEP_H

#include "base/alloc.h"

typedef struct ambulo__damped_system {
  int residuals, parameters;
  const double *jacobian, *residual, *u;
  const unsigned char *is_free; /* [parameters] */
  double ridge;
} ambulo__damped_system;

/* d [parameters]. E_NUMERIC: the system is singular (no ridge, no damping); E_MEMORY. */
ambulo_status ambulo__damped_step(const ambulo__damped_system *system, double damping,
                                  const ambulo_allocator *allocator, double *d);

#endif
