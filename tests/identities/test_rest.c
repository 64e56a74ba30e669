/* A body at rest and the mass matrix: the zero-moment point is the centre of mass projected
 * along gravity, the wrench carries the weight, M is symmetric and positive, and q-dot' M q-dot
 * is twice the kinetic energy. */
#include "support/lagrangian_energy.h"
#include "mechanics/lagrangian.h"
#include "identities/point_masses.h"

enum { poses = 12 };

static void pose(int k, double *q) {
  for (int i = 0; i < masses_joints; i++) q[i] = 0.9 * sin(1.0 + 0.7 * i + 1.3 * k);
}

static void center_of_mass(const double *points, double center[3]) {
  double mass = 0.0;
  center[0] = center[1] = center[2] = 0.0;
  for (int e = 0; e < masses_ends; e++) {
    mass += masses_of_end(e);
    for (int u = 0; u < 3; u++) center[u] += masses_of_end(e) * points[3 * e + u];
  }
  for (int u = 0; u < 3; u++) center[u] /= mass;
}

static void zero_moment_point_is_below_the_center_of_mass(void **state) {
  (void)state;
  ambulo_model *model = masses_create();
  ambulo_problem_definition definition = ambulo_problem_definition_default();
  definition.model = model;
  definition.ground_height = masses_ground;
  ambulo_problem *problem = NULL;
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  int control_points = ambulo_problem_control_point_count(problem);
  double *x = calloc((size_t)control_points * masses_joints, sizeof *x);
  const double *up = ambulo_model_up(model);
  for (int k = 0; k < poses; k++) {
    for (int c = 0; c < control_points; c++) pose(k, x + c * masses_joints);
    double points[3 * masses_ends], zmp[3], wrench[6], center[3], time = 0.43;
    ambulo_motion motion = {
        .size = sizeof(ambulo_motion), .points = points, .zmp = zmp, .wrench = wrench};
    assert_int_equal(ambulo_problem_motion(problem, workspace, x, 1, &time, &motion), AMBULO_OK);
    center_of_mass(points, center);
    double height = up[0] * center[0] + up[1] * center[1] + up[2] * center[2];
    for (int u = 0; u < 3; u++) {
      assert_close(zmp[u], center[u] - (height - masses_ground) * up[u], 1e-11);
      assert_close(wrench[3 + u], -ambulo_model_mass(model) * masses_gravity[u], 1e-12);
    }
  }
  free(x);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

/* in place; fails where a pivot is not positive */
static void factor(double *m, int n) {
  for (int j = 0; j < n; j++) {
    for (int k = 0; k < j; k++) m[j * n + j] -= m[j * n + k] * m[j * n + k];
    assert_true(m[j * n + j] > 0.0);
    m[j * n + j] = sqrt(m[j * n + j]);
    for (int i = j + 1; i < n; i++) {
      for (int k = 0; k < j; k++) m[i * n + j] -= m[i * n + k] * m[j * n + k];
      m[i * n + j] /= m[j * n + j];
    }
  }
}

static void mass_matrix_is_symmetric_positive_and_gives_the_energy(void **state) {
  (void)state;
  enum { n = masses_joints };
  ambulo_model *model = masses_create();
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  void *scratch = malloc(ambulo__lagrangian_scratch_size(model));
  for (int k = 0; k < poses; k++) {
    double q[n], qd[n], qdd[n], m[n * n], kinetic, potential, twice = 0.0;
    pose(k, q);
    pose(k + 3, qd);
    pose(k + 5, qdd);
    ambulo_jacobians jacobians = {.size = sizeof(ambulo_jacobians), .tau_qdd = m};
    assert_int_equal(ambulo_mechanics_jacobians(mechanics, 1, q, qd, qdd, &jacobians), AMBULO_OK);
    lagrangian_energy(model, q, qd, &kinetic, &potential, scratch);
    for (int i = 0; i < n; i++) {
      for (int j = 0; j < n; j++) {
        assert_close(m[i * n + j], m[j * n + i], 1e-12);
        twice += qd[i] * m[i * n + j] * qd[j];
      }
    }
    assert_close(0.5 * twice, kinetic, 1e-12);
    factor(m, n);
  }
  free(scratch);
  ambulo_mechanics_free(mechanics);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(zero_moment_point_is_below_the_center_of_mass),
      cmocka_unit_test(mass_matrix_is_symmetric_positive_and_gives_the_energy),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
