/* Devices over a stride: the mirrored step, and work that a spring gives back. */
#include "people/waving_stride.h"

static const char *const worn =
    "devices=[{name: exo_r, kind: spring, coordinate: ankle_angle_r, stiffness: 150, rest: -60, "
    "side: above, mirror: true}, {name: twist, kind: spring, coordinate: lumbar_rotation, "
    "stiffness: 30, rest: 0}, {name: band, kind: spring, between: [{link: foot_r, position: [0.04, "
    "0, 0]}, {link: foot_l, position: [0.04, 0, 0]}], stiffness: 120, rest: 0.2}]";

/* the state of the spring at each sample: what it holds is what went in */
static void test_a_mirrored_stride(void **state) {
  (void)state;
  waving_stride waving;
  open_waving_stride(&waving, worn, 2001);
  const ambulo_problem *p = waving.problem;
  const ambulo__stride s = waving.stride;
  int d = s.coordinates, n = s.devices;
  int ankle[2] = {ambulo_model_find_coordinate(p->model, "ankle_angle_r"),
                  ambulo_model_find_coordinate(p->model, "ankle_angle_l")};
  int twist = ambulo_model_find_coordinate(p->model, "lumbar_rotation");
  assert_int_equal(n, 4);
  for (int k = 0; k < s.samples; k += 7) {
    for (int side = 0; side < 2; side++) {
      double q = s.q[k * d + ankle[side]];
      int v = side ? 3 : 0;
      assert_close(s.along[k * n + v], q, 1e-12);
      assert_close(s.effort[k * n + v], -150 * (q + acos(-1) / 3), 1e-10);
      assert_close(s.power[k * n + v], s.effort[k * n + v] * s.qd[k * d + ankle[side]], 1e-10);
    }
    assert_close(s.along[k * n + 1], s.q[k * d + twist], 1e-12);
    assert_close(s.effort[k * n + 1], -30 * s.q[k * d + twist], 1e-12);
    assert_close(s.effort[k * n + 2], 120 * (s.along[k * n + 2] - 0.2), 1e-10);
  }
  for (int v = 0; v < n; v++) {
    double stiffness[] = {150, 30, 120, 150}, rest[] = {-acos(-1) / 3, 0, 0.2, -acos(-1) / 3};
    ambulo__device_work work = ambulo__stride_device_work(&s, v);
    double first = s.along[v] - rest[v], last = s.along[(s.samples - 1) * n + v] - rest[v];
    double peak = 0, stored = 0.5 * stiffness[v] * (last * last - first * first);
    for (int k = 0; k < s.samples; k++) peak = fmax(peak, fabs(s.effort[k * n + v]));
    assert_close(fabs(work.peak), peak, 0);
    assert_true(work.positive > 0 && work.negative < 0);
    /* the motion is no gait: from one step to the next its state jumps */
    double middle = s.along[1000 * n + v] - rest[v], after = s.along[1001 * n + v] - rest[v];
    double jump = 0.5 * stiffness[v] * (after * after - middle * middle);
    assert_close((work.positive + work.negative + stored - jump) / work.positive, 0, 0.02);
  }
  close_waving_stride(&waving);
}

static void test_no_devices_no_arrays(void **state) {
  (void)state;
  waving_stride still;
  open_waving_stride(&still, NULL, 0);
  assert_int_equal(still.stride.devices, 0);
  assert_null(still.stride.effort);
  close_waving_stride(&still);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_a_mirrored_stride),
                                     cmocka_unit_test(test_no_devices_no_arrays)};
  return cmocka_run_group_tests_name("stride/stride_devices", tests, NULL, NULL);
}
