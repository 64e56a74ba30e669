/* OpenSim models that are no trees, and what is said of them; frames; masses; what touches. */
#include "support/import_case.h"

#define V4(bodies, joints, more)                                                                   \
  "<OpenSimDocument Version='40000'>\n<Model name='m'>\n<BodySet><objects>\n" bodies               \
  "</objects></BodySet>\n<JointSet><objects>\n" joints "</objects></JointSet>\n" more              \
  "</Model></OpenSimDocument>\n"
#define BODY(name)                                                                                 \
  "<Body name='" name                                                                              \
  "'><mass>1</mass><mass_center>0 0 0</mass_center><inertia>1 1 1 0 0 0</inertia>"                 \
  "</Body>\n"
#define PIN(name, parent, child)                                                                   \
  "<PinJoint name='" name "'><socket_parent_frame>" parent "</socket_parent_frame>"                \
  "<socket_child_frame>" child "</socket_child_frame><coordinates><Coordinate name='q_" name       \
  "'/></coordinates></PinJoint>\n"

static void trees_that_are_none(void **state) {
  import_bad(
      state,
      V4(BODY("a") BODY("b"), PIN("1", "ground", "a") PIN("2", "a", "b") PIN("3", "ground", "b"),
         ""),
      AMBULO_E_MODEL,
      "t.xml:10:1: error[E_MODEL]: body 'b' is the child of two joints ('2', line 9, and '3')");
  import_bad(state, V4(BODY("a") BODY("b"), PIN("1", "a", "b") PIN("2", "b", "a"), ""),
             AMBULO_E_MODEL, "body 'a' hangs on itself through its parents; expected a tree");
  import_bad(state, V4(BODY("a"), PIN("1", "a", "ground"), ""), AMBULO_E_MODEL,
             "the ground is the child of joint '1'");
  import_bad(state, V4(BODY("a") BODY("a"), "", ""), AMBULO_E_MODEL,
             "two bodies are named 'a' (the first one at line 4)");
  import_bad(state, V4(BODY("tibia"), PIN("1", "ground", "/bodyset/tibio"), ""), AMBULO_E_MODEL,
             "hint: did you mean 'tibia'?");
  import_bad(state,
             V4(BODY("a"),
                "<ScrewJoint name='s'><socket_parent_frame>ground</socket_parent_frame>"
                "<socket_child_frame>a</socket_child_frame></ScrewJoint>\n",
                ""),
             AMBULO_E_SCHEMA,
             "t.xml:7:1: error[E_SCHEMA]: unknown joint (got 'ScrewJoint'); expected one of "
             "WeldJoint, PinJoint");
  import_bad(state,
             V4(BODY("a"),
                "<UniversalJoint name='u'><socket_parent_frame>ground</socket_parent_frame>"
                "<socket_child_frame>a</socket_child_frame></UniversalJoint>\n",
                ""),
             AMBULO_E_SCHEMA, "<UniversalJoint> 'u' has 0 coordinates; expected 2");
  import_bad(state, "<OpenSimDocument><ControlSet/></OpenSimDocument>", AMBULO_E_SCHEMA,
             "this OpenSim file holds no model (got <ControlSet>)");
}

static void bodies_that_are_wrong(void **state) {
  import_bad(state, V4("<Body name='a'><mass>1</mass></Body>\n", PIN("1", "ground", "a"), ""),
             AMBULO_E_SCHEMA, "t.xml:4:1: error[E_SCHEMA]: body 'a' has a mass but no inertia");
  import_bad(state, V4("<Body name='a'/>\n", PIN("1", "ground", "a"), ""), AMBULO_E_SCHEMA,
             "body 'a' has no mass");
  import_bad(state,
             V4("<Body name='a'><mass>-1</mass><inertia>1 1 1 0 0 0</inertia></Body>\n",
                PIN("1", "ground", "a"), ""),
             AMBULO_E_MODEL, "t.xml:4:16: error[E_MODEL]: mass of 'a' is out of range (got -1 kg)");
  import_bad(state,
             V4("<Body name='a'><mass>one</mass><inertia>1 1 1 0 0 0</inertia></Body>\n",
                PIN("1", "ground", "a"), ""),
             AMBULO_E_SCHEMA, "the text of <mass> is not a number (got 'one')");
}

static void joints_that_are_wrong(void **state) {
  import_bad(state,
             V4("<Body name='a'><mass>1</mass><inertia>1 1 1 0 0 0</inertia><Joint>\n"
                "<PinJoint name='p'><parent_body>ground</parent_body><reverse>true</reverse>"
                "<CoordinateSet><objects><Coordinate name='q'/></objects></CoordinateSet>"
                "</PinJoint></Joint></Body>\n",
                "", ""),
             AMBULO_E_MODEL,
             "t.xml:5:1: error[E_MODEL]: joint 'p' is reversed; expected the parent to come first");
  import_bad(state, V4("<Muscle/>\n", "", ""), AMBULO_E_SCHEMA,
             "t.xml:4:1: error[E_SCHEMA]: unknown object in BodySet (got <Muscle>)");
  import_bad(state,
             V4(BODY("a"), PIN("1", "ground", "loop"),
                "<ComponentSet><objects><PhysicalOffsetFrame name='loop'><socket_parent>loop"
                "</socket_parent></PhysicalOffsetFrame></objects></ComponentSet>"),
             AMBULO_E_MODEL, "unknown frame (got 'loop'); expected a body, or a frame");
  import_bad(state, "<OpenSimDocument/>", AMBULO_E_SCHEMA,
             "this OpenSim file holds no model (got <nothing>)");
  import_bad(state,
             V4("<Body name='a'><mass>1</mass><inertia_xx>1</inertia_xx><inertia_yy>1"
                "</inertia_yy></Body>\n",
                PIN("1", "ground", "a"), ""),
             AMBULO_E_SCHEMA, "expected <inertia> with six numbers, or <inertia_zz>");
  import_bad(state,
             V4(BODY("a"),
                "<CustomJoint name='c'><socket_parent_frame>ground</socket_parent_frame>"
                "<socket_child_frame>a</socket_child_frame><SpatialTransform>\n"
                "<TransformAxis/></SpatialTransform></CustomJoint>\n",
                ""),
             AMBULO_E_SCHEMA, "unknown transform axis (got '')");
}

/* moments one by one; products may be left out; a massless body needs none */
static void moments_one_by_one(void **state) {
  import_case c = import_good(
      state, V4("<Body name='a'><mass>1</mass><inertia_xx>1</inertia_xx><inertia_yy>2</inertia_yy>"
                "<inertia_zz>2.5</inertia_zz><inertia_xy>0.25</inertia_xy></Body>\n"
                "<Body name='b'><mass>0</mass></Body>\n",
                PIN("1", "ground", "a") PIN("2", "a", "b"), ""));
  const ambulo_link *a = ambulo_model_link(c.model, ambulo_model_find_link(c.model, "a"));
  static const double want[] = {1, 2, 2.5, 0.25, 0, 0};
  for (int i = 0; i < 6; i++) assert_close(a->inertia[i], want[i], 1e-12);
  import_shut(&c);
}

/* an axis without a function, one that nothing drives, one that is held off, one that drives two */
static void axes_of_custom_joints(void **state) {
#define AXIS(name, inner) "<TransformAxis name='" name "'>" inner "</TransformAxis>"
#define LINE(slope, offset)                                                                        \
  "<LinearFunction><coefficients>" slope " " offset "</coefficients></LinearFunction>"
  import_case c = import_good(
      state,
      V4(BODY("a"),
         "<CustomJoint name='c'><socket_parent_frame>ground</socket_parent_frame>"
         "<socket_child_frame>a</socket_child_frame><coordinates><Coordinate name='q'/>"
         "<Coordinate name='idle'/></coordinates><SpatialTransform>\n" AXIS(
             "rotation1", "<coordinates>q</coordinates>" LINE("2", "0.5"))
             AXIS("rotation2", "<Constant><value>0.25</value></Constant>")
                 AXIS("rotation3", "<coordinates>idle</coordinates><Constant><value>0</value>"
                                   "</Constant>")
                     AXIS("translation1", "<SimmSpline><x>0 1 2</x><y>0.125 1 4</y></SimmSpline>")
                         AXIS("translation2", "<coordinates>q</coordinates>" LINE("1", "0"))
                             AXIS("translation3", "") "</SpatialTransform></CustomJoint>\n",
         ""));
  assert_int_equal(ambulo_model_coordinate_count(c.model), 1);
  assert_told(&c, "idle drives no axis linearly: it is left out, and its joint is held at 0");
  assert_non_null(strstr(c.text, "0.125"));
  import_shut(&c);
}

#define CUSTOM(axis)                                                                               \
  V4(BODY("a"),                                                                                    \
     "<CustomJoint name='c'><socket_parent_frame>ground</socket_parent_frame>"                     \
     "<socket_child_frame>a</socket_child_frame><coordinates><Coordinate name='q'/>"               \
     "</coordinates><SpatialTransform>\n" axis "</SpatialTransform></CustomJoint>\n",              \
     "")

static void custom_joints_that_are_wrong(void **state) {
  import_bad(state, CUSTOM("<TransformAxis name='rotation4'/>"), AMBULO_E_SCHEMA,
             "t.xml:8:1: error[E_SCHEMA]: unknown transform axis (got 'rotation4')");
  import_bad(state, CUSTOM("<TransformAxis name='rotation1'><axis>0 0 0</axis></TransformAxis>"),
             AMBULO_E_MODEL, "the axis of joint 'c' has no direction");
  import_bad(state,
             CUSTOM("<TransformAxis name='rotation1'><coordinates>r</coordinates></TransformAxis>"),
             AMBULO_E_MODEL, "unknown coordinate of joint 'c' (got 'r')");
}

/* a chain of offset frames: 0.1 along x, turned by 90 degrees about z, then 0.2 along its x */
static void frames_on_frames(void **state) {
  import_case c = import_good(
      state,
      V4(BODY("a") BODY("b"),
         PIN("1", "ground",
             "a") "<PinJoint "
                  "name='2'><socket_parent_frame>outer</socket_parent_frame><socket_child_frame>b"
                  "</socket_child_frame><coordinates><Coordinate name='q'/></coordinates><frames>"
                  "<PhysicalOffsetFrame "
                  "name='outer'><socket_parent>inner</socket_parent><translation>0.2 0 0"
                  "</translation></PhysicalOffsetFrame><PhysicalOffsetFrame "
                  "name='inner'><socket_parent>"
                  "/bodyset/a</socket_parent><translation>0.1 0 0</translation><orientation>0 0 "
                  "1.5707963267948966</orientation></PhysicalOffsetFrame></frames></PinJoint>\n",
         ""));
  assert_non_null(strstr(c.text, "origin: {xyz: [0.1, 0.2, 0], rpy: [0, 0, 90]}"));
  import_shut(&c);
}

/* two bodies on the ground: one fixed root; a body without a joint floats, and that is said */
static void several_roots(void **state) {
  import_case c = import_good(state, V4(BODY("a") BODY("b"), PIN("1", "ground", "a"), ""));
  assert_string_equal(ambulo_model_link(c.model, 0)->name, "ground");
  assert_int_equal(ambulo_model_coordinate_count(c.model), 7);
  assert_told(&c, "b has no joint: it gets six coordinates");
  import_shut(&c);
}

/* spheres at heel and toe, by the names of either version; the toes have no joint of their own */
static void contact_spheres(void **state) {
#define SPHERE(frame, at, radius)                                                                  \
  "<ContactSphere name='s'>" frame "<location>" at "</location><radius>" radius                    \
  "</radius></ContactSphere>"
#define ON(body) "<socket_frame>/bodyset/" body "</socket_frame>"
  import_case c = import_good(
      state,
      V4(BODY("pelvis") BODY("calcn_r") BODY("calcn_l"),
         PIN("0", "ground", "pelvis") PIN("1", "pelvis", "calcn_r") PIN("2", "pelvis", "calcn_l"),
         "<ContactGeometrySet><objects>" SPHERE(ON("calcn_r"), "-0.02 0.03 0", "0.04")
             SPHERE(ON("calcn_r"), "0.18 0.02 0", "0.03") SPHERE("<body_name>calcn_l</body_name>",
                                                                 "-0.02 0.03 0", "0.04")
                 SPHERE("<body_name>calcn_l</body_name>", "0.18 0.02 0.02",
                        "0.03") "<ContactHalfSpace name='floor'/></objects></ContactGeometrySet>"));
  const ambulo_point *heel =
      ambulo_model_point(c.model, ambulo_model_find_point(c.model, "right_heel"));
  const ambulo_point *toe =
      ambulo_model_point(c.model, ambulo_model_find_point(c.model, "left_toe"));
  assert_non_null(heel);
  assert_non_null(toe);
  assert_close(heel->position[0], -0.02, 1e-12);
  assert_close(heel->position[1], -0.01, 1e-12);
  assert_close(toe->position[0], 0.18, 1e-12);
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(trees_that_are_none),   cmocka_unit_test(bodies_that_are_wrong),
      cmocka_unit_test(joints_that_are_wrong), cmocka_unit_test(moments_one_by_one),
      cmocka_unit_test(axes_of_custom_joints), cmocka_unit_test(custom_joints_that_are_wrong),
      cmocka_unit_test(frames_on_frames),      cmocka_unit_test(several_roots),
      cmocka_unit_test(contact_spheres)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
