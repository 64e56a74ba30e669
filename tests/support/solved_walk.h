/* tests/support/solved_walk.h - a walk that is solved, at times far between the nodes, and the
 * power of the ground on its feet. */
#ifndef AMBULO_TESTS_SOLVED_WALK_H
#define AMBULO_TESTS_SOLVED_WALK_H

#include "support/test.h"

#include "ambulo/tools/tools.h"

enum { SAMPLES = 4001, FEET = 2, FOOT_POINTS = 4 };

typedef struct walk {
  ambulo_problem *problem;
  const ambulo_model *model;
  double times[SAMPLES];
  double *q, *qd, *tau, *points, *grf, *cop, *moment;
} walk;

static inline double *room(int columns) {
  double *values = calloc((size_t)SAMPLES * (size_t)columns, sizeof *values);
  assert_non_null(values);
  return values;
}

static inline void open_walk(walk *w, const char *path, const char *const *settings, int count) {
  ambulo_workspace *workspace = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_problem_load(path, settings, count, NULL, NULL, &w->problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(w->problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  w->model = ambulo_problem_model(w->problem);
  int d = ambulo_model_coordinate_count(w->model);
  for (int k = 0; k < SAMPLES; k++)
    w->times[k] = ambulo_problem_duration(w->problem) * k / (SAMPLES - 1);
  w->q = room(d);
  w->qd = room(d);
  w->tau = room(d);
  w->points = room(3 * ambulo_model_point_count(w->model));
  w->grf = room(3 * FEET);
  w->cop = room(3 * FEET);
  w->moment = room(FEET);
  ambulo_motion motion = {.size = sizeof(ambulo_motion),
                          .q = w->q,
                          .qd = w->qd,
                          .tau = w->tau,
                          .points = w->points,
                          .grf = w->grf,
                          .cop = w->cop,
                          .free_moment = w->moment};
  assert_int_equal(ambulo_workspace_create(w->problem, NULL, &workspace), AMBULO_OK);
  assert_int_equal(ambulo_problem_motion(w->problem, workspace, ambulo_result_x(result), SAMPLES,
                                         w->times, &motion),
                   AMBULO_OK);
  ambulo_workspace_free(workspace);
  ambulo_result_free(result);
}

static inline void close_walk(walk *w) {
  double *const arrays[] = {w->q, w->qd, w->tau, w->points, w->grf, w->cop, w->moment};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
  ambulo_problem_free(w->problem);
}

/* trapezoidal */
static inline double part_of_interval(const walk *w, int k) {
  double step = w->times[1] - w->times[0];
  return k == 0 || k == SAMPLES - 1 ? 0.5 * step : step;
}

/* *positive: of the joints that give */
static inline double joint_work(const walk *w, double *positive) {
  int d = ambulo_model_coordinate_count(w->model);
  double net = 0.0;
  *positive = 0.0;
  for (int j = 0; j < d; j++) {
    if (!ambulo_model_coordinate(w->model, j)->actuated) continue;
    for (int k = 0; k < SAMPLES; k++) {
      double work = w->tau[k * d + j] * w->qd[k * d + j] * part_of_interval(w, k);
      net += work;
      *positive += fmax(work, 0.0);
    }
  }
  return net;
}

static inline void cross(const double a[3], const double b[3], double c[3]) {
  for (int i = 0; i < 3; i++)
    c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static inline double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void unit(double a[3]) {
  double length = sqrt(dot(a, a));
  for (int i = 0; i < 3; i++) a[i] /= length;
}

/* heel's centre, and the foot's axes from heel to ball, to the side, and across both */
static inline void pose(const walk *w, const int point[FOOT_POINTS], int k, double heel[3],
                        double axes[3][3]) {
  const double *all = w->points + (size_t)(3 * k) * (size_t)ambulo_model_point_count(w->model);
  for (int i = 0; i < 3; i++) {
    heel[i] = all[3 * point[0] + i];
    axes[0][i] = all[3 * point[1] + i] - heel[i];
    axes[1][i] = all[3 * point[3] + i] - all[3 * point[2] + i];
  }
  unit(axes[0]);
  unit(axes[1]);
  cross(axes[0], axes[1], axes[2]);
}

/* the foot's turning, and the velocity of its point at the centre of pressure, at sample k; 0: the
 * ground gives it no force there */
static inline int motion_at_contact(const walk *w, const int point[FOOT_POINTS], int foot, int k,
                                    double omega[3], double velocity[3]) {
  const double *c = w->cop + 3 * (FEET * k + foot);
  double heel[3][3], axes[3][3][3], arm[3], turn[3];
  if (!isfinite(c[0])) return 0;
  int around[3] = {k, k > 0 ? k - 1 : k, k < SAMPLES - 1 ? k + 1 : k};
  for (int i = 0; i < 3; i++) pose(w, point, around[i], heel[i], axes[i]);
  double span = w->times[around[2]] - w->times[around[1]];
  for (int i = 0; i < 3; i++) omega[i] = 0.0;
  for (int a = 0; a < 3; a++) {
    double rate[3], part[3];
    for (int i = 0; i < 3; i++) rate[i] = (axes[2][a][i] - axes[1][a][i]) / span;
    cross(axes[0][a], rate, part);
    for (int i = 0; i < 3; i++) omega[i] += 0.5 * part[i];
  }
  for (int i = 0; i < 3; i++) arm[i] = c[i] - heel[0][i];
  cross(omega, arm, turn);
  for (int i = 0; i < 3; i++) velocity[i] = (heel[2][i] - heel[1][i]) / span + turn[i];
  return 1;
}

/* how much power the ground gives to a foot at sample k */
static inline double power(const walk *w, const int point[FOOT_POINTS], int foot, int k) {
  double omega[3], velocity[3];
  if (!motion_at_contact(w, point, foot, k, omega, velocity)) return 0.0;
  return dot(w->grf + 3 * (FEET * k + foot), velocity) +
         w->moment[FEET * k + foot] * dot(ambulo_model_up(w->model), omega);
}

static inline void points_of(const walk *w, int foot, int point[FOOT_POINTS]) {
  static const char *const parts[FOOT_POINTS] = {"heel", "ball", "heel_lateral", "heel_medial"};
  char side = ambulo_model_foot(w->model, foot)->name[0], name[40];
  for (int i = 0; i < FOOT_POINTS; i++) {
    (void)snprintf(name, sizeof name, "%s_%c", parts[i], side);
    point[i] = ambulo_model_find_point(w->model, name);
    assert_true(point[i] >= 0);
  }
}

#endif
