/* models/walk_whole_body.yaml, its larger bodies and run_whole_body.yaml, from zero: arms that
 * nothing tells how to swing. */
#include "mechanics/lagrangian.h"
#include "people/stride.h"
#include "support/test.h"

#include "ambulo/tools/tools.h"

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

enum { SAMPLES = 201, LOCKS = 9, TEXT = 512 };
static const double degree = 57.295779513082321;

typedef struct walk {
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo__stride stride;
} walk;

/* solved once, for all tests that ask for the same file and settings */
enum { KEPT = 12 };
static struct {
  char asked[2 * TEXT];
  walk walk;
} kept[KEPT];
static int kept_count;

static walk solved_walk(const char *file, const char *const *settings, int count) {
  char path[TEXT];
  walk w = {.problem = NULL};
  (void)snprintf(path, sizeof path, "%s/models/%s", AMBULO_SOURCE_DIR, file);
  assert_int_equal(ambulo_problem_load(path, settings, count, NULL, NULL, &w.problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(w.problem, NULL, NULL, NULL, NULL, &w.result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(w.result), AMBULO_OPTIMAL);
  assert_true(ambulo_result_audit(w.result)->violation.worst <= 1e-6);
  assert_int_equal(
      ambulo__stride_create(w.problem, ambulo_result_x(w.result), SAMPLES, NULL, &w.stride),
      AMBULO_OK);
  return w;
}

static void open_walk(walk *w, const char *file, const char *const *settings, int count) {
  char asked[2 * TEXT];
  int length = snprintf(asked, sizeof asked, "%s", file);
  for (int i = 0; i < count; i++)
    length += snprintf(asked + length, sizeof asked - (size_t)length, " %s", settings[i]);
  assert_true(length < (int)sizeof asked);
  int k = 0;
  while (k < kept_count && strcmp(kept[k].asked, asked) != 0) k++;
  if (k == kept_count) {
    assert_true(k < KEPT);
    kept[k].walk = solved_walk(file, settings, count);
    memcpy(kept[kept_count++].asked, asked, sizeof asked);
  }
  *w = kept[k].walk;
}

static int free_walks(void **state) {
  (void)state;
  for (int k = 0; k < kept_count; k++) {
    ambulo__stride_free(&kept[k].walk.stride);
    ambulo_result_free(kept[k].walk.result);
    ambulo_problem_free(kept[k].walk.problem);
  }
  return 0;
}

static double angle(const walk *w, const char *name, int k) {
  int i = ambulo_model_find_coordinate(w->problem->model, name);
  assert_true(i >= 0);
  return degree * w->stride.q[k * w->stride.coordinates + i];
}

static double range(const walk *w, const char *name) {
  double low = INFINITY, high = -INFINITY;
  for (int k = 0; k < SAMPLES; k++) {
    low = fmin(low, angle(w, name, k));
    high = fmax(high, angle(w, name, k));
  }
  return high - low;
}

/* of two angles over the stride */
static double correlation(const walk *w, const char *one, const char *other) {
  double mean[2] = {0.0, 0.0}, square[3] = {0.0, 0.0, 0.0};
  for (int k = 0; k < SAMPLES; k++) {
    mean[0] += angle(w, one, k) / SAMPLES;
    mean[1] += angle(w, other, k) / SAMPLES;
  }
  for (int k = 0; k < SAMPLES; k++) {
    double a = angle(w, one, k) - mean[0], b = angle(w, other, k) - mean[1];
    square[0] += a * a;
    square[1] += b * b;
    square[2] += a * b;
  }
  return square[2] / sqrt(square[0] * square[1]);
}

static double largest_free_moment(const walk *w) {
  double most = 0.0;
  for (int i = 0; i < SAMPLES * w->stride.feet; i++)
    most = fmax(most, fabs(w->stride.free_moment[i]));
  return most;
}

/* Each arm against the leg of its side, by 10 to 40 degrees (people of 1.25 m/s: about 20 to 30),
 * elbows bent, the lumbar joint against the pelvis. Larger bodies do the same. */
static void arms_swing_against_the_legs(void **state) {
  (void)state;
  static const char *const files[] = {"walk_whole_body.yaml", "walk_whole_body_37.yaml",
                                      "walk_whole_body_45.yaml"};
  for (int f = 0; f < 3; f++) {
    walk w;
    open_walk(&w, files[f], NULL, 0);
    assert_true(correlation(&w, "arm_flex_l", "hip_flexion_l") <= -0.8);
    assert_true(correlation(&w, "lumbar_rotation", "pelvis_rotation") <= -0.6);
    double swing = range(&w, "arm_flex_l");
    if (!(swing >= 10.0 && swing <= 40.0)) fail_msg("%s: arms swing by %.1f", files[f], swing);
    for (int k = 0; k < SAMPLES; k++) assert_true(angle(&w, "elbow_flex_l", k) > 5.0);
  }
}

static void arms_swing_further_the_faster(void **state) {
  (void)state;
  static const char *const speeds[] = {"gait.speed=0.9", "gait.speed=1.28", "gait.speed=1.72"};
  double last = 0.0;
  for (int i = 0; i < 3; i++) {
    walk w;
    open_walk(&w, "walk_whole_body.yaml", &speeds[i], 1);
    double swing = range(&w, "arm_flex_l");
    assert_true(swing > 1.2 * last);
    last = swing;
  }
}

/* arms at the sides: it costs .4 % more, the ground has to hold the body against turning */
static void locked_arms_cost_more(void **state) {
  (void)state;
  static const char *const locks[LOCKS] = {"model.links[arm_flex_r].coordinate.range=[-0.2, 0.2]",
                                           "model.links[arm_flex_l].coordinate.range=[-0.2, 0.2]",
                                           "model.links[arm_add_r].coordinate.range=[-8.2, -7.8]",
                                           "model.links[arm_add_l].coordinate.range=[-8.2, -7.8]",
                                           "model.links[upper_arm_r].coordinate.range=[-0.2, 0.2]",
                                           "model.links[upper_arm_l].coordinate.range=[-0.2, 0.2]",
                                           "model.links[forearm_r].coordinate.range=[19.8, 20.2]",
                                           "model.links[forearm_l].coordinate.range=[19.8, 20.2]",
                                           "gait.speed=0.9"};
  walk arms, locked;
  open_walk(&arms, "walk_whole_body.yaml", &locks[LOCKS - 1], 1);
  open_walk(&locked, "walk_whole_body.yaml", locks, LOCKS);
  assert_true(range(&locked, "arm_flex_l") < 0.41);
  assert_true(ambulo_result_objective(locked.result) >
              1.003 * ambulo_result_objective(arms.result));
  assert_true(largest_free_moment(&locked) > 1.03 * largest_free_moment(&arms));
}

/* the lowest tip of a loaded foot at the nodes, m above the ground: inverse dynamics of its own
 * tells where points are */
static double lowest_loaded_tip(const walk *w) {
  const ambulo_model *m = w->problem->model;
  ambulo__stride nodes;
  assert_int_equal(ambulo__stride_create(w->problem, ambulo_result_x(w->result), 0, NULL, &nodes),
                   AMBULO_OK);
  size_t d = (size_t)nodes.coordinates;
  double *zero = calloc(2 * d, sizeof *zero), least = INFINITY, wrench[6];
  double(*points)[3] = malloc((size_t)m->point_count * sizeof *points);
  void *scratch = malloc(ambulo__lagrangian_scratch_size(m));
  assert_true(zero && points && scratch);
  for (int k = 0; k < nodes.samples; k++) {
    assert_int_equal(ambulo__lagrangian(0, m, nodes.q + (size_t)k * d, zero, zero,
                                        &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                          .tau = zero + d,
                                                          .wrench = wrench,
                                                          .points = points[0]},
                                        scratch),
                     AMBULO_OK);
    for (int foot = 0; foot < 2; foot++)
      if (ambulo__stride_contact(&nodes, foot, nodes.times[k]))
        least = fmin(least, points[m->feet[foot].tip][1]);
  }
  free(scratch);
  free(points);
  free(zero);
  ambulo__stride_free(&nodes);
  return least;
}

/* largest difference of the gradients of the rows that keep the left tip above the ground from
 * central differences, over one control point in the middle; their number */
static double tip_gradient_error(const walk *w, int *rows) {
  enum { STEPS = 2 };
  static const double step = 1e-5;
  const ambulo_problem *p = w->problem;
  int n = ambulo_problem_variable_count(p), count = ambulo_problem_row_count(p);
  int first = n / 2 - n / 2 % w->stride.coordinates;
  double worst = 0.0, objective, *x = malloc((size_t)n * sizeof *x);
  double *gradient = malloc((size_t)n * sizeof *gradient);
  double *value = malloc((size_t)(STEPS * count) * sizeof *value);
  ambulo_workspace *workspace = NULL;
  ambulo_row row;
  assert_true(x && gradient && value);
  assert_int_equal(ambulo_workspace_create(p, NULL, &workspace), AMBULO_OK);
  memcpy(x, ambulo_result_x(w->result), (size_t)n * sizeof *x);
  *rows = 0;
  for (int i = first; i < first + w->stride.coordinates; i++) {
    double before = x[i];
    for (int side = 0; side < STEPS; side++) {
      x[i] = before + (side ? step : -step);
      assert_int_equal(
          ambulo_problem_evaluate(p, workspace, x, &objective, NULL, value + side * count),
          AMBULO_OK);
    }
    x[i] = before;
    for (int r = 0; r < count; r++) {
      assert_int_equal(ambulo_problem_row(p, r, &row), AMBULO_OK);
      if (strcmp(row.family, "contact") || strcmp(row.subject, "toe_l")) continue;
      assert_int_equal(ambulo_problem_row_gradient(p, workspace, x, r, gradient), AMBULO_OK);
      worst = fmax(worst, fabs((value[count + r] - value[r]) / (2.0 * step) - gradient[i]));
      *rows += i == first;
    }
  }
  ambulo_workspace_free(workspace);
  free(value);
  free(gradient);
  free(x);
  return worst;
}

/* toes of their own: while the foot is loaded they rest on the ground, as far below it as contacts
 * may be and no further */
static void loaded_toes_stay_above_the_ground(void **state) {
  (void)state;
  walk w;
  open_walk(&w, "walk_whole_body_45.yaml", NULL, 0);
  double e = w.problem->definition.contact_tolerance, least = lowest_loaded_tip(&w);
  if (!(least >= -e - 1e-6 && least < 0.0)) fail_msg("a loaded tip is at %g m", least);
  int rows;
  double error = tip_gradient_error(&w, &rows);
  assert_true(rows > 40);
  if (!(error < 1e-8)) fail_msg("a row's gradient is off by %g", error);
}

/* Runners: each arm against the leg of its side from 3 m/s on, further the faster, elbows bent by
 * 60 to 115 degrees. One runner: -14 to -50 degrees at 3 m/s, r -.78. At 2 m/s arms hardly swing,
 * at 5 m/s they go as far as joints allow. */
static void running_arms_swing_on_bent_elbows(void **state) {
  (void)state;
  ONLY_IN_CHECK_LONG();
  static const char *const speeds[] = {"gait.speed=2", "gait.speed=3", "gait.speed=5"};
  static const double most_r[] = {0.3, -0.35, -0.8};
  double last = 8.0;
  for (int i = 0; i < 3; i++) {
    walk w;
    open_walk(&w, "run_whole_body.yaml", &speeds[i], 1);
    double swing = range(&w, "arm_flex_l"), r = correlation(&w, "arm_flex_l", "hip_flexion_l");
    if (!(swing > last && swing < 181.0 && r <= most_r[i]))
      fail_msg("%s: arms swing by %.1f, r %.2f", speeds[i], swing, r);
    last = swing;
    for (int k = 0; k < SAMPLES; k++) {
      double elbow = angle(&w, "elbow_flex_l", k);
      assert_true(elbow > 60.0 && elbow < 115.0);
    }
  }
}

/* toes of their own bend by more than 30 degrees at push-off */
static void toes_bend_at_push_off(void **state) {
  (void)state;
  walk w;
  open_walk(&w, "walk_whole_body_45.yaml", NULL, 0);
  double most = 0.0, at = 0.0;
  for (int k = 0; k < SAMPLES; k++) {
    if (angle(&w, "mtp_angle_l", k) <= most) continue;
    most = angle(&w, "mtp_angle_l", k);
    at = (double)k / (SAMPLES - 1);
  }
  if (!(most > 30.0 && most < 65.0 && at > 0.5 && at < 0.75))
    fail_msg("toes bend by %.1f at %.2f of the stride", most, at);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(arms_swing_against_the_legs),
      cmocka_unit_test(arms_swing_further_the_faster),
      cmocka_unit_test(locked_arms_cost_more),
      cmocka_unit_test(loaded_toes_stay_above_the_ground),
      cmocka_unit_test(running_arms_swing_on_bent_elbows),
      cmocka_unit_test(toes_bend_at_push_off),
  };
  return cmocka_run_group_tests(tests, NULL, free_walks);
}
