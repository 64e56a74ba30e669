/* people/load_apply.c - forces on the feet against the dynamics of a motion (ground_load.h). */
#include <math.h>
#include <string.h>

#include "people/ground_load.h"
#include "base/arithmetic.h"
#include "mechanics/pose.h"
#include "model/model.h"

/* -------------------------------------------------------------------- poses */

static void find_foot(const ambulo__pose *pose, const ambulo_model *model, int foot,
                      double middle[3]) {
  const ambulo_point *ends[2] = {&model->points[model->feet[foot].heel_center],
                                 &model->points[model->feet[foot].toe_center]};
  for (int i = 0; i < 3; i++) middle[i] = 0.0;
  for (int end = 0; end < 2; end++) {
    double at[3];
    ambulo__pose_point(pose, ends[end]->link, ends[end]->position, at);
    for (int i = 0; i < 3; i++) middle[i] += 0.5 * at[i];
  }
}

ambulo_status ambulo__load_poses_fill(const ambulo_model *model, const double *q, int rows,
                                      const ambulo_allocator *allocator,
                                      ambulo__load_poses *poses) {
  ambulo__pose pose = {.model = NULL};
  ambulo_status status = ambulo__pose_create(model, allocator, &pose);
  if (status) return status;
  size_t d = (size_t)model->coordinate_count, feet = (size_t)model->foot_count;
  for (size_t k = 0; k < (size_t)rows; k++) {
    ambulo__pose_at(&pose, q + k * d);
    ambulo__pose_center_of_mass(&pose, poses->center + 3 * k);
    for (size_t foot = 0; foot < feet; foot++)
      find_foot(&pose, model, (int)foot, poses->foot + 3 * (k * feet + foot));
  }
  ambulo__pose_free(&pose);
  return AMBULO_OK;
}

/* ----------------------------------------------------------------- applying */

void ambulo__ground_load_place(ambulo__ground_load *load, const ambulo__load_poses *poses,
                               const double *points) {
  for (int k = 0; k < load->rows; k++) {
    for (int foot = 0; foot < load->feet; foot++) {
      size_t at = 3 * ((size_t)k * (size_t)load->feet + (size_t)foot);
      const double *point = points + 3 * (size_t)k;
      double moment[3];
      if (!load->is_loose[foot]) continue;
      if (!isfinite(point[0])) point = poses->foot + at;
      ambulo__cross(point, load->loose + at, moment);
      for (int i = 0; i < 3; i++) load->moment[at + (size_t)i] += moment[i];
    }
  }
}

/* (I.3): z . (m - o x f) or z . f */
double ambulo__load_share(const ambulo_model *model, const double *frames, int link,
                          const double *force, const double *moment) {
  static const double world[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const ambulo_link *l = &model->links[link];
  const double *frame = l->parent < 0 ? world : frames + 12 * (size_t)l->parent;
  double axis[3], origin[3], turn[3], about[3];
  for (int i = 0; i < 3; i++) {
    axis[i] = frame[4 * i + 2];
    origin[i] = frame[4 * i + 3];
  }
  if (l->type == AMBULO_PRISMATIC) return ambulo__dot(axis, force);
  ambulo__cross(origin, force, turn);
  for (int i = 0; i < 3; i++) about[i] = moment[i] - turn[i];
  return ambulo__dot(axis, about);
}

void ambulo__load_take(const ambulo_model *model, const double *frames, int link, const double *q,
                       const double force[3], const double moment[3], double *tau) {
  for (; link >= 0; link = model->links[link].parent) {
    double slope[AMBULO__COUPLING_SLOPES];
    int i = ambulo__moved_by(model, link);
    if (i < 0) continue;
    (void)ambulo__joint_value(model, link, q, slope);
    tau[i] -= slope[0] * ambulo__load_share(model, frames, link, force, moment);
  }
}

ambulo_status ambulo__ground_load_apply(const ambulo__ground_load *load, const ambulo_model *model,
                                        const double *q, double *tau) {
  ambulo__pose pose = {.model = NULL};
  size_t d = (size_t)model->coordinate_count;
  ambulo_status status = ambulo__pose_create(model, &load->allocator, &pose);
  if (status) return status;
  for (int k = 0; k < load->rows; k++) {
    ambulo__pose_at(&pose, q + (size_t)k * d);
    for (int foot = 0; foot < load->feet; foot++) {
      size_t at = 3 * ((size_t)k * (size_t)load->feet + (size_t)foot);
      int link = model->points[model->feet[foot].heel[0]].link;
      ambulo__load_take(model, pose.frames, link, q + (size_t)k * d, load->force + at,
                        load->moment + at, tau + (size_t)k * d);
    }
  }
  ambulo__pose_free(&pose);
  return AMBULO_OK;
}

/* ---------------------------------------------------------- pressure centres */

void ambulo__ground_load_pressure(const ambulo__ground_load *load, const ambulo_model *model,
                                  double height, double *cop, double *free_moment) {
  const double *n = model->up;
  for (size_t j = 0; j < (size_t)load->rows * (size_t)load->feet; j++) {
    const double *f = load->force + 3 * j, *m = load->moment + 3 * j;
    double normal = ambulo__dot(n, f), lever[3], turn[3], vertical[3];
    int pressed = normal > 0.0;
    ambulo__cross(n, m, lever);
    for (int i = 0; i < 3; i++)
      cop[3 * j + (size_t)i] = pressed ? (lever[i] + height * f[i]) / normal : (double)NAN;
    if (pressed) ambulo__cross(cop + 3 * j, f, turn);
    for (int i = 0; i < 3; i++) vertical[i] = pressed ? m[i] - turn[i] : 0.0;
    free_moment[j] = ambulo__dot(n, vertical);
  }
}

/* ----------------------------------------------------------------- residual */

/* root wrench (M about the origin, F) of row k minus what the feet get, about the origin */
static void row_residual(const ambulo__ground_load *load, int k, const double *wrench,
                         double force[3], double moment[3], double given[3]) {
  for (int i = 0; i < 3; i++) {
    moment[i] = wrench[i];
    force[i] = wrench[3 + i];
    given[i] = 0.0;
  }
  for (int foot = 0; foot < load->feet; foot++) {
    size_t at = 3 * ((size_t)k * (size_t)load->feet + (size_t)foot);
    for (size_t i = 0; i < 3; i++) {
      force[i] -= load->force[at + i];
      moment[i] -= load->moment[at + i];
      given[i] += load->force[at + i];
    }
  }
}

/* moment about a point instead of the origin */
static void move_to(const double point[3], const double force[3], const double moment[3],
                    double moved[3]) {
  double turn[3];
  ambulo__cross(point, force, turn);
  for (int i = 0; i < 3; i++) moved[i] = moment[i] - turn[i];
}

void ambulo__ground_load_residual(const ambulo__ground_load *load, const ambulo_model *model,
                                  const double *times, const double *wrench, const double *zmp,
                                  const double *center, double *rows_residual,
                                  ambulo_ground_residual *residual) {
  const double *axes[3] = {model->forward, model->up, model->left}, *up = model->up;
  double weight = -model->mass * ambulo__dot(model->gravity, up);
  double forces[3] = {0.0, 0.0, 0.0}, moments = 0.0;
  int supported = 0, loose = 0;
  ambulo_ground_residual r = {.vertical_impulse = 0.0};
  for (int foot = 0; foot < load->feet; foot++) loose |= load->is_loose[foot];
  for (int k = 0; k < load->rows; k++) {
    const double *w = wrench + 6 * (size_t)k, *p = zmp + 3 * (size_t)k;
    double *row = rows_residual + 6 * (size_t)k, force[3], moment[3], given[3], there[3];
    row_residual(load, k, w, force, moment, given);
    memcpy(row, force, sizeof force);
    move_to(center + 3 * (size_t)k, force, moment, row + 3);
    for (int i = 0; i < 3; i++)
      forces[i] += ambulo__dot(force, axes[i]) * ambulo__dot(force, axes[i]);
    if (isfinite(p[0])) {
      move_to(p, force, moment, there);
      moments += ambulo__dot(there, there) - ambulo__dot(there, up) * ambulo__dot(there, up);
      supported++;
    }
    double before = k > 0 ? times[k] - times[k - 1] : 0.0;
    double after = k + 1 < load->rows ? times[k + 1] - times[k] : 0.0;
    r.vertical_impulse += 0.5 * (before + after) * ambulo__dot(w + 3, up);
    r.given_vertical_impulse += 0.5 * (before + after) * ambulo__dot(given, up);
  }
  for (int i = 0; i < 3; i++) r.force_rms[i] = sqrt(forces[i] / (double)load->rows) / weight;
  r.moment_rms = !loose && supported ? sqrt(moments / (double)supported) / weight : (double)NAN;
  *residual = r;
}
