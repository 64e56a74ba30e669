/* Efforts, torques and all derivatives of devices against dense sums in complex numbers, and what
 * mechanics says of them: virtual work, stored energy, nothing for the body as a whole. */
#include "device_fixture.h"

#include "support/fail_alloc.h"

/* relative to the largest of a group, which says how well its sums can be known */
static double size_of(const number *values, int count) {
  double size = 1;
  for (int i = 0; i < count; i++) size = fmax(size, cabs(values[i]));
  return size;
}

static void each_case(void (*check)(device_case *)) {
  for (int index = 0; index < device_case_count; index++) {
    device_case c;
    device_case_open(&c, index);
    check(&c);
    device_case_close(&c);
  }
}

static void check_forces(device_case *c) {
  double tau[most_coordinates * AMBULO__LANES], effort[most_devices * AMBULO__LANES];
  for (int i = 0; i < c->d * AMBULO__LANES; i++) tau[i] = sin(1.0 + i);
  ambulo__devices_apply(c->devices, c->q, c->qd, c->told, tau, effort, c->scratch);
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    number force[most_coordinates], want[most_devices];
    reference_all(c, lane, -1, 0, force, want);
    double size = size_of(force, c->d), allowed = c->model->coupled_count ? 1e-11 : 1e-12;
    for (int i = 0; i < c->d; i++) {
      double added = sin(1.0 + i * AMBULO__LANES + lane) - tau[i * AMBULO__LANES + lane];
      assert_close(added / size, creal(force[i]) / size, allowed);
    }
    for (int i = 0; i < c->n; i++) {
      double most = fmax(1, cabs(want[i]));
      assert_close(effort[i * AMBULO__LANES + lane] / most, creal(want[i]) / most, allowed);
    }
  }
}

static void test_forces_are_those_of_the_reference(void **state) {
  (void)state;
  each_case(check_forces);
}

/* r of a sharp spring bends within 1 cm: what rounding leaves of a length counts a hundred times.
 */
/* rows of the reference: slope[2 d][d + n], of the forces and efforts */
static void reference_jacobian(const device_case *c, int lane, number *jacobian) {
  int rows = c->d + c->n;
  for (int k = 0; k < 2 * c->d; k++) {
    number *row = jacobian + (size_t)k * (size_t)rows;
    reference_all(c, lane, k, 1e-40, row, row + c->d);
    for (int i = 0; i < rows; i++) row[i] = cimag(row[i]) / 1e-40;
  }
}

enum { most_rows = most_coordinates + most_devices };

static void check_gradients(device_case *c) {
  static number want[2 * most_coordinates * most_rows];
  int rows = c->d + c->n, lane = 3;
  double *kept = calloc(ambulo__devices_entries(c->devices), sizeof *kept);
  assert_non_null(kept);
  ambulo__devices_keep(c->devices, c->q + lane, c->qd + lane, c->told + lane, kept);
  reference_jacobian(c, lane, want);
  double size = size_of(want, 2 * c->d * rows);
  for (int row = 0; row < rows; row++) {
    double gradient[2 * most_coordinates] = {0};
    double sign = row < c->d ? -1 : 1; /* the person has what devices leave */
    if (row < c->d)
      ambulo__devices_add_torque(c->devices, kept, row, gradient);
    else
      ambulo__devices_add_effort(c->devices, kept, row - c->d, gradient);
    for (int k = 0; k < 2 * c->d; k++)
      assert_close(sign * gradient[k] / size, creal(want[k * rows + row]) / size, 3e-11);
  }
  free(kept);
}

static void test_gradients_are_complex_steps(void **state) {
  (void)state;
  each_case(check_gradients);
}

static void check_reverse(device_case *c) {
  static number want[2 * most_coordinates * most_rows];
  double tau[most_coordinates * AMBULO__LANES] = {0}, plain[most_coordinates * AMBULO__LANES] = {0};
  double gq[most_coordinates * AMBULO__LANES] = {0}, gqd[most_coordinates * AMBULO__LANES] = {0};
  double y[most_coordinates * AMBULO__LANES], e[most_devices * AMBULO__LANES];
  double effort[most_devices * AMBULO__LANES];
  const ambulo__device_adjoints adjoints = {y, e, gq, gqd};
  int rows = c->d + c->n;
  for (int i = 0; i < c->d * AMBULO__LANES; i++) y[i] = cos(3.0 * i);
  for (int i = 0; i < c->n * AMBULO__LANES; i++) e[i] = sin(5.0 * i);
  ambulo__devices_reverse(c->devices, c->q, c->qd, c->told, tau, &adjoints, c->scratch);
  ambulo__devices_apply(c->devices, c->q, c->qd, c->told, plain, effort, c->scratch);
  assert_memory_equal(tau, plain, (size_t)c->d * AMBULO__LANES * sizeof *tau);
  for (int lane = 0; lane < AMBULO__LANES; lane += 5) {
    reference_jacobian(c, lane, want);
    double size = c->d * size_of(want, 2 * c->d * rows);
    for (int k = 0; k < 2 * c->d; k++) {
      double sum = 0, *got = k < c->d ? gq : gqd;
      for (int i = 0; i < c->d; i++) sum -= y[i * AMBULO__LANES + lane] * creal(want[k * rows + i]);
      for (int i = 0; i < c->n; i++)
        sum += e[i * AMBULO__LANES + lane] * creal(want[k * rows + c->d + i]);
      assert_close(got[k % c->d * AMBULO__LANES + lane] / size, sum / size, 3e-11);
    }
  }
}

static void test_the_reverse_sweep_is_the_transpose(void **state) {
  (void)state;
  each_case(check_reverse);
}

/* power = sum Q qd = - d/dt of the energy of springs, at what their clutch has */
static void check_power(device_case *c) {
  const double h = 1e-40;
  for (int i = 0; i < c->n; i++) {
    number q[most_coordinates], qd[most_coordinates], slope[most_coordinates], energy;
    const ambulo_device *v = &c->device[i];
    lane_state(c, 1, q, qd);
    ambulo__device_state now =
        ambulo__device_at(c->devices, i, c->q + 1, c->qd + 1, c->told + 1, c->scratch);
    for (int k = 0; k < c->d; k++) q[k] += h * I * qd[k];
    number s = reference_along(c->model, v, q, slope);
    double rate = cimag(s) / h, size = fmax(1, fabs(now.power));
    (void)reference_effort(v, s, rate, c->told[i * AMBULO__LANES + 1], &energy);
    if (v->kind == AMBULO_DEVICE_SPRING)
      assert_close(now.power / size, -cimag(energy) / h / size, 1e-12);
    if (v->kind == AMBULO_DEVICE_DAMPER) assert_true(now.power <= 0.0);
    assert_close(now.rate, rate, 1e-11);
    double pull = 0, tau[most_coordinates * AMBULO__LANES] = {0}, all[most_devices * AMBULO__LANES];
    double told[most_devices * AMBULO__LANES] = {0}; /* it alone */
    told[i * AMBULO__LANES + 1] = c->told[i * AMBULO__LANES + 1];
    ambulo__devices_apply(c->devices, c->q, c->qd, told, tau, all, c->scratch);
    for (int k = 0; k < c->d; k++)
      pull -= tau[k * AMBULO__LANES + 1] * c->qd[k * AMBULO__LANES + 1];
    assert_close(now.power / size, pull / size, 1e-12);
  }
}

static void test_power_is_virtual_work_and_stored_energy(void **state) {
  (void)state;
  each_case(check_power);
}

/* coordinates above both points have no force: not even rounding */
static void check_internal(device_case *c) {
  for (int i = 0; i < c->n; i++) {
    const ambulo_device *v = &c->device[i];
    double tau[most_coordinates * AMBULO__LANES] = {0}, effort[most_devices * AMBULO__LANES];
    double told[most_devices * AMBULO__LANES] = {0};
    if (v->coordinate >= 0 || c->model->coupled_count > 0) continue;
    for (int lane = 0; lane < AMBULO__LANES; lane++) told[i * AMBULO__LANES + lane] = 1.0;
    ambulo__devices_apply(c->devices, c->q, c->qd, told, tau, effort, c->scratch);
    for (int a = v->link[0]; a >= 0; a = c->model->links[a].parent) {
      int shared = 0, coordinate = c->model->links[a].coordinate;
      for (int b = v->link[1]; b >= 0; b = c->model->links[b].parent) shared |= a == b;
      if (shared && coordinate >= 0) assert_true(tau[coordinate * AMBULO__LANES] == 0.0);
    }
  }
}

static void test_what_carries_both_ends_feels_nothing(void **state) {
  (void)state;
  each_case(check_internal);
}

static void test_points_that_meet_have_no_force_that_is_not_finite(void **state) {
  (void)state;
  device_case c;
  device_case_open(&c, 7);
  ambulo__devices_free(c.devices);
  c.definition.device_count = 1;
  c.device[0] = ambulo_device_default(AMBULO_DEVICE_SPRING);
  c.device[0].stiffness = 100;
  c.device[0].rest = 0.1;
  c.device[0].link[0] = c.device[0].link[1] = c.model->link_count - 1;
  assert_int_equal(ambulo__devices_create(&c.definition, NULL, &c.devices), AMBULO_OK);
  double tau[most_coordinates * AMBULO__LANES] = {0}, effort[AMBULO__LANES];
  ambulo__devices_apply(c.devices, c.q, c.qd, c.told, tau, effort, c.scratch);
  for (int i = 0; i < c.d; i++) assert_true(isfinite(tau[i * AMBULO__LANES]));
  assert_true(isfinite(effort[0]));
  device_case_close(&c);
}

static void test_memory_may_fail(void **state) {
  (void)state;
  device_case c;
  device_case_open(&c, 12);
  for (int k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__devices *devices = NULL;
    ambulo_status status = ambulo__devices_create(&c.definition, &allocator, &devices);
    if (!status) {
      assert_true(k > 3);
      ambulo__devices_free(devices);
      assert_int_equal(memory.live, 0);
      break;
    }
    assert_int_equal(status, AMBULO_E_MEMORY);
    assert_null(devices);
    assert_int_equal(memory.live, 0);
  }
  device_case_close(&c);
}

static void test_none_is_none(void **state) {
  (void)state;
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo__devices *devices = NULL;
  assert_int_equal(ambulo__devices_create(&d, NULL, &devices), AMBULO_OK);
  assert_null(devices);
  assert_int_equal(ambulo__devices_scratch(devices), 0);
  assert_int_equal(ambulo__devices_entries(devices), 0);
  ambulo__devices_free(devices);
}

/* a torque at joints that turn; a force at those that slide, and between points */
static void test_what_turns_is_a_torque(void **state) {
  (void)state;
  device_case c;
  int turning = 0, sliding = 0;
  for (int index = 0; index < 12; index++) {
    device_case_open(&c, index);
    ambulo_device device = ambulo_device_default(AMBULO_DEVICE_SPRING);
    assert_int_equal(device.coordinate, -1);
    assert_int_equal(ambulo__device_turns(c.model, &device), 0);
    for (device.coordinate = 0; device.coordinate < c.d; device.coordinate++) {
      int turns = c.model->coordinates[device.coordinate].type == AMBULO_REVOLUTE;
      assert_int_equal(ambulo__device_turns(c.model, &device), turns);
      turning += turns;
      sliding += !turns;
    }
    device_case_close(&c);
  }
  assert_true(turning > 0 && sliding > 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_what_turns_is_a_torque),
      cmocka_unit_test(test_forces_are_those_of_the_reference),
      cmocka_unit_test(test_gradients_are_complex_steps),
      cmocka_unit_test(test_the_reverse_sweep_is_the_transpose),
      cmocka_unit_test(test_power_is_virtual_work_and_stored_energy),
      cmocka_unit_test(test_what_carries_both_ends_feels_nothing),
      cmocka_unit_test(test_points_that_meet_have_no_force_that_is_not_finite),
      cmocka_unit_test(test_memory_may_fail),
      cmocka_unit_test(test_none_is_none)};
  return cmocka_run_group_tests_name("device/devices", tests, NULL, NULL);
}
