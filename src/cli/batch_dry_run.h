/* cli/batch_dry_run.h - what a batch would do. */
#ifndef AMBULO_CLI_BATCH_DRY_RUN_H
#define AMBULO_CLI_BATCH_DRY_RUN_H

#include "ambulo/tools/tools.h"

/* Prints the case list and an estimate of time and disk: from the finished cases in `directory`
 * (may be NULL), else from solving the first case once. Returns the exit code. */
int ambulo__cli_dry_run(const ambulo_sweep *sweep, const char *directory, int workers);

/* A batch has filled the folder (may be NULL). */
int ambulo__cli_is_batch(const char *directory);

#endif
