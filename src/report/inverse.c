/* report/inverse.c - inverse dynamics of a motion file.
 *
 * The samples of each coordinate are interpolated by a spline of degree 5 (3 when there are
 * only 4 or 5 samples); q, qd, qdd at the sample times give torques and root wrench by inverse
 * dynamics, and the zero-moment point on the plane n . r = 0 is
 *
 *     p = n x M / (n . F)                                                         (16')
 */
#include "ambulo/report.h"

#include <math.h>
#include <string.h>

#include "base/atomic_file.h"
#include "model/model.h"
#include "report/ground_load.h"
#include "report/motion_csv.h"
#include "trajectory/motion_fit.h"

typedef struct inverse {
  ambulo_allocator allocator;
  const ambulo_model *model;
  ambulo_diagnostics *diagnostics;
  const char *file;
  ambulo__motion *given;  /* as in the file */
  ambulo__motion *motion; /* one column a coordinate, radians and metres */
  ambulo__motion_fit *fit;
  double *q, *qd, *qdd, *tau, *wrench, *zmp; /* [rows][...] */
} inverse;

static void clear(inverse *v) {
  ambulo__motion_free(v->given);
  ambulo__motion_free(v->motion);
  ambulo__motion_fit_free(v->fit);
  ambulo__free(&v->allocator, v->q);
  ambulo__free(&v->allocator, v->qd);
  ambulo__free(&v->allocator, v->qdd);
  ambulo__free(&v->allocator, v->tau);
  ambulo__free(&v->allocator, v->wrench);
  ambulo__free(&v->allocator, v->zmp);
}

static void copy_column(inverse *v, int i, int column) {
  for (int k = 0; k < v->given->rows; k++) {
    double value = v->given->values[(size_t)k * (size_t)v->given->columns + (size_t)column];
    v->motion->values[(size_t)k * (size_t)v->motion->columns + (size_t)i] = value;
  }
}

/* the file's columns in the model's order; missing coordinates stay at zero */
static ambulo_status select_columns(inverse *v, const char **names, unsigned char *is_angle) {
  const ambulo_model *model = v->model;
  int d = model->coordinate_count, found = 0;
  ambulo__place place = {.file = v->file};
  for (int i = 0; i < d; i++) names[i] = model->coordinates[i].name;
  ambulo_status status = ambulo__motion_create(v->given->rows, d, names, &v->allocator, &v->motion);
  if (status) return status;
  memcpy(v->motion->time, v->given->time, (size_t)v->given->rows * sizeof *v->motion->time);
  v->motion->in_degrees = v->given->in_degrees;
  for (int i = 0; i < d; i++) {
    int column = ambulo__motion_column(v->given, names[i]);
    is_angle[i] = model->coordinates[i].type == AMBULO_REVOLUTE;
    if (column >= 0) {
      copy_column(v, i, column);
      found++;
    }
  }
  if (found == 0)
    return ambulo__error(v->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "no column is named after a coordinate of model '%s'; expected for "
                         "example '%s'",
                         model->name, d ? names[0] : "");
  for (int i = 0; i < d; i++) {
    if (ambulo__motion_column(v->given, names[i]) < 0)
      ambulo__warning(v->diagnostics, place, NULL,
                      "no column for coordinate '%s'; it is taken as 0", names[i]);
  }
  ambulo__motion_to_radians(v->motion, is_angle);
  return AMBULO_OK;
}

static ambulo_status read_motion(inverse *v) {
  ambulo_status status = ambulo__motion_read(v->file, &v->allocator, v->diagnostics, &v->given);
  if (status) return status;
  if (v->given->rows < 4) {
    ambulo__place place = {.file = v->file};
    return ambulo__error(v->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "%d times; expected at least 4 for rates and accelerations",
                         v->given->rows);
  }
  size_t d = (size_t)v->model->coordinate_count;
  const char **names = ambulo__alloc(&v->allocator, d, sizeof *names);
  unsigned char *is_angle = ambulo__alloc(&v->allocator, d, 1);
  status = names && is_angle ? select_columns(v, names, is_angle) : AMBULO_E_MEMORY;
  ambulo__free(&v->allocator, names);
  ambulo__free(&v->allocator, is_angle);
  return status;
}

static ambulo_status allocate(inverse *v) {
  size_t rows = (size_t)v->motion->rows, d = (size_t)v->model->coordinate_count;
  double **arrays[] = {&v->q, &v->qd, &v->qdd, &v->tau};
  int failed = 0;
  for (int i = 0; i < 4; i++) {
    *arrays[i] = ambulo__alloc(&v->allocator, rows * d, sizeof(double));
    failed |= !*arrays[i];
  }
  v->wrench = ambulo__alloc(&v->allocator, 6 * rows, sizeof(double));
  v->zmp = ambulo__alloc(&v->allocator, 3 * rows, sizeof(double));
  return failed || !v->wrench || !v->zmp ? AMBULO_E_MEMORY : AMBULO_OK;
}

static void zero_moment_points(inverse *v) {
  const double *n = v->model->up;
  for (int k = 0; k < v->motion->rows; k++) {
    const double *m = v->wrench + 6 * (size_t)k, *f = m + 3;
    double normal = n[0] * f[0] + n[1] * f[1] + n[2] * f[2];
    double cross[3] = {n[1] * m[2] - n[2] * m[1], n[2] * m[0] - n[0] * m[2],
                       n[0] * m[1] - n[1] * m[0]};
    for (int i = 0; i < 3; i++)
      v->zmp[3 * (size_t)k + (size_t)i] = normal > 0.0 ? cross[i] / normal : (double)NAN;
  }
}

static ambulo_status compute(inverse *v) {
  int rows = v->motion->rows;
  ambulo_mechanics *mechanics = NULL;
  ambulo_status status = allocate(v);
  if (!status)
    status = ambulo__motion_fit_create(v->motion, rows > 5 ? 5 : 3, 0.0, &v->allocator, &v->fit);
  if (!status) status = ambulo_mechanics_create(v->model, &v->allocator, &mechanics);
  if (!status) {
    ambulo__motion_fit_at(v->fit, v->motion->time, rows, v->q, v->qd, v->qdd);
    status = ambulo_mechanics_inverse_dynamics(mechanics, rows, v->q, v->qd, v->qdd, v->tau,
                                               v->wrench, NULL);
  }
  ambulo_mechanics_free(mechanics);
  if (!status) zero_moment_points(v);
  return status;
}

static ambulo_status deliver(inverse *v, const char *output, char **text) {
  ambulo__text_buffer buffer;
  ambulo__text_init(&buffer, &v->allocator);
  ambulo__motion_table table = {
      .model = v->model,
      .name = v->model->name,
      .samples = v->motion->rows,
      .times = v->motion->time,
      .q = v->q,
      .qd = v->qd,
      .qdd = v->qdd,
      .tau = v->tau,
      .zmp = v->zmp,
  };
  ambulo__motion_csv(&table, &buffer);
  ambulo_status status = ambulo__text_status(&buffer);
  if (!status && output) {
    status = ambulo__write_file(output, ambulo__text_data(&buffer), buffer.length, 1, &v->allocator,
                                v->diagnostics);
  } else if (!status) {
    char *copy = ambulo__strdup(&v->allocator, ambulo__text_data(&buffer));
    if (copy) *text = copy;
    if (!copy) status = AMBULO_E_MEMORY;
  }
  ambulo__text_free(&buffer);
  return status;
}

/* -------------------------------------------------------- forces on the feet */

static void tell(const inverse *v, const char *forces, const ambulo__ground_load *load,
                 const ambulo_ground_residual *r) {
  ambulo__place place = {.file = forces};
  if (!load->has_points)
    ambulo__warning(
        v->diagnostics, place, NULL,
        "neither points nor torques; the forces are applied at the zero-moment point of "
        "the motion, which makes torques rough while both feet are loaded");
  ambulo__note(v->diagnostics, place,
               "left over at the root: forward %.4f, up %.4f, left %.4f body weights (rms)",
               r->force_rms[0], r->force_rms[1], r->force_rms[2]);
  if (load->has_points)
    ambulo__note(v->diagnostics, place, "moment left over: %.4f body weights m (rms)",
                 r->moment_rms);
  ambulo__note(v->diagnostics, place, "vertical impulse %.2f N s; the motion needs %.2f N s",
               r->given_vertical_impulse, r->vertical_impulse);
}

static ambulo_status apply_forces(inverse *v, const char *forces,
                                  ambulo_ground_residual *residual) {
  ambulo__ground_load load;
  ambulo_ground_residual r;
  ambulo_status status = ambulo__ground_load_read(
      v->model, forces, v->motion->time, v->motion->rows, &v->allocator, v->diagnostics, &load);
  if (status) return status;
  ambulo__ground_load_place(&load, v->zmp);
  status = ambulo__ground_load_apply(&load, v->model, v->q, v->tau);
  if (!status) {
    ambulo__ground_load_residual(&load, v->model, v->motion->time, v->wrench, v->zmp, &r);
    tell(v, forces, &load, &r);
    if (residual) *residual = r;
  }
  ambulo__ground_load_free(&load);
  return status;
}

static ambulo_status run(inverse *v, const char *forces, const char *output,
                         ambulo_ground_residual *residual, char **text) {
  ambulo_ground_residual r = {.moment_rms = (double)NAN};
  ambulo_status status = read_motion(v);
  if (!status) status = compute(v);
  if (!status && forces) status = apply_forces(v, forces, &r);
  if (!status) status = deliver(v, output, text);
  if (!status && forces && residual) *residual = r;
  clear(v);
  return status;
}

ambulo_status ambulo_inverse_dynamics_file(const ambulo_model *model, const char *motion,
                                           const char *output, const ambulo_allocator *allocator,
                                           ambulo_diagnostics *diagnostics, char **text) {
  if (!model || !motion || (!output && !text)) return AMBULO_E_ARGUMENT;
  inverse v = {.allocator = ambulo__allocator_or_default(allocator),
               .model = model,
               .diagnostics = diagnostics,
               .file = motion};
  return run(&v, NULL, output, NULL, text);
}

ambulo_status ambulo_inverse_dynamics_loaded(const ambulo_model *model, const char *motion,
                                             const char *forces, const char *output,
                                             const ambulo_allocator *allocator,
                                             ambulo_diagnostics *diagnostics,
                                             ambulo_ground_residual *residual, char **text) {
  if (!model || !motion || !forces || (!output && !text)) return AMBULO_E_ARGUMENT;
  inverse v = {.allocator = ambulo__allocator_or_default(allocator),
               .model = model,
               .diagnostics = diagnostics,
               .file = motion};
  return run(&v, forces, output, residual, text);
}
