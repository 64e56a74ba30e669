/* Stick figures: forward kinematics against the mechanics, sides, and which lines exist. */
#include "report/skeleton.h"
#include "support/arm.h"
#include "support/walker_result.h"

static void test_points_agree_with_the_mechanics(void **state) {
  (void)state;
  ambulo_model *model = walker_create();
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  ambulo__skeleton s;
  assert_int_equal(ambulo__skeleton_create(model, NULL, &s), AMBULO_OK);
  double q[WALKER_COORDINATES], zero[WALKER_COORDINATES] = {0.0}, points[3 * WALKER_POINTS];
  for (int i = 0; i < WALKER_COORDINATES; i++) q[i] = sin(1.0 + 1.3 * i);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(mechanics, 1, q, zero, zero, NULL, NULL, points),
      AMBULO_OK);
  ambulo__skeleton_pose(&s, q);
  for (int p = 0; p < WALKER_POINTS; p++) {
    const ambulo_point *point = ambulo_model_point(model, p);
    double world[3];
    ambulo__skeleton_point(&s, point->link, point->position, world);
    for (int k = 0; k < 3; k++) assert_close(world[k], points[3 * p + k], 1e-13);
  }
  ambulo__skeleton_free(&s);
  ambulo_mechanics_free(mechanics);
  ambulo_model_free(model);
}

static void test_walker_has_legs_feet_and_a_head(void **state) {
  (void)state;
  ambulo_model *model = walker_create();
  ambulo__skeleton s;
  assert_int_equal(ambulo__skeleton_create(model, NULL, &s), AMBULO_OK);
  int count[3] = {0, 0, 0}, heads = 0;
  for (int b = 0; b < s.bone_count; b++) {
    count[s.bones[b].side]++;
    heads += s.bones[b].head > 0.0;
  }
  /* thigh, shank, three lines of the foot */
  assert_int_equal(count[AMBULO__LEFT], 5);
  assert_int_equal(count[AMBULO__RIGHT], 5);
  assert_int_equal(count[AMBULO__MIDDLE], 1);
  assert_int_equal(heads, 1);
  ambulo__skeleton_free(&s);
  ambulo_model_free(model);
}

static void test_arm_has_two_links(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo__skeleton s;
  assert_int_equal(ambulo__skeleton_create(model, NULL, &s), AMBULO_OK);
  assert_int_equal(s.bone_count, 2);
  const double straight[ARM_COORDINATES] = {0.0, 0.0};
  double hand[3];
  ambulo__skeleton_pose(&s, straight);
  ambulo__skeleton_point(&s, s.bones[1].link[1], s.bones[1].at[1], hand);
  assert_close(hand[0], 0.55, 1e-15);
  ambulo__skeleton_free(&s);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_points_agree_with_the_mechanics),
                                     cmocka_unit_test(test_walker_has_legs_feet_and_a_head),
                                     cmocka_unit_test(test_arm_has_two_links)};
  return cmocka_run_group_tests_name("report/skeleton", tests, NULL, NULL);
}
