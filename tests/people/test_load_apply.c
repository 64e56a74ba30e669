/* Forces on the feet applied: generalized forces by virtual work, no residual when the forces are
 * those that the motion needs, centres of pressure back from force and moment. */
#include "people/ground_load.h"
#include "support/planar_walker.h"
#include "support/test.h"

enum { MOST = 32 };

static void cross(const double a[3], const double b[3], double c[3]) {
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    c[i] = a[j] * b[k] - a[k] * b[j];
  }
}

/* one row, two feet */
typedef struct one_row {
  double force[6], moment[6], loose[6];
  unsigned char is_loose[2];
  ambulo__ground_load load;
} one_row;

static void row_of(one_row *r) {
  memset(r, 0, sizeof *r);
  r->load = (ambulo__ground_load){.allocator = ambulo__allocator_or_default(NULL),
                                  .rows = 1,
                                  .feet = 2,
                                  .force = r->force,
                                  .moment = r->moment,
                                  .loose = r->loose,
                                  .is_loose = r->is_loose};
}

/* a force at a point of the foot does the work J' f (J by the gradient of the point) */
static void virtual_work(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  ambulo_mechanics *mechanics = NULL;
  int d = ambulo_model_coordinate_count(model);
  double q[MOST], zero[MOST] = {0}, points[192], weights[192] = {0}, work[MOST], rest[2 * MOST];
  double tau[MOST] = {0};
  one_row r;
  row_of(&r);
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  for (int i = 0; i < d; i++) q[i] = 0.1 * (i + 1);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, 1, q, zero, zero,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .points = points}),
                   0);
  for (int foot = 0; foot < 2; foot++) {
    int at = ambulo_model_foot(model, foot)->toe[0];
    for (int i = 0; i < 3; i++)
      weights[3 * at + i] = r.force[3 * foot + i] = i == 2 ? 0.0 : 7.0 - 3.0 * i + foot;
    cross(points + 3 * at, r.force + 3 * foot, r.moment + 3 * foot);
  }
  assert_int_equal(ambulo__ground_load_apply(&r.load, model, q, tau), AMBULO_OK);
  assert_int_equal(
      ambulo_mechanics_gradient(
          mechanics, 1, q, zero, zero,
          &(ambulo_output_weights){.size = sizeof(ambulo_output_weights), .points = weights},
          &(ambulo_motion_gradient){sizeof(ambulo_motion_gradient), work, rest, rest + MOST}),
      0);
  for (int i = 0; i < d; i++) assert_close(tau[i], -work[i], 1e-12);
  ambulo_mechanics_free(mechanics);
  ambulo_model_free(model);
}

/* all of the root wrench given to one foot at the zero-moment point */
static void the_forces_that_are_needed_leave_nothing(void **state) {
  (void)state;
  static const double times[1] = {0.0};
  ambulo_model *model = planar_walker_create();
  ambulo_mechanics *mechanics = NULL;
  int d = ambulo_model_coordinate_count(model);
  double q[MOST] = {0}, qd[MOST], qdd[MOST], tau[MOST], wrench[6], zmp[3], center[3], foot[6];
  double residual[6], weight = 9.81 * ambulo_model_mass(model);
  one_row row;
  ambulo_ground_residual r;
  ambulo__load_poses poses = {center, foot};
  row_of(&row);
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  for (int i = 0; i < d; i++) {
    q[i] = 0.05 * (i + 1);
    qd[i] = 0.3 - 0.1 * i;
    qdd[i] = 0.2 * i - 0.5;
  }
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(
          mechanics, 1, q, qd, qdd,
          &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau, .wrench = wrench}),
      0);
  assert_int_equal(ambulo__load_poses_fill(model, q, 1, NULL, &poses), AMBULO_OK);
  zmp[0] = wrench[2] / wrench[4];
  zmp[1] = zmp[2] = 0.0;
  for (int i = 0; i < 3; i++) row.loose[i] = row.force[i] = wrench[3 + i];
  row.is_loose[0] = 1;
  ambulo__ground_load_place(&row.load, &poses, zmp);
  assert_close(row.moment[2], wrench[2], 1e-10);
  assert_int_equal(ambulo__ground_load_apply(&row.load, model, q, tau), AMBULO_OK);
  for (int i = 0; i < d; i++) {
    if (!ambulo_model_coordinate(model, i)->actuated) assert_close(tau[i] / weight, 0.0, 1e-12);
  }
  ambulo__ground_load_residual(&row.load, model, times, wrench, zmp, center, residual, &r);
  assert_true(isnan(r.moment_rms));
  row.is_loose[0] = 0;
  ambulo__ground_load_residual(&row.load, model, times, wrench, zmp, center, residual, &r);
  for (int i = 0; i < 3; i++) assert_close(r.force_rms[i], 0.0, 1e-12);
  for (int i = 0; i < 6; i++) assert_close(residual[i] / weight, 0.0, 1e-12);
  assert_close(r.moment_rms, 0.0, 1e-12);
  /* too much forward and too little upward force, at the zero-moment point */
  row.force[0] += 0.5 * weight;
  row.force[1] -= 0.25 * weight;
  row.moment[2] -= 0.25 * weight * zmp[0];
  ambulo__ground_load_residual(&row.load, model, times, wrench, zmp, center, residual, &r);
  assert_close(r.force_rms[0], 0.5, 1e-12);
  assert_close(r.force_rms[1], 0.25, 1e-12);
  assert_close(r.moment_rms, 0.0, 1e-12);
  assert_close(residual[0] / weight, -0.5, 1e-12);
  assert_close(residual[1] / weight, 0.25, 1e-12);
  /* about the centre of mass: (zmp - center) x force */
  double arm[3] = {zmp[0] - center[0], zmp[1] - center[1], 0.0}, turn[3];
  cross(arm, residual, turn);
  assert_close(residual[5] / weight, turn[2] / weight, 1e-12);
  ambulo_mechanics_free(mechanics);
  ambulo_model_free(model);
}

/* free fall: the centre of mass is where its acceleration says; without a zero-moment point a loose
 * force acts on the middle of the foot */
static void poses_and_places(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  ambulo_mechanics *mechanics = NULL;
  int d = ambulo_model_coordinate_count(model);
  double q[MOST], zero[MOST] = {0}, wrench[6], center[3], feet[6], points[192],
                  zmp[3] = {NAN, NAN, NAN};
  double weight = 9.81 * ambulo_model_mass(model);
  ambulo__load_poses poses = {center, feet};
  one_row r;
  row_of(&r);
  for (int i = 0; i < d; i++) q[i] = 0.3 - 0.07 * i;
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(
          mechanics, 1, q, zero, zero,
          &(ambulo_outputs){.size = sizeof(ambulo_outputs), .wrench = wrench, .points = points}),
      0);
  assert_int_equal(ambulo__load_poses_fill(model, q, 1, NULL, &poses), AMBULO_OK);
  assert_close(center[0], wrench[2] / weight, 1e-12); /* at rest it stands above the ZMP */
  for (int foot = 0; foot < 2; foot++) {
    const ambulo_foot *f = ambulo_model_foot(model, foot);
    for (int i = 0; i < 3; i++)
      assert_close(feet[3 * foot + i],
                   0.5 * (points[3 * f->heel_center + i] + points[3 * f->toe_center + i]), 1e-12);
  }
  r.loose[3] = 2.0;
  r.loose[4] = 30.0;
  r.is_loose[1] = 1;
  ambulo__ground_load_place(&r.load, &poses, zmp);
  assert_close(r.moment[5], feet[3] * 30.0 - feet[4] * 2.0, 1e-12);
  assert_close(r.moment[2], 0.0, 0.0);
  ambulo_mechanics_free(mechanics);
  ambulo_model_free(model);
}

static void pressure_comes_back(void **state) {
  (void)state;
  static const double force[3] = {30.0, 600.0, -20.0}, point[3] = {1.2, 0.4, 0.1};
  ambulo_model *model = planar_walker_create();
  double cop[6], free_moment[2];
  one_row r;
  row_of(&r);
  memcpy(r.force, force, sizeof force);
  cross(point, force, r.moment);
  r.moment[1] += 7.5;
  r.force[4] = -3.0;
  ambulo__ground_load_pressure(&r.load, model, 0.4, cop, free_moment);
  for (int i = 0; i < 3; i++) assert_close(cop[i], point[i], 1e-13);
  assert_close(free_moment[0], 7.5, 1e-12);
  assert_true(isnan(cop[3]));
  assert_close(free_moment[1], 0.0, 0.0);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(virtual_work), cmocka_unit_test(the_forces_that_are_needed_leave_nothing),
      cmocka_unit_test(poses_and_places), cmocka_unit_test(pressure_comes_back)};
  return cmocka_run_group_tests_name("inverse/load_apply", tests, NULL, NULL);
}
