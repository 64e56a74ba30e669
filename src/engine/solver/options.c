/* solver/options.c - the options of a problem, and the check of what a caller hands in. */
#include "solver/options.h"
#include "base/sized.h"
#include "problem/nlp.h"

#include <math.h>

static const double least_tolerance = 1e-14, most_tolerance = 1.0; /* as in problem files */

void ambulo_problem_options_fill(const ambulo_problem *problem, ambulo_options *filled,
                                 size_t size) {
  ambulo_options usual =
      problem->file_options.size != 0 ? problem->file_options : ambulo_options_default();
  usual.size = size;
  ambulo__sized_fill(filled, size, &usual, sizeof usual);
}

static ambulo_status refuse_size(ambulo_diagnostics *diagnostics) {
  return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                       "solver options did not come from ambulo_options_default()");
}

ambulo_status ambulo__options_own(const ambulo_problem *problem, const ambulo_options *given,
                                  ambulo_diagnostics *diagnostics, ambulo_options *own) {
  *own = given ? ambulo_options_default() : ambulo_problem_options(problem);
  if (!ambulo__sized_take(own, sizeof *own, given)) return refuse_size(diagnostics);
  return ambulo__options_check(own, diagnostics);
}

/* below: less than doubles can tell; above: anything would pass */
static ambulo_status check_tolerance(const char *name, double value,
                                     ambulo_diagnostics *diagnostics) {
  if (value >= least_tolerance && value <= most_tolerance) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                       "solver.%s is %g; expected %g to %g", name, value, least_tolerance,
                       most_tolerance);
}

ambulo_status ambulo__options_check(const ambulo_options *options,
                                    ambulo_diagnostics *diagnostics) {
  if (options->size != sizeof *options) return refuse_size(diagnostics);
  if (options->algorithm < AMBULO_AUTO || options->algorithm > AMBULO_AUGLAG)
    return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "unknown solver algorithm %d", (int)options->algorithm);
  if (options->maximum_evaluations < 1)
    return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "solver.maximum_evaluations is %d; expected at least 1",
                         options->maximum_evaluations);
  if (options->maximum_iterations < 1)
    return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "solver.maximum_iterations is %d; expected at least 1",
                         options->maximum_iterations);
  if (!isnan(options->time_limit) && !(options->time_limit > 0.0))
    return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "solver.time_limit is %g s; expected more than 0, or AMBULO_OFF",
                         options->time_limit);
  if (!isnan(options->maximum_memory) && !(options->maximum_memory > 0.0))
    return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "solver.maximum_memory is %g bytes; expected more than 0, or AMBULO_OFF",
                         options->maximum_memory);
  ambulo_status status =
      check_tolerance("feasibility_tolerance", options->feasibility_tolerance, diagnostics);
  if (!status)
    status = check_tolerance("optimality_tolerance", options->optimality_tolerance, diagnostics);
  if (status) return status;
  if (options->starts < 1 || options->starts > AMBULO_MOST_STARTS)
    return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "solver.starts is %d; expected 1 to %d", options->starts,
                         AMBULO_MOST_STARTS);
  if (options->dense_samples < 1 || options->dense_samples > 1000)
    return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "solver.dense_samples is %d; expected 1 to 1000", options->dense_samples);
  return AMBULO_OK;
}
