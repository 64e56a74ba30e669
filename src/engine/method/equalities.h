/* method/equalities.h - from anywhere to a point that satisfies the equalities; points on their
 * surface, and gradients along it, with the factor of the last model step. */
#ifndef AMBULO_METHOD_EQUALITIES_H
#define AMBULO_METHOD_EQUALITIES_H

#include "linear/kkt.h"
#include "method/engine.h"

/* The first two are the tolerances, the rest is scratch. */
typedef struct ambulo__retraction {
  double tolerance;                     /* worst equality of a retracted point */
  double adjoint_tolerance;             /* relative error of a reduced gradient */
  ambulo__mixing points, adjoint;       /* of points; of multipliers l */
  double *step, *gradient;              /* [n]: of a chord or of restoration; G + J' l */
  double *previous, *previous_gradient; /* [n]: z and right-hand side of the pass before */
  double *along;                        /* [equalities]: J_k z */
  double *force, *balanced;             /* [equalities]: S h, S^1/2 h (or of J_k z) */
  double *nearest;                      /* [n]: the point of restoration with the least error */
  double *border;                       /* [borders]: b - C y */
} ambulo__retraction;

ambulo_status ambulo__retraction_create(ambulo__engine *engine);

/* Damped Newton steps of least length to h = 0, C x = b, with the mu of the iterate. Returns the
 * error left; x moves, the iterate with it. E_NUMERIC when no finite point was found. */
ambulo_status ambulo__restore(ambulo__engine *engine, double *x, double *error);

/* Moves y along the metric's normal directions until |h| <= tolerance; the workspace then holds
 * it. 0 when that fails. */
int ambulo__retract(ambulo__engine *engine, double *y);
/* z, the tangent representative of the gradient of scale f + sum p v: see equalities.c. scale and p
 * as in ambulo__engine_gradient. l [equalities]: first guess and result. E_NUMERIC as there. */
ambulo_status ambulo__reduced_gradient(ambulo__engine *engine, double scale, const double *p,
                                       double *l, double *z);

#endif
