/* solver/candidates.h - of all points that a solve came by, the one that it returns. */
#ifndef AMBULO_SOLVER_CANDIDATES_H
#define AMBULO_SOLVER_CANDIDATES_H

#include "method/engine.h"

typedef struct ambulo__candidate {
  double *x;                   /* [n] */
  double violation, objective; /* worst row relative to its size, HUGE_VAL: none; f, not scaled */
} ambulo__candidate;

typedef struct ambulo__candidates {
  ambulo__candidate start, found; /* of the caller; best of the attempts */
  double tolerance;               /* violation that counts as none */
  int n;
} ambulo__candidates;

/* Memory from the engine's pool, which the candidates must not outlive. E_MEMORY. */
ambulo_status ambulo__candidates_create(ambulo__candidates *candidates, ambulo__engine *engine);
/* The caller's start. */
void ambulo__candidates_offer_start(ambulo__candidates *candidates, ambulo__engine *engine,
                                    const double *x);
/* What an attempt found. */
void ambulo__candidates_offer(ambulo__candidates *candidates, ambulo__engine *engine,
                              const double *x);
/* 1 when some attempt found a point that satisfies every row. */
int ambulo__candidates_solved(const ambulo__candidates *candidates);
/* Copies the best point into x; 1 when that is the start. Points that satisfy every row come first,
 * the lowest objective among them; then the smallest violation. A start wins by more than what its
 * rows, held to their tolerance only, may have saved it. */
int ambulo__candidates_take(const ambulo__candidates *candidates, double *x);

/* Worst row at x relative to its size; HUGE_VAL where something is not finite. */
double ambulo__violation_at(ambulo__engine *engine, const double *x);

#endif
