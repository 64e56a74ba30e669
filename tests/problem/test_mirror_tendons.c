/* Tendons on the two sides of lower_body_18 with mirrored ends. */
#include "mirror_fixture.h"

static void tendons_are_alike(void **state) {
  (void)state;
  for (int k = 0; k < 3; k++) {
    fixture f;
    double tendon[D] = {0.0};
    open_fixture(&f, 1, AMBULO_MECHANICAL_POWER);
    tendon[KNEE_R] = 300.0;
    if (k == 0) tendon[KNEE_L] = 300.0;
    if (k == 2) tendon[KNEE_L] = 250.0;
    f.terms[0].tendon = tendon;
    expect(&f, k == 0   ? NULL
               : k == 1 ? "the tendon of 'knee_angle_r' is 300 N m/rad, that of its mirror partner "
                          "'knee_angle_l' 0 N m/rad; expected the same"
                        : "'knee_angle_l' 250 N m/rad");
  }
}

/* power at the nodes on one side, of intervals on the other */
static void both_sides_are_at_nodes_or_between(void **state) {
  (void)state;
  for (int k = 0; k < 2; k++) {
    fixture f;
    const double none[D] = {0.0};
    open_fixture(&f, 2, AMBULO_MECHANICAL_POWER);
    for (int i = 0; i < D; i++) {
      f.scale[0][i] = i >= HIP_R && i < HIP_R + 6 ? 0.01 : 0.0;
      f.scale[1][i] = i >= HIP_R + 6 ? 0.01 : 0.0;
    }
    f.terms[0].tendon = none;
    if (k == 0) f.terms[1].tendon = none;
    expect(&f,
           k ? "of 'hip_flexion_r' is 0.01, that of its mirror partner 'hip_flexion_l' 0;" : NULL);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(tendons_are_alike),
                                     cmocka_unit_test(both_sides_are_at_nodes_or_between)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
