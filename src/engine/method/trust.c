/* method/trust.c - see trust.h */
#include "method/trust.h"

#include "method/parameters.h"

#include <math.h>

double ambulo__trust_damping(ambulo__trust *t, double mu, double reached, const ambulo__trial *at) {
  double promised = fmin(t->predicted, -1e-14);
  double by_step = (t->tried - t->start) / promised, in_all = (reached - t->start) / promised;
  int counts = t->predicted < -AMBULO__GAIN_COUNTS * fabs(at->objective) &&
               at->violation <= AMBULO__ROUGH_VIOLATION;
  t->short_solves = counts && in_all < AMBULO__GAIN_SHORT ? t->short_solves + 1 : 0;
  if (in_all > AMBULO__DAMPING_LOWER_ALL)
    mu = fmax(AMBULO__DAMPING_LEAST * t->damping, mu / AMBULO__DAMPING_CHANGE);
  if (by_step < AMBULO__DAMPING_RAISE_STEP)
    mu = fmax(mu, fmin(AMBULO__DAMPING_LARGEST * t->damping, AMBULO__DAMPING_CHANGE * mu));
  return mu;
}

/* (P.12) */
double ambulo__trust_penalty(ambulo__trust *t, int raised, double rho, double *limit) {
  int patient = t->short_solves > 0 && t->falls < AMBULO__PENALTY_FALLS;
  if (patient && t->short_solves >= AMBULO__SHORT_SOLVES && rho > AMBULO__PENALTY_STIFF) {
    t->falls++;
    t->short_solves = 0;
    *limit = AMBULO__PENALTY_LIMIT;
    return 1.0 / AMBULO__PENALTY_STEP;
  }
  if (!raised || patient) return 1.0;
  return fmax(1.0, fmin(AMBULO__PENALTY_GROWTH, *limit / rho));
}
