/* The shipped motions that are no walks, from zero: all solve and hold between their nodes, and
 * each does what its comments say. Looked at on a grid ten times as fine as the nodes. */
#include "support/contact_index.h"
#include "support/scratch.h"
#include "support/shared_data.h"

#include "ambulo/tools/tools.h"

enum { FINER = 10, AXES = 3 };

typedef struct task {
  ambulo_problem *problem;
  ambulo_result *result;
  const ambulo_model *model;
  int count, coordinates, points;
  double *t, *q, *qd, *point, *grf, *zmp;
} task;

static void solve(task *k, const char *name) {
  char path[SCRATCH_PATH];
  snprintf(path, sizeof path, "%s/models/%s.yaml", AMBULO_SOURCE_DIR, name);
  assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &k->problem), AMBULO_OK);
  ambulo_options options = ambulo_problem_options(k->problem);
  assert_int_equal(ambulo_solve(k->problem, &options, NULL, NULL, NULL, &k->result), AMBULO_OK);
  ambulo_verdict verdict = ambulo_result_verdict(k->result);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(k->result);
  double violation = ambulo_result_audit(k->result)->violation.worst;
  if (verdict != AMBULO_OPTIMAL || dense->failing != 0)
    print_error("%s: %s, violation %g; %s\n", name, ambulo_verdict_name(verdict), violation,
                dense->summary);
  assert_true(verdict == AMBULO_OPTIMAL && dense->failing == 0);
  assert_true(violation <= options.feasibility_tolerance);
}

static void *room(const task *k, int width) {
  void *array = calloc((size_t)k->count * (size_t)width, sizeof(double));
  assert_non_null(array);
  return array;
}

static void open_task(task *k, const char *name) {
  *k = (task){.count = 0};
  solve(k, name);
  k->model = ambulo_problem_model(k->problem);
  k->coordinates = ambulo_model_coordinate_count(k->model);
  k->points = ambulo_model_point_count(k->model);
  int intervals = ambulo_problem_node_count(k->problem) - 1;
  k->count = FINER * intervals + 1;
  k->t = room(k, 1);
  k->q = room(k, k->coordinates);
  k->qd = room(k, k->coordinates);
  k->point = room(k, AXES * k->points);
  k->grf = room(k, 2 * AXES);
  k->zmp = room(k, AXES);
  for (int i = 0; i < k->count; i++) {
    int node = i / FINER < intervals ? i / FINER : intervals - 1;
    double from = ambulo_problem_node_time(k->problem, node);
    double step = ambulo_problem_node_time(k->problem, node + 1) - from;
    k->t[i] = from + step * (i - FINER * node) / FINER;
  }
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(k->problem, NULL, &workspace), AMBULO_OK);
  ambulo_motion motion = {.size = sizeof(ambulo_motion),
                          .q = k->q,
                          .qd = k->qd,
                          .points = k->point,
                          .grf = k->grf,
                          .zmp = k->zmp};
  assert_int_equal(ambulo_problem_motion(k->problem, workspace, ambulo_result_x(k->result),
                                         k->count, k->t, &motion),
                   AMBULO_OK);
  ambulo_workspace_free(workspace);
}

static void close_task(task *k) {
  free(k->t);
  free(k->q);
  free(k->qd);
  free(k->point);
  free(k->grf);
  free(k->zmp);
  ambulo_result_free(k->result);
  ambulo_problem_free(k->problem);
}

static double value(const task *k, const double *array, int i, const char *coordinate) {
  int c = ambulo_model_find_coordinate(k->model, coordinate);
  assert_true(c >= 0);
  return array[i * k->coordinates + c];
}

static double degrees(const task *k, int i, const char *coordinate) {
  return 57.295779513082321 * value(k, k->q, i, coordinate);
}

static const double *place(const task *k, int i, int point) {
  return k->point + AXES * (i * k->points + point);
}

/* of the vertical force, that the foot of this name carries */
static double share(const task *k, int i, const char *name) {
  int foot = strcmp(ambulo_model_foot(k->model, 0)->name, name) == 0 ? 0 : 1;
  const double *f = k->grf + 2 * AXES * i;
  return f[AXES * foot + 1] / (f[1] + f[AXES + 1]);
}

/* of the line from the lumbar joint to the vertex against the vertical, forward, degrees */
static double lean(const task *k, int i) {
  const double *low = place(k, i, ambulo_model_find_point(k->model, "lumbar"));
  const double *high = place(k, i, ambulo_model_find_point(k->model, "head_top"));
  return 57.295779513082321 * atan2(high[0] - low[0], high[1] - low[1]);
}

static double weight(const task *k) {
  return 9.81 * ambulo_model_mass(k->model);
}

/* ----------------------------------------------------------------- on one place */

static void two_feet_carry_half_each(void **state) {
  (void)state;
  task k;
  open_task(&k, "stand_quietly");
  for (int i = 0; i < k.count; i++) {
    assert_close(share(&k, i, "left"), 0.5, 1e-9);
    assert_close(k.grf[6 * i + 1] + k.grf[6 * i + 4], weight(&k), 0.02);
  }
  close_task(&k);
}

static void a_squat_goes_down_and_up_on_both_legs(void **state) {
  (void)state;
  task k;
  open_task(&k, "squat");
  int bottom = (k.count - 1) / 2;
  for (int i = 0; i < k.count; i++) {
    assert_close(share(&k, i, "left"), 0.5, 1e-5); /* as symmetric as a solve is exact */
    assert_close(degrees(&k, i, "knee_angle_l"), degrees(&k, i, "knee_angle_r"), 1e-3);
  }
  assert_true(value(&k, k.q, bottom, "pelvis_ty") < -0.315);
  assert_true(degrees(&k, bottom, "knee_angle_l") > 97.0);
  assert_true(degrees(&k, bottom, "knee_angle_l") < 100.0);
  assert_true(lean(&k, bottom) > 43.0 && lean(&k, bottom) < 57.0);
  assert_close(lean(&k, 0), 0.0, 1e-3);
  assert_close(degrees(&k, 0, "knee_angle_l"), 5.0, 1e-4);
  assert_close(degrees(&k, k.count - 1, "knee_angle_l"), 5.0, 1e-4);
  close_task(&k);
}

/* with arms that go ahead of the body and a trunk that leans over the feet */
static void a_whole_body_squats_with_its_arms_ahead(void **state) {
  (void)state;
  task k;
  open_task(&k, "squat_whole_body");
  int bottom = (k.count - 1) / 2;
  for (int i = 0; i < k.count; i++) {
    assert_close(share(&k, i, "left"), 0.5, 0.01);
    assert_close(degrees(&k, i, "knee_angle_l"), degrees(&k, i, "knee_angle_r"), 0.5);
    assert_close(degrees(&k, i, "arm_flex_l"), degrees(&k, i, "arm_flex_r"), 1.0);
  }
  assert_true(value(&k, k.q, bottom, "pelvis_ty") < -0.315);
  assert_true(degrees(&k, bottom, "knee_angle_l") > 97.0);
  assert_true(degrees(&k, bottom, "knee_angle_l") < 100.0);
  assert_true(lean(&k, bottom) > 35.0 && lean(&k, bottom) < 55.0);
  assert_true(degrees(&k, bottom, "arm_flex_l") > 80.0);
  assert_close(lean(&k, 0), 0.0, 1e-3);
  close_task(&k);
}

/* Sits on the seat and the feet, leans forward with back and pelvis as it leaves the seat, stands
 * on both feet in the end. */
static void a_body_rises_from_its_seat(void **state) {
  (void)state;
  char path[SCRATCH_PATH];
  snprintf(path, sizeof path, "%s/models/sit_to_stand.yaml", AMBULO_SOURCE_DIR);
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &problem), AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  assert_int_equal(ambulo_result_dense_audit(result)->failing, 0);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  const ambulo_model *model = ambulo_problem_model(problem);
  enum { TIMES = 81, MOST = 32, PATCHES = 3 }; /* the seat is the first */
  double times[TIMES], q[TIMES * MOST], tau[TIMES * MOST], seat[TIMES * PATCHES * AXES];
  double grf[TIMES * 2 * AXES], knee_moment = 0.0, hip_moment = 0.0;
  int n = ambulo_model_coordinate_count(model), tilt, knee, back, hip;
  assert_int_equal(ambulo_model_patch_count(model), PATCHES);
  for (int i = 0; i < TIMES; i++) times[i] = 1.75 * i / (TIMES - 1);
  ambulo_motion motion = {
      .size = sizeof(ambulo_motion), .q = q, .tau = tau, .grf = grf, .patch_force = seat};
  assert_int_equal(
      ambulo_problem_motion(problem, workspace, ambulo_result_x(result), TIMES, times, &motion),
      AMBULO_OK);
  tilt = ambulo_model_find_coordinate(model, "pelvis_tilt");
  knee = ambulo_model_find_coordinate(model, "knee_angle_l");
  back = ambulo_model_find_coordinate(model, "lumbar_extension");
  hip = ambulo_model_find_coordinate(model, "hip_flexion_l");
  double weighs = 9.81 * ambulo_model_mass(model), tips = 0.0, bends = 0.0;
  assert_true(seat[1] > 0.4 * weighs && seat[1] < weighs);
  assert_close(seat[1] + grf[1] + grf[4], weighs, 1e-3 * weighs);
  for (int i = 0; i < TIMES; i++) {
    tips = fmin(tips, q[i * n + tilt] + q[i * n + back]);
    bends = fmin(bends, q[i * n + back]);
    knee_moment = fmin(knee_moment, tau[i * n + knee]);
    hip_moment = fmin(hip_moment, tau[i * n + hip]);
    if (times[i] >= 0.55) assert_close(seat[PATCHES * AXES * i + 1], 0.0, 0.0);
    assert_close(grf[6 * i + 1], grf[6 * i + 4], 1e-3 * weighs);
  }
  assert_true(tips < -0.7 && tips > -1.05); /* 40 to 60 degrees forward */
  assert_true(bends > -0.4);                /* mostly from the hips, as people do */
  /* N m per kg of one leg */
  assert_true(knee_moment < -0.6 * 75.0 && knee_moment > -1.25 * 75.0);
  assert_true(hip_moment < -0.6 * 75.0 && hip_moment > -1.1 * 75.0);
  assert_true(q[knee] > 1.6 && q[knee] < 2.1);
  assert_close(q[(TIMES - 1) * n + knee], 0.0872664626, 1e-6);
  assert_close(grf[6 * (TIMES - 1) + 1] / weighs, 0.5, 1e-3);
  ambulo_workspace_free(workspace);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* ------------------------------------------------------------- start, stop, turn */

/* the centre of pressure goes back and toward the foot that will swing, which is the right one,
 * before it goes forward over the left one (z is to the right) */
static void a_start_pushes_off_the_foot_that_will_swing(void **state) {
  (void)state;
  task k;
  open_task(&k, "walk_start");
  double most = 0.0, right = -INFINITY, back = INFINITY;
  int when = 0;
  for (int i = 0; i < k.count && k.t[i] < 0.62; i++) {
    if (share(&k, i, "right") > most) when = i;
    most = fmax(most, share(&k, i, "right"));
    right = fmax(right, k.zmp[3 * i + 2]);
    back = fmin(back, k.zmp[3 * i]);
  }
  assert_close(share(&k, 0, "right"), 0.5, 0.03);
  assert_true(most > 0.58 && k.t[when] > 0.2 && k.t[when] < 0.45);
  assert_true(right - k.zmp[2] > 0.02 && k.zmp[0] - back > 0.04);
  assert_true(fabs(value(&k, k.qd, 0, "pelvis_tx")) < 1e-6);
  assert_close(value(&k, k.qd, k.count - 1, "pelvis_tx"), 1.3, 1e-6);
  /* the left heel strikes where the motion ends: it carries nothing yet, and the right foot all */
  int last = k.count - 1;
  assert_true(share(&k, last, "left") == 0.0);
  assert_true(share(&k, last, "right") == 1.0);
  assert_true(k.grf[6 * last + 1] + k.grf[6 * last + 4] > 0.5 * weight(&k));
  close_task(&k);
}

static void a_stop_ends_at_rest_on_both_feet(void **state) {
  (void)state;
  task k;
  open_task(&k, "walk_stop");
  int last = k.count - 1;
  assert_true(value(&k, k.qd, 0, "pelvis_tx") > 1.3);
  for (int c = 0; c < k.coordinates; c++) assert_true(fabs(k.qd[last * k.coordinates + c]) < 1e-6);
  assert_close(share(&k, last, "left"), 0.5, 1e-4);
  assert_close(k.grf[6 * last + 1] + k.grf[6 * last + 4], weight(&k), 1e-5);
  close_task(&k);
}

/* a flat foot points along its heading, and all turn by 45 degrees to the left */
static void a_turn_follows_its_headings(void **state) {
  (void)state;
  task k;
  open_task(&k, "walk_turn");
  int seen = 0;
  for (int i = 0; i < k.count; i++) {
    for (int f = 0; f < 2; f++) {
      int c = contact_index_at(k.problem, f, k.t[i]);
      const ambulo_contact *contact = c >= 0 ? ambulo_problem_contact(k.problem, c) : NULL;
      if (!contact || contact->mode != AMBULO_CONTACT_FLAT) continue;
      const ambulo_foot *foot = ambulo_model_foot(k.model, f);
      const double *heel = place(&k, i, foot->heel_center), *toe = place(&k, i, foot->toe_center);
      double heading = atan2(-(toe[2] - heel[2]), toe[0] - heel[0]);
      assert_true(fabs(heading - contact->heading) < 0.015);
      seen |= 1 << f;
    }
  }
  assert_int_equal(seen, 3);
  assert_close(degrees(&k, 0, "pelvis_rotation"), -22.5, 1e-4);
  assert_close(degrees(&k, k.count - 1, "pelvis_rotation"), 22.5, 1e-4);
  double speed[2] = {value(&k, k.qd, k.count - 1, "pelvis_tx"),
                     -value(&k, k.qd, k.count - 1, "pelvis_tz")};
  assert_close(57.295779513082321 * atan2(speed[1], speed[0]), 22.5, 1e-3);
  close_task(&k);
}

/* ------------------------------------------------------------------------ stairs */

static const double tread = 0.29, step_height = 0.17, foot_length = 0.245;

/* lowest of the treads within 1 mm of x; `up`: 1 or -1. The riser between the treads of feet at 0
 * and at 0.29 m is midway between the tip of the one and the heel of the other */
static double stairs(double x, int up) {
  double riser = 0.5 * (foot_length + tread), slack = 0.001;
  double low = floor((x - slack - riser) / tread) + 1.0;
  double high = floor((x + slack - riser) / tread) + 1.0;
  return step_height * fmin(up * low, up * high);
}

/* how far a rigid foot dips into its tread where it turns about the ball, and the toes of people
 * bend; the tip has to clear from a tenth of the swing on */
static int tip_may_dip(const task *k, int f, double t) {
  int c = contact_index_at(k->problem, f, t);
  double left = 2.0 * ambulo_problem_duration(k->problem) * (0.62 - 0.5);
  double air = ambulo_problem_duration(k->problem) - left;
  if (c >= 0) return ambulo_problem_contact(k->problem, c)->mode == AMBULO_CONTACT_TOE;
  return t < left + 0.1 * air + 1e-9;
}

/* of points between heel and tip over the stairs, less what contacts may be off */
static void check_foot(const task *k, int i, int f, int up) {
  const ambulo_foot *foot = ambulo_model_foot(k->model, f);
  const double *heel = place(k, i, foot->heel_center), *tip = place(k, i, foot->tip);
  int loaded = contact_index_at(k->problem, f, k->t[i]) >= 0;
  double room = loaded ? 0.006 : 0.001, ball = 0.775;
  enum { PARTS = 40 };
  for (int part = 0; part <= PARTS; part++) {
    double along = (double)part / PARTS, x = heel[0] + along * (tip[0] - heel[0]);
    double y = heel[1] + along * (tip[1] - heel[1]);
    int dips = along > ball && tip_may_dip(k, f, k->t[i]);
    double below = stairs(x, up) - y;
    if (below > (dips ? 0.05 : room))
      print_error("%s foot %.1f mm below the stairs at t = %.4f s, x = %.3f m\n", foot->name,
                  1e3 * below, k->t[i], x);
    assert_true(below <= (dips ? 0.05 : room));
  }
}

/* a foot that lands on its toes is flat from when the other one has left: no force jumps there */
static void check_loads(const task *k) {
  for (int i = 1; i < k->count; i++) {
    double change = fabs(share(k, i, "left") - share(k, i - 1, "left"));
    assert_true(change <= 0.05 + 25.0 * (k->t[i] - k->t[i - 1]));
  }
}

static void no_foot_passes_through_a_step(void **state) {
  (void)state;
  for (int up = 1; up >= -1; up -= 2) {
    task k;
    open_task(&k, up > 0 ? "stairs_up" : "stairs_down");
    for (int i = 0; i < k.count; i++)
      for (int f = 0; f < 2; f++) check_foot(&k, i, f, up);
    check_loads(&k);
    int strike = 0, last = k.count - 1;
    /* the left foot has struck at t = 0, the right one strikes at T */
    assert_close(degrees(&k, strike, "knee_angle_l"), degrees(&k, last, "knee_angle_r"), 1e-3);
    if (up > 0) {
      assert_true(degrees(&k, strike, "knee_angle_l") > 55.0);
      assert_true(degrees(&k, strike, "knee_angle_l") < 75.0);
    } else {
      assert_true(degrees(&k, strike, "knee_angle_l") < 25.0);
      assert_true(degrees(&k, strike, "ankle_angle_l") < 0.0);
    }
    close_task(&k);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(two_feet_carry_half_each),
      cmocka_unit_test(a_squat_goes_down_and_up_on_both_legs),
      cmocka_unit_test(a_whole_body_squats_with_its_arms_ahead),
      cmocka_unit_test(a_body_rises_from_its_seat),
      cmocka_unit_test(a_start_pushes_off_the_foot_that_will_swing),
      cmocka_unit_test(a_stop_ends_at_rest_on_both_feet),
      cmocka_unit_test(a_turn_follows_its_headings),
      cmocka_unit_test(no_foot_passes_through_a_step),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
