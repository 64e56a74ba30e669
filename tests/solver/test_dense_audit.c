/* The dense audit as a result tells it: families, words, the warning, and what it says when there
 * is no finer grid or no finite motion. */
#include "solver/dense.h"
#include "ambulo/tools/load.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"

static ambulo_result *solve(const ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  ambulo_options options = ambulo_problem_options(p);
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(p, &options, NULL, NULL, diagnostics, &result), AMBULO_OK);
  return result;
}

static int warnings(const ambulo_diagnostics *diagnostics, const char *text) {
  int count = 0;
  for (size_t i = 0; i < ambulo_diagnostics_count(diagnostics); i++) {
    const ambulo_diagnostic *d = ambulo_diagnostics_get(diagnostics, i);
    count += d->severity == AMBULO_WARNING && strstr(d->message, text) != NULL;
  }
  return count;
}

/* the toe of the foot that leaves slips before toe-off, 0.1296 s */
static void a_walk_is_optimal_at_the_nodes_only(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_result *r = solve(p, diagnostics);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(r);
  const ambulo_dense_family *first = &dense->families[0];
  assert_int_equal(ambulo_result_verdict(r), AMBULO_OPTIMAL_AT_NODES);
  assert_int_equal(dense->samples, 10);
  assert_string_equal(first->violation.family, "slip");
  assert_non_null(strstr(first->violation.subject, "_r"));
  assert_close(first->violation.time, 0.1296, 1e-6);
  assert_true(first->violation.worst > 0.01 && first->violation.worst < 0.03);
  assert_close(first->tolerance, 0.001, 0.0);
  assert_memory_equal(&first->violation, &ambulo_result_audit(r)->dense_violation,
                      sizeof first->violation);
  int failing = 0;
  for (int i = 0; i < dense->family_count; i++) {
    const ambulo_dense_family *f = &dense->families[i];
    failing += !f->holds;
    assert_int_equal(f->holds, f->violation.worst <= f->tolerance);
    assert_int_equal(f->settings[0] != '\0', !f->holds);
    if (i > 0)
      assert_true(f->violation.worst / f->tolerance <= f[-1].violation.worst / f[-1].tolerance);
  }
  assert_int_equal(dense->failing, failing);
  assert_int_equal(dense->line_count, failing);
  assert_non_null(strstr(dense->lines[0], "slip: 0.02"));
  assert_non_null(strstr(dense->lines[0], "tolerance 0.001 m"));
  char setting[60];
  (void)snprintf(setting, sizeof setting, "--set time.intervals=%d", dense->intervals);
  assert_string_equal(first->settings, setting);
  assert_non_null(strstr(dense->summary, "optimal at the nodes only; slip, "));
  assert_non_null(strstr(dense->summary, setting));
  assert_int_equal(warnings(diagnostics, dense->summary), 1);
  assert_int_equal(ambulo_diagnostics_count(diagnostics), 1);
  ambulo_result_free(r);
  ambulo_diagnostics_free(diagnostics);
  ambulo_problem_free(p);
}

static void a_motion_that_holds_says_nothing(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("pendulum_swing");
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_result *r = solve(p, diagnostics);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(r);
  assert_int_equal(dense->failing, 0);
  assert_true(dense->family_count > 0 && dense->samples == 10);
  assert_string_equal(dense->summary, "");
  assert_string_equal(dense->reason, "");
  assert_int_equal(dense->line_count + dense->intervals, 0);
  assert_int_equal(ambulo_diagnostics_count(diagnostics), 0);
  ambulo_result_free(r);
  ambulo_diagnostics_free(diagnostics);
  ambulo_problem_free(p);
}

/* Thousands of a tolerance between its nodes, with an objective of zero: that nothing costs less
 * does not make it a motion. */
static void a_lower_bound_excuses_nothing_between_the_nodes(void **state) {
  (void)state;
  ambulo_problem *p = load_problem_with("yardstick_12", "trajectory.intervals=24");
  ambulo_result *r = solve(p, NULL);
  const ambulo_dense_family *worst = &ambulo_result_dense_audit(r)->families[0];
  assert_int_equal(ambulo_result_audit(r)->at_lower_bound, 1);
  assert_true(worst->violation.worst > 100.0 * worst->tolerance);
  assert_int_equal(ambulo_result_verdict(r), AMBULO_OPTIMAL_AT_NODES);
  assert_false(ambulo_verdict_is_solution(ambulo_result_verdict(r)));
  assert_non_null(strstr(ambulo_result_dense_audit(r)->summary, "optimal at the nodes only; zmp"));
  ambulo_result_free(r);
  ambulo_problem_free(p);
}

/* up to ten tolerances the verdict stays, beyond them it is that of the nodes */
static void ten_tolerances_are_the_line(void **state) {
  (void)state;
  static const double ratio[] = {0.5, 9.99, 10.0, 10.01, (double)NAN};
  for (int i = 0; i < 5; i++) {
    int far_off = i > 2;
    assert_int_equal(ambulo__verdict_between_nodes(AMBULO_OPTIMAL, ratio[i]),
                     far_off ? AMBULO_OPTIMAL_AT_NODES : AMBULO_OPTIMAL);
    assert_int_equal(ambulo__verdict_between_nodes(AMBULO_FEASIBLE, ratio[i]),
                     far_off ? AMBULO_FEASIBLE_AT_NODES : AMBULO_FEASIBLE);
    assert_int_equal(ambulo__verdict_between_nodes(AMBULO_INFEASIBLE, ratio[i]), AMBULO_INFEASIBLE);
  }
}

/* nothing is advised about a point that is no solution at the nodes either */
static void a_point_that_is_no_solution_is_only_measured(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  ambulo_options options = ambulo_problem_options(p);
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  double *zero = calloc((size_t)p->variables, sizeof *zero);
  ambulo_result *r = NULL;
  assert_int_equal(ambulo_audit_point(p, &options, zero, NULL, diagnostics, &r), AMBULO_OK);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(r);
  assert_int_equal(ambulo_result_verdict(r), AMBULO_INFEASIBLE);
  assert_true(dense->failing > 0);
  assert_string_equal(dense->summary, "");
  assert_int_equal(dense->line_count, 0);
  assert_int_equal(ambulo_diagnostics_count(diagnostics), 0);
  ambulo_result_free(r);
  ambulo_diagnostics_free(diagnostics);
  free(zero);
  ambulo_problem_free(p);
}

/* an audit of the same point says the same as its solve */
static void an_audit_says_what_the_solve_said(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/two_link_reach");
  ambulo_options options = ambulo_problem_options(p);
  ambulo_result *r = solve(p, NULL), *again = NULL;
  assert_int_equal(ambulo_audit_point(p, &options, ambulo_result_x(r), NULL, NULL, &again),
                   AMBULO_OK);
  assert_string_equal(ambulo_result_dense_audit(again)->summary,
                      ambulo_result_dense_audit(r)->summary);
  assert_true(ambulo_result_dense_audit(r)->summary[0] != '\0');
  ambulo_result_free(again);
  ambulo_result_free(r);
  ambulo_problem_free(p);
}

/* a result with the point x, judged optimal whatever x is */
static ambulo_result *result_of(const ambulo_problem *p, double value) {
  ambulo_result *r = NULL;
  assert_int_equal(ambulo__result_create(p, NULL, &r), AMBULO_OK);
  for (int i = 0; i < p->variables; i++) r->x[i] = value;
  r->verdict = AMBULO_OPTIMAL;
  return r;
}

static void a_motion_that_overflows_is_named(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  ambulo_result *r = result_of(p, 1e200);
  assert_int_equal(ambulo__dense_audit(p, 10, 1, NULL, r), AMBULO_OK);
  assert_int_equal(ambulo__dense_advise(p, 1, NULL, NULL, r), AMBULO_OK);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(r);
  assert_true(dense->failing > 0);
  assert_false(dense->families[0].holds);
  assert_true(!isfinite(dense->families[0].violation.worst));
  assert_non_null(strstr(dense->lines[0], ": not finite ("));
  assert_non_null(strstr(dense->lines[0], "the motion overflows there"));
  assert_non_null(strstr(dense->summary, "not finite"));
  assert_true(!isfinite(r->audit.dense_violation.worst));
  ambulo_result_free(r);
  ambulo_problem_free(p);
}

/* a height that no force can follow: places are numbers, the force is not, and comes first */
static void what_is_not_finite_comes_first(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  ambulo_result *r = result_of(p, 0.0);
  int height = ambulo_model_find_coordinate(p->model, "pelvis_ty");
  r->x[8 * p->coordinates + height] = 1e304;
  assert_int_equal(ambulo__dense_audit(p, 10, 1, NULL, r), AMBULO_OK);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(r);
  int finite = 0;
  for (int i = 0; i < dense->family_count; i++) {
    const ambulo_violation *v = &dense->families[i].violation;
    if (isfinite(v->worst)) finite++;
    if (finite) assert_true(isfinite(v->worst));
    if (strcmp(v->family, "slip") == 0) assert_true(isfinite(v->worst));
    if (strcmp(v->family, "ground_force") == 0) assert_true(!isfinite(v->worst));
  }
  assert_in_range(finite, 2, dense->family_count - 1);
  ambulo_result_free(r);
  ambulo_problem_free(p);
}

/* what holds at the nodes is advised about, the best motion or not */
static void a_feasible_motion_is_told_too(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  ambulo_result *r = result_of(p, 0.0);
  r->verdict = AMBULO_FEASIBLE;
  assert_int_equal(ambulo__dense_audit(p, 10, 1, NULL, r), AMBULO_OK);
  assert_int_equal(ambulo__dense_advise(p, 0, NULL, NULL, r), AMBULO_OK);
  assert_non_null(strstr(ambulo_result_dense_audit(r)->summary, "feasible at the nodes only; "));
  ambulo_result_free(r);
  ambulo_problem_free(p);
}

static void without_time_nothing_is_predicted(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  ambulo_result *r = result_of(p, 0.0);
  assert_int_equal(ambulo__dense_audit(p, 10, 1, NULL, r), AMBULO_OK);
  assert_int_equal(ambulo__dense_advise(p, 0, NULL, NULL, r), AMBULO_OK);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(r);
  assert_true(dense->failing > 0 && dense->intervals == 0);
  assert_non_null(strstr(dense->summary, "no time was left"));
  for (int i = 0; i < dense->family_count; i++)
    assert_string_equal(dense->families[i].settings, "");
  ambulo_result_free(r);
  ambulo_problem_free(p);
}

/* ------------------------------------------------------------- no finer grid */

static void check_refusal(const ambulo_problem *p, int samples, const char *reason) {
  ambulo_result *r = result_of(p, 0.0);
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__dense_audit(p, samples, 1, NULL, r), AMBULO_OK);
  assert_int_equal(ambulo__dense_advise(p, 1, NULL, diagnostics, r), AMBULO_OK);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(r);
  assert_int_equal(dense->samples, 0);
  assert_int_equal(dense->family_count, 0);
  if (!strstr(dense->reason, reason)) print_error("%s\n", dense->reason);
  assert_non_null(strstr(dense->reason, reason));
  assert_non_null(strstr(dense->summary, "optimal at the nodes; between them nothing is known: "));
  assert_true(isnan(r->audit.dense_violation.worst));
  assert_int_equal(warnings(diagnostics, dense->summary), 1);
  ambulo_result_free(r);
  ambulo_diagnostics_free(diagnostics);
}

static void a_grid_that_cannot_be_is_not_a_motion_that_holds(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("pendulum_swing");
  check_refusal(p, 1, "solver.dense_samples is 1");
  ambulo_problem_free(p);
  p = load_problem_with("pendulum_swing", "time.intervals=60000");
  check_refusal(p, 10, "too many time intervals");
  ambulo_problem_free(p);
  /* after a time limit a large grid is left alone, a small one takes no time */
  p = load_problem_with("pendulum_swing", "time.intervals=2001");
  ambulo_result *r = result_of(p, 0.0);
  assert_int_equal(ambulo__dense_audit(p, 10, 0, NULL, r), AMBULO_OK);
  assert_string_equal(ambulo_result_dense_audit(r)->reason, "no time was left");
  assert_int_equal(ambulo__dense_audit(p, 9, 0, NULL, r), AMBULO_OK);
  assert_string_equal(ambulo_result_dense_audit(r)->reason, "");
  assert_int_equal(ambulo__dense_audit(p, 10, 1, NULL, r), AMBULO_OK); /* there is time */
  assert_string_equal(ambulo_result_dense_audit(r)->reason, "");
  ambulo_result_free(r);
  ambulo_problem_free(p);
}

/* legal at its nodes; between two of them the body stands on the toes of one foot, a point */
static void a_refusal_between_the_nodes_is_told(void **state) {
  (void)state;
  const char *overrides[] = {"constraints.zmp=hull", "gait.phases.heel_strike=0",
                             "gait.phases.heel_off=0.49", "gait.phases.toe_off=0.6",
                             "time.intervals=16"};
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walker_2d_step.yaml", overrides, 5, NULL, NULL, &p),
      AMBULO_OK);
  check_refusal(p, 10, "the support polygon is empty at t = ");
  ambulo_problem_free(p);
}

/* --------------------------------------------------------------------- memory */

static int rule_of(ambulo__row_kind kind, ambulo__measure measure) {
  ambulo__table_row row = {.kind = (unsigned char)kind, .measure = (unsigned char)measure};
  return ambulo__dense_rule_of_row(&row);
}

/* lengths and angles of contacts fail alike: the sentence has their family once */
static void the_sentence_names_a_family_once(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/two_link_reach");
  ambulo__dense_report *report = calloc(1, sizeof *report);
  const ambulo__row_kind kinds[] = {AMBULO__KIND_CONTACT, AMBULO__KIND_ZMP, AMBULO__KIND_CONTACT};
  const ambulo__measure measures[] = {AMBULO__METRES, AMBULO__METRES, AMBULO__RADIANS};
  for (int i = 0; i < 3; i++) {
    const char *family = ambulo__row_family(kinds[i]), *unit = ambulo__measure_text(measures[i]);
    report->family_rule[i] = rule_of(kinds[i], measures[i]);
    report->family[i].violation = (ambulo_violation){
        .family = family, .subject = "a", .detail = "b", .unit = unit, .worst = 1.0, .size = 1.0};
  }
  report->view.family_count = report->view.failing = 3;
  report->view.samples = 10;
  ambulo__dense_words(p, AMBULO_OPTIMAL, NULL, report);
  assert_non_null(strstr(report->summary, "; contact, zmp: no time"));
  assert_int_equal(report->view.line_count, 3);
  free(report);
  ambulo_problem_free(p);
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walker_2d_step");
  long k = 0;
  for (int done = 0; !done; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_result *r = result_of(p, 0.01);
    ambulo_status status = ambulo__dense_audit(p, 10, 1, &allocator, r);
    if (!status) status = ambulo__dense_advise(p, 1, &allocator, NULL, r);
    assert_int_equal(memory.live, 0);
    done = !memory.failed;
    assert_int_equal(status, done ? AMBULO_OK : AMBULO_E_MEMORY);
    ambulo_result_free(r);
  }
  assert_true(k > 50);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_walk_is_optimal_at_the_nodes_only),
      cmocka_unit_test(a_lower_bound_excuses_nothing_between_the_nodes),
      cmocka_unit_test(ten_tolerances_are_the_line),
      cmocka_unit_test(a_motion_that_holds_says_nothing),
      cmocka_unit_test(a_point_that_is_no_solution_is_only_measured),
      cmocka_unit_test(an_audit_says_what_the_solve_said),
      cmocka_unit_test(a_motion_that_overflows_is_named),
      cmocka_unit_test(what_is_not_finite_comes_first),
      cmocka_unit_test(a_feasible_motion_is_told_too),
      cmocka_unit_test(without_time_nothing_is_predicted),
      cmocka_unit_test(a_grid_that_cannot_be_is_not_a_motion_that_holds),
      cmocka_unit_test(a_refusal_between_the_nodes_is_told),
      cmocka_unit_test(the_sentence_names_a_family_once),
      cmocka_unit_test(every_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
