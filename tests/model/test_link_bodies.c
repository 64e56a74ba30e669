#include "definitions/model_reader.h"
#include "model/model_check.h"
#include "support/messages.h"
#include "support/test.h"

/* two halves of a rod along x make the rod: m L^2 / 12 */
static void halves_make_a_rod(void **state) {
  (void)state;
  ambulo__part whole = {0};
  for (int side = -1; side <= 1; side += 2) {
    ambulo__part half = {.mass = 1.5, .com = {side * 0.5 + 0.2, 0.3, -0.1}};
    half.inertia[1] = half.inertia[2] = 1.5 / 12;
    ambulo__part_add(&whole, &half);
  }
  assert_close(whole.mass, 3, 0);
  assert_close(whole.com[0], 0.2, 1e-15);
  assert_close(whole.com[1], 0.3, 1e-15);
  assert_close(whole.com[2], -0.1, 1e-15);
  assert_close(whole.inertia[0], 0, 1e-15);
  assert_close(whole.inertia[1], 3 * 4 / 12.0, 1e-15);
  assert_close(whole.inertia[2], 3 * 4 / 12.0, 1e-15);
}

/* against the sum over point masses about the common centre, products included */
static void points_make_a_cloud(void **state) {
  (void)state;
  static const double mass[4] = {1, 2, 0.5, 3};
  static const double at[4][3] = {{0, 0, 0}, {0.3, -0.2, 0.7}, {-1, 0.4, 0.1}, {0.2, 0.9, -0.5}};
  ambulo__part whole = {0};
  double total = 0, center[3] = {0}, want[6] = {0};
  for (int i = 0; i < 4; i++) {
    ambulo__part point = {.mass = mass[i], .com = {at[i][0], at[i][1], at[i][2]}};
    ambulo__part_add(&whole, &point);
    total += mass[i];
    for (int k = 0; k < 3; k++) center[k] += mass[i] * at[i][k];
  }
  for (int k = 0; k < 3; k++) center[k] /= total;
  for (int i = 0; i < 4; i++) {
    double x = at[i][0] - center[0], y = at[i][1] - center[1], z = at[i][2] - center[2];
    const double add[6] = {y * y + z * z, x * x + z * z, x * x + y * y, -x * y, -x * z, -y * z};
    for (int k = 0; k < 6; k++) want[k] += mass[i] * add[k];
  }
  assert_close(whole.mass, total, 1e-15);
  for (int k = 0; k < 3; k++) assert_close(whole.com[k], center[k], 1e-14);
  for (int k = 0; k < 6; k++) assert_close(whole.inertia[k], want[k], 1e-14);
}

static int test_composite_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(halves_make_a_rod),
                                     cmocka_unit_test(points_make_a_cloud)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

static ambulo_status check(double mass, const double inertia[6], const char *want) {
  static const double com[3] = {0.1, 0.2, 0.3};
  ambulo__body_places places = {{"t.yaml", 3, 4, NULL}, {"t.yaml", 5, 6, NULL}};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo__check_body("thigh", mass, com, inertia, places, list);
  assert_int_equal(ambulo_diagnostics_count(list), want ? 1 : 0);
  if (want) assert_message(list, 0, want);
  ambulo_diagnostics_free(list);
  return status;
}

static void eigenvalues(void **state) {
  (void)state;
  static const double turned[6] = {2, 3, 4, 1, 0.5, -0.25}, plain[6] = {7, -5, 6, 0, 0, 0};
  double m[3];
  ambulo__principal_moments(plain, m);
  assert_close(m[0], -5, 0);
  assert_close(m[1], 6, 0);
  assert_close(m[2], 7, 0);
  ambulo__principal_moments(turned, m);
  /* invariants: trace, sum of principal minors, determinant */
  assert_close(m[0] + m[1] + m[2], 9, 1e-15);
  assert_close(m[0] * m[1] + m[0] * m[2] + m[1] * m[2], 6 + 8 + 12 - 1 - 0.25 - 0.0625, 1e-14);
  assert_close(m[0] * m[1] * m[2],
               2 * (3 * 4 - 0.0625) - 1 * (1 * 4 + 0.25 * 0.5) + 0.5 * (-0.25 - 3 * 0.5), 1e-14);
  assert_true(m[0] < m[1] && m[1] < m[2]);
}

static void masses(void **state) {
  (void)state;
  static const double good[6] = {1, 1, 1, 0, 0, 0};
  static const double bad[] = {0, -1, 1e-300, 1e300, NAN, INFINITY};
  static const char *const shown[] = {"got 0 kg",      "got -1 kg",  "got 1e-300 kg",
                                      "got 1e+300 kg", "got nan kg", "got inf kg"};
  for (int i = 0; i < 6; i++) assert_int_equal(check(bad[i], good, shown[i]), AMBULO_E_MODEL);
  assert_int_equal(check(0, good, "t.yaml:3:4: error[E_MODEL]: mass of 'thigh' is out of range"),
                   AMBULO_E_MODEL);
  assert_int_equal(check(1e-9, good, NULL), AMBULO_OK);
  assert_int_equal(check(1e6, good, NULL), AMBULO_OK);
}

/* rods, plates and points are limits that exist, also when turned */
static void limits_of_inertia(void **state) {
  (void)state;
  static const double point[6] = {0}, rod[6] = {0, 2, 2, 0, 0, 0}, plate[6] = {1, 2, 3, 0, 0, 0};
  static const double turned_rod[6] = {1, 1, 2, -1, 0, 0};
  assert_int_equal(check(1, point, NULL), AMBULO_OK);
  assert_int_equal(check(1, rod, NULL), AMBULO_OK);
  assert_int_equal(check(1, plate, NULL), AMBULO_OK);
  assert_int_equal(check(1, turned_rod, NULL), AMBULO_OK);
}

static void impossible_inertias(void **state) {
  (void)state;
  static const double negative[6] = {1, 1, 1, 2, 0, 0}, flat[6] = {1, 1, 2.5, 0, 0, 0};
  static const double minus[6] = {-1, -1, -1, 0, 0, 0}, none[6] = {1, NAN, 1, 0, 0, 0};
  assert_int_equal(check(1, negative,
                         "t.yaml:5:6: error[E_MODEL]: inertia of 'thigh' is not positive "
                         "semidefinite (smallest eigenvalue -1 kg m^2)"),
                   AMBULO_E_MODEL);
  assert_int_equal(check(1, minus, "smallest eigenvalue -1"), AMBULO_E_MODEL);
  assert_int_equal(
      check(1, flat, "breaks the triangle inequality (principal moments 1, 1, 2.5 kg m^2)"),
      AMBULO_E_MODEL);
  assert_int_equal(check(1, none, "is out of range"), AMBULO_E_MODEL);
}

static int test_body_check_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(eigenvalues), cmocka_unit_test(masses),
                                     cmocka_unit_test(limits_of_inertia),
                                     cmocka_unit_test(impossible_inertias)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_composite_tests() + test_body_check_tests();
}
