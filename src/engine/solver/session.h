/* solver/session.h - one call of ambulo_solve or ambulo_audit_point, from its arguments to its
 * result.
 */
#ifndef AMBULO_SOLVER_SESSION_H
#define AMBULO_SOLVER_SESSION_H

#include "solver/candidates.h"
#include "solver/result.h"

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
  const char *method, *nlopt, *note;
} ambulo__session;

/* Checks options, memory and start, makes result and engine; no engine, and AMBULO_OK, when the run
 * was stopped meanwhile. */
ambulo_status ambulo__session_begin(ambulo__session *session, const ambulo_options *options,
                                    const double *start);
/* Audit, verdict, a second look where that may help, what happens between the nodes, explanation;
 * frees the engine. */
ambulo_status ambulo__session_finish(ambulo__session *session);
/* Frees what a failed call leaves, hands over the result of a good one. */
ambulo_status ambulo__session_end(ambulo__session *session, ambulo_status status,
                                  ambulo_result **result);

/* ambulo_solve from one start; explains = 0: without second looks and explanation. */
ambulo_status ambulo__solve_once(const ambulo_problem *problem, const ambulo_options *options,
                                 const double *start, int explains,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo_result **result);

#endif
