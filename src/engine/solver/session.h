/* solver/session.h - one call of ambulo_solve or ambulo_audit_point, from its arguments to its
 * result.
 */
#ifndef AMBULO_SOLVER_SESSION_H
#define AMBULO_SOLVER_SESSION_H

#include "solver/result.h"

/* Of all points that a solve came by, the one that it returns. */
typedef struct ambulo__candidate {
  double *x;                   /* [n] */
  double violation, objective; /* worst row relative to its size, HUGE_VAL: none; f, not scaled */
} ambulo__candidate;

typedef struct ambulo__candidates {
  ambulo__candidate start, found; /* of the caller; best of the attempts */
  double tolerance;               /* violation that counts as none */
  int n;
} ambulo__candidates;

/* *own: what the caller gave, of whatever age; NULL: those of the problem. E_ARGUMENT with the
 * option's name and its range. */
ambulo_status ambulo__options_own(const ambulo_problem *problem, const ambulo_options *given,
                                  ambulo_diagnostics *diagnostics, ambulo_options *own);

/* E_LIMIT with the figures when a solve with these options would not fit. */
ambulo_status ambulo__solve_check_memory(const ambulo_problem *problem,
                                         const ambulo_options *options,
                                         ambulo_diagnostics *diagnostics);

typedef struct ambulo__session {
  const ambulo_problem *problem;
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  size_t errors; /* in it before */
  ambulo__run run;
  ambulo__engine *engine;
  ambulo_result *result;
  ambulo__candidates candidates;
  const double *start; /* the caller's; NULL: zero */
  int from_zero, explains;
  int beside; /* the next attempt begins with the multipliers of the options */
  const char *method, *nlopt, *note;
} ambulo__session;

/* Checks memory and start, makes result and engine; no engine, and AMBULO_OK, when the run
 * was stopped meanwhile. */
ambulo_status ambulo__session_begin(ambulo__session *session, const ambulo_options *options,
                                    const double *start);
/* Audit, verdict, a second look where that may help, what happens between the nodes, explanation;
 * frees the engine. */
ambulo_status ambulo__session_finish(ambulo__session *session);
/* Frees what a failed call leaves, hands over the result of a good one. */
ambulo_status ambulo__session_end(ambulo__session *session, ambulo_status status,
                                  ambulo_result **result);

/* A solve from one start, or from zero (NULL). explains = 0: without second looks and explanation.
 * (attempts.c) */
ambulo_status ambulo__solve_once(const ambulo_problem *problem, const ambulo_options *options,
                                 const double *start, int explains,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo_result **result);

/* -------------------------------------------------------------- candidates */

/* With memory of the engine's allocator, which ambulo__session_end frees. E_MEMORY. */
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
