/* definitions/problem_muscles.c - `muscles` of a problem file: a file of them, or a mapping {file,
 * strength, and names of muscles}. */
#include "definitions/problem_reader.h"

void ambulo__read_problem_muscles(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  const ambulo__yaml_node *file = node, *section = NULL;
  if (ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) {
    section = node;
    file = ambulo__yaml_require(node, "file");
  }
  const char *name = file ? ambulo__yaml_file_name(file) : "";
  const char *path = name[0] ? ambulo__reader_path(reader, file, name) : NULL;
  if (!path || !reader->model) return;
  ambulo_status status =
      ambulo__muscles_load_input(&reader->inputs, path, section, reader->model, &reader->allocator,
                                 reader->diagnostics, &reader->muscles);
  reader->definition.muscles = reader->muscles;
  if (!status) return;
  reader->failure = status;
  (void)ambulo__yaml_error(file, status, NULL, "the muscles '%s' could not be loaded", path);
}
