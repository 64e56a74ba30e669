/* `gait.phases`: shares of the stride, or functions of the speed. */
#include "definitions/problem_text.h"
#include "ambulo/tools/load.h"

#define WALK                                                                                       \
  "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\nobjective: none\n"                         \
  "time: {intervals: 20, grid: events}\ntrajectory: {knots: events}\n"                             \
  "ends: {kind: mirrored}\ngait: {steps: 1, first_foot: left, step_width: 0.1, "

#define YARDSTICK                                                                                  \
  "ambulo: 1\nkind: problem\nmodel: yardstick_body.yaml\nobjective: none\n"                        \
  "time: {intervals: 20}\ngait: {steps: 1, first_foot: left, "

static ambulo_gait walk_of(const char *rest) {
  char text[1024];
  (void)snprintf(text, sizeof text, WALK "%s}\n", rest);
  ambulo_problem *problem = problem_of(text);
  ambulo_gait walk = problem->keys.walk;
  ambulo_problem_free(problem);
  return walk;
}

static void expect_phases(const ambulo_gait *walk, double flat, double heel, double toe) {
  assert_close(walk->heel_strike, 0.0, 0.0);
  assert_close(walk->foot_flat, flat, 1e-14);
  assert_close(walk->heel_off, heel, 1e-14);
  assert_close(walk->toe_off, toe, 1e-14);
}

/* of 1.75 m and 9.81 m/s^2 */
static double number_of(double speed) {
  return speed / sqrt(9.81 * 1.75);
}

static void textbook_timing_is_the_default_at_every_speed(void **state) {
  (void)state;
  ambulo_gait slow = walk_of("speed: 0.8"), fast = walk_of("speed: 1.9");
  expect_phases(&slow, 0.08, 0.38, 0.62);
  expect_phases(&fast, 0.08, 0.38, 0.62);
}

static void people_stand_for_less_of_a_fast_stride(void **state) {
  (void)state;
  static const double speeds[] = {0.6, 1.28, 2.2};
  for (int i = 0; i < 3; i++) {
    char text[64];
    (void)snprintf(text, sizeof text, "speed: %g, phases: by_speed", speeds[i]);
    ambulo_gait walk = walk_of(text);
    double beyond = number_of(speeds[i]) - 0.31;
    expect_phases(&walk, 0.08, 0.38 - 0.145 * beyond, 0.62 - 0.145 * beyond);
  }
  /* Kirtley et al. (1985): 3.5 % of the stride for 1 m/s */
  ambulo_gait one = walk_of("speed: 1, phases: by_speed");
  ambulo_gait two = walk_of("speed: 2, phases: by_speed");
  assert_close(one.toe_off - two.toe_off, 0.035, 2e-4);
}

/* statures of a step, as a function of the speed number; the step time follows */
static void step_lengths_go_with_the_speed(void **state) {
  (void)state;
  ambulo_gait run = walk_of("speed: 3, step_length: {comfortable: 0.36, slope: 0.6}");
  double length = 1.75 * (0.36 + 0.6 * (number_of(3.0) - 0.31));
  assert_close(run.step_length, length, 1e-14);
  assert_close(run.step_time, length / 3.0, 1e-14);
  assert_int_equal(run.forefoot, 0);
  run = walk_of("speed: 3, landing: forefoot");
  assert_int_equal(run.forefoot, 1);
  run = walk_of("speed: 3, landing: heel");
  assert_int_equal(run.forefoot, 0);
  expect_refusal(WALK "step_time: 0.5, step_length: {comfortable: 0.36, slope: 0.6}}\n",
                 AMBULO_E_PROBLEM, "a step length by speed, but no gait.speed; expected a length");
  expect_refusal(WALK "speed: 9, step_length: {comfortable: 0.36, slope: -0.6}}\n",
                 AMBULO_E_PROBLEM, "expected a length above 0");
  expect_refusal(WALK "speed: 1, step_length: {comfortable: 0.36}}\n", AMBULO_E_SCHEMA, "slope");
  expect_refusal(YARDSTICK "speed: 1, step_length: {comfortable: 0.36, slope: 0.1}}\n",
                 AMBULO_E_PROBLEM, "no stature or no gravity");
  expect_refusal(WALK "speed: 1, landing: toes}\n", AMBULO_E_SCHEMA, "forefoot");
}

static void functions_are_read(void **state) {
  (void)state;
  ambulo_gait walk = walk_of("speed: 1.6, phases: {foot_flat: 0.09, heel_off: {slope: 0.1}, "
                             "toe_off: {comfortable: 0.6, slope: -0.3}}");
  double beyond = number_of(1.6) - 0.31;
  expect_phases(&walk, 0.09, 0.38 + 0.1 * beyond, 0.6 - 0.3 * beyond);
}

/* a stature of 1.4 m at the speed that has the same number */
static void phases_follow_the_number_and_not_the_speed(void **state) {
  (void)state;
  char text[160];
  (void)snprintf(text, sizeof text, "speed: %.17g, phases: by_speed}\nsubject: {stature: 1.4",
                 1.6 * sqrt(1.4 / 1.75));
  ambulo_gait large = walk_of("speed: 1.6, phases: by_speed"), small = walk_of(text);
  expect_phases(&small, large.foot_flat, large.heel_off, large.toe_off);
}

/* the speed that a step's length and time make */
static void lengths_and_times_make_the_speed(void **state) {
  (void)state;
  ambulo_gait walk = walk_of("step_length: 0.7, step_time: 0.5, phases: by_speed");
  expect_phases(&walk, 0.08, 0.38 - 0.145 * (number_of(1.4) - 0.31),
                0.62 - 0.145 * (number_of(1.4) - 0.31));
}

/* of both steps together */
static void two_unlike_steps_have_one_speed(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\nobjective: none\n"
      "time: {intervals: 20}\nends: {kind: periodic}\n"
      "gait: {steps: 2, first_foot: left, step_length: [0.6, 0.8], step_time: [0.5, 0.6], "
      "phases: by_speed}\n");
  assert_close(p->keys.walk.toe_off, 0.62 - 0.145 * (number_of(1.4 / 1.1) - 0.31), 1e-14);
  ambulo_problem_free(p);
}

/* on the moon people are faster at a lower speed */
static void the_number_is_by_gravity(void **state) {
  (void)state;
  static const char moon[] = "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\nobjective: "
                             "none\ntime: {intervals: 20}\nends: {kind: mirrored}\n"
                             "gait: {steps: 1, first_foot: left, speed: 1, phases: by_speed}\n";
  const char *overrides[] = {"model.gravity=[0, -1.62, 0]"};
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = moon,
                                                      .length = strlen(moon),
                                                      .name = "p.yaml",
                                                      .directory = "models",
                                                      .overrides = overrides,
                                                      .override_count = 1},
                               NULL, NULL, &p),
      AMBULO_OK);
  assert_close(p->keys.walk.toe_off, 0.62 - 0.145 * (1.0 / sqrt(1.62 * 1.75) - 0.31), 1e-14);
  ambulo_problem_free(p);
}

/* one fault is one error: phases have a speed to be read at, whatever became of it */
static void a_speed_that_is_none_is_the_only_fault(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *p = NULL;
  assert_int_equal(load_text(WALK "speed: -1, phases: {toe_off: {slope: -0.2}}}\n", list, &p),
                   AMBULO_E_SCHEMA);
  assert_int_equal(ambulo_diagnostics_error_count(list), 1);
  ambulo_diagnostics_free(list);
}

static void faults_are_named(void **state) {
  (void)state;
  expect_refusal(WALK "speed: 2, phases: {heel_strike: {slope: -9}}}\n", AMBULO_E_PROBLEM,
                 "expected -0.49 to 0.49");
  expect_refusal(WALK "speed: 2, phases: {heel_strike: 0.6}}\n", AMBULO_E_SCHEMA,
                 "got '0.6'; expected a number from -0.49 to 0.49");
  expect_refusal(WALK "speed: 2, phases: {toe_off: 1.2}}\n", AMBULO_E_SCHEMA,
                 "got '1.2'; expected a number from -0.49 to 1");
  expect_refusal(WALK "speed: 2, phases: {toe_of: 0.6}}\n", AMBULO_E_SCHEMA, "toe_of");
  expect_refusal(WALK "speed: 2, phases: {toe_off: by_speed}}\n", AMBULO_E_SCHEMA,
                 "got 'by_speed' for one phase; expected a number, or {comfortable, slope}");
  expect_refusal(WALK "speed: 2, phases: {toe_off: {slope: -2}}}\n", AMBULO_E_PROBLEM,
                 "hint: phases go with the speed, here 0.4827 sqrt(g H)");
  expect_refusal(WALK "speed: 1, phases: by_sped}\n", AMBULO_E_SCHEMA, "by_speed");
  expect_refusal(WALK "speed: 1, phases: [0, 1]}\n", AMBULO_E_SCHEMA, "'phases' is a list");
  expect_refusal(WALK "speed: 1, phases: {toe_off: {}}}\n", AMBULO_E_SCHEMA,
                 "a phase without a number");
  expect_refusal(WALK "speed: 1, phases: {toe_off: {slop: 1}}}\n", AMBULO_E_SCHEMA, "slop");
  expect_refusal(WALK "speed: 2, phases: {heel_strike: {slope: 9}}}\n", AMBULO_E_PROBLEM,
                 "heel_strike is at 1.5");
  expect_refusal(WALK "speed: 2, phases: {toe_off: {slope: -2}}}\n", AMBULO_E_PROBLEM,
                 "expected heel_strike <= foot_flat <= heel_off <= toe_off");
  expect_refusal(YARDSTICK "step_length: 0.6, step_time: 0.5, phases: by_speed}\n",
                 AMBULO_E_PROBLEM, "phases by speed of a model without stature");
  expect_refusal(YARDSTICK "step_length: 0.6, step_time: 0.5, phases: {toe_off: {slope: 0}}}\n",
                 AMBULO_E_PROBLEM, "a phase by speed of a model without stature");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(textbook_timing_is_the_default_at_every_speed),
      cmocka_unit_test(people_stand_for_less_of_a_fast_stride),
      cmocka_unit_test(step_lengths_go_with_the_speed),
      cmocka_unit_test(functions_are_read),
      cmocka_unit_test(phases_follow_the_number_and_not_the_speed),
      cmocka_unit_test(lengths_and_times_make_the_speed),
      cmocka_unit_test(two_unlike_steps_have_one_speed),
      cmocka_unit_test(the_number_is_by_gravity),
      cmocka_unit_test(a_speed_that_is_none_is_the_only_fault),
      cmocka_unit_test(faults_are_named),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
