/* `time:` and `trajectory:`. */
#include "reader/problem_text.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(bases_are_read),
                                     cmocka_unit_test(breakpoints_are_kept),
                                     cmocka_unit_test(faults_are_placed)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
