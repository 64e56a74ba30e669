#include "model/check.h"
#include "support/messages.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(eigenvalues), cmocka_unit_test(masses),
                                     cmocka_unit_test(limits_of_inertia),
                                     cmocka_unit_test(impossible_inertias)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
