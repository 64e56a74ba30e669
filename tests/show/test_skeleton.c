/* Stick figures: sides, and which lines exist. */
#include "show/skeleton.h"
#include "ambulo/tools/load.h"
#include "support/arm.h"
#include "support/import_case.h"
#include "support/toed_body.h"
#include "support/walker_result.h"

static void test_walker_has_legs_feet_and_a_head(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
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

/* ------------------------------------------------------------ imported bodies */

static double length_of(const ambulo__skeleton *s, int b) {
  double end[2][3];
  for (int e = 0; e < 2; e++)
    ambulo__pose_point(&s->pose, s->bones[b].link[e], s->bones[b].at[e], end[e]);
  return hypot(hypot(end[0][0] - end[1][0], end[0][1] - end[1][1]), end[0][2] - end[1][2]);
}

#define BODY(name, mass)                                                                           \
  "<link name='" name "'><inertial><mass value='" mass "'/><inertia ixx='1' ixy='0' ixz='0' "      \
  "iyy='1' iyz='0' izz='1'/><origin xyz='0 0 -0.2'/></inertial></link>\n"
#define HINGE(name, parent, child, place, axis)                                                    \
  "<joint name='" name "' type='continuous'><parent link='" parent "'/><child link='" child        \
  "'/><origin xyz='" place "'/><axis xyz='" axis "'/></joint>\n"
#define WELD(name, parent, child, place)                                                           \
  "<joint name='" name "' type='fixed'><parent link='" parent "'/><child link='" child             \
  "'/><origin xyz='" place "'/></joint>\n"

/* a trunk with a hip of two hinges, a thigh with a kneecap and a shank, and a camera on a mast of
 * two metres: trunk to hip, hip to knee, shank to its centre of mass; no spikes to the masses of
 * what is joined at both ends, none to the camera, no second thigh to the kneecap */
static void test_an_imported_leg_is_three_lines(void **state) {
  import_case c =
      import_text(state,
                  "<robot name='r'>" BODY("trunk", "9") BODY("ball", "0.3") BODY("thigh", "5")
                      BODY("shank", "3") BODY("cap", "0.02") "<link name='camera'/>" HINGE(
                          "hip_a", "trunk", "ball", "0.02 0.1 -0.3", "1 0 0")
                          HINGE("hip_b", "ball", "thigh", "0 0 0", "0.6 0.8 0")
                              HINGE("knee", "thigh", "shank", "0 0 -0.4", "0 1 0")
                                  WELD("tendon", "thigh", "cap", "0.05 0 -0.4")
                                      WELD("mast", "trunk", "camera", "0 0 2") "</robot>",
                  NULL);
  assert_int_equal(c.status, AMBULO_OK);
  ambulo__skeleton s;
  assert_int_equal(ambulo__skeleton_create(c.model, NULL, &s), AMBULO_OK);
  double *q = calloc((size_t)c.model->coordinate_count, sizeof *q);
  assert_non_null(q);
  for (int i = 0; i < c.model->coordinate_count; i++) q[i] = 0.1 * (double)(i + 1);
  ambulo__pose_at(&s.pose, q);
  free(q);
  assert_int_equal(s.bone_count, 3);
  const double want[3] = {hypot(hypot(0.02, 0.1), 0.3), 0.4, 0.2};
  for (int b = 0; b < 3; b++) {
    int found = 0;
    for (int k = 0; k < 3; k++) found += fabs(length_of(&s, k) - want[b]) < 1e-12;
    assert_int_equal(found, 1);
  }
  ambulo__skeleton_free(&s);
  import_shut(&c);
}

/* no line is longer than the body's longest part: its joints and masses are within 0.6 m of their
 * neighbours */
static void test_imported_lines_are_as_long_as_the_body(void **state) {
  (void)state;
  static const char *const files[] = {"every_joint.urdf", "every_joint.xml", "every_joint_v3.osim",
                                      "every_joint_v4.osim"};
  for (int i = 0; i < 4; i++) {
    char path[64];
    snprintf(path, sizeof path, "tests/import/%s", files[i]);
    import_case c = import_file(path, NULL);
    assert_int_equal(c.status, AMBULO_OK);
    ambulo__skeleton s;
    assert_int_equal(ambulo__skeleton_create(c.model, NULL, &s), AMBULO_OK);
    double *q = calloc((size_t)c.model->coordinate_count, sizeof *q);
    assert_non_null(q);
    ambulo__pose_at(&s.pose, q);
    free(q);
    assert_true(s.bone_count >= 3);
    for (int b = 0; b < s.bone_count; b++) assert_true(length_of(&s, b) < 0.6);
    ambulo__skeleton_free(&s);
    import_shut(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_walker_has_legs_feet_and_a_head),
      cmocka_unit_test(test_a_whole_body_has_forearms_and_toes),
      cmocka_unit_test(test_toes_with_the_ball_are_part_of_the_foot),
      cmocka_unit_test(test_arm_has_two_links),
      cmocka_unit_test_setup_teardown(test_an_imported_leg_is_three_lines, scratch_open,
                                      scratch_close),
      cmocka_unit_test(test_imported_lines_are_as_long_as_the_body)};
  return cmocka_run_group_tests_name("picture/skeleton", tests, NULL, NULL);
}
