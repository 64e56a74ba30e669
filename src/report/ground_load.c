/* report/ground_load.c - reading forces on the feet, applying them, what they leave over
 * (ground_load.h). */
#include "report/ground_load.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "report/skeleton.h"
#include "trajectory/motion_file.h"

/* ------------------------------------------------------------------- reading */

typedef struct foot_columns {
  int force[3], point[3], torque[3], free_moment; /* -1: not in the file */
} foot_columns;

static int column(const ambulo__motion *motion, const char *pattern, const char *foot, char axis) {
  char name[AMBULO__MOTION_MAX_NAME];
  char side[2] = {foot[0], '\0'};
  const char *who = pattern[0] == 'g' && pattern[1] == 'r' && pattern[2] == 'o' ? side : foot;
  const char *hole = strchr(pattern, '*');
  snprintf(name, sizeof name, "%.*s%s%s%c", (int)(hole - pattern), pattern, who, hole + 1, axis);
  return ambulo__motion_column(motion, name);
}

static void find_columns(const ambulo__motion *motion, const char *foot, foot_columns *columns) {
  char name[AMBULO__MOTION_MAX_NAME];
  snprintf(name, sizeof name, "free_moment.%s", foot);
  columns->free_moment = ambulo__motion_column(motion, name);
  for (int i = 0; i < 3; i++) {
    char axis = "xyz"[i];
    columns->force[i] = column(motion, "ground_force_*_v", foot, axis);
    columns->point[i] = column(motion, "ground_force_*_p", foot, axis);
    columns->torque[i] = column(motion, "ground_torque_*_", foot, axis);
    if (columns->force[i] < 0) columns->force[i] = column(motion, "grf.*.", foot, axis);
    if (columns->point[i] < 0) columns->point[i] = column(motion, "cop.*.", foot, axis);
  }
}

/* value of a column at a time within the file; 0 for column -1 */
static double value_at(const ambulo__motion *motion, int at, double time) {
  if (at < 0) return 0.0;
  int low = 0, high = motion->rows - 1;
  while (high - low > 1) {
    int middle = low + (high - low) / 2;
    if (motion->time[middle] <= time) {
      low = middle;
    } else {
      high = middle;
    }
  }
  const double *values = motion->values + at;
  double a = values[(size_t)low * (size_t)motion->columns];
  double b = values[(size_t)high * (size_t)motion->columns];
  double s = (time - motion->time[low]) / (motion->time[high] - motion->time[low]);
  /* a foot in the air has no point: that of the other end, as its force goes to zero */
  if (isnan(a)) a = isnan(b) ? 0.0 : b;
  if (isnan(b)) b = a;
  return a + fmin(fmax(s, 0.0), 1.0) * (b - a);
}

static ambulo_status check(const ambulo__motion *motion, const char *path, const double *times,
                           int rows, int found, ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = path};
  double first = times[0], last = times[rows - 1], slack = 1e-6 * (last - first);
  if (!found)
    return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "no column of forces on a foot; expected for example ground_force_r_vx or "
                         "grf.right.x");
  if (motion->rows >= 2 && motion->time[0] <= first + slack &&
      motion->time[motion->rows - 1] >= last - slack)
    return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                       "forces from %g to %g s; expected them from %g to %g s as the motion",
                       motion->time[0], motion->time[motion->rows - 1], first, last);
}

static int fill(ambulo__ground_load *load, const ambulo__motion *motion, int foot,
                const foot_columns *columns, const double *up, const double *times) {
  int found = 0;
  for (int k = 0; k < load->rows; k++) {
    for (int i = 0; i < 3; i++) {
      size_t at = 3 * ((size_t)k * (size_t)load->feet + (size_t)foot) + (size_t)i;
      load->force[at] = value_at(motion, columns->force[i], times[k]);
      load->point[at] = value_at(motion, columns->point[i], times[k]);
      load->torque[at] = value_at(motion, columns->torque[i], times[k]) +
                         value_at(motion, columns->free_moment, times[k]) * up[i];
      load->has_points |= load->point[at] != 0.0 || load->torque[at] != 0.0;
      found |= columns->force[i] >= 0;
    }
  }
  return found;
}

ambulo_status ambulo__ground_load_read(const ambulo_model *model, const char *path,
                                       const double *times, int rows,
                                       const ambulo_allocator *allocator,
                                       ambulo_diagnostics *diagnostics, ambulo__ground_load *load) {
  ambulo__ground_load l = {.allocator = ambulo__allocator_or_default(allocator),
                           .rows = rows,
                           .feet = ambulo_model_foot_count(model)};
  ambulo__motion *motion = NULL;
  size_t count = 3 * (size_t)rows * (size_t)l.feet;
  int found = 0;
  ambulo_status status = ambulo__motion_read(path, &l.allocator, diagnostics, &motion);
  if (status) return status;
  l.force = ambulo__alloc(&l.allocator, count, sizeof(double));
  l.point = ambulo__alloc(&l.allocator, count, sizeof(double));
  l.torque = ambulo__alloc(&l.allocator, count, sizeof(double));
  if (!l.force || !l.point || !l.torque) status = AMBULO_E_MEMORY;
  for (int foot = 0; !status && foot < l.feet; foot++) {
    foot_columns columns;
    find_columns(motion, ambulo_model_foot(model, foot)->name, &columns);
    found |= fill(&l, motion, foot, &columns, ambulo_model_up(model), times);
  }
  if (!status) status = check(motion, path, times, rows, found, diagnostics);
  ambulo__motion_free(motion);
  if (status) {
    ambulo__ground_load_free(&l);
  } else {
    *load = l;
  }
  return status;
}

void ambulo__ground_load_free(ambulo__ground_load *load) {
  ambulo__free(&load->allocator, load->force);
  ambulo__free(&load->allocator, load->point);
  ambulo__free(&load->allocator, load->torque);
}

void ambulo__ground_load_place(ambulo__ground_load *load, const double *points) {
  for (int k = 0; !load->has_points && k < load->rows; k++) {
    for (int j = 0; j < 3 * load->feet; j++) {
      double place = points[3 * k + j % 3];
      load->point[(size_t)k * 3 * (size_t)load->feet + (size_t)j] = isfinite(place) ? place : 0.0;
    }
  }
}

/* ------------------------------------------------------------------ applying */

static void cross(const double a[3], const double b[3], double c[3]) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/* z . (m + (p - o) x f) or z . f of the joint of `link`; frames [links][12] */
static double share(const ambulo_model *model, const double *frames, int link, const double *force,
                    const double *point, const double *torque) {
  static const double world[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const ambulo_link *l = ambulo_model_link(model, link);
  const double *frame = l->parent < 0 ? world : frames + 12 * (size_t)l->parent;
  double arm[3], moment[3], sum = 0.0;
  for (int i = 0; i < 3; i++) arm[i] = point[i] - frame[4 * i + 3];
  cross(arm, force, moment);
  for (int i = 0; i < 3; i++) {
    double along = l->type == AMBULO_PRISMATIC ? force[i] : torque[i] + moment[i];
    sum += frame[4 * i + 2] * along;
  }
  return sum;
}

ambulo_status ambulo__ground_load_apply(const ambulo__ground_load *load, const ambulo_model *model,
                                        const double *q, double *tau) {
  ambulo__skeleton skeleton = {.model = NULL};
  size_t d = (size_t)ambulo_model_coordinate_count(model);
  ambulo_status status = ambulo__skeleton_create(model, &load->allocator, &skeleton);
  if (status) return status;
  for (int k = 0; k < load->rows; k++) {
    ambulo__skeleton_pose(&skeleton, q + (size_t)k * d);
    for (int foot = 0; foot < load->feet; foot++) {
      size_t at = 3 * ((size_t)k * (size_t)load->feet + (size_t)foot);
      int link = ambulo_model_point(model, ambulo_model_foot(model, foot)->heel[0])->link;
      for (; link >= 0; link = ambulo_model_link(model, link)->parent) {
        int i = ambulo_model_link(model, link)->coordinate;
        if (i < 0) continue;
        tau[(size_t)k * d + (size_t)i] -= share(model, skeleton.frames, link, load->force + at,
                                                load->point + at, load->torque + at);
      }
    }
  }
  ambulo__skeleton_free(&skeleton);
  return AMBULO_OK;
}

/* ------------------------------------------------------------------ residual */

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* wrench (M about the zero-moment point, F) of row k minus what the feet get */
static void row_residual(const ambulo__ground_load *load, int k, const double *wrench,
                         const double *zmp, double moment[3], double force[3], double given[3]) {
  double turn[3];
  cross(zmp, wrench + 3, turn);
  for (int i = 0; i < 3; i++) {
    moment[i] = wrench[i] - turn[i];
    force[i] = wrench[3 + i];
    given[i] = 0.0;
  }
  for (int foot = 0; foot < load->feet; foot++) {
    size_t at = 3 * ((size_t)k * (size_t)load->feet + (size_t)foot);
    double arm[3];
    for (int i = 0; i < 3; i++) arm[i] = load->point[at + (size_t)i] - zmp[i];
    cross(arm, load->force + at, turn);
    for (int i = 0; i < 3; i++) {
      moment[i] -= turn[i] + load->torque[at + (size_t)i];
      force[i] -= load->force[at + (size_t)i];
      given[i] += load->force[at + (size_t)i];
    }
  }
}

void ambulo__ground_load_residual(const ambulo__ground_load *load, const ambulo_model *model,
                                  const double *times, const double *wrench, const double *zmp,
                                  ambulo_ground_residual *residual) {
  const double *axes[3] = {ambulo_model_forward(model), ambulo_model_up(model),
                           ambulo_model_left(model)};
  const double *up = axes[1];
  double weight = -ambulo_model_mass(model) * dot(ambulo_model_gravity(model), up);
  double forces[3] = {0.0, 0.0, 0.0}, moments = 0.0;
  int supported = 0;
  ambulo_ground_residual r = {.vertical_impulse = 0.0};
  for (int k = 0; k < load->rows; k++) {
    const double *w = wrench + 6 * (size_t)k, *p = zmp + 3 * (size_t)k;
    static const double origin[3] = {0.0, 0.0, 0.0};
    int stands = isfinite(p[0]);
    double moment[3], force[3], given[3];
    row_residual(load, k, w, stands ? p : origin, moment, force, given);
    for (int i = 0; i < 3; i++) forces[i] += dot(force, axes[i]) * dot(force, axes[i]);
    if (stands) {
      double vertical = dot(moment, up);
      moments += dot(moment, moment) - vertical * vertical;
      supported++;
    }
    double before = k > 0 ? times[k] - times[k - 1] : 0.0;
    double after = k + 1 < load->rows ? times[k + 1] - times[k] : 0.0;
    r.vertical_impulse += 0.5 * (before + after) * dot(w + 3, up);
    r.given_vertical_impulse += 0.5 * (before + after) * dot(given, up);
  }
  for (int i = 0; i < 3; i++) r.force_rms[i] = sqrt(forces[i] / (double)load->rows) / weight;
  r.moment_rms =
      load->has_points && supported ? sqrt(moments / (double)supported) / weight : (double)NAN;
  *residual = r;
}
