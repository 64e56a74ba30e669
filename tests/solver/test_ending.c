/* The ending tells which limit or which test ended a solve, and credits NLopt with nothing that it
 * did not do. */
#include "solver/result.h"
#include "ambulo/tools/load.h"
#include "solver/explain.h"
#include "support/at_nodes.h"
#include "support/engine_fixture.h"
#include "support/messages.h"

static ambulo_result *solve(const ambulo_problem *problem, const ambulo_options *options) {
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, options, NULL, NULL, NULL, &result), AMBULO_OK);
  return result;
}

static void expect(const ambulo_result *r, ambulo_ending ending, const char *words) {
  if (ambulo_result_ending_code(r) != ending || !strstr(ambulo_result_ending(r), words))
    print_error("%s: '%s', expected %s: '%s'\n", ambulo__ending_name(ambulo_result_ending_code(r)),
                ambulo_result_ending(r), ambulo__ending_name(ending), words);
  assert_int_equal(ambulo_result_ending_code(r), ending);
  assert_non_null(strstr(ambulo_result_ending(r), words));
}

static void limits_are_named(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_36");
  ambulo_options options = ambulo_problem_options(problem);
  options.maximum_iterations = 8;
  ambulo_result *r = solve(problem, &options);
  expect(r, AMBULO_ENDING_ITERATIONS, "the iteration limit was met (8)");
  assert_int_not_equal(verdict_at_nodes(r), AMBULO_OPTIMAL);
  assert_null(strstr(ambulo_result_ending(r), "converged"));
  ambulo_result_free(r);
  options = ambulo_problem_options(problem);
  options.maximum_evaluations = 60;
  r = solve(problem, &options);
  expect(r, AMBULO_ENDING_EVALUATIONS, "the evaluation limit was met (60)");
  ambulo_result_free(r);
  options = ambulo_problem_options(problem);
  options.time_limit = 0.02;
  r = solve(problem, &options);
  expect(r, AMBULO_ENDING_TIME, "the time limit was met (0.02 s)");
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

static int stop(void *user, const ambulo_progress *progress) {
  (void)user;
  return progress->iteration >= 3;
}

static void tests_are_named(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_36");
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *r = solve(problem, &options);
  expect(r, AMBULO_ENDING_CONVERGED, "reduced gradient is small");
  ambulo_result_free(r);
  options.progress = stop;
  r = solve(problem, &options);
  expect(r, AMBULO_ENDING_CALLER, "stopped by the caller");
  ambulo_result_free(r);
  ambulo_problem_free(problem);
  problem = load_problem_with("yardstick_12", "trajectory={basis: hermite}");
  r = solve(problem, NULL);
  expect(r, AMBULO_ENDING_VANISHED, "went to zero");
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

/* where NLopt ends the solve its word is given; where the pipeline does, only its part is named */
static void nlopt_has_its_own_words(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("support/two_link_reach");
  ambulo_options options = ambulo_problem_options(problem);
  options.algorithm = AMBULO_SLSQP;
  ambulo_result *r = solve(problem, &options);
  expect(r, AMBULO_ENDING_SETTLED, "NLopt's SLSQP, whitened (its last call: ");
  ambulo_result_free(r);
  ambulo_problem_free(problem);
  problem = load_problem("support/walker_2d_step");
  r = solve(problem, NULL);
  expect(r, AMBULO_ENDING_CONVERGED, "NLopt's AUGLAG with LBFGS: the objective settled");
  assert_null(strstr(ambulo_result_ending(r), "its last call"));
  assert_null(strstr(ambulo_result_ending(r), "contradict")); /* none do */
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

/* a cap that ends nothing changes nothing */
static void caps_that_are_not_met_change_nothing(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_12");
  ambulo_options options = ambulo_problem_options(problem);
  ambulo_result *a = solve(problem, &options);
  options.maximum_iterations = ambulo_result_iterations(a);
  ambulo_result *b = solve(problem, &options);
  assert_close(ambulo_result_objective(b), ambulo_result_objective(a), 0.0);
  expect(b, AMBULO_ENDING_CONVERGED, "");
  ambulo_result_free(a);
  ambulo_result_free(b);
  ambulo_problem_free(problem);
}

/* heavier and heavier loads on limited joints: a few thousandths of a newton metre are no reason to
 * call a walk infeasible */
static void torques_are_judged_by_their_size(void **state) {
  (void)state;
  static const char *const loads[] = {"load.mass=60", "load.mass=150"};
  for (size_t i = 0; i < 2; i++) {
    const char *overrides[] = {loads[i], "constraints.torque_limits=true"};
    ambulo_problem *problem = NULL;
    assert_int_equal(
        ambulo_problem_load("models/walk_loaded.yaml", overrides, 2, NULL, NULL, &problem),
        AMBULO_OK);
    ambulo_result *r = solve(problem, NULL);
    const ambulo_violation *v = &ambulo_result_audit(r)->violation;
    if (verdict_at_nodes(r) != AMBULO_OPTIMAL)
      print_error("%s: %s, %s off by %g %s\n", loads[i], ambulo_verdict_name(verdict_at_nodes(r)),
                  v->family, v->worst, v->unit);
    assert_int_equal(verdict_at_nodes(r), AMBULO_OPTIMAL);
    ambulo_result_free(r);
    ambulo_problem_free(problem);
  }
}

/* every family has a size that belongs to its unit */
static void violations_have_sizes(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("support/two_link_reach");
  ambulo_result *r = solve(problem, NULL);
  const double *gravity = ambulo_model_gravity(ambulo_problem_model(problem));
  double weight = ambulo_model_mass(ambulo_problem_model(problem)) * fabs(gravity[1]);
  for (int f = 0; f < ambulo_result_family_count(r); f++) {
    const ambulo_violation *v = ambulo_result_family(r, f);
    double want = !strcmp(v->unit, "N m") ? weight : !strcmp(v->unit, "rad/s") ? 10.0 : 1.0;
    assert_close(v->size, want, 1e-12);
  }
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

/* a result that nobody filled is not judged */
static void zero_is_no_verdict(void **state) {
  (void)state;
  ambulo_verdict zero = (ambulo_verdict)0;
  assert_string_equal(ambulo_verdict_name(zero), "not_judged");
  assert_false(ambulo_verdict_is_solution(zero));
  for (int v = 1; v <= AMBULO_FEASIBLE_AT_NODES; v++)
    assert_int_equal(ambulo_verdict_is_solution((ambulo_verdict)v),
                     v == AMBULO_OPTIMAL || v == AMBULO_FEASIBLE);
  ambulo_problem *problem = load_problem("pendulum_swing");
  ambulo_result *r = NULL;
  assert_int_equal(ambulo__result_create(problem, NULL, &r), AMBULO_OK);
  assert_int_equal(verdict_at_nodes(r), AMBULO_NOT_JUDGED);
  ambulo_options options = ambulo_options_default();
  assert_int_equal(ambulo__verdict_of(ambulo_result_audit(r), &options, AMBULO_ENDING_CONVERGED),
                   AMBULO_NUMERIC_FAILURE);
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

static void endings_have_names(void **state) {
  (void)state;
  for (int a = AMBULO_ENDING_NONE; a <= AMBULO_ENDING_CALLER; a++) {
    assert_true(strlen(ambulo__ending_text((ambulo_ending)a)) > 10);
    for (int b = AMBULO_ENDING_NONE; b < a; b++)
      assert_string_not_equal(ambulo__ending_name((ambulo_ending)a),
                              ambulo__ending_name((ambulo_ending)b));
  }
  assert_string_equal(ambulo__ending_name((ambulo_ending)99), "unknown");
}

/* that no metric could be factored says nothing about the rows: no conflict is shown */
static void a_breakdown_is_a_numeric_failure(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo_audit audit = {.violation = {.worst = 0.1, .size = 1.0}, .kkt = 1.0};
  assert_int_equal(ambulo__verdict_of(&audit, &options, AMBULO_ENDING_BREAKDOWN),
                   AMBULO_NUMERIC_FAILURE);
  assert_int_equal(ambulo__verdict_of(&audit, &options, AMBULO_ENDING_STALLED), AMBULO_INFEASIBLE);
  audit.violation.worst = 0.0;
  assert_int_equal(ambulo__verdict_of(&audit, &options, AMBULO_ENDING_BREAKDOWN), AMBULO_FEASIBLE);
}

/* a method gave up because of what was not finite lately; a limit or a test that ended it did not
 */
static void faults_end_what_gave_up(void **state) {
  (void)state;
  static const ambulo_ending gave_up[] = {AMBULO_ENDING_STALLED, AMBULO_ENDING_NO_DESCENT,
                                          AMBULO_ENDING_NOT_RESTORED, AMBULO_ENDING_BREAKDOWN,
                                          AMBULO_ENDING_NLOPT};
  for (size_t i = 0; i < sizeof gave_up / sizeof *gave_up; i++) {
    ambulo__run run = {.ending = gave_up[i], .faults = 3};
    ambulo__ending_of_faults(&run);
    assert_int_equal(run.ending, gave_up[i]); /* forgiven since */
    run.faults_lately = 1;
    ambulo__ending_of_faults(&run);
    assert_int_equal(run.ending, AMBULO_ENDING_NOT_FINITE);
  }
  ambulo__run broken = {.ending = AMBULO_ENDING_NOT_RESTORED, .breakdowns = 1};
  ambulo__ending_of_faults(&broken); /* nothing was shown of the equalities */
  assert_int_equal(broken.ending, AMBULO_ENDING_BREAKDOWN);
  broken.ending = AMBULO_ENDING_STALLED;
  ambulo__ending_of_faults(&broken);
  assert_int_equal(broken.ending, AMBULO_ENDING_STALLED);
  ambulo__run_forgive(&broken);
  assert_int_equal(broken.breakdowns, 0);
  ambulo__run run = {.ending = AMBULO_ENDING_CONVERGED, .faults = 1, .faults_lately = 1};
  ambulo__ending_of_faults(&run);
  assert_int_equal(run.ending, AMBULO_ENDING_CONVERGED);
}

/* the last one explains a failure, the first one is reported for a success */
static void faults_are_reported(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__run run = {.faults = 1, .evaluations = 40};
  ambulo_result r = {.verdict = AMBULO_OPTIMAL};
  run.first_fault = (ambulo_fault){.kind = AMBULO_FAULT_TERM, .name = "first", .value = NAN};
  run.fault = (ambulo_fault){.kind = AMBULO_FAULT_TERM, .name = "last", .value = NAN};
  ambulo__report_faults(&run, &r, list);
  assert_message(list, 0,
                 "1 of 40 points were rejected; at the first the value of objective term "
                 "'first'");
  assert_int_equal(r.audit.fault.kind, AMBULO_FAULT_NONE);
  r.verdict = AMBULO_NUMERIC_FAILURE;
  ambulo__report_faults(&run, &r, list);
  assert_string_equal(r.audit.fault.name, "last");
  assert_message(list, 1, "'last'");
  run = (ambulo__run){.faults = 0};
  r = (ambulo_result){.verdict = AMBULO_OPTIMAL};
  ambulo__report_faults(&run, &r, list);
  assert_int_equal(ambulo_diagnostics_count(list), 2);
  ambulo_diagnostics_free(list);
}

/* infeasible is what the least violation shows, not what a search ended with; of iterations only
 * where there were no fewer than usual */
static void verdicts_are_settled_by_explanations(void **state) {
  (void)state;
  static const ambulo_ending endings[] = {AMBULO_ENDING_STALLED, AMBULO_ENDING_ITERATIONS,
                                          AMBULO_ENDING_EVALUATIONS, AMBULO_ENDING_TIME};
  for (int k = 0; k < 32; k++) {
    int ending = k & 3, confirmed = (k >> 2) & 1, said = (k >> 3) & 1, few = (k >> 4) & 1;
    ambulo__explanation *e = calloc(1, sizeof *e);
    ambulo_options options = ambulo_options_default();
    if (few) options.maximum_iterations -= 1;
    ambulo__run run = {.options = &options, .ending = endings[ending]};
    ambulo_verdict before = ending ? AMBULO_LIMIT_REACHED : AMBULO_INFEASIBLE, after = before;
    ambulo_result r = {.verdict = before};
    e->view.confirmed = confirmed;
    if (said) r.explanation = e;
    ambulo__settle_verdict(&run, &r);
    if (said && !confirmed && ending == 0) after = AMBULO_NOT_CONVERGED;
    if (said && confirmed && ending == 1 && !few) after = AMBULO_INFEASIBLE;
    assert_int_equal(r.verdict, after);
    free(e);
  }
}

/* families by how much they are off in their size */
static void families_are_reported_by_size(void **state) {
  (void)state;
  ambulo_violation families[2] = {
      {.family = "torque_limit", .subject = "a", .detail = "b", .unit = "N m", .worst = 1e-3},
      {.family = "joint_limit", .subject = "c", .detail = "d", .unit = "rad", .worst = 1e-3}};
  families[0].size = 2000.0;
  families[1].size = 1.0;
  ambulo_result r = {.verdict = AMBULO_INFEASIBLE, .families = 2, .family = families};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__report_families(&r, 1e-6, list);
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  assert_message(list, 0, "no point was found that satisfies joint_limit: c (d)");
  r.verdict = AMBULO_NOT_CONVERGED;
  ambulo__report_families(&r, 1e-6, list);
  assert_int_equal(ambulo_diagnostics_count(list), 2);
  r.verdict = AMBULO_OPTIMAL;
  ambulo__report_families(&r, 1e-6, list);
  assert_int_equal(ambulo_diagnostics_count(list), 2);
  ambulo_diagnostics_free(list);
}

/* SLSQP alone, too, which here would go on */
static void small_problems_keep_to_the_limit(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/infeasible/torque_too_weak.yaml", NULL, 0, NULL, NULL, &problem),
      AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  options.maximum_iterations = 1;
  options.algorithm = AMBULO_SLSQP;
  ambulo_result *r = solve(problem, &options);
  expect(r, AMBULO_ENDING_ITERATIONS, "the iteration limit was met (1); 1 iterations");
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(faults_end_what_gave_up),
      cmocka_unit_test(a_breakdown_is_a_numeric_failure),
      cmocka_unit_test(faults_are_reported),
      cmocka_unit_test(verdicts_are_settled_by_explanations),
      cmocka_unit_test(families_are_reported_by_size),
      cmocka_unit_test(small_problems_keep_to_the_limit),
      cmocka_unit_test(limits_are_named),
      cmocka_unit_test(tests_are_named),
      cmocka_unit_test(nlopt_has_its_own_words),
      cmocka_unit_test(caps_that_are_not_met_change_nothing),
      cmocka_unit_test(torques_are_judged_by_their_size),
      cmocka_unit_test(violations_have_sizes),
      cmocka_unit_test(zero_is_no_verdict),
      cmocka_unit_test(endings_have_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
