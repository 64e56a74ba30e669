/* method/model_step.h - the step that foresees which rows become active: the minimum of a piecewise
 * quadratic model phi of the augmented Lagrangian. */
#ifndef AMBULO_METHOD_MODEL_STEP_H
#define AMBULO_METHOD_MODEL_STEP_H

#include "method/engine.h"

/* phi and where its minimization stands. What it is made of comes first, then what comes out, then
 * scratch. */
typedef struct ambulo__quadratic {
  int n, inequalities;
  const double *lambda;          /* the iterate's */
  double *gradient;              /* [n]: g */
  double *linear;                /* [inequalities]: v + J d; the excesses v on entry */
  double *total;                 /* [n]: d, the step */
  double *force;                 /* [inequalities]: of the rows, max(0, lambda + rho (v + J d)) */
  double rho;                    /* of phi: the iterate's, or a larger one */
  int warm;                      /* `active` is of the last model step, and good for the next */
  int *active, *added;           /* [inequalities]: with a force; in whitener and kkt */
  double *step, *right;          /* [n]: Newton step, its right-hand side */
  double *curved, *curved_total; /* [n]: H0 step, H0 d */
  double *along;                 /* [inequalities]: J step */
  double *best_total, *best_curved, *best_linear; /* at the best point so far */
} ambulo__quadratic;

ambulo_status ambulo__quadratic_create(ambulo__engine *engine);

/* Minimizes phi at the iterate, sets whitener and kkt; step in quadratic->total. Returns 0; 1 when
 * a factorization failed; 2 when a value or a derivative is not finite, which the run remembers. */
int ambulo__model_step(ambulo__engine *engine, double *predicted);
/* Its inner part: minimizes phi for linearized.base, the iterate's lambda, this rho, and gradient
 * and linear (excesses at d = 0) of the quadratic; whoever fills the base resets
 * linearized.assembled. Multipliers of equalities and border rows go to
 * the iterate. `roughly`: from the last active set where it is good, and no further than a step
 * needs. 0, or -1 when a factorization failed or the run is late. *phi: decrease (<= 0). */
int ambulo__model_minimize(ambulo__engine *engine, double rho, int roughly, double *phi);

#endif
