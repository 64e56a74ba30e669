/* solver/options.h - check of the options of a solve. */
#ifndef AMBULO_SOLVER_OPTIONS_H
#define AMBULO_SOLVER_OPTIONS_H

#include "ambulo/solve.h"
#include "base/diagnostics.h"

/* *own: what the caller gave, of whatever age, checked; NULL: those of the problem. */
ambulo_status ambulo__options_own(const ambulo_problem *problem, const ambulo_options *given,
                                  ambulo_diagnostics *diagnostics, ambulo_options *own);

/* E_ARGUMENT with the option's name and its range. */
ambulo_status ambulo__options_check(const ambulo_options *options, ambulo_diagnostics *diagnostics);

#endif
