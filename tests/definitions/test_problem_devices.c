/* `devices` in a problem file: every key, mirror images, refusals with their places. */
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_key), cmocka_unit_test(refusals),
                                     cmocka_unit_test(loads)};
  return cmocka_run_group_tests_name("reader/problem_devices", tests, NULL, NULL);
}
