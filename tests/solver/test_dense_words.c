/* What a dense audit says about each family that fails: the settings that are predicted to help,
 * the remedy where more intervals do not, and one sentence that has everything once. The audits
 * are written down here, not measured. */
#include "solver/dense.h"
#include "support/engine_fixture.h"

typedef struct told {
  ambulo_problem *problem;
  ambulo__dense_report report;
  ambulo__dense_cure cure;
} told;

static told *open_told(const char *name, const char *override) {
  told *t = calloc(1, sizeof *t);
  assert_non_null(t);
  t->problem = load_problem_with(name, override);
  t->report.view.samples = 10;
  return t;
}

static void close_told(told *t) {
  ambulo_problem_free(t->problem);
  free(t);
}

/* a family whose worst sample is that many times its tolerance; returns its rule */
static int add(told *t, ambulo__row_kind kind, ambulo__measure measure, double ratio) {
  ambulo__table_row row = {.kind = (unsigned char)kind, .measure = (unsigned char)measure};
  int slip = kind == AMBULO__KIND_SLIP, force = kind == AMBULO__KIND_GROUND_FORCE;
  int rule = slip    ? AMBULO__DENSE_RULE_SLIP
             : force ? AMBULO__DENSE_RULE_FORCE
                     : ambulo__dense_rule_of_row(&row);
  int i = t->report.view.family_count++;
  assert_true(rule >= 0);
  t->report.family_rule[i] = rule;
  t->report.worst.entry[rule].present = 1;
  t->report.worst.entry[rule].ratio = ratio;
  ambulo_dense_family *f = &t->report.family[i];
  *f = (ambulo_dense_family){.tolerance = 0.5, .holds = ratio <= 1.0, .settings = "", .advice = ""};
  f->violation.family = ambulo__row_family(kind);
  f->violation.subject = "knee";
  f->violation.detail = "upper";
  f->violation.unit = ambulo__measure_text(measure);
  f->violation.time = 0.25;
  f->violation.worst = 0.5 * ratio;
  t->report.view.failing += !f->holds;
  return rule;
}

static void tell(told *t, const ambulo__dense_cure *cure) {
  ambulo__dense_words(t->problem, AMBULO_OPTIMAL, cure, &t->report);
}

static void has(const char *text, const char *phrase) {
  if (!strstr(text, phrase)) print_error("got '%s'\nexpected '%s'\n", text, phrase);
  assert_non_null(strstr(text, phrase));
}

/* the trajectory's intervals are set only where they change: walk_slow keeps its 17, and a
 * trajectory that follows the time intervals follows these too */
static void settings_that_stay_are_not_named(void **state) {
  (void)state;
  static const struct {
    const char *name, *override, *settings;
    int spline;
  } cases[] = {
      {"support/walk_rigid", NULL, "--set time.intervals=50", 17},
      {"support/walk_rigid", NULL, "--set time.intervals=50 --set trajectory.intervals=34", 34},
      {"support/walk_without_reaction", NULL,
       "--set time.intervals=50 --set trajectory.intervals=38", 38},
      {"support/walk_without_reaction", "trajectory={basis: bspline}", "--set time.intervals=50",
       50},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    told *t = open_told(cases[i].name, cases[i].override);
    t->cure.intervals = 50;
    t->cure.spline_intervals = cases[i].spline;
    t->cure.cured[add(t, AMBULO__KIND_SLIP, AMBULO__METRES, 4.0)] = 1;
    tell(t, &t->cure);
    assert_string_equal(t->report.family[0].settings, cases[i].settings);
    assert_string_equal(t->report.family[0].advice, "more intervals help");
    close_told(t);
  }
}

/* control points bound a B-spline only; other trajectories have no such cure */
static void joint_limits_on_control_points_take_a_spline(void **state) {
  (void)state;
  const char *const overrides[] = {NULL, "trajectory={basis: hermite}"};
  for (int i = 0; i < 2; i++) {
    told *t = open_told("support/two_link_reach", overrides[i]);
    add(t, AMBULO__KIND_JOINT_LIMIT, AMBULO__RADIANS, 2.0);
    tell(t, &t->cure);
    assert_string_equal(t->report.family[0].settings,
                        i ? "" : "--set constraints.joint_limits=control_points");
    assert_string_equal(t->report.family[0].advice,
                        i ? "more intervals do not help"
                          : "limits on the control points hold at all times");
    close_told(t);
  }
}

/* contacts that are equations already hold the trajectory at as many nodes as it has room for:
 * three times the larger of its two grids; contacts within a tolerance have no such cure */
static void forces_between_exact_contacts_take_a_tolerance(void **state) {
  (void)state;
  told *t = open_told("support/walk_without_reaction", NULL);
  add(t, AMBULO__KIND_GROUND_FORCE, AMBULO__BODY_WEIGHTS, 2.0);
  tell(t, &t->cure);
  assert_string_equal(t->report.family[0].settings,
                      "--set constraints.contact_tolerance=0.002 --set time.intervals=72");
  has(t->report.family[0].advice, "more intervals do not help while contacts are exact");
  close_told(t);
  t = open_told("support/walk_without_reaction", "trajectory.intervals=40");
  add(t, AMBULO__KIND_GROUND_FORCE, AMBULO__BODY_WEIGHTS, 2.0);
  tell(t, &t->cure);
  assert_string_equal(t->report.family[0].settings,
                      "--set constraints.contact_tolerance=0.002 --set time.intervals=120");
  close_told(t);
  t = open_told("support/walk_rigid", NULL);
  add(t, AMBULO__KIND_GROUND_FORCE, AMBULO__BODY_WEIGHTS, 2.0);
  tell(t, &t->cure);
  assert_string_equal(t->report.family[0].settings, "");
  assert_string_equal(t->report.family[0].advice, "more intervals do not help");
  close_told(t);
}

/* what takes more intervals than are tried is told apart from what none help */
static void too_far_off_is_no_cannot(void **state) {
  (void)state;
  told *t = open_told("support/walk_without_reaction", NULL);
  t->cure.out_of_reach[add(t, AMBULO__KIND_SLIP, AMBULO__METRES, 90.0)] = 1;
  add(t, AMBULO__KIND_CLEARANCE, AMBULO__METRES, 2.0);
  tell(t, &t->cure);
  assert_string_equal(t->report.family[0].settings, "");
  has(t->report.family[0].advice,
      "too far off on a grid this coarse to predict how many intervals it takes; look again with "
      "--set time.intervals=48 --set trajectory.intervals=36");
  assert_string_equal(
      t->report.summary,
      "optimal, but a little off between the nodes; slip: too far off on a grid this "
      "coarse to predict how many intervals it takes; clearance: more intervals "
      "do not help");
  close_told(t);
}

static void what_is_not_finite_has_no_number(void **state) {
  (void)state;
  told *t = open_told("support/walk_rigid", NULL);
  t->cure.intervals = 50;
  t->cure.cured[add(t, AMBULO__KIND_SLIP, AMBULO__METRES, (double)NAN)] = 1;
  tell(t, &t->cure);
  assert_string_equal(t->report.line[0], "slip: not finite (knee upper, t = 0.25 s; tolerance 0.5 "
                                         "m): the motion overflows there");
  assert_string_equal(t->report.summary,
                      "optimal, but a little off between the nodes; slip: not finite");
  close_told(t);
}

/* families that hold are passed over, wherever they stand; each that fails has a line */
static void only_what_fails_is_told(void **state) {
  (void)state;
  told *t = open_told("support/walk_rigid", NULL);
  t->cure.intervals = 50;
  t->cure.spline_intervals = 17;
  t->cure.cured[add(t, AMBULO__KIND_SLIP, AMBULO__METRES, 4.0)] = 1;
  t->cure.cured[add(t, AMBULO__KIND_PRESSURE, AMBULO__METRES, 0.5)] = 1;
  t->cure.cured[add(t, AMBULO__KIND_FRICTION, AMBULO__BODY_WEIGHTS, 3.0)] = 1;
  tell(t, &t->cure);
  assert_int_equal(t->report.view.line_count, 2);
  assert_string_equal(t->report.line[0],
                      "slip: 2 m (knee upper, t = 0.25 s; tolerance 0.5 m): more intervals help; "
                      "--set time.intervals=50");
  has(t->report.line[1], "friction: 1.5 body weights (");
  assert_string_equal(t->report.family[1].settings, "");
  assert_string_equal(t->report.summary,
                      "optimal, but a little off between the nodes; slip, friction: "
                      "again with --set time.intervals=50");
  close_told(t);
}

/* a family is named once under each cure, lengths and angles of contacts under different ones
 * twice; and a cure has one place in the sentence */
static void the_sentence_groups_by_cure(void **state) {
  (void)state;
  told *t = open_told("support/walk_rigid", NULL);
  t->cure.intervals = 50;
  t->cure.spline_intervals = 17;
  t->cure.cured[add(t, AMBULO__KIND_CONTACT, AMBULO__METRES, 4.0)] = 1;
  add(t, AMBULO__KIND_CLEARANCE, AMBULO__METRES, 3.5);
  t->cure.out_of_reach[add(t, AMBULO__KIND_SLIP, AMBULO__METRES, 3.2)] = 1;
  t->cure.cured[add(t, AMBULO__KIND_CONTACT, AMBULO__RADIANS, 3.0)] = 1;
  add(t, AMBULO__KIND_CLEARANCE, AMBULO__RADIANS, 2.0);
  t->cure.cured[add(t, AMBULO__KIND_PRESSURE, AMBULO__METRES, 1.5)] = 1;
  tell(t, &t->cure);
  assert_string_equal(
      t->report.summary,
      "optimal, but a little off between the nodes; contact, pressure: again with --set "
      "time.intervals=50; clearance: more intervals do not help; slip: too far off "
      "on a grid this coarse to predict how many intervals it takes");
  t->cure.cured[t->report.family_rule[3]] = 0;
  tell(t, &t->cure);
  has(t->report.summary, "; contact, pressure: again with --set time.intervals=50; clearance, "
                         "contact: more intervals do not help; slip");
  close_told(t);
}

/* nothing is said about a motion that holds; a second telling does not add to the first */
static void a_motion_that_holds_says_nothing(void **state) {
  (void)state;
  told *t = open_told("support/walk_rigid", NULL);
  add(t, AMBULO__KIND_SLIP, AMBULO__METRES, 4.0);
  tell(t, NULL);
  has(t->report.summary, "slip: no time was left");
  tell(t, NULL);
  assert_int_equal(t->report.view.line_count, 1);
  assert_string_equal(t->report.family[0].advice,
                      "no time was left to predict how many intervals it takes");
  t->report.family[0].holds = 1;
  t->report.view.failing = 0;
  tell(t, &t->cure);
  assert_int_equal(t->report.view.line_count, 0);
  assert_string_equal(t->report.summary, "");
  close_told(t);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(settings_that_stay_are_not_named),
      cmocka_unit_test(joint_limits_on_control_points_take_a_spline),
      cmocka_unit_test(forces_between_exact_contacts_take_a_tolerance),
      cmocka_unit_test(too_far_off_is_no_cannot),
      cmocka_unit_test(what_is_not_finite_has_no_number),
      cmocka_unit_test(only_what_fails_is_told),
      cmocka_unit_test(the_sentence_groups_by_cure),
      cmocka_unit_test(a_motion_that_holds_says_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
