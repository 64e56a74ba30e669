/* Names and directions of joints: against what the feet and the head do when a joint turns. */
#include "ambulo/mechanics.h"
#include "ambulo/tools/load.h"
#include "people/body_joints.h"
#include "support/test.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

static ambulo_model *load(const char *path) {
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load(path, NULL, NULL, NULL, &model), AMBULO_OK);
  return model;
}

/* d(point)/dq of a coordinate, at q = 0 */
static void slope_of(const ambulo_model *model, int point, int coordinate, double slope[3]) {
  size_t d = (size_t)ambulo_model_coordinate_count(model);
  double *q = calloc(2 * d, sizeof *q), *slopes = calloc(3 * d, sizeof *slopes), at[3];
  const ambulo_point *p = ambulo_model_point(model, point);
  ambulo_point_motion motion = ambulo_point_motion_default();
  motion.position = at;
  motion.position_q = slopes;
  assert_int_equal(ambulo_model_point_motion(model, p->link, p->position, q, q + d, &motion),
                   AMBULO_OK);
  for (int i = 0; i < 3; i++) slope[i] = slopes[(size_t)i * d + (size_t)coordinate];
  free(q);
  free(slopes);
}

static double dot(const double *a, const double *b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* how far a turn of the joint as people count it moves the foot of its side, or tips it */
static double moved(const ambulo_model *model, const ambulo__body_joint *joint) {
  const double *f = ambulo_model_forward(model), *u = ambulo_model_up(model);
  const double *l = ambulo_model_left(model);
  size_t length = strlen(joint->name);
  int is_left = joint->name[length - 1] == 'l';
  int foot_index = strstr(ambulo_model_foot(model, 0)->name, "left") ? !is_left : is_left;
  const ambulo_foot *foot = ambulo_model_foot(model, foot_index);
  double heel[3], toe[3], inward = is_left ? -1.0 : 1.0;
  int end = foot->has_tip ? foot->tip : foot->toe_center;
  slope_of(model, foot->heel_center, joint->coordinate, heel);
  slope_of(model, end, joint->coordinate, toe);
  double sum = 0.0;
  if (strncmp(joint->name, "hip_flexion", 11) == 0) sum = dot(f, heel);
  if (strncmp(joint->name, "hip_adduction", 13) == 0) sum = inward * dot(l, heel);
  if (strncmp(joint->name, "hip_rotation", 12) == 0) sum = inward * dot(l, toe);
  if (strncmp(joint->name, "knee", 4) == 0) sum = -dot(f, heel);
  if (strncmp(joint->name, "ankle", 5) == 0) sum = dot(u, toe) - dot(u, heel);
  if (strncmp(joint->name, "mtp", 3) == 0) sum = dot(u, toe);
  return joint->sign * sum;
}

static void joints_turn_as_people_count_them(void **state) {
  (void)state;
  static const struct {
    const char *path;
    int legs, turned; /* joints of the legs, of which so many count the other way round */
  } cases[] = {{"models/lower_body_18.yaml", 10, 0},
               {"models/lower_body_23.yaml", 12, 0},
               {"models/whole_body_45.yaml", 12, 0},
               {"models/opensim_2d_gait10.yaml", 6, 2}};
  for (int c = 0; c < 4; c++) {
    ambulo_model *model = load(cases[c].path);
    ambulo__body_joint joints[AMBULO__BODY_JOINTS];
    int legs = 0, turned = 0;
    ambulo__body_joints(model, joints);
    for (int i = 0; i < AMBULO__BODY_JOINTS; i++) {
      int in_leg = strncmp(joints[i].name, "pelvis", 6) && strncmp(joints[i].name, "lumbar", 6) &&
                   strncmp(joints[i].name, "subtalar", 8);
      if (joints[i].coordinate < 0) continue;
      turned += joints[i].sign < 0;
      if (!in_leg) continue;
      legs++;
      if (!(moved(model, &joints[i]) > 0.02))
        print_error("%s %s: %g\n", cases[c].path, joints[i].name, moved(model, &joints[i]));
      assert_true(moved(model, &joints[i]) > 0.02);
    }
    assert_int_equal(legs, cases[c].legs);
    assert_int_equal(turned, cases[c].turned);
    ambulo_model_free(model);
  }
}

static void files_call_them_in_many_ways(void **state) {
  (void)state;
  static const char *const wanted[] = {"knee_angle_r", "knee_angle_right", "right_knee_flexion",
                                       "RKnee_rz", "knee_r"};
  char name[AMBULO__JOINT_NAME];
  int index = 0, found = 0;
  for (; index < AMBULO__BODY_JOINTS; index++) {
    ambulo__joint_name(index, name);
    if (strcmp(name, "knee_angle_r") == 0) break;
  }
  for (int w = 0; w < 5; w++)
    for (int alias = 0; ambulo__joint_alias(index, alias, name); alias++)
      found += strcasecmp(name, wanted[w]) == 0;
  assert_int_equal(found, 5);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(joints_turn_as_people_count_them),
                                     cmocka_unit_test(files_call_them_in_many_ways)};
  return cmocka_run_group_tests_name("people/body_joints", tests, NULL, NULL);
}
