/* definitions/problem_written_for.c - `written_for` of a problem file: the body its numbers are
 * for.
 *
 * What becomes of them for the subject is problem/definition_resize.h's.
 */
#include "definitions/problem_reader.h"
#include "problem/definition.h"

void ambulo__read_written_for(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  ambulo__problem_keys *keys = &reader->keys;
  keys->longer = keys->heavier = 1.0;
  const ambulo__yaml_node *section = ambulo__reader_section(root, "written_for");
  if (!section) return;
  double mass = ambulo__yaml_number_in(ambulo__yaml_require(section, "mass"), 1.0, 1000.0, 0.0);
  double stature = ambulo__yaml_number_in(ambulo__yaml_require(section, "stature"), 0.3, 3.0, 0.0);
  ambulo__yaml_close(section);
  if (!reader->model || !(mass > 0.0) || !(stature > 0.0)) return;
  double subject_mass = reader->model->units.mass;
  double subject_stature = ambulo_model_stature(reader->model);
  if (!(subject_stature > 0.0) || subject_mass == 1.0 || !(subject_mass > 0.0)) {
    (void)ambulo__yaml_error(section, AMBULO_E_PROBLEM, NULL,
                             "'written_for' with a model that has its own size; expected one whose "
                             "units are those of a subject");
    return;
  }
  keys->written_for = 1;
  keys->longer = subject_stature / stature;
  keys->heavier = subject_mass / mass;
}

void ambulo__scale_to_subject(ambulo__problem_reader *reader) {
  const ambulo__problem_keys *keys = &reader->keys;
  ambulo_problem_definition *d = &reader->definition;
  if (keys->written_for) ambulo__definition_resize(d, d->term_count, keys->longer, keys->heavier);
}
