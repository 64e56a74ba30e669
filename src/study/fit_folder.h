/* study/fit_folder.h - the folder of a fit.
 *
 * DIR/fit_inputs.json: hashes of what it was filled from. DIR/solves: the batch folder of its
 * solves. DIR/fit.json, DIR/fitted.yaml: results. DIR/lock: held while a fit runs in it. */
#ifndef AMBULO_STUDY_FIT_FOLDER_H
#define AMBULO_STUDY_FIT_FOLDER_H

#include "study/batch_lock.h"
#include "study/fit_evaluate.h"

/* Makes DIR the folder of this fit and locks it. One that holds other things is refused, and one of
 * a fit with other inputs unless force = 1. Errors: E_IO, E_PROBLEM, E_MEMORY. */
ambulo_status ambulo__fit_folder_prepare(const ambulo__fit_runner *runner, const char *directory,
                                         ambulo__lock *lock);

#endif
