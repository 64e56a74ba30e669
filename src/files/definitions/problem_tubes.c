/* definitions/problem_tubes.c - `constraints.tubes`: reference motions that are not to be left.
 *
 * References are sampled ten times an interval, so that finer grids of the same problem and the
 * audit between the nodes see the curve of the file and not the chords between nodes. */
#include "definitions/problem_reader.h"

#include <math.h>

enum { PER_INTERVAL = 10, MOST_TUBES = 1000 };

/* half_width[d] of the coordinates that are listed, in the order of the model */
static void read_widths(ambulo__problem_reader *reader, const ambulo__yaml_node *mapping,
                        const double *has_column, double *half_width) {
  for (int i = 0; i < ambulo_model_coordinate_count(reader->model); i++) {
    const char *name = ambulo_model_coordinate(reader->model, i)->name;
    const ambulo__yaml_node *node = ambulo__yaml_get(mapping, name);
    half_width[i] = INFINITY;
    if (!node) continue;
    half_width[i] = ambulo__read_coordinate_value(reader, node, i);
    if (half_width[i] < 0.0)
      (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                               "a half width of %g; expected at least 0",
                               ambulo__yaml_number(node, 0.0));
    if (has_column && has_column[i] == 0.0)
      (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL, "the reference has no column for '%s'",
                               name);
  }
  ambulo__yaml_close(mapping);
}

static void read_tube(ambulo__problem_reader *reader, const ambulo__yaml_node *item, void *out) {
  ambulo_tube *tube = out;
  size_t coordinates = (size_t)ambulo_model_coordinate_count(reader->model);
  double *half_width = ambulo__reader_alloc(reader, coordinates, sizeof *half_width);
  double *has_column = ambulo__reader_alloc(reader, coordinates, sizeof *has_column);
  if (!half_width || !has_column) return;
  for (size_t i = 0; i < coordinates; i++) has_column[i] = 1.0;
  const ambulo__yaml_node *file = ambulo__yaml_require(item, "reference");
  const ambulo__yaml_node *widths = ambulo__yaml_require(item, "coordinates");
  tube->samples = PER_INTERVAL * reader->definition.intervals + 1;
  if (file) tube->reference = ambulo__read_sampled_motion(reader, file, tube->samples, has_column);
  if (widths && !ambulo__yaml_is(widths, AMBULO__YAML_MAPPING)) {
    (void)ambulo__yaml_error(widths, AMBULO_E_SCHEMA, NULL,
                             "expected a mapping of coordinates to half widths");
    widths = NULL;
  }
  if (widths) read_widths(reader, widths, tube->reference ? has_column : NULL, half_width);
  tube->half_width = half_width;
  ambulo__yaml_close(item);
}

void ambulo__read_tubes(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  const ambulo__yaml_node *section = ambulo__yaml_get(root, "constraints");
  if (!ambulo__yaml_is(section, AMBULO__YAML_MAPPING)) return;
  reader->definition.tubes =
      ambulo__read_items(reader, ambulo__yaml_get(section, "tubes"), &ambulo__tube_members, 0,
                         MOST_TUBES, read_tube, &reader->definition.tube_count);
}
