/* What devices leave to the person, on whole problems: person and devices together are inverse
 * dynamics, nothing outside the body notices, and work adds up. */
#include "problem/nlp.h"
#include "ambulo/tools/load.h"
#include "support/test.h"

#define EXO                                                                                        \
  "{name: exo, kind: spring, coordinate: ankle_angle_r, stiffness: 150, rest: 1, side: above, "    \
  "foot: right, engaged: {from: 0.02, to: 0.64, ramp: 0.1}, mirror: true}"
#define BAND                                                                                       \
  "{name: band, kind: spring, between: [{link: foot_r, position: [0.04, 0, 0]}, {link: foot_l, "   \
  "position: [0.04, 0, 0]}], stiffness: 120, rest: 0.2}"
#define BRAKE                                                                                      \
  "{name: brake, kind: damper, between: [{link: thorax, position: [0, 0.3, 0.1]}, {link: "         \
  "shank_r, position: [0.02, -0.1, 0]}], damping: 20, mirror: true}"

enum { SAMPLES = 23, MOST = 23 };

typedef struct worn {
  ambulo_problem *problem;
  ambulo_workspace *workspace;
  double tau[SAMPLES * MOST], wrench[SAMPLES * 6], grf[SAMPLES * 6], qd[SAMPLES * MOST];
  double effort[SAMPLES * 5], along[SAMPLES * 5], power[SAMPLES * 5];
} worn;

static void open(worn *w, const char *devices) {
  const char *overrides[] = {devices, "time.intervals=30", "trajectory.intervals=9"};
  assert_int_equal(ambulo_problem_load("models/walk.yaml", overrides, 3, NULL, NULL, &w->problem),
                   AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(w->problem, NULL, &w->workspace), AMBULO_OK);
}

static void close_it(worn *w) {
  ambulo_workspace_free(w->workspace);
  ambulo_problem_free(w->problem);
}

static void move(worn *w, const double *x) {
  double times[SAMPLES];
  for (int k = 0; k < SAMPLES; k++)
    times[k] = ambulo_problem_duration(w->problem) * k / (SAMPLES - 1);
  const ambulo_motion motion = {.size = sizeof(ambulo_motion),
                                .qd = w->qd,
                                .tau = w->tau,
                                .wrench = w->wrench,
                                .grf = w->grf,
                                .device_effort = w->effort,
                                .device_along = w->along,
                                .device_power = w->power};
  assert_int_equal(ambulo_problem_motion(w->problem, w->workspace, x, SAMPLES, times, &motion),
                   AMBULO_OK);
}

static double *some_motion(const ambulo_problem *p) {
  double *x = calloc((size_t)p->variables, sizeof *x);
  assert_non_null(x);
  for (int j = 0; j < p->variables; j++)
    x[j] = 0.2 * sin(1.3 * (j % p->coordinates) + 0.7 * (j / p->coordinates));
  return x;
}

static void test_person_and_devices_are_inverse_dynamics(void **state) {
  (void)state;
  worn bare, dressed;
  open(&bare, "name=bare");
  open(&dressed, "devices=[" EXO ", " BAND ", " BRAKE "]");
  double *x = some_motion(bare.problem);
  move(&bare, x);
  move(&dressed, x);
  int d = bare.problem->coordinates, n = dressed.problem->channels.devices;
  int ankle[2] = {ambulo_model_find_coordinate(bare.problem->model, "ankle_angle_r"),
                  ambulo_model_find_coordinate(bare.problem->model, "ankle_angle_l")};
  int hip = ambulo_model_find_coordinate(bare.problem->model, "hip_flexion_r"), differs = 0;
  assert_int_equal(n, 5); /* exo, band, brake, and two images */
  assert_memory_equal(bare.wrench, dressed.wrench, sizeof bare.wrench);
  assert_memory_equal(bare.grf, dressed.grf, sizeof bare.grf);
  for (int k = 0; k < SAMPLES; k++) {
    double power = 0.0, sum = 0.0;
    for (int i = 0; i < d; i++) {
      double taken = bare.tau[k * d + i] - dressed.tau[k * d + i];
      power += taken * bare.qd[k * d + i];
      if (i < 6) assert_true(taken == 0.0); /* the root */
    }
    for (int v = 0; v < n; v++) sum += dressed.power[k * n + v];
    assert_close(power, sum, 1e-11); /* (person + devices) qd = inverse dynamics qd */
    differs += fabs(bare.tau[k * d + hip] - dressed.tau[k * d + hip]) > 1;
  }
  assert_true(differs > SAMPLES / 2);
  close_it(&dressed);
  open(&dressed, "devices=[" EXO "]");
  move(&dressed, x);
  for (int k = 0; k < SAMPLES; k++) {
    for (int side = 0; side < 2; side++) {
      int at = k * d + ankle[side];
      assert_close(dressed.tau[at] + dressed.effort[2 * k + side], bare.tau[at], 1e-12);
    }
  }
  free(x);
  close_it(&bare);
  close_it(&dressed);
}

/* rows and terms by the reverse sweep and by local gradients, against differences */
static void test_the_whole_problem_has_its_gradients(void **state) {
  (void)state;
  static const char *const overrides[] = {
      "devices=[" EXO ", " BAND ", " BRAKE "]",
      "time.intervals=14",
      "trajectory.intervals=6",
      "time.grid=uniform",
      "trajectory.knots=uniform",
      "constraints.torque_limits=true",
      "objective=[{term: torque_squared, weight: 0.01}, {term: device_effort, weight: 0.1, scale: "
      "{band: 0.1, default: 0.05}}, {term: mechanical_power, weight: 1}, {term: torque_rate, "
      "weight: 0.001}]"};
  enum { MOST_FAMILIES = 24 };
  ambulo_problem *p = NULL;
  ambulo_workspace *workspace = NULL;
  ambulo_derivative_error errors[MOST_FAMILIES];
  int count = 0, seen = 0;
  assert_int_equal(ambulo_problem_load("models/walk.yaml", overrides, 7, NULL, NULL, &p),
                   AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(p, NULL, &workspace), AMBULO_OK);
  double *x = some_motion(p);
  assert_int_equal(
      ambulo_problem_check_derivatives(p, workspace, x, 0.0, errors, MOST_FAMILIES, &count),
      AMBULO_OK);
  for (int i = 0; i < count; i++) {
    if (!(errors[i].error < 2e-8))
      fail_msg("%s of %s: %g", errors[i].family, errors[i].subject, errors[i].error);
    seen |= strcmp(errors[i].family, "device_effort") == 0;
    seen |= 2 * (strcmp(errors[i].family, "torque_limit") == 0);
  }
  assert_int_equal(seen, 3);
  free(x);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(p);
}

/* a gradient leaves the torques of the point as they were */
static void test_gradients_leave_the_torques(void **state) {
  (void)state;
  worn w;
  open(&w, "devices=[" EXO ", " BAND "]");
  double *x = some_motion(w.problem), *g = calloc((size_t)w.problem->variables, sizeof *g);
  size_t lanes = (size_t)w.problem->blocks * (size_t)w.workspace->channel_count * AMBULO__LANES;
  double *before = malloc(lanes * sizeof *before);
  assert_non_null(before);
  assert_int_equal(ambulo__evaluate(w.workspace, x), AMBULO_OK);
  memcpy(before, w.workspace->channel, lanes * sizeof *before);
  assert_int_equal(ambulo__gradient(w.workspace, 1.0, NULL, g), AMBULO_OK);
  assert_memory_equal(before, w.workspace->channel, lanes * sizeof *before);
  free(before);
  free(g);
  free(x);
  close_it(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_person_and_devices_are_inverse_dynamics),
                                     cmocka_unit_test(test_the_whole_problem_has_its_gradients),
                                     cmocka_unit_test(test_gradients_leave_the_torques)};
  return cmocka_run_group_tests_name("identities/devices", tests, NULL, NULL);
}
