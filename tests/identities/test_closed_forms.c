/* Pendulum and two-link arm against the textbook equations, both routes of the library.
 * The arm lies in a vertical plane, angles from the horizontal, gravity g along -y; c_i are the
 * distances from the joints to the centres of mass. */
#include "mechanics/lagrangian.h"
#include "support/arm.h"
#include "support/test.h"

static const double g = 9.81;

typedef struct states {
  double q[2], qd[2], qdd[2];
} states;

static states state_number(int k) {
  states s;
  for (int i = 0; i < 2; i++) {
    s.q[i] = 3.0 * sin(0.8 * k + i);
    s.qd[i] = 5.0 * cos(1.3 * k + 2 * i);
    s.qdd[i] = 20.0 * sin(2.1 * k - i);
  }
  return s;
}

static void torques(const ambulo_model *model, const states *s, int reference, double *tau,
                    double *wrench) {
  if (reference) {
    void *scratch = malloc(ambulo__lagrangian_scratch_size(model));
    assert_int_equal(
        ambulo__lagrangian(
            0, model, s->q, s->qd, s->qdd,
            &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau, .wrench = wrench},
            scratch),
        AMBULO_OK);
    free(scratch);
    return;
  }
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(
          mechanics, 1, s->q, s->qd, s->qdd,
          &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau, .wrench = wrench}),
      AMBULO_OK);
  ambulo_mechanics_free(mechanics);
}

/* tau = (I + m c^2) qdd + m g c cos q */
static void pendulum(void **state) {
  (void)state;
  double m = 2.5, l = 0.8, c = 0.5, inertia = 0.04, tau, wrench[6];
  ambulo_link link = ambulo_link_default();
  link.name = "rod";
  link.type = AMBULO_REVOLUTE;
  link.parent = -1;
  link.a = l;
  link.mass = m;
  link.com[0] = c - l;
  link.inertia[0] = 0.002;
  link.inertia[1] = link.inertia[2] = inertia;
  ambulo_coordinate coordinate = ambulo_coordinate_default();
  coordinate.name = "angle";
  ambulo_model_definition definition = ambulo_model_definition_default();
  definition.name = "pendulum";
  definition.links = &link;
  definition.coordinates = &coordinate;
  definition.link_count = definition.coordinate_count = 1;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_create(&definition, NULL, NULL, &model), AMBULO_OK);
  for (int k = 0; k < 20; k++) {
    states s = state_number(k);
    double want = (inertia + m * c * c) * s.qdd[0] + m * g * c * cos(s.q[0]);
    for (int reference = 0; reference < 2; reference++) {
      torques(model, &s, reference, &tau, wrench);
      assert_close(tau, want, 1e-12);
      assert_close(wrench[2], want, 1e-12);
    }
  }
  ambulo_model_free(model);
}

static void two_link_arm(void **state) {
  (void)state;
  const double m1 = 2.0, m2 = 1.5, l1 = 0.3, c1 = 0.3 - 0.16, c2 = 0.25 - 0.12, inertia = 0.016;
  ambulo_model *model = arm_create();
  assert_non_null(model);
  for (int k = 0; k < 20; k++) {
    states s = state_number(k);
    double bend = cos(s.q[1]), h = m2 * l1 * c2 * sin(s.q[1]);
    double m11 = 2 * inertia + m1 * c1 * c1 + m2 * (l1 * l1 + c2 * c2 + 2 * l1 * c2 * bend);
    double m12 = inertia + m2 * (c2 * c2 + l1 * c2 * bend), m22 = inertia + m2 * c2 * c2;
    double fall = m2 * g * c2 * cos(s.q[0] + s.q[1]);
    double want[2], tau[2];
    want[0] = m11 * s.qdd[0] + m12 * s.qdd[1] - h * (2 * s.qd[0] + s.qd[1]) * s.qd[1] +
              (m1 * c1 + m2 * l1) * g * cos(s.q[0]) + fall;
    want[1] = m12 * s.qdd[0] + m22 * s.qdd[1] + h * s.qd[0] * s.qd[0] + fall;
    for (int reference = 0; reference < 2; reference++) {
      torques(model, &s, reference, tau, NULL);
      assert_close(tau[0], want[0], 1e-12);
      assert_close(tau[1], want[1], 1e-12);
    }
  }
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pendulum),
      cmocka_unit_test(two_link_arm),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
