/* Feet that roll: the ground does next to no work on the shipped walks.
 *
 * Two ways that share nothing but the motion: what the joints give,
 *
 *     W_joints = sum over the joints of int tau qd dt,   W_ground = m g . (path) - W_joints
 *
 * as the body's energy is the same after a step but for the height it has gained; and what the feet
 * take, from their points and the ground's forces alone,
 *
 *     W_ground = sum over the feet of int F . (v + omega x (c - h)) + M n . omega dt
 *
 * with h the heel's centre and v its velocity, c the centre of pressure, M the free moment, omega
 * from the foot's own three axes x_i: omega = sum x_i x (dx_i / dt) / 2. Velocities are central
 * differences of positions. */
#include "support/test.h"

#include "ambulo/ambulo.h"

enum { SAMPLES = 4001, FEET = 2, FOOT_POINTS = 4 };

typedef struct walk {
  ambulo_problem *problem;
  const ambulo_model *model;
  double times[SAMPLES];
  double *q, *qd, *tau, *points, *grf, *cop, *moment;
} walk;

static double *room(int columns) {
  double *values = calloc((size_t)SAMPLES * (size_t)columns, sizeof *values);
  assert_non_null(values);
  return values;
}

static void open_walk(walk *w, const char *path) {
  ambulo_workspace *workspace = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &w->problem), AMBULO_OK);
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
  ambulo_motion motion = {.q = w->q,
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

static void close_walk(walk *w) {
  double *const arrays[] = {w->q, w->qd, w->tau, w->points, w->grf, w->cop, w->moment};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
  ambulo_problem_free(w->problem);
}

/* trapezoidal */
static double part_of_interval(const walk *w, int k) {
  double step = w->times[1] - w->times[0];
  return k == 0 || k == SAMPLES - 1 ? 0.5 * step : step;
}

/* *positive: of the joints that give */
static double joint_work(const walk *w, double *positive) {
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

static double lifted(const walk *w) {
  const double *g = ambulo_model_gravity(w->model);
  double work = 0.0;
  static const char *const root[3] = {"pelvis_tx", "pelvis_ty", "pelvis_tz"};
  int d = ambulo_model_coordinate_count(w->model);
  for (int i = 0; i < 3; i++) {
    int c = ambulo_model_find_coordinate(w->model, root[i]);
    assert_true(c >= 0);
    /* sideways a mirrored step ends where its image begins, across gravity */
    if (i < 2) work -= g[i] * (w->q[(SAMPLES - 1) * d + c] - w->q[c]);
  }
  return ambulo_model_mass(w->model) * work;
}

/* --------------------------------------------------------------- at the feet */

static void cross(const double a[3], const double b[3], double c[3]) {
  for (int i = 0; i < 3; i++)
    c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit(double a[3]) {
  double length = sqrt(dot(a, a));
  for (int i = 0; i < 3; i++) a[i] /= length;
}

/* heel's centre, and the foot's axes from heel to ball, to the side, and across both */
static void pose(const walk *w, const int point[FOOT_POINTS], int k, double heel[3],
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

/* how much power the ground gives to a foot at sample k */
static double power(const walk *w, const int point[FOOT_POINTS], int foot, int k) {
  const double *force = w->grf + 3 * (FEET * k + foot), *c = w->cop + 3 * (FEET * k + foot);
  double heel[3][3], axes[3][3][3], omega[3] = {0.0, 0.0, 0.0}, arm[3], turn[3], sum = 0.0;
  if (!isfinite(c[0])) return 0.0;
  int around[3] = {k, k > 0 ? k - 1 : k, k < SAMPLES - 1 ? k + 1 : k};
  for (int i = 0; i < 3; i++) pose(w, point, around[i], heel[i], axes[i]);
  double span = w->times[around[2]] - w->times[around[1]];
  for (int a = 0; a < 3; a++) {
    double rate[3], part[3];
    for (int i = 0; i < 3; i++) rate[i] = (axes[2][a][i] - axes[1][a][i]) / span;
    cross(axes[0][a], rate, part);
    for (int i = 0; i < 3; i++) omega[i] += 0.5 * part[i];
  }
  for (int i = 0; i < 3; i++) arm[i] = c[i] - heel[0][i];
  cross(omega, arm, turn);
  for (int i = 0; i < 3; i++) sum += force[i] * ((heel[2][i] - heel[1][i]) / span + turn[i]);
  return sum + w->moment[FEET * k + foot] * dot(ambulo_model_up(w->model), omega);
}

static double work_at_the_feet(const walk *w) {
  static const char *const parts[FOOT_POINTS] = {"heel", "ball", "heel_lateral", "heel_medial"};
  double work = 0.0;
  for (int foot = 0; foot < FEET; foot++) {
    char side = ambulo_model_foot(w->model, foot)->name[0], name[40];
    int point[FOOT_POINTS];
    for (int i = 0; i < FOOT_POINTS; i++) {
      (void)snprintf(name, sizeof name, "%s_%c", parts[i], side);
      point[i] = ambulo_model_find_point(w->model, name);
      assert_true(point[i] >= 0);
    }
    for (int k = 0; k < SAMPLES; k++) work += power(w, point, foot, k) * part_of_interval(w, k);
  }
  return work;
}

/* ------------------------------------------------------------------- the walks */

static void the_ground_does_next_to_no_work(void **state) {
  (void)state;
  static const char *const walks[] = {"models/walk_normal.yaml",     "models/walk_normal_21.yaml",
                                      "models/walk_slow.yaml",       "models/walk_fast.yaml",
                                      "models/walk_loaded.yaml",     "models/walk_uphill.yaml",
                                      "models/walk_asymmetric.yaml", "models/walk_tracking.yaml"};
  for (size_t i = 0; i < sizeof walks / sizeof *walks; i++) {
    walk w;
    double positive;
    open_walk(&w, walks[i]);
    double net = joint_work(&w, &positive), ground = lifted(&w) - net, feet = work_at_the_feet(&w);
    if (!(fabs(ground) <= 0.01 * positive && fabs(feet - ground) <= 0.002 * positive))
      print_error("%s: the ground does %.3f J, at the feet %.3f J; joints %.2f J\n", walks[i],
                  ground, feet, positive);
    assert_true(positive > 20.0);
    assert_true(fabs(ground) <= 0.01 * positive);
    assert_true(fabs(feet - ground) <= 0.002 * positive);
    close_walk(&w);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_ground_does_next_to_no_work)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
