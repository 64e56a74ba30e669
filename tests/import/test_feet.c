/* Feet from geometry and by hand: where the points are, which foot is whose image, what is said
 * where there are none; and that a free root stands on them. */
#include "support/import_case.h"

#define MASS "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>"
#define HEAD "<mujoco><worldbody><body name='trunk' pos='0 0 1'><freejoint/>" MASS
#define TAIL "</body></worldbody></mujoco>"
/* a leg 0.8 m long at y, its foot with a geom */
#define LEG(side, y, geom)                                                                         \
  "<body name='leg_" side "' pos='0 " y " -0.8'><joint name='hip_" side "' axis='1 0 0'/>" MASS    \
  "<body name='foot_" side "'><joint name='ankle_" side "' axis='0 1 0'/>" MASS geom               \
  "</body></body>"

static void point_is(const import_case *c, const char *name, double x, double y, double z) {
  const ambulo_point *p = ambulo_model_point(c->model, ambulo_model_find_point(c->model, name));
  if (!p) print_error("no point %s\n", name);
  assert_non_null(p);
  assert_close(p->position[0], x, 1e-12);
  assert_close(p->position[1], y, 1e-12);
  assert_close(p->position[2], z, 1e-12);
}

static void a_box(void **state) {
  import_case c = import_good(
      state, HEAD LEG("r", "-0.1", "<geom type='box' pos='.05 0 -.06' size='.12 .04 .02'/>")
                 LEG("l", "0.1", "<geom type='box' pos='.05 0 -.06' size='.12 .04 .02'/>") TAIL);
  assert_int_equal(ambulo_model_foot_count(c.model), 2);
  const ambulo_foot *right = ambulo_model_foot(c.model, 0);
  assert_string_equal(right->name, "right");
  assert_int_equal(right->mirror, 1);
  point_is(&c, "right_heel", -0.07, 0, -0.08);
  point_is(&c, "right_toe", 0.17, 0, -0.08);
  point_is(&c, "right_heel_lateral", -0.07, -0.04, -0.08);
  point_is(&c, "right_toe_medial", 0.17, 0.04, -0.08);
  point_is(&c, "left_heel_lateral", -0.07, 0.04, -0.08);
  assert_int_equal(ambulo_model_find_point(c.model, "right_heel_lateral"), right->heel[0]);
  /* the free root is lifted: trunk at 0.8 + 0.08 instead of 1 */
  assert_non_null(strstr(
      c.text, "{name: base_tx, parent: none, joint: prismatic,\n     origin: {xyz: [0, 0, 0.88]}"));
  import_shut(&c);
}

/* spheres touch below their centres; what is more than 2 cm above the lowest is no sole */
static void spheres_and_capsules(void **state) {
  import_case c = import_good(
      state,
      HEAD LEG("r", "-0.1",
               "<geom size='.03' pos='-.05 .01 -.05'/><geom size='.02' pos='.1 .03 -.06'/>"
               "<geom size='.02' pos='.1 -.03 -.06'/><geom size='.1' pos='.5 0 .1'/>")
          LEG("l", "0.1", "<geom type='capsule' size='.02' fromto='-.06 0 -.06 .1 0 -.06'/>") TAIL);
  point_is(&c, "right_heel", -0.05, 0, -0.08);
  point_is(&c, "right_toe_medial", 0.1, 0.03, -0.08);
  point_is(&c, "left_heel", -0.06, 0, -0.08);
  const ambulo_foot *left = ambulo_model_foot(c.model, 1);
  assert_int_equal(left->heel[1], -1); /* a line has no width */
  import_shut(&c);
}

static void cylinders_and_ellipsoids(void **state) {
  import_case c = import_good(
      state,
      HEAD LEG("r", "-0.1", "<geom type='cylinder' size='.03 .1' euler='0 90 0' pos='.02 0 -.05'/>")
          LEG("l", "0.1",
              "<geom type='ellipsoid' size='.1 .04 .03' pos='-.05 0 -.05'/>"
              "<geom type='ellipsoid' size='.1 .04 .03' pos='.1 0 -.05'/>") TAIL);
  point_is(&c, "right_heel", -0.08, 0, -0.08);
  point_is(&c, "right_toe", 0.12, 0, -0.08);
  point_is(&c, "left_heel", -0.05, 0, -0.08);
  point_is(&c, "left_toe", 0.1, 0, -0.08);
  import_shut(&c);
}

/* what a foot lacks is named, with the option that gives it; a ball is a foot on one point */
static void what_is_missing(void **state) {
  import_case c = import_good(state, HEAD LEG("r", "-0.1", "<geom type='mesh' mesh='m' mass='0'/>")
                                         LEG("l", "0.1", "<geom size='.02' pos='0 0 -.05'/>") TAIL);
  assert_int_equal(ambulo_model_foot_count(c.model), 1);
  assert_told(&c, "foot_r: its geometry is a mesh that could not be read, so the foot 'right' has "
                  "no points: give "
                  "them by --heel right=foot_r:X,Y,Z and --toe");
  point_is(&c, "left_point", 0, 0, -0.07);
  assert_int_equal(ambulo_model_foot(c.model, 0)->heel[1], -1);
  import_shut(&c);
}

#define BARE HEAD LEG("r", "-0.1", "") LEG("l", "0.1", "<geom type='box' size='.1 .05 .02'/>") TAIL

static void by_hand(void **state) {
  static const char *const heels[] = {"right=foot_r:-0.05,0,-0.07"};
  static const char *const toes[] = {"right=foot_r:0.15,-0.04,-0.07:0.15,0.04,-0.07"};
  static const char *const one_toe[] = {"right=foot_r:0.15,0,-0.07"}, *const feet[] = {
                                                                          "left=foot_l"};
  ambulo_import_options o = ambulo_import_options_default();
  o.heels = heels;
  o.heel_count = 1;
  o.toes = one_toe;
  o.toe_count = 1;
  o.feet = feet;
  o.foot_count = 1;
  import_case c = import_text(state, BARE, &o);
  assert_int_equal(c.status, AMBULO_OK);
  point_is(&c, "right_heel", -0.05, 0, -0.07);
  point_is(&c, "left_toe", 0.1, 0, -0.02);
  assert_int_equal(ambulo_model_foot_count(c.model), 2);
  import_shut(&c);
  o.toes = toes; /* one corner at the heel, two at the toe: the model is refused */
  c = import_text(state, BARE, &o);
  assert_int_equal(c.status, AMBULO_E_MODEL);
  import_shut(&c);
}

static void options_that_are_wrong(void **state) {
  static const struct {
    const char *heel, *toe, *want;
  } cases[] = {
      {"right", "right=foot_r:1,2,3", "has no --toe"},
      {"right=foot_r:1,2,3", "left=foot_r:1,2,3", "has no --toe; expected --toe right=LINK:X,Y,Z"},
      {"right=foot_x:1,2,3", "right=foot_r:1,2,3", "hint: did you mean 'foot_"},
      {"right=foot_r:1,2", "right=foot_r:1,2,3", "--heel: '1,2' is not a position; expected X,Y,Z"},
      {"right=foot_r:1,2,3:1,2,3:1,2,3", "right=foot_r:1,2,3", "is not a position"},
      {"right=foot_r", "right=foot_r:1,2,3", "--heel has no position"},
      {"right=:1,2,3", "right=foot_r:1,2,3", "names no link; expected FOOT=LINK:X,Y,Z"},
      {"=foot_r:1,2,3", "=foot_r:1,2,3", "--heel '=foot_r:1,2,3' names no link"},
      {"right=foot_r:1,2,x", "right=foot_r:1,2,3", "--heel: '1,2,x' is not a position"},
      {"right=foot_r:1,2e4,3", "right=foot_r:1,2,3", "--heel: '1,2e4,3' is not a position"},
      {"right=foot_r:1:2,3", "right=foot_r:1,2,3", "--heel: '1:2,3' is not a position"},
      {"right=foot_r:1,2,3", "right=foot_r:1,,3", "--toe: '1,,3' is not a position"},
      {"right=foot_r:1,2,3", "right=none:1,2,3", "--toe: unknown link (got 'none')"},
      {"right=foot_r:1,2,3:4", "right=foot_r:1,2,3", "--heel: '1,2,3:4' is not a position"}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    ambulo_import_options o = ambulo_import_options_default();
    o.heels = &cases[i].heel;
    o.heel_count = 1;
    o.toes = &cases[i].toe;
    o.toe_count = 1;
    import_case c = import_text(state, BARE, &o);
    assert_int_equal(c.status, AMBULO_E_ARGUMENT);
    assert_null(c.text);
    assert_told(&c, cases[i].want);
    import_shut(&c);
  }
}

/* of links that say no foot the lowest of each side; toes of their own belong to a short foot */
static void guesses(void **state) {
#define SHANK(side, y)                                                                             \
  "<body name='shank_" side "' pos='0 " y " -0.8'><joint name='hip_" side "' axis='1 0 0'/>" MASS  \
  "<geom size='.02' pos='-.05 0 -.05'/><body name='toes_" side                                     \
  "' pos='.1 0 0'><joint name='mtp_" side "' axis='0 1 0'/>" MASS                                  \
  "<geom size='.02' pos='.05 0 -.05'/></body></body>"
  import_case c = import_good(state, HEAD SHANK("r", "-0.1") SHANK("l", "0.1") TAIL);
  assert_int_equal(ambulo_model_foot_count(c.model), 2);
  int toe = ambulo_model_foot(c.model, 0)->toe_center;
  import_shut(&c);
  assert_true(toe >= 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_box),
      cmocka_unit_test(spheres_and_capsules),
      cmocka_unit_test(cylinders_and_ellipsoids),
      cmocka_unit_test(what_is_missing),
      cmocka_unit_test(by_hand),
      cmocka_unit_test(options_that_are_wrong),
      cmocka_unit_test(guesses),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
