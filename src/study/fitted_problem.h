/* study/fitted_problem.h - the problem file with the fitted numbers in place of its own.
 *
 * The text stays as it is, comments and all, but for the numbers of the parameters' keys and the
 * names of other files (`model`, and each `reference`), which are written as seen from the folder
 * that the text goes to; absolute names stay. */
#ifndef AMBULO_STUDY_FITTED_PROBLEM_H
#define AMBULO_STUDY_FITTED_PROBLEM_H

#include "base/text_buffer.h"
#include "study/fit.h"

/* Appends the text for u [parameters], to be written into `directory`, which exists. Keys that only
 * conditions set are not in it. Errors: as of ambulo__yaml_load; E_IO; E_PROBLEM (the file is no
 * longer what it was); E_MEMORY. */
ambulo_status ambulo__fitted_problem(const ambulo_fit *fit, const double *u, const char *directory,
                                     ambulo_diagnostics *diagnostics, ambulo__text_buffer *text);

#endif
