/* Angles of balls, and a skeleton that loads as a model. */
#include "retarget/skeleton_model.h"

#include "model/model.h"
#include "support/given_motion.h"

static void check_angles(const double angles[3], double tolerance) {
  double got[3];
  static const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  ambulo__rigid want = ambulo__rigid_identity(), again = ambulo__rigid_identity();
  for (int i = 0; i < 3; i++) {
    ambulo__rigid turn = ambulo__rigid_turn(axes[i], angles[i]);
    want = ambulo__rigid_times(&want, &turn);
  }
  ambulo__joint_angles((const double(*)[3])want.r, got);
  for (int i = 0; i < 3; i++) {
    ambulo__rigid turn = ambulo__rigid_turn(axes[i], got[i]);
    again = ambulo__rigid_times(&again, &turn);
  }
  assert_true(apart(&want, &again) < tolerance);
}

static void angles(void **state) {
  (void)state;
  unsigned seed = 7;
  for (int k = 0; k < 200; k++) {
    double a[3] = {3 * even(&seed), 3 * even(&seed), 3 * even(&seed)};
    check_angles(a, 1e-7);
  }
  double right = 0.5 * acos(-1.0); /* only a + c is known */
  check_angles((double[]){0.4, right, 0.3}, 1e-7);
  check_angles((double[]){0.4, -right, 0.3}, 1e-7);
}

static const ambulo__skeleton_joint legs[] = {
    {"Hips", -1, {0, 0, 0}, 0},       {"LeftUpLeg", 0, {0.1, -0.1, 0}, 0},
    {"LeftLeg", 1, {0, -0.4, 0}, 0},  {"LeftFoot", 2, {0, -0.4, 0}, 0},
    {"Site", 3, {0, -0.05, 0.15}, 1}, {"RightUpLeg", 0, {-0.1, -0.1, 0}, 0},
    {"RightLeg", 5, {0, -0.4, 0}, 0}, {"RightFoot", 6, {0, -0.4, 0}, 0},
    {"Site", 7, {0, -0.05, 0.15}, 1},
};

static void model(void **state) {
  (void)state;
  static ambulo__skeleton_joints joints;
  ambulo__given given = {.allocator = ambulo__allocator_or_default(NULL)};
  ambulo__text_init(&given.text, NULL);
  memcpy(joints.joint, legs, sizeof legs);
  joints.count = (int)(sizeof legs / sizeof *legs);
  assert_int_equal(ambulo__joints_model(&joints, "legs", NULL, &given), AMBULO_OK);
  assert_int_equal(given.body->coordinate_count, 3 + 3 * 7);
  assert_int_equal(ambulo__joint_coordinate(&joints, 5), 3 + 3 * 4);
  assert_string_equal(given.body->coordinates[ambulo__joint_coordinate(&joints, 5)].name,
                      "RightUpLeg_x");
  ambulo__segment_map map;
  ambulo__figure figure;
  ambulo__segments_find(given.body, NULL, &map);
  assert_int_equal(ambulo__figure_create(given.body, &map, "body", NULL, NULL, &figure), AMBULO_OK);
  assert_close(figure.leg, 0.4 + 0.4 + 0.05 + 0.015, 1e-6);
  assert_close(figure.aside[1], 0.1, 1e-6);
  assert_close(figure.aside[0], -0.1, 1e-6);
  ambulo__figure_free(&figure);
  ambulo__given_free(&given);
}

static void feet_are_needed(void **state) {
  (void)state;
  static ambulo__skeleton_joints joints;
  ambulo__given given = {.allocator = ambulo__allocator_or_default(NULL)};
  ambulo__text_init(&given.text, NULL);
  memcpy(joints.joint, legs, sizeof legs);
  joints.count = 5; /* the left leg alone */
  assert_int_equal(ambulo__joints_model(&joints, "leg", NULL, &given), AMBULO_E_MODEL);
  ambulo__given_free(&given);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(angles), cmocka_unit_test(model),
                                     cmocka_unit_test(feet_are_needed)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
