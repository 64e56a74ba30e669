/* people/inverse_motion.c - values, rates and accelerations of a motion file (inverse.h).
 *
 * What the file has is used as it stands. Rates that it lacks are those of an interpolating spline
 * through the values (degree 5; 3 with fewer than 6 rows), accelerations that it lacks the slopes
 * of one through its rates, or the second derivative of the one through the values. After a filter
 * everything comes from the filtered values. */
#include "people/inverse.h"

#include "formats/motion_file.h"
#include "model/model.h"
#include "people/motion_fit.h"

#include <math.h>
#include <string.h>

static const double radian = 3.14159265358979323846 / 180.0;

/* 1 if the file's angles are in degrees */
static int in_degrees(ambulo__inverse *v) {
  ambulo__place place = {.file = v->file};
  ambulo_angle_unit wanted = v->options.angles;
  if (wanted == AMBULO_ANGLES_OF_FILE && v->given->in_degrees && !v->given->unit_stated)
    ambulo__doubt(&v->doubts, v->file, "say which: --angles degrees or --angles radians",
                  "the header has neither inDegrees nor version: angles are taken in degrees, as "
                  "OpenSim takes such files");
  if (wanted == AMBULO_ANGLES_OF_FILE) return v->given->in_degrees;
  int degrees = wanted == AMBULO_ANGLES_DEGREES;
  if (v->given->unit_stated && degrees != v->given->in_degrees)
    ambulo__note(v->doubts.diagnostics, place,
                 "the file says that its angles are in %s; taken as %s",
                 v->given->in_degrees ? "degrees" : "radians", degrees ? "degrees" : "radians");
  return degrees;
}

static void copy_column(const ambulo__inverse *v, int column, double factor, int i, double *to) {
  size_t d = (size_t)v->model->coordinate_count, columns = (size_t)v->given->columns;
  for (size_t k = 0; k < (size_t)v->rows; k++)
    to[k * d + (size_t)i] = factor * v->given->values[k * columns + (size_t)column];
}

static ambulo_status take_column(ambulo__inverse *v, int i, ambulo__motion_order order,
                                 double factor, double *to, unsigned char *has) {
  int column = -1;
  ambulo_status status = ambulo__motion_find(v->given, v->file, v->model->coordinates[i].name,
                                             order, v->doubts.diagnostics, &column);
  has[i] = !status && column >= 0;
  if (has[i]) copy_column(v, column, factor, i, to);
  return status;
}

/* every fault of the columns is reported before the first one is returned */
static ambulo_status take_columns(ambulo__inverse *v) {
  ambulo_status first = AMBULO_OK;
  int degrees = in_degrees(v);
  for (int i = 0; i < v->model->coordinate_count; i++) {
    int angle = v->model->coordinates[i].type == AMBULO_REVOLUTE;
    double unit = angle ? (degrees ? radian : 1.0) : v->options.length_unit;
    double per_time = unit / v->options.time_unit;
    ambulo_status status = take_column(v, i, AMBULO__ORDER_VALUE, unit, v->q, v->has_value);
    if (!first) first = status;
    if (!v->has_value[i] || v->options.recompute_rates || v->options.cutoff > 0.0) continue;
    status = take_column(v, i, AMBULO__ORDER_RATE, per_time, v->qd, v->has_rate);
    if (!first) first = status;
    status = take_column(v, i, AMBULO__ORDER_ACCELERATION, per_time / v->options.time_unit, v->qdd,
                         v->has_acceleration);
    if (!first) first = status;
  }
  return first;
}

/* coordinates without a column: none at all is a mistake, some are doubted */
static ambulo_status check_columns(ambulo__inverse *v) {
  const ambulo_model *model = v->model;
  int d = model->coordinate_count, found = 0;
  for (int i = 0; i < d; i++) found += v->has_value[i];
  if (found == 0) {
    ambulo__place place = {.file = v->file};
    return ambulo__error(v->doubts.diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "no column is named after a coordinate of model '%s'; expected for "
                         "example '%s'",
                         model->name, d ? model->coordinates[0].name : "");
  }
  for (int i = 0; i < d; i++) {
    if (!v->has_value[i])
      ambulo__doubt(&v->doubts, v->file, "a column of zeros says that it is zero",
                    "no column for coordinate '%s'; it is taken as 0", model->coordinates[i].name);
  }
  return AMBULO_OK;
}

/* a value that moves a coordinate of some other model */
static int is_stray(const ambulo__inverse *v, int column) {
  const ambulo__motion *m = v->given;
  int moves = 0;
  if (!ambulo__motion_is_value(m->names[column])) return 0;
  for (int i = 0; i < v->model->coordinate_count; i++) {
    if (ambulo__motion_names(m->names[column], v->model->coordinates[i].name, AMBULO__ORDER_VALUE))
      return 0;
  }
  for (int k = 0; k < m->rows; k++)
    moves |= m->values[(size_t)k * (size_t)m->columns + (size_t)column] != 0.0;
  return moves;
}

static void doubt_strays(ambulo__inverse *v) {
  int count = 0, first = -1;
  for (int c = 0; c < v->given->columns; c++) {
    if (!is_stray(v, c)) continue;
    if (count++ == 0) first = c;
  }
  if (count == 0) return;
  ambulo__doubt(&v->doubts, v->file, "the motion of another body needs its own model",
                "'%s' is no coordinate of model '%s'; %d such column%s left out",
                v->given->names[first], v->model->name, count, count > 1 ? "s are" : " is");
}

/* ------------------------------------------------------------------- splines */

/* rates and accelerations (each may be NULL) of a spline through values [rows][d] */
static ambulo_status differentiate(const ambulo__inverse *v, double *values, double *rates,
                                   double *accelerations) {
  ambulo__motion table = {.allocator = v->allocator,
                          .rows = v->rows,
                          .columns = v->model->coordinate_count,
                          .time = v->given->time,
                          .values = values};
  ambulo__motion_fit *fit = NULL;
  ambulo_status status =
      ambulo__motion_fit_create(&table, v->rows > 5 ? 5 : 3, 0.0, &v->allocator, &fit);
  if (status == AMBULO_E_NUMERIC ||
      status == AMBULO_E_ARGUMENT) { /* of times: no spline has them */
    ambulo__place place = {.file = v->file};
    return ambulo__error(
        v->doubts.diagnostics, AMBULO_E_NUMERIC, place, NULL,
        "no spline goes through the values: some are too large or too close in time");
  }
  if (status) return status;
  ambulo__motion_fit_at(fit, v->given->time, v->rows, NULL, rates, accelerations);
  ambulo__motion_fit_free(fit);
  return AMBULO_OK;
}

/* fills the gaps of `to` from `from` */
static void complete(const ambulo__inverse *v, const unsigned char *wanted, const double *from,
                     double *to) {
  size_t d = (size_t)v->model->coordinate_count;
  for (size_t at = 0; at < (size_t)v->rows * d; at++) {
    if (wanted[at % d]) to[at] = from[at];
  }
}

/* scratch: rates, accelerations, slopes of the rates [rows][d]; masks [d] */
static ambulo_status fill_gaps(ambulo__inverse *v, double *const scratch[3],
                               unsigned char *by_value, unsigned char *by_rate) {
  int need_rate = 0, need_slope = 0;
  for (int i = 0; i < v->model->coordinate_count; i++) {
    int lacks_acceleration = v->has_value[i] && !v->has_acceleration[i];
    need_rate |= v->has_value[i] && !v->has_rate[i];
    by_rate[i] = (unsigned char)(lacks_acceleration && v->has_rate[i]);
    by_value[i] = (unsigned char)(lacks_acceleration && !v->has_rate[i]);
    need_slope |= by_rate[i];
    need_rate |= by_value[i];
  }
  if (v->rows < 4) {
    ambulo__place place = {.file = v->file};
    if (!need_rate && !need_slope) return AMBULO_OK;
    return ambulo__error(v->doubts.diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "%d times; expected at least 4 for rates and accelerations", v->rows);
  }
  ambulo_status status = differentiate(v, v->q, scratch[0], scratch[1]);
  if (status) return status;
  complete(v, by_value, scratch[1], v->qdd);
  for (int i = 0; i < v->model->coordinate_count; i++)
    by_value[i] = (unsigned char)(v->has_value[i] && !v->has_rate[i]);
  complete(v, by_value, scratch[0], v->qd);
  status = differentiate(v, v->qd, scratch[2], NULL);
  if (status) return status;
  complete(v, by_rate, scratch[2], v->qdd);
  ambulo__doubt_rates(v, scratch[0], scratch[2]);
  return AMBULO_OK;
}

static ambulo_status find_rates(ambulo__inverse *v) {
  size_t d = (size_t)v->model->coordinate_count, count = (size_t)v->rows * d;
  double *scratch[3];
  int failed = 0;
  unsigned char *masks = ambulo__alloc(&v->allocator, 2 * d, 1);
  for (int i = 0; i < 3; i++) {
    scratch[i] = ambulo__alloc(&v->allocator, count, sizeof(double));
    failed |= !scratch[i];
  }
  ambulo_status status =
      failed || !masks ? AMBULO_E_MEMORY : fill_gaps(v, scratch, masks, masks + d);
  for (int i = 0; i < 3; i++) ambulo__free(&v->allocator, scratch[i]);
  ambulo__free(&v->allocator, masks);
  return status;
}

/* ------------------------------------------------------------------- the whole */

static ambulo_status allocate(ambulo__inverse *v) {
  const ambulo_allocator *a = &v->allocator;
  size_t d = (size_t)v->model->coordinate_count, count = (size_t)v->rows * d;
  v->q = ambulo__alloc(a, count, sizeof(double));
  v->qd = ambulo__alloc(a, count, sizeof(double));
  v->qdd = ambulo__alloc(a, count, sizeof(double));
  v->has_value = ambulo__alloc(a, d, 1);
  v->has_rate = ambulo__alloc(a, d, 1);
  v->has_acceleration = ambulo__alloc(a, d, 1);
  int complete_now = v->q && v->qd && v->qdd && v->has_value && v->has_rate && v->has_acceleration;
  return complete_now ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* a filter leaves the file's rates behind */
static void note_unused_rates(const ambulo__inverse *v) {
  ambulo__place place = {.file = v->file};
  for (int i = 0; i < v->model->coordinate_count; i++) {
    int column = -1;
    ambulo_status status = ambulo__motion_find(v->given, v->file, v->model->coordinates[i].name,
                                               AMBULO__ORDER_RATE, NULL, &column);
    if (status || column < 0) continue;
    ambulo__note(v->doubts.diagnostics, place,
                 "rates and accelerations are those of the filtered values; the file's own are not "
                 "used");
    return;
  }
}

static ambulo_status filter(const ambulo__inverse *v) {
  ambulo__filtering filtering = {.time = v->given->time,
                                 .rows = v->rows,
                                 .time_unit = 1.0,
                                 .cutoff = v->options.cutoff,
                                 .order = v->options.filter_order,
                                 .option = "--filter",
                                 .file = v->file,
                                 .diagnostics = v->doubts.diagnostics};
  if (isnan(v->options.cutoff)) return AMBULO_OK;
  note_unused_rates(v);
  return ambulo__filter(&filtering, v->q, v->model->coordinate_count, &v->allocator);
}

ambulo_status ambulo__inverse_read(ambulo__inverse *v) {
  ambulo_status status =
      ambulo__motion_read(v->file, 0, &v->allocator, v->doubts.diagnostics, &v->given);
  if (status) return status;
  v->rows = v->given->rows;
  ambulo__doubt_header(&v->doubts, v->file, v->given);
  for (int k = 0; k < v->rows; k++) v->given->time[k] *= v->options.time_unit;
  status = allocate(v);
  if (!status) status = take_columns(v);
  if (!status) status = check_columns(v);
  if (status) return status;
  doubt_strays(v);
  ambulo__doubt_body(&v->doubts, v->file, v->given, v->model);
  ambulo__doubt_units(v);
  status = filter(v);
  return status ? status : find_rates(v);
}
