/* study/fit_trial.h - the problem with its parameters somewhere, solved in every condition; and
 * what the search for better ones is given. */
#ifndef AMBULO_STUDY_FIT_TRIAL_H
#define AMBULO_STUDY_FIT_TRIAL_H

#include "study/fit_residual.h"

enum { AMBULO__FIT_LABEL = 96 };

/* Numbers of what the arrays hold. */
typedef struct ambulo__fit_sizes {
  int parameters, residuals, conditions, curves;
} ambulo__fit_sizes;

typedef struct ambulo__fit_trial {
  double *u;                /* [parameters], in steps */
  double *residual;         /* [residuals], with their weights */
  double distance, cost;    /* D; with the ridge */
  int *index;               /* [conditions] place of the case in the list of solves; -1: none */
  unsigned char *solved;    /* [conditions] */
  double *apart;            /* [conditions] distance of each by itself; NaN: not evaluated */
  ambulo__fit_score *score; /* [conditions][curves] */
  int complete;             /* 0: the run was stopped before it was solved */
  char label[AMBULO__FIT_LABEL];
} ambulo__fit_trial;

/* One block of `count` trials, to be freed; u = 0, nothing evaluated. NULL: no memory. */
ambulo__fit_trial *ambulo__fit_trials_make(const ambulo__fit_sizes *sizes, int count,
                                           const ambulo_allocator *allocator);
/* All of one to another. */
void ambulo__fit_trial_copy(const ambulo__fit_sizes *sizes, const ambulo__fit_trial *from,
                            ambulo__fit_trial *to);

/* What became of an iteration. */
typedef struct ambulo__fit_step {
  double distance, cost; /* of the best trial after it */
  double damping;        /* of the accepted candidate; NaN: none */
  int dropped;           /* columns of the Jacobian that are no derivatives */
  const char *accepted;  /* "candidate", "difference", "none", "start" */
} ambulo__fit_step;

/* What the search is given. */
typedef struct ambulo__fit_task {
  ambulo__fit_sizes sizes;
  const double *lower, *upper; /* [parameters] of u */
  double ridge, tolerance;
  int iterations;
  const ambulo_allocator *allocator;
  /* Fills residual, distance, index, solved of count trials, each started from the solutions of
   * `from`. A stop of the caller leaves some of them not complete. */
  ambulo_status (*evaluate)(void *user, const ambulo__fit_trial *from, ambulo__fit_trial *trials,
                            int count);
  /* Looks, where the best trial stands, for solutions that are better than those it followed, and
   * puts them into it; its distance may rise. */
  ambulo_status (*refresh)(void *user, ambulo__fit_trial *best);
  /* After each iteration. */
  ambulo_status (*note)(void *user, const ambulo__fit_step *step);
  void *user;
} ambulo__fit_task;

/* Cost of an evaluated trial: D + ridge |u|^2 / parameters. */
double ambulo__fit_cost(const ambulo__fit_task *task, const ambulo__fit_trial *trial);

/* fit_search.c: from *best, an evaluated trial, to a better one. sensitivity [parameters]:
 * |dr/du_i| where it was found last; NaN where it was not. *stuck: the condition whose solves all
 * failed. Errors: what evaluate, refresh and note return, E_MEMORY. */
ambulo_status ambulo__fit_search(const ambulo__fit_task *task, ambulo__fit_trial *best,
                                 double *sensitivity, ambulo_fit_ending *ending, int *stuck);

#endif
