/* cli/load.h - a file of the command line that may be a model or a problem, as --set changes it. */
#ifndef AMBULO_CLI_LOAD_H
#define AMBULO_CLI_LOAD_H

#include "ambulo/tools/tools.h"
#include "cli/args.h"

/* The option that ambulo__cli_load reads, for a command's table. */
#define AMBULO__CLI_SET_OPTION                                                                     \
  { "set", 0, "path=value", "replace a value of the model or problem file; may be repeated" }

/* What a command changes of a file besides. */
typedef struct ambulo__cli_changes {
  ambulo_subject subject;       /* of a model file */
  const char *const *overrides; /* [count] of a problem file */
  int count;
} ambulo__cli_changes;

/* Sets *model or *problem, by what the file is; the other stays as it was. `changes` may be NULL.
 */
ambulo_status ambulo__cli_load(const ambulo__cli_input *input, const char *file,
                               const ambulo__cli_changes *changes, ambulo_diagnostics *diagnostics,
                               ambulo_model **model, ambulo_problem **problem);

#endif
