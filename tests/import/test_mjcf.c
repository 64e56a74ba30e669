/* MuJoCo: included files, settings of the compiler, what actuators bound, what is left out. */
#include "support/import_case.h"

#define BODY "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>"
#define HEAD "<mujoco><worldbody><body name='b'>" BODY "<joint name='j'/></body></worldbody>"

static const ambulo_coordinate *named(const import_case *c, const char *name) {
  int i = ambulo_model_find_coordinate(c->model, name);
  if (i < 0) print_error("no coordinate %s\n", name);
  assert_true(i >= 0);
  return ambulo_model_coordinate(c->model, i);
}

/* -------------------------------------------------------------------- included files */

/* what stands before, in and behind the included elements keeps its place, wherever they stand */
static void places_of_included_elements(void **state) {
  static const struct {
    const char *inner, *order;
  } cases[] = {{"%s<joint name='y'/><joint name='z'/>", "abyz"},
               {"<joint name='y'/>%s<joint name='z'/>", "yabz"},
               {"<joint name='y'/><joint name='z'/>%s", "yzab"},
               {"%s", "ab"}};
  scratch_write(scratch_path(state, "two.xml"),
                "<mujocoinclude><joint name='a'/><joint name='b'/></mujocoinclude>");
  scratch_write(scratch_path(state, "empty.xml"), "<mujocoinclude/>");
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    for (int empty = 0; empty < 2; empty++) {
      char inner[256], text[800];
      (void)snprintf(inner, sizeof inner, cases[i].inner,
                     empty ? "<include file='empty.xml'/>" : "<include file='two.xml'/>");
      (void)snprintf(text, sizeof text,
                     "<mujoco><worldbody><body name='body'>" BODY
                     "%s<joint name='own'/></body></worldbody></mujoco>",
                     inner);
      import_case c = import_good(state, text);
      char order[16] = "";
      for (int k = 0; k < ambulo_model_coordinate_count(c.model); k++)
        if (!empty || !strchr("ab", ambulo_model_coordinate(c.model, k)->name[0]))
          strncat(order, ambulo_model_coordinate(c.model, k)->name, 1);
      char want[16] = "";
      for (const char *at = cases[i].order; *at; at++)
        if (!empty || !strchr("ab", *at)) strncat(want, at, 1);
      strcat(want, "o");
      assert_string_equal(order, want);
      import_shut(&c);
    }
  }
}

/* elements of an included file include others; paths are those of the model, or absolute */
static void files_of_files(void **state) {
  char text[1200];
  scratch_write(scratch_path(state, "inner.xml"), "<mujocoinclude><body name='leg'>" BODY
                                                  "<joint name='hip'/></body></mujocoinclude>");
  scratch_write(scratch_path(state, "outer.xml"),
                "<mujocoinclude><include file='inner.xml'/></mujocoinclude>");
  (void)snprintf(text, sizeof text, "<mujoco><worldbody><include file='%s'/></worldbody></mujoco>",
                 scratch_path(state, "outer.xml"));
  import_case c = import_good(state, text);
  assert_string_equal(named(&c, "hip")->name, "hip");
  import_shut(&c);
}

static void too_many_files(void **state) {
  char text[8192] = "<mujoco>\n";
  for (int i = 0; i < 65; i++) {
    char name[32];
    (void)snprintf(name, sizeof name, "part%d.xml", i);
    scratch_write(scratch_path(state, name), "<mujocoinclude/>");
    (void)snprintf(text + strlen(text), sizeof text - strlen(text), "<include file='%s'/>\n", name);
  }
  strcat(text, "</mujoco>");
  import_bad(state, text, AMBULO_E_LIMIT,
             "t.xml:66:1: error[E_LIMIT]: too many <include>; expected at most 64");
}

/* more levels than one file may have, of two */
static void too_deep(void **state) {
  enum { LEVELS = 120 };
  char text[8192] = "<mujoco>", part[8192] = "<mujocoinclude>";
  for (int i = 0; i < LEVELS; i++) {
    strcat(text, "<worldbody>");
    strcat(part, "<frame>");
  }
  strcat(text, "<include file='part.xml'/>");
  for (int i = 0; i < LEVELS; i++) {
    strcat(text, "</worldbody>");
    strcat(part, "</frame>");
  }
  strcat(text, "</mujoco>");
  strcat(part, "</mujocoinclude>");
  scratch_write(scratch_path(state, "part.xml"), part);
  import_bad(state, text, AMBULO_E_LIMIT,
             "included elements are nested too deeply; expected at most 200 levels");
}

static void files_that_are_none(void **state) {
  import_bad(state, HEAD "\n<include file=''/></mujoco>", AMBULO_E_SCHEMA,
             "t.xml:2:1: error[E_SCHEMA]: <include> names no file; expected file=...");
  import_bad(state, HEAD "\n<include file='none.xml'/></mujoco>", AMBULO_E_IO,
             "the included file 'none.xml' could not be read");
  scratch_write(scratch_path(state, "bad.xml"), "<mujocoinclude>\n<body>");
  import_bad(state, HEAD "\n<include file='bad.xml'/></mujoco>", AMBULO_E_PARSE, "bad.xml:2:");
}

/* --------------------------------------------------------------------------- actuators */

static void torques(void **state) {
  static const struct {
    const char *joint, *actuators;
    double low, high;
  } cases[] = {
      {"", "<motor joint='j' ctrlrange='-2 3'/>", -2, 3},
      {"", "<motor joint='j' ctrlrange='-2 3' gear='-10'/>", -30, 20},
      {"", "<motor joint='j' ctrlrange='-2 3' gear='10'/>", -20, 30},
      {"", "<motor joint='j' ctrlrange='-2 3' ctrllimited='false'/>", -INFINITY, INFINITY},
      {"", "<motor joint='j' ctrlrange='-2 3' ctrllimited='true'/>", -2, 3},
      {"", "<motor joint='j' ctrlrange='-2 3' forcerange='-1 1'/>", -1, 1},
      {"", "<motor joint='j' ctrlrange='-2 3' forcerange='-1 1' forcelimited='false'/>", -2, 3},
      {"", "<position joint='j' ctrlrange='-2 3'/>", -INFINITY, INFINITY},
      {"", "<position joint='j' forcerange='-7 8'/>", -7, 8},
      {"", "<motor joint='j' ctrlrange='3 3'/>", -INFINITY, INFINITY},
      {"", "<motor joint='j' ctrlrange='-2 3'/><motor joint='j' ctrlrange='-4 5'/>", -6, 8},
      {"actuatorfrcrange='-1 9'", "<motor joint='j' ctrlrange='-2 3'/>", -1, 3},
      {"actuatorfrcrange='9 9'", "<motor joint='j' ctrlrange='-2 3'/>", -2, 3},
      {"limited='false' range='-1 1'", "", -INFINITY, INFINITY},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[800];
    (void)snprintf(text, sizeof text,
                   "<mujoco><worldbody><body name='b'>" BODY "<joint name='j' %s/></body>"
                   "</worldbody><actuator>%s</actuator></mujoco>",
                   cases[i].joint, cases[i].actuators);
    import_case c = import_good(state, text);
    const double *torque = named(&c, "j")->torque;
    if (torque[0] != cases[i].low || torque[1] != cases[i].high)
      print_error("case %zu: %g to %g\n", i, torque[0], torque[1]);
    assert_true(torque[0] == cases[i].low && torque[1] == cases[i].high);
    assert_true(isinf(named(&c, "j")->range[0]));
    import_shut(&c);
  }
}

/* sites, tendons, axes of a ball: counted */
static void actuators_elsewhere(void **state) {
  import_case c =
      import_good(state, HEAD "<actuator><motor site='s'/><motor joint='none'/>"
                              "<motor joint='j' ctrlrange='-1 1'/></actuator>"
                              "<tendon><fixed/><fixed/></tendon><equality><weld/></equality>"
                              "<equality><weld/><weld/></equality></mujoco>");
  assert_told(&c, "2 actuators on tendons, sites or joints of three axes are left out");
  assert_told(&c, "2 of <tendon> are left out");
  assert_told(&c, "3 of <equality> are left out");
  assert_close(named(&c, "j")->torque[1], 1, 0);
  import_shut(&c);
  c = import_good(state, HEAD "<actuator><motor joint='j'/></actuator><tendon/></mujoco>");
  assert_null(strstr(c.text, "left out")); /* nothing is: nothing is said */
  import_shut(&c);
}

/* ---------------------------------------------------------------------------- settings */

static double mass_with(void **state, const char *compiler) {
  char text[800];
  (void)snprintf(text, sizeof text,
                 "<mujoco model=''><compiler %s/><worldbody><body name='b'><joint/>"
                 "<geom type='box' size='.5 .5 .5' density='1'/>"
                 "<geom type='box' size='.5 .5 .5' density='2' group='3'/></body></worldbody>"
                 "</mujoco>",
                 compiler);
  import_case c = import_good(state, text);
  double mass = ambulo_model_mass(c.model);
  assert_string_equal(ambulo_model_name(c.model), "model");
  import_shut(&c);
  return mass;
}

static void masses_by_setting(void **state) {
  static const struct {
    const char *compiler;
    double mass;
  } cases[] = {{"coordinate='local'", 3},
               {"inertiagrouprange='0 2'", 1},
               {"inertiagrouprange='1 1000'", 2},
               {"inertiagrouprange='-1000 0'", 1},
               {"inertiagrouprange='3 3'", 2},
               {"boundmass='7'", 7},
               {"boundmass='2'", 3},
               {"settotalmass='0.5'", 0.5},
               {"settotalmass='-1'", 3}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
    assert_close(mass_with(state, cases[i].compiler), cases[i].mass, 1e-12);
}

/* principal moments of at least so much */
static void least_inertia(void **state) {
  import_case c = import_good(
      state,
      "<mujoco><compiler boundinertia='0.5'/><worldbody><body name='b'><joint/>"
      "<inertial pos='0 0 0' mass='1' diaginertia='0.4 0.6 0.45'/></body></worldbody></mujoco>");
  const ambulo_link *b = ambulo_model_link(c.model, ambulo_model_find_link(c.model, "b"));
  assert_close(b->inertia[0], 0.5, 1e-12);
  assert_close(b->inertia[1], 0.6, 1e-12);
  assert_close(b->inertia[2], 0.5, 1e-12);
  import_shut(&c);
}

/* meshes stand in meshdir, else in assetdir, else beside the model */
static void folders_of_meshes(void **state) {
  static const struct {
    const char *compiler;
    int found;
  } cases[] = {{"meshdir='parts'", 1},
               {"assetdir='parts'", 1},
               {"assetdir='none' meshdir='parts'", 1},
               {"assetdir='parts' meshdir='none'", 0},
               {"", 0}};
  assert_int_equal(mkdir(scratch_path(state, "parts"), 0777), 0);
  scratch_write(scratch_path(state, "parts/foot.obj"),
                "v -0.05 -0.05 -0.05\nv 0.15 -0.05 -0.05\nv 0.15 0.05 -0.05\n"
                "v -0.05 0.05 -0.05\nv 0 0 0.3\n");
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[900];
    (void)snprintf(
        text, sizeof text,
        "<mujoco><compiler %s/><asset><mesh name='m' file='foot.obj'/></asset><worldbody>"
        "<body name='b'>" BODY "<freejoint/><body name='foot_r'>" BODY "<joint name='j'/>"
        "<geom type='mesh' mesh='m'/></body></body></worldbody></mujoco>",
        cases[i].compiler);
    import_case c = import_good(state, text);
    assert_int_equal(ambulo_model_foot_count(c.model), cases[i].found);
    import_shut(&c);
  }
}

static void gravity(void **state) {
  static const struct {
    const char *option;
    double g[3];
  } cases[] = {{"<option gravity='0 0 -1.62'/>", {0, 0, -1.62}},
               {"<option gravity='0 0 -3'><flag gravity='enable'/></option>", {0, 0, -3}},
               {"<option><flag contact='disable'/></option>", {0, 0, -9.81}},
               {"<option gravity='0 0 -1e9'/>", {0, 0, -9.81}}, /* and a warning */
               {"<option gravity='-9 0 0'/>", {-9, 0, 0}}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[800];
    (void)snprintf(text, sizeof text, HEAD "%s</mujoco>", cases[i].option);
    import_case c = import_good(state, text);
    for (int k = 0; k < 3; k++)
      assert_close(ambulo_model_gravity(c.model)[k], cases[i].g[k], 1e-12);
    import_shut(&c);
  }
}

static void wrong_settings(void **state) {
  static const struct {
    const char *setting;
    ambulo_status status;
    const char *said;
  } wrong[] = {
      {"<compiler coordinate='global'/>", AMBULO_E_SCHEMA,
       "t.xml:2:1: error[E_SCHEMA]: unknown coordinate (got 'global'); expected one of local"},
      {"<compiler angle='grad'/>", AMBULO_E_SCHEMA, "unknown angle (got 'grad')"},
      {"<compiler eulerseq='xyzx'/>", AMBULO_E_SCHEMA, "eulerseq of <compiler> is 'xyzx'"},
      {"<compiler inertiagrouprange='1'/>", AMBULO_E_SCHEMA, "inertiagrouprange"},
      {"<compiler autolimits='perhaps'/>", AMBULO_E_SCHEMA, "unknown autolimits (got 'perhaps')"},
      {"<option gravity='1 2'/>", AMBULO_E_SCHEMA, "gravity"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    char text[800];
    (void)snprintf(text, sizeof text, HEAD "\n%s</mujoco>", wrong[i].setting);
    import_bad(state, text, wrong[i].status, wrong[i].said);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(places_of_included_elements),
      cmocka_unit_test(files_of_files),
      cmocka_unit_test(too_many_files),
      cmocka_unit_test(too_deep),
      cmocka_unit_test(files_that_are_none),
      cmocka_unit_test(torques),
      cmocka_unit_test(actuators_elsewhere),
      cmocka_unit_test(masses_by_setting),
      cmocka_unit_test(least_inertia),
      cmocka_unit_test(folders_of_meshes),
      cmocka_unit_test(gravity),
      cmocka_unit_test(wrong_settings),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
