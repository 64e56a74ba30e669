/* Feet of models without geometry: from markers and toe bodies, the same on both sides, with a word
 * about what was proposed; nothing where nothing tells. */
#include "support/import_case.h"

#define HEAD "<OpenSimDocument Version='40000'><Model name='walker'><gravity>0 -9.8 0</gravity>"
#define BODY(name, mass)                                                                           \
  "<Body name='" name "'><mass>" mass "</mass><mass_center>0 0 0</mass_center>"                    \
  "<inertia>0.1 0.1 0.1 0 0 0</inertia></Body>"
/* a joint at `at` of its parent, about z */
#define PIN(name, parent, child, at)                                                               \
  "<PinJoint name='" name "'><socket_parent_frame>" name "_p</socket_parent_frame>"                \
  "<socket_child_frame>/bodyset/" child                                                            \
  "</socket_child_frame><coordinates><Coordinate name='" name                                      \
  "'><range>-1 1</range></Coordinate></coordinates><frames><PhysicalOffsetFrame name='" name       \
  "_p'><socket_parent>" parent "</socket_parent><translation>" at                                  \
  "</translation></PhysicalOffsetFrame></frames></PinJoint>"
#define MARKER(name, body, at)                                                                     \
  "<Marker name='" name "'><socket_parent_frame>/bodyset/" body                                    \
  "</socket_parent_frame><location>" at "</location></Marker>"
#define LEG(s, z)                                                                                  \
  PIN("hip_" s, "/bodyset/pelvis", "calcn_" s, "0 -0.9 " z)                                        \
  PIN("mtp_" s, "/bodyset/calcn_" s, "toes_" s, "0.18 -0.01 0")
#define BODIES                                                                                     \
  "<BodySet><objects>" BODY("pelvis", "10") BODY("calcn_r", "1") BODY("calcn_l", "1")              \
      BODY("toes_r", "0.2") BODY("toes_l", "0.2") "</objects></BodySet>"
#define JOINTS(offset)                                                                             \
  "<JointSet><objects>" PIN("tilt", "/ground", "pelvis", "0 1 " offset) LEG("r", "0.1")            \
      LEG("l", "-0.1") "</objects></JointSet>"
#define TAIL "</Model></OpenSimDocument>"

static void point_is(const import_case *c, const char *name, double x, double y, double z) {
  const ambulo_point *p = ambulo_model_point(c->model, ambulo_model_find_point(c->model, name));
  if (!p) print_error("no point %s\n", name);
  assert_non_null(p);
  assert_close(p->position[0], x, 1e-12);
  assert_close(p->position[1], y, 1e-12);
  assert_close(p->position[2], z, 1e-12);
}

/* heel markers 2 and 3 cm behind the frames, the mean on both sides; toes at their joint */
static void markers_and_toes_propose(void **state) {
  import_case c = import_good(
      state,
      HEAD BODIES JOINTS("0") "<MarkerSet><objects>" MARKER("R.Heel", "calcn_r", "-0.02 0.02 0.01")
          MARKER("LHEE", "calcn_l", "-0.03 0.03 0") MARKER("R.Toe.Tip", "toes_r", "0.1 0 0")
              MARKER("R.ASIS", "pelvis", "-0.4 0 0") "</objects></MarkerSet>" TAIL);
  assert_int_equal(ambulo_model_foot_count(c.model), 2);
  point_is(&c, "right_heel", -0.025, -0.01, 0);
  point_is(&c, "left_heel", -0.025, -0.01, 0);
  point_is(&c, "right_toe", 0.18, -0.01, 0);
  point_is(&c, "left_toe", 0.18, -0.01, 0);
  assert_non_null(strstr(c.text, "the foot 'right' has its heel at R.Heel and its toe at toes_r; "
                                 "--heel right=calcn_r:X,Y,Z with --toe place them otherwise"));
  assert_int_equal(ambulo_model_check_mirror(c.model, NULL, NULL), AMBULO_OK);
  import_shut(&c);
}

/* without any marker the frame of the foot is its heel */
static void frames_alone_propose_too(void **state) {
  import_case c = import_good(state, HEAD BODIES JOINTS("0") TAIL);
  point_is(&c, "right_heel", 0, -0.01, 0);
  point_is(&c, "right_toe", 0.18, -0.01, 0);
  assert_non_null(strstr(c.text, "its heel at calcn_r and its toe at toes_r"));
  import_shut(&c);
}

/* a planar body 2 cm beside the plane through the origin moves into it */
static void planar_bodies_stand_in_the_plane(void **state) {
  import_case c = import_good(state, HEAD BODIES JOINTS("0.02") TAIL);
  assert_non_null(strstr(c.text, "the body stands 20 mm beside the plane through the origin"));
  assert_int_equal(ambulo_model_check_mirror(c.model, NULL, NULL), AMBULO_OK);
  import_shut(&c);
}

/* no toes, no markers of them: as before */
static void what_tells_nothing_proposes_nothing(void **state) {
  import_case c =
      import_good(state, HEAD "<BodySet><objects>" BODY("pelvis", "10") BODY("calcn_r", "1")
                             BODY("calcn_l", "1") "</objects></BodySet><JointSet><objects>" PIN(
                                 "tilt", "/ground", "pelvis", "0 1 0")
                                 PIN("hip_r", "/bodyset/pelvis", "calcn_r", "0 -0.9 0.1")
                                     PIN("hip_l", "/bodyset/pelvis", "calcn_l",
                                         "0 -0.9 -0.1") "</objects></JointSet>" TAIL);
  assert_int_equal(ambulo_model_foot_count(c.model), 0);
  assert_non_null(strstr(c.text, "so the foot 'right' has no points"));
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(markers_and_toes_propose, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(frames_alone_propose_too, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(planar_bodies_stand_in_the_plane, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(what_tells_nothing_proposes_nothing, scratch_open,
                                      scratch_close),
  };
  return cmocka_run_group_tests_name("exchange/foot_markers", tests, NULL, NULL);
}
