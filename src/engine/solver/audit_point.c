/* solver/audit_point.c - ambulo_audit_point: what a given point is worth. */
#include "solver/options.h"
#include "solver/session.h"

#include <stdio.h>

ambulo_status ambulo_audit_point(const ambulo_problem *problem, const ambulo_options *options,
                                 const double *x, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo_result **result) {
  if (!problem || !x || !result) return AMBULO_E_ARGUMENT;
  ambulo_options own;
  ambulo_status status = ambulo__options_own(problem, options, diagnostics, &own);
  if (status) return status;
  ambulo__session s = {.problem = problem, .allocator = allocator, .diagnostics = diagnostics};
  s.errors = ambulo_diagnostics_error_count(diagnostics);
  status = ambulo__session_begin(&s, &own, x);
  if (!status) status = ambulo__session_finish(&s);
  if (!status) (void)snprintf(s.result->ending, sizeof s.result->ending, "audit of a given point");
  return ambulo__session_end(&s, status, result);
}
