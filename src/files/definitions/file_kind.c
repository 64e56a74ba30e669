/* definitions/file_kind.c - model or problem? */
#include "ambulo/tools/report.h"
#include "ambulo/tools/load.h"
#include "formats/yaml_node.h"

ambulo_status ambulo_file_kind_of(const char *path, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_file_kind *kind) {
  if (!path || !kind) return AMBULO_E_ARGUMENT;
  ambulo__yaml *document = NULL;
  ambulo_status status = ambulo__yaml_load(path, allocator, diagnostics, &document);
  if (status) return status;
  static const char *const kinds[] = {"model", "problem"};
  int choice = ambulo__yaml_file_kind(ambulo__yaml_root(document), kinds, 2);
  status = ambulo__yaml_finish(document);
  if (!status) *kind = choice == 0 ? AMBULO_FILE_MODEL : AMBULO_FILE_PROBLEM;
  ambulo__yaml_free(document);
  return status;
}
