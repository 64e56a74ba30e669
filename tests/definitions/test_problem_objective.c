/* `objective:`. */
#include "definitions/problem_text.h"
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"

#define TIME "time: {duration: 1, intervals: 4}\n"

static void terms_are_read(void **state) {
  (void)state;
  ambulo_problem *p =
      problem_of(WALKER TIME "objective:\n"
                             "  - {term: torque_squared, weight: 2, scale: 0.5}\n"
                             "  - term: torque_absolute\n    name: effort\n    smoothing: 0.25\n"
                             "    scale: {pelvis_tx: 0.05, default: 3}\n"
                             "    offset: {pelvis_ty: body_weight, pelvis_tx: -4}\n"
                             "  - {term: acceleration, weight: 1e-3}\n");
  const ambulo_problem_definition *d = &p->definition;
  int tx = ambulo_model_find_coordinate(p->model, "pelvis_tx");
  int ty = ambulo_model_find_coordinate(p->model, "pelvis_ty");
  assert_int_equal(d->term_count, 3);
  assert_int_equal(d->terms[0].kind, AMBULO_TORQUE_SQUARED);
  assert_close(d->terms[0].weight, 2.0, 0.0);
  for (int i = 0; i < 9; i++) assert_close(d->terms[0].scale[i], 0.5, 0.0);
  assert_null(d->terms[0].offset);
  assert_string_equal(ambulo_problem_term_name(p, 1), "effort");
  assert_int_equal(d->terms[1].kind, AMBULO_TORQUE_ABSOLUTE);
  assert_close(d->terms[1].smoothing, 0.25, 0.0);
  assert_close(d->terms[1].weight, 1.0, 0.0);
  for (int i = 0; i < 9; i++) {
    assert_close(d->terms[1].scale[i], i == tx ? 0.05 : 3.0, 0.0);
    assert_close(d->terms[1].offset[i], i == ty ? 75.0 * 9.81 : i == tx ? -4.0 : 0.0, 1e-9);
  }
  assert_int_equal(d->terms[2].kind, AMBULO_ACCELERATION);
  assert_close(d->terms[2].weight, 1e-3, 0.0);
  ambulo_problem_free(p);
}

static void faults_are_placed(void **state) {
  (void)state;
  expect_refusal(WALKER TIME "objective: nothing\n", AMBULO_E_SCHEMA, "p.yaml:5:12: error");
  expect_refusal(WALKER TIME "objective: []\n", AMBULO_E_SCHEMA, "not a list of 1 to 64 terms");
  expect_refusal(WALKER TIME "objective: [torque_squared]\n", AMBULO_E_SCHEMA,
                 "p.yaml:5:13: error[E_SCHEMA]: a term is not a mapping");
  expect_refusal(WALKER TIME "objective: [{term: torque_square}]\n", AMBULO_E_SCHEMA,
                 "p.yaml:5:20: error");
  expect_refusal(WALKER TIME "objective: [{weight: 1}]\n", AMBULO_E_SCHEMA, "'term'");
  expect_refusal(WALKER TIME "objective: [{term: acceleration, weight: -1}]\n", AMBULO_E_SCHEMA,
                 "p.yaml:5:42: error");
  expect_refusal(WALKER TIME "objective: [{term: torque_squared, scale: {knee: 1}}]\n",
                 AMBULO_E_SCHEMA, "p.yaml:5:44: error[E_SCHEMA]: unknown key 'knee'");
  expect_refusal(WALKER TIME "objective: [{term: torque_squared, offset: 3}]\n", AMBULO_E_SCHEMA,
                 "got '3'; expected a mapping");
  expect_refusal(WALKER TIME "objective: [{term: torque_squared, offset: {pelvis_ty: weight}}]\n",
                 AMBULO_E_SCHEMA, "p.yaml:5:56: error");
  expect_refusal(WALKER TIME
                 "objective: [{term: torque_squared, offset: {pelvis_tx: body_weight}}]\n",
                 AMBULO_E_PROBLEM, "body_weight on 'pelvis_tx'; expected a vertical translation");
  expect_refusal(WALKER TIME "objective: [{term: acceleration, offset: {pelvis_tx: 1}}]\n",
                 AMBULO_E_SCHEMA, "unknown key 'offset'");
  expect_refusal(WALKER TIME "objective: [{term: torque_absolute, smoothing: 0}]\n",
                 AMBULO_E_SCHEMA, "p.yaml:5:48: error");
  expect_refusal(WALKER TIME "objective: [{term: tracking}]\n", AMBULO_E_SCHEMA, "'reference'");
}

/* [d][2][3]: the model's torque limits, at any angle */
static void limits_are_strength(void **state) {
  (void)state;
#define WITH(strength)                                                                             \
  "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\ntime: {intervals: 6, duration: 1}\n"       \
  "objective:\n  - {term: torque_power, scale: {default: 0, ankle_angle_r: 0.7}" strength "}\n"
  ambulo_problem *p = problem_of(WITH(", strength: limits"));
  const ambulo_term *term = &p->definition.terms[0];
  int ankle = ambulo_model_find_coordinate(p->model, "ankle_angle_r");
  const double *limit = ambulo_model_coordinate(p->model, ankle)->torque;
  assert_true(limit[0] < -100.0 && limit[1] > 20.0 && limit[1] < 100.0);
  assert_close(term->strength[6 * ankle], limit[1], 0.0);
  assert_close(term->strength[6 * ankle + 3], -limit[0], 0.0);
  for (int k = 1; k < 6; k += 1 + (k == 2))
    assert_close(term->strength[6 * ankle + k], 0.0, 0.0); /* c2, c3 */
  ambulo_problem *without = problem_of(WITH(""));
  assert_true(ambulo_problem_hash(p) != ambulo_problem_hash(without));
  ambulo_problem_free(without);
  ambulo_problem_free(p);
  expect_refusal(WITH(", strength: limit"), AMBULO_E_SCHEMA, "limits");
#define PRICED(pair, strength)                                                                     \
  "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\ntime: {intervals: 6, duration: 1}\n"       \
  "objective:\n  - {term: torque_power, scale: {default: 0, ankle_angle_r: " pair "}" strength     \
  "}\n"
  p = problem_of(PRICED("[0.5, 4]", ", strength: limits"));
  term = &p->definition.terms[0];
  limit = ambulo_model_coordinate(p->model, ankle)->torque;
  assert_close(term->scale[ankle], 1.0, 0.0);
  assert_close(term->strength[6 * ankle], limit[1] / 4.0, 1e-12);
  assert_close(term->strength[6 * ankle + 3], -limit[0] / 0.5, 1e-12);
  ambulo_problem_free(p);
  expect_refusal(PRICED("[0.5, 4]", ""), AMBULO_E_SCHEMA, "got a sequence of 2; expected a number");
  expect_refusal(PRICED("[0.5, 4]", ""), AMBULO_E_SCHEMA, "torque_power with strength: limits");
  expect_refusal(PRICED("[0.5, 0]", ", strength: limits"), AMBULO_E_SCHEMA,
                 "p.yaml:6:67: error[E_SCHEMA]: a price of 0 for ankle_angle_r; expected one above "
                 "0");
  expect_refusal(PRICED("[-0.5, 1]", ", strength: limits"), AMBULO_E_SCHEMA,
                 "p.yaml:6:62: error[E_SCHEMA]: a price of -0.5 for ankle_angle_r");
  expect_refusal(PRICED("[0.5, 1, 2]", ", strength: limits"), AMBULO_E_SCHEMA,
                 "expected a sequence of 2 numbers");
  expect_refusal("ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\n"
                 "time: {intervals: 6, duration: 1}\n"
                 "objective: [{term: torque_power, strength: limits}]\n",
                 AMBULO_E_PROBLEM, "pelvis_tx has none in the model");
}

/* N m/rad by coordinate, in series with muscles; none where not named */
static void tendons_are_read(void **state) {
  (void)state;
#define BEHIND(more)                                                                               \
  "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\ntime: {intervals: 6, duration: 1}\n"       \
  "objective:\n  - {term: mechanical_power" more "}\n"
  ambulo_problem *p = problem_of(BEHIND(", tendon: {ankle_angle_r: 400}"));
  const double *tendon = p->definition.terms[0].tendon;
  int ankle = ambulo_model_find_coordinate(p->model, "ankle_angle_r");
  assert_non_null(tendon);
  for (int i = 0; i < 18; i++) assert_close(tendon[i], i == ankle ? 400.0 : 0.0, 0.0);
  ambulo_problem_free(p);
  p = problem_of(BEHIND(""));
  assert_null(p->definition.terms[0].tendon);
  ambulo_problem_free(p);
  p = problem_of(BEHIND(", negative: 0.3"));
  assert_close(p->definition.terms[0].negative, 0.3, 0.0);
  ambulo_problem_free(p);
  p = problem_of(BEHIND(""));
  assert_close(p->definition.terms[0].negative, 1.0, 0.0);
  ambulo_problem_free(p);
  expect_refusal(BEHIND(", negative: -0.1"), AMBULO_E_SCHEMA, "p.yaml:6:40: error");
  expect_refusal(BEHIND(", negative: 1.1"), AMBULO_E_SCHEMA, "p.yaml:6:40: error");
  expect_refusal("ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\n"
                 "time: {intervals: 6, duration: 1}\n"
                 "objective: [{term: torque_rate, negative: 0.3}]\n",
                 AMBULO_E_SCHEMA, "unknown key 'negative'");
  expect_refusal(BEHIND(", tendon: {ankle_angle_r: 0}"), AMBULO_E_SCHEMA, "p.yaml:6:54: error");
  expect_refusal(BEHIND(", tendon: 400"), AMBULO_E_SCHEMA, "p.yaml:6:38: error");
  expect_refusal(BEHIND(", tendon: {ankle: 400}"), AMBULO_E_SCHEMA, "unknown key 'ankle'");
  expect_refusal("ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\n"
                 "time: {intervals: 6, duration: 1}\n"
                 "objective: [{term: torque_rate, tendon: {ankle_angle_r: 400}}]\n",
                 AMBULO_E_SCHEMA, "unknown key 'tendon'");
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  static const char text[] =
      PRICED("[0.5, 4]",
             ", strength: limits") "  - {term: mechanical_power, tendon: {ankle_angle_r: 400}}\n"
                                   "written_for: {mass: 60, stature: 1.6}\n";
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
    if (status)
      assert_int_equal(status, AMBULO_E_MEMORY);
    else
      ambulo_problem_free(p);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_true(k < 99000);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(terms_are_read), cmocka_unit_test(limits_are_strength),
      cmocka_unit_test(tendons_are_read), cmocka_unit_test(every_allocation_may_fail),
      cmocka_unit_test(faults_are_placed)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
