/* `gait:` and `contacts:`. */
#include "definitions/problem_text.h"
#include "ambulo/tools/load.h"

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
    int contact = ambulo_problem_contact_at(p, ambulo_model_find_foot(p->model, "left"), 0.2);
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
      p, ambulo_problem_contact_at(p, ambulo_model_find_foot(p->model, "right"), 0.6));
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
                 "p.yaml:6:12: error[E_SCHEMA]: a contact is not a mapping");
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
  assert_int_equal(c->patch, ambulo_model_find_patch(p->model, "seat"));
  assert_close(c->from, 0.2, 0.0);
  assert_close(c->to, 0.7, 0.0);
  assert_close(c->place[2], 0.45, 0.0);
  assert_close(c->normal[0], -1.0, 0.0);
  assert_close(c->heading, 1.5707963267948966, 1e-15);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(contacts_are_read),
                                     cmocka_unit_test(step_times_are_completed),
                                     cmocka_unit_test(phases_and_places_are_read),
                                     cmocka_unit_test(the_width_defaults_to_the_hips),
                                     cmocka_unit_test(a_speed_alone_and_unlike_steps),
                                     cmocka_unit_test(a_speed_and_a_time_make_the_length),
                                     cmocka_unit_test(faults_are_placed),
                                     cmocka_unit_test(expanded_contradictions_point_at_the_gait),
                                     cmocka_unit_test(contacts_of_patches_are_read)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
