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

/* `constraints.collision`, `constraints.reach` and `obstacles` of a problem file: what is read, and
 * what is refused, with the key it is about. */

#define BODY                                                                                       \
  "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\nangles: degrees\nobjective: none\n"        \
  "time: {duration: 1, intervals: 8}\n"

static void what_is_read(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      BODY
      "obstacles:\n"
      "  - {name: step, center: [1, 2, 0.1], half_size: [0.1, 0.2, 0.1], heading: 90}\n"
      "  - {name: bar, from: [0, -1, 1], to: [0, 1, 1], radius: 0.02, margin: 0.05, capsules: "
      "[head]}\n"
      "constraints:\n"
      "  collision: {pairs: [[foot_l, foot_r]], margin: 0.02}\n"
      "  reach: [{point: head_top, place: [0.1, 0.2, 1.6], at: [0.25, 0.5], tolerance: 0.01}]\n");
  const ambulo_problem_definition *d = &p->definition;
  assert_int_equal(d->obstacle_count, 2);
  const ambulo_obstacle *box = ambulo_problem_obstacle(p, 0), *bar = ambulo_problem_obstacle(p, 1);
  assert_string_equal(box->name, "step");
  assert_int_equal(box->shape, AMBULO_OBSTACLE_BOX);
  assert_close(box->center[1], 2.0, 0.0);
  assert_close(box->half[1], 0.2, 0.0);
  assert_close(box->heading, 1.5707963267948966, 1e-15);
  assert_close(box->margin, 0.01, 0.0);
  assert_null(box->capsules);
  assert_int_equal(bar->shape, AMBULO_OBSTACLE_CAPSULE);
  assert_close(bar->from[1], -1.0, 0.0);
  assert_close(bar->to[1], 1.0, 0.0);
  assert_close(bar->radius, 0.02, 0.0);
  assert_close(bar->margin, 0.05, 0.0);
  assert_int_equal(bar->capsule_count, 1);
  assert_int_equal(bar->capsules[0], find_capsule(p->model, "head"));
  assert_null(ambulo_problem_obstacle(p, 2));
  assert_close(d->collision.margin, 0.02, 0.0);
  assert_int_equal(ambulo_problem_pairs(p, 0, NULL), 1);
  assert_int_equal(d->reach_count, 1);
  assert_close(d->reaches[0].from, 0.25, 0.0);
  assert_close(d->reaches[0].to, 0.5, 0.0);
  assert_close(d->reaches[0].place[2], 1.6, 0.0);
  ambulo_problem_free(p);
}

static void pairs_left_out_are_told(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(BODY "constraints: {collision: {}, joint_limits: nodes}\n");
  ambulo_capsule_pair pair = {0, 0};
  assert_true(ambulo_problem_pairs(p, 0, NULL) >= 8);
  assert_close(p->definition.collision.margin, 0.01, 0.0);
  assert_true(ambulo_problem_pairs_too_far(p) > 0);
  int left = ambulo_problem_pairs_left_out(p, 0, NULL);
  for (int i = 0; i < left; i++) {
    assert_int_equal(ambulo_problem_pairs_left_out(p, i, &pair), left);
    assert_true(pair.one != pair.other);
  }
  ambulo_problem_free(p);
  p = problem_of(BODY "constraints: {collision: {pairs: off}}\n");
  assert_int_equal(ambulo_problem_pairs(p, 0, NULL) + ambulo_problem_pairs_left_out(p, 0, NULL), 0);
  ambulo_problem_free(p);
}

/* lengths of another body grow with it; obstacles and places are the task's, and stay */
static void margins_go_with_the_body(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      BODY "subject: {stature: 0.875, mass: 75}\nwritten_for: {stature: 1.75, mass: 75}\n"
           "obstacles: [{name: a, center: [1, 0, 0], half_size: [1, 1, 1], margin: 0.02}]\n"
           "constraints: {collision: {margin: 0.02}}\n");
  assert_close(p->definition.collision.margin, 0.01, 1e-15);
  assert_close(p->definition.obstacles[0].margin, 0.02, 0.0);
  ambulo_problem_free(p);
}

static void a_pair_that_overlaps_is_warned_of(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *p = NULL;
  assert_int_equal(
      load_text(BODY "constraints: {collision: {pairs: [[pelvis, thigh_r]]}}\n", list, &p),
      AMBULO_OK);
  assert_message(list, 0, "p.yaml:7:35: warning: 'pelvis' and 'thigh_r' overlap by");
  assert_message(list, 0, "'pairs: automatic' leaves such pairs out");
  ambulo_problem_free(p);
  ambulo_diagnostics_free(list);
}

static const struct {
  const char *text, *message;
  ambulo_status status;
} refused[] = {
    {"constraints: {collision: {pairs: [[shank_l, shank_rr]]}}\n",
     "p.yaml:7:45: error[E_PROBLEM]: unknown capsule (got 'shank_rr'); expected a capsule of the "
     "model\n  hint: did you mean 'shank_r'?",
     AMBULO_E_PROBLEM},
    {"constraints: {collision: {pairs: [[shank_l]]}}\n",
     "expected the names of two capsules, such as [shank_l, shank_r]", AMBULO_E_SCHEMA},
    {"constraints: {collision: {pairs: [[shank_l, shank_l]]}}\n",
     "a capsule and itself (got 'shank_l' twice)", AMBULO_E_PROBLEM},
    {"constraints: {collision: {pairs: [[trunk, head]]}}\n",
     "'trunk' and 'head' are parts of one rigid body", AMBULO_E_PROBLEM},
    {"constraints: {collision: {pairs: all}}\n", "automatic", AMBULO_E_SCHEMA},
    {"constraints: {collision: {pairs: []}}\n", "an empty list; expected pairs of capsules",
     AMBULO_E_SCHEMA},
    {"constraints: {collision: {pairs: {a: b}}}\n", "expected a list of pairs of capsules",
     AMBULO_E_SCHEMA},
    {"constraints: {collision: {margin: -0.1}}\n", "-0.1", AMBULO_E_SCHEMA},
    {"constraints: {collision: {margn: 0.1}}\n", "did you mean 'margin'?", AMBULO_E_SCHEMA},
    {"constraints: {collision: [shank_l]}\n", "expected a mapping", AMBULO_E_SCHEMA},
    {"obstacles: {name: a}\n", "expected a list of {name, center, half_size, heading, from, to, ",
     AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0]}]\n", "half_size", AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, radius: 1}]\n", "from", AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 0, 1]}]\n",
     ": 0; expected 1e-06 to 1000", AMBULO_E_SCHEMA},
    {"obstacles: [{center: [0, 0, 0], half_size: [1, 1, 1]}]\n", "missing required key 'name'",
     AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1]}, {name: a, center: [0, 0, "
     "0], half_size: [1, 1, 1]}]\n",
     "obstacles[0] and obstacles[1] are both named 'a'", AMBULO_E_PROBLEM},
    {"obstacles: [{name: a, center: [0, 0, 5000], half_size: [1, 1, 1]}]\n",
     ": 5000; expected -1000 to 1000", AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1], capsules: [haed]}]\n",
     "did you mean 'head'?", AMBULO_E_PROBLEM},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1], capsules: []}]\n",
     "an empty list; expected names of capsules, or 'all'", AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1], heigth: 1}]\n",
     "unknown key 'heigth'", AMBULO_E_SCHEMA},
    {"obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1]}]\nends: {kind: mirrored}\n",
     "obstacle 'a' stands once and the step for both", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: head_top, place: [0, 0, 1], at: 0.5}]}\nends: {kind: "
     "mirrored}\n",
     "constraints.reach[0] asks for a place once", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: knee_r, relative_to: knee_l, place: [0.1, -0.2, 0]}]}\nends: "
     "{kind: "
     "mirrored}\n",
     "the mirror image of constraints.reach[0] is another one", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: knee_r, relative_to: knee_l, place: [0, -0.2, 0], at: [0, "
     "0.5]}]}\n"
     "ends: {kind: mirrored}\n",
     "straight to the side, from 0 to 1 s", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: knee_r, relative_to: ankle_l, place: [0, -0.2, 0]}]}\nends: "
     "{kind: "
     "mirrored}\n",
     "expected the way from a point to its mirror image", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: knee_r, relative_to: knee_r, place: [0, 0, 0]}]}\n",
     "constraints.reach[0] is relative to point", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: knee_r, relative_to: nee_l, place: [0, 0, 0]}]}\n",
     "hint: did you mean 'knee_l'?", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: head_tip, place: [0, 0, 1], at: 0.5}]}\n",
     "unknown point (got 'head_tip'); expected a point of the model\n  hint: did you mean "
     "'head_top'?",
     AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: head_top, place: [0, 0, 1]}]}\n", "missing required key 'at'",
     AMBULO_E_SCHEMA},
    {"constraints: {reach: [{point: head_top, place: [0, 1], at: 0.5}]}\n", "p.yaml:7:48",
     AMBULO_E_SCHEMA},
    {"constraints: {reach: [{point: head_top, place: [0, 0, 1], at: 0.3}]}\n",
     "constraints.reach[0]: no node from 0.3 s to 0.3 s, the nearest is at 0.25 s; expected the "
     "time of a node, or grid: events",
     AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: head_top, place: [0, 0, 1], at: [0.5, 0.25]}]}\n",
     "constraints.reach[0] is from 0.5 s to 0.25 s; expected times in 0 to 1 s", AMBULO_E_PROBLEM},
    {"constraints: {reach: [{point: head_top, place: [0, 0, 1], at: 2}]}\n",
     "constraints.reach[0] is from 2 s to 2 s", AMBULO_E_PROBLEM},
    {"constraints: {reach: {point: head_top}}\n",
     "expected a list of {point, relative_to, place, at, tolerance}", AMBULO_E_SCHEMA},
};

static void refusals(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
    char text[1024];
    (void)snprintf(text, sizeof text, BODY "%s", refused[i].text);
    expect_refusal(text, refused[i].status, refused[i].message);
  }
  expect_refusal(WALKER "time: {duration: 1, intervals: 4}\nobjective: none\n"
                        "constraints: {collision: {}}\n",
                 AMBULO_E_PROBLEM,
                 "constraints.collision: the model 'walker_2d' has no capsules; expected some");
  expect_refusal(WALKER "time: {duration: 1, intervals: 4}\nobjective: none\n"
                        "obstacles: [{name: a, center: [0, 0, 0], half_size: [1, 1, 1]}]\n",
                 AMBULO_E_PROBLEM, "has no capsules that could keep clear of it");
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
                                     cmocka_unit_test(differences_are_placed),
                                     cmocka_unit_test(what_is_read),
                                     cmocka_unit_test(pairs_left_out_are_told),
                                     cmocka_unit_test(margins_go_with_the_body),
                                     cmocka_unit_test(a_pair_that_overlaps_is_warned_of),
                                     cmocka_unit_test(refusals)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
