/* study/fit_evaluate.h - the solves of trials, as cases of a batch in DIR/solves.
 *
 * A round is all that can be solved at once: every condition of every trial of it. Its cases are
 * added to the list of the run and the batch is run again, which finds those before it done. An id
 * is the hash of the case's overrides and start, so a run that is repeated asks for the same cases
 * in the same order and computes only what is not there: to resume is to repeat. A case starts from
 * the solution of the same condition at the trial that the round begins from, which depends neither
 * on the number of workers nor on which of them is first. */
#ifndef AMBULO_STUDY_FIT_EVALUATE_H
#define AMBULO_STUDY_FIT_EVALUATE_H

#include "study/fit_trial.h"
#include "study/sweep.h"

/* Which conditions, and what they start from. */
typedef enum ambulo__fit_scope {
  AMBULO__FIT_FITTED,    /* those that count */
  AMBULO__FIT_ALL,       /* the held-out ones too */
  AMBULO__FIT_HELD_OUT,  /* those alone */
  AMBULO__FIT_FROM_ZERO, /* all, each by itself, as `ambulo solve` begins */
  AMBULO__FIT_FRESH      /* those that count, each by itself */
} ambulo__fit_scope;

typedef struct ambulo__fit_runner {
  const ambulo_fit *fit;
  const ambulo_fit_options *options;
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  char *solves; /* path of the batch folder */
  ambulo_sweep *sweep;
  int points;             /* most of a target */
  double *values, *block; /* [points], [most residuals of a condition] */
  double weights;         /* sum over fitted conditions and their targets */
  double begin, solving;  /* s; of rounds that computed something */
  int before;             /* cases of earlier rounds */
  int computed;           /* solves of this run */
  int told;               /* 1: warnings about motions were passed on */
  int wish;               /* of the caller: 1, 2: stop */
  ambulo_fit_progress progress;
} ambulo__fit_runner;

/* Fills *runner; ambulo__fit_runner_close releases it, filled or not. Errors as of
 * ambulo_sweep_load. */
ambulo_status ambulo__fit_runner_open(const ambulo_fit *fit, const char *directory,
                                      const ambulo_fit_options *options,
                                      const ambulo_allocator *allocator,
                                      ambulo_diagnostics *diagnostics, ambulo__fit_runner *runner);
void ambulo__fit_runner_close(ambulo__fit_runner *runner);

/* Solves and scores trials; from: the one whose solutions they start from (NULL: zero, or `after`).
 * Errors: as of ambulo_batch_run; E_PROBLEM (a motion lacks a curve). */
ambulo_status ambulo__fit_evaluate(ambulo__fit_runner *runner, ambulo__fit_scope scope,
                                   const ambulo__fit_trial *from, ambulo__fit_trial *trials,
                                   int count);
/* refresh.c: puts the solutions of `fresh`, of the same parameters, in place of those whose
 * objective is greater, or that are none, in the conditions that both have. Errors: E_IO, E_MEMORY.
 */
ambulo_status ambulo__fit_take_better(const ambulo__fit_runner *runner,
                                      const ambulo__fit_sizes *sizes,
                                      const ambulo__fit_trial *fresh, ambulo__fit_trial *trial);
/* Solves the conditions that count once more from zero, where the trial stands, and takes what is
 * better: a problem predicts its least objective, wherever the fit came from. Errors as above. */
ambulo_status ambulo__fit_refresh(ambulo__fit_runner *runner, const ambulo__fit_sizes *sizes,
                                  ambulo__fit_trial *trial);
/* What the record of a solve says; "missing" where there is none. */
ambulo_status ambulo__fit_state(const ambulo__fit_runner *runner, int index, char state[24]);

#endif
