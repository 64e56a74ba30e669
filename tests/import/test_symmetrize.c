/* --symmetrize: what nearly is its own mirror image becomes it, by the model's own check; what
 * differed is said; what is not changed stays; and too much is refused. */
#include "support/import_case.h"

/* A body whose left and right differ: the right hip by 4 mm in height and 10 g, its axis by 0.01
 * rad, its range and torque; the trunk's centre of mass is 3 mm off the middle; a sensor is fixed
 * to the left shank alone. */
#define INERTIAL(at, mass, moments)                                                                \
  "<inertial pos='" at "' mass='" mass "' diaginertia='" moments "'/>"
#define LEG(side, hip, axis, mass, range, more)                                                    \
  "<body name='thigh_" side "' pos='" hip "'><joint name='roll_" side "' axis='" axis              \
  "' limited='true' range='" range                                                                 \
  "'/>" INERTIAL("0 0 -.2", mass, ".02 .02 .01") "<body name='shank_" side                         \
                                                 "' pos='0 0 -.4'><joint name='knee_" side         \
                                                 "' axis='0 1 0'/>" INERTIAL("0 0 -.2", "1",       \
                                                                             ".02 .02 .01") more   \
      "<body name='foot_" side "' pos='0 0 -.4'><joint name='ankle_" side                          \
      "' axis='0 1 0'/>" INERTIAL(".03 0 0", ".5",                                                 \
                                  ".001 .002 .003") "<geom type='box' size='.1 .04 .02' pos='.03 " \
                                                    "0 -.03' mass='0'/></body></body></body>"
#define BODY(trunk, more, right, right_axis, right_mass, right_range)                              \
  "<mujoco><compiler angle='radian'/><worldbody><body name='trunk' pos='0 0 1'>"                   \
  "<freejoint name='root'/>" INERTIAL(                                                             \
      trunk, "5",                                                                                  \
      ".1 .1 .1") "<body name='neck' pos='0 .001 .3'><joint name='neck' axis='0 0 1' "             \
                  "limited='true' "                                                                \
                  "range='-1 .8'/>" INERTIAL("0 0 0", "1", ".01 .01 .01") "</body>" LEG(           \
                      "l", ".01 .1 -.1", "1 0 0", "2", "-.5 1", more)                              \
                      LEG("r", right, right_axis, right_mass, right_range,                         \
                          "") "</body></worldbody></mujoco>"
#define SENSOR                                                                                     \
  "<body name='sensor' pos='.02 .01 0'><inertial pos='0 0 0' mass='.01' "                          \
  "diaginertia='1e-6 1e-6 1e-6'/></body>"

static import_case made_even(void **state, const char *xml) {
  ambulo_import_options o = ambulo_import_options_default();
  o.symmetrize = 1;
  return import_text(state, xml, &o);
}

static const ambulo_coordinate *named(const import_case *c, const char *name) {
  return ambulo_model_coordinate(c->model, ambulo_model_find_coordinate(c->model, name));
}

static const char uneven[] =
    BODY("0 .003 .1", SENSOR, ".01 -.1 -.104", "1 .01 0", "2.01", "-.9 .5");

static void becomes_its_image(void **state) {
  import_case c = import_good(state, uneven);
  double mass = ambulo_model_mass(c.model);
  assert_int_equal(ambulo_model_check_mirror(c.model, NULL, NULL), AMBULO_E_MODEL);
  import_shut(&c);
  c = made_even(state, uneven);
  if (c.status) import_print(&c);
  assert_int_equal(c.status, AMBULO_OK);
  assert_int_equal(ambulo_model_check_mirror(c.model, NULL, c.list), AMBULO_OK);
  assert_close(ambulo_model_mass(c.model), mass, 1e-12);
  assert_told(&c, "left and right are exact images now; they differed by up to 4 mm in the place "
                  "of a joint (thigh_l, thigh_r), 10 g in a mass (");
  assert_told(&c, "0.573 degrees in an axis (thigh_l, thigh_r)");
  assert_told(&c, "and in 3 limits or defaults");
  assert_close(named(&c, "roll_l")->mirror_sign, -1, 0);
  assert_close(named(&c, "roll_l")->range[1], .95, 1e-8);
  assert_close(named(&c, "roll_r")->range[0], -.95, 1e-8);
  assert_close(named(&c, "neck")->range[0], -.9, 1e-8);
  assert_close(named(&c, "neck")->range[1], .9, 1e-8);
  import_shut(&c);
}

static void drives_become_alike(void **state) {
  import_case c = made_even(state, BODY("0 0 .1", "", ".01 -.1 -.1", "1 0 0", "2",
                                        "-1 .5' armature='.03' damping='.4' frictionloss='.2"));
  assert_int_equal(c.status, AMBULO_OK);
  for (int side = 0; side < 2; side++) {
    const ambulo_coordinate *roll = named(&c, side ? "roll_r" : "roll_l");
    assert_close(roll->armature, .015, 1e-12);
    assert_close(roll->damping, .2, 1e-12);
    assert_close(roll->friction, .1, 1e-12);
  }
  import_shut(&c);
}

/* the same in a world whose forward is another axis */
static void any_axis(void **state) {
  ambulo_import_options o = ambulo_import_options_default();
  o.symmetrize = 1;
  import_case c = import_text(
      state,
      "<mujoco><worldbody><body name='trunk' pos='.002 0 1'><freejoint name='root'/>" INERTIAL(
          ".001 0 0", "5",
          ".1 .1 .1") "<body name='arm_l' pos='.2 .01 0'><joint name='arm_l' axis='0 0 "
                      "1'/>" INERTIAL("0 0 .1", "1",
                                      ".01 .02 .03") "</body>"
                                                     "<body name='arm_r' pos='-.203 .01 0' "
                                                     "euler='0 0 180'><joint name='arm_r' axis='0 "
                                                     "0 1'/>" INERTIAL(
                                                         "0 0 .1", "1",
                                                         ".01 .02 .0299") "</body></body></"
                                                                          "worldbody></mujoco>",
      &o);
  if (c.status) import_print(&c);
  assert_int_equal(c.status, AMBULO_OK);
  assert_close(ambulo_model_forward(c.model)[1], -1, 1e-12);
  assert_int_equal(ambulo_model_check_mirror(c.model, NULL, c.list), AMBULO_OK);
  import_shut(&c);
}

/* what is even already is written as it was, and nothing is said */
static void an_even_body_stays(void **state) {
  static const char even[] = BODY("0 0 .1", "", ".01 -.1 -.1", "1 0 0", "2", "-1 .5");
  char *was = NULL;
  import_case c = import_good(state, even);
  was = strdup(strstr(c.text, "thigh_l"));
  import_shut(&c);
  c = made_even(state, even);
  assert_int_equal(c.status, AMBULO_OK);
  assert_string_equal(strstr(c.text, "thigh_l"), was);
  free(was);
  import_shut(&c);
}

/* Means, not the better side: of 0.1 kg m^2 and 0.12, 0.11. */
static void means(void **state) {
  import_case c = made_even(
      state, "<mujoco><worldbody><body name='trunk'><freejoint name='root'/>" INERTIAL(
                 "0 0 0", "5",
                 ".1 .1 .1") "<body name='arm_l' pos='0 .2 0'><joint name='arm_l' axis='1 0 "
                             "0'/>" INERTIAL("0 .1 0", "1",
                                             ".1 .1 .02") "</body>"
                                                          "<body name='arm_r' pos='0 -.2 0'><joint "
                                                          "name='arm_r' axis='1 0 0'/>" INERTIAL(
                                                              "0 -.104 0", "1.04",
                                                              ".12 .12 .02") "</body></body></"
                                                                             "worldbody></mujoco>");
  assert_int_equal(c.status, AMBULO_OK);
  const ambulo_link *left = ambulo_model_link(c.model, ambulo_model_find_link(c.model, "arm_l"));
  assert_close(left->mass, 1.02, 1e-12);
  assert_close(left->com[1], .102, 1e-12);
  assert_close(left->inertia[0], .11, 1e-12);
  import_shut(&c);
}

/* Joints that differ where the masses are images already: masses stay where they are. */
static void joints_alone(void **state) {
  import_case c = made_even(
      state, "<mujoco><worldbody><body name='trunk'><freejoint name='root'/>" INERTIAL(
                 "0 0 0", "5",
                 ".1 .1 .1") "<body name='arm_l' pos='0 .5 0'><joint name='arm_l' "
                             "axis='1 0 0'/>" INERTIAL(
                                 "0 .1 0", "1",
                                 ".1 .1 .1") "</body><body name='arm_r' pos='0 -.5 "
                                             ".004'><joint name='arm_r' axis='1 0 "
                                             "0'/>" INERTIAL("0 -.1 -.004", "1",
                                                             ".1 .1 .1") "</body></body></"
                                                                         "worldbody></mujoco>");
  assert_int_equal(c.status, AMBULO_OK);
  assert_int_equal(ambulo_model_check_mirror(c.model, NULL, c.list), AMBULO_OK);
  const ambulo_link *left = ambulo_model_link(c.model, ambulo_model_find_link(c.model, "arm_l"));
  assert_close(left->com[2], -.002, 1e-12);
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(becomes_its_image),
      cmocka_unit_test(drives_become_alike),
      cmocka_unit_test(any_axis),
      cmocka_unit_test(an_even_body_stays),
      cmocka_unit_test(means),
      cmocka_unit_test(joints_alone),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
