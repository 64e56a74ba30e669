/* The key `front`: what is read, what is refused, and the list of cases that grows. */
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/sweep_files.h"
#include "study/study.h"

static const char problem[] =
    "ambulo: 1\nkind: problem\nname: swing\nmodel: one.yaml\n"
    "angles: radians\ntime: {duration: 1.0, intervals: 10}\ntrajectory: {intervals: 6}\n"
    "ends: {initial: {pin: 0}, final: {pin: 1}}\n"
    "objective:\n  - {term: torque_squared, weight: 2}\n  - {term: acceleration}\n"
    "  - {term: posture, name: rest, weight: 3, scale: {pin: 1}}\n"
    "  - {term: torque_rate, weight: 0}\n";

static ambulo_status load(void **state, const char *text, const ambulo_allocator *allocator,
                          ambulo_sweep **sweep) {
  return sweep_load_over(state, problem, text, allocator, NULL, sweep);
}

static void refused(void **state, const char *text, const char *message) {
  sweep_refused_over(state, problem, text, message);
}

static void ends_are_cases(void **state) {
  ambulo_sweep *s = NULL;
  assert_int_equal(load(state, "front: {terms: [rest, torque_squared]}\n", NULL, &s), AMBULO_OK);
  assert_int_equal(ambulo_sweep_front_points(s), 12);
  assert_int_equal(ambulo_sweep_case_count(s), 2);
  assert_int_equal(ambulo_sweep_axis_count(s), 2);
  assert_string_equal(ambulo_sweep_axis_name(s, 0), "weight(rest)");
  ambulo_case one;
  assert_int_equal(ambulo_sweep_case(s, 0, &one), AMBULO_OK);
  assert_string_equal(one.name, "least rest");
  assert_int_equal(one.override_count, 2);
  /* twice the file's weights, shares 0.99 and 0.01 */
  assert_string_equal(one.overrides[0], "objective[2].weight=5.94");
  assert_string_equal(one.overrides[1], "objective[0].weight=0.04");
  assert_string_equal(ambulo_sweep_value(s, 1, 1), "3.96");
  assert_int_equal(s->front.neighbour, 0);
  ambulo_sweep_free(s);
  assert_int_equal(load(state,
                        "front: {terms: [rest, acceleration, torque_squared], points: 30, least: "
                        "0.05}\nstart_from: neighbour\n",
                        NULL, &s),
                   AMBULO_OK);
  assert_int_equal(ambulo_sweep_front_points(s), 30);
  assert_int_equal(ambulo_sweep_case_count(s), 3);
  assert_string_equal(ambulo_sweep_value(s, 1, 1), "2.7");
  assert_string_equal(ambulo_sweep_value(s, 1, 2), "0.3");
  assert_int_equal(s->front.neighbour, 1);
  ambulo_sweep_free(s);
  s = NULL;
  assert_int_equal(load(state, "axes:\n  - {key: time.duration, values: [1]}\n", NULL, &s),
                   AMBULO_OK);
  assert_int_equal(ambulo_sweep_front_points(s), 0);
  ambulo_sweep_free(s);
}

static void faults_are_told_with_their_place(void **state) {
  refused(
      state, "front: {terms: [rest, torqe_squared]}\n",
      "s.yaml:5:23: error[E_SCHEMA]: unknown term (got 'torqe_squared'); expected a term of the "
      "base problem's objective\n  hint: did you mean 'torque_squared'?");
  refused(state, "front: {terms: [rest, posture]}\n", "unknown term (got 'posture')");
  refused(state, "front: {terms: [rest]}\n",
          "s.yaml:5:16: error[E_SCHEMA]: a front of 1 term; expected two or three");
  refused(state, "front: {terms: [rest, acceleration, torque_squared, torque_rate]}\n",
          "a front of 4 terms; expected two or three");
  refused(state, "front: {terms: [rest, rest]}\n",
          "s.yaml:5:23: error[E_SCHEMA]: the term 'rest' twice; expected different terms\n"
          "  hint: other terms: torque_squared, acceleration, torque_rate");
  refused(state, "front: {terms: [rest, torque_rate]}\n",
          "the term 'torque_rate' has no weight in the base problem; expected a positive one");
  refused(state, "front: {terms: rest}\n", "'terms' is no list");
  refused(state, "front: {points: 3}\n", "missing required key 'terms'");
  refused(state, "front: {terms: [rest, acceleration], points: 2}\n",
          "got '2'; expected a whole number from 3 to 500");
  refused(state, "front: {terms: [rest, acceleration], point: 9}\n", "did you mean 'points'?");
  refused(state, "front: {terms: [rest, acceleration], least: 0.5}\n", "got '0.5'");
  refused(state, "front: {terms: [rest, acceleration]}\naxes: []\n",
          "s.yaml:6:7: error[E_SCHEMA]: 'axes' beside 'front'");
  refused(state, "front: {terms: [rest, acceleration]}\ncase_name: x\n", "'case_name' beside");
  refused(state, "front: {terms: [rest, acceleration]}\nalong: x\n", "'along' beside 'front'");
  refused(state, "front: {terms: [rest, acceleration]}\nfilters: [\"a < 1\"]\n",
          "'filters' beside 'front'");
}

static void points_are_appended_once(void **state) {
  ambulo_sweep *s = NULL;
  assert_int_equal(load(state,
                        "front: {terms: [rest, torque_squared]}\n"
                        "outputs: [objective, {output: duration, label: d, unit: s}]\n"
                        "limits: {seconds: 7}\n",
                        NULL, &s),
                   AMBULO_OK);
  ambulo_sweep view = ambulo__sweep_without_cases(s), *t = &view;
  assert_int_equal(ambulo_sweep_case_count(t), 0);
  ambulo__front_request request = {{5.94, 0.04}, -1, {-1, -1}, 0};
  int index = -1;
  assert_int_equal(ambulo__sweep_append_point(t, &request, NULL, &index), AMBULO_OK);
  assert_int_equal(index, 0);
  /* the same as in the file's own list */
  ambulo_case one, other;
  assert_int_equal(ambulo_sweep_case(s, 0, &one), AMBULO_OK);
  assert_int_equal(ambulo_sweep_case(t, 0, &other), AMBULO_OK);
  assert_string_equal(one.id, other.id);
  assert_true(one.key == other.key);
  assert_int_equal(ambulo__sweep_append_point(t, &request, NULL, &index), AMBULO_OK);
  assert_true(index == 0 && ambulo_sweep_case_count(t) == 1);
  for (int k = 1; k < 200; k++) {
    request.weight[0] = k;
    request.anchor = k == 1 ? 0 : -1;
    request.from = k == 2 ? 1 : -1;
    assert_int_equal(ambulo__sweep_append_point(t, &request, NULL, &index), AMBULO_OK);
    assert_int_equal(index, k);
  }
  assert_string_equal(t->cases[1].name, "least rest, 2");
  assert_string_equal(t->cases[2].name, "3 from 2");
  assert_string_equal(t->cases[199].name, "200");
  assert_string_equal(ambulo_sweep_value(t, 150, 0), "150");
  assert_string_equal(ambulo_sweep_value(t, 0, 0), "5.94");
  ambulo__sweep_free_cases(t);
  assert_int_equal(ambulo_sweep_case_count(s), 2);
  ambulo_sweep_free(s);
}

static void memory_may_run_out_anywhere(void **state) {
  for (long k = 0; k < 100000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_sweep *s = NULL, grown;
    ambulo__front_request request = {{1.0, 2.0}, -1, {-1, -1}, -1};
    int index;
    ambulo_status status = load(state,
                                "front: {terms: [rest, torque_squared]}\n"
                                "outputs: [objective]\n",
                                &allocator, &s);
    int loaded = !status;
    if (loaded) grown = ambulo__sweep_without_cases(s);
    if (loaded) status = ambulo__sweep_append_point(&grown, &request, NULL, &index);
    assert_true(status == AMBULO_OK || status == AMBULO_E_MEMORY);
    if (loaded) ambulo__sweep_free_cases(&grown);
    ambulo_sweep_free(s);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) return;
  }
  fail();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(ends_are_cases, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(faults_are_told_with_their_place, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(points_are_appended_once, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(memory_may_run_out_anywhere, scratch_open, scratch_close),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
