/* Bodies with more joints: with arms, neck and toes at rest they are lower_body_21, whose arms,
 * head and toes are fixed; joints turn to where their names say. */
#include "mechanics/lagrangian.h"
#include "ambulo/tools/tools.h"
#include "support/random_model.h"
#include "support/test.h"

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

enum { MOST = 45, MOST_POINTS = 64, DRAWS = 20 };

typedef struct body {
  ambulo_model *model;
  void *scratch;
  double q[MOST], qd[MOST], qdd[MOST], tau[MOST], wrench[6], points[MOST_POINTS][3];
} body;

static void open_body(body *b, const char *name, const char *sex) {
  char path[512];
  *b = (body){.model = NULL};
  ambulo_subject subject = {.size = sizeof(ambulo_subject),
                            .mass = 70.0,
                            .stature = 1.7,
                            .sex = sex[0] == 'f' ? AMBULO_FEMALE : AMBULO_MALE};
  (void)snprintf(path, sizeof path, "%s/models/%s.yaml", AMBULO_SOURCE_DIR, name);
  assert_int_equal(ambulo_model_load(path, &subject, NULL, NULL, &b->model), AMBULO_OK);
  assert_true(ambulo_model_coordinate_count(b->model) <= MOST);
  assert_true(ambulo_model_point_count(b->model) <= MOST_POINTS);
  b->scratch = malloc(ambulo__lagrangian_scratch_size(b->model));
  assert_non_null(b->scratch);
}

static void close_body(body *b) {
  free(b->scratch);
  ambulo_model_free(b->model);
}

static void evaluate(body *b) {
  assert_int_equal(ambulo__lagrangian(0, b->model, b->q, b->qd, b->qdd,
                                      &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                        .tau = b->tau,
                                                        .wrench = b->wrench,
                                                        .points = b->points[0]},
                                      b->scratch),
                   AMBULO_OK);
}

static int coordinate(const body *b, const char *name) {
  int i = ambulo_model_find_coordinate(b->model, name);
  if (i < 0) print_error("no coordinate named %s\n", name);
  assert_true(i >= 0);
  return i;
}

static const double *point(const body *b, const char *name) {
  int i = ambulo_model_find_point(b->model, name);
  if (i < 0) print_error("no point named %s\n", name);
  assert_true(i >= 0);
  return b->points[i];
}

/* largest difference of the torques that both bodies have, and of the root's wrench, relative to
 * m g h and m g, with what is not of lower_body_21 at rest */
static double difference(body *whole, body *lower, uint64_t seed) {
  double worst = 0.0, weight = 70.0 * 9.81;
  random_source random = {seed};
  for (int draw = 0; draw < DRAWS; draw++) {
    for (int i = 0; i < ambulo_model_coordinate_count(lower->model); i++) {
      int k = coordinate(whole, ambulo_model_coordinate(lower->model, i)->name);
      whole->q[k] = lower->q[i] = random_between(&random, -0.5, 0.5);
      whole->qd[k] = lower->qd[i] = random_between(&random, -2.0, 2.0);
      whole->qdd[k] = lower->qdd[i] = random_between(&random, -10.0, 10.0);
    }
    evaluate(whole);
    evaluate(lower);
    for (int i = 0; i < ambulo_model_coordinate_count(lower->model); i++) {
      int k = coordinate(whole, ambulo_model_coordinate(lower->model, i)->name);
      worst = fmax(worst, fabs(whole->tau[k] - lower->tau[i]) / (weight * 1.7));
    }
    for (int i = 0; i < 6; i++)
      worst = fmax(worst, fabs(whole->wrench[i] - lower->wrench[i]) / weight);
  }
  return worst;
}

/* sizes are rounded to 1e-6 of the stature; the thorax of 45 is in two parts, whose centre is 4 mm
 * lower than that of the whole trunk less the lower */
static void at_rest_they_are_the_lower_body(void **state) {
  (void)state;
  static const struct {
    const char *name;
    double tolerance;
  } bodies[] = {{"lower_body_23", 2e-5},
                {"whole_body_29", 2e-5},
                {"whole_body_31", 2e-5},
                {"whole_body_37", 2e-5},
                {"whole_body_45", 1e-2}};
  for (int b = 0; b < 5; b++) {
    for (int s = 0; s < 2; s++) {
      body whole, lower;
      open_body(&whole, bodies[b].name, s ? "female" : "male");
      open_body(&lower, "lower_body_21", s ? "female" : "male");
      double worst = difference(&whole, &lower, 100 + (uint64_t)b);
      if (!(worst <= bodies[b].tolerance)) print_error("%s: %g\n", bodies[b].name, worst);
      assert_true(worst <= bodies[b].tolerance);
      close_body(&whole);
      close_body(&lower);
    }
  }
}

/* Turns one coordinate of a side by 0.3 rad: along `axis` the point moves by the sign. */
static void expect_moves(body *b, const char *name, const char *moved, int axis, int sign) {
  int i = coordinate(b, name);
  evaluate(b);
  double before = point(b, moved)[axis];
  b->q[i] += 0.3;
  evaluate(b);
  double after = point(b, moved)[axis];
  b->q[i] -= 0.3;
  if (!(sign * (after - before) > 0.003))
    print_error("%s moves %s by %g along %d\n", name, moved, after - before, axis);
  assert_true(sign * (after - before) > 0.003);
}

/* X forward, Y up, Z to the right; as in the OpenSim model */
static void joints_turn_as_they_are_called(void **state) {
  (void)state;
  body b;
  open_body(&b, "whole_body_45", "male");
  expect_moves(&b, "arm_flex_r", "hand_r", 0, 1);
  expect_moves(&b, "arm_flex_l", "hand_l", 0, 1);
  expect_moves(&b, "arm_add_r", "hand_r", 2, -1);
  expect_moves(&b, "arm_add_l", "hand_l", 2, 1);
  expect_moves(&b, "elbow_flex_r", "hand_r", 0, 1);
  expect_moves(&b, "elbow_flex_l", "hand_l", 0, 1);
  expect_moves(&b, "wrist_flex_r", "hand_r", 0, 1);
  expect_moves(&b, "wrist_flex_l", "hand_l", 0, 1);
  expect_moves(&b, "wrist_dev_r", "hand_r", 2, -1);
  expect_moves(&b, "wrist_dev_l", "hand_l", 2, 1);
  expect_moves(&b, "clavicle_elevation_r", "shoulder_r", 1, 1);
  expect_moves(&b, "clavicle_elevation_l", "shoulder_l", 1, 1);
  expect_moves(&b, "neck_extension", "head_top", 0, -1);
  expect_moves(&b, "neck_bending", "head_top", 2, 1);
  expect_moves(&b, "thorax_extension", "neck", 0, -1);
  expect_moves(&b, "mtp_angle_r", "toe_r", 1, 1);
  expect_moves(&b, "mtp_angle_l", "toe_l", 1, 1);
  /* bent elbows: turning the upper arm inward brings hands together; pronation turns bent hands in
   */
  b.q[coordinate(&b, "elbow_flex_r")] = b.q[coordinate(&b, "elbow_flex_l")] = 1.2;
  expect_moves(&b, "arm_rot_r", "hand_r", 2, -1);
  expect_moves(&b, "arm_rot_l", "hand_l", 2, 1);
  b.q[coordinate(&b, "elbow_flex_r")] = b.q[coordinate(&b, "elbow_flex_l")] = 0.0;
  b.q[coordinate(&b, "wrist_flex_r")] = b.q[coordinate(&b, "wrist_flex_l")] = 1.0;
  expect_moves(&b, "pro_sup_r", "hand_r", 2, -1);
  expect_moves(&b, "pro_sup_l", "hand_l", 2, 1);
  close_body(&b);
}

/* stature in the upright pose: soles at -0, the vertex one stature above */
static void they_are_as_tall_as_their_subject(void **state) {
  (void)state;
  static const char *const names[] = {"lower_body_23", "whole_body_29", "whole_body_31",
                                      "whole_body_37", "whole_body_45"};
  for (int k = 0; k < 5; k++) {
    body b;
    open_body(&b, names[k], "male");
    evaluate(&b);
    double tall = point(&b, "head_top")[1] - point(&b, "heel_r")[1];
    body lower;
    open_body(&lower, "lower_body_21", "male");
    evaluate(&lower);
    double due = point(&lower, "head_top")[1] - point(&lower, "heel_r")[1];
    assert_close(tall, due, 2e-4);
    close_body(&lower);
    close_body(&b);
  }
}

/* the arc of the forefoot, 4.4 cm for a body of 1.75 m, is the sole of the foot and of the toes:
 * the toes turn about its centre, 11.9 cm ahead of the ankle, and their tip stands on the ground */
static void toes_turn_about_the_arc_of_the_forefoot(void **state) {
  (void)state;
  static const char *const names[] = {"lower_body_23", "whole_body_31"};
  for (int k = 0; k < 2; k++) {
    body b;
    open_body(&b, names[k], "male");
    for (int bent = 0; bent < 2; bent++) {
      b.q[coordinate(&b, "mtp_angle_r")] = 0.6 * bent;
      evaluate(&b);
      for (int i = 0; i < 3; i++)
        assert_close(point(&b, "mtp_r")[i], point(&b, "ball_arc_r")[i], 1e-6);
      assert_close(point(&b, "ball_arc_r")[1], 0.04375 / 1.75 * 1.7, 1e-5);
      assert_close(point(&b, "ball_r")[0] - point(&b, "ankle_r")[0], 0.119 / 1.75 * 1.7, 1e-5);
    }
    b.q[coordinate(&b, "mtp_angle_r")] = 0.0;
    evaluate(&b);
    assert_close(point(&b, "toe_r")[1], 0.0, 1e-5);
    expect_moves(&b, "mtp_angle_r", "toe_r", 1, 1);
    expect_moves(&b, "mtp_angle_l", "toe_l", 1, 1);
    close_body(&b);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(at_rest_they_are_the_lower_body),
                                     cmocka_unit_test(joints_turn_as_they_are_called),
                                     cmocka_unit_test(they_are_as_tall_as_their_subject),
                                     cmocka_unit_test(toes_turn_about_the_arc_of_the_forefoot)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
