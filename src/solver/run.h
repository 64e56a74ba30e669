/* solver/run.h - one call of the solver: its clock, its limits, its counters. */
#ifndef AMBULO_SOLVER_RUN_H
#define AMBULO_SOLVER_RUN_H

#include "nlp/states.h"
#include "solver/verdict.h"

typedef struct ambulo__run {
  const ambulo_options *options;
  double started; /* s, monotonic clock */
  int evaluations, iterations;
  int stopped; /* a limit was met or the caller said stop */
  ambulo__ending_kind ending;
  double seconds_evaluate, seconds_linear, seconds_nlopt;
} ambulo__run;

void ambulo__run_begin(ambulo__run *run, const ambulo_options *options);
/* Counts one evaluation; returns 1 when the solve has to end. */
int ambulo__run_count(ambulo__run *run);
/* 1 when the time or the evaluations are used up or the caller said stop. */
int ambulo__run_over(ambulo__run *run);
/* Tells the caller's callback; 1 when it says stop. */
int ambulo__run_progress(ambulo__run *run, double objective, double violation);

#endif
