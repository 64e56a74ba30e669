/* `gait:` and `contacts:`. */
#include "support/contact_index.h"
#include "model/model.h"
#include "ambulo/tools/load.h"
#include "definitions/problem_text.h"

#define HEAD WALKER "objective: none\n"
#define GAIT "gait: {steps: 2, first_foot: left, step_length: 0.6, "

static void contacts_are_read(void **state) {
  (void)state;
  ambulo_problem *p =
      problem_of(HEAD "time: {duration: 1, intervals: 4}\n"
                      "contacts:\n"
                      "  - {foot: right, mode: heel, from: 0, to: 0.2, place: [0.1, -0.2]}\n"
                      "  - {foot: left, mode: toe, from: 0.1, to: 1, place: [0.3, 0.4]}\n");
  assert_int_equal(ambulo_problem_contact_count(p), 2);
  const ambulo_contact *c = ambulo_problem_contact(p, 0);
  assert_string_equal(ambulo_model_foot(ambulo_problem_model(p), c->foot)->name, "right");
  assert_int_equal(c->mode, AMBULO_CONTACT_HEEL);
  c = ambulo_problem_contact(p, 1);
  assert_int_equal(c->mode, AMBULO_CONTACT_TOE);
  assert_close(c->from, 0.1, 0.0);
  assert_close(c->to, 1.0, 0.0);
  assert_close(c->place[0], 0.3, 0.0);
  assert_close(c->place[1], 0.4, 0.0);
  ambulo_problem_free(p);
}

/* step time, speed and duration in every combination that says it once */
static void step_times_are_completed(void **state) {
  (void)state;
  static const char *const texts[] = {HEAD "time: {intervals: 4}\n" GAIT "step_time: 0.5}\n",
                                      HEAD "time: {intervals: 4}\n" GAIT "speed: 1.2}\n",
                                      HEAD "time: {duration: 1, intervals: 4}\n" GAIT "start: 0}\n",
                                      HEAD "time: {duration: 1, intervals: 4}\n" GAIT
                                           "speed: 1.2, step_time: 0.5}\n"};
  for (int i = 0; i < 4; i++) {
    ambulo_problem *p = problem_of(texts[i]);
    assert_close(ambulo_problem_duration(p), 1.0, 1e-14);
    assert_close(p->definition.travel, 1.2, 1e-14);
    /* stride 1 s; default phases 0, 0.08, 0.38, 0.62: left flat from 0.08 s to 0.38 s */
    int contact = contact_index_at(p, ambulo_model_find_foot(p->model, "left"), 0.2);
    const ambulo_contact *c = ambulo_problem_contact(p, contact);
    assert_int_equal(c->mode, AMBULO_CONTACT_FLAT);
    assert_close(c->from, 0.08, 1e-14);
    assert_close(c->to, 0.38, 1e-14);
    ambulo_problem_free(p);
  }
}

static void phases_and_places_are_read(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      HEAD "time: {intervals: 4}\n" GAIT "step_time: 0.5, step_width: 0.2, start: 0.05, "
           "phases: {heel_strike: -0.05, foot_flat: 0.05, heel_off: 0.4, toe_off: 0.6}}\n");
  const ambulo_contact *c = ambulo_problem_contact(
      p, contact_index_at(p, ambulo_model_find_foot(p->model, "right"), 0.6));
  assert_close(c->from, 0.55, 1e-14);
  assert_close(c->to, 0.9, 1e-14);
  assert_close(c->place[0], 0.65, 1e-14);
  assert_close(fabs(c->place[1]), 0.1, 1e-14);
  ambulo_problem_free(p);
}

/* a speed and a time make the length: at 1.2 m/s 0.5 s make 0.6 m, also of unlike steps */
static void a_speed_and_a_time_make_the_length(void **state) {
  (void)state;
  static const char *const texts[] = {
      HEAD "time: {intervals: 4}\ngait: {steps: 2, first_foot: left, speed: 1.2, step_time: 0.5}\n",
      HEAD "time: {intervals: 4, duration: 1}\ngait: {steps: 2, first_foot: left, speed: 1.2}\n",
      HEAD "time: {intervals: 4}\ngait: {steps: 2, first_foot: left, speed: 1.2, step_time: [0.4, "
           "0.6]}\n"};
  for (int i = 0; i < 3; i++) {
    ambulo_problem *p = problem_of(texts[i]);
    assert_close(ambulo_problem_duration(p), 1.0, 1e-14);
    assert_close(p->definition.travel, 1.2, 1e-14);
    assert_close(p->keys.walk.step_length, 0.6, 1e-14);
    ambulo_problem_free(p);
  }
}

/* L = sqrt(60 v W) with W = 0.0035 * 1.75 m; lists are two unlike steps */
static void a_speed_alone_and_unlike_steps(void **state) {
  (void)state;
  ambulo_problem *p = problem_of("ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\n"
                                 "objective: none\ntime: {intervals: 4}\n"
                                 "gait: {steps: 2, first_foot: left, speed: 1.4}\n");
  double length = sqrt(60.0 * 1.4 * 0.0035 * 1.75);
  assert_close(p->definition.travel, 2.0 * length, 1e-12);
  assert_close(ambulo_problem_duration(p), 2.0 * length / 1.4, 1e-12);
  ambulo_problem_free(p);
  p = problem_of(HEAD "time: {intervals: 4}\ngait: {steps: 2, first_foot: left, step_length: "
                      "[0.6, 0.7], step_time: [0.5, 0.6]}\n");
  assert_close(p->definition.travel, 1.3, 1e-12);
  assert_close(ambulo_problem_duration(p), 1.1, 1e-12);
  ambulo_problem_free(p);
  expect_refusal(HEAD "time: {intervals: 4}\ngait: {steps: 2, first_foot: left, step_length: "
                      "[0.6, 0.7], step_time: [0.5, 0]}\n",
                 AMBULO_E_SCHEMA, "step times 0.5 s and 0 s; expected 0.001 to 1000 s");
}

/* feet that stand apart at q = 0 walk that far apart by default: hips 2 * 0.048571 * 1.75 m */
static void the_width_defaults_to_the_hips(void **state) {
  (void)state;
  ambulo_problem *p = problem_of("ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\n"
                                 "objective: none\ntime: {intervals: 4}\n" GAIT "step_time: 1}\n");
  assert_close(fabs(ambulo_problem_contact(p, 0)->place[1]), 0.048571 * 1.75, 1e-12);
  ambulo_problem_free(p);
}

/* one error and no other: nothing is concluded from a value that was refused */
static void expect_only(const char *text, const char *message) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *problem = NULL;
  assert_int_not_equal(
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = text,
                                                      .length = strlen(text),
                                                      .name = "p.yaml",
                                                      .directory = "models"},
                               NULL, list, &problem),
      AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_error_count(list), 1);
  assert_non_null(strstr(ambulo_diagnostics_get(list, 0)->message, message));
  ambulo_diagnostics_free(list);
}

static void faults_are_placed(void **state) {
  (void)state;
  expect_refusal(HEAD "time: {intervals: 4}\n" GAIT "start: 0}\n", AMBULO_E_SCHEMA,
                 "no step time; expected one of gait.step_time, gait.speed, time.duration");
  expect_refusal(HEAD "time: {duration: 1, intervals: 4}\n" GAIT "step_time: 0.6}\n",
                 AMBULO_E_PROBLEM,
                 "p.yaml:6:65: error[E_PROBLEM]: 'step_time' makes a step last 0.6 s; "
                 "expected 0.5 s");
  expect_only(HEAD "time: {duration: 1, intervals: 4}\n" GAIT "speed: -1.3}\n",
              "expected a number from 0.001 to 100");
  expect_only(HEAD "time: {duration: 1, intervals: 4}\n" GAIT "step_time: -1}\n",
              "expected a number from 0.001 to 1000");
  expect_only(HEAD "time: {duration: 1, intervals: 4}\ngait: {steps: 2, first_foot: left, "
                   "speed: -1}\n",
              "expected a number from 0.001 to 100");
  expect_only(HEAD "time: {intervals: 4}\n" GAIT "speed: 1.3, step_time: [0.5, 0.6]}\n",
              "'speed' makes a step last 0.461538462 s; expected 0.55 s");
  expect_only(HEAD "time: {intervals: 4}\n" GAIT "step_time: [0.5, long]}\n",
              "got 'long'; expected a number");
  expect_refusal(HEAD "time: {intervals: 4}\n" GAIT "step_time: 0.5, phases: {heel_off: 0.7}}\n",
                 AMBULO_E_PROBLEM, "phases 0, 0.08, 0.7, 0.62 of a stride");
  expect_refusal(HEAD "time: {intervals: 4}\n"
                      "gait: {steps: 2, first_foot: lft, step_length: 0.6, step_time: 1}\n",
                 AMBULO_E_SCHEMA, "p.yaml:6:30: error[E_SCHEMA]");
  expect_refusal(HEAD "time: {intervals: 4}\ngait: {first_foot: left, step_time: 1}\n",
                 AMBULO_E_SCHEMA, "'steps'");
  expect_refusal(HEAD "time: {duration: 1, intervals: 4}\ncontacts: []\n" GAIT "step_time: 0.5}\n",
                 AMBULO_E_SCHEMA, "both 'gait' and 'contacts' are given");
  expect_refusal(HEAD "time: {duration: 1, intervals: 4}\ncontacts: {foot: left}\n",
                 AMBULO_E_SCHEMA, "'contacts' is not a list");
  expect_refusal(HEAD "time: {duration: 1, intervals: 4}\ncontacts: [left]\n", AMBULO_E_SCHEMA,
                 "p.yaml:6:12: error[E_SCHEMA]: got 'left'; expected a mapping");
  expect_refusal(HEAD "time: {duration: 1, intervals: 4}\n"
                      "contacts: [{foot: left, mode: flat, from: 0, to: 1, place: [1]}]\n",
                 AMBULO_E_SCHEMA, "p.yaml:6:");
  expect_refusal(PENDULUM "objective: none\ntime: {intervals: 4}\n" GAIT "step_time: 0.5}\n",
                 AMBULO_E_PROBLEM, "the model has no feet");
}

/* what is wrong with an expanded schedule is reported at the gait */
static void expanded_contradictions_point_at_the_gait(void **state) {
  (void)state;
  expect_refusal(HEAD "constraints: {foot_strike: true}\ntime: {intervals: 4}\n"
                      "gait: {steps: 2, first_foot: left, step_length: 3, step_time: 1}\n",
                 AMBULO_E_PROBLEM, "p.yaml:7:");
}

static void contacts_of_patches_are_read(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      "ambulo: 1\nkind: problem\nmodel: lower_body_18_rigid.yaml\nobjective: none\n"
      "angles: degrees\ntime: {duration: 1, intervals: 4}\n"
      "contacts:\n"
      "  - {foot: left, mode: flat, from: 0, to: 1, place: [0, 0.1]}\n"
      "  - {patch: seat, from: 0.2, to: 0.7, place: [-0.2, 0.01, 0.45], normal: [-1, 0, 0],\n"
      "     heading: 90}\n");
  const ambulo_contact *c = ambulo_problem_contact(p, 1);
  assert_int_equal(ambulo_problem_contact(p, 0)->foot, ambulo_model_find_foot(p->model, "left"));
  assert_int_equal(c->foot, -1);
  assert_int_equal(c->mode, AMBULO_CONTACT_PATCH);
  assert_int_equal(c->patch, ambulo__find_patch(p->model, "seat"));
  assert_close(c->from, 0.2, 0.0);
  assert_close(c->to, 0.7, 0.0);
  assert_close(c->place[2], 0.45, 0.0);
  assert_close(c->normal[0], -1.0, 0.0);
  assert_close(c->heading, 1.5707963267948966, 1e-15);
  ambulo_problem_free(p);
}

/* `gait.phases`: shares of the stride, or functions of the speed. */

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
      cmocka_unit_test(contacts_are_read),
      cmocka_unit_test(step_times_are_completed),
      cmocka_unit_test(phases_and_places_are_read),
      cmocka_unit_test(the_width_defaults_to_the_hips),
      cmocka_unit_test(a_speed_alone_and_unlike_steps),
      cmocka_unit_test(a_speed_and_a_time_make_the_length),
      cmocka_unit_test(faults_are_placed),
      cmocka_unit_test(expanded_contradictions_point_at_the_gait),
      cmocka_unit_test(contacts_of_patches_are_read),
      cmocka_unit_test(textbook_timing_is_the_default_at_every_speed),
      cmocka_unit_test(people_stand_for_less_of_a_fast_stride),
      cmocka_unit_test(step_lengths_go_with_the_speed),
      cmocka_unit_test(functions_are_read),
      cmocka_unit_test(phases_follow_the_number_and_not_the_speed),
      cmocka_unit_test(lengths_and_times_make_the_speed),
      cmocka_unit_test(two_unlike_steps_have_one_speed),
      cmocka_unit_test(the_number_is_by_gravity),
      cmocka_unit_test(a_speed_that_is_none_is_the_only_fault),
      cmocka_unit_test(faults_are_named)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
