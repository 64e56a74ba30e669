/* definitions/problem_tracking.c - what terms of the objective follow besides coordinates: points
 * of the body, forces on feet and centres of pressure.
 *
 * Three columns of the reference belong to each of them. They begin with a text, by default the
 * name of the point, "grf.FOOT" or "cop.FOOT", and go on with x, y and z, or ".x", "_x". */
#include "definitions/problem_reader.h"
#include "problem/term.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_MARKS = 1000 };

/* what is followed: a point or a foot */
typedef struct followed {
  int index;                     /* in the model */
  const char *begins;            /* its columns */
  const ambulo__yaml_node *node; /* where that stands; NULL: by default */
} followed;

static int find_columns(const ambulo__motion *motion, const char *begins, int column[3]) {
  static const char *const joints[] = {".", "_", ""};
  char name[AMBULO__MOTION_MAX_NAME + 4];
  for (int way = 0; way < 3; way++) {
    int found = 0;
    for (int axis = 0; axis < 3; axis++) {
      (void)snprintf(name, sizeof name, "%.*s%s%c", AMBULO__MOTION_MAX_NAME, begins, joints[way],
                     "xyz"[axis]);
      column[axis] = ambulo__motion_column(motion, name);
      if (column[axis] < 0) {
        name[strlen(name) - 1] = "XYZ"[axis];
        column[axis] = ambulo__motion_column(motion, name);
      }
      found += column[axis] >= 0;
    }
    if (found == 3) return 1;
  }
  return 0;
}

/* names of the file without their last letter, of which the nearest is proposed */
static void refuse_columns(ambulo__problem_reader *reader, const ambulo__motion *motion,
                           const followed *one) {
  char hint[AMBULO__MOTION_MAX_NAME + 40];
  size_t columns = (size_t)motion->columns, length = strlen(one->begins) + 2;
  char *text = ambulo__reader_alloc(reader, columns, AMBULO__MOTION_MAX_NAME + 1);
  const char **names = ambulo__reader_alloc(reader, columns, sizeof *names);
  if (!text || !names) return;
  for (size_t c = 0; c < columns; c++) {
    char *name = text + c * (AMBULO__MOTION_MAX_NAME + 1);
    size_t size = strlen(motion->names[c]);
    if (size > 1 && strchr("xyzXYZ", motion->names[c][size - 1])) size--;
    if (size > 1 && size < length + 8 && strchr("._", motion->names[c][size - 1])) size--;
    memcpy(name, motion->names[c], size);
    names[c] = name;
  }
  const char *nearest = ambulo__nearest(one->begins, names, columns);
  (void)snprintf(hint, sizeof hint, "did you mean '%.*s'?", AMBULO__MOTION_MAX_NAME,
                 nearest ? nearest : "");
  (void)ambulo__yaml_error(one->node, AMBULO_E_PROBLEM, nearest ? hint : NULL,
                           "the reference has no columns '%s.x', '%s.y', '%s.z'", one->begins,
                           one->begins, one->begins);
}

/* [nodes][count][3] of what the columns have; NULL after an error */
static const double *sample(ambulo__problem_reader *reader, const ambulo__motion *motion,
                            const followed *list, int count) {
  const double *times = ambulo__reference_times(reader);
  size_t nodes = (size_t)reader->definition.intervals + 1, width = 3 * (size_t)count;
  double *reference = ambulo__reader_alloc(reader, nodes * width, sizeof *reference);
  if (!times || !reference) return NULL;
  int missing = 0;
  for (int i = 0; i < count; i++) {
    int column[3] = {-1, -1, -1};
    int found = find_columns(motion, list[i].begins, column);
    if (!found && list[i].node) {
      refuse_columns(reader, motion, &list[i]);
      missing = 1;
    }
    for (size_t k = 0; k < 3 * nodes; k++)
      reference[k / 3 * width + 3 * (size_t)i + k % 3] =
          found ? ambulo__reference_at(motion, column[k % 3], times[k / 3]) : (double)NAN;
  }
  return missing ? NULL : reference;
}

/* a number for all, or a mapping of names with `default` for those not named */
static double scale_of(const ambulo__yaml_node *node, const char *name) {
  if (!ambulo__yaml_is(node, AMBULO__YAML_MAPPING))
    return ambulo__yaml_number_in(node, 0.0, 1e12, 1.0);
  double rest = ambulo__yaml_number_in(ambulo__yaml_get(node, "default"), 0.0, 1e12, 1.0);
  return ambulo__yaml_number_in(ambulo__yaml_get(node, name), 0.0, 1e12, rest);
}

static void close_scale(const ambulo__yaml_node *node) {
  if (ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) ambulo__yaml_close(node);
}

/* no body has places that far away: they may be in millimetres */
static void doubt_lengths(const ambulo__problem_reader *reader, const double *reference,
                          size_t count, const ambulo__yaml_node *node) {
  double far = 100.0 + fabs(reader->definition.travel);
  for (size_t i = 0; reference && i < count; i++) {
    if (isnan(reference[i]) || fabs(reference[i]) <= far) continue;
    ambulo__yaml_warning(node, "lengths are in metres", "the reference has a place at %g m",
                         reference[i]);
    return;
  }
}

/* ----------------------------------------------------------------------- points */

/* every point with columns of its name; their number */
static int points_of_file(const ambulo_model *model, const ambulo__motion *motion, followed *list) {
  int count = 0, column[3];
  for (int i = 0; i < ambulo_model_point_count(model) && count < MOST_MARKS; i++) {
    const char *name = ambulo_model_point(model, i)->name;
    if (find_columns(motion, name, column)) list[count++] = (followed){i, name, NULL};
  }
  return count;
}

/* `points: {POINT: NAME}` or `points: [POINT]`; their number, 0 after an error */
static int named_points(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                        followed *list) {
  int pairs = ambulo__yaml_is(node, AMBULO__YAML_MAPPING), faults = 0;
  int count = pairs ? ambulo__yaml_pairs(node) : ambulo__yaml_items(node);
  if (count < 1 || count > MOST_MARKS) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "no points; expected 1 to %d, {heel_r: RHEE} or [heel_r]", MOST_MARKS);
    return 0;
  }
  for (int i = 0; i < count; i++) {
    const ambulo__yaml_node *item =
        pairs ? ambulo__yaml_value(node, i) : ambulo__yaml_item(node, i);
    const char *name = pairs ? ambulo__yaml_key(node, i) : ambulo__yaml_text(item);
    list[i] = (followed){pairs ? ambulo__find_name_of(reader, item, name, AMBULO__NAMED_POINT)
                               : ambulo__read_name_of(reader, item, AMBULO__NAMED_POINT),
                         pairs ? ambulo__yaml_text(item) : name, item};
    if (pairs) ambulo__yaml_expect(node, name);
    faults += list[i].index < 0 || !list[i].begins[0];
  }
  return faults ? 0 : count;
}

static int list_points(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                       const ambulo__yaml_node *file, const ambulo__motion *motion,
                       followed *list) {
  if (node) return named_points(reader, node, list);
  int count = points_of_file(reader->model, motion, list);
  if (count == 0)
    (void)ambulo__yaml_error(file, AMBULO_E_PROBLEM,
                             "say which column belongs to which point: points: {heel_r: RHEE}",
                             "the reference has no columns NAME.x, NAME.y, NAME.z of a point of "
                             "the model");
  return count;
}

void ambulo__read_marks(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                        ambulo_term *term) {
  const ambulo__yaml_node *file = ambulo__yaml_require(node, "reference");
  const ambulo__yaml_node *points = ambulo__yaml_get(node, "points");
  const ambulo__yaml_node *scales = ambulo__yaml_get(node, "scale");
  followed *list = ambulo__reader_alloc(reader, MOST_MARKS, sizeof *list);
  ambulo__motion *motion = file && list ? ambulo__open_reference(reader, file, 1) : NULL;
  if (!motion) return;
  int count = list_points(reader, points, file, motion, list);
  int *marks = ambulo__reader_alloc(reader, (size_t)count, sizeof *marks);
  double *scale = ambulo__reader_alloc(reader, (size_t)count, sizeof *scale);
  for (int i = 0; marks && scale && i < count; i++) {
    marks[i] = list[i].index;
    scale[i] = scale_of(scales, ambulo_model_point(reader->model, marks[i])->name);
  }
  if (count > 0) close_scale(scales);
  const double *reference = count > 0 ? sample(reader, motion, list, count) : NULL;
  ambulo__motion_free(motion);
  doubt_lengths(reader, reference, 3 * (size_t)count * ((size_t)reader->definition.intervals + 1),
                file);
  term->marks = marks;
  term->mark_count = reference ? count : 0;
  term->mark_scale = scale;
  term->mark_reference = reference;
}

/* ------------------------------------------------------------------------- feet */

void ambulo__read_foot_loads(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                             ambulo_term *term) {
  const ambulo__yaml_node *file = ambulo__yaml_require(node, "reference");
  const ambulo__yaml_node *names = ambulo__yaml_get(node, "feet");
  const ambulo__yaml_node *scales = ambulo__yaml_get(node, "scale");
  int count = ambulo_model_foot_count(reader->model), forces = term->kind == AMBULO_FORCE_TRACKING;
  followed *list = ambulo__reader_alloc(reader, (size_t)count, sizeof *list);
  double *scale = ambulo__reader_alloc(reader, (size_t)count, sizeof *scale);
  char(*usual)[AMBULO__MOTION_MAX_NAME + 1] =
      ambulo__reader_alloc(reader, (size_t)count, sizeof *usual);
  ambulo__motion *motion =
      file && list && scale && usual ? ambulo__open_reference(reader, file, 1) : NULL;
  if (!motion) return;
  int known = 0, column[3];
  for (int f = 0; f < count; f++) {
    const char *foot = ambulo_model_foot(reader->model, f)->name;
    const ambulo__yaml_node *own = ambulo__yaml_get(names, foot);
    (void)snprintf(usual[f], sizeof usual[f], "%s.%.*s", forces ? "grf" : "cop",
                   AMBULO__MOTION_MAX_NAME - 4, foot);
    list[f] = (followed){f, own ? ambulo__yaml_text(own) : usual[f], own};
    scale[f] = scale_of(scales, foot);
    known += own || find_columns(motion, usual[f], column);
  }
  if (names) ambulo__yaml_close(names);
  close_scale(scales);
  if (known == 0)
    (void)ambulo__yaml_error(file, AMBULO_E_PROBLEM,
                             "say which columns belong to which foot: feet: {right: "
                             "ground_force_r_v}",
                             "the reference has no columns '%s.x' of a foot of the model",
                             count > 0 ? usual[0] : "");
  term->foot_scale = scale;
  term->foot_reference = known > 0 ? sample(reader, motion, list, count) : NULL;
  ambulo__motion_free(motion);
}
