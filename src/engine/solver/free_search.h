/* solver/free_search.h - a run over free parameters: what its files share.
 *
 * A trial is one inner solve at some values: problem, result, messages. The run keeps the best one,
 * from which the next starts.
 */
#ifndef AMBULO_SOLVER_FREE_SEARCH_H
#define AMBULO_SOLVER_FREE_SEARCH_H

#include "ambulo/parameters.h"
#include "solver/sensitivity.h"

/* One inner solve. */
typedef struct ambulo__outer_trial {
  double *value, *gradient; /* [count]: p and dF/dp */
  double objective;         /* F; HUGE_VAL: rejected; NaN: not tried */
  double distance;          /* D */
  ambulo_problem *problem;
  ambulo_result *result; /* NULL: there is no problem at these values */
  ambulo_diagnostics *messages;
} ambulo__outer_trial;

typedef struct ambulo__outer {
  ambulo_allocator allocator;
  ambulo_diagnostics *diagnostics;
  const ambulo_problem *problem; /* the caller's */
  ambulo_parameters parameters;
  ambulo_options options; /* of the whole run */
  const double *start;
  double started;                   /* s */
  ambulo__parameters known;         /* what the problem's numbers are called */
  ambulo__parameter **which;        /* [count]: the free ones among them */
  double first;                     /* F where the run began */
  ambulo__outer_trial best, latest; /* best.result NULL before the first solve */
  int solves, failed, evaluations;
  int converged;        /* dF/dp is small at the best values, or points out of the bounds */
  int settled;          /* F and p do not change any more */
  int near;             /* trials in a row whose F was that of the best */
  ambulo_status status; /* of a failure that ends the run */
  ambulo_ending ending; /* a limit, or the caller; NONE: none */
} ambulo__outer;

/* free_trial.c: builds and solves the problem at run->latest.value, from the best solution so far;
 * F and dF/dp. Whatever goes wrong with the values is HUGE_VAL; E_MEMORY and the like end the run.
 */
ambulo_status ambulo__outer_try(ambulo__outer *run);
/* 1 when a limit was met or the caller said stop (run->ending). */
int ambulo__outer_over(ambulo__outer *run);
/* Frees problem, result and messages, keeps the numbers. */
void ambulo__outer_drop(ambulo__outer_trial *trial);
/* -1, 1: p_i is at its lower, its upper bound; 0: between. */
int ambulo__outer_bound(const ambulo__outer *run, const double *value, int i);

/* The parameters, of which a copy is kept, are what the problem has free. E_MEMORY.
 */
ambulo_status ambulo__free_keep(ambulo_problem *problem, const ambulo_parameters *parameters);

#endif
