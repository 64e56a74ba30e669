/* solver/options.c - the options of a problem, and the check of what a caller hands in. */
#include "solver/options.h"
#include "base/sized.h"
#include "problem/definition.h"
#include "problem/nlp.h"

void ambulo_problem_options_fill(const ambulo_problem *problem, ambulo_options *filled,
                                 size_t size) {
  ambulo_options usual =
      problem->file_options.size != 0 ? problem->file_options : ambulo_options_default();
  usual.size = size;
  ambulo__sized_fill(filled, size, &usual, sizeof usual);
}

ambulo_status ambulo__options_check(const ambulo_options *options,
                                    ambulo_diagnostics *diagnostics) {
  if (options->size == sizeof *options) return ambulo__option_ranges_check(options, diagnostics);
  return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                       "solver options did not come from ambulo_options_default()");
}

ambulo_status ambulo__options_own(const ambulo_problem *problem, const ambulo_options *given,
                                  ambulo_diagnostics *diagnostics, ambulo_options *own) {
  *own = given ? ambulo_options_default() : ambulo_problem_options(problem);
  if (!ambulo__sized_take(own, sizeof *own, given)) own->size = 0;
  return ambulo__options_check(own, diagnostics);
}
