/* solver/solve.c - ambulo_solve: from one start (solver.c), or from the best of several (starts.c).
 */
#include "base/machine.h"
#include "solver/result.h"
#include "solver/options.h"
#include "solver/session.h"
#include "solver/starts.h"

#include <math.h>

/* from several starts; what is left of the time limit is the last solve's */
static ambulo_status solve_from_starts(const ambulo_problem *problem, const ambulo_options *options,
                                       const ambulo_allocator *allocator,
                                       ambulo_diagnostics *diagnostics, ambulo_result **result) {
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo_options last = *options;
  ambulo__valleys *valleys = NULL;
  double *start = NULL, begin = ambulo__seconds_now();
  ambulo_status status = ambulo__starts(problem, options, allocator, &start, &valleys);
  if (last.time_limit > 0.0)
    last.time_limit = fmax(1e-3, last.time_limit - (ambulo__seconds_now() - begin));
  if (!status)
    status = ambulo__solve_once(problem, &last, start, 1, allocator, diagnostics, result);
  if (!status) {
    (*result)->valleys = valleys;
    (*result)->timing.total = ambulo__seconds_now() - begin;
    valleys = NULL;
  }
  ambulo__free(&a, start);
  ambulo__free(&a, valleys);
  return status;
}

ambulo_status ambulo_solve(const ambulo_problem *problem, const ambulo_options *options,
                           const double *start, const ambulo_allocator *allocator,
                           ambulo_diagnostics *diagnostics, ambulo_result **result) {
  if (!problem || !result) return AMBULO_E_ARGUMENT;
  ambulo_options own;
  ambulo_status status = ambulo__options_own(problem, options, diagnostics, &own);
  if (status) return status;
  if (!start && own.starts > 1)
    return solve_from_starts(problem, &own, allocator, diagnostics, result);
  return ambulo__solve_once(problem, &own, start, 1, allocator, diagnostics, result);
}

const ambulo_starts *ambulo_result_starts(const ambulo_result *result) {
  return result && result->valleys ? &result->valleys->shown : NULL;
}
