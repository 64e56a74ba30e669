/* definitions/solution_load.c - reading control points, and carrying them to another grid.
 *
 * Coordinates are matched by name, in any order. On the problem's own basis the numbers are
 * copied; from any other they are carried over by trajectory/basis.h (knot insertion where
 * that is exact, least squares otherwise). */
#include "ambulo/tools/load.h"
#include "ambulo/tools/report.h"
#include "definitions/motion_repeat.h"
#include "formats/yaml_node.h"
#include "problem/nlp.h"

#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------------ reading */

enum { MAX_INTERVALS = 100000 };

typedef struct reader {
  const ambulo_problem *problem;
  int stretch;      /* 1: another duration is stretched to the problem's */
  ambulo_ends ends; /* not free: the file holds one period, */
  int count;        /* of so many */
  ambulo_allocator allocator;
  ambulo__yaml *document;
  ambulo__basis *basis; /* of the file */
  int *column;          /* [d]: coordinate of the problem that stands in column i of the file */
  double *points;       /* [control points of the file][d], in the problem's order */
} reader;

static ambulo_status read_basis(reader *r, const ambulo__yaml_node *root) {
  static const char *const words[] = {"bspline", "central_difference", "hermite"};
  const ambulo__yaml_node *t = ambulo__yaml_require(root, "trajectory");
  double duration = ambulo__yaml_number_in(ambulo__yaml_require(root, "duration"), 1e-9, 1e9, 1.0);
  int kind = ambulo__yaml_choice(ambulo__yaml_require(t, "basis"), words, 3, 0);
  int degree = ambulo__yaml_integer(ambulo__yaml_get(t, "degree"), 3, AMBULO__MAX_DEGREE, 3);
  int intervals = ambulo__yaml_integer(ambulo__yaml_require(t, "intervals"), 1, MAX_INTERVALS, 1);
  const ambulo__yaml_node *breaks = ambulo__yaml_get(t, "breakpoints");
  ambulo__yaml_close(t);
  ambulo_status status = ambulo__yaml_finish(r->document);
  if (status) return status;
  double expected = ambulo_problem_duration(r->problem);
  if (!r->stretch && fabs(duration - expected) > 1e-9 * expected)
    return ambulo__yaml_error(ambulo__yaml_get(root, "duration"), AMBULO_E_PROBLEM, NULL,
                              "the solution lasts %g s; the problem lasts %g s", duration,
                              expected);
  if (r->ends != AMBULO_ENDS_FREE) {
    r->count = (int)fmin(MAX_INTERVALS, fmax(1.0, round(expected / duration)));
    expected /= r->count;
  }
  double *values = NULL;
  if (breaks) {
    values = ambulo__alloc(&r->allocator, (size_t)intervals + 1, sizeof *values);
    if (!values) return AMBULO_E_MEMORY;
    ambulo__yaml_numbers(breaks, intervals + 1, values);
    for (int i = 0; r->stretch && i <= intervals; i++) values[i] *= expected / duration;
    status = ambulo__yaml_finish(r->document);
  }
  if (!status) {
    status = ambulo__basis_create((ambulo__basis_kind)kind, degree, intervals, expected, values,
                                  &r->allocator, &r->basis);
    if (status == AMBULO_E_ARGUMENT)
      status = ambulo__yaml_error(breaks ? breaks : t, AMBULO_E_SCHEMA, NULL,
                                  "breakpoints must rise from 0 to the duration");
  }
  ambulo__free(&r->allocator, values);
  return status;
}

static ambulo_status read_coordinates(reader *r, const ambulo__yaml_node *root) {
  const ambulo_model *model = r->problem->model;
  const ambulo__yaml_node *names = ambulo__yaml_require(root, "coordinates");
  ambulo_status status = ambulo__yaml_finish(r->document);
  if (status) return status;
  int count = ambulo__yaml_items(names);
  status = ambulo__yaml_finish(r->document);
  if (status) return status;
  if (count != model->coordinate_count)
    return ambulo__yaml_error(names, AMBULO_E_PROBLEM, NULL,
                              "got %d coordinates; expected the %d of model '%s'", count,
                              model->coordinate_count, model->name);
  for (int i = 0; i < count; i++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(names, i);
    const char *name = ambulo__yaml_name(item);
    int coordinate = name[0] ? ambulo_model_find_coordinate(model, name) : -1;
    for (int k = 0; k < i && coordinate >= 0; k++) {
      if (r->column[k] == coordinate)
        return ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL, "coordinate '%s' appears twice",
                                  name);
    }
    if (name[0] && coordinate < 0)
      return ambulo__yaml_error(item, AMBULO_E_PROBLEM, NULL, "model '%s' has no coordinate '%s'",
                                model->name, name);
    r->column[i] = coordinate;
  }
  return ambulo__yaml_finish(r->document);
}

static ambulo_status read_points(reader *r, const ambulo__yaml_node *root) {
  int d = r->problem->coordinates, expected = ambulo__basis_control_points(r->basis);
  const ambulo__yaml_node *rows = ambulo__yaml_require(root, "control_points");
  ambulo_status status = ambulo__yaml_finish(r->document);
  if (status) return status;
  int count = ambulo__yaml_items(rows);
  status = ambulo__yaml_finish(r->document);
  if (status) return status;
  if (count != expected)
    return ambulo__yaml_error(rows, AMBULO_E_SCHEMA, NULL,
                              "got %d control points; expected %d for this trajectory", count,
                              expected);
  r->points = ambulo__alloc(&r->allocator, (size_t)count * (size_t)d, sizeof *r->points);
  double *row = ambulo__alloc(&r->allocator, (size_t)d, sizeof *row);
  if (!r->points || !row) status = AMBULO_E_MEMORY;
  for (int c = 0; c < count && !status; c++) {
    if (!ambulo__yaml_numbers(ambulo__yaml_item(rows, c), d, row)) continue;
    for (int i = 0; i < d; i++) r->points[(size_t)c * (size_t)d + (size_t)r->column[i]] = row[i];
  }
  ambulo__free(&r->allocator, row);
  return status ? status : ambulo__yaml_finish(r->document);
}

static int same_basis(const ambulo__basis *a, const ambulo__basis *b) {
  if (ambulo__basis_get_kind(a) != ambulo__basis_get_kind(b) ||
      ambulo__basis_intervals(a) != ambulo__basis_intervals(b))
    return 0;
  if (ambulo__basis_get_kind(a) != AMBULO__BSPLINE) return 1;
  if (ambulo__basis_degree(a) != ambulo__basis_degree(b)) return 0;
  const double *u = ambulo__basis_breakpoints(a), *v = ambulo__basis_breakpoints(b);
  for (int i = 0; i <= ambulo__basis_intervals(a); i++) {
    if (fabs(u[i] - v[i]) > 1e-12 * ambulo__basis_duration(a)) return 0;
  }
  return 1;
}

static ambulo_status read_document(reader *r, double *x) {
  static const char *const kinds[] = {"solution"};
  const ambulo__yaml_node *root = ambulo__yaml_root(r->document);
  if (ambulo__yaml_file_kind(root, kinds, 1) < 0) return ambulo__yaml_finish(r->document);
  (void)ambulo__yaml_integer(ambulo__yaml_require(root, "ambulo"), 1, 1, 1);
  ambulo__yaml_expect(root, "duration");
  ambulo__yaml_expect(root, "trajectory");
  ambulo__yaml_expect(root, "coordinates");
  ambulo__yaml_expect(root, "control_points");
  ambulo__yaml_expect(root, "multipliers"); /* solution_multipliers.c */
  ambulo__yaml_close(root);
  r->column = ambulo__alloc(&r->allocator, (size_t)r->problem->coordinates, sizeof *r->column);
  if (!r->column) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__yaml_finish(r->document);
  if (!status) status = read_basis(r, root);
  if (!status) status = read_coordinates(r, root);
  if (!status) status = read_points(r, root);
  if (status) return status;
  if (r->count > 1)
    return ambulo__motion_repeat(r->basis, r->points, r->count, r->ends, r->problem, x);
  if (same_basis(r->basis, r->problem->basis)) {
    memcpy(x, r->points, (size_t)r->problem->variables * sizeof *x);
    return AMBULO_OK;
  }
  return ambulo__basis_transfer(r->basis, r->points, r->problem->basis, x, r->problem->coordinates,
                                &r->allocator);
}

static ambulo_status load(const char *path, const ambulo_problem *problem, int stretch,
                          ambulo_ends ends, const ambulo_allocator *allocator,
                          ambulo_diagnostics *diagnostics, double *x) {
  if (!path || !problem || !x) return AMBULO_E_ARGUMENT;
  reader r = {.problem = problem,
              .stretch = stretch,
              .ends = ends,
              .count = 1,
              .allocator = ambulo__allocator_or_default(allocator)};
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__yaml_load(path, &r.allocator, diagnostics, &r.document);
  if (status) return status;
  status = read_document(&r, x);
  ambulo__free(&r.allocator, r.points);
  ambulo__free(&r.allocator, r.column);
  ambulo__basis_free(r.basis);
  ambulo__yaml_free(r.document);
  return ambulo__conclude(diagnostics, errors, status, path);
}

ambulo_status ambulo_solution_load(const char *path, const ambulo_problem *problem,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, double *x) {
  return load(path, problem, 0, AMBULO_ENDS_FREE, allocator, diagnostics, x);
}

ambulo_status ambulo_solution_start(const char *path, const ambulo_problem *problem,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, double *x) {
  return load(path, problem, 1, AMBULO_ENDS_FREE, allocator, diagnostics, x);
}

ambulo_status ambulo_solution_repeat(const char *path, const ambulo_problem *problem,
                                     ambulo_ends ends, const ambulo_allocator *allocator,
                                     ambulo_diagnostics *diagnostics, double *x) {
  if (ends != AMBULO_ENDS_PERIODIC && ends != AMBULO_ENDS_MIRRORED) return AMBULO_E_ARGUMENT;
  return load(path, problem, 1, ends, allocator, diagnostics, x);
}
