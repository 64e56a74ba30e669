/* MuJoCo: every joint, geom and way to write a rotation, with torques that MuJoCo 4.0 computed (its
 * free joint as three sliders and three hinges, its ball as three hinges with its armature, damping
 * and friction each; friction smoothed as here). */
#include "support/import_case.h"

#define BODY "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>"
#define MODEL(inner) "<mujoco>\n<worldbody>\n" inner "</worldbody>\n</mujoco>\n"
#define HINGE(more) MODEL("<body name='b'>" BODY "\n<joint name='j' " more "/></body>")

/* joints that are polynomials of others, about references; one that is off is none */
static void functions_as_mujoco(void **state) {
  (void)state;
  static const double want[] = {5.24822137132024, 1.61252934878532};
  import_case c = import_file("tests/import/coupled_joints.xml", NULL);
  assert_int_equal(c.status, AMBULO_OK);
  assert_torques(c.model, want, 2, 1e-12);
  assert_told(&c, "1 of <equality> are left out");
  import_shut(&c);
}

/* y = 3 x: armature and damping by nine, dry friction by three; on a curve they are left out */
static void followers_pass_their_drives_on(void **state) {
#define FOLLOWED(coefficients)                                                                     \
  "<mujoco><worldbody><body name='a'><joint name='x' axis='0 0 1' armature='.01' damping='.1'/>"   \
  "<geom size='.1'/><body name='b'><joint name='y' axis='0 0 1' armature='.2' damping='.3' "       \
  "frictionloss='.5'/><geom size='.1'/></body></body></worldbody><equality>"                       \
  "<joint joint1='y' joint2='x' polycoef='" coefficients "'/></equality></mujoco>"
  import_case c = import_good(state, FOLLOWED("0 -3"));
  const ambulo_coordinate *x = ambulo_model_coordinate(c.model, 0);
  assert_int_equal(ambulo_model_coordinate_count(c.model), 1);
  assert_close(x->armature, .01 + 9 * .2, 1e-12);
  assert_close(x->damping, .1 + 9 * .3, 1e-12);
  assert_close(x->friction, 3 * .5, 1e-12);
  import_shut(&c);
  c = import_good(state, FOLLOWED("0 1 .5"));
  assert_close(ambulo_model_coordinate(c.model, 0)->armature, .01, 1e-12);
  assert_told(&c, "armature, damping and friction of 1 joints that follow others on curves");
  import_shut(&c);
}

static void as_mujoco(void **state) {
  (void)state;
  static const double want[] = {4.45988213124041,   -31.8283296199847,   312.697450895045,
                                0.220177175497207,  -1.18480615309464,   -0.559814706082123,
                                -2.06276428004688,  -1.63142247074675,   -6.46912929903552,
                                0.0932743194726421, 0.00710067021542821, 0.0619636955021647,
                                -1.95461922403152};
  import_case c = import_file("tests/import/every_joint.xml", NULL);
  assert_int_equal(c.status, AMBULO_OK);
  assert_torques(c.model, want, 13, 1e-12);
  assert_told(&c,
              "armature, damping and friction of 1 ball joints are those of each of their three "
              "hinges: MuJoCo's at 0");
  import_shut(&c);
}

static const ambulo_coordinate *named(const import_case *c, const char *name) {
  int i = ambulo_model_find_coordinate(c->model, name);
  if (i < 0) print_error("no coordinate %s\n", name);
  assert_true(i >= 0);
  return ambulo_model_coordinate(c->model, i);
}

/* ranges by class and of their own; torques by gear, by control and by force, within the joint's */
static void limits(void **state) {
  (void)state;
  import_case c = import_file("tests/import/every_joint.xml", NULL);
  const double degree = acos(-1) / 180;
  assert_close(named(&c, "lift")->range[0], -90 * degree, 1e-12);
  assert_close(named(&c, "twist")->range[1], 60 * degree, 1e-12);
  assert_close(named(&c, "reach")->range[1], 0.2, 1e-12);
  assert_true(isinf(named(&c, "wrist_x")->range[0]));
  assert_close(named(&c, "lift")->torque[1], 40, 0);
  assert_close(named(&c, "twist")->torque[0], -5, 0);
  assert_close(named(&c, "swing")->torque[0], -80, 0); /* -120 by control, -80 by the joint */
  assert_close(named(&c, "swing")->torque[1], 60, 0);  /* 60 by control, 70 by the joint */
  assert_int_equal(named(&c, "root_tx")->actuated, 0);
  assert_int_equal(named(&c, "swing")->actuated, 1);
  import_shut(&c);
}

static void expect_drive(const import_case *c, const char *name, double armature, double damping,
                         double friction) {
  assert_close(named(c, name)->armature, armature, 0);
  assert_close(named(c, name)->damping, damping, 0);
  assert_close(named(c, name)->friction, friction, 0);
}

/* by class and of their own; on three hinges of a ball; not on what moves a free body */
static void drives(void **state) {
  import_case c = import_good(
      state,
      "<mujoco><default><joint armature='0.5' stiffness='3'/><default class='arm'>"
      "<joint damping='2' frictionloss='0.25'/></default></default><worldbody><body name='b'>" BODY
      "<joint name='x' type='slide' damping='1'/><joint name='turn' armature='0'/>"
      "<body name='c'>" BODY "<joint name='plain'/><body name='d' childclass='arm'>" BODY
      "<joint name='arm'/><body name='e'>" BODY "<joint name='own' armature='4' damping='0 0 1' "
      "stiffness='0'/><body name='f'>" BODY "<joint name='ball' type='ball' stiffness='0'/>"
      "</body></body></body></body></body></worldbody></mujoco>");
  expect_drive(&c, "x", 0, 0, 0);
  expect_drive(&c, "turn", 0, 0, 0);
  expect_drive(&c, "plain", 0.5, 0, 0);
  expect_drive(&c, "arm", 0.5, 2, 0.25);
  expect_drive(&c, "own", 4, 0, 0.25);
  expect_drive(&c, "ball_x", 0.5, 2, 0.25);
  expect_drive(&c, "ball_z", 0.5, 2, 0.25);
  assert_told(&c, "stiffness of 4 joints is left out");
  assert_told(&c, "damping that grows faster than the speed of 1 joints is left out");
  assert_told(&c, "armature, damping and friction of 1 joints of the free root are left out");
  assert_told(&c, "armature, damping and friction of 1 ball joints are those of each");
  import_shut(&c);
  c = import_good(state, "<mujoco><default><joint armature='0.5'/></default><worldbody>"
                         "<body name='b'>" BODY "<joint name='r' type='free'/><body name='c'>" BODY
                         "<joint name='j'/></body></body></worldbody></mujoco>");
  expect_drive(&c, "r_tx", 0, 0, 0);
  expect_drive(&c, "j", 0.5, 0, 0);
  assert_told(&c, "armature, damping and friction of 1 joints of the free root are left out: no "
                  "drive is there to have them");
  import_shut(&c);
}

/* the joints of a root are free unless an actuator names them */
static void what_is_driven(void **state) {
  import_case c = import_good(
      state, "<mujoco><worldbody><body name='b'>" BODY "<joint name='x' type='slide'/>"
             "<joint name='turn'/><body name='leg'>" BODY "<joint name='hip'/></body></body>"
             "</worldbody><actuator><motor joint='hip'/><motor joint='turn'/></actuator></mujoco>");
  assert_int_equal(named(&c, "x")->actuated, 0);
  assert_int_equal(named(&c, "turn")->actuated, 1);
  assert_int_equal(named(&c, "hip")->actuated, 1);
  import_shut(&c);
}

static void mass_of(void **state, const char *geom, double mass, double xx, double zz) {
  char text[600];
  (void)snprintf(text, sizeof text, MODEL("<body name='b'><joint/>%s</body>"), geom);
  import_case c = import_good(state, text);
  const ambulo_link *b = ambulo_model_link(c.model, ambulo_model_find_link(c.model, "b"));
  assert_close(b->mass, mass, 1e-12);
  assert_close(b->inertia[0], xx, 1e-12);
  assert_close(b->inertia[2], zz, 1e-12);
  import_shut(&c);
}

/* closed forms at 1000 kg/m^3; the capsule is checked by MuJoCo above */
static void solids(void **state) {
  const double pi = acos(-1), r = 0.1, h = 0.3, ball = 4000.0 / 3 * pi * r * r * r;
  mass_of(state, "<geom size='0.1'/>", ball, 0.4 * ball * r * r, 0.4 * ball * r * r);
  double rod = 2000 * pi * r * r * h;
  mass_of(state, "<geom type='cylinder' size='.1 .3'/>", rod, rod * (r * r / 4 + h * h / 3),
          rod * r * r / 2);
  mass_of(state, "<geom type='box' size='0.1 0.2 0.3' mass='2'/>", 2, 2.0 / 3 * (0.04 + 0.09),
          2.0 / 3 * (0.01 + 0.04));
  mass_of(state, "<geom type='ellipsoid' size='0.1 0.2 0.3' mass='2'/>", 2, 0.4 * (0.04 + 0.09),
          0.4 * (0.01 + 0.04));
}

/* the settings of the compiler: which masses count, and how much they are in all */
static void settings(void **state) {
  import_case c = import_good(
      state, "<mujoco><compiler angle='radian' inertiafromgeom='true' settotalmass='7'/><worldbody>"
             "<body name='b'>" BODY "<joint name='j' range='-1 1'/><geom type='box' size='1 1 1'/>"
             "<geom size='3' group='3'/></body></worldbody></mujoco>");
  assert_close(ambulo_model_mass(c.model), 7, 1e-12);
  assert_close(named(&c, "j")->range[1], 1, 1e-8);
  import_shut(&c);
  c = import_good(state,
                  "<mujoco><compiler autolimits='false'/><worldbody><body>" BODY
                  "<joint name='j' range='-10 10'/></body><body>" BODY
                  "<joint name='k' range='-10 10' limited='true'/></body></worldbody></mujoco>");
  assert_true(isinf(named(&c, "j")->range[1]));
  assert_close(named(&c, "k")->range[1], acos(-1) / 18, 1e-8);
  import_shut(&c);
}

/* no gravity, limits that are none, a mass that is none: said, and a model all the same */
static void what_is_as_good_as_none(void **state) {
  import_case c = import_good(
      state,
      "<mujoco><compiler angle='radian'/><option><flag gravity='disable'/></option><worldbody>"
      "<body name='b'>" BODY "<joint name='j' range='-1e16 2'/><body name='speck'>"
      "<joint name='k'/><geom size='1e-5'/></body></body></worldbody></mujoco>");
  assert_told(&c, "gravity is 0 m/s^2 in the source: it is 9.81 here, along -z");
  assert_told(&c, "speck: its mass of 4.188");
  assert_close(ambulo_model_gravity(c.model)[2], -9.81, 0);
  assert_true(isinf(named(&c, "j")->range[0]));
  assert_close(named(&c, "j")->range[1], 2, 1e-7);
  import_shut(&c);
}

static void what_is_wrong(void **state) {
  static const struct {
    const char *xml;
    ambulo_status status;
    const char *said;
  } wrong[] = {
      {HINGE("type='screw'"), AMBULO_E_SCHEMA,
       "t.xml:4:1: error[E_SCHEMA]: unknown type of joint (got 'screw'); expected one of free, "
       "ball, slide, hinge"},
      {HINGE("axis='0 0 0'"), AMBULO_E_MODEL, "the axis of joint 'j' has no direction"},
      {HINGE("range='10 -10'"), AMBULO_E_MODEL,
       "the range of 'j' contradicts itself (got 10 to -10)"},
      {HINGE("armature='-1'"), AMBULO_E_MODEL,
       "armature of 'j' is out of range (got -1); expected 0 to 1e9"},
      {HINGE("pos='0 0'"), AMBULO_E_SCHEMA, "pos of <joint> has 2 numbers; expected 3"},
      {HINGE("limited='maybe'"), AMBULO_E_SCHEMA, "unknown limited (got 'maybe')"},
      {MODEL("<body><joint/>\n<geom type='mesh' mesh='m'/></body>"), AMBULO_E_MODEL,
       "t.xml:4:1: error[E_MODEL]: the mass of a body comes from a mesh"},
      {MODEL("<body><joint/><geom size='-1'/></body>"), AMBULO_E_MODEL,
       "a size of <geom> is not positive"},
      {MODEL("<body><joint/><geom type='box' size='1 1'/></body>"), AMBULO_E_SCHEMA,
       "size of <geom> has 2 numbers; expected 3"},
      {MODEL("<body><joint/><geom size='1' mass='-1'/></body>"), AMBULO_E_MODEL,
       "the mass of <geom> is negative"},
      {MODEL("<body><joint/><inertial pos='0 0 0' mass='1'/></body>"), AMBULO_E_SCHEMA,
       "has a mass but no inertia; expected diaginertia or fullinertia"},
      {MODEL("<body quat='0 0 0 0'><joint/></body>"), AMBULO_E_MODEL,
       "the orientation of <body> has no direction"},
      {MODEL("<replicate count='3'/>"), AMBULO_E_SCHEMA, "<replicate> generates bodies"},
      {"<mujoco><compiler eulerseq='xyw'/></mujoco>", AMBULO_E_SCHEMA,
       "eulerseq of <compiler> is 'xyw'"},
      {"<mujoco><worldbody><body>" BODY "</body></worldbody></mujoco>", AMBULO_E_MODEL,
       "the model cannot move (got 1 links, none with a coordinate)"},
      {MODEL("<body><joint/></body>"), AMBULO_E_MODEL, "the model has no mass"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    import_bad(state, wrong[i].xml, wrong[i].status, wrong[i].said);
}

/* what a body has by its inertial, by its geoms, or by either; names that are made up */
static void masses(void **state) {
  static const struct {
    const char *compiler, *inertial;
    double mass;
  } cases[] = {{"", BODY, 1},
               {"", "", 3},
               {"inertiafromgeom='auto'", BODY, 1},
               {"inertiafromgeom='true'", BODY, 3},
               {"inertiafromgeom='false'", BODY, 1},
               {"inertiafromgeom='false' boundmass='7'", "", 7},
               {"", "<inertial pos='0 0 0' mass='2' fullinertia='1 1 1 0 0 0'/>", 2},
               {"boundmass='4'", "<inertial pos='0 0 0' mass='0'/>", 4}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[900];
    (void)snprintf(text, sizeof text,
                   "<mujoco><compiler %s boundinertia='0.01'/><worldbody><frame><body>%s<joint/>"
                   "<joint name='' type='slide' ref='0.5'/><geom size='1' mass='3'/></body></frame>"
                   "</worldbody></mujoco>",
                   cases[i].compiler, cases[i].inertial);
    import_case c = import_good(state, text);
    assert_close(ambulo_model_mass(c.model), cases[i].mass, 1e-12);
    assert_true(ambulo_model_find_link(c.model, "body_1") >= 0);
    assert_close(named(&c, "body_1_joint2")->default_value, 0.5, 0);
    import_shut(&c);
  }
  import_bad(state, MODEL("<body name='b'>\n<inertial diaginertia='1 1 1'/><joint/></body>"),
             AMBULO_E_SCHEMA,
             "t.xml:4:1: error[E_SCHEMA]: <inertial> of body 'b' has no mass; expected mass=...");
}

/* a keyframe gives what it has: the rest stands as without it; a turn of zeros is none */
static void keyframes_that_are_short(void **state) {
  static const struct {
    const char *key;
    double start[2]; /* of the first of the ball's, and of the hinge */
  } cases[] = {{"<key qpos='0.9553364891256 0.2955202066613 0 0 0.25'/>", {0.6, 0.25}},
               {"<key name='' qpos='0 0 0 0 0.25'/>", {0, 0.25}},
               {"<key qpos='0.9553364891256 0.2955202066613 0 0'/>", {0.6, 0}},
               {"<key qpos='1 0'/>", {0, 0}},
               {"<key/>", {0, 0}},
               {"", {0, 0}}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[900];
    (void)snprintf(text, sizeof text,
                   "<mujoco><worldbody><body name='b'>" BODY "<joint name='ball' type='ball'/>"
                   "<body name='c'>" BODY "<joint name='j'/></body></body></worldbody>"
                   "<keyframe>%s</keyframe></mujoco>",
                   cases[i].key);
    import_case c = import_good(state, text);
    assert_close(named(&c, "ball_x")->default_value, cases[i].start[0], 1e-8);
    assert_close(named(&c, "j")->default_value, cases[i].start[1], 1e-8);
    if (i < 4) assert_told(&c, "the start pose is that of keyframe '0'");
    import_shut(&c);
  }
  import_bad(state, MODEL(""), AMBULO_E_MODEL, "the model cannot move");
}

static void included_files(void **state) {
  scratch_write(scratch_path(state, "leg.xml"), "<mujocoinclude><body name='leg'>" BODY
                                                "<joint name='hip'/></body></mujocoinclude>");
  scratch_write(scratch_path(state, "loop.xml"),
                "<mujocoinclude><include file='loop.xml'/></mujocoinclude>");
  import_case c = import_good(state, MODEL("<include file='leg.xml'/>"));
  assert_string_equal(ambulo_model_coordinate(c.model, 0)->name, "hip");
  import_shut(&c);
  import_bad(state, MODEL("<include file='leg.xml'/><include file='leg.xml'/>"), AMBULO_E_SCHEMA,
             "'leg.xml' is included twice");
  import_bad(state, MODEL("<include file='loop.xml'/>"), AMBULO_E_SCHEMA,
             "'loop.xml' is included twice");
  import_bad(state, MODEL("<include file='none.xml'/>"), AMBULO_E_IO,
             "the included file 'none.xml' could not be read");
  import_bad(state, MODEL("<include/>"), AMBULO_E_SCHEMA, "<include> names no file");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(as_mujoco),
                                     cmocka_unit_test(drives),
                                     cmocka_unit_test(functions_as_mujoco),
                                     cmocka_unit_test(followers_pass_their_drives_on),
                                     cmocka_unit_test(limits),
                                     cmocka_unit_test(what_is_driven),
                                     cmocka_unit_test(solids),
                                     cmocka_unit_test(settings),
                                     cmocka_unit_test(what_is_as_good_as_none),
                                     cmocka_unit_test(masses),
                                     cmocka_unit_test(keyframes_that_are_short),
                                     cmocka_unit_test(what_is_wrong),
                                     cmocka_unit_test(included_files)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
