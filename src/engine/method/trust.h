/* method/trust.h - how far the model step is trusted: the damping mu, and when R is too stiff.
 *
 * The model promises a descent of F, `predicted`. What the model step itself and the whole inner
 * solve brought of it says whether the model is damped too much or too little; and whether L-BFGS
 * could follow it at all. Where it could not, near a solution, rows that do not hold are unfinished
 * work: R does not grow for them, and after SHORT_SOLVES such inner solves it falls. That happens
 * PENALTY_FALLS times at most: rows that contradict each other need a penalty that grows.
 */
#ifndef AMBULO_METHOD_TRUST_H
#define AMBULO_METHOD_TRUST_H

#include "method/engine.h"

typedef struct ambulo__trust {
  double damping;   /* mu at the beginning */
  double start;     /* F where the chart was laid */
  double predicted; /* what the model step promised that F changes by */
  double tried;     /* F at the model step */
  int short_solves; /* inner solves in a row that brought too little */
  int falls;        /* of R so far */
} ambulo__trust;

/* mu after an inner solve that ended at F = reached, the point `at`. */
double ambulo__trust_damping(ambulo__trust *trust, double mu, double reached,
                             const ambulo__trial *at);

/* Factor of R after it, where NLopt raises the penalty (`raised`) or not; *limit, the bound of R,
 * begins anew where R falls. */
double ambulo__trust_penalty(ambulo__trust *trust, int raised, double rho, double *limit);

#endif
