/* cli/check_model.h - gradient check of a model's mechanics. */
#ifndef AMBULO_CLI_CHECK_MODEL_H
#define AMBULO_CLI_CHECK_MODEL_H

#include "ambulo/ambulo.h"

/* Prints one line a Jacobian, adds to *wrong those that are off by more than `tolerance`. `file`:
 * what the model was read from. */
ambulo_status ambulo__cli_check_model(const char *file, const ambulo_model *model, double tolerance,
                                      int *wrong);

/* Says how far the feet are from the ground, at `ground` m along up, in the start pose, where a
 * solve begins (q = 0 but for defaults of the model); nothing where they stand on it, and of a body
 * without feet. */
ambulo_status ambulo__cli_check_standing(const ambulo_model *model, double ground);

#endif
