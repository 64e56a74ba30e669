/* Newton's and Euler's laws, from positions alone. The positions of the point masses at seven
 * times give velocities and accelerations by sixth-order central differences:
 *     F = sum m (pdd - g),   M = sum p x m (pdd - g),   qd . tau = d/dt sum (m |pd|^2/2 - m g.p)
 * Both routes of the library, for the spatial recursion also from its positions. */
#include "support/lagrangian_energy.h"
#include "mechanics/lagrangian.h"
#include "identities/point_masses.h"

enum { stencil = 7, middle = 3 };
static const double spacing = 4e-3; /* s: truncation and rounding both near 1e-9 */

typedef struct sample {
  double q[stencil][masses_joints], qd[stencil][masses_joints], qdd[stencil][masses_joints];
  double tau[stencil][masses_joints], wrench[stencil][6], points[stencil][masses_ends][3];
} sample;

static double first_derivative(const double *values, int stride) {
  static const double weight[stencil] = {-1.0 / 60, 3.0 / 20,  -3.0 / 4, 0,
                                         3.0 / 4,   -3.0 / 20, 1.0 / 60};
  double sum = 0.0;
  for (int k = 0; k < stencil; k++) sum += weight[k] * values[k * stride];
  return sum / spacing;
}

static double second_derivative(const double *values, int stride) {
  static const double weight[stencil] = {1.0 / 90, -3.0 / 20, 1.5,     -49.0 / 18,
                                         1.5,      -3.0 / 20, 1.0 / 90};
  double sum = 0.0;
  for (int k = 0; k < stencil; k++) sum += weight[k] * values[k * stride];
  return sum / (spacing * spacing);
}

static void take_sample(const ambulo_model *model, double time, int reference, sample *s) {
  for (int k = 0; k < stencil; k++)
    masses_motion(time + (k - middle) * spacing, s->q[k], s->qd[k], s->qdd[k]);
  if (reference) {
    void *scratch = malloc(ambulo__lagrangian_scratch_size(model));
    for (int k = 0; k < stencil; k++)
      assert_int_equal(ambulo__lagrangian(0, model, s->q[k], s->qd[k], s->qdd[k],
                                          &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                            .tau = s->tau[k],
                                                            .wrench = s->wrench[k],
                                                            .points = &s->points[k][0][0]},
                                          scratch),
                       AMBULO_OK);
    free(scratch);
    return;
  }
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, stencil, &s->q[0][0], &s->qd[0][0], &s->qdd[0][0],
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                         .tau = &s->tau[0][0],
                                         .wrench = &s->wrench[0][0],
                                         .points = &s->points[0][0][0]}),
                   AMBULO_OK);
  ambulo_mechanics_free(mechanics);
}

static void check_wrench(const sample *s) {
  double force[3] = {0}, moment[3] = {0};
  for (int e = 0; e < masses_ends; e++) {
    double pull[3];
    const double *p = s->points[middle][e];
    for (int u = 0; u < 3; u++) {
      double acceleration = second_derivative(&s->points[0][e][u], 3 * masses_ends);
      pull[u] = masses_of_end(e) * (acceleration - masses_gravity[u]);
      force[u] += pull[u];
    }
    for (int u = 0; u < 3; u++) {
      int v = (u + 1) % 3, w = (u + 2) % 3;
      moment[u] += p[v] * pull[w] - p[w] * pull[v];
    }
  }
  for (int u = 0; u < 3; u++) {
    assert_close(s->wrench[middle][u], moment[u], 2e-8);
    assert_close(s->wrench[middle][3 + u], force[u], 2e-8);
  }
}

/* velocities by the same stencil at each of its times would need a longer one; the energy is
 * differentiated as pd . pdd instead: power = sum m pd . (pdd - g) */
static void check_power(const sample *s) {
  double power = 0.0, work = 0.0;
  for (int e = 0; e < masses_ends; e++) {
    for (int u = 0; u < 3; u++) {
      double velocity = first_derivative(&s->points[0][e][u], 3 * masses_ends);
      double acceleration = second_derivative(&s->points[0][e][u], 3 * masses_ends);
      power += masses_of_end(e) * velocity * (acceleration - masses_gravity[u]);
    }
  }
  for (int i = 0; i < masses_joints; i++) work += s->qd[middle][i] * s->tau[middle][i];
  assert_close(work, power, 2e-8);
}

static void check_route(int reference) {
  ambulo_model *model = masses_create();
  sample s;
  for (int k = 0; k < 9; k++) {
    take_sample(model, 0.2 + 0.37 * k, reference, &s);
    check_wrench(&s);
    check_power(&s);
  }
  ambulo_model_free(model);
}

static void laws_hold_for_the_spatial_recursion(void **state) {
  (void)state;
  check_route(0);
}

static void laws_hold_for_the_reference_recursion(void **state) {
  (void)state;
  check_route(1);
}

/* dE/dt = qd . tau, E from lagrangian_energy */
static void energy_function_balances_work(void **state) {
  (void)state;
  ambulo_model *model = masses_create();
  void *scratch = malloc(ambulo__lagrangian_scratch_size(model));
  double q[masses_joints], qd[masses_joints], qdd[masses_joints], tau[masses_joints];
  double energy[stencil];
  for (int at = 0; at < 9; at++) {
    double time = 0.2 + 0.37 * at, work = 0.0;
    for (int k = 0; k < stencil; k++) {
      double kinetic, potential;
      masses_motion(time + (k - middle) * spacing, q, qd, qdd);
      lagrangian_energy(model, q, qd, &kinetic, &potential, scratch);
      assert_true(kinetic > 0.0);
      energy[k] = kinetic + potential;
    }
    masses_motion(time, q, qd, qdd);
    assert_int_equal(
        ambulo__lagrangian(0, model, q, qd, qdd,
                           &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau}, scratch),
        0);
    for (int i = 0; i < masses_joints; i++) work += qd[i] * tau[i];
    assert_close(work, first_derivative(energy, 1), 1e-8);
  }
  free(scratch);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(laws_hold_for_the_spatial_recursion),
      cmocka_unit_test(laws_hold_for_the_reference_recursion),
      cmocka_unit_test(energy_function_balances_work),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
