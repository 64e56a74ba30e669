/* cli/forces.c - see forces.h. */
#include "cli/forces.h"
#include "ambulo/tools/load.h"

#include <string.h>
#include <strings.h>

static int is_xml(const char *file) {
  const char *dot = strrchr(file, '.');
  return dot && strcasecmp(dot, ".xml") == 0;
}

ambulo_status ambulo__cli_forces_read(const ambulo__cli_input *input, const ambulo_model *model,
                                      ambulo_diagnostics *diagnostics, ambulo__cli_forces *forces,
                                      ambulo_inverse_options *options) {
  const char *file = ambulo__cli_value(input, "grf");
  options->without_forces = file && strcmp(file, "none") == 0;
  options->forces = options->without_forces ? NULL : file;
  options->force_columns = ambulo__cli_value(input, "force-columns");
  if (!options->forces || !is_xml(file)) return AMBULO_OK;
  ambulo_status status = ambulo_import_external_loads(file, model, NULL, diagnostics,
                                                      &forces->table, &forces->columns);
  if (status) return status;
  options->forces = forces->table;
  if (!options->force_columns) options->force_columns = forces->columns;
  return AMBULO_OK;
}

void ambulo__cli_forces_free(ambulo__cli_forces *forces) {
  ambulo_text_free(forces->table, NULL);
  ambulo_text_free(forces->columns, NULL);
}
