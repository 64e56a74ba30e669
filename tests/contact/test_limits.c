/* Limits in both halves of a mirrored stride. In the walker hip_r (3) and hip_l (5), knee_r (4) and
 * knee_l (6) are partners with sign +1; pelvis_tz (0) is its own image with sign -1, pelvis_tx (2)
 * travels. */
#include "ambulo/tools/load.h"
#include "ambulo/tools/tools.h"
#include "contact/row_families.h"
#include "support/messages.h"
#include "support/row_fixture.h"
#include "support/test.h"

static void set(row_fixture *f, int i, double low, double high) {
  f->model->coordinates[i].range[0] = low;
  f->model->coordinates[i].range[1] = high;
}

static void expect(const ambulo__bound *b, double value, int owner, int is_upper, double given,
                   double later) {
  assert_close(b->value, value, 1e-15);
  assert_int_equal(b->owner, owner);
  assert_int_equal(b->is_upper, is_upper);
  assert_close(b->given, given, 1e-15);
  assert_close(b->later, later, 0);
}

static void open_mirrored(row_fixture *f) {
  row_fixture_open(f, 0);
  f->definition.ends = AMBULO_ENDS_MIRRORED;
}

static void the_narrower_end_wins(void **state) {
  (void)state;
  row_fixture f;
  open_mirrored(&f);
  set(&f, 4, -2.0, 0.1);
  set(&f, 6, -1.0, 0.5);
  ambulo__bounds right = ambulo__bounds_of(&f.definition, 4, AMBULO_LIMITED_POSITION);
  ambulo__bounds left = ambulo__bounds_of(&f.definition, 6, AMBULO_LIMITED_POSITION);
  expect(&right.low, -1.0, 6, 0, -1.0, 1.0);
  expect(&right.high, 0.1, 4, 1, 0.1, 0.0);
  expect(&left.low, -1.0, 6, 0, -1.0, 0.0);
  expect(&left.high, 0.1, 4, 1, 0.1, 1.0);
  row_fixture_close(&f);
}

static void other_ends_leave_the_limits_alone(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  set(&f, 4, -2.0, 0.1);
  set(&f, 6, -1.0, 0.5);
  for (int ends = AMBULO_ENDS_FREE; ends <= AMBULO_ENDS_PERIODIC; ends++) {
    f.definition.ends = (ambulo_ends)ends;
    ambulo__bounds b = ambulo__bounds_of(&f.definition, 4, AMBULO_LIMITED_POSITION);
    expect(&b.low, -2.0, 4, 0, -2.0, 0.0);
    expect(&b.high, 0.1, 4, 1, 0.1, 0.0);
  }
  row_fixture_close(&f);
}

/* equal limits are each one's own: symmetric bodies keep the rows they have without mirror */
static void equal_limits_are_ones_own(void **state) {
  (void)state;
  row_fixture f;
  open_mirrored(&f);
  set(&f, 4, -2.0, 0.1);
  set(&f, 6, -2.0, 0.1);
  ambulo__bounds b = ambulo__bounds_of(&f.definition, 6, AMBULO_LIMITED_POSITION);
  expect(&b.low, -2.0, 6, 0, -2.0, 0.0);
  expect(&b.high, 0.1, 6, 1, 0.1, 0.0);
  row_fixture_close(&f);
}

/* the lower limit of the partner is the upper one of its negative */
static void a_sign_turns_the_interval(void **state) {
  (void)state;
  row_fixture f;
  open_mirrored(&f);
  set(&f, 0, -0.3, 0.1);
  ambulo__bounds b = ambulo__bounds_of(&f.definition, 0, AMBULO_LIMITED_POSITION);
  expect(&b.low, -0.1, 0, 1, 0.1, 1.0);
  expect(&b.high, 0.1, 0, 1, 0.1, 0.0);
  f.model->coordinates[4].mirror_sign = f.model->coordinates[6].mirror_sign = -1.0;
  set(&f, 4, -INFINITY, 0.4);
  set(&f, 6, -0.2, INFINITY);
  b = ambulo__bounds_of(&f.definition, 4, AMBULO_LIMITED_POSITION);
  assert_true(b.low.value == -INFINITY);
  expect(&b.high, 0.2, 6, 0, -0.2, 1.0);
  row_fixture_close(&f);
}

/* the second step is a travel further on; speed and torque do not travel */
static void what_travels_needs_room_for_two_steps(void **state) {
  (void)state;
  row_fixture f;
  open_mirrored(&f);
  f.definition.travel = 0.6;
  set(&f, 2, -1.0, 2.0);
  f.model->coordinates[2].speed[1] = 3.0;
  ambulo__bounds b = ambulo__bounds_of(&f.definition, 2, AMBULO_LIMITED_POSITION);
  expect(&b.low, -1.0, 2, 0, -1.0, 0.0);
  expect(&b.high, 1.4, 2, 1, 2.0, 1.0);
  b = ambulo__bounds_of(&f.definition, 2, AMBULO_LIMITED_SPEED);
  expect(&b.high, 3.0, 2, 1, 3.0, 0.0);
  b = ambulo__bounds_of(&f.definition, 1, AMBULO_LIMITED_POSITION); /* up: across the travel */
  assert_close(b.high.later, 0.0, 0);
  row_fixture_close(&f);
}

/* right angles of a model are right to rounding only: what crosses the travel has no share of it */
static void rounding_is_no_travel(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.ends = AMBULO_ENDS_MIRRORED;
  d.travel = 0.68;
  for (int i = 0; i < model->coordinate_count; i++) {
    ambulo__bounds b = ambulo__bounds_of(&d, i, AMBULO_LIMITED_POSITION);
    assert_close(b.low.later, 0.0, 0);
    assert_close(b.high.later, i == 0 ? d.duration : 0.0, 0);
    assert_int_equal(b.high.owner, i);
  }
  ambulo_model_free(model);
}

static void speed_and_torque_likewise(void **state) {
  (void)state;
  row_fixture f;
  open_mirrored(&f);
  ambulo__bounds speed = ambulo__bounds_of(&f.definition, 5, AMBULO_LIMITED_SPEED);
  ambulo__bounds torque = ambulo__bounds_of(&f.definition, 5, AMBULO_LIMITED_TORQUE);
  expect(&speed.low, -8.0, 3, 0, -8.0, 1.0);
  expect(&torque.high, 120.0, 3, 1, 120.0, 1.0);
  row_fixture_close(&f);
}

static void the_limit_of_a_row_is_the_models(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  ambulo__table_row row = {
      .kind = AMBULO__KIND_JOINT_LIMIT, .subject = "knee_r", .detail = "upper"};
  assert_close(ambulo__limit_given(f.model, &row), 0.1, 0);
  row.detail = "lower";
  assert_close(ambulo__limit_given(f.model, &row), -2.0, 0);
  row =
      (ambulo__table_row){.kind = AMBULO__KIND_SPEED_LIMIT, .subject = "hip_r", .detail = "lower"};
  assert_close(ambulo__limit_given(f.model, &row), -8.0, 0);
  row =
      (ambulo__table_row){.kind = AMBULO__KIND_TORQUE_LIMIT, .subject = "hip_r", .detail = "upper"};
  assert_close(ambulo__limit_given(f.model, &row), 120.0, 0);
  row = (ambulo__table_row){
      .subject = "nobody", .kind = AMBULO__KIND_JOINT_LIMIT, .detail = "lower", .constant = 2.0};
  assert_close(ambulo__limit_given(f.model, &row), -2.0, 0);
  row_fixture_close(&f);
}

static void words_name_the_owner(void **state) {
  (void)state;
  row_fixture f;
  char text[AMBULO__WHOSE_SIZE];
  open_mirrored(&f);
  ambulo__bounds b = ambulo__bounds_of(&f.definition, 5, AMBULO_LIMITED_POSITION);
  ambulo__bounds_whose(f.model, &b, text);
  assert_string_equal(text,
                      " (the upper end by the upper limit of hip_r, 1.5, in the mirrored half)");
  b = ambulo__bounds_of(&f.definition, 3, AMBULO_LIMITED_POSITION);
  ambulo__bounds_whose(f.model, &b, text);
  assert_string_equal(text, "");
  set(&f, 0, -0.3, 0.1); /* its own image, turned */
  b = ambulo__bounds_of(&f.definition, 0, AMBULO_LIMITED_POSITION);
  ambulo__bounds_whose(f.model, &b, text);
  assert_string_equal(
      text, " (the lower end by the upper limit of pelvis_tz, 0.1, in the mirrored half)");
  row_fixture_close(&f);
}

/* Joints that could not carry the body at rest are named before solving. */

static const char text[] = "ambulo: 1\n"
                           "kind: problem\n"
                           "name: standing\n"
                           "model: %s.yaml\n"
                           "time: {duration: 0.6, intervals: 6}\n"
                           "trajectory: {basis: bspline, degree: 3, intervals: 6}\n"
                           "contacts:\n"
                           "  - {foot: right, mode: flat, from: 0, to: 0.6, place: [0, 0]}\n"
                           "  - {foot: left, mode: flat, from: 0, to: 0.6, place: [0, 0]}\n"
                           "ground_reaction: {kind: shared}\n"
                           "constraints: {ground_penetration: true, torque_limits: true}\n"
                           "objective: none\n";

static size_t warnings(const char *folder, const char *model, const char *phrase) {
  char problem_text[1200];
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  (void)snprintf(problem_text, sizeof problem_text, text, model);
  ambulo_status status =
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = problem_text,
                                                      .length = strlen(problem_text),
                                                      .name = "standing",
                                                      .directory = folder},
                               NULL, list, &problem);
  if (status) assert_message(list, 0, "no error");
  assert_int_equal(status, AMBULO_OK);
  size_t count = ambulo_diagnostics_count(list);
  if (phrase) assert_message(list, 0, phrase);
  ambulo_problem_free(problem);
  ambulo_diagnostics_free(list);
  return count;
}

static void a_strong_body_stands(void **state) {
  (void)state;
  assert_int_equal(warnings("models", "walker_2d", NULL), 0);
}

/* ankles that push the toes up with 1 % of weight times stature or more */
static void a_weak_joint_is_named(void **state) {
  (void)state;
  assert_int_equal(
      warnings("tests/infeasible/models", "weak_ankles",
               "ankle_angle_r needs 0 N m to carry the body standing still; its torque limits are "
               "12.88 to 55.37 N m"),
      2);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_narrower_end_wins),
                                     cmocka_unit_test(other_ends_leave_the_limits_alone),
                                     cmocka_unit_test(equal_limits_are_ones_own),
                                     cmocka_unit_test(a_sign_turns_the_interval),
                                     cmocka_unit_test(what_travels_needs_room_for_two_steps),
                                     cmocka_unit_test(rounding_is_no_travel),
                                     cmocka_unit_test(speed_and_torque_likewise),
                                     cmocka_unit_test(the_limit_of_a_row_is_the_models),
                                     cmocka_unit_test(words_name_the_owner),
                                     cmocka_unit_test(a_strong_body_stands),
                                     cmocka_unit_test(a_weak_joint_is_named)};
  return cmocka_run_group_tests_name("contact/limits", tests, NULL, NULL);
}
