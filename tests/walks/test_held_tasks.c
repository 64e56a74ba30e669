/* The shipped tasks of hands, from zero: a box lifted from the floor to a table, a wall that is
 * pushed with a given force, a wall that bears who leans on it. All solve, hold between their nodes
 * and do what their comments say; energy and forces are those of mechanics. Looked at on 2001
 * times. */
#include "ambulo/tools/tools.h"
#include "base/arithmetic.h"
#include "support/test.h"

enum { TIMES = 2001, AXES = 3, PATCHES = 3 };
static const double gravity = 9.81;

typedef struct task {
  ambulo_problem *problem;
  ambulo_result *result;
  const ambulo_model *model;
  int coordinates, points;
  double duration, *t, *q, *qd, *tau, *wrench, *point, *grf, *force, *moment, *power, *patch;
} task;

static double *room(int width) {
  double *array = calloc((size_t)TIMES * (size_t)width, sizeof *array);
  assert_non_null(array);
  return array;
}

static void open_task(task *k, const char *name) {
  char path[64];
  (void)snprintf(path, sizeof path, "models/%s.yaml", name);
  assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &k->problem), AMBULO_OK);
  ambulo_options options = ambulo_problem_options(k->problem);
  assert_int_equal(ambulo_solve(k->problem, &options, NULL, NULL, NULL, &k->result), AMBULO_OK);
  ambulo_verdict verdict = ambulo_result_verdict(k->result);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(k->result);
  if (verdict != AMBULO_OPTIMAL || dense->failing != 0)
    print_error("%s: %s; %s\n", name, ambulo_verdict_name(verdict), dense->summary);
  assert_true(verdict == AMBULO_OPTIMAL && dense->failing == 0);
  k->model = ambulo_problem_model(k->problem);
  k->coordinates = ambulo_model_coordinate_count(k->model);
  k->points = ambulo_model_point_count(k->model);
  k->duration = ambulo_problem_duration(k->problem);
  k->t = room(1);
  k->q = room(k->coordinates);
  k->qd = room(k->coordinates);
  k->tau = room(k->coordinates);
  k->wrench = room(6);
  k->point = room(AXES * k->points);
  k->grf = room(2 * AXES);
  assert_int_equal(ambulo_model_patch_count(k->model), PATCHES);
  k->patch = room(PATCHES * AXES);
  k->force = room(2 * AXES);
  k->moment = room(2 * AXES);
  k->power = room(1);
  for (int i = 0; i < TIMES; i++) k->t[i] = k->duration * i / (TIMES - 1);
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(k->problem, NULL, &workspace), AMBULO_OK);
  const ambulo_motion motion = {.size = sizeof(ambulo_motion),
                                .q = k->q,
                                .qd = k->qd,
                                .tau = k->tau,
                                .wrench = k->wrench,
                                .points = k->point,
                                .grf = k->grf,
                                .patch_force = k->patch,
                                .hold_force = k->force,
                                .hold_moment = k->moment,
                                .hold_power = k->power};
  assert_int_equal(ambulo_problem_motion(k->problem, workspace, ambulo_result_x(k->result), TIMES,
                                         k->t, &motion),
                   AMBULO_OK);
  ambulo_workspace_free(workspace);
}

static void close_task(task *k) {
  double *const arrays[] = {k->t,   k->q,     k->qd,     k->tau,   k->wrench, k->point,
                            k->grf, k->force, k->moment, k->power, k->patch};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
  ambulo_result_free(k->result);
  ambulo_problem_free(k->problem);
}

static double value(const task *k, const double *array, int i, const char *coordinate) {
  int c = ambulo_model_find_coordinate(k->model, coordinate);
  assert_true(c >= 0);
  return array[i * k->coordinates + c];
}

static const double *place(const task *k, int i, const char *point) {
  int p = ambulo_model_find_point(k->model, point);
  assert_true(p >= 0);
  return k->point + AXES * (i * k->points + p);
}

static int at_time(const task *k, double time) {
  return (int)(time / k->duration * (TIMES - 1) + 0.5);
}

/* the feet carry the root wrench's force, and over the motion the impulse of the weight of the body
 * and of what the hands ask for: it begins and ends at rest */
static void check_momentum(const task *k) {
  double impulse[AXES] = {0}, hands[AXES] = {0}, step = k->duration / (TIMES - 1);
  for (int i = 0; i < TIMES; i++) {
    double share = i == 0 || i == TIMES - 1 ? 0.5 * step : step;
    for (int axis = 0; axis < AXES; axis++) {
      const double *grf = k->grf + 2 * AXES * i, *force = k->force + 2 * AXES * i;
      assert_close(grf[axis] + grf[AXES + axis], k->wrench[6 * i + 3 + axis], 1e-9);
      impulse[axis] += share * (grf[axis] + grf[AXES + axis]);
      hands[axis] += share * (force[axis] + force[AXES + axis]);
    }
  }
  impulse[1] -= gravity * ambulo_model_mass(k->model) * k->duration;
  for (int axis = 0; axis < AXES; axis++) assert_close(impulse[axis], hands[axis], 0.02);
}

/* -------------------------------------------------------------------------- lift */

static const double taken = 0.9, set_down = 2.8, ramp = 0.2, mass = 10.0;

/* kinetic and potential energy of the box, whose attitude is kept: 0 where it stands at first */
static double box_energy(const task *k, int i) {
  double v[AXES], step = k->duration / (TIMES - 1);
  double height = 0.5 * (place(k, i, "hand_r")[1] + place(k, i, "hand_l")[1]);
  for (int axis = 0; axis < AXES; axis++) {
    double ahead = place(k, i + 1, "hand_r")[axis] + place(k, i + 1, "hand_l")[axis];
    double behind = place(k, i - 1, "hand_r")[axis] + place(k, i - 1, "hand_l")[axis];
    v[axis] = 0.5 * (ahead - behind) / (2 * step);
  }
  return mass * (0.5 * ambulo__dot(v, v) + gravity * height);
}

/* while the hands have it all, what their forces did since then is what the box has won */
static void check_energy(const task *k) {
  int from = at_time(k, taken + ramp), to = at_time(k, set_down - ramp);
  double work = 0, step = k->duration / (TIMES - 1), first = box_energy(k, from);
  for (int i = from + 1; i <= to; i++) {
    work += 0.5 * step * (k->power[i - 1] + k->power[i]);
    assert_close(work, box_energy(k, i) - first, 0.02);
  }
  assert_close(work, mass * gravity * 0.72, 0.02); /* from the floor to the table */
}

/* the grip begins and ends; handles stay where they are while floor and table hand it over */
static void check_grip(const task *k) {
  for (int i = 0; i < TIMES; i++) {
    const double *f = k->force + 2 * AXES * i, *r = place(k, i, "hand_r");
    const double *l = place(k, i, "hand_l");
    double size = fabs(f[0]) + fabs(f[1]) + fabs(f[2]) + fabs(f[3]) + fabs(f[4]) + fabs(f[5]);
    if (k->t[i] <= taken || k->t[i] >= set_down) {
      assert_close(size, 0, 0);
      continue;
    }
    assert_true(fabs(r[0] - l[0]) < 0.003 && fabs(r[1] - l[1]) < 0.003);
    assert_close(r[2] - l[2], 0.34, 0.003);
    if (k->t[i] <= taken + ramp) assert_close(r[1], 0.23, 0.003);
    if (k->t[i] >= set_down - ramp) assert_close(r[1], 0.95, 0.003);
  }
}

/* hips, knees and ankles bend, and none to the end of its range; no joint is weaker than its torque
 */
static void check_limits(const task *k) {
  static const char *const bent[] = {"hip_flexion_l", "knee_angle_l", "ankle_angle_l"};
  for (int i = 0; i < TIMES; i++) {
    for (int b = 0; b < 3; b++) {
      const ambulo_coordinate *c =
          ambulo_model_coordinate(k->model, ambulo_model_find_coordinate(k->model, bent[b]));
      assert_true(value(k, k->q, i, bent[b]) < c->range[1] - 0.08);
    }
    for (int j = 0; j < k->coordinates; j++) {
      const ambulo_coordinate *c = ambulo_model_coordinate(k->model, j);
      double tau = k->tau[i * k->coordinates + j];
      if (c->actuated) assert_true(tau >= 1.01 * c->torque[0] && tau <= 1.01 * c->torque[1]);
    }
  }
}

/* Two hands alike; the back's moment is that of people who lift 10 kg from the floor: about L5/S1
 * 150 to 220 N m. */
static void a_box_from_the_floor_to_a_table(void **state) {
  (void)state;
  ONLY_IN_CHECK_LONG();
  task k;
  open_task(&k, "lift");
  check_momentum(&k);
  check_energy(&k);
  check_grip(&k);
  check_limits(&k);
  double lumbar = 0, apart = 0, hand = 0;
  for (int i = 0; i < TIMES; i++) {
    const double *f = k.force + 2 * AXES * i;
    lumbar = fmax(lumbar, value(&k, k.tau, i, "lumbar_extension"));
    apart = fmax(apart, fabs(f[1] - f[AXES + 1]));
    hand = fmax(hand, f[1]);
  }
  assert_true(lumbar > 150 && lumbar < 220);
  assert_true(apart < 5);
  assert_true(hand > 0.5 * mass * gravity && hand < 100);
  assert_close(ambulo_model_mass(k.model), 75, 1e-9); /* the box is no part of the body */
  close_task(&k);
}

/* --------------------------------------------------------------------------- wall */

static void a_wall_is_pushed(void **state) {
  (void)state;
  task k;
  open_task(&k, "push_wall");
  check_momentum(&k);
  int middle = at_time(&k, 1.3);
  double lean[2];
  for (int i = 0; i < TIMES; i++) {
    const double *f = k.force + 2 * AXES * i, *g = k.grf + 2 * AXES * i;
    int whole = k.t[i] >= 0.95 && k.t[i] <= 1.65, none = k.t[i] <= 0.7 || k.t[i] >= 1.9;
    if (whole) assert_close(f[0] + f[AXES], 250, 1e-9);
    if (none) assert_close(f[0] + f[AXES], 0, 0);
    for (int hand = 0; hand < 2; hand++) {
      const double *at = place(&k, i, hand ? "hand_l" : "hand_r");
      assert_close(f[AXES * hand], 0.5 * (f[0] + f[AXES]), 1e-9); /* half each */
      if (none) continue;
      assert_close(at[0], 0.8, 0.005);
      assert_close(at[1], 1.35, 0.005);
    }
    for (int foot = 0; foot < 2; foot++) /* 0.35 forward and across */
      assert_true(fabs(g[AXES * foot]) <= 0.42 * g[AXES * foot + 1]);
  }
  /* who leans: the shoulders are further ahead of the hips than at the start */
  for (int n = 0; n < 2; n++) {
    int i = n ? middle : 0;
    lean[n] = place(&k, i, "shoulder_r")[0] - place(&k, i, "hip_r")[0];
  }
  assert_true(lean[1] > lean[0] + 0.08);
  /* from rest to rest, the ground's impulse is the wall's */
  double forward = 0.0, wall = 0.0;
  for (int i = 0; i < TIMES; i++) {
    const double *f = k.force + 2 * AXES * i, *g = k.grf + 2 * AXES * i;
    forward += g[0] + g[AXES];
    wall += f[0] + f[AXES];
  }
  assert_true(wall / TIMES > 80.0 && fabs(forward - wall) < 0.01 * wall);
  /* and a foot is about to slip, along and across together */
  double slip = 0.0;
  for (int foot = 0; foot < 2; foot++) {
    const double *g = k.grf + 2 * AXES * middle + AXES * foot;
    slip = fmax(slip, hypot(g[0], g[2]) / g[1]);
  }
  assert_true(slip > 0.345 && slip < 0.3505);
  close_task(&k);
}

/* ------------------------------------------------------------------------ push-up */

/* Nobody says how hard hands push: what balances the body about the middle of the feet, 0.09 m
 * ahead of the heels, where their pressure stays. Of the moment about it hands have what they push
 * times 1.3 m, and what rubs along the wall times 0.86 m. */
static void a_wall_bears_who_leans_on_it(void **state) {
  (void)state;
  task k;
  open_task(&k, "push_up_wall");
  double weight = gravity * ambulo_model_mass(k.model), push[2], least = INFINITY;
  for (int i = 0; i < TIMES; i++) {
    const double *right = k.patch + AXES * (PATCHES * i + 1), *left = right + AXES;
    const double *g = k.grf + 2 * AXES * i;
    assert_close(right[0], left[0], 0.5);
    least = fmin(least, -right[0]);
    for (int hand = 0; hand < 2; hand++) { /* 0.5 along the wall, up and across each */
      const double *f = hand ? left : right;
      assert_true(fabs(f[1]) <= -0.5 * f[0] && fabs(f[2]) <= -0.5 * f[0]);
      const double *at = place(&k, i, hand ? "hand_l" : "hand_r");
      assert_close(at[0], 0.95, 0.003);
      assert_close(at[1], 1.3, 0.003);
    }
    for (int axis = 0; axis < AXES; axis++) /* hands and feet have all of it */
      assert_close(right[axis] + left[axis] + g[axis] + g[AXES + axis], k.wrench[6 * i + 3 + axis],
                   1e-9);
  }
  assert_true(least > 20);
  for (int n = 0; n < 2; n++) {
    int i = n ? (TIMES - 1) / 2 : 0;
    const double *f = k.patch + AXES * (PATCHES * i + 1);
    const double *w = k.wrench + 6 * i; /* moment about the origin */
    push[n] = -f[0] - f[AXES];
    double along = f[1] + f[AXES + 1];
    assert_close(w[2] - 0.09 * w[4], 1.3 * push[n] + 0.86 * along, 0.03 * 1.3 * push[n]);
    assert_close(w[4], weight, 0.05 * weight);
  }
  assert_true(push[1] > 1.5 * push[0]); /* deep in the push-up it bears more */
  assert_true(value(&k, k.q, (TIMES - 1) / 2, "elbow_flex_l") > 1.3);
  close_task(&k);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_box_from_the_floor_to_a_table),
                                     cmocka_unit_test(a_wall_is_pushed),
                                     cmocka_unit_test(a_wall_bears_who_leans_on_it)};
  return cmocka_run_group_tests_name("walks/held_tasks", tests, NULL, NULL);
}
