/* Which limbs are legs, what their feet are called, where the body goes, and what is said of feet
 * that are none. */
#include "support/import_case.h"

#define MASS "<inertial pos='0 0 0' mass='1' diaginertia='.01 .01 .01'/>"
#define HEAD "<mujoco><worldbody><body name='trunk' pos='0 0 1'><freejoint name='root'/>" MASS
#define TAIL "</body></worldbody></mujoco>"
#define BOX(size, at) "<geom type='box' size='" size "' pos='" at "' mass='0'/>"
/* a leg of two links: NAMEthigh on NAMEhip, NAMEend on NAMEknee, with what is on it */
#define LEG(name, at, more)                                                                        \
  "<body name='" name "thigh' pos='" at "'><joint name='" name "hip' axis='0 1 0'/>" MASS          \
  "<body name='" name "end' pos='0 0 -.4'><joint name='" name "knee' axis='0 1 0'/>" MASS more     \
  "</body></body>"
#define TIP "<geom size='.02' pos='0 0 -.4' mass='0'/>"

/* "NAME:LINK>MIRROR NAME:LINK>MIRROR" of all feet */
static void feet_are(const import_case *c, const char *want) {
  char text[400] = "";
  for (int i = 0; i < ambulo_model_foot_count(c->model); i++) {
    const ambulo_foot *foot = ambulo_model_foot(c->model, i);
    int link = ambulo_model_point(c->model, foot->heel_center)->link;
    (void)snprintf(text + strlen(text), sizeof text - strlen(text), "%s%s:%s>%s", i ? " " : "",
                   foot->name, ambulo_model_link(c->model, link)->name,
                   ambulo_model_foot(c->model, foot->mirror)->name);
  }
  if (strcmp(text, want) != 0) import_print(c);
  assert_string_equal(text, want);
}

static void legs(void **state, const char *xml, const char *want) {
  import_case c = import_good(state, xml);
  feet_are(&c, want);
  import_shut(&c);
}

/* A hip has no foot because one hangs below it, and its own ball is no sole: what is lowest is. */
static void the_lowest_link_of_a_leg(void **state) {
#define BALL "<geom size='.05' mass='0'/>"
#define LONG(side, y)                                                                              \
  "<body name='" side "_hip' pos='0 " y " -.1'><joint name='" side "_h' axis='1 0 0'/>" MASS BALL  \
  "<body name='" side "_shank' pos='0 0 -.4'><joint name='" side "_k' axis='0 1 0'/>" MASS BALL    \
  "<body name='" side "_ankle' pos='0 0 -.4'><joint name='" side                                   \
  "_a' axis='0 1 0'/>" MASS BOX(".1 .05 .02", ".03 0 -.05") "</body></body></body>"
  legs(state, HEAD LONG("right", "-.1") LONG("left", ".1") TAIL,
       "right:right_ankle>left left:left_ankle>right");
}

/* legs are where names end lowest; arms and a tail that hangs are none */
static void arms_are_no_legs(void **state) {
  legs(state,
       HEAD LEG("r_", "0 -.1 0", BOX(".1 .05 .01", "0 0 -.4"))
           LEG("l_", "0 .1 0", BOX(".1 .05 .01", "0 0 -.4")) LEG("r_arm_", "0 -.3 .5", TIP)
               LEG("l_arm_", "0 .3 .5", TIP) TAIL,
       "right:r_end>left left:l_end>right");
  import_case c =
      import_good(state, HEAD LEG("r_elbow_", "0 -.3 0", TIP) LEG("l_elbow_", "0 .3 0", TIP) TAIL);
  feet_are(&c, "");
  assert_told(&c, "no feet: the model has no legs: none of its limbs ends lower than its trunk");
  import_shut(&c);
  c = import_good(state, HEAD BOX(".1 .1 .1", "0 0 -2") LEG("r_", "0 -.3 0", TIP)
                             LEG("l_", "0 .3 0", TIP) TAIL);
  assert_told(&c, "the model has no legs");
  import_shut(&c);
}

static void four_and_six(void **state) {
  legs(state,
       HEAD LEG("FR_", ".3 -.1 0", TIP) LEG("RL_", "-.3 .1 0", TIP) LEG("FL_", ".3 .1 0", TIP)
           LEG("RR_", "-.3 -.1 0", TIP) TAIL,
       "fl:FL_end>fr fr:FR_end>fl hl:RL_end>hr hr:RR_end>hl");
  legs(state,
       HEAD LEG("lf_", ".3 .1 0", TIP) LEG("rf_", ".3 -.1 0", TIP) LEG("lh_", "-.3 .1 0", TIP)
           LEG("rh_", "-.3 -.1 0", TIP) TAIL,
       "fl:lf_end>fr fr:rf_end>fl hl:lh_end>hr hr:rh_end>hl");
  legs(state,
       HEAD LEG("LF_", ".3 .1 0", TIP) LEG("LM_", "0 .1 0", TIP) LEG("LR_", "-.3 .1 0", TIP)
           LEG("RF_", ".3 -.1 0", TIP) LEG("RM_", "0 -.1 0", TIP) LEG("RR_", "-.3 -.1 0", TIP) TAIL,
       "fl:LF_end>fr fr:RF_end>fl ml:LM_end>mr mr:RM_end>ml hl:LR_end>hr hr:RR_end>hl");
  /* without a side in their names: by where they are */
  legs(state, HEAD LEG("one_", "0 .1 0", TIP) LEG("two_", "0 -.1 0", TIP) TAIL,
       "right:two_end>left left:one_end>right");
  /* eight: counted from the front */
  legs(state,
       HEAD LEG("l1_", ".3 .1 0", TIP) LEG("l2_", ".1 .1 0", TIP) LEG("l3_", "-.1 .1 0", TIP)
           LEG("l4_", "-.3 .1 0", TIP) LEG("r1_", ".3 -.1 0", TIP) LEG("r2_", ".1 -.1 0", TIP)
               LEG("r3_", "-.1 -.1 0", TIP) LEG("r4_", "-.3 -.1 0", TIP) TAIL,
       "l1:l1_end>r1 r1:r1_end>l1 l2:l2_end>r2 r2:r2_end>l2 l3:l3_end>r3 r3:r3_end>l3 "
       "l4:l4_end>r4 r4:r4_end>l4");
}

/* what else is in a scene is no part of the body */
static void a_ball_in_the_scene(void **state) {
  legs(state,
       "<mujoco><worldbody><body name='ball' pos='3 0 0'><freejoint/><geom size='.1' mass='.1'/>"
       "</body><body name='trunk' pos='0 0 1'><freejoint name='root'/>" MASS LEG(
           "r_", "0 -.1 0", TIP) LEG("l_", "0 .1 0", TIP) TAIL,
       "right:r_end>left left:l_end>right");
}

/* rods that end beside a foot, on the same leg */
static void rods_are_no_feet(void **state) {
#define RODS(side, y)                                                                              \
  "<body name='" side "_hip' pos='0 " y " 0'><joint name='" side "_h' axis='1 0 0'/>" MASS         \
  "<body name='" side "_foot_crank' pos='0 0 -.3'><joint name='" side "_c' axis='0 1 0'/>" MASS    \
  "<geom size='.01' mass='0'/></body><body name='" side "_foot' pos='0 0 -.4'>"                    \
  "<joint name='" side "_a' axis='0 1 0'/>" MASS BOX(".1 .05 .02", "0 0 0") "</body></body>"
  legs(state, HEAD RODS("r", "-.1") RODS("l", ".1") TAIL, "right:r_foot>left left:l_foot>right");
}

/* ------------------------------------------------------------------------ forward */

static import_case towards(void **state, const char *xml, const char *direction) {
  ambulo_import_options o = ambulo_import_options_default();
  o.forward = direction;
  return import_text(state, xml, &o);
}

static void forward_is(import_case c, double x, double y, double z) {
  if (c.status) import_print(&c);
  assert_int_equal(c.status, AMBULO_OK);
  const double *forward = ambulo_model_forward(c.model);
  assert_close(forward[0], x, 1e-9);
  assert_close(forward[1], y, 1e-9);
  assert_close(forward[2], z, 1e-9);
  import_shut(&c);
}

#define PAIR(y) LEG("r_", "0 -" y " 0", TIP) LEG("l_", "0 " y " 0", TIP)

static void forward(void **state) {
  static const char sideways[] = HEAD LEG("r_", "-.1 0 0", TIP) LEG("l_", ".1 0 0", TIP) TAIL;
  forward_is(import_good(state, HEAD PAIR(".1") TAIL), 1, 0, 0);
  forward_is(import_good(state, HEAD LEG("r_", "0 .1 0", TIP) LEG("l_", "0 -.1 0", TIP) TAIL), -1,
             0, 0);
  forward_is(import_good(state, sideways), 0, -1, 0);
  forward_is(towards(state, sideways, "x"), 1, 0, 0);
  forward_is(towards(state, sideways, "-x"), -1, 0, 0);
  forward_is(towards(state, sideways, "3,4,0"), .6, .8, 0);
  /* ring finger and little finger are no sides */
  forward_is(import_good(state, HEAD LEG("rf_", "-.1 -.1 0", TIP) LEG("lf_", ".1 .1 0", TIP) TAIL),
             1, 0, 0);
  /* no side in any name: the toes */
  forward_is(import_good(state, HEAD LEG("one_", "0 .1 0", BOX(".1 .05 .01", "-.06 0 -.4"))
                                    LEG("two_", "0 -.1 0", BOX(".1 .05 .01", "-.06 0 -.4")) TAIL),
             -1, 0, 0);
}

/* The coordinates of a free body are about the new axes: tilt about left, list about forward. */
static void free_coordinates_follow(void **state) {
  import_case c = import_good(state, HEAD LEG("r_", "0 .1 0", TIP) LEG("l_", "0 -.1 0", TIP) TAIL);
  assert_non_null(strstr(c.text, "forward: [-1, 0, 0]"));
  assert_non_null(strstr(c.text, "axis: [0, -1, 0],\n     coordinate: {name: root_tilt"));
  assert_int_equal(ambulo_model_check_mirror(c.model, NULL, NULL), AMBULO_OK);
  import_shut(&c);
}

static void no_direction(void **state) {
  static const char *const words[] = {"z",   "-z",      "w",     "",     "x,y,z",
                                      "1,2", "1,2,3,4", "0,0,0", "0,0,2"};
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
    import_case c = towards(state, HEAD PAIR(".1") TAIL, words[i]);
    assert_int_equal(c.status, AMBULO_E_ARGUMENT);
    assert_told(&c, "is no direction along the ground; expected x, -x, y, -y, z, -z or X,Y,Z");
    import_shut(&c);
  }
}

/* ------------------------------------------------------------------- what is wrong */

static void a_foot_that_is_not_the_lowest(void **state) {
  static const char *const feet[] = {"right=r_thigh", "left=l_end"};
  ambulo_import_options o = ambulo_import_options_default();
  o.feet = feet;
  o.foot_count = 2;
  import_case c = import_text(
      state,
      HEAD "<body name='r_thigh' pos='0 -.1 0'><joint name='r_h' axis='0 1 0'/>" MASS BOX(
          ".1 .05 .01", "0 0 -.1") "<body name='r_end' pos='0 0 -.4'>"
                                   "<joint name='r_k' axis='0 1 0'/>" MASS BOX(
                                       ".1 .05 .01",
                                       "0 0 -.4") "</body></body>" LEG("l_", "0 .1 0",
                                                                       BOX(".1 .05 .01", "0 0 -.4"))
                                       TAIL,
      &o);
  assert_int_equal(c.status, AMBULO_OK);
  feet_are(&c, "right:r_thigh>left left:l_end>right");
  assert_told(&c, "the foot 'right' is on r_thigh, which is not the lowest link of its leg: in the "
                  "start pose r_end is 0.7 m lower; --foot right=LINK chooses another");
  for (size_t i = 0; i < ambulo_diagnostics_count(c.list); i++) {
    char text[2048] = "";
    ambulo_diagnostics_format(c.list, i, text, sizeof text);
    assert_null(strstr(text, "the foot 'left' is on"));
  }
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_lowest_link_of_a_leg),
      cmocka_unit_test(arms_are_no_legs),
      cmocka_unit_test(four_and_six),
      cmocka_unit_test(a_ball_in_the_scene),
      cmocka_unit_test(rods_are_no_feet),
      cmocka_unit_test(forward),
      cmocka_unit_test(free_coordinates_follow),
      cmocka_unit_test(no_direction),
      cmocka_unit_test(a_foot_that_is_not_the_lowest),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
