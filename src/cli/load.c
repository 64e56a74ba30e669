/* cli/load.c - see load.h. */
#include "cli/load.h"
#include "ambulo/tools/load.h"

#include <stdlib.h>

ambulo_status ambulo__cli_load(const ambulo__cli_input *input, const char *file,
                               const ambulo__cli_changes *changes, ambulo_diagnostics *diagnostics,
                               ambulo_model **model, ambulo_problem **problem) {
  size_t more = changes ? (size_t)changes->count : 0;
  const char **overrides = calloc((size_t)input->given_count + more + 1, sizeof *overrides);
  if (!overrides) return AMBULO_E_MEMORY;
  ambulo_file_kind kind = AMBULO_FILE_UNKNOWN;
  int count = ambulo__cli_values(input, "set", overrides);
  ambulo_status status = ambulo_file_kind_of(file, NULL, diagnostics, &kind);
  if (!status && kind == AMBULO_FILE_MODEL) {
    status = ambulo_model_load_with(file, overrides, count, changes ? &changes->subject : NULL,
                                    NULL, diagnostics, model);
  } else if (!status) {
    for (size_t i = 0; i < more; i++) overrides[count++] = changes->overrides[i];
    status = ambulo_problem_load(file, overrides, count, NULL, diagnostics, problem);
  }
  free(overrides);
  return status;
}
