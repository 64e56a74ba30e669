#include "definitions/model_reader.h"
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(halves_make_a_rod),
                                     cmocka_unit_test(points_make_a_cloud)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
