/* `free:` of a problem file: what it says, and what it may not say, with its place. */
#include "definitions/problem_free.h"
#include "ambulo/tools/load.h"
#include "definitions/problem_text.h"
#include "support/fail_alloc.h"
#include "support/test.h"

#include <string.h>

#define WALK                                                                                       \
  WALKER "angles: degrees\nobjective: [{term: torque_squared}]\nends: {kind: mirrored}\n"          \
         "time: {intervals: 6}\nground: {slope: 3}\n"                                              \
         "gait: {steps: 1, first_foot: left, speed: 1.2, step_time: 0.5}\n"
#define REST PENDULUM "time: {duration: 1, intervals: 6}\nobjective: [{term: torque_squared}]\n"

static void bounds_are_read_in_units_of_the_file(void **state) {
  (void)state;
  ambulo_problem *p =
      problem_of(WALK "free: {gait.step_time: [0.4, 0.8], ground.slope: [-5, 5], per: none, "
                      "maximum_solves: 7}\n");
  ambulo_parameters free = ambulo_problem_parameters(p);
  assert_int_equal(free.count, 2);
  assert_string_equal(free.items[0].name, "gait.step_time");
  assert_close(free.items[0].lower, 0.4, 0.0);
  assert_close(free.items[0].upper, 0.8, 0.0);
  assert_string_equal(free.items[1].name, "ground.slope");
  assert_close(free.items[1].upper, 5.0 * 3.14159265358979324 / 180.0, 1e-15);
  assert_int_equal(free.per, AMBULO_PER_NONE);
  assert_int_equal(free.maximum_solves, 7);
  assert_null(free.problem_at);
  ambulo_problem_free(p);
  p = problem_of(WALK "free: {gait.speed: [1, 2]}\n");
  free = ambulo_problem_parameters(p);
  assert_int_equal(free.per, AMBULO_PER_DEFAULT);
  assert_int_equal(free.maximum_solves, ambulo_parameters_default().maximum_solves);
  ambulo_problem_free(p);
  p = problem_of(WALK);
  assert_int_equal(ambulo_problem_parameters(p).count, 0);
  ambulo_problem_free(p);
}

/* lengths of a file that is written for another body are in its metres */
static void bounds_are_those_of_the_body_that_is_written_for(void **state) {
  (void)state;
#define LARGE                                                                                      \
  "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\ntime: {intervals: 20}\n"                   \
  "subject: {mass: 75, stature: 2.1}\nwritten_for: {mass: 75, stature: 1.75}\n"                    \
  "objective: [{term: torque_squared}]\nends: {kind: mirrored}\n"                                  \
  "gait: {steps: 1, first_foot: left, speed: 1.4, step_width: 0.1}\n"
  ambulo_problem *p = problem_of(LARGE "free: {gait.step_width: [0.05, 0.2]}\n"), *at = NULL;
  ambulo_parameters free = ambulo_problem_parameters(p);
  assert_close(free.items[0].lower, 0.06, 1e-15);
  assert_close(free.items[0].upper, 0.24, 1e-15);
  const double wide = 0.18;
  assert_int_equal(ambulo_problem_at(p, &wide, NULL, NULL, &at), AMBULO_OK);
  assert_close(at->keys.walk.step_width, 0.18, 1e-15);
  ambulo_problem_free(at);
  ambulo_problem_free(p);
  expect_refusal(LARGE "free: {\"objective[torque_squared].weight\": [0.5, 2]}\n", AMBULO_E_SCHEMA,
                 "cannot be free in a file that is written for another body");
}

/* what is free, and between which bounds, is another problem to a batch */
static void the_hash_sees_what_is_free(void **state) {
  (void)state;
  static const char *const texts[] = {WALK, WALK "free: {gait.step_time: [0.4, 0.8]}\n",
                                      WALK "free: {gait.step_time: [0.4, 0.9]}\n",
                                      WALK "free: {gait.step_time: [0.4, 0.8], per: none}\n",
                                      WALK "free: {gait.speed: [0.4, 2]}\n"};
  unsigned long long hash[5];
  for (int i = 0; i < 5; i++) {
    ambulo_problem *p = problem_of(texts[i]);
    hash[i] = ambulo_problem_hash(p);
    for (int k = 0; k < i; k++) assert_true(hash[k] != hash[i]);
    ambulo_problem_free(p);
  }
}

/* the problem as it was read, of which text and overrides may be gone, and the values */
static void the_problem_elsewhere(void **state) {
  (void)state;
  char text[] = WALK "free: {gait.step_time: [0.4, 0.8], ground.slope: [-5, 5]}\n";
  char override[] = "subject.mass=60";
  const char *const overrides[] = {override};
  const double values[2] = {0.7, -0.05};
  ambulo_problem *p = NULL, *at = NULL;
  assert_int_equal(
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = text,
                                                      .length = strlen(text),
                                                      .name = "p.yaml",
                                                      .directory = "models",
                                                      .overrides = overrides,
                                                      .override_count = 1},
                               NULL, NULL, &p),
      AMBULO_OK);
  memset(text, '#', strlen(text));
  memset(override, '#', strlen(override));
  assert_int_equal(ambulo_problem_at(p, values, NULL, NULL, &at), AMBULO_OK);
  assert_close(ambulo_problem_duration(at), 0.7, 1e-15);
  assert_close(at->definition.travel, 0.84, 1e-14);
  assert_close(ambulo_model_mass(ambulo_problem_model(at)), 60.0, 1e-9);
  const double *g = ambulo_model_gravity(ambulo_problem_model(at));
  assert_close(atan2(-g[0], -g[1]), -0.05, 1e-12);
  assert_int_equal(ambulo_problem_parameters(at).count, 0);
  assert_int_equal(ambulo_problem_at(NULL, values, NULL, NULL, &at), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_at(p, NULL, NULL, NULL, &at), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_at(p, values, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  ambulo_problem_free(at);
  ambulo_problem_free(p);
}

/* all contacts of a stance; all that begin and end at a time */
static void others_go_along(void **state) {
  (void)state;
  static const char *const overrides[] = {
      "free={\"contacts[4].place[0]\": [0.4, 0.6], \"contacts[3].to\": [1.1, 1.25]}"};
  const double values[2] = {0.55, 1.2};
  ambulo_problem *p = NULL, *at = NULL;
  assert_int_equal(ambulo_problem_load("models/walk_start.yaml", overrides, 1, NULL, NULL, &p),
                   AMBULO_OK);
  assert_int_equal(ambulo_problem_at(p, values, NULL, NULL, &at), AMBULO_OK);
  const ambulo_contact *c = at->definition.contacts;
  for (int i = 4; i <= 6; i++) assert_close(c[i].place[0], 0.55, 0.0);
  assert_close(c[7].place[0], 1.18, 0.0);
  assert_close(c[3].to, 1.2, 0.0);
  assert_close(c[4].to, 1.2, 0.0);
  assert_close(c[5].from, 1.2, 0.0);
  ambulo_problem_free(at);
  ambulo_problem_free(p);
}

/* equal heights, equal steps, footholds at both ends of a motion that repeats */
static void kinks_cannot_be_free(void **state) {
  (void)state;
  static const char *const names[][2] = {
      {"models/walk_turn.yaml", "free={\"contacts[4].place[2]\": [-1, 1]}"},
      {"models/walk_turn.yaml", "free={\"contacts[1].to\": [0.1, 0.2]}"},
      {"models/stairs_up.yaml", "free={ends.rise: [0, 1]}"},
      {"models/stairs_up.yaml", "free={\"contacts[0].place[0]\": [-1, 1]}"}};
  for (int i = 0; i < 4; i++) {
    ambulo_problem *p = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    assert_int_equal(ambulo_problem_load(names[i][0], &names[i][1], 1, NULL, list, &p),
                     AMBULO_E_SCHEMA);
    assert_non_null(strstr(ambulo_diagnostics_get(list, 0)->message, "cannot be free"));
    ambulo_diagnostics_free(list);
  }
}

static void faults_are_placed(void **state) {
  (void)state;
  expect_refusal(WALK "free: {gait.step_tim: [0.4, 0.8]}\n", AMBULO_E_SCHEMA,
                 "p.yaml:10:23: error[E_SCHEMA]: 'gait.step_tim' cannot be free");
  expect_refusal(WALK "free: {gait.step_tim: [0.4, 0.8]}\n", AMBULO_E_SCHEMA,
                 "did you mean 'gait.step_time'?");
  expect_refusal(
      WALK "free: {gait.phases.toe_off: [0.4, 0.8]}\n", AMBULO_E_SCHEMA,
      "those are gait.step_time, gait.speed, subject.mass, subject.stature, ground.slope");
  expect_refusal(WALK "free: {time.intervals: [4, 8]}\n", AMBULO_E_SCHEMA, "cannot be free");
  /* a limit that is no row */
  expect_refusal(WALK "free: {\"model.links[shank_r].coordinate.range[1]\": [90, 170]}\n",
                 AMBULO_E_SCHEMA, "cannot be free");
  expect_refusal(WALK "free: {gait.step_time: [0.8, 0.4]}\n", AMBULO_E_SCHEMA,
                 "p.yaml:10:24: error[E_SCHEMA]: bounds of gait.step_time from 0.8 to 0.4; "
                 "expected [lower, upper]");
  expect_refusal(WALK "free: {gait.step_time: [0.5, 0.5]}\n", AMBULO_E_SCHEMA, "[lower, upper]");
  expect_refusal(WALK "free: {gait.step_time: [400, 800]}\n", AMBULO_E_PROBLEM,
                 "gait.step_time is 0.5, outside of 400 to 800; expected bounds around it, in s");
  expect_refusal(WALK "free: {ground.slope: [-0.05, 0.05]}\n", AMBULO_E_PROBLEM,
                 "ground.slope is 3, outside of -0.05 to 0.05; expected bounds around it");
  expect_refusal(WALK "free: {gait.step_time: 0.5}\n", AMBULO_E_SCHEMA, "a sequence of 2 numbers");
  expect_refusal(WALK "free: {gait.step_time: [0.4, long]}\n", AMBULO_E_SCHEMA, "'long'");
  expect_refusal(WALK "free: {gait.step_time: [-0.1, 0.8]}\n", AMBULO_E_SCHEMA,
                 "p.yaml:10:25: error[E_SCHEMA]: got '-0.1");
  expect_refusal(WALK "free: {gait.speed: [1, 200]}\n", AMBULO_E_SCHEMA,
                 "p.yaml:10:24: error[E_SCHEMA]: got '200'; expected a number from 0.001 to 100");
  /* the range of a definition's member is that of its key */
  expect_refusal(WALK "free: {\"objective[torque_squared].weight\": [-1, 2]}\n", AMBULO_E_SCHEMA,
                 "got '-1'; expected a number from 0 to 1e+12");
  expect_refusal(WALK "free: {constraints.ground_height: [-2000, 1]}\n", AMBULO_E_SCHEMA,
                 "got '-2000'; expected a number from -1000 to 1000");
  expect_refusal(WALK "free: {}\n", AMBULO_E_SCHEMA, "0 free parameters; expected 1 to 64");
  expect_refusal(WALK "free: {per: none}\n", AMBULO_E_SCHEMA, "0 free parameters");
  expect_refusal(WALK "free: 3\n", AMBULO_E_SCHEMA, "'free' is not a mapping");
  expect_refusal(WALK "free: {gait.speed: [1, 2], per: step}\n", AMBULO_E_SCHEMA,
                 "got 'step'; expected one of: distance, none");
  expect_refusal(WALK "free: {gait.speed: [1, 2], maximum_solves: 0}\n", AMBULO_E_SCHEMA,
                 "got '0'; expected a whole number");
  expect_refusal(REST "free: {time.duration: [0.5, 2], per: distance}\n", AMBULO_E_PROBLEM,
                 "the body travels 0 m; expected 'per: none'");
  expect_refusal(REST "ends: {initial: {swing: 0}}\nfree: {ends.initial.swing: [-1, 1]}\n",
                 AMBULO_E_SCHEMA, "does not state its unit");
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  static const char text[] = WALK "free: {gait.step_time: [0.4, 0.8], ground.slope: [-5, 5]}\n";
  long last = 0;
  for (long k = 0; k < 100000; k += k < 100 ? 7 : 97) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_problem *p = NULL;
    ambulo_status status =
        ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                        .text = text,
                                                        .length = strlen(text),
                                                        .name = "p.yaml",
                                                        .directory = "models"},
                                 &allocator, NULL, &p);
    if (status == AMBULO_OK) {
      ambulo_problem_free(p);
    } else {
      assert_int_equal(status, AMBULO_E_MEMORY);
      assert_null(p);
    }
    assert_int_equal(memory.live, 0);
    last = k;
    if (!memory.failed) break;
  }
  assert_true(last > 150);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bounds_are_read_in_units_of_the_file),
      cmocka_unit_test(bounds_are_those_of_the_body_that_is_written_for),
      cmocka_unit_test(the_hash_sees_what_is_free),
      cmocka_unit_test(the_problem_elsewhere),
      cmocka_unit_test(others_go_along),
      cmocka_unit_test(kinks_cannot_be_free),
      cmocka_unit_test(faults_are_placed),
      cmocka_unit_test(every_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
