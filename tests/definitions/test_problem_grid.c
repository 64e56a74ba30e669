/* `time:` and `trajectory:`. */
#include "definitions/problem_text.h"
#include "support/arm.h"

#define NONE "objective: none\n"
#define TIME "time: {duration: 2, intervals: 6}\n"

static void bases_are_read(void **state) {
  (void)state;
  static const struct {
    const char *text;
    ambulo_discretization discretization;
    int control_points;
  } cases[] = {
      {"", AMBULO_BSPLINE, 9},
      {"trajectory: {}\n", AMBULO_BSPLINE, 9},
      {"trajectory: {basis: bspline, degree: 5, intervals: 4}\n", AMBULO_BSPLINE, 9},
      {"trajectory: {breakpoints: [0, 0.5, 2]}\n", AMBULO_BSPLINE, 5},
      {"trajectory: {basis: central_difference}\n", AMBULO_CENTRAL_DIFFERENCE, 9},
      {"trajectory: {basis: hermite}\n", AMBULO_HERMITE, 14},
  };
  for (int i = 0; i < 6; i++) {
    char text[512];
    (void)snprintf(text, sizeof text, "%s%s%s%s", PENDULUM, NONE, TIME, cases[i].text);
    ambulo_problem *p = problem_of(text);
    assert_int_equal(p->definition.discretization, cases[i].discretization);
    assert_int_equal(ambulo_problem_control_point_count(p), cases[i].control_points);
    assert_int_equal(ambulo_problem_node_count(p), 7);
    assert_close(ambulo_problem_duration(p), 2.0, 0.0);
    ambulo_problem_free(p);
  }
}

static void breakpoints_are_kept(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(PENDULUM NONE TIME "trajectory: {breakpoints: [0, 0.5, 2]}\n");
  assert_int_equal(p->definition.spline_intervals, 2);
  assert_close(p->definition.breakpoints[1], 0.5, 0.0);
  ambulo_problem_free(p);
}

#define STEPS                                                                                      \
  "contacts:\n"                                                                                    \
  "  - {foot: left, mode: flat, from: 0, to: 0.8, place: [0, 0.09]}\n"                             \
  "  - {foot: right, mode: flat, from: 0.7, to: 1, place: [0.3, -0.09]}\n"

/* phases of 0.7, 0.1 and 0.2 s */
static void grids_are_read(void **state) {
  (void)state;
  ambulo_problem *p =
      problem_of(WALKER NONE STEPS "time: {duration: 1, intervals: 10, grid: events}\n"
                                   "trajectory: {knots: events, intervals: 10}\n");
  assert_int_equal(p->definition.grid, AMBULO_GRID_EVENTS);
  assert_int_equal(p->definition.knots, AMBULO_GRID_EVENTS);
  assert_close(p->times[6], 0.7, 1e-15); /* 7 due, but the short phase has two */
  assert_close(p->times[8], 0.8, 1e-15);
  assert_close(ambulo__basis_breakpoints(p->basis)[7], 0.7, 1e-15);
  assert_close(ambulo__basis_breakpoints(p->basis)[8], 0.8, 1e-15);
  ambulo_problem_free(p);
  p = problem_of(WALKER NONE STEPS "time: {duration: 1, intervals: 10, grid: uniform}\n"
                                   "trajectory: {knots: uniform}\n");
  assert_int_equal(p->definition.grid, AMBULO_GRID_UNIFORM);
  assert_int_equal(p->definition.knots, AMBULO_GRID_UNIFORM);
  ambulo_problem_free(p);
}

static void grids_that_are_none_are_placed(void **state) {
  (void)state;
  expect_refusal(PENDULUM "time: {duration: 1, intervals: 6, grid: event}\n" NONE, AMBULO_E_SCHEMA,
                 "p.yaml:4:41: error[E_SCHEMA]: got 'event'; expected one of: uniform, events");
  expect_refusal(PENDULUM NONE TIME "trajectory: {knots: even}\n", AMBULO_E_SCHEMA,
                 "p.yaml:6:21: error[E_SCHEMA]: got 'even'");
  expect_refusal(PENDULUM NONE TIME "trajectory: {breakpoints: [0, 1, 2], knots: events}\n",
                 AMBULO_E_SCHEMA, "knots are 'events', but breakpoints are given");
  expect_refusal(PENDULUM NONE TIME "trajectory: {basis: hermite, knots: events}\n",
                 AMBULO_E_SCHEMA, "'knots' means nothing with basis hermite");
  expect_refusal(PENDULUM NONE "time: {duration: 1, intervals: 6, grid: events}\n"
                               "trajectory: {basis: central_difference}\n",
                 AMBULO_E_SCHEMA, "p.yaml:5:41: error[E_SCHEMA]: grid 'events' with basis");
  expect_refusal(WALKER NONE STEPS "time: {duration: 1, intervals: 5, grid: events}\n",
                 AMBULO_E_PROBLEM, "time.intervals is 5; expected at least 6, 2 for each of the 3");
  expect_refusal(WALKER NONE STEPS "time: {duration: 1, intervals: 5}\n"
                                   "trajectory: {intervals: 2, knots: events}\n",
                 AMBULO_E_PROBLEM, "trajectory.intervals is 2; expected at least 3, 1 for each");
}

static void faults_are_placed(void **state) {
  (void)state;
  expect_refusal(PENDULUM "time: {duration: 0, intervals: 6}\n" NONE, AMBULO_E_SCHEMA,
                 "p.yaml:4:18: error");
  expect_refusal(PENDULUM "time: {duration: 1, intervals: 0}\n" NONE, AMBULO_E_SCHEMA,
                 "p.yaml:4:32: error");
  expect_refusal(PENDULUM "time: {duration: 1}\n" NONE, AMBULO_E_SCHEMA, "'intervals'");
  expect_refusal(PENDULUM "time: {intervals: 3}\n" NONE, AMBULO_E_SCHEMA, "'duration'");
  expect_refusal(PENDULUM NONE TIME "trajectory: {basis: bezier}\n", AMBULO_E_SCHEMA, "bezier");
  expect_refusal(PENDULUM NONE TIME "trajectory: {degree: 2}\n", AMBULO_E_SCHEMA, "p.yaml:6:22:");
  expect_refusal(PENDULUM NONE TIME "trajectory: {basis: hermite, degree: 3}\n", AMBULO_E_SCHEMA,
                 "'degree' means nothing with basis hermite");
  expect_refusal(PENDULUM NONE TIME "trajectory: {breakpoints: [0, 1]}\n", AMBULO_E_SCHEMA,
                 "breakpoints run from 0 s to 1 s; expected 0 s to 2 s");
  expect_refusal(PENDULUM NONE TIME "trajectory: {breakpoints: [0, 1.5, 1, 2]}\n", AMBULO_E_SCHEMA,
                 "breakpoint 1 s follows 1.5 s; expected rising times");
  expect_refusal(PENDULUM NONE TIME "trajectory: {breakpoints: [0, 1, 2], intervals: 3}\n",
                 AMBULO_E_SCHEMA, "3 breakpoints make 2 intervals; expected 3");
  expect_refusal(PENDULUM NONE TIME "trajectory: {breakpoints: 4}\n", AMBULO_E_SCHEMA,
                 "breakpoints are not a list");
}

/* `solver:`. */

#define HEAD PENDULUM "time: {duration: 1, intervals: 4}\nobjective: none\n"

static void absent_means_defaults(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(HEAD);
  ambulo_options got = ambulo_problem_options(p), want = ambulo_options_default();
  assert_int_equal(got.size, want.size);
  assert_int_equal(got.algorithm, want.algorithm);
  assert_int_equal(got.maximum_evaluations, want.maximum_evaluations);
  assert_close(got.feasibility_tolerance, want.feasibility_tolerance, 0.0);
  ambulo_problem_free(p);
}

static void without_a_file_all_are_defaults(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition definition = arm_definition(model);
  ambulo_problem *p = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &p), AMBULO_OK);
  ambulo_options got = ambulo_problem_options(p), want = ambulo_options_default();
  assert_int_equal(got.size, want.size);
  assert_int_equal(got.maximum_iterations, want.maximum_iterations);
  assert_int_equal(got.dense_samples, want.dense_samples);
  ambulo_problem_free(p);
  ambulo_model_free(model);
}

static void every_key_arrives(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      HEAD "solver: {algorithm: auglag, maximum_evaluations: 77, time_limit: 2.5,\n"
           "  feasibility_tolerance: 1e-7, optimality_tolerance: 1e-4, continuation: false,\n"
           "  dense_samples: 3}\n");
  ambulo_options o = ambulo_problem_options(p);
  assert_int_equal(o.algorithm, AMBULO_AUGLAG);
  assert_int_equal(o.maximum_evaluations, 77);
  assert_close(o.time_limit, 2.5, 0.0);
  assert_close(o.feasibility_tolerance, 1e-7, 1e-20);
  assert_close(o.optimality_tolerance, 1e-4, 1e-20);
  assert_int_equal(o.continuation, 0);
  assert_int_equal(o.dense_samples, 3);
  ambulo_problem_free(p);
}

static void switches_have_two_spellings(void **state) {
  (void)state;
  static const char *const words[] = {"on", "true", "off", "false"};
  for (int i = 0; i < 4; i++) {
    char text[256];
    (void)snprintf(text, sizeof text, HEAD "solver: {continuation: %s}\n", words[i]);
    ambulo_problem *p = problem_of(text);
    assert_int_equal(ambulo_problem_options(p).continuation, i < 2);
    ambulo_problem_free(p);
  }
}

static void test_problem_solver_faults_are_placed(void **state) {
  (void)state;
  expect_refusal(HEAD "solver: {algorithm: ipopt}\n", AMBULO_E_SCHEMA, "p.yaml:6:21: error");
  expect_refusal(HEAD "solver: {continuation: maybe}\n", AMBULO_E_SCHEMA, "p.yaml:6:24: error");
  expect_refusal(HEAD "solver: {time_limit: -1}\n", AMBULO_E_SCHEMA, "p.yaml:6:22: error");
  expect_refusal(HEAD "solver: {maximum_evaluations: 1.5}\n", AMBULO_E_SCHEMA,
                 "p.yaml:6:31: error");
  expect_refusal(HEAD "solver: {feasibility_tolerance: 0}\n", AMBULO_E_SCHEMA,
                 "p.yaml:6:33: error");
  expect_refusal(HEAD "solver: {tolerance: 1}\n", AMBULO_E_SCHEMA, "unknown key 'tolerance'");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(bases_are_read),
                                     cmocka_unit_test(breakpoints_are_kept),
                                     cmocka_unit_test(grids_are_read),
                                     cmocka_unit_test(grids_that_are_none_are_placed),
                                     cmocka_unit_test(faults_are_placed),
                                     cmocka_unit_test(absent_means_defaults),
                                     cmocka_unit_test(without_a_file_all_are_defaults),
                                     cmocka_unit_test(every_key_arrives),
                                     cmocka_unit_test(switches_have_two_spellings),
                                     cmocka_unit_test(test_problem_solver_faults_are_placed)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
