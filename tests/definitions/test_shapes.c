/* Sections of a problem file that have another shape, or another size, than is expected: each is
 * refused with the place of what is wrong, and no problem is made. */
#include "definitions/problem_text.h"

#define HEAD(model)                                                                                \
  "ambulo: 1\nkind: problem\nmodel: " model ".yaml\ntime: {duration: 1, intervals: 8}\n"
#define NONE "objective: none\n"
#define OBSTACLE "obstacles: [{name: o, from: [0, 0, 1], to: [1, 0, 1], radius: 0.1, "
#define FLAT "contacts: [{foot: left, mode: flat, from: 0, to: 1, place: [0, 0]}]\n"

typedef struct fault {
  const char *section; /* line 5 and on */
  const char *said;
} fault;

static const fault of_the_walker[] = {
    /* constraints, obstacles, pairs of capsules */
    {NONE "constraints: {strike_pitch: 3}\n", "p.yaml:6:"},
    {NONE "constraints: {strike_pitch: [1]}\n", "'strike_pitch' is not a list of two angles"},
    {NONE "angles: radians\nconstraints: {strike_pitch: [0.2, 0.2]}\n",
     "from 0.2 to 0.2 rad; expected two rising angles of less than 1.5 rad"},
    {NONE "angles: radians\nconstraints: {strike_pitch: [-1.5, 0.2]}\n", "from -1.5 to 0.2 rad"},
    {NONE "angles: radians\nconstraints: {strike_pitch: [0, 1.5]}\n", "from 0 to 1.5 rad"},
    {NONE "constraints: {collision: {pairs: [shank_l]}}\n",
     "expected the names of two capsules, such as [shank_l, shank_r]"},
    {NONE "constraints: {collision: {pairs: [[shank_l]]}}\n", "expected the names of two capsules"},
    {NONE "constraints: {collision: {pairs: [[none, shank_l]]}}\n", "unknown capsule (got 'none')"},
    {NONE "constraints: {collision: {pairs: {a: b}}}\n", "p.yaml:6:"},
    /* devices */
    {NONE "devices: [{name: a, kind: actuator, coordinate: knee_angle_r, by: time, points: []}]\n",
     "0 points; expected 1 to "},
    {NONE
     "devices: [{name: a, kind: actuator, coordinate: knee_angle_r, by: time, points: [[0]]}]\n",
     "p.yaml:6:"},
    {NONE "devices: [{name: a, kind: damper, damping: 1, coordinate: knee_angle_r, mirror: 2}]\n",
     "p.yaml:6:81: error[E_SCHEMA]: got '2'; expected true or false"},
    /* numbers of terms, breakpoints, loads */
    {"objective: [{term: torque_squared, offset: {pelvis_tx: body_weight}}]\n",
     "body_weight on 'pelvis_tx'; expected a vertical translation of the root"},
    {"objective: [{term: torque_squared, offset: {knee_angle_r: body_weight}}]\n",
     "body_weight on 'knee_angle_r'; expected a vertical translation of the root"},
    {"objective: [{term: torque_power, strength: {}}]\n",
     "an empty mapping; expected 'limits', or curves of coordinates"},
    {"objective: [{term: torque_power, strength: limits, scale: {knee_angle_r: [0, 1]}}]\n",
     "a price of 0 for knee_angle_r; expected one above 0, at most 1e12"},
    {"objective: [{term: torque_power, strength: limits, scale: {knee_angle_r: [1, 2e12]}}]\n",
     "a price of 2e+12 for knee_angle_r"},
    {NONE "trajectory: {breakpoints: 3}\n", "breakpoints are not a list; expected rising times"},
    {NONE "trajectory: {breakpoints: [0]}\n", "breakpoints are not a list"},
    {NONE "trajectory: {breakpoints: [0.1, 1]}\n",
     "breakpoints run from 0.1 s to 1 s; expected 0 s to 1 s"},
    {NONE "trajectory: {breakpoints: [0, 0.9]}\n", "breakpoints run from 0 s to 0.9 s"},
    {NONE "trajectory: {breakpoints: [0, 1.1]}\n", "breakpoints run from 0 s to 1.1 s"},
    {NONE "trajectory: {breakpoints: [0, a]}\n", "p.yaml:6:"},
    {NONE "trajectory: {intervals: 3, breakpoints: [0, 0.5, 1]}\n",
     "3 breakpoints make 2 intervals; expected 3, as trajectory.intervals says"},
    {NONE "load: []\n", "0 loads; expected 1 to "},
    {NONE "load: {link: pelvis, mass: 5, position: [0, 0]}\n", "p.yaml:6:"},
    {NONE "load: {link: none, mass: 5, position: [0, 0, 0]}\n", "unknown link (got 'none')"},
    /* another body */
    {NONE "written_for: {mass: 0, stature: 1.7}\n", "p.yaml:6:"},
    {NONE "written_for: {mass: 70, stature: 9}\n", "p.yaml:6:"},
    /* lists that are none, or of nothing */
    {NONE "contacts: {foot: left}\n", "'contacts' is not a list; expected a list of {"},
    {NONE "contacts: [flat]\n", "p.yaml:6:12: error"},
    {NONE "obstacles: wall\n", "'obstacles' is not a list; expected a list of {"},
    {NONE OBSTACLE "capsules: shank_l}]\n", "got 'shank_l'"},
    {NONE OBSTACLE "capsules: {a: b}}]\n", "expected a list of capsules, or 'all'"},
    {NONE OBSTACLE "capsules: [none]}]\n", "unknown capsule (got 'none')"},
    {NONE FLAT "free: {}\n", "0 free parameters; expected 1 to "},
    {NONE FLAT "free: {per: none}\n", "0 free parameters; expected 1 to "},
    {NONE FLAT "free: {nothing: [1, 2]}\n", "p.yaml:7:"},
};

/* with capsules, and of a size of its own */
static const fault of_the_lower_body[] = {
    {NONE "constraints: {collision: {pairs: [[shank_l, shank_l]]}}\n",
     "a capsule and itself (got 'shank_l' twice)"},
    {NONE "constraints: {collision: {pairs: [[shank_l, none]]}}\n", "unknown capsule (got 'none')"},
};

static const fault of_the_pendulum[] = {
    {NONE "written_for: {mass: 70, stature: 1.7}\n",
     "'written_for' with a model that has its own size"},
};

static int count_faults(const char *head, const fault *list_of, size_t count) {
  int faults = 0;
  for (size_t i = 0; i < count; i++) {
    char text[1200], said[2048] = "nothing";
    ambulo_problem *problem = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    (void)snprintf(text, sizeof text, "%s%s", head, list_of[i].section);
    ambulo_status status = load_text(text, list, &problem);
    ambulo_diagnostics_format(list, 0, said, sizeof said);
    if (status == AMBULO_OK || problem || !strstr(said, list_of[i].said) ||
        strncmp(said, "p.yaml:", 7) != 0) {
      print_error("%sgave %s\nexpected %s\n\n", list_of[i].section, said, list_of[i].said);
      faults++;
    }
    ambulo_diagnostics_free(list);
    ambulo_problem_free(problem);
  }
  return faults;
}

#define COUNT(head, list) count_faults(head, list, sizeof list / sizeof *list)

static void what_has_another_shape(void **state) {
  (void)state;
  assert_int_equal(COUNT(HEAD("walker_2d"), of_the_walker), 0);
  assert_int_equal(COUNT(HEAD("lower_body_21"), of_the_lower_body), 0);
  assert_int_equal(COUNT(HEAD("pendulum"), of_the_pendulum), 0);
}

/* two capsules that overlap as the body stands: a warning, and a problem */
static void pairs_that_overlap(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(load_text(HEAD("lower_body_21") NONE
                             "constraints: {collision: {pairs: [[shank_l, thigh_l], [shank_l, "
                             "shank_r]]}}\n",
                             list, &problem),
                   AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  assert_message(list, 0, "'shank_l' and 'thigh_l' overlap by ");
  ambulo_diagnostics_free(list);
  ambulo_problem_free(problem);
}

/* what may be free is listed, and what is not there is not */
static void what_may_be_free(void **state) {
  (void)state;
  static const struct {
    const char *objective;
    int terms;
  } cases[] = {{NONE, 0}, {"objective: [{term: torque_squared}]\n", 1}};
  for (int i = 0; i < 2; i++) {
    char text[600], said[2048] = "";
    ambulo_problem *problem = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    (void)snprintf(text, sizeof text, HEAD("walker_2d") "%s" FLAT "free: {xyzzyqwx: [1, 2]}\n",
                   cases[i].objective);
    assert_int_not_equal(load_text(text, list, &problem), AMBULO_OK);
    ambulo_diagnostics_format(list, 0, said, sizeof said);
    assert_non_null(strstr(said, "those are "));
    assert_int_equal(strstr(said, "numbers of 'objective'") != NULL, cases[i].terms);
    ambulo_diagnostics_free(list);
  }
}

/* calls without what they need; nothing is touched */
static void arguments(void **state) {
  (void)state;
  static const char text[] = HEAD("pendulum") NONE;
  const char *const none[] = {NULL}, *const wrong[] = {"time.intervals"};
  for (int i = 0; i < 8; i++) {
    ambulo_problem *problem = NULL;
    ambulo_problem_text given = {.size = sizeof given,
                                 .text = text,
                                 .length = sizeof text - 1,
                                 .name = "p.yaml",
                                 .directory = "models"};
    if (i == 0) given.size = 0;
    if (i == 1) given.text = NULL;
    if (i == 2) given.override_count = -1;
    if (i == 3) given.override_count = 1;
    if (i == 4 || i == 5) given.override_count = 1;
    if (i == 4) given.overrides = none;
    if (i == 5) given.overrides = wrong;
    ambulo_status status =
        ambulo_problem_load_text(i == 6 ? NULL : &given, NULL, NULL, i == 7 ? NULL : &problem);
    assert_int_equal(status, AMBULO_E_ARGUMENT);
    assert_null(problem);
  }
  ambulo_problem *problem = NULL;
  ambulo_model *model = NULL;
  ambulo_file_kind kind;
  double x = 7.0;
  assert_int_equal(ambulo_problem_load(NULL, NULL, 0, NULL, NULL, &problem), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_load("x", NULL, 0, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_load("x", NULL, 1, NULL, NULL, &problem), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_load("x", none, -1, NULL, NULL, &problem), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_load("models/walk.yaml", none, 1, NULL, NULL, &problem),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_model_load(NULL, NULL, NULL, NULL, &model), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_model_load("x", NULL, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_model_load_text(NULL, 0, "m", NULL, NULL, NULL, &model),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_model_load_text("", 0, "m", NULL, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_file_kind_of(NULL, NULL, NULL, &kind), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_file_kind_of("x", NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solution_load(NULL, NULL, NULL, NULL, &x), AMBULO_E_ARGUMENT);
  problem = problem_of(text);
  assert_int_equal(ambulo_solution_load(NULL, problem, NULL, NULL, &x), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solution_load("x", NULL, NULL, NULL, &x), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_solution_load("x", problem, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_true(x == 7.0);
  assert_null(model);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_has_another_shape), cmocka_unit_test(arguments),
      cmocka_unit_test(pairs_that_overlap), cmocka_unit_test(what_may_be_free)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
