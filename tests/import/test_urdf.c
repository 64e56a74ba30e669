/* URDF: every kind of joint with torques that Pinocchio 4.1 computed (damping and friction
 * added by hand), trees that are none, and what
 * stands in the model. */
#include "support/import_case.h"

#define LINK(name)                                                                                 \
  "<link name='" name "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "     \
  "iyz='0' izz='1'/></inertial></link>\n"
#define JOINT(name, type, parent, child, more)                                                     \
  "<joint name='" name "' type='" type "'><parent link='" parent "'/><child link='" child          \
  "'/>" more "</joint>\n"
#define ROBOT(inner) "<robot name='r'>\n" inner "</robot>\n"

static void as_pinocchio(void **state) {
  (void)state;
  static const double want[] = {0.988589328680417,  -14.465962664171,  117.039594300423,
                                -0.360614237212602, 1.23939168558925,  -0.46672402965333,
                                1.54217612610846,   0.250990255000786, -14.9041709783741};
  import_case c = import_file("tests/import/every_joint.urdf", NULL);
  assert_int_equal(c.status, AMBULO_OK);
  assert_torques(c.model, want, 9, 1e-12);
  assert_string_equal(ambulo_model_name(c.model), "every_joint");
  const ambulo_coordinate *hip = ambulo_model_coordinate(c.model, 6);
  assert_string_equal(hip->name, "hip");
  assert_close(hip->range[1], 120 * acos(-1) / 180, 1e-12); /* 2.0943951 rad */
  assert_close(hip->torque[0], -120, 0);
  assert_close(hip->speed[1], 7, 1e-7);
  assert_true(isinf(ambulo_model_coordinate(c.model, 7)->range[0]));
  assert_non_null(strstr(c.text, "coupled: {to: hip, polynomial: [14.3239448782706, 0.5]}"));
  assert_close(hip->damping, 0.5, 0);
  assert_close(hip->friction, 0.8, 0);
  import_shut(&c);
}

static void roots(void **state) {
  ambulo_import_options options = ambulo_import_options_default();
  const char *arm = ROBOT(LINK("plinth") LINK("arm")
                              JOINT("j", "continuous", "plinth", "arm", "<axis xyz='0 0 1'/>"));
  import_case c = import_text(state, arm, &options);
  assert_int_equal(ambulo_model_coordinate_count(c.model), 7);
  assert_int_equal(ambulo_model_coordinate(c.model, 0)->actuated, 0);
  assert_int_equal(ambulo_model_coordinate(c.model, 6)->actuated, 1);
  import_shut(&c);
  options.root = AMBULO_ROOT_FIXED;
  c = import_text(state, arm, &options);
  assert_int_equal(ambulo_model_coordinate_count(c.model), 1);
  import_shut(&c);
  options.root = AMBULO_ROOT_AS_IS;
  c = import_text(
      state, ROBOT("<link name='world'/>" LINK("arm") JOINT("j", "continuous", "world", "arm", "")),
      &options);
  assert_int_equal(ambulo_model_coordinate_count(c.model), 1);
  import_shut(&c);
}

static void planar_and_floating(void **state) {
  import_case c =
      import_good(state, ROBOT("<link name='world'/>" LINK("a") LINK("b")
                                   JOINT("p", "planar", "world", "a", "<axis xyz='0 1 0'/>")
                                       JOINT("f", "floating", "a", "b", "")));
  static const char *const names[] = {"p_first", "p_second", "p_turn", "f_tx",      "f_ty",
                                      "f_tz",    "f_tilt",   "f_list", "f_rotation"};
  assert_int_equal(ambulo_model_coordinate_count(c.model), 9);
  for (int i = 0; i < 9; i++)
    assert_string_equal(ambulo_model_coordinate(c.model, i)->name, names[i]);
  /* a mass of 2 kg that falls pulls at the sliders across y: x, and -z or z */
  double zero[9] = {0}, tau[9];
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_mechanics_create(c.model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, 1, zero, zero, zero,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau}),
                   AMBULO_OK);
  assert_close(tau[0], 0, 1e-12);
  assert_close(fabs(tau[1]), 2 * 9.81, 1e-12);
  assert_close(tau[5], 9.81, 1e-12);
  ambulo_mechanics_free(mechanics);
  import_shut(&c);
}

static void trees_that_are_none(void **state) {
  import_bad(state, ROBOT(LINK("a") LINK("b")), AMBULO_E_MODEL,
             "t.xml:3:1: error[E_MODEL]: two roots: no joint has 'a' (line 2) or 'b' as its child; "
             "expected one");
  import_bad(
      state,
      ROBOT(LINK("a") LINK("b") LINK("c") JOINT("1", "fixed", "a", "c", "")
                JOINT("2", "fixed", "b", "c", "")),
      AMBULO_E_MODEL,
      "t.xml:6:1: error[E_MODEL]: link 'c' is the child of two joints ('1', line 5, and '2'); "
      "expected a tree");
  import_bad(state,
             ROBOT(LINK("a") LINK("b") JOINT("1", "fixed", "a", "b", "")
                       JOINT("2", "fixed", "b", "a", "")),
             AMBULO_E_MODEL, "t.xml:1:1: error[E_MODEL]: every link is the child of a joint");
  import_bad(state,
             ROBOT(LINK("a") LINK("b") LINK("c") JOINT("1", "fixed", "c", "b", "")
                       JOINT("2", "fixed", "b", "c", "")),
             AMBULO_E_MODEL, "hangs on itself through its parents; expected a tree");
  import_bad(state, ROBOT(LINK("a") LINK("a")), AMBULO_E_MODEL,
             "t.xml:3:1: error[E_MODEL]: two links are named 'a' (the first one at line 2)");
  import_bad(state, ROBOT(LINK("thigh") LINK("b") JOINT("1", "fixed", "tigh", "b", "")),
             AMBULO_E_MODEL, "hint: did you mean 'thigh'?");
  import_bad(state, ROBOT(""), AMBULO_E_MODEL, "the robot has no links");
  import_bad(state, ROBOT("<link/>"), AMBULO_E_SCHEMA,
             "t.xml:2:1: error[E_SCHEMA]: a link has no name");
  import_bad(state, ROBOT(LINK("a") "<joint name='j' type='fixed'><child link='a'/></joint>"),
             AMBULO_E_SCHEMA, "joint 'j' has no <parent link=...>");
}

#define ARM(more) ROBOT(LINK("a") LINK("b") more)
#define BODY(inertial)                                                                             \
  ROBOT(LINK("a") "<link name='b'>\n<inertial>" inertial                                           \
                  "</inertial></link>\n" JOINT("j", "continuous", "a", "b", ""))

static void joints_that_are_wrong(void **state) {
  import_bad(state, ARM(JOINT("j", "hinge", "a", "b", "")), AMBULO_E_SCHEMA,
             "t.xml:4:1: error[E_SCHEMA]: unknown type of joint (got 'hinge'); expected one of "
             "revolute, continuous, prismatic, fixed, floating, planar");
  import_bad(state, ARM(JOINT("j", "revolute", "a", "b", "<axis xyz='0 0 0'/>")), AMBULO_E_MODEL,
             "the axis of joint 'j' has no direction");
  import_bad(state, ARM(JOINT("j", "revolute", "a", "b", "<axis xyz='0 1'/>")), AMBULO_E_SCHEMA,
             "xyz of <axis> has 2 numbers; expected 3");
  import_bad(state, ARM(JOINT("j", "revolute", "a", "b", "<axis xyz='0 x 1'/>")), AMBULO_E_SCHEMA,
             "xyz of <axis> is not a number (got 'x'); expected a finite number");
  import_bad(state, ARM(JOINT("j", "revolute", "a", "b", "<limit lower='1' upper='-1'/>")),
             AMBULO_E_MODEL, "the range of 'j' contradicts itself (got 1 to -1)");
  import_bad(state, ARM(JOINT("j", "revolute", "a", "b", "<mimic multiplier='2'/>")),
             AMBULO_E_SCHEMA, "<mimic> of joint 'j' names no joint");
  import_bad(state, ROBOT("<xacro:macro name='leg'/>"), AMBULO_E_SCHEMA,
             "hint: expand it first: xacro FILE.xacro > robot.urdf");
}

static void bodies_that_are_wrong(void **state) {
  import_bad(state,
             BODY("<mass value='-2'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"),
             AMBULO_E_MODEL, "t.xml:4:11: error[E_MODEL]: mass of 'b'");
  import_bad(state, BODY("<mass value='2'/>"), AMBULO_E_SCHEMA,
             "t.xml:4:1: error[E_SCHEMA]: <inertial> of link 'b' has a mass but no inertia");
  import_bad(state, BODY("<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"),
             AMBULO_E_SCHEMA, "<inertial> of link 'b' has no mass");
  import_bad(state, BODY("<mass value='2'/><inertia ixx='1' iyy='1'/>"), AMBULO_E_SCHEMA,
             "<inertia> of link 'b' has no izz");
  import_bad(state,
             BODY("<mass value='2'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='9'/>"),
             AMBULO_E_MODEL, "inertia of 'b' breaks the triangle inequality");
  import_bad(state, BODY("<mass value='nan'/>"), AMBULO_E_SCHEMA,
             "value of <mass> is not a number");
}

/* 1 + t + 1 + t = 9 + t with t = 7: just possible, and said */
static void inertia_is_repaired(void **state) {
  ambulo_import_options options = ambulo_import_options_default();
  options.repair_inertia = 1;
  import_case c = import_text(
      state, BODY("<mass value='2'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='9'/>"),
      &options);
  assert_int_equal(c.status, AMBULO_OK);
  assert_told(&c, "b: its inertia is impossible: 7 kg m^2 were added to its moments");
  const ambulo_link *b = ambulo_model_link(c.model, ambulo_model_find_link(c.model, "b"));
  assert_close(b->inertia[2], 16, 1e-8);
  import_shut(&c);
}

/* limits: positive ones count; a range is of hinges and sliders that have <limit> */
static void limits(void **state) {
  import_case c = import_good(
      state, ROBOT(LINK("a") LINK("b") LINK("c") LINK("d") LINK("e")
                       JOINT("1", "revolute", "a", "b", "<limit effort='0' velocity='-2'/>") JOINT(
                           "2", "prismatic", "b", "c", "<limit upper='3'/><dynamics friction='1'/>")
                           JOINT("3", "revolute", "c", "d", "<dynamics damping='1'/>")
                               JOINT("4", "continuous", "d", "e",
                                     "<limit lower='-1' upper='1' effort='5'/><dynamics/>")));
  const ambulo_coordinate *q[5];
  for (int i = 1; i <= 4; i++)
    q[i] = ambulo_model_coordinate(
        c.model, ambulo_model_find_coordinate(c.model, (char[]){(char)('0' + i), '\0'}));
  assert_true(isinf(q[1]->torque[0]) && isinf(q[1]->torque[1]) && isinf(q[1]->speed[1]));
  assert_close(q[1]->range[1], 0, 0);
  assert_close(q[2]->range[0], 0, 0);
  assert_close(q[2]->range[1], 3, 0);
  assert_true(isinf(q[3]->range[0]));
  assert_true(isinf(q[4]->range[0]) && isinf(q[4]->range[1]));
  assert_close(q[4]->torque[0], -5, 0);
  assert_close(q[2]->friction, 1, 0);
  assert_close(q[3]->damping, 1, 0);
  assert_close(q[4]->damping, 0, 0);
  assert_told(&c, "1 joints have no <limit>: their coordinates have no range");
  import_shut(&c);
}

/* joints that follow: a slider, one that follows another that follows, one that is not there, and
 * two that follow each other */
static void followers(void **state) {
  static const struct {
    const char *type, *mimic, *other, *text, *said;
  } cases[] = {{"prismatic", "joint='lead' multiplier='-2' offset='1'", "",
                "coupled: {to: lead, polynomial: [1, -0.0349065850398866]}", NULL},
               {"revolute", "joint='other' multiplier='2' offset='1'",
                "<mimic joint='lead' multiplier='3' offset='-1'/>",
                "coupled: {to: lead, polynomial: [-57.2957795130823, 6]}", NULL},
               {"revolute", "joint='none' offset='0.5'", "", NULL,
                "follow follows none, which does not move: it is held at 0.5"},
               {"revolute", "joint='other'", "<mimic joint='follow'/>", NULL,
                "which follows it in turn: it is held at 0"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[2000];
    (void)snprintf(
        text, sizeof text,
        ROBOT(LINK("a") LINK("b") LINK("c") LINK("d") JOINT("lead", "revolute", "a", "b", "") JOINT(
            "follow", "%s", "b", "c", "<mimic %s/>") JOINT("other", "revolute", "b", "d", "%s")),
        cases[i].type, cases[i].mimic, cases[i].other);
    import_case c = import_good(state, text);
    if (cases[i].said) assert_told(&c, cases[i].said);
    if (cases[i].text) assert_non_null(strstr(c.text, cases[i].text));
    assert_true(ambulo_model_find_coordinate(c.model, "follow") < 0);
    import_shut(&c);
  }
}

/* a sole of what collides; geometry without its sizes is none */
static void soles(void **state) {
  static const struct {
    const char *geometry;
    double length;
  } cases[] = {{"<box size='0.2 0.1 0.05'/>", 0.2},
               {"<box/>", 0},
               {"<sphere radius='0.05'/>", 0.1},
               {"<sphere/>", 0},
               {"<cylinder radius='0.05' length='0.02'/>", 0.1},
               {"<cylinder radius='0.05'/>", 0},
               {"<capsule radius='0.05' length='0.02'/>", 0.1},
               {"<mesh/>", 0},
               {"<mesh filename='none.stl' scale='1 1 1'/>", 0},
               {"", 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[1600];
    (void)snprintf(
        text, sizeof text,
        ROBOT(LINK("base") "<link name='foot_r'><inertial><mass value='1'/><inertia "
                           "ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"
                           "<collision/><collision><origin xyz='0 0 -0.1'/><geometry>%s"
                           "</geometry></collision></link>" JOINT("hip", "continuous", "base",
                                                                  "foot_r", "<axis xyz='0 1 0'/>")),
        cases[i].geometry);
    import_case c = import_good(state, text);
    assert_int_equal(ambulo_model_foot_count(c.model), cases[i].length > 0);
    import_shut(&c);
  }
}

static void ends_of_joints(void **state) {
  import_bad(state, ROBOT(LINK("a") "<joint name='j' type='fixed'><parent link='a'/></joint>"),
             AMBULO_E_SCHEMA, "joint 'j' has no <child link=...>");
  import_bad(state, ROBOT(LINK("a") LINK("b") JOINT("j", "fixed", "a", "c", "")), AMBULO_E_MODEL,
             "unknown child link of joint 'j' (got 'c'); expected a link of this robot");
  import_bad(state,
             ROBOT(LINK("a") LINK("b") "<joint name='j'><parent link='a'/><child link='b'/>"
                                       "</joint>"),
             AMBULO_E_SCHEMA, "unknown type of joint (got '')");
  import_bad(state,
             ROBOT(LINK("a") LINK("b") JOINT("j", "planar", "a", "b", "<axis xyz='0 0 0'/>")),
             AMBULO_E_MODEL, "the axis of joint 'j' has no direction");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(as_pinocchio),
                                     cmocka_unit_test(roots),
                                     cmocka_unit_test(planar_and_floating),
                                     cmocka_unit_test(trees_that_are_none),
                                     cmocka_unit_test(joints_that_are_wrong),
                                     cmocka_unit_test(bodies_that_are_wrong),
                                     cmocka_unit_test(inertia_is_repaired),
                                     cmocka_unit_test(limits),
                                     cmocka_unit_test(followers),
                                     cmocka_unit_test(soles),
                                     cmocka_unit_test(ends_of_joints)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
