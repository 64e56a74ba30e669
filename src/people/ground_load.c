/* people/ground_load.c - reading forces on the feet (ground_load.h). */
#include "people/ground_load.h"
#include "base/arithmetic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "people/motion_fit.h"
#include "model/model.h"

/* of the body weight: a foot that carries less may lack its point */
static const double light = 0.05;
/* body weights m: what a moment and the force at its point may differ by */
static const double rounded = 1e-4;
/* times the step of the motion: forces are recorded more often than that */
static const double sparse = 20.0;

/* a group of columns on its way to forces and moments on the file's own rows */
typedef struct group_load {
  const ambulo__load_source *source;
  const ambulo__motion *table;
  const ambulo__force_group *group;
  double weight;  /* of the body, N */
  double *wrench; /* [table rows][6]: force, moment about the origin; of the whole foot */
  double *loose;  /* [table rows][3]: force without points; of the whole foot */
  int *from;      /* [table rows]: nearest row in time that has a point, often itself */
} group_load;

static double size_of(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double cell(const ambulo__motion *table, int row, int column) {
  if (column < 0) return 0.0;
  return table->values[(size_t)row * (size_t)table->columns + (size_t)column];
}

static void take(const ambulo__motion *table, int row, const int columns[3], double factor,
                 double v[3]) {
  for (int i = 0; i < 3; i++) v[i] = factor * cell(table, row, columns[i]);
}

static int is_finite(const double v[3]) {
  return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

static int is_zero(const double v[3]) {
  return v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0;
}

/* ------------------------------------------------------------------- points */

/* 1: moments are given about the origin, as torques beside points that are all zero */
static int has_moments_of_origin(const group_load *g) {
  const double *up = ambulo_model_up(g->source->model);
  int sideways = 0;
  for (int k = 0; k < g->table->rows; k++) {
    double point[3], torque[3], along = 0.0;
    take(g->table, k, g->group->point, 1.0, point);
    take(g->table, k, g->group->torque, 1.0, torque);
    if (!is_zero(point)) return 0;
    for (int i = 0; i < 3; i++) along += torque[i] * up[i];
    for (int i = 0; i < 3; i++) sideways |= fabs(torque[i] - along * up[i]) > 0.0;
  }
  return sideways;
}

static int has_point(const group_load *g, int row) {
  double point[3];
  take(g->table, row, g->group->point, 1.0, point);
  return is_finite(point) && !is_zero(point);
}

/* fills g->from; 0 if no row has a point */
static int find_points(const group_load *g) {
  const int *columns = g->group->point;
  int rows = g->table->rows, last = -1;
  const double *time = g->table->time;
  if (columns[0] < 0 && columns[1] < 0 && columns[2] < 0) return 0;
  int everywhere = has_moments_of_origin(g);
  for (int k = 0; k < rows; k++) {
    if (everywhere || has_point(g, k)) last = k;
    g->from[k] = last;
  }
  if (last < 0) return 0;
  for (int k = rows - 1, next = -1; k >= 0; k--) {
    if (g->from[k] == k) next = k;
    int before = g->from[k];
    if (next >= 0 && (before < 0 || time[next] - time[k] < time[k] - time[before]))
      g->from[k] = next;
  }
  return 1;
}

/* the height of points that have no column for it: the ground's */
static void put_on_ground(const group_load *g, double point[3]) {
  const double *up = ambulo_model_up(g->source->model);
  for (int i = 0; i < 3; i++) {
    if (fabs(up[i]) > 1.0 - 1e-9 && g->group->point[i] < 0)
      point[i] = g->source->options->ground_height * up[i];
  }
}

/* ---------------------------------------------------------- force and moment */

static ambulo_status refuse_gap(const group_load *g, const char *what, double force, int row) {
  ambulo__place place = {.file = g->source->file};
  double time = g->source->options->force_time_unit * g->table->time[row];
  return ambulo__error(g->source->doubts->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                       "'%s' of foot '%s' has no %s (nan) at t = %g s, where it carries %.1f N",
                       g->group->name, ambulo_model_foot(g->source->model, g->group->foot)->name,
                       what, time, force);
}

static ambulo_status take_force(const group_load *g, int row, double force[3]) {
  take(g->table, row, g->group->force, 1.0, force);
  if (is_finite(force)) return AMBULO_OK;
  ambulo__place place = {.file = g->source->file};
  return ambulo__error(g->source->doubts->diagnostics, AMBULO_E_SCHEMA, place,
                       "a foot in the air has the force 0",
                       "'%s' of foot '%s' has no force (nan) at t = %g s", g->group->name,
                       ambulo_model_foot(g->source->model, g->group->foot)->name,
                       g->source->options->force_time_unit * g->table->time[row]);
}

/* torques and the free moment, N m */
static ambulo_status take_torque(const group_load *g, int row, double force, double torque[3]) {
  const double *up = ambulo_model_up(g->source->model);
  double unit = g->source->options->force_length_unit;
  take(g->table, row, g->group->torque, unit, torque);
  double free_moment = unit * cell(g->table, row, g->group->free_moment);
  for (int i = 0; i < 3; i++) torque[i] += free_moment * up[i];
  if (is_finite(torque)) return AMBULO_OK;
  if (force > light * g->weight) return refuse_gap(g, "torque", force, row);
  for (int i = 0; i < 3; i++) torque[i] = 0.0;
  return AMBULO_OK;
}

/* is the point of another row good enough for this one? */
static ambulo_status check_point(const group_load *g, int row, double force, int *doubtful) {
  double point[3];
  if (g->from[row] == row) return AMBULO_OK;
  take(g->table, row, g->group->point, 1.0, point);
  if (force > light * g->weight && !is_finite(point)) return refuse_gap(g, "point", force, row);
  if (force > light * g->weight && !*doubtful) {
    *doubtful = 1;
    ambulo__doubt(g->source->doubts, g->source->file, NULL,
                  "'%s' of foot '%s' has the point 0 0 0 at t = %g s, where it carries %.1f N; the "
                  "nearest other one in time is taken",
                  g->group->name, ambulo_model_foot(g->source->model, g->group->foot)->name,
                  g->source->options->force_time_unit * g->table->time[row], force);
  }
  return AMBULO_OK;
}

/* the row's moment about the origin, in full, if the file has it */
static int take_moment(const group_load *g, int row, double moment[3]) {
  const int *columns = g->group->moment;
  if (columns[0] < 0 || columns[1] < 0 || columns[2] < 0) return 0;
  take(g->table, row, columns, g->source->options->force_length_unit, moment);
  return is_finite(moment);
}

/* somebody changed one of them */
static void doubt_moment(const group_load *g, int row, const double load[6], int *doubtful) {
  double point[3], torque[3], off = 0.0, unit = g->source->options->force_length_unit;
  take(g->table, row, g->group->point, unit, point);
  if (*doubtful || !is_finite(point) || take_torque(g, row, 0.0, torque)) return;
  ambulo__add_cross(point, load, 1.0, torque);
  for (int i = 0; i < 3; i++) off = fmax(off, fabs(torque[i] - load[3 + i]));
  if (off <= rounded * g->weight) return;
  *doubtful = 1;
  ambulo__doubt(g->source->doubts, g->source->file,
                "without the columns 'moment.' points are taken",
                "the moment of '%s' is %.3g N m from that of its force at its point at t = %g s; "
                "the moment is taken",
                g->group->name, off, g->source->options->force_time_unit * g->table->time[row]);
}

/* the row's force and, of a point, its moment about the origin; of none: what is loose */
static ambulo_status take_load(const group_load *g, int row, int placed, int *doubtful,
                               double load[6], double loose[3]) {
  double torque[3], point[3];
  ambulo_status status = take_force(g, row, load);
  if (status) return status;
  if (take_moment(g, row, load + 3)) {
    doubt_moment(g, row, load, doubtful);
    return AMBULO_OK;
  }
  double size = size_of(load);
  status = take_torque(g, row, size, torque);
  if (!status && placed) status = check_point(g, row, size, doubtful);
  if (status) return status;
  memcpy(load + 3, torque, sizeof torque);
  for (int i = 0; i < 3 && !placed; i++) loose[i] += load[i];
  if (!placed || is_zero(load)) return AMBULO_OK;
  take(g->table, g->from[row], g->group->point, g->source->options->force_length_unit, point);
  put_on_ground(g, point);
  ambulo__add_cross(point, load, 1.0, load + 3);
  return AMBULO_OK;
}

static ambulo_status add_group(const group_load *g, int placed) {
  int doubtful = 0;
  for (int k = 0; k < g->table->rows; k++) {
    double load[6];
    ambulo_status status = take_load(g, k, placed, &doubtful, load, g->loose + 3 * (size_t)k);
    if (status) return status;
    for (int i = 0; i < 6; i++) g->wrench[6 * (size_t)k + (size_t)i] += load[i];
  }
  return AMBULO_OK;
}

/* some row says its force and not where it acts */
static int is_loose(const group_load *g) {
  for (int k = 0; k < g->table->rows; k++) {
    double force[3], moment[3];
    take(g->table, k, g->group->force, 1.0, force);
    if (!is_zero(force) && !take_moment(g, k, moment)) return 1;
  }
  return 0;
}

/* ------------------------------------------------------------------- one foot */

/* (I.2): linearly between the file's rows, which cover the time */
void ambulo__load_between(const ambulo__motion *table, double unit, const double *values, int width,
                          double time, double *out) {
  int low = 0, high = table->rows - 1;
  while (high - low > 1) {
    int middle = low + (high - low) / 2;
    if (unit * table->time[middle] <= time) {
      low = middle;
    } else {
      high = middle;
    }
  }
  double start = unit * table->time[low], end = unit * table->time[high];
  double s = fmin(fmax((time - start) / (end - start), 0.0), 1.0);
  const double *a = values + (size_t)low * (size_t)width,
               *b = values + (size_t)high * (size_t)width;
  for (int i = 0; i < width; i++) out[i] = s < 1.0 ? a[i] + s * (b[i] - a[i]) : b[i];
}

static ambulo_status smooth(const group_load *g) {
  const ambulo_inverse_options *o = g->source->options;
  ambulo__filtering filtering = {.time = g->table->time,
                                 .rows = g->table->rows,
                                 .time_unit = o->force_time_unit,
                                 .cutoff = o->force_cutoff,
                                 .order = o->filter_order,
                                 .option = "--grf-filter",
                                 .file = g->source->file,
                                 .diagnostics = g->source->doubts->diagnostics};
  const ambulo_allocator *a = &g->table->allocator;
  if (isnan(o->force_cutoff)) return AMBULO_OK;
  ambulo_status status = ambulo__filter(&filtering, g->wrench, 6, a);
  return status ? status : ambulo__filter(&filtering, g->loose, 3, a);
}

static ambulo_status load_foot(group_load *g, const ambulo__force_columns *columns, int foot,
                               ambulo__ground_load *load) {
  ambulo_status status = AMBULO_OK;
  memset(g->wrench, 0, 6 * (size_t)g->table->rows * sizeof *g->wrench);
  memset(g->loose, 0, 3 * (size_t)g->table->rows * sizeof *g->loose);
  for (int i = 0; i < columns->count && !status; i++) {
    g->group = &columns->groups[i];
    if (g->group->foot != foot) continue;
    int placed = find_points(g);
    if (!placed && is_loose(g)) load->is_loose[foot] = 1;
    status = add_group(g, placed);
  }
  if (!status) status = smooth(g);
  for (int k = 0; k < load->rows && !status; k++) {
    double wrench[6], unit = g->source->options->force_time_unit;
    size_t at = 3 * ((size_t)k * (size_t)load->feet + (size_t)foot);
    ambulo__load_between(g->table, unit, g->wrench, 6, g->source->times[k], wrench);
    ambulo__load_between(g->table, unit, g->loose, 3, g->source->times[k], load->loose + at);
    memcpy(load->force + at, wrench, 3 * sizeof *wrench);
    memcpy(load->moment + at, wrench + 3, 3 * sizeof *wrench);
  }
  if (!status && load->is_loose[foot])
    ambulo__doubt(g->source->doubts, g->source->file, NULL,
                  "the forces on foot '%s' have no points; they are applied at the zero-moment "
                  "point of the motion, which makes torques rough while both feet are loaded",
                  ambulo_model_foot(g->source->model, foot)->name);
  return status;
}

/* ------------------------------------------------------------------- the whole */

/* 1000 ms cover the first second of any motion, and tell nothing about it */
static void doubt_steps(const ambulo__load_source *s, const ambulo__motion *table) {
  double span = table->time[table->rows - 1] - table->time[0];
  double step = s->options->force_time_unit * span / (double)(table->rows - 1);
  double own = (s->times[s->rows - 1] - s->times[0]) / (double)(s->rows > 1 ? s->rows - 1 : 1);
  if (table->rows > 2 && own > 0.0 && step >= sparse * own)
    ambulo__doubt(s->doubts, s->file, "times in milliseconds: --grf-time ms",
                  "the rows of the forces are %g s apart, those of the motion %g s", step, own);
}

ambulo_status ambulo__load_times_check(const ambulo__load_source *s, const ambulo__motion *table) {
  ambulo__place place = {.file = s->file};
  double first = s->times[0], last = s->times[s->rows - 1], slack = 1e-6 * (last - first);
  double unit = s->options->force_time_unit;
  double begin = unit * table->time[0], end = unit * table->time[table->rows - 1];
  if (table->rows >= 2 && begin <= first + slack && end >= last - slack) {
    doubt_steps(s, table);
    return AMBULO_OK;
  }
  if (table->rows < 2)
    return ambulo__error(s->doubts->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "forces at one time, %g s; expected at least 2 rows", begin);
  int milliseconds =
      1e-3 * begin <= first + slack && 1e-3 * end >= last - slack && end > 100.0 * last;
  return ambulo__error(s->doubts->diagnostics, AMBULO_E_SCHEMA, place,
                       milliseconds ? "times in milliseconds: --grf-time ms" : NULL,
                       "forces from %g to %g s; expected them from %g to %g s as the motion", begin,
                       end, first, last);
}

static ambulo_status load_feet(const ambulo__load_source *s, const ambulo__motion *table,
                               const ambulo__force_columns *columns, ambulo__ground_load *load) {
  const ambulo_allocator *a = &load->allocator;
  size_t rows = (size_t)table->rows;
  const double *g = ambulo_model_gravity(s->model);
  group_load work = {
      .source = s, .table = table, .weight = ambulo_model_mass(s->model) * size_of(g)};
  work.wrench = ambulo__alloc(a, 6 * rows, sizeof *work.wrench);
  work.loose = ambulo__alloc(a, 3 * rows, sizeof *work.loose);
  work.from = ambulo__alloc(a, rows, sizeof *work.from);
  ambulo_status status = work.wrench && work.loose && work.from ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int foot = 0; foot < load->feet && !status; foot++)
    status = load_foot(&work, columns, foot, load);
  ambulo__free(a, work.wrench);
  ambulo__free(a, work.loose);
  ambulo__free(a, work.from);
  return status;
}

static ambulo_status read_columns(const ambulo__load_source *s, const ambulo__motion *table,
                                  ambulo__ground_load *load) {
  ambulo__force_columns columns = {.count = 0};
  ambulo_status status = ambulo__force_columns_find(table, s->file, &load->allocator,
                                                    s->doubts->diagnostics, &columns);
  if (status) return status;
  status = ambulo__force_columns_match(&columns, s->model, s->options->force_columns, s->doubts);
  if (!status) status = ambulo__force_columns_complete(&columns, s->model, s->doubts);
  if (!status) status = ambulo__load_times_check(s, table);
  if (!status) status = load_feet(s, table, &columns, load);
  ambulo__force_columns_free(&columns);
  return status;
}

ambulo_status ambulo__ground_load_read(const ambulo__load_source *source,
                                       const ambulo_allocator *allocator,
                                       ambulo__ground_load *load) {
  ambulo__ground_load l = {.allocator = ambulo__allocator_or_default(allocator),
                           .rows = source->rows,
                           .feet = ambulo_model_foot_count(source->model)};
  ambulo__motion *read = NULL;
  const ambulo__motion *table = source->table;
  size_t count = 3 * (size_t)l.rows * (size_t)l.feet;
  ambulo_status status = AMBULO_OK;
  if (!table) {
    status = ambulo__motion_read(source->file, 1, &l.allocator, source->doubts->diagnostics, &read);
    if (status || !read) return status;
    ambulo__doubt_header(source->doubts, source->file, read);
    table = read;
  }
  l.force = ambulo__alloc(&l.allocator, count, sizeof(double));
  l.moment = ambulo__alloc(&l.allocator, count, sizeof(double));
  l.loose = ambulo__alloc(&l.allocator, count, sizeof(double));
  l.is_loose = ambulo__alloc(&l.allocator, (size_t)l.feet, 1);
  if (!l.force || !l.moment || !l.loose || !l.is_loose) status = AMBULO_E_MEMORY;
  if (!status) status = read_columns(source, table, &l);
  ambulo__motion_free(read);
  if (status) {
    ambulo__ground_load_free(&l);
  } else {
    *load = l;
  }
  return status;
}

void ambulo__ground_load_free(ambulo__ground_load *load) {
  ambulo__free(&load->allocator, load->force);
  ambulo__free(&load->allocator, load->moment);
  ambulo__free(&load->allocator, load->loose);
  ambulo__free(&load->allocator, load->is_loose);
}
