/* show/abandoned.c - a solve whose caller does not wait: what the point that it showed last is.
 *
 * No engine is made: the values of the rows are all that a moment has time for. */
#include "ambulo/tools/report.h"
#include "solver/session.h"

#include <math.h>
#include <string.h>

ambulo_status ambulo_audit_progress(const ambulo_problem *problem, const ambulo_options *options,
                                    const ambulo_progress *last, ambulo_ending ending,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo_result **result) {
  int stopped = ending == AMBULO_ENDING_TIME || ending == AMBULO_ENDING_CALLER;
  if (!problem || !last || !stopped || !result) return AMBULO_E_ARGUMENT;
  ambulo_options own;
  ambulo_status status = ambulo__options_own(problem, options, diagnostics, &own);
  if (status) return status;
  ambulo__session s = {.problem = problem, .allocator = allocator, .diagnostics = diagnostics};
  s.errors = ambulo_diagnostics_error_count(diagnostics);
  s.method = "the solver did not answer";
  s.note = "";
  ambulo__run_begin(&s.run, &own);
  s.run.started -= last->seconds;
  s.run.evaluations = last->evaluations;
  s.run.iterations = last->iteration;
  s.run.ending = ending;
  s.run.stopped = 1;
  status = ambulo__result_create(problem, allocator, &s.result);
  if (!status) {
    ambulo__start_pose(problem, s.result->x);
    if (last->point)
      memcpy(s.result->x, last->point, (size_t)problem->variables * sizeof *last->point);
    s.result->iterations = last->iteration;
    status = ambulo__session_finish(&s);
  }
  return ambulo__session_end(&s, status, result);
}
