/* `load` with `hands` in a problem file: every key, defaults, beside loads on links, refusals. */
#include "ambulo/parameters.h"
#include "definitions/problem_text.h"

#define HEAD WALKER "time: {duration: 1, intervals: 4}\nobjective: none\n"

static void every_key(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      HEAD "load:\n"
           "  - {link: pelvis, mass: 4, position: [0, 0.1, 0]}\n"
           "  - {name: box, hands: [heel_r, heel_l], mass: 10, inertia: 0.2, center: [0.1, 0, "
           "-0.2], force: [1, 2, 3], from: 0.25, to: 0.75, ramp: 0.125, size: [0.3, 0.4, 0.5]}\n"
           "  - {hands: [heel_r], mass: 2}\n");
  const ambulo_hold *h = p->definition.holds;
  assert_int_equal(p->model->load_count, 1);
  assert_int_equal(ambulo_problem_hold_count(p), 2);
  assert_ptr_equal(ambulo_problem_hold(p, 0), h);
  assert_null(ambulo_problem_hold(p, 2));
  assert_null(ambulo_problem_hold(p, -1));
  assert_string_equal(h[0].name, "box");
  assert_string_equal(p->model->points[h[0].hand[0]].name, "heel_r");
  assert_string_equal(p->model->points[h[0].hand[1]].name, "heel_l");
  assert_close(h[0].mass, 10, 0);
  assert_close(h[0].inertia, 0.2, 0);
  assert_close(h[0].center[2], -0.2, 0);
  assert_close(h[0].force[1], 2, 0);
  assert_close(h[0].from, 0.25, 0);
  assert_close(h[0].to, 0.75, 0);
  assert_close(h[0].ramp, 0.125, 0);
  assert_close(h[0].size[1], 0.4, 0);
  assert_string_equal(h[1].name, "load");
  assert_int_equal(h[1].hand[1], -1);
  assert_close(h[1].ramp, 0.1, 0);
  assert_true(h[1].from == 0 && h[1].to > 1);
  ambulo_problem_free(p);
}

/* other numbers make another problem */
static void the_hash_knows(void **state) {
  (void)state;
  static const char *const loads[] = {"{hands: [heel_r, heel_l], mass: 2}",
                                      "{hands: [heel_r, heel_l], mass: 3}",
                                      "{hands: [heel_l, heel_r], mass: 2}",
                                      "{hands: [heel_r], mass: 2}",
                                      "{hands: [heel_r, heel_l], mass: 2, to: 0.5}",
                                      "{hands: [heel_r], mass: 2, force: [1, 0, 0]}",
                                      "{hands: [heel_r, heel_l], mass: 2, center: [0, 0, 0.1]}"};
  unsigned long long seen[7];
  for (int i = 0; i < 7; i++) {
    char text[400];
    (void)snprintf(text, sizeof text, HEAD "load: %s\n", loads[i]);
    ambulo_problem *p = problem_of(text);
    seen[i] = ambulo_problem_hash(p);
    for (int k = 0; k < i; k++) assert_true(seen[k] != seen[i]);
    ambulo_problem_free(p);
  }
}

static void refuses(const char *load, const char *what) {
  char text[1000];
  (void)snprintf(text, sizeof text, HEAD "load: %s\n", load);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *p = NULL;
  assert_true(load_text(text, list, &p) != AMBULO_OK);
  assert_null(p);
  assert_message(list, 0, what);
  ambulo_diagnostics_free(list);
}

static void refusals(void **state) {
  (void)state;
  refuses("{hands: heel_r, mass: 2}", "'hands' is not a list of one or two points of the model");
  refuses("{hands: [], mass: 2}", "'hands' is not a list of one or two points");
  refuses("{hands: [heel_r, heel_l, toe_r], mass: 2}", "'hands' is not a list of one or two");
  refuses("{hands: [heel_q], mass: 2}",
          "unknown point (got 'heel_q'); expected a point of the model");
  refuses("{hands: [heel_r], mass: -2}", "got '-2'; expected a number from 0 to 1000");
  refuses("{hands: [heel_r], mass: 2, force: [0, 2e5, 0]}", "200000; expected -100000 to 100000");
  refuses("{hands: [heel_r], mass: 2, ramp: 0}", "got '0'");
  refuses("{hands: [heel_r], mass: 2, length: 3}", "unknown key 'length'");
  refuses("{hands: [heel_r, heel_l], mass: 2, from: 0.5, to: 0.6}",
          "taken up and set down over 0.1 s each");
}

/* by the name of the load, or where it stands in the list, beside loads on links */
static void they_may_be_free(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      WALKER
      "time: {duration: 1, intervals: 4}\nobjective: [{term: torque_squared}]\nload: [{name: "
      "box, hands: [heel_r], mass: 2}, {link: pelvis, mass: 4, position: [0, 0.1, 0]}, "
      "{hands: [heel_l], mass: 3, force: [0, 1, 0]}]\nfree: {\"load[box].mass\": [1, 3], "
      "\"load[1].mass\": [1, 5], \"load[2].force[0]\": [-1, 1]}\n");
  assert_int_equal(ambulo_problem_parameters(p).count, 3);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_key), cmocka_unit_test(the_hash_knows),
                                     cmocka_unit_test(refusals),
                                     cmocka_unit_test(they_may_be_free)};
  return cmocka_run_group_tests_name("reader/problem_holds", tests, NULL, NULL);
}
