/* `constraints:` and `ends:`. */
#include "support/find_capsule.h"
#include "base/diagnostics.h"
#include "definitions/problem_text.h"

#define TIME "objective: none\ntime: {duration: 1, intervals: 4}\n"

static void every_key_arrives(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      WALKER TIME "contacts: [{foot: left, mode: flat, from: 0, to: 1, place: [0, 0]}]\n"
                  "constraints:\n  ground_height: 0.1\n  ground_penetration: true\n"
                  "  foot_strike: true\n  zmp: hull\n  zmp_margin: 0.02\n  minimum_force: 0.3\n"
                  "  joint_limits: control_points\n  speed_limits: true\n  torque_limits: true\n");
  const ambulo_problem_definition *d = &p->definition;
  assert_close(d->ground_height, 0.1, 0.0);
  assert_int_equal(d->ground_penetration, 1);
  assert_int_equal(d->foot_strike, 1);
  assert_int_equal(d->support, AMBULO_SUPPORT_HULL);
  assert_close(d->support_margin, 0.02, 0.0);
  assert_close(d->minimum_force, 0.3, 0.0);
  assert_int_equal(d->joint_limits, AMBULO_LIMIT_CONTROL_POINTS);
  assert_int_equal(d->speed_limits, 1);
  assert_int_equal(d->torque_limits, 1);
  ambulo_problem_free(p);
}

static void absent_means_off(void **state) {
  (void)state;
  static const char *const texts[] = {PENDULUM TIME, PENDULUM TIME "constraints: {}\n",
                                      PENDULUM TIME "constraints: {minimum_force: off, zmp: off, "
                                                    "joint_limits: off}\nends: {}\n"};
  for (int i = 0; i < 3; i++) {
    ambulo_problem *p = problem_of(texts[i]);
    assert_int_equal(ambulo_problem_row_count(p), 0);
    assert_int_equal(p->definition.ends, AMBULO_ENDS_FREE);
    assert_true(isnan(p->definition.minimum_force));
    ambulo_problem_free(p);
  }
}

static void end_values_are_in_radians(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      WALKER TIME
      "angles: degrees\n"
      "ends: {kind: mirrored, order: 2, travel: 0.7,\n"
      "  initial: {pelvis_tx: 0.5, knee_angle_r: 90}, final_speed: {knee_angle_l: -180},\n"
      "  initial_speed: {pelvis_tx: 1.5}, final: {hip_flexion_l: 45},\n"
      "  initial_acceleration: {pelvis_ty: -2}, final_acceleration: {knee_angle_l: 90}}\n");
  const ambulo_problem_definition *d = &p->definition;
  assert_int_equal(d->ends, AMBULO_ENDS_MIRRORED);
  assert_int_equal(d->ends_order, 2);
  assert_close(d->travel, 0.7, 0.0);
  static const struct {
    const char *coordinate;
    int order, final;
    double value;
  } expected[] = {{"pelvis_tx", 0, 0, 0.5},
                  {"knee_angle_r", 0, 0, 1.5707963267948966},
                  {"pelvis_tx", 1, 0, 1.5},
                  {"pelvis_ty", 2, 0, -2.0},
                  {"hip_flexion_l", 0, 1, 0.7853981633974483},
                  {"knee_angle_l", 1, 1, -3.141592653589793},
                  {"knee_angle_l", 2, 1, 1.5707963267948966}};
  assert_int_equal(d->end_value_count, 7);
  for (int i = 0; i < 7; i++) {
    const ambulo_end_value *end = &d->end_values[i];
    assert_int_equal(end->coordinate,
                     ambulo_model_find_coordinate(p->model, expected[i].coordinate));
    assert_int_equal(end->order, expected[i].order);
    assert_int_equal(end->final, expected[i].final);
    assert_close(end->value, expected[i].value, 1e-15);
  }
  ambulo_problem_free(p);
}

/* `default` is for whom no name was given */
static void a_body_at_rest_is_said_in_one_word(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(WALKER TIME "angles: degrees\n"
                                             "ends: {final_speed: {default: 0, pelvis_tx: 1.5},\n"
                                             "  final_acceleration: {default: 0}}\n");
  const ambulo_problem_definition *d = &p->definition;
  int coordinates = ambulo_model_coordinate_count(p->model);
  assert_int_equal(d->end_value_count, 2 * coordinates);
  for (int i = 0; i < d->end_value_count; i++) {
    const ambulo_end_value *end = &d->end_values[i];
    int first = end->coordinate == ambulo_model_find_coordinate(p->model, "pelvis_tx");
    assert_int_equal(end->order, i < coordinates ? 1 : 2);
    assert_int_equal(end->final, 1);
    assert_close(end->value, first && end->order == 1 ? 1.5 : 0.0, 0.0);
  }
  ambulo_problem_free(p);
}

static void units_of_angles_are_asked_for(void **state) {
  (void)state;
  ambulo_problem_free(problem_of(WALKER TIME "ends: {initial: {pelvis_tx: 0}}\n"));
  expect_refusal(
      WALKER TIME "ends: {initial: {knee_angle_r: 90}}\n", AMBULO_E_SCHEMA,
      "p.yaml:6:32: error[E_SCHEMA]: 'knee_angle_r' is an angle, but the file does not state");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *p = NULL;
  assert_int_equal(
      load_text(WALKER TIME "angles: radians\nends: {initial: {knee_angle_r: 90}}\n", list, &p),
      AMBULO_OK);
  assert_message(list, 0, "90 for 'knee_angle_r' is more than a whole turn in radians");
  ambulo_problem_free(p);
  ambulo_diagnostics_free(list);
}

static void faults_are_placed(void **state) {
  (void)state;
  expect_refusal(WALKER TIME "constraints: {zmp: bx}\n", AMBULO_E_SCHEMA, "p.yaml:6:20: error");
  expect_refusal(WALKER TIME "constraints: {foot_strike: yes}\n", AMBULO_E_SCHEMA, "p.yaml:6:28:");
  expect_refusal(WALKER TIME "constraints: {zmp_margin: -0.1}\n", AMBULO_E_SCHEMA, "p.yaml:6:27:");
  expect_refusal(WALKER TIME "constraints: {minimum_force: of}\n", AMBULO_E_SCHEMA, "p.yaml:6:30:");
  expect_refusal(WALKER TIME "constraints: {minimum_force: -1}\n", AMBULO_E_SCHEMA, "p.yaml:6:30:");
  expect_refusal(WALKER TIME "constraints: {joint_limit: nodes}\n", AMBULO_E_SCHEMA,
                 "unknown key 'joint_limit'");
  expect_refusal(WALKER TIME "ends: {kind: cyclic}\n", AMBULO_E_SCHEMA, "p.yaml:6:14: error");
  expect_refusal(WALKER TIME "ends: {order: 3}\n", AMBULO_E_SCHEMA, "p.yaml:6:15: error");
  expect_refusal(WALKER TIME "angles: degrees\nends: {final: {knee_angel_r: 3}}\n", AMBULO_E_SCHEMA,
                 "p.yaml:7:16: error[E_SCHEMA]: unknown key 'knee_angel_r'");
  expect_refusal(WALKER TIME "ends: {final: 3}\n", AMBULO_E_SCHEMA, "'final' is not a mapping");
}

#define STEPS(rest) WALKER "objective: none\ntime: {intervals: 4}\n" rest
#define GAIT "gait: {first_foot: left, step_time: 0.5, "

/* feet alternate: an odd number of steps ends in the mirror image, an even one where it began */
static void ends_go_with_the_number_of_steps(void **state) {
  (void)state;
  ambulo_problem_free(
      problem_of(STEPS(GAIT "steps: 3, step_length: 0.6}\nends: {kind: mirrored}\n")));
  ambulo_problem_free(
      problem_of(STEPS(GAIT "steps: 4, step_length: [0.6, 0.7]}\nends: {kind: periodic}\n")));
  ambulo_problem_free(problem_of(STEPS(GAIT "steps: 2, step_length: 0.6}\nends: {kind: free}\n")));
  expect_refusal(
      STEPS(GAIT "steps: 2, step_length: 0.6}\nends: {kind: mirrored}\n"), AMBULO_E_PROBLEM,
      "p.yaml:7:14: error[E_PROBLEM]: mirrored ends with 2 steps; expected an odd number, "
      "after which the other foot strikes\n  hint: ends: {kind: periodic}, or an odd");
  expect_refusal(
      STEPS(GAIT "steps: 1, step_length: 0.6}\nends: {kind: periodic}\n"), AMBULO_E_PROBLEM,
      "p.yaml:7:14: error[E_PROBLEM]: periodic ends with 1 step; expected an even number, "
      "after which the same foot strikes again");
}

/* the gait would be told of one kind of step only */
static void mirrored_steps_are_equal(void **state) {
  (void)state;
  ambulo_problem_free(
      problem_of(STEPS(GAIT "steps: 1, step_length: [0.6, 0.6]}\nends: {kind: mirrored}\n")));
  expect_refusal(STEPS(GAIT "steps: 1, step_length: [0.6, 0.7]}\nends: {kind: mirrored}\n"),
                 AMBULO_E_PROBLEM, "the gait has steps of two lengths or times");
  expect_refusal(STEPS("gait: {first_foot: left, steps: 1, step_length: 0.6, "
                       "step_time: [0.5, 0.6]}\nends: {kind: mirrored}\n"),
                 AMBULO_E_PROBLEM,
                 "p.yaml:7:14: error[E_PROBLEM]: mirrored ends make each step the mirror image");
}

/* what only ends that match look at */
static void free_ends_take_no_rise_and_no_order(void **state) {
  (void)state;
  expect_refusal(WALKER TIME "ends: {kind: free, rise: 0.17}\n", AMBULO_E_PROBLEM,
                 "p.yaml:6:26: error[E_PROBLEM]: a rise of 0.17 m with free ends, which do nothing "
                 "with it; expected 'kind: periodic' or 'kind: mirrored' beside it");
  ambulo_problem *p = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(load_text(WALKER TIME "ends: {order: 2, rise: 0}\n", list, &p), AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  assert_int_equal(ambulo_diagnostics_error_count(list), 0);
  assert_string_equal(ambulo_diagnostics_get(list, 0)->message,
                      "'order' has no effect with free ends; it belongs to kind periodic or "
                      "mirrored");
  ambulo_problem_free(p);
  ambulo__diagnostics_clear(list);
  assert_int_equal(load_text(WALKER TIME "ends: {kind: cyclic, rise: 0.17, order: 2}\n", list, &p),
                   AMBULO_E_SCHEMA);
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  ambulo_diagnostics_free(list);
}

/* what the problem itself objects to points to the key that it is about */
static void differences_are_placed(void **state) {
  (void)state;
  expect_refusal(STEPS("gait: {first_foot: left, steps: 1, step_length: 0.6, step_time: 0.5}\n"
                       "constraints: {foot_strike: true}\n"
                       "ends: {kind: mirrored, travel: 0.5}\n"),
                 AMBULO_E_PROBLEM,
                 "p.yaml:8:32: error[E_PROBLEM]: ends.travel: foot 'left' stands");
  expect_refusal(
      WALKER "time: {duration: 0.5, intervals: 4}\n"
             "load: {link: shank_l, mass: 3, position: [0, 0, 0]}\n"
             "ends: {kind: mirrored}\n"
             "objective: [{term: torque_squared}]\n",
      AMBULO_E_PROBLEM,
      "p.yaml:6:14: error[E_PROBLEM]: ends.kind: mirrored ends, but the mass of 'shank_r' "
      "is 3.2475 kg, that of its mirror partner 'shank_l' 6.2475 kg");
  expect_refusal(WALKER "time: {duration: 0.5, intervals: 4}\n"
                        "ends: {kind: mirrored}\n"
                        "objective:\n"
                        "  - {term: torque_squared}\n"
                        "  - {term: acceleration, scale: {knee_angle_l: 2}}\n",
                 AMBULO_E_PROBLEM,
                 "p.yaml:8:5: error[E_PROBLEM]: objective[1] (acceleration): the scale of "
                 "'knee_angle_r' is 1, that of its mirror partner 'knee_angle_l' 2");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_key_arrives),
                                     cmocka_unit_test(absent_means_off),
                                     cmocka_unit_test(end_values_are_in_radians),
                                     cmocka_unit_test(a_body_at_rest_is_said_in_one_word),
                                     cmocka_unit_test(units_of_angles_are_asked_for),
                                     cmocka_unit_test(faults_are_placed),
                                     cmocka_unit_test(ends_go_with_the_number_of_steps),
                                     cmocka_unit_test(mirrored_steps_are_equal),
                                     cmocka_unit_test(free_ends_take_no_rise_and_no_order),
                                     cmocka_unit_test(differences_are_placed)};
  return cmocka_run_group_tests_name("definitions/problem_constraints", tests, NULL, NULL);
}
