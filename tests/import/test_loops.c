/* Four-bars of MuJoCo models: joints of a closed loop become functions of the motor's.
 *
 * In the plane of x and z: pivots A = (0, 0) and D = (0.3, 0) m, a crank from A to B = 0.1 (sin a,
 * cos a), a rocker from D to C = D + 0.2 (sin r, cos r), a coupler from B to C; a = r = 0 in the
 * file. Masses 1, 2 and 0.5 kg in the middle of each. */
#include "support/import_case.h"

#define BAR(name, at, length, motion, mass, inside)                                                \
  "<body name='" name "' pos='" at "'><joint name='" name "' axis='0 1 0' " motion "/>"            \
  "<inertial pos='" length "' mass='" mass "' diaginertia='.001 .001 .001'/>" inside "</body>"

#define FOUR_BAR(crank, rocker, motors)                                                            \
  "<mujoco><compiler angle='radian'/><worldbody>" BAR(                                             \
      "crank", "0 0 0", "0 0 .05", crank, "1",                                                     \
      BAR("coupler", "0 0 .1", ".15 0 .05", "", ".5", ""))                                         \
      BAR("rocker", ".3 0 0", "0 0 .1", rocker, "2",                                               \
          "") "</worldbody><equality><connect body1='rocker' body2='coupler' anchor='0 0 "         \
              ".2'/></equality>"                                                                   \
              "<actuator>" motors "</actuator></mujoco>"

/* r(a): the side of the rocker on which it stands in the file */
static double rocker_of(double a) {
  double x = 0.3 - 0.1 * sin(a), z = -0.1 * cos(a), coupler = 0.1;
  double k = (coupler - x * x - z * z - 0.04) / (0.4 * hypot(x, z));
  return atan2(x, z) - acos(k);
}

static double height_energy(double a) {
  double b = 0.1 * cos(a), c = 0.2 * cos(rocker_of(a));
  return 9.81 * (0.5 * b + 0.5 * 0.5 * (b + c) + 2.0 * 0.5 * c);
}

static double torque_at(const ambulo_model *model, double q, double qd, double qdd) {
  ambulo_mechanics *mechanics = NULL;
  double tau = 0.0;
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, 1, &q, &qd, &qdd,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = &tau}),
                   AMBULO_OK);
  ambulo_mechanics_free(mechanics);
  return tau;
}

/* tau of the crank at rest is the slope of the potential energy along the closed loop */
static void a_four_bar_follows_its_motor(void **state) {
  import_case c = import_good(state, FOUR_BAR("range='-2 2'", "", "<motor joint='crank'/>"));
  assert_int_equal(ambulo_model_coordinate_count(c.model), 1);
  assert_close(rocker_of(0.0), 0.0, 1e-12);
  for (double a = -1.9; a < 2.0; a += 0.17) {
    double h = 1e-4, slope = (height_energy(a + h) - height_energy(a - h)) / (2.0 * h);
    assert_true(fabs(torque_at(c.model, a, 0.0, 0.0) - slope) < 2e-5 * 9.81);
  }
  import_shut(&c);
}

/* tau a' = d/dt (T + V): rods do no work, whatever the motion; T = m(a) a'^2 / 2 */
static void closing_forces_do_no_work(void **state) {
  import_case c = import_good(state, FOUR_BAR("range='-2 2'", "", "<motor joint='crank'/>"));
  for (double a = -1.5; a < 1.6; a += 0.5) {
    double h = 1e-5, rate = 3.0, rest = torque_at(c.model, a, 0.0, 0.0);
    double mass[2], middle = torque_at(c.model, a, 0.0, 1.0) - rest;
    for (int side = 0; side < 2; side++) {
      double at = a + (side ? h : -h);
      mass[side] = torque_at(c.model, at, 0.0, 1.0) - torque_at(c.model, at, 0.0, 0.0);
    }
    assert_true(middle > 0.0);
    double want = rest + 0.5 * (mass[1] - mass[0]) / (2.0 * h) * rate * rate;
    assert_true(fabs(torque_at(c.model, a, rate, 0.0) - want) < 1e-6);
  }
  import_shut(&c);
}

/* |B C| = 0.3162 at most, so that a rocker that is driven does not turn round */
static void a_motor_goes_as_far_as_the_loop(void **state) {
  import_case c = import_good(state, FOUR_BAR("", "range='-3 3'", "<motor joint='rocker'/>"));
  assert_int_equal(ambulo_model_coordinate_count(c.model), 1);
  assert_told(&c, "the loop that 'rocker' drives closes from ");
  const double *range = ambulo_model_coordinate(c.model, 0)->range;
  for (int end = 0; end < 2; end++) {
    double x = 0.3 + 0.2 * sin(range[end]), z = 0.2 * cos(range[end]), far = hypot(x, z);
    assert_true(far < sqrt(0.1) + 0.1 && far > sqrt(0.1) - 0.1);
  }
  assert_true(range[0] > -3.0 && range[1] < 3.0 && range[1] - range[0] > 0.5);
  import_shut(&c);
}

static void loops_that_stay_open(void **state) {
  static const struct {
    const char *xml, *message;
  } cases[] = {
      {FOUR_BAR("range='-2 2'", "", "<motor joint='crank'/><motor joint='rocker'/>"),
       "the loop between rocker and coupler stays open: more than one motor drives it"},
      {FOUR_BAR("range='-2 2'", "", ""), "stays open: no motor drives it"},
      {FOUR_BAR("", "", "<motor joint='crank'/>"), "stays open: its motor has no range"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    import_case c = import_good(state, cases[i].xml);
    assert_told(&c, cases[i].message);
    assert_int_equal(ambulo_model_coordinate_count(c.model), 3);
    import_shut(&c);
  }
}

/* a spring beside the motor's loop is rigid */
static void springs_are_held(void **state) {
  import_case c =
      import_good(state, FOUR_BAR("range='-.1 .1'", "stiffness='900'", "<motor joint='crank'/>"));
  assert_told(&c, "stays open");
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_four_bar_follows_its_motor), cmocka_unit_test(closing_forces_do_no_work),
      cmocka_unit_test(a_motor_goes_as_far_as_the_loop), cmocka_unit_test(loops_that_stay_open),
      cmocka_unit_test(springs_are_held)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
