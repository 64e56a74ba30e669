/* MuJoCo's geoms: rotations in every way, ends of capsules, which have a mass, what is wrong. */
#include "support/import_case.h"

#define BODY "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>"

/* a body whose joint turns about z of a frame; the axis in the world shows in gravity's torque */
static void axis_of(void **state, const char *compiler, const char *rotation,
                    const double want[3]) {
  char text[900];
  (void)snprintf(text, sizeof text,
                 "<mujoco><compiler angle='radian' %s/><worldbody><body name='b' %s>"
                 "<inertial pos='0.3 0.5 0' mass='1' diaginertia='1 2 1.5'/><joint name='j'/>"
                 "</body></worldbody></mujoco>",
                 compiler, rotation);
  import_case c = import_good(state, text);
  ambulo_mechanics *mechanics = NULL;
  double q[1] = {0}, tau[1];
  assert_int_equal(ambulo_mechanics_create(c.model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(
          mechanics, 1, q, q, q, &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau}),
      AMBULO_OK);
  /* axis . (com x m g up), com and up in the body's axes: up = R' e_z = want */
  assert_close(tau[0], 9.81 * (0.3 * want[1] - 0.5 * want[0]), 1e-12);
  ambulo_mechanics_free(mechanics);
  import_shut(&c);
}

/* up in the body's axes, by hand for each way to write a turn */
static void rotations(void **state) {
  const double c = cos(0.4), s = sin(0.4), d = cos(0.3), e = sin(0.3);
  const struct {
    const char *compiler, *rotation;
    double up[3];
  } cases[] = {
      {"", "", {0, 0, 1}},
      {"", "axisangle='2 0 0 0.4'", {0, s, c}},
      {"", "euler='0.4 0 0'", {0, s, c}},
      {"", "euler='0 0.4 0'", {-s, 0, c}},
      {"", "euler='0.4 0.3 0'", {-e * c, s, d * c}},               /* R_x R_y */
      {"eulerseq='XYZ'", "euler='0.4 0.3 0'", {-e, s * d, c * d}}, /* R_y R_x */
      {"eulerseq='yxz'", "euler='0.3 0.4 0'", {-e, s * d, c * d}}, /* the same */
      {"", "xyaxes='1 0 0 0 2 0'", {0, 0, 1}},
      {"", "xyaxes='0 3 0 5 1 0'", {0, 0, -1}},
      {"", "xyaxes='1 0 0 7 0 1'", {0, 1, 0}},
      {"", "zaxis='0 0 3'", {0, 0, 1}},
      {"", "zaxis='0 0 -3'", {0, 0, -1}},
      {"", "zaxis='0 -1 0'", {0, 1, 0}},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    axis_of(state, cases[i].compiler, cases[i].rotation, cases[i].up);
}

static import_case of_geoms(void **state, const char *geoms) {
  char text[1200];
  (void)snprintf(text, sizeof text,
                 "<mujoco><worldbody><body name='b'><joint/>%s</body></worldbody></mujoco>", geoms);
  return import_good(state, text);
}

/* between two ends: the middle, half the length, along the line */
static void ends(void **state) {
  static const struct {
    const char *geom;
    double mass, com[3], inertia[3];
  } cases[] = {
      {"<geom type='box' fromto='0 0 1 0 0 3' size='0.5' mass='3'/>",
       3,
       {0, 0, 2},
       {1.25, 1.25, 0.5}},
      {"<geom type='box' fromto='0 0 3 0 0 1' size='0.5' mass='3'/>",
       3,
       {0, 0, 2},
       {1.25, 1.25, 0.5}},
      {"<geom type='box' fromto='1 0 0 3 0 0' size='0.5' mass='3'/>",
       3,
       {2, 0, 0},
       {0.5, 1.25, 1.25}},
      {"<geom type='ellipsoid' fromto='0 1 0 0 3 0' size='0.5' mass='5'/>",
       5,
       {0, 2, 0},
       {1.25, 0.5, 1.25}},
      {"<geom type='cylinder' fromto='0 0 1 0 0 3' size='0.5' mass='12'/>",
       12,
       {0, 0, 2},
       {4.75, 4.75, 1.5}},
      {"<geom type='sphere' fromto='0 0 1 0 0 3' size='0.5' mass='10'/>", 10, {0, 0, 2}, {1, 1, 1}},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    import_case c = of_geoms(state, cases[i].geom);
    const ambulo_link *b = ambulo_model_link(c.model, ambulo_model_find_link(c.model, "b"));
    assert_close(b->mass, cases[i].mass, 1e-12);
    for (int k = 0; k < 3; k++) {
      assert_close(b->com[k], cases[i].com[k], 1e-12);
      assert_close(b->inertia[k], cases[i].inertia[k], 1e-12);
    }
    import_shut(&c);
  }
}

/* planes, geoms of no density, meshes of no mass weigh nothing beside a ball of 2 kg */
static void what_weighs_nothing(void **state) {
  static const char *const geoms[] = {
      "<geom type='plane' size='1 1 1'/>", "<geom size='1' mass='0'/>",
      "<geom size='1' density='0'/>",      "<geom type='mesh' mass='0'/>",
      "<geom mesh='none' density='0'/>",   "<geom type='hfield' mass='0'/>"};
  for (size_t i = 0; i < sizeof geoms / sizeof *geoms; i++) {
    char text[400];
    (void)snprintf(text, sizeof text, "<geom size='0.1' mass='2' shellinertia='false'/>%s",
                   geoms[i]);
    import_case c = of_geoms(state, text);
    assert_close(ambulo_model_mass(c.model), 2, 1e-12);
    import_shut(&c);
  }
}

/* a foot's sole is of what can touch, by contype or conaffinity; of what is only seen where nothing
 * does */
static void what_touches(void **state) {
  static const struct {
    const char *more;
    double toe; /* m ahead; 0: no foot */
  } cases[] = {
      {"", .15},
      {"contype='0'", .15},
      {"conaffinity='0'", .15},
      {"contype='0' conaffinity='0'", .15},
      {"contype='0' conaffinity='0'/><geom type='box' size='.2 .05 .01' pos='0 0 -.02'", .2},
      {"type='plane'", 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[900];
    (void)snprintf(text, sizeof text,
                   "<mujoco><worldbody><body name='b'>" BODY "<freejoint/><body name='foot_r'>" BODY
                   "<joint name='ankle'/><geom %s %s/></body></body>"
                   "</worldbody></mujoco>",
                   i < 5 ? "type='box' size='.1 .05 .02' pos='.05 0 -.05'" : "", cases[i].more);
    import_case c = import_good(state, text);
    int toe = ambulo_model_find_point(c.model, "right_toe");
    assert_int_equal(toe >= 0, cases[i].toe > 0);
    if (toe >= 0) assert_close(ambulo_model_point(c.model, toe)->position[0], cases[i].toe, 1e-12);
    import_shut(&c);
  }
}

static void what_is_wrong(void **state) {
  static const struct {
    const char *geom;
    ambulo_status status;
    const char *said;
  } wrong[] = {
      {"<geom type='blob'/>", AMBULO_E_SCHEMA,
       "t.xml:2:1: error[E_SCHEMA]: unknown type of geom (got 'blob'); expected one of plane"},
      {"<geom size='one'/>", AMBULO_E_SCHEMA, "size"},
      {"<geom size='1 2 3 4'/>", AMBULO_E_SCHEMA, "size of <geom> has 4 numbers; expected 3"},
      {"<geom type='capsule' size='1'/>", AMBULO_E_SCHEMA,
       "size of <geom> has 1 numbers; expected 2"},
      {"<geom type='capsule' fromto='0 0 0 0 0 0' size='1'/>", AMBULO_E_MODEL,
       "a size of <geom> is not positive"},
      {"<geom size='1' shellinertia='true'/>", AMBULO_E_MODEL,
       "the mass of <geom> is in its surface (shellinertia); expected a solid"},
      {"<geom type='mesh' mass='1'/>", AMBULO_E_MODEL, "the mass of a body comes from a mesh"},
      {"<geom size='1' axisangle='0 0 0 1'/>", AMBULO_E_MODEL,
       "the orientation of <geom> has no direction (got zeros)"},
      {"<geom size='1' xyaxes='0 0 0 0 1 0'/>", AMBULO_E_MODEL, "the orientation of <geom>"},
      {"<geom size='1' xyaxes='0 1 0 0 2 0'/>", AMBULO_E_MODEL, "the orientation of <geom>"},
      {"<geom size='1' zaxis='0 0 0'/>", AMBULO_E_MODEL, "the orientation of <geom>"},
      {"<geom size='1' quat='1 0 0'/>", AMBULO_E_SCHEMA,
       "quat of <geom> has 3 numbers; expected 4"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    char text[800];
    (void)snprintf(text, sizeof text,
                   "<mujoco><worldbody><body name='b'><joint/>\n%s</body></worldbody></mujoco>",
                   wrong[i].geom);
    import_bad(state, text, wrong[i].status, wrong[i].said);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rotations),           cmocka_unit_test(ends),
      cmocka_unit_test(what_weighs_nothing), cmocka_unit_test(what_touches),
      cmocka_unit_test(what_is_wrong),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
