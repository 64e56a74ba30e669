/* Thirteen problems without a solution (tests/infeasible), each with what it has to be told: some
 * are refused before solving, the others are explained afterwards. What is suggested can be set as
 * it stands, and leads to a motion that satisfies every row. */
#include "ambulo/tools/tools.h"
#include "solver/explain.h"
#include "support/at_nodes.h"
#include "support/engine_fixture.h"
#include "support/test.h"

typedef struct example {
  const char *file;
  const char *phrases[6]; /* every one has to stand in the messages or lines */
  int settings;           /* how many settings are suggested; following them cures the problem */
} example;

static const example refused[] = {
    {"foothold_out_of_reach",
     {"foot 'left'", "foot 'right'", "out of reach at t = 0 s", "2.02 m, the legs' length",
      "shorten the step by 0.535 m or more"},
     0},
    {"no_support", {"no foot touches the ground from 0.3 s to 0.5 s"}, 0},
    {"empty_support",
     {"the support polygon is empty at t = 0.068", "right flat, margin 0.15 m",
      "lower constraints.zmp_margin"},
     0},
    {"end_outside_range",
     {"the final value of elbow is 2.96706 rad", "expected -2.61799 to 2.61799 rad"},
     0},
    {"speed_limit_too_low",
     {"swing has to move by 3.14159 rad in 1 s, at 3.14159 rad/s on average",
      "its speed limit is 2.0944 rad/s"},
     0},
    {"travel_against_end_values",
     {"the final value of pelvis_tx is 0.5 m",
      "periodic ends with a travel of 0.6 m make it 0.6 m"},
     0},
    {"footholds_against_travel",
     {"foot 'right' stands at (0, 0) m at t = 0.6 s",
      "periodic ends with a travel of 0.3 m put it at (0.3, 0) m",
      "mirrored ends go with an odd number of equal steps"},
     0},
    {"state_off_the_ground",
     {"the initial state puts heel_r (foot 'right') 0.04 m above the ground at t = 0 s"},
     0},
};

static const example explained[] = {
    {"step_too_long",
     {"foot_strike: ", "relaxing foot_strike alone is enough: by 0.0075", "m at ",
      "forward, t = ", "0.015 m beyond reach: shorten the step from 1.75 m to 1.73",
      "no walk: a walk with these steps would need legs of 1.5 m"},
     2},
    {"range_excludes_posture",
     {"in conflict", "joint_limit: 0.037", "ground_penetration: 0.026",
      "on its limit: joint_limit knee_angle lower, 1.047 rad, t = 0 to 0.5 s",
      "suggestion: lower the lower end of the range of pelvis_ty by 0.06", "from -0.05 to -0.11"},
     1},
    {"torque_too_weak",
     {"relaxing torque_limit alone is enough: by 3.4",
      "N m at swing upper, t = ", "on its limit: torque_limit swing upper, 6 N m, t = ",
      "suggestion: raise the upper torque limit of swing by 3.4", "from 6 to 9.51"},
     1},
    {"support_too_narrow",
     {"relaxing zmp alone is enough: by 0.04", "m at support front, t = ",
      "suggestion: lower the margin of the zero-moment point by 0.04", "from 0.08 m to 0.03"},
     1},
    {"equalities_contradict",
     {"contradictory equality: tracking_tube", "m at pelvis_tx on, t = 0.6 s",
      "relaxing tracking_tube alone is enough: by 0.15 m",
      "relaxing periodic alone is enough: by 0.3 m at pelvis_tx value",
      "suggestion: let pelvis_tx leave the motion that it follows by 0.15"},
     1},
};

static ambulo_status load(const char *file, ambulo_diagnostics *list, ambulo_problem **problem) {
  char path[160];
  (void)snprintf(path, sizeof path, "tests/infeasible/%s.yaml", file);
  return ambulo_problem_load(path, NULL, 0, NULL, list, problem);
}

static void assert_phrases(const example *e, const char *text) {
  for (int i = 0; i < 6 && e->phrases[i]; i++) {
    if (strstr(text, e->phrases[i])) continue;
    print_error("%s says\n%s\nexpected it to contain\n  %s\n", e->file, text, e->phrases[i]);
    fail();
  }
}

static void are_refused_by_name(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
    char text[8000] = "";
    ambulo_problem *problem = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo_status status = load(refused[i].file, list, &problem);
    if (status != AMBULO_E_PROBLEM) print_error("%s is not refused\n", refused[i].file);
    assert_int_equal(status, AMBULO_E_PROBLEM);
    for (size_t m = 0; m < ambulo_diagnostics_count(list) && m < 3; m++) {
      size_t used = strlen(text);
      ambulo_diagnostics_format(list, m, text + used, sizeof text - used);
    }
    assert_phrases(&refused[i], text);
    ambulo_diagnostics_free(list);
  }
}

static void assert_consistent(const ambulo_explanation *e) {
  for (int i = 0; i < e->conflict_count; i++) {
    const ambulo_conflict *c = &e->conflicts[i];
    assert_true(c->shared.worst > 0.0 && c->shared.family[0] && c->shared.unit[0]);
    if (c->alone != 1) continue;
    assert_string_equal(c->relaxation.family, c->shared.family);
    assert_true(c->relaxation.worst > 0.0);
  }
  for (int i = 0; i < e->on_limit_count; i++) {
    assert_true(e->on_limits[i].nodes > 0 && e->on_limits[i].from <= e->on_limits[i].to);
  }
  assert_true(e->line_count > 0);
}

static ambulo_result *solve(const ambulo_problem *problem, ambulo_options *options) {
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, options, NULL, NULL, NULL, &result), AMBULO_OK);
  return result;
}

/* what is suggested can be set as it stands, and is enough */
static void follow(const example *e, const ambulo_explanation *explanation) {
  ambulo_problem *problem = NULL;
  char path[160];
  assert_int_equal(explanation->setting_count, e->settings);
  (void)snprintf(path, sizeof path, "tests/infeasible/%s.yaml", e->file);
  assert_int_equal(ambulo_problem_load(path, explanation->settings, explanation->setting_count,
                                       NULL, NULL, &problem),
                   AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *result = solve(problem, &options);
  if (!ambulo_verdict_is_solution(verdict_at_nodes(result)))
    print_error("%s with %s is %s\n", e->file, explanation->settings[0],
                ambulo_verdict_name(verdict_at_nodes(result)));
  assert_true(ambulo_verdict_is_solution(verdict_at_nodes(result)));
  assert_null(ambulo_result_explanation(result));
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void are_explained(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof explained / sizeof *explained; i++) {
    char text[12000] = "";
    ambulo_problem *problem = NULL;
    assert_int_equal(load(explained[i].file, NULL, &problem), AMBULO_OK);
    ambulo_options options = ambulo_problem_options(problem);
    ambulo_result *result = solve(problem, &options);
    assert_int_equal(verdict_at_nodes(result), AMBULO_INFEASIBLE);
    const ambulo_explanation *e = ambulo_result_explanation(result);
    assert_non_null(e);
    assert_consistent(e);
    for (int k = 0; k < e->line_count; k++) {
      size_t used = strlen(text);
      (void)snprintf(text + used, sizeof text - used, "%s\n", e->lines[k]);
    }
    assert_phrases(&explained[i], text);
    follow(&explained[i], e);
    ambulo_result_free(result);
    ambulo_problem_free(problem);
  }
}

/* what is suggested when one row, the last one of these labels, is missed by `value` */
static void expect_suggestion(const ambulo_problem *problem, const char *family,
                              const char *subject, const char *detail, double value,
                              const char *phrase) {
  ambulo__explanation *out = calloc(1, sizeof *out);
  double *values = calloc((size_t)problem->rows, sizeof *values);
  ambulo__remedy remedy = {.conflict = 0, .row = -1, .value = values, .single = 1};
  for (int r = 0; r < problem->rows; r++) {
    const ambulo__table_row *row = &problem->table.rows[r];
    if (strcmp(row->family, family) || strcmp(row->subject, subject)) continue;
    if (!strcmp(row->detail, detail)) remedy.row = r;
  }
  assert_true(remedy.row >= 0);
  values[remedy.row] = value;
  ambulo__suggest(problem, &remedy, out);
  if (!strstr(out->suggestion, phrase)) print_error("got '%s'\n", out->suggestion);
  assert_non_null(strstr(out->suggestion, phrase));
  free(values);
  free(out);
}

/* periodic ends that miss by 0.3 m: a travel shorter by that much is what the rest allows */
static void the_travel_that_can_be_reached_is_named(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  assert_int_equal(load("equalities_contradict", NULL, &problem), AMBULO_OK);
  expect_suggestion(problem, "periodic", "pelvis_tx", "value", -0.3,
                    "change the travel from 0.3 m to 0 m");
  ambulo_problem_free(problem);
}

/* mirrored ends: the right knee may rest on the limit of the left one, the pelvis on one that it
 * comes to a step later; the model's numbers are reported, not what is left of them */
static void a_limit_of_the_mirrored_half_is_named(void **state) {
  (void)state;
  static const char *const overrides[] = {"model.links[shank_l].coordinate.range=[0, 10]",
                                          "constraints.joint_limits=nodes"};
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walker_2d_step.yaml", overrides, 2, NULL, NULL, &problem),
      AMBULO_OK);
  double latest = 0.0;
  for (int r = 0; r < problem->rows; r++) latest = fmax(latest, problem->table.rows[r].time);
  assert_close(latest, 2.0 * ambulo_problem_duration(problem), 1e-12);
  expect_suggestion(problem, "joint_limit", "knee_angle_l", "upper", -0.1,
                    "raise the upper end of the range of knee_angle_l by 0.1 rad: from 0.1745 (10 "
                    "deg) to 0.2756 rad");
  expect_suggestion(problem, "joint_limit", "pelvis_tx", "upper", -0.1,
                    "raise the upper end of the range of pelvis_tx by 0.1 m: from 7 to 7.101 m");
  for (int r = 0; r < problem->rows; r++) /* nothing about the right one's upper limit */
    assert_false(!strcmp(problem->table.rows[r].subject, "knee_angle_r") &&
                 !strcmp(problem->table.rows[r].detail, "upper"));
  ambulo_problem_free(problem);
}

/* knees that cannot straighten: the rows of both rest on what the model says of the left one; a
 * range of two steps of 0.6 m and 0.001 m leaves the pelvis no choice (lengths of a model are
 * shares of the stature) */
static void limits_that_the_motion_rests_on_have_the_models_numbers(void **state) {
  (void)state;
  static const char *const overrides[] = {
      "model.links[shank_l].coordinate.range=[100, 120]",
      "model.links[pelvis_forward].coordinate.range=[-0.1, 0.5863]"};
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walker_2d_step.yaml", overrides, 2, NULL, NULL, &problem),
      AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *result = solve(problem, &options);
  const ambulo_explanation *e = ambulo_result_explanation(result);
  int left = 0, ahead = 0;
  assert_non_null(e);
  for (int i = 0; i < e->on_limit_count; i++) {
    const ambulo_on_limit *l = &e->on_limits[i];
    int knee = strstr(l->subject, "knee_angle_") != NULL && !strcmp(l->detail, "lower");
    if (!strcmp(l->subject, "pelvis_tx") && !strcmp(l->detail, "upper")) {
      assert_close(l->bound, 0.5863 * 1.75, 1e-12);
      ahead = 1;
    }
    if (!knee) continue;
    assert_string_equal(l->subject, "knee_angle_l");
    assert_close(l->bound, 100.0 / 57.295779513082321, 1e-12);
    assert_true(l->to > ambulo_problem_duration(problem));
    left = 1;
  }
  assert_true(left && ahead);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void good_ends_and_audits_need_no_explanation(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("pendulum_swing");
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *result = solve(problem, &options), *audit = NULL;
  assert_null(ambulo_result_explanation(result));
  double *zero = calloc((size_t)ambulo_problem_variable_count(problem), sizeof *zero);
  assert_int_equal(ambulo_audit_point(problem, &options, zero, NULL, NULL, &audit), AMBULO_OK);
  assert_int_equal(verdict_at_nodes(audit), AMBULO_INFEASIBLE);
  assert_null(ambulo_result_explanation(audit));
  free(zero);
  ambulo_result_free(audit);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* too few evaluations: a motion exists, and the explanation says so */
static void a_missed_solution_is_named(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("support/two_link_reach");
  ambulo_options options = ambulo_problem_options(problem);
  options.maximum_evaluations = 1;
  ambulo_result *result = solve(problem, &options);
  if (verdict_at_nodes(result) == AMBULO_LIMIT_REACHED) {
    const ambulo_explanation *e = ambulo_result_explanation(result);
    assert_non_null(e);
    assert_true(e->feasible_point);
    assert_int_equal(e->conflict_count, 0);
  } else {
    assert_true(ambulo_verdict_is_solution(verdict_at_nodes(result)));
  }
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* a solve that a cap ended is told to raise the cap, whatever its point violates; as it stands the
 * suggestion can be set */
static void a_cap_is_to_be_raised(void **state) {
  (void)state;
  static const char *const caps[][2] = {
      {"solver.maximum_iterations=1", "solver.maximum_iterations=150"},
      {"solver.maximum_evaluations=70", "solver.maximum_evaluations=20000"},
      {"solver.time_limit=0.004", "solver.time_limit=0.008"}};
  static const char *const names[] = {"step_too_long", "support_too_narrow"};
  for (int k = 0; k < 6; k++) {
    ambulo_problem *problem = NULL;
    char path[160];
    (void)snprintf(path, sizeof path, "tests/infeasible/%s.yaml", names[k % 2]);
    assert_int_equal(ambulo_problem_load(path, caps[k / 2], 1, NULL, NULL, &problem), AMBULO_OK);
    ambulo_options options = ambulo_problem_options(problem);
    ambulo_result *result = solve(problem, &options);
    assert_int_equal(ambulo_result_verdict(result), AMBULO_LIMIT_REACHED);
    const ambulo_explanation *e = ambulo_result_explanation(result);
    assert_non_null(strstr(e->suggestion, "raise the cap"));
    assert_int_equal(e->setting_count, 1);
    assert_string_equal(e->settings[0], caps[k / 2][1]);
    for (int i = 0; i < e->conflict_count; i++) assert_int_equal(e->conflicts[i].alone, -1);
    ambulo_result_free(result);
    ambulo_problem_free(problem);
  }
}

/* rows that hold to 1e-8 of their size are not "in conflict", whatever tolerance was asked for */
static void what_all_but_holds_is_no_conflict(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("support/walk_without_reaction");
  ambulo_options options = ambulo_problem_options(problem);
  options.feasibility_tolerance = 1e-14;
  options.maximum_iterations = 60;
  ambulo_result *result = solve(problem, &options);
  const ambulo_explanation *e = ambulo_result_explanation(result);
  double left = ambulo_result_audit(result)->violation.worst, asked = 0.0;
  if (e && left < 1e-6) {
    assert_true(ambulo_result_verdict(result) != AMBULO_INFEASIBLE);
    assert_int_equal(e->conflict_count, 0);
    assert_int_equal(e->on_limit_count, 0);
    assert_int_equal(e->setting_count, 1);
    assert_int_equal(sscanf(e->settings[0], "solver.feasibility_tolerance=%lf", &asked), 1);
    assert_true(asked > left && asked < 10.0 * left);
  } else {
    assert_true(ambulo_verdict_is_solution(verdict_at_nodes(result)));
  }
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void a_spent_time_limit_is_kept(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  assert_int_equal(load("step_too_long", NULL, &problem), AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  options.time_limit = 0.02;
  ambulo_result *result = solve(problem, &options);
  assert_int_equal(verdict_at_nodes(result), AMBULO_LIMIT_REACHED);
  const ambulo_explanation *e = ambulo_result_explanation(result);
  assert_non_null(e);
  assert_false(e->complete);
  assert_true(e->line_count >= 2);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(are_refused_by_name),
      cmocka_unit_test(are_explained),
      cmocka_unit_test(the_travel_that_can_be_reached_is_named),
      cmocka_unit_test(a_limit_of_the_mirrored_half_is_named),
      cmocka_unit_test(limits_that_the_motion_rests_on_have_the_models_numbers),
      cmocka_unit_test(good_ends_and_audits_need_no_explanation),
      cmocka_unit_test(a_cap_is_to_be_raised),
      cmocka_unit_test(a_missed_solution_is_named),
      cmocka_unit_test(what_all_but_holds_is_no_conflict),
      cmocka_unit_test(a_spent_time_limit_is_kept)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
