/* report/file_kind.c - model or problem? */
#include "ambulo/report.h"
#include "base/yaml_node.h"

ambulo_status ambulo_file_kind_of(const char *path, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_file_kind *kind) {
  if (!path || !kind) return AMBULO_E_ARGUMENT;
  ambulo__yaml *document = NULL;
  ambulo_status status = ambulo__yaml_load(path, allocator, diagnostics, &document);
  if (status) return status;
  const ambulo__yaml_node *root = ambulo__yaml_root(document);
  if (ambulo__yaml_get(root, "links")) {
    *kind = AMBULO_FILE_MODEL;
  } else if (ambulo__yaml_get(root, "model")) {
    *kind = AMBULO_FILE_PROBLEM;
  } else {
    status = ambulo__yaml_error(root, AMBULO_E_SCHEMA, NULL,
                                "neither 'links' nor 'model' at the top level; expected a model "
                                "(with links) or a problem (with a model)");
  }
  ambulo__yaml_free(document);
  return status;
}
