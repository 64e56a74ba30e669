/* method/run.h - one call of the solver: its clock, its limits, its counters, and what it met. */
#ifndef AMBULO_METHOD_RUN_H
#define AMBULO_METHOD_RUN_H

#include "ambulo/solve.h"
#include "linear/sparse_rows.h"
#include "problem/callbacks.h"

/* What a solve passed through, in bounded memory. */
enum { AMBULO__HISTORY_MOST = 256 };

typedef struct ambulo__history {
  ambulo_history shown; /* its items are those below; `every` as there */
  int number;           /* of the last iteration on its grid, from 0 on */
  int passing;          /* 1: the last item stands only until its grid has a next one */
  ambulo_iteration item[AMBULO__HISTORY_MOST];
} ambulo__history;

typedef struct ambulo__run {
  const ambulo_options *options;
  double started; /* s, monotonic clock */
  double stopped_at, polled_at;
  const char *stage;             /* what is being done, for the caller's callback */
  const ambulo_problem *problem; /* that is solved, and where its solve stands; for the same */
  const double *point;
  int evaluations, iterations;
  int stopped;          /* a limit was met or the caller said stop */
  ambulo_ending ending; /* of the run while `stopped`, else of the method that ran last */
  int faults;           /* points that were rejected because something was not finite */
  int faults_lately;    /* of these, since the last iteration that brought a point */
  int breakdowns;       /* metrics that could not be factored, since then */
  ambulo_fault fault, first_fault; /* the first of those lately; of all */
  ambulo_nlopt_work nlopt;
  int unpolished;    /* 1: what a limit cuts short stays as it is */
  int own_gradients; /* NLopt's multipliers are not those of mirror.h */
  double seconds_evaluate, seconds_linear;
  ambulo__history *history; /* NULL: none is kept */
} ambulo__run;

void ambulo__run_begin(ambulo__run *run, const ambulo_options *options);
/* Counts one evaluation; returns 1 when the solve has to end. */
int ambulo__run_count(ambulo__run *run);
/* 1 when the time or the evaluations are used up or the caller said stop. */
int ambulo__run_over(ambulo__run *run);
/* An iteration on a grid of so many intervals has ended (ambulo_iteration): keeps it and tells the
 * caller's callback; 1 when that says stop. */
int ambulo__run_iteration(ambulo__run *run, int intervals, double objective, double violation,
                          double gradient);
/* Tells the caller's callback; 1 when it says stop. */
int ambulo__run_progress(ambulo__run *run, double objective, double violation);
/* The same from work that has no numbers to show, at most every tenth of a second; also looks at
 * the clock. 1 when the work is to end. `run` may be NULL: never. */
int ambulo__run_poll(ambulo__run *run);
/* The same question, for work that knows nothing of runs. */
ambulo__poll ambulo__run_poller(ambulo__run *run);
/* 1 when a run that was stopped by the clock or the caller has also used up its grace: what it
 * takes to say what it found, a tenth of the time it had, and at least a quarter of a second. */
int ambulo__run_late(const ambulo__run *run);
/* One call of NLopt: what it returned, its own time in s. */
void ambulo__run_nlopt(ambulo__run *run, int result, double seconds);
/* NLopt's name of its result, without the prefix. */
const char *ambulo__nlopt_name(int result);
/* A method ends for a reason of its own; a limit that stopped the run stays. */
void ambulo__run_end(ambulo__run *run, ambulo_ending ending);
/* Something was not finite at a point that is rejected. */
void ambulo__run_fault(ambulo__run *run, const ambulo_fault *fault);
/* A method has found a point: what was not finite on the way did not keep it from that. */
void ambulo__run_forgive(ambulo__run *run);

/* Empty. NULL: no memory. */
ambulo__history *ambulo__history_create(const ambulo_allocator *allocator);
/* `history` may be NULL: nothing is kept. */
void ambulo__history_add(ambulo__history *history, const ambulo_iteration *iteration);

#endif
