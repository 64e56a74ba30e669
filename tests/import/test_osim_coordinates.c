/* Coordinates of OpenSim: what holds them, what drives them, what bounds them, what touches. */
#include "support/import_case.h"

#define BODY(name)                                                                                 \
  "<Body name='" name                                                                              \
  "'><mass>1</mass><mass_center>0 0 0</mass_center><inertia>1 1 1 0 0 0</inertia></Body>\n"
#define PIN(name, parent, child, inner)                                                            \
  "<PinJoint name='" name "'><socket_parent_frame>" parent "</socket_parent_frame>"                \
  "<socket_child_frame>" child "</socket_child_frame><coordinates>" inner                          \
  "</coordinates></PinJoint>\n"
#define Q(name, inner) "<Coordinate name='" name "'>" inner "</Coordinate>"
#define MODEL(coordinate, more)                                                                    \
  "<OpenSimDocument Version='40000'>\n<Model name='m'>\n<BodySet><objects>\n" BODY("a") BODY("b")  \
      BODY("toes_r") "</objects></BodySet>\n<JointSet><objects>\n" PIN(                            \
          "1", "ground", "a", Q("lead", "%s")) PIN("2", "a", "b", coordinate)                      \
          PIN("3", "b", "toes_r", Q("z", "")) "</objects></JointSet>\n" more                       \
                                              "</Model></OpenSimDocument>\n"

static const ambulo_coordinate *named(const import_case *c, const char *name) {
  int i = ambulo_model_find_coordinate(c->model, name);
  return i < 0 ? NULL : ambulo_model_coordinate(c->model, i);
}

/* a constraint that is off, or of another coordinate, changes none; of one that moves it makes a
 * function, else the coordinate is held */
static void couplers(void **state) {
  static const struct {
    const char *range, *constraint, *said;
  } cases[] = {
      {"", "<PointConstraint/>", NULL},
      {"",
       "<CoordinateCouplerConstraint name='k'><isDisabled>true</isDisabled>"
       "<dependent_coordinate_name>q</dependent_coordinate_name></CoordinateCouplerConstraint>",
       NULL},
      {"",
       "<CoordinateCouplerConstraint name='k'><isEnforced>0</isEnforced>"
       "<dependent_coordinate_name>q</dependent_coordinate_name></CoordinateCouplerConstraint>",
       NULL},
      {"",
       "<CoordinateCouplerConstraint name='k'><isEnforced>maybe</isEnforced>"
       "<dependent_coordinate_name>z9</dependent_coordinate_name></CoordinateCouplerConstraint>",
       NULL},
      {"",
       "<CoordinateCouplerConstraint name='k'><isDisabled>0</isDisabled><isEnforced>1</isEnforced>"
       "<dependent_coordinate_name>q</dependent_coordinate_name></CoordinateCouplerConstraint>",
       "q follows  (k): it is held at 0; by its function it would move by up to 0 "},
      {"<range>-1 1</range><default_value>0.5</default_value>",
       "<CoordinateCouplerConstraint name='k'><coupled_coordinates_function><LinearFunction>"
       "<coefficients>2 1</coefficients></LinearFunction></coupled_coordinates_function>"
       "<independent_coordinate_names>lead</independent_coordinate_names>"
       "<dependent_coordinate_name>q</dependent_coordinate_name><scale_factor>3</scale_factor>"
       "</CoordinateCouplerConstraint>",
       ""},
      {"<range>-inf inf</range>",
       "<CoordinateCouplerConstraint name='k'><Constant><value>0.25</value></Constant>"
       "<independent_coordinate_names>nobody</independent_coordinate_names>"
       "<dependent_coordinate_name>q</dependent_coordinate_name></CoordinateCouplerConstraint>",
       "q follows nobody (k): it is held at 0.25; by its Constant it would move by up to 0 "},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[4096];
    (void)snprintf(text, sizeof text,
                   MODEL(Q("q", ""), "<ConstraintSet><objects>%s</objects></ConstraintSet>"),
                   cases[i].range, cases[i].constraint);
    import_case c = import_good(state, text);
    assert_int_equal(named(&c, "q") == NULL, cases[i].said != NULL);
    if (cases[i].said && cases[i].said[0]) assert_told(&c, cases[i].said);
    if (cases[i].said && !cases[i].said[0])
      assert_non_null(strstr(c.text, "coupled: {to: lead, polynomial: [171.887338539247, 6]}"));
    import_shut(&c);
  }
}

/* locked and prescribed ones are held, and move with --unlock */
static void held(void **state) {
  static const char *const words[] = {"locked", "prescribed"};
  for (int i = 0; i < 4; i++) {
    char inner[200], text[4096], said[100];
    ambulo_import_options options = ambulo_import_options_default();
    options.unlock = i / 2;
    (void)snprintf(inner, sizeof inner, "<default_value>0.5</default_value><%s>true</%s>",
                   words[i % 2], words[i % 2]);
    (void)snprintf(text, sizeof text, MODEL(Q("q", "%s"), ""), "", inner);
    import_case c = import_text(state, text, &options);
    assert_int_equal(c.status, AMBULO_OK);
    assert_int_equal(named(&c, "q") == NULL, !options.unlock);
    (void)snprintf(said, sizeof said, "q is %s in the source: it is held at 0.5", words[i % 2]);
    if (!options.unlock) assert_told(&c, said);
    if (options.unlock) assert_close(named(&c, "q")->default_value, 0.5, 1e-8);
    import_shut(&c);
  }
}

/* torques: force times control, whatever its sign; what is no bound is none */
static void actuators(void **state) {
  static const struct {
    const char *inner;
    double low, high;
  } cases[] = {
      {"<coordinate>q</coordinate><optimal_force>10</optimal_force><min_control>-2</min_control>"
       "<max_control>3</max_control>",
       -20, 30},
      {"<coordinate>q</coordinate><optimal_force>-10</optimal_force><min_control>-2</min_control>"
       "<max_control>3</max_control>",
       -30, 20},
      {"<coordinate>q</coordinate><optimal_force>10</optimal_force>", -INFINITY, INFINITY},
      {"<coordinate>q</coordinate><optimal_force>10</optimal_force><min_control>-inf</min_control>"
       "<max_control>1</max_control>",
       -INFINITY, 10},
      {"<coordinate>q</coordinate><min_control>-2</min_control><max_control>3</max_control>",
       -INFINITY, INFINITY},
      {"<coordinate>q</coordinate><optimal_force>10</optimal_force><min_control>3</min_control>"
       "<max_control>2</max_control>",
       -INFINITY, INFINITY},
      {"<coordinate>none</coordinate><optimal_force>10</optimal_force><max_control>2</max_control>",
       -INFINITY, INFINITY}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[4096];
    (void)snprintf(text, sizeof text,
                   MODEL(Q("q", ""), "<ForceSet><objects><CoordinateActuator>%s"
                                     "</CoordinateActuator></objects></ForceSet>"),
                   "", cases[i].inner);
    import_case c = import_good(state, text);
    assert_true(named(&c, "q")->torque[0] == cases[i].low);
    assert_true(named(&c, "q")->torque[1] == cases[i].high);
    import_shut(&c);
  }
}

/* each kind once, with how many there are */
static void what_is_left_out(void **state) {
  char text[4096];
  (void)snprintf(text, sizeof text,
                 MODEL(Q("q", "<range>-1 2</range>"),
                       "<ForceSet><objects><Millard/><Bushing/><Millard/><CoordinateActuator/>"
                       "<Millard/></objects></ForceSet><ConstraintSet><objects><WeldConstraint/>"
                       "</objects></ConstraintSet>"),
                 "");
  import_case c = import_good(state, text);
  assert_told(&c, "3 Millard (muscles and other forces) are left out");
  assert_told(&c, "1 Bushing (muscles and other forces) is left out");
  assert_told(&c, "1 WeldConstraint (constraints: loops that they close stay open) is left out");
  assert_null(strstr(c.text, "CoordinateActuator"));
  assert_close(named(&c, "q")->range[1], 2, 1e-8);
  import_shut(&c);
}

static void too_many(void **state) {
  enum { MOST = 20000 };
  static const char *const sets[] = {"ForceSet", "ConstraintSet"};
  char *text = malloc(MOST * 8 + 4096);
  assert_non_null(text);
  for (int s = 0; s < 2; s++) {
    int at = snprintf(text, 4000, MODEL(Q("q", ""), "<%s><objects>\n"), "", sets[s]);
    at -= (int)strlen("</Model></OpenSimDocument>\n");
    for (int i = 0; i <= MOST; i++) at += snprintf(text + at, 8, "<A/>");
    (void)snprintf(text + at, 90, "</objects></%s></Model></OpenSimDocument>\n", sets[s]);
    import_bad(state, text, AMBULO_E_LIMIT, "a set has 20001 objects; expected at most 20000");
  }
  free(text);
  char small[4096];
  (void)snprintf(small, sizeof small, MODEL(Q("q", "") "\n" Q("r", ""), ""), "");
  import_bad(state, small, AMBULO_E_SCHEMA, "<PinJoint> '2' has 2 coordinates; expected 1");
}

/* only spheres and meshes on bodies make soles */
static void contacts(void **state) {
  static const struct {
    const char *contact;
    int feet;
  } cases[] = {
      {"<ContactSphere><socket_frame>/bodyset/toes_r</socket_frame><radius>0.05</radius>"
       "<location>0.1 0 0</location></ContactSphere><ContactSphere><body_name>toes_r</body_name>"
       "<radius>0.05</radius></ContactSphere>",
       1},
      {"<ContactSphere><socket_frame_connectee_name>/bodyset/toes_r</socket_frame_connectee_name>"
       "<radius>0.05</radius><location>0.1 0 0</location></ContactSphere><ContactSphere>"
       "<body_name>toes_r</body_name><radius>0.05</radius></ContactSphere>",
       1},
      {"<ContactSphere><body_name>ground</body_name><radius>0.05</radius></ContactSphere>", 0},
      {"<ContactHalfSpace><body_name>toes_r</body_name></ContactHalfSpace>", 0},
      {"<ContactMesh><body_name>toes_r</body_name><filename>none.obj</filename></ContactMesh>", 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[4096];
    (void)snprintf(text, sizeof text,
                   MODEL(Q("q", ""), "<ContactGeometrySet><objects>%s</objects>"
                                     "</ContactGeometrySet>"),
                   "", cases[i].contact);
    import_case c = import_good(state, text);
    assert_int_equal(ambulo_model_foot_count(c.model), cases[i].feet);
    import_shut(&c);
  }
  char text[4096];
  (void)snprintf(text, sizeof text,
                 MODEL(Q("q", ""), "<ContactGeometrySet><objects>\n<ContactSphere><body_name>toe_r"
                                   "</body_name></ContactSphere></objects></ContactGeometrySet>"),
                 "");
  import_bad(state, text, AMBULO_E_MODEL, "unknown frame (got 'toe_r'); expected a body");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(couplers),         cmocka_unit_test(held),     cmocka_unit_test(actuators),
      cmocka_unit_test(what_is_left_out), cmocka_unit_test(too_many), cmocka_unit_test(contacts),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
