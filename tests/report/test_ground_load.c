/* Forces on the feet: columns and times of the file, generalized forces by virtual work, and no
 * residual when the forces are those that the motion needs. */
#include "report/ground_load.h"
#include "support/messages.h"
#include "support/planar_walker.h"
#include "support/scratch.h"

enum { ROWS = 3 };
static const double times[ROWS] = {0.0, 0.5, 1.0};

static ambulo_status read_load(void **state, const ambulo_model *model, const char *text,
                               ambulo_diagnostics *list, ambulo__ground_load *load) {
  const char *path = scratch_path(state, "forces.csv");
  scratch_write(path, text);
  return ambulo__ground_load_read(model, path, times, ROWS, NULL, list, load);
}

static int foot_of(const ambulo_model *model, char side) {
  return ambulo_model_foot(model, 0)->name[0] == side ? 0 : 1;
}

static void columns_and_times(void **state) {
  ambulo_model *model = walker_create();
  ambulo__ground_load load;
  assert_int_equal(read_load(state, model,
                             "time,ground_force_r_vx,ground_force_r_vy,ground_force_r_px,"
                             "ground_torque_r_z,ground_force_l_vy\n"
                             "-1,0,0,0,0,0\n1,10,20,0.4,2,6\n",
                             NULL, &load),
                   AMBULO_OK);
  size_t right = 3 * (2 * 1 + (size_t)foot_of(model, 'r'));
  size_t left = 3 * (2 * 1 + (size_t)foot_of(model, 'l'));
  assert_int_equal(load.has_points, 1);
  assert_close(load.force[right], 7.5, 1e-14);
  assert_close(load.force[right + 1], 15.0, 1e-14);
  assert_close(load.force[left + 1], 4.5, 1e-14);
  assert_close(load.point[right], 0.3, 1e-14);
  assert_close(load.torque[right + 2], 1.5, 1e-14);
  ambulo__ground_load_free(&load);
  const char *foot = ambulo_model_foot(model, foot_of(model, 'r'))->name;
  char text[256];
  (void)snprintf(text, sizeof text,
                 "time,grf.%s.y,cop.%s.x,zmp.x,free_moment.%s\n0,8,0.2,nan,4\n1,0,nan,0,2\n", foot,
                 foot, foot);
  assert_int_equal(read_load(state, model, text, NULL, &load), AMBULO_OK);
  assert_close(load.force[right + 1], 4.0, 1e-14);
  assert_close(load.point[right], 0.2, 1e-14);
  assert_close(load.torque[right + 1], 3.0, 1e-14);
  ambulo__ground_load_free(&load);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(read_load(state, model, "time,x\n0,1\n1,1\n", list, &load), AMBULO_E_SCHEMA);
  assert_message(list, 0, "no column of forces on a foot");
  assert_int_equal(read_load(state, model, "time,ground_force_r_vx\n0,1\n0.9,1\n", list, &load),
                   AMBULO_E_SCHEMA);
  assert_message(list, 1, "forces from 0 to 0.9 s; expected them from 0 to 1 s");
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

/* a force at a point of the foot does the work J' f (J by the gradient of the point) */
static void virtual_work(void **state) {
  (void)state;
  ambulo_model *model = walker_create();
  ambulo_mechanics *mechanics = NULL;
  int d = ambulo_model_coordinate_count(model), p = ambulo_model_point_count(model);
  double q[32], zero[32] = {0}, points[192], weights[192] = {0}, work[32], rest[64], tau[32] = {0};
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  for (int i = 0; i < d; i++) q[i] = 0.1 * (i + 1);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(mechanics, 1, q, zero, zero, NULL, NULL, points), 0);
  for (int foot = 0; foot < 2; foot++) {
    int at = ambulo_model_foot(model, foot)->toe[0];
    double force[6] = {0}, point[6] = {0}, torque[6] = {0};
    for (int i = 0; i < 3; i++) {
      weights[3 * at + i] = force[3 * foot + i] = i == 2 ? 0.0 : 7.0 - 3.0 * i + foot;
      point[3 * foot + i] = points[3 * at + i];
    }
    ambulo__ground_load load = {
        .rows = 1, .feet = 2, .force = force, .point = point, .torque = torque};
    assert_int_equal(ambulo__ground_load_apply(&load, model, q, tau), AMBULO_OK);
  }
  assert_int_equal(ambulo_mechanics_gradient(mechanics, 1, q, zero, zero, NULL, NULL, weights, work,
                                             rest, rest + 32),
                   0);
  assert_true(p <= 64);
  for (int i = 0; i < d; i++) assert_close(tau[i], -work[i], 1e-12);
  ambulo_mechanics_free(mechanics);
  ambulo_model_free(model);
}

/* all of the root wrench given to one foot at the zero-moment point */
static void the_forces_that_are_needed_leave_nothing(void **state) {
  (void)state;
  ambulo_model *model = walker_create();
  ambulo_mechanics *mechanics = NULL;
  int d = ambulo_model_coordinate_count(model);
  double q[32] = {0}, qd[32], qdd[32], tau[32], wrench[6], zmp[3];
  double force[6] = {0}, point[6] = {0}, torque[6] = {0};
  ambulo_ground_residual r;
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  for (int i = 0; i < d; i++) {
    q[i] = 0.05 * (i + 1);
    qd[i] = 0.3 - 0.1 * i;
    qdd[i] = 0.2 * i - 0.5;
  }
  assert_int_equal(ambulo_mechanics_inverse_dynamics(mechanics, 1, q, qd, qdd, tau, wrench, NULL),
                   0);
  zmp[0] = wrench[2] / wrench[4];
  zmp[1] = zmp[2] = 0.0;
  for (int i = 0; i < 3; i++) force[i] = wrench[3 + i];
  ambulo__ground_load load = {
      .rows = 1, .feet = 2, .force = force, .point = point, .torque = torque};
  double weight = 9.81 * ambulo_model_mass(model);
  ambulo__ground_load_place(&load, zmp);
  assert_close(point[3], zmp[0], 0.0);
  assert_int_equal(ambulo__ground_load_apply(&load, model, q, tau), AMBULO_OK);
  for (int i = 0; i < d; i++) {
    if (!ambulo_model_coordinate(model, i)->actuated) assert_close(tau[i] / weight, 0.0, 1e-12);
  }
  load.has_points = 1;
  ambulo__ground_load_residual(&load, model, times, wrench, zmp, &r);
  for (int i = 0; i < 3; i++) assert_close(r.force_rms[i], 0.0, 1e-12);
  assert_close(r.moment_rms, 0.0, 1e-12);
  force[0] += 0.5 * weight;
  force[1] -= 0.25 * weight;
  ambulo__ground_load_residual(&load, model, times, wrench, zmp, &r);
  assert_close(r.force_rms[0], 0.5, 1e-12);
  assert_close(r.force_rms[1], 0.25, 1e-12);
  load.has_points = 0;
  ambulo__ground_load_residual(&load, model, times, wrench, zmp, &r);
  assert_true(isnan(r.moment_rms));
  ambulo_mechanics_free(mechanics);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(columns_and_times, scratch_open, scratch_close),
      cmocka_unit_test(virtual_work), cmocka_unit_test(the_forces_that_are_needed_leave_nothing)};
  return cmocka_run_group_tests_name("report/ground_load", tests, NULL, NULL);
}
