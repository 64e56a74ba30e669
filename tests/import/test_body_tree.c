/* Bodies of other programs: names, masses that are none or impossible, sizes beyond bounds,
 * gravity. */
#include "support/import_case.h"

#define INERTIA(x, y, z) "<inertia ixx='" x "' iyy='" y "' izz='" z "' ixy='0' ixz='0' iyz='0'/>"
#define ARM(inertial, more)                                                                        \
  "<robot name='r'>\n<link name='a'><inertial><mass value='1'/>" INERTIA(                          \
      "1", "1", "1") "</inertial></link>\n<link name='b'>\n" inertial                              \
                     "</link>\n<joint name='j' type='continuous'>"                                 \
                     "<parent link='a'/><child link='b'/>" more "</joint>\n</robot>\n"

/* what a body weighs, and what is said of it */
static void masses(void **state) {
  static const struct {
    const char *xml, *said;
    double mass, inertia;
  } cases[] = {
      {ARM("<inertial><mass value='2'/>" INERTIA("1", "1", "1.5") "</inertial>", ""), NULL, 2, 1},
      {ARM("<inertial><mass value='0'/></inertial>", ""), NULL, 0, 0},
      {ARM("<inertial><mass value='0'/>" INERTIA("1", "1", "1") "</inertial>", ""),
       "b: an inertia without a mass is left out", 0, 0},
      {ARM("<inertial><mass value='0.9e-9'/>" INERTIA("0", "0", "0") "</inertial>", ""),
       "b: its mass of 9e-10 kg is left out", 0, 0},
      /* short of the triangle by rounding: lifted without a word */
      {ARM("<inertial><mass value='2'/>" INERTIA("1", "1", "2.00000000000001") "</inertial>", ""),
       NULL, 2, 1},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    import_case c = import_good(state, cases[i].xml);
    const ambulo_link *b = ambulo_model_link(c.model, ambulo_model_find_link(c.model, "b"));
    assert_close(b->mass, cases[i].mass, 0);
    assert_close(b->inertia[0], cases[i].inertia, 1e-12);
    if (cases[i].said) assert_told(&c, cases[i].said);
    if (!cases[i].said) assert_null(strstr(c.text, "b: "));
    import_shut(&c);
  }
}

static void what_cannot_be(void **state) {
  static const struct {
    const char *xml;
    ambulo_status status;
    const char *said;
  } wrong[] = {
      {ARM("<inertial><mass value='2'/>" INERTIA("1", "1", "9") "</inertial>", ""), AMBULO_E_MODEL,
       "note: --repair-inertia adds 7 kg m^2 to the moments of 'b'"},
      {ARM("<inertial><mass value='-2'/>" INERTIA("1", "1", "9") "</inertial>", ""), AMBULO_E_MODEL,
       "t.xml:4:11: error[E_MODEL]: mass of 'b'"},
      {"<mujoco><compiler settotalmass='2e6'/><worldbody>\n<body name='b'><joint/>"
       "<geom size='1'/></body></worldbody></mujoco>",
       AMBULO_E_MODEL, "t.xml:2:1: error[E_MODEL]: 'b' is too heavy (got 2000000 kg in all)"},
      {ARM("", "<origin xyz='0 -2e6 0'/>"), AMBULO_E_MODEL,
       "t.xml:5:1: error[E_MODEL]: 'b' is too far from its parent (got 2000000 m); expected at "
       "most 1e6 m"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    import_bad(state, wrong[i].xml, wrong[i].status, wrong[i].said);
}

/* just within the bounds */
static void large_but_possible(void **state) {
  import_case c =
      import_good(state, ARM("<inertial><mass value='1e6'/>" INERTIA("1", "1", "1") "</inertial>",
                             "<origin xyz='0 -1e6 0'/><limit effort='1e9' velocity='1.01e9'/>"));
  const ambulo_coordinate *j =
      ambulo_model_coordinate(c.model, ambulo_model_find_coordinate(c.model, "j"));
  assert_close(j->torque[0], -1e9, 0); /* larger ones are how files write none */
  assert_close(j->torque[1], 1e9, 0);
  assert_true(isinf(j->speed[0]) && isinf(j->speed[1]));
  import_shut(&c);
}

static void chain(char *text, size_t size, int links) {
  int at = snprintf(text, size, "<robot name='r'><link name='l0'/>\n");
  for (int i = 1; i < links; i++)
    at += snprintf(text + at, size - (size_t)at,
                   "<link name='l%d'/><joint name='j%d' type='continuous'><parent link='l%d'/>"
                   "<child link='l%d'/></joint>\n",
                   i, i, i - 1, i);
  strcat(text + at, "</robot>");
}

/* one more than there may be: in the file, or by the root's coordinates */
static void too_many_links(void **state) {
  enum { MOST = 4096, SIZE = MOST * 160 };
  char *text = malloc(SIZE);
  assert_non_null(text);
  chain(text, SIZE, MOST + 1);
  import_bad(state, text, AMBULO_E_LIMIT, "too many links; expected at most 4096");
  chain(text, SIZE, MOST);
  import_bad(state, text, AMBULO_E_LIMIT, "the body has too many links; expected at most 4096");
  free(text);
}

static void names(void **state) {
  import_case c = import_good(
      state, "<mujoco><worldbody><body name='leg.place'><joint name='q'/><geom size='1'/></body>"
             "<body name='leg.turn'><joint name='q'/><geom size='1'/></body>"
             "<body name='a.joint'><joint name='q'/><geom size='1'/></body>"
             "<body name='world'><joint name='q'/><geom size='1'/></body></worldbody></mujoco>");
  static const char *const links[] = {"leg_place", "leg_turn", "a_joint", "base"};
  static const char *const coordinates[] = {"q", "q_2", "q_3", "q_4"};
  for (int i = 0; i < 4; i++) {
    assert_true(ambulo_model_find_link(c.model, links[i]) >= 0);
    assert_true(ambulo_model_find_coordinate(c.model, coordinates[i]) >= 0);
  }
  import_shut(&c);
}

/* what another program's names hold that a text of YAML cannot */
static void names_in_notes(void **state) {
  import_case c = import_good(
      state,
      "<robot name='r'><link name='a'><inertial><mass value='1'/>" INERTIA(
          "1", "1", "1") "</inertial></link><link name='b'/><link name='c'/><joint name='j' "
                         "type='continuous'><parent link='a'/><child link='b'/></joint>"
                         "<joint name='k' type='revolute'><parent link='b'/><child link='c'/>"
                         "<mimic joint='say &quot;a\\b&quot; \xc3\xa9'/></joint></robot>");
  assert_non_null(strstr(c.text, "k follows say 'a?b' ??, which does not move"));
  import_shut(&c);
}

/* a pose is of the coordinate of that name, not of one that begins alike; what is no number is
 * refused before */
static void poses(void **state) {
  static const char *const pose[] = {"knee=0.5", "kn=0.25", "k=0.125"};
  ambulo_import_options options = ambulo_import_options_default();
  options.pose = pose;
  options.pose_count = 3;
  import_case c = import_text(
      state,
      "<mujoco><worldbody><body name='b'><joint name='k'/><joint name='kn' axis='0 1 0'/>"
      "<joint name='knee' axis='1 0 0'/><joint name='kne' axis='1 0 0' ref='1'/>"
      "<geom size='1'/></body></worldbody></mujoco>",
      &options);
  assert_int_equal(c.status, AMBULO_OK);
  static const char *const names_of[] = {"k", "kn", "knee", "kne"};
  const double want[] = {0.125, 0.25, 0.5, acos(-1) / 180};
  for (int i = 0; i < 4; i++) {
    const ambulo_coordinate *q =
        ambulo_model_coordinate(c.model, ambulo_model_find_coordinate(c.model, names_of[i]));
    assert_close(q->default_value, want[i], 1e-8);
  }
  import_shut(&c);
}

/* gravity within its bounds stays; beyond, and along x, it is said */
static void gravity(void **state) {
  static const struct {
    const char *g;
    double size;
    const char *said;
  } cases[] = {{"0 0 -1e-3", 1e-3, NULL},
               {"0 0 -1e5", 1e5, NULL},
               {"0 0 -0.9e-3", 9.81, "gravity is 0.0009 m/s^2 in the source: it is 9.81 here"},
               {"0 0 -1.1e5", 9.81, "gravity is 110000 m/s^2 in the source: it is 9.81 here"},
               {"-9 0 0", 9, "gravity is along x in the source: forward is y here"},
               {"-9 0 0.1", 9, NULL}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[600];
    (void)snprintf(text, sizeof text,
                   "<mujoco><option gravity='%s'/><worldbody><body name='b'><freejoint/>"
                   "<geom size='1'/></body></worldbody></mujoco>",
                   cases[i].g);
    import_case c = import_good(state, text);
    const double *g = ambulo_model_gravity(c.model);
    assert_close(fmax(fabs(g[0]), fabs(g[2])), cases[i].size, 1e-12);
    if (cases[i].said) assert_told(&c, cases[i].said);
    if (!cases[i].said) assert_null(strstr(c.text, "in the source"));
    import_shut(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(masses),
      cmocka_unit_test(what_cannot_be),
      cmocka_unit_test(large_but_possible),
      cmocka_unit_test(too_many_links),
      cmocka_unit_test(names),
      cmocka_unit_test(poses),
      cmocka_unit_test(names_in_notes),
      cmocka_unit_test(gravity),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
