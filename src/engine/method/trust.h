/* method/trust.h - how far the model step is trusted: the damping mu, and when R is too stiff.
 *
 * The model promises a descent of F, `predicted`. What the model step itself and the whole inner
 * solve brought of it says whether the model is damped too much or too little; and whether L-BFGS
 * could follow it at all. Where it could not, rows that do not hold are unfinished work: R does not
 * grow for them, and after SHORT_SOLVES such inner solves it falls.
 */
#ifndef AMBULO_METHOD_TRUST_H
#define AMBULO_METHOD_TRUST_H

typedef struct ambulo__trust {
  double damping;   /* mu at the beginning */
  double start;     /* F where the chart was laid */
  double predicted; /* what the model step promised that F changes by */
  double tried;     /* F at the model step */
  int short_solves; /* inner solves in a row that brought too little */
} ambulo__trust;

/* mu after an inner solve that ended at F = reached; f: the objective there. */
double ambulo__trust_damping(ambulo__trust *trust, double mu, double reached, double f);

/* Factor of R after it, where NLopt raises the penalty (`raised`) or not; *limit, the bound of R,
 * begins anew where R falls. */
double ambulo__trust_penalty(ambulo__trust *trust, int raised, double rho, double *limit);

#endif
