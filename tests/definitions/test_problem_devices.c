/* `devices` in a problem file: every key, mirror images, refusals with their places. */
#include "ambulo/parameters.h"
#include "definitions/problem_text.h"

#define HEAD WALKER "angles: degrees\ntime: {duration: 1, intervals: 4}\nobjective: none\n"
#define WALK                                                                                       \
  "ends: {kind: periodic, travel: 0.8}\n"                                                          \
  "contacts: [{foot: right, mode: flat, from: 0, to: 0.6, place: [0, 0]}, "                        \
  "{foot: left, mode: flat, from: 0.5, to: 1, place: [0.4, 0]}]\n"

static void every_key(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      HEAD WALK
      "devices:\n"
      "  - {name: a_r, kind: spring, coordinate: ankle_angle_r, stiffness: 150, rest: -9, "
      "pretension: 4, side: above, smoothing: 18, foot: right, engaged: {from: 0.1, to: 0.5, ramp: "
      "0.02}, mirror: true}\n"
      "  - {name: band, kind: spring, between: [{point: heel_r}, {link: foot_l, position: [0.1, "
      "0.2, "
      "0.3]}], stiffness: 60, rest: 0.4, smoothing: 0.03, mirror: true}\n"
      "  - {name: brake, kind: damper, coordinate: knee_angle_l, damping: 2.5}\n"
      "  - {name: motor, kind: actuator, coordinate: hip_flexion_r, amount: -3, by: stride, foot: "
      "left, points: [[0, 1], [0.4, 2], [1, 1]]}\n"
      "  - {name: push, kind: actuator, coordinate: hip_flexion_r, by: time, points: [[0.2, "
      "7]]}\n");
  const ambulo_device *v = p->definition.devices;
  const ambulo_model *m = p->model;
  assert_int_equal(p->definition.device_count, 7);
  assert_int_equal(ambulo_problem_device_count(p), 7);
  assert_ptr_equal(ambulo_problem_device(p, 0), v);
  assert_null(ambulo_problem_device(p, 7));
  assert_string_equal(v[0].name, "a_r");
  assert_string_equal(m->coordinates[v[0].coordinate].name, "ankle_angle_r");
  assert_close(v[0].stiffness, 150, 0);
  assert_close(v[0].rest, -0.15707963267948966, 1e-15);
  assert_close(v[0].pretension, 4, 0);
  assert_int_equal(v[0].side, AMBULO_DEVICE_ABOVE);
  assert_close(v[0].smoothing, 0.31415926535897931, 1e-15);
  assert_true(v[0].clutch);
  assert_string_equal(m->feet[v[0].foot].name, "right");
  assert_close(v[0].from, 0.1, 0);
  assert_close(v[0].to, 0.5, 0);
  assert_close(v[0].ramp, 0.02, 0);
  assert_int_equal(v[0].image_of, -1);
  assert_int_equal(v[1].coordinate, -1);
  assert_string_equal(m->links[v[1].link[0]].name, "foot_r");
  assert_close(v[1].position[1][2], 0.3, 0);
  assert_close(v[1].smoothing, 0.03, 0);
  assert_close(v[1].rest, 0.4, 0);
  assert_int_equal(v[1].side, AMBULO_DEVICE_BOTH);
  assert_close(v[2].damping, 2.5, 0);
  assert_int_equal(v[3].clock, AMBULO_DEVICE_BY_STRIDE);
  assert_int_equal(v[3].point_count, 2); /* the end of the stride is its begin */
  assert_close(v[3].points[1][1], 2, 0);
  assert_close(v[4].amount, 1, 0);
  assert_int_equal(v[4].clock, AMBULO_DEVICE_BY_TIME);
  assert_string_equal(v[5].name, "a_l");
  assert_int_equal(v[5].image_of, 0);
  assert_string_equal(m->coordinates[v[5].coordinate].name, "ankle_angle_l");
  assert_string_equal(m->feet[v[5].foot].name, "left");
  assert_string_equal(v[6].name, "band_mirror");
  assert_int_equal(v[6].image_of, 1);
  assert_string_equal(m->links[v[6].link[0]].name, "foot_l");
  ambulo_problem_free(p);
}

static void refuses(const char *devices, const char *what) {
  char text[3000];
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *p = NULL;
  (void)snprintf(text, sizeof text, HEAD "devices: %s\n", devices);
  assert_true(load_text(text, list, &p) != AMBULO_OK);
  assert_null(p);
  assert_message(list, 0, what);
  ambulo_diagnostics_free(list);
}

static void refusals(void **state) {
  (void)state;
  refuses("{name: a}", "'devices' is not a list; expected a list of {kind, name, ");
  refuses("[{kind: spring, coordinate: knee_angle_r, stiffness: 1, rest: 0}]",
          "missing required key 'name'");
  refuses("[{name: a, coordinate: knee_angle_r}]", "missing required key 'kind'");
  refuses("[{name: a, kind: sprig, coordinate: knee_angle_r}]", "got 'sprig'");
  refuses("[{name: a, kind: damper, damping: 1}]", "with none of 'coordinate' and 'between'");
  refuses("[{name: a, kind: damper, damping: 1, coordinate: knee_angle_r, between: []}]",
          "with both of");
  refuses("[{name: a, kind: damper, damping: 1, coordinate: knee_angel_r}]",
          "unknown coordinate (got 'knee_angel_r')");
  refuses("[{name: a, kind: damper, damping: 1, between: [{link: foot_r, position: [0, 0, 0]}]}]",
          "'between' is not a list of two places");
  refuses("[{name: a, kind: damper, damping: 1, between: [{link: foot_x, position: [0, 0, 0]}, "
          "{point: heel_l}]}]",
          "unknown link (got 'foot_x')");
  refuses("[{name: a, kind: damper, damping: 1, between: [{point: hell_r}, {point: heel_l}]}]",
          "unknown point (got 'hell_r')");
  refuses("[{name: a, kind: damper, coordinate: knee_angle_r}]", "missing required key 'damping'");
  refuses("[{name: a, kind: spring, coordinate: knee_angle_r, stiffness: -1, rest: 0}]", "-1");
  refuses("[{name: a, kind: spring, coordinate: knee_angle_r, stiffness: 1}]",
          "missing required key 'rest'");
  refuses("[{name: a, kind: spring, coordinate: knee_angle_r, stiffness: 1, rest: 0, side: up}]",
          "got 'up'");
  refuses("[{name: a, kind: spring, coordinate: knee_angle_r, stiffness: 1, rest: 0, damping: 2}]",
          "unknown key 'damping'");
  refuses(
      "[{name: a, kind: spring, coordinate: knee_angle_r, stiffness: 1, rest: 0, engaged: {from: "
      "0.1, to: 0.5}}]",
      "missing required key 'foot'");
  refuses("[{name: a, kind: actuator, coordinate: knee_angle_r, points: [[0, 1]]}]",
          "missing required key 'by'");
  refuses("[{name: a, kind: actuator, coordinate: knee_angle_r, by: time}]", "0 points");
  refuses("[{name: a, kind: actuator, coordinate: knee_angle_r, by: stride, foot: right, points: "
          "[[0, 1], [1, 2]]}]",
          "2 at the end of the stride and 1 at its begin");
  refuses("[{name: a, kind: damper, damping: 1, coordinate: pelvis_tx}]",
          "p.yaml:7:11: error[E_PROBLEM]: devices[0]: 'a' would act on 'pelvis_tx'");
}

static void loads(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(HEAD "load: [{link: shank_r, mass: 2, position: [0, 0.1, 0]}, "
                                      "{link: shank_r, mass: 3, position: [0, 0, 0]}]\n");
  ambulo_problem *one = problem_of(HEAD "load: {link: shank_r, mass: 5, position: [0, 0.04, 0]}\n");
  int link = ambulo_model_find_link(p->model, "shank_r");
  assert_int_equal(p->model->load_count, 2);
  assert_close(ambulo__model_load_mass(p->model), 5, 0);
  assert_close(p->model->mass, one->model->mass, 1e-14);
  for (int k = 0; k < 3; k++)
    assert_close(p->model->links[link].com[k], one->model->links[link].com[k], 1e-14);
  ambulo_problem_free(p);
  ambulo_problem_free(one);
}

/* `load` with `hands` in a problem file: every key, defaults, beside loads on links, refusals. */

#define TEST_PROBLEM_HOLDS_HEAD WALKER "time: {duration: 1, intervals: 4}\nobjective: none\n"

static void test_problem_holds_every_key(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      TEST_PROBLEM_HOLDS_HEAD
      "load:\n"
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
    (void)snprintf(text, sizeof text, TEST_PROBLEM_HOLDS_HEAD "load: %s\n", loads[i]);
    ambulo_problem *p = problem_of(text);
    seen[i] = ambulo_problem_hash(p);
    for (int k = 0; k < i; k++) assert_true(seen[k] != seen[i]);
    ambulo_problem_free(p);
  }
}

static void test_problem_holds_refuses(const char *load, const char *what) {
  char text[1000];
  (void)snprintf(text, sizeof text, TEST_PROBLEM_HOLDS_HEAD "load: %s\n", load);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *p = NULL;
  assert_true(load_text(text, list, &p) != AMBULO_OK);
  assert_null(p);
  assert_message(list, 0, what);
  ambulo_diagnostics_free(list);
}

static void test_problem_holds_refusals(void **state) {
  (void)state;
  test_problem_holds_refuses("{hands: heel_r, mass: 2}",
                             "'hands' is not a list of one or two points of the model");
  test_problem_holds_refuses("{hands: [], mass: 2}", "'hands' is not a list of one or two points");
  test_problem_holds_refuses("{hands: [heel_r, heel_l, toe_r], mass: 2}",
                             "'hands' is not a list of one or two");
  test_problem_holds_refuses("{hands: [heel_q], mass: 2}",
                             "unknown point (got 'heel_q'); expected a point of the model");
  test_problem_holds_refuses("{hands: [heel_r], mass: -2}",
                             "got '-2'; expected a number from 0 to 1000");
  test_problem_holds_refuses("{hands: [heel_r], mass: 2, force: [0, 2e5, 0]}",
                             "200000; expected -100000 to 100000");
  test_problem_holds_refuses("{hands: [heel_r], mass: 2, ramp: 0}", "got '0'");
  test_problem_holds_refuses("{hands: [heel_r], mass: 2, length: 3}", "unknown key 'length'");
  test_problem_holds_refuses("{hands: [heel_r, heel_l], mass: 2, from: 0.5, to: 0.6}",
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
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_key),       cmocka_unit_test(refusals),
      cmocka_unit_test(loads),           cmocka_unit_test(test_problem_holds_every_key),
      cmocka_unit_test(the_hash_knows),  cmocka_unit_test(test_problem_holds_refusals),
      cmocka_unit_test(they_may_be_free)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
