/* definitions/problem_reference.c - the reference motion of a tracking term, at the time nodes, or
 * of a tube, at equal time steps.
 *
 * The file's first time counts as t = 0 and it must last as long as the problem. Between
 * its rows the motion is interpolated linearly. Coordinates it does not have are not
 * tracked (scale 0).
 */
#include "contact/schedule.h"
#include "definitions/problem_reader.h"
#include "formats/marker_file.h"

#include <math.h>

/* column of each coordinate, or -1; NULL after a failure */
static int *find_columns(ambulo__problem_reader *reader, const ambulo__motion *motion,
                         const char *path, const ambulo__yaml_node *node) {
  int count = ambulo_model_coordinate_count(reader->model);
  int *column = ambulo__reader_alloc(reader, (size_t)count, sizeof *column);
  for (int i = 0; column && i < count; i++) {
    ambulo_status status =
        ambulo__motion_find(motion, path, ambulo_model_coordinate(reader->model, i)->name,
                            AMBULO__ORDER_VALUE, reader->diagnostics, &column[i]);
    if (!status) continue;
    reader->failure = status;
    (void)ambulo__yaml_error(node, status, NULL, "the reference '%s' could not be read", path);
    return NULL;
  }
  return column;
}

static void to_radians(ambulo__problem_reader *reader, ambulo__motion *motion, const int *column) {
  unsigned char *is_angle = ambulo__reader_alloc(reader, (size_t)motion->columns, 1);
  if (!is_angle) return;
  for (int i = 0; i < ambulo_model_coordinate_count(reader->model); i++) {
    if (column[i] >= 0 && ambulo_model_coordinate(reader->model, i)->type == AMBULO_REVOLUTE)
      is_angle[column[i]] = 1;
  }
  ambulo__motion_to_radians(motion, is_angle);
}

/* undeclared degrees would silently be followed as radians */
static void doubt_units(const ambulo__problem_reader *reader, const ambulo__motion *motion,
                        const int *column, const ambulo__yaml_node *node) {
  for (int i = 0; i < ambulo_model_coordinate_count(reader->model); i++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(reader->model, i);
    double bound = ambulo__largest_plausible(c);
    for (int k = 0; column[i] >= 0 && k < motion->rows; k++) {
      double value = motion->values[(size_t)k * (size_t)motion->columns + (size_t)column[i]];
      if (fabs(value) <= bound) continue;
      int angle = c->type == AMBULO_REVOLUTE;
      ambulo__yaml_warning(node,
                           angle ? "a file in degrees says so: '# inDegrees=yes' in a CSV, "
                                   "'inDegrees=yes' in the header of an STO or MOT"
                                 : "lengths are in metres",
                           "the reference has '%s' at %g %s, range %g to %g %s", c->name, value,
                           angle ? "rad" : "m", c->range[0], c->range[1], angle ? "rad" : "m");
      return;
    }
  }
}

/* milliseconds pass for seconds where the whole problem lies within the first row's step */
static void doubt_times(const ambulo__motion *motion, double duration,
                        const ambulo__yaml_node *node) {
  double step = motion->rows > 1 ? motion->time[1] - motion->time[0] : 0.0;
  if (step <= 1.5 * duration) return;
  ambulo__yaml_warning(node, "times are in seconds",
                       "the reference has a row every %g s; the problem lasts %g s", step,
                       duration);
}

double ambulo__reference_at(const ambulo__motion *motion, int column, double time) {
  int low = 0, high = motion->rows - 1;
  time += motion->time[0];
  if (high == 0) return motion->values[column];
  while (high - low > 1) {
    int middle = low + (high - low) / 2;
    if (motion->time[middle] <= time) {
      low = middle;
    } else {
      high = middle;
    }
  }
  double s = (time - motion->time[low]) / (motion->time[high] - motion->time[low]);
  s = s < 0.0 ? 0.0 : s > 1.0 ? 1.0 : s;
  const double *values = motion->values + column;
  double a = values[(size_t)low * (size_t)motion->columns];
  double b = values[(size_t)high * (size_t)motion->columns];
  return s == 0.0 ? a : s == 1.0 ? b : a + s * (b - a);
}

/* Where a reference is asked for, from its first time on. */
typedef struct sampling {
  int samples;
  const double *times; /* [samples], s; NULL: equally spaced over the duration */
} sampling;

static const double *resample(ambulo__problem_reader *reader, const ambulo__motion *motion,
                              const int *column, const ambulo__yaml_node *node,
                              const sampling *wanted, double *scale) {
  const ambulo_problem_definition *d = &reader->definition;
  int coordinates = ambulo_model_coordinate_count(reader->model), found = 0;
  int samples = wanted->samples;
  double *reference =
      ambulo__reader_alloc(reader, (size_t)samples * (size_t)coordinates, sizeof *reference);
  if (!reference) return NULL;
  for (int i = 0; i < coordinates; i++) {
    if (column[i] < 0) {
      scale[i] = 0.0;
      continue;
    }
    found++;
    for (int k = 0; k < samples; k++) {
      double time =
          wanted->times ? wanted->times[k] : (double)k * d->duration / (double)(samples - 1);
      reference[(size_t)k * (size_t)coordinates + (size_t)i] =
          ambulo__reference_at(motion, column[i], time);
    }
  }
  if (found > 0) return reference;
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                           "the reference has no column named after a coordinate of the model");
  return NULL;
}

static ambulo_status read_table(ambulo__problem_reader *reader, const char *path, int gaps,
                                ambulo__motion **motion) {
  if (gaps && ambulo__is_marker_file(path))
    return ambulo__markers_read_input(&reader->inputs, path, &reader->allocator,
                                      reader->diagnostics, motion);
  return ambulo__motion_read_input(&reader->inputs, path, gaps, &reader->allocator,
                                   reader->diagnostics, motion);
}

ambulo__motion *ambulo__open_reference(ambulo__problem_reader *reader,
                                       const ambulo__yaml_node *node, int gaps) {
  const char *name = ambulo__yaml_file_name(node);
  const char *path = name[0] ? ambulo__reader_path(reader, node, name) : NULL;
  if (!path) return NULL;
  ambulo__motion *motion = NULL;
  ambulo_status status = read_table(reader, path, gaps, &motion);
  if (status) {
    reader->failure = status;
    (void)ambulo__yaml_error(node, status, NULL, "the reference '%s' could not be read", path);
    return NULL;
  }
  double lasts = motion->rows > 0 ? motion->time[motion->rows - 1] - motion->time[0] : 0.0;
  double duration = reader->definition.duration;
  if (motion->rows < 1 || lasts < duration - 1e-6 * duration) {
    (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                             "the reference lasts %.6g s; expected at least the duration, %.6g s",
                             lasts, duration);
    ambulo__motion_free(motion);
    return NULL;
  }
  doubt_times(motion, duration, node);
  if (motion->declared_columns >= 0 && motion->declared_columns != motion->columns + 1)
    ambulo__yaml_warning(node, NULL, "the reference has %d columns; its header says %d (nColumns)",
                         motion->columns + 1, motion->declared_columns);
  return motion;
}

static const double *read_motion(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                 const sampling *wanted, double *scale) {
  ambulo__motion *motion = ambulo__open_reference(reader, node, 0);
  if (!motion) return NULL;
  const double *reference = NULL;
  const int *column = find_columns(reader, motion, ambulo__yaml_file_name(node), node);
  if (column) to_radians(reader, motion, column);
  if (column) doubt_units(reader, motion, column, node);
  if (column) reference = resample(reader, motion, column, node, wanted, scale);
  ambulo__motion_free(motion);
  return reference;
}

const double *ambulo__reference_times(ambulo__problem_reader *reader) {
  const ambulo_problem_definition *d = &reader->definition;
  int count = d->intervals + 1;
  double *times = ambulo__reader_alloc(reader, (size_t)count, sizeof *times);
  if (!times) return NULL;
  /* too few intervals for events are reported when the problem is built */
  int known = d->grid != AMBULO_GRID_UNIFORM &&
              ambulo__node_times(d, &reader->allocator, NULL, times) == AMBULO_OK;
  for (int k = 0; !known && k < count; k++)
    times[k] = (double)k * d->duration / (double)d->intervals;
  return times;
}

const double *ambulo__read_tracked_motion(ambulo__problem_reader *reader,
                                          const ambulo__yaml_node *node, double *scale) {
  sampling nodes = {reader->definition.intervals + 1, ambulo__reference_times(reader)};
  return nodes.times ? read_motion(reader, node, &nodes, scale) : NULL;
}

const double *ambulo__read_sampled_motion(ambulo__problem_reader *reader,
                                          const ambulo__yaml_node *node, int samples,
                                          double *scale) {
  sampling equal = {samples, NULL};
  return read_motion(reader, node, &equal, scale);
}

/* -------------------------------------------------------------------------- tubes */

/* References are sampled ten times an interval, so that finer grids of the same problem and the
 * audit between the nodes see the curve of the file and not the chords between nodes. */

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
