/* cli/check_model.h - gradient check of a model's mechanics. */
#ifndef AMBULO_CLI_CHECK_MODEL_H
#define AMBULO_CLI_CHECK_MODEL_H

#include "ambulo/ambulo.h"

/* Loads the model, prints one line a Jacobian, adds to *wrong those that are off by more than
 * `tolerance`. */
ambulo_status ambulo__cli_check_model(const char *file, ambulo_diagnostics *diagnostics,
                                      double tolerance, int *wrong);

#endif
