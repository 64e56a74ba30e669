/* Where a foot touches the ground: of what is fixed to it, in the pose in which it is flat, and by
 * its inertia where there is no geometry. */
#include "support/import_case.h"

#define MASS "<inertial pos='0 0 0' mass='1' diaginertia='.01 .01 .01'/>"
#define HEAD                                                                                       \
  "<mujoco><worldbody><body name='trunk' pos='0 0 1'><freejoint/>" MASS                            \
  "<body name='thigh_r'><joint name='hip' axis='0 1 0'/>" MASS                                     \
  "<body name='shank_r' pos='0 0 -.5'><joint name='knee' axis='0 1 0'/>" MASS
#define TAIL(more) "</body></body></body></worldbody>" more "</mujoco>"
#define FOOT(more)                                                                                 \
  "<body name='foot_r' pos='0 0 -.4'><joint name='ankle' axis='0 1 0'/>" more "</body>"

static const double *point_of(const import_case *c, const char *name) {
  const ambulo_point *p = ambulo_model_point(c->model, ambulo_model_find_point(c->model, name));
  if (!p) import_print(c);
  assert_non_null(p);
  return p->position;
}

static void is_at(const import_case *c, const char *name, double x, double z) {
  assert_close(point_of(c, name)[0], x, 1e-9);
  assert_close(point_of(c, name)[2], z, 1e-9);
}

/* What is only seen counts where nothing touches, and of each solids before meshes. */
static void touching_before_seen(void **state) {
  static const char seen[] = "<geom type='box' contype='0' conaffinity='0' size='.2 .1 .01' "
                             "pos='0 0 -.1' mass='0'/>";
  char text[1200];
  (void)snprintf(text, sizeof text, HEAD FOOT(MASS "%s") TAIL(""), seen);
  import_case c = import_good(state, text);
  is_at(&c, "right_heel", -.2, -.11);
  import_shut(&c);
  (void)snprintf(text, sizeof text,
                 HEAD FOOT(MASS "%s<geom type='box' size='.1 .05 .01' mass='0'/>") TAIL(""), seen);
  c = import_good(state, text);
  is_at(&c, "right_heel", -.1, -.01);
  import_shut(&c);
}

/* The foot is level in the start pose alone: at q = 0 it stands on its tip. */
static void flat_in_the_start_pose(void **state) {
  import_case c = import_good(
      state, HEAD FOOT(MASS "<geom type='box' size='.1 .05 .01' euler='0 -60 0' mass='0'/>")
                 TAIL("<keyframe><key qpos='0 0 1 1 0 0 0 -.5235987755982988 1.0471975511965976 "
                      ".5235987755982988'/></keyframe>"));
  const double *heel = point_of(&c, "right_heel"), *toe = point_of(&c, "right_toe");
  assert_close(hypot(toe[0] - heel[0], toe[2] - heel[2]), 0.2, 1e-9);
  import_shut(&c);
}

/* A ball stands on what is below it in the start pose. */
static void a_ball(void **state) {
  import_case c =
      import_good(state, HEAD FOOT(MASS "<geom size='.05' mass='0'/>")
                             TAIL("<keyframe><key qpos='0 0 1 1 0 0 0 .3 0 0'/></keyframe>"));
  is_at(&c, "right_point", .05 * sin(.3), -.05 * cos(.3));
  assert_non_null(strstr(c.text, "{name: right, point: right_point"));
  import_shut(&c);
}

/* 0.12 m long, and 10 degrees from level: its heel is 2.1 cm above its tip */
static void a_tilted_sole(void **state) {
  import_case c = import_good(
      state,
      HEAD FOOT(MASS "<geom type='capsule' size='.02 .06' euler='0 100 0' mass='0'/>") TAIL(""));
  const double *heel = point_of(&c, "right_heel"), *toe = point_of(&c, "right_toe");
  assert_close(toe[0] - heel[0], .12 * cos(.17453292519943295), 1e-9);
  import_shut(&c);
}

/* Toes on a joint belong to a short foot; a shank is none, however short its own geometry is. */
static void toes_but_no_shank(void **state) {
#define BALL(x, z) "<geom size='.02' pos='" x " 0 " z "' mass='0'/>"
  import_case c = import_good(
      state, HEAD FOOT(MASS BALL("-.05", "-.05") "<body name='toes_r' pos='.1 0 0'>" MASS BALL(
                 ".05", "-.05") "<joint name='mtp' axis='0 1 0'/></body>") TAIL(""));
  is_at(&c, "right_heel", -.05, -.07);
  is_at(&c, "right_toe", .15, -.07);
  import_shut(&c);
  c = import_good(
      state, HEAD BALL("0", "-.3") "<body name='end_r' pos='0 0 -.4'>"
                                   "<joint name='ankle' axis='0 1 0'/>" MASS
                                   "<geom type='box' size='.1 .05 .01' mass='0'/></body>" TAIL(""));
  is_at(&c, "right_heel", -.1, -.01);
  int heel = ambulo_model_find_point(c.model, "right_heel");
  assert_string_equal(ambulo_model_link(c.model, ambulo_model_point(c.model, heel)->link)->name,
                      "end_r");
  import_shut(&c);
}

/* A shank that is asked for has its own geometry alone, not the foot's below it. */
static void a_shank_by_hand(void **state) {
  static const char *const feet[] = {"right=shank_r"};
  ambulo_import_options o = ambulo_import_options_default();
  o.feet = feet;
  o.foot_count = 1;
  import_case c = import_text(
      state,
      HEAD BALL("0", "-.1") FOOT(MASS "<geom type='box' size='.1 .05 .01' mass='0'/>") TAIL(""),
      &o);
  assert_int_equal(c.status, AMBULO_OK);
  is_at(&c, "right_point", 0, -.12);
  import_shut(&c);
}

/* a box of 0.2 m by 0.08 m by 0.04 m and 0.6 kg, seen by its inertia alone */
static void a_foot_by_its_inertia(void **state) {
  char text[1600];
  double m = 0.6, a = 0.2, b = 0.08, h = 0.04;
  (void)snprintf(text, sizeof text,
                 HEAD FOOT("<inertial pos='.03 0 -.05' mass='%g' diaginertia='%.17g %.17g %.17g'/>"
                           "<geom type='mesh' mesh='none' mass='0'/>") TAIL(""),
                 m, m * (b * b + h * h) / 12, m * (a * a + h * h) / 12, m * (a * a + b * b) / 12);
  import_case c = import_good(state, text);
  assert_told(&c, "foot_r: its geometry is a mesh that could not be read: the foot 'right' is "
                  "guessed from its inertia, 0.2 m long; give --heel right=foot_r:X,Y,Z and --toe");
  is_at(&c, "right_heel", -.07, -.07);
  is_at(&c, "right_toe", .13, -.07);
  assert_close(fabs(point_of(&c, "right_toe_lateral")[1]), .04, 1e-9);
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(touching_before_seen),
      cmocka_unit_test(flat_in_the_start_pose),
      cmocka_unit_test(a_ball),
      cmocka_unit_test(a_tilted_sole),
      cmocka_unit_test(toes_but_no_shank),
      cmocka_unit_test(a_foot_by_its_inertia),
      cmocka_unit_test(a_shank_by_hand),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
