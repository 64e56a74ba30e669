/* The start pose of imported models: defaults of the source and of --pose, within the ranges, with
 * the feet on the ground. */
#include "support/import_case.h"

static double start_of(const import_case *c, const char *name) {
  int i = ambulo_model_find_coordinate(c->model, name);
  if (i < 0) print_error("no coordinate %s\n", name);
  assert_true(i >= 0);
  return ambulo_model_coordinate(c->model, i)->default_value;
}

static import_case with_pose(void **state, const char *xml, const char *pose, const char *heel,
                             const char *toe) {
  ambulo_import_options o = ambulo_import_options_default();
  o.pose = &pose;
  o.pose_count = pose != NULL;
  o.heels = &heel;
  o.heel_count = heel != NULL;
  o.toes = &toe;
  o.toe_count = toe != NULL;
  import_case c = import_text(state, xml, &o);
  if (c.status) import_print(&c);
  assert_int_equal(c.status, AMBULO_OK);
  return c;
}

/* heights of both ends of the foot in the start pose, by the model's own kinematics */
static void heights(const import_case *c, double height[2]) {
  double q[64], zero[64] = {0}, places[3 * 64];
  ambulo_mechanics *mechanics = NULL;
  for (int i = 0; i < ambulo_model_coordinate_count(c->model); i++)
    q[i] = ambulo_model_coordinate(c->model, i)->default_value;
  assert_int_equal(ambulo_mechanics_create(c->model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, 1, q, zero, zero,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .points = places}),
                   AMBULO_OK);
  const ambulo_foot *foot = ambulo_model_foot(c->model, 0);
  const int ends[2] = {foot->heel[0], foot->toe[0]};
  const double *up = ambulo_model_up(c->model);
  for (int k = 0; k < 2; k++) {
    const double *p = places + 3 * ends[k];
    height[k] = p[0] * up[0] + p[1] * up[1] + p[2] * up[2];
  }
  ambulo_mechanics_free(mechanics);
}

/* ------------------------------------------------------------------------ OpenSim */

#define OSIM(ty, knee, range)                                                                      \
  "<OpenSimDocument Version='40000'><Model name='m'><gravity>0 -9.81 0</gravity><BodySet>"         \
  "<objects><Body name='pelvis'><mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body>"               \
  "<Body name='shank'><mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet>"     \
  "<JointSet><objects><PlanarJoint name='root'><socket_parent_frame>/ground</socket_parent_frame>" \
  "<socket_child_frame>/bodyset/pelvis</socket_child_frame><coordinates>"                          \
  "<Coordinate name='tilt'/><Coordinate name='tx'/>"                                               \
  "<Coordinate name='ty'><default_value>" ty "</default_value></Coordinate></coordinates>"         \
  "</PlanarJoint><PinJoint name='knee'>"                                                           \
  "<socket_parent_frame>/bodyset/pelvis</socket_parent_frame>"                                     \
  "<socket_child_frame>/bodyset/shank</socket_child_frame><coordinates><Coordinate name='knee'>"   \
  "<default_value>" knee "</default_value><range>" range "</range></Coordinate></coordinates>"     \
  "</PinJoint></objects></JointSet></Model></OpenSimDocument>"

/* a leg of 0.5 m bent by 0.6 rad: its foot is 0.5 cos(0.6) below the hip */
static void defaults_of_opensim(void **state) {
  import_case c = with_pose(state, OSIM("0.9", "0.6", "-1 2"), NULL, "right=shank:0,-0.5,0",
                            "right=shank:0,-0.5,0");
  double height[2];
  assert_close(start_of(&c, "knee"), 0.6, 1e-8);
  assert_close(start_of(&c, "ty"), 0.5 * cos(0.6), 1e-7);
  heights(&c, height);
  assert_close(height[0], 0.0, 1e-7);
  assert_told(&c, "ty starts at 0.413 m, 487 mm lower than in the source");
  import_shut(&c);
}

static void without_feet(void **state) {
  import_case c = with_pose(state, OSIM("0.9", "0.6", "-1 0.5"), NULL, NULL, NULL);
  assert_close(start_of(&c, "ty"), 0.9, 1e-12);
  assert_close(start_of(&c, "knee"), 0.5, 1e-8);
  assert_told(&c, "knee is 0.6 by default, outside its range: it starts at 0.5");
  import_shut(&c);
}

static void asked_for(void **state) {
  import_case c = with_pose(state, OSIM("0.9", "0.6", "-1 2"), "knee=-0.25", NULL, NULL);
  assert_close(start_of(&c, "knee"), -0.25, 1e-8);
  import_shut(&c);
}

/* --------------------------------------------------------------------------- URDF */

/* the root is free: lifted to stand at q = 0, and lower where the knee is bent */
static void pose_of_a_robot(void **state) {
  static const char xml[] =
      "<robot name='r'><link name='base'><inertial><mass value='1'/><inertia ixx='1' iyy='1' "
      "izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link><link name='foot'>"
      "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
      "</inertial></link><joint name='knee' type='revolute'><parent link='base'/>"
      "<child link='foot'/><axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='1' "
      "velocity='1'/></joint></robot>";
  import_case c = with_pose(state, xml, "knee=0.5", "right=foot:0,0,-0.4", "right=foot:0.1,0,-0.4");
  double height[2];
  assert_close(start_of(&c, "knee"), 0.5, 1e-8);
  heights(&c, height);
  assert_close(fmin(height[0], height[1]), 0.0, 1e-7);
  assert_true(fabs(start_of(&c, "base_tz")) > 1e-3);
  import_shut(&c);
}

/* ------------------------------------------------------------------------- MuJoCo */

#define BODY "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>"

/* the first keyframe: places against the body's own, quaternions as turns */
static void keyframe(void **state) {
  import_case c = import_good(
      state,
      "<mujoco><worldbody><body name='b' pos='1 2 3' quat='0.5 0.5 0.5 0.5'>" BODY
      "<freejoint name='root'/><body name='c'>" BODY "<joint name='ball' type='ball'/>"
      "<body name='d'>" BODY "<joint name='j' range='-90 90'/></body></body></body></worldbody>"
      /* turned by 0.4 about x in front of the body's own turn; by 0.6 about y; 0.7 rad */
      "<keyframe><key name='home' qpos='1.5 1 3.25 0.3906986235230902 0.5893679543181514 "
      "0.3906986235230902 0.5893679543181514 0.95533648912560598 0 0.29552020666133955 0 0.7'/>"
      "<key qpos='0 0 0 1 0 0 0 1 0 0 0 0'/></keyframe></mujoco>");
  assert_close(start_of(&c, "root_tx"), 0.5, 1e-12);
  assert_close(start_of(&c, "root_ty"), -1.0, 1e-12);
  assert_close(start_of(&c, "root_tz"), 0.25, 1e-12);
  assert_close(start_of(&c, "root_tilt"), 0.0, 1e-8);
  assert_close(start_of(&c, "root_list"), 0.4, 1e-8);
  assert_close(start_of(&c, "root_rotation"), 0.0, 1e-8);
  assert_close(start_of(&c, "ball_y"), 0.6, 1e-8);
  assert_close(start_of(&c, "ball_x"), 0.0, 1e-8);
  assert_close(start_of(&c, "j"), 0.7, 1e-8);
  assert_told(&c, "the start pose is that of keyframe 'home'");
  import_shut(&c);
}

/* turns about left and up, of a body that stands as the world does */
static void keyframe_of_a_free_body(void **state) {
  static const struct {
    const char *turn, *name;
  } cases[] = {{"0.98877107793604224 0 0.14943813247359922 0", "root_tilt"},
               {"0.98877107793604224 0.14943813247359922 0 0", "root_list"},
               {"0.98877107793604224 0 0 0.14943813247359922", "root_rotation"}};
  static const char *const names[] = {"root_tilt", "root_list", "root_rotation"};
  for (int i = 0; i < 3; i++) {
    char text[1024];
    (void)snprintf(text, sizeof text,
                   "<mujoco><worldbody><body name='b'>" BODY "<freejoint name='root'/></body>"
                   "</worldbody><keyframe><key qpos='0 0 0 %s'/></keyframe></mujoco>",
                   cases[i].turn);
    import_case c = import_good(state, text);
    for (int k = 0; k < 3; k++)
      assert_close(start_of(&c, names[k]), strcmp(names[k], cases[i].name) == 0 ? 0.3 : 0.0, 1e-7);
    import_shut(&c);
  }
}

/* without one, joints stand at their reference */
static void reference(void **state) {
  import_case c = import_good(state, "<mujoco><worldbody><body name='b'>" BODY
                                     "<joint name='j' ref='30'/></body></worldbody></mujoco>");
  assert_close(start_of(&c, "j"), acos(-1) / 6, 1e-8);
  import_shut(&c);
}

/* A keyframe in which the robot stands is as it was, whatever its legs do at q = 0: knees bent by
 * 60 degrees, 0.4 m from hip to knee and from knee to foot, the hip 0.2 + 0.4 above the ground. */
static void a_start_that_stands(void **state) {
  import_case c = import_good(
      state, "<mujoco><worldbody><body name='trunk' pos='0 0 0.7'>" BODY
             "<freejoint name='root'/><body name='thigh'>" BODY "<joint name='hip' axis='0 1 0'/>"
             "<body name='shank' pos='0 0 -0.4'>" BODY "<joint name='knee' axis='0 1 0'/>"
             "<body name='foot_r' pos='0 0 -0.4'>" BODY "<joint name='ankle' axis='0 1 0'/>"
             "<geom type='box' size='0.1 0.05 0.01' pos='0 0 0.01'/></body></body></body></body>"
             "</worldbody><keyframe><key qpos='0 0 0.6 1 0 0 0 -1.0471975511965976 "
             "1.0471975511965976 0'/></keyframe></mujoco>");
  double height[2];
  heights(&c, height);
  assert_close(height[0], 0.0, 1e-6);
  for (size_t i = 0; i < ambulo_diagnostics_count(c.list); i++) {
    char text[2048] = "";
    ambulo_diagnostics_format(c.list, i, text, sizeof text);
    assert_null(strstr(text, "than in the source"));
  }
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_of_opensim),
      cmocka_unit_test(without_feet),
      cmocka_unit_test(asked_for),
      cmocka_unit_test(pose_of_a_robot),
      cmocka_unit_test(keyframe),
      cmocka_unit_test(keyframe_of_a_free_body),
      cmocka_unit_test(reference),
      cmocka_unit_test(a_start_that_stands),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
