/* Left for right: partners by name, signs by axes, and the model's own check of the result. */
#include "import/body_tree.h"
#include "support/import_case.h"
#include "support/test.h"

#define MASS "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>"
#define HEAD "<mujoco><worldbody><body name='trunk'><freejoint name='root'/>" MASS
#define TAIL "</body></worldbody></mujoco>"
#define LIMB(name, y, axis)                                                                        \
  "<body name='" name "' pos='0 " y " -.1'><joint name='" name "_j' axis='" axis "'/>" MASS        \
  "</body>"

static const ambulo_coordinate *named(const import_case *c, const char *name) {
  return ambulo_model_coordinate(c->model, ambulo_model_find_coordinate(c->model, name));
}

static void expect(const import_case *c, const char *name, const char *partner, double sign) {
  const ambulo_coordinate *q = named(c, name);
  assert_non_null(q);
  assert_string_equal(ambulo_model_coordinate(c->model, q->mirror)->name, partner);
  assert_close(q->mirror_sign, sign, 0);
}

static void a_body(void **state) {
  import_case c = import_good(
      state, HEAD LIMB("hip_l", "0.1", "0 1 0") LIMB("hip_r", "-0.1", "0 1 0")
                 LIMB("RLEG_ROLL_R", "-0.1", "1 0 0") LIMB("LLEG_ROLL_R", "0.1", "1 0 0")
                     LIMB("Left.Arm", "0.2", "0 0 1") LIMB("Right.Arm", "-0.2", "0 0 -1")
                         LIMB("lfemur", "0.2", "0 1 0") LIMB("rfemur", "-0.2", "0 -1 0") TAIL);
  expect(&c, "hip_l_j", "hip_r_j", 1);
  expect(&c, "RLEG_ROLL_R_j", "LLEG_ROLL_R_j", -1);
  expect(&c, "Left.Arm_j", "Right.Arm_j", 1);
  expect(&c, "lfemur_j", "rfemur_j", -1);
  expect(&c, "root_tx", "root_tx", 1);
  expect(&c, "root_ty", "root_ty", -1);
  expect(&c, "root_list", "root_list", -1);
  expect(&c, "root_tilt", "root_tilt", 1);
  assert_int_equal(ambulo_model_check_mirror(c.model, NULL, NULL), AMBULO_OK);
  import_shut(&c);
}

/* a limb without a partner is said; axes that are no images get no sign */
static void what_has_no_image(void **state) {
  import_case c =
      import_good(state, HEAD LIMB("hook_r", "-0.1", "1 1 0") LIMB("arm_l", "0.1", "1 1 0")
                             LIMB("arm_r", "-0.1", "0 1 1") TAIL);
  assert_told(&c, "1 coordinates have no partner on the other side (hook_r_j, for one)");
  expect(&c, "arm_l_j", "arm_l_j", 1);
  import_shut(&c);
}

static void sides(void **state) {
  (void)state;
  static const struct {
    const char *name;
    char side;
    const char *other;
  } cases[] = {{"hip_l", 'l', "hip_r"},
               {"R_knee", 'r', "L_knee"},
               {"left_foot", 'l', "right_foot"},
               {"RightFoot", 'r', "LeftFoot"},
               {"ANKLE_LEFT", 'l', "ANKLE_RIGHT"},
               {"LHip", 'l', "RHip"},
               {"FL_hip", 'l', "FR_hip"},
               {"knee_angle_r_beta", 'r', "knee_angle_l_beta"},
               {"Lever", 0, NULL},
               {"trunk", 0, NULL},
               {"roll", 0, NULL},
               {"lfemur", 0, NULL},
               {"", 0, NULL}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    char text[40] = "";
    assert_int_equal(ambulo__side_of(cases[i].name), cases[i].side);
    assert_int_equal(ambulo__other_side(cases[i].name, text, sizeof text), cases[i].side != 0);
    if (cases[i].other) assert_string_equal(text, cases[i].other);
  }
}

static void letters(void **state) {
  (void)state;
  char text[8] = "";
  assert_int_equal(ambulo__flip_letter("LLEG_R", 0, text, sizeof text), 1);
  assert_string_equal(text, "RLEG_R");
  assert_int_equal(ambulo__flip_letter("LLEG_R", 2, text, sizeof text), 0);
  assert_int_equal(ambulo__flip_letter("LLEG_R", 6, text, sizeof text), 0);   /* its end */
  assert_int_equal(ambulo__flip_letter("LLEG_RRR", 0, text, sizeof text), 0); /* no room */
  assert_int_equal(ambulo__other_side("left_1", text, sizeof text), 1);
  assert_int_equal(ambulo__other_side("left_12", text, sizeof text), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_body),
      cmocka_unit_test(what_has_no_image),
      cmocka_unit_test(sides),
      cmocka_unit_test(letters),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
