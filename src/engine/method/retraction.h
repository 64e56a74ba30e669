/* method/retraction.h - points on the equalities' surface, and gradients along it, with the factor
 * of the last model step. */
#ifndef AMBULO_METHOD_RETRACTION_H
#define AMBULO_METHOD_RETRACTION_H

#include "linear/kkt.h"
#include "method/engine.h"

/* The first two are for whoever needs other tolerances for a while, the rest is scratch. */
typedef struct ambulo__retraction {
  double tolerance;                     /* worst equality of a retracted point */
  double adjoint_tolerance;             /* relative error of a reduced gradient */
  ambulo__mixing points, adjoint;       /* of points; of multipliers l */
  double *step, *gradient;              /* [n]: of a chord; G + J' l */
  double *previous, *previous_gradient; /* [n]: z and right-hand side of the pass before */
  double *along;                        /* [equalities]: J_k z */
  double *force, *balanced;             /* [equalities]: S h, S^1/2 h (or of J_k z) */
  double *border;                       /* [borders]: b - C y */
} ambulo__retraction;

ambulo_status ambulo__retraction_create(ambulo__engine *engine);

/* Moves y along the metric's normal directions until |h| <= tolerance; the workspace then holds
 * it. 0 when that fails. */
int ambulo__retract(ambulo__engine *engine, double *y);
/* z, the tangent representative of the gradient of scale f + sum p v: see retraction.c. scale and p
 * as in ambulo__engine_gradient. l [equalities]: first guess and result. E_NUMERIC as there. */
ambulo_status ambulo__reduced_gradient(ambulo__engine *engine, double scale, const double *p,
                                       double *l, double *z);

#endif
