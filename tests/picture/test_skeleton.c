/* Stick figures: sides, and which lines exist. */
#include "picture/skeleton.h"
#include "support/arm.h"
#include "support/toed_body.h"
#include "support/walker_result.h"

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

/* shoulder to elbow, and on to the tip of the hand; feet with toes of their own */
static void test_a_whole_body_has_forearms_and_toes(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/whole_body_45.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  ambulo__skeleton s;
  assert_int_equal(ambulo__skeleton_create(model, NULL, &s), AMBULO_OK);
  static const char *const ends[2] = {"hand_l", "toe_l"};
  for (int k = 0; k < 2; k++) {
    const ambulo_point *end = &model->points[ambulo_model_find_point(model, ends[k])];
    int lines = 0;
    for (int b = 0; b < s.bone_count; b++)
      lines += s.bones[b].link[1] == end->link && s.bones[b].side == AMBULO__LEFT &&
               memcmp(s.bones[b].at[1], end->position, sizeof end->position) == 0;
    assert_int_equal(lines, 1);
  }
  ambulo__skeleton_free(&s);
  ambulo_model_free(model);
}

/* a tip that the ball goes with has no line of its own: those of the foot reach to the ball */
static void test_toes_with_the_ball_are_part_of_the_foot(void **state) {
  (void)state;
  ambulo_model *model = toed_body();
  ambulo__skeleton s;
  assert_int_equal(ambulo__skeleton_create(model, NULL, &s), AMBULO_OK);
  for (int foot = 0; foot < 2; foot++) {
    int toes = model->points[model->feet[foot].tip].link, lines = 0;
    assert_int_equal(toes, model->points[model->feet[foot].toe_center].link);
    for (int b = 0; b < s.bone_count; b++)
      lines += s.bones[b].link[0] == toes && s.bones[b].link[1] == toes;
    assert_int_equal(lines, 0);
  }
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
  ambulo__pose_at(&s.pose, straight);
  ambulo__pose_point(&s.pose, s.bones[1].link[1], s.bones[1].at[1], hand);
  assert_close(hand[0], 0.55, 1e-15);
  ambulo__skeleton_free(&s);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_walker_has_legs_feet_and_a_head),
                                     cmocka_unit_test(test_a_whole_body_has_forearms_and_toes),
                                     cmocka_unit_test(test_toes_with_the_ball_are_part_of_the_foot),
                                     cmocka_unit_test(test_arm_has_two_links)};
  return cmocka_run_group_tests_name("picture/skeleton", tests, NULL, NULL);
}
