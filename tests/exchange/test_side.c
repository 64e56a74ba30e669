#include "exchange/side.h"
#include "support/test.h"

static void sides(void **state) {
  (void)state;
  static const struct {
    const char *name;
    char side;
    const char *other;
  } cases[] = {{"hip_l", 'l', "hip_r"},
               {"R_knee", 'r', "L_knee"},
               {"left_foot", 'l', "right_foot"},
               {"RightFoot", 'r', "LeftFoot"},
               {"ANKLE_LEFT", 'l', "ANKLE_RIGHT"},
               {"LHip", 'l', "RHip"},
               {"FL_hip", 'l', "FR_hip"},
               {"knee_angle_r_beta", 'r', "knee_angle_l_beta"},
               {"Lever", 0, NULL},
               {"trunk", 0, NULL},
               {"roll", 0, NULL},
               {"lfemur", 0, NULL},
               {"", 0, NULL}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    char text[40] = "";
    assert_int_equal(ambulo__side_of(cases[i].name), cases[i].side);
    assert_int_equal(ambulo__other_side(cases[i].name, text, sizeof text), cases[i].side != 0);
    if (cases[i].other) assert_string_equal(text, cases[i].other);
  }
}

static void letters(void **state) {
  (void)state;
  char text[8] = "";
  assert_int_equal(ambulo__flip_letter("LLEG_R", 0, text, sizeof text), 1);
  assert_string_equal(text, "RLEG_R");
  assert_int_equal(ambulo__flip_letter("LLEG_R", 2, text, sizeof text), 0);
  assert_int_equal(ambulo__flip_letter("LLEG_R", 6, text, sizeof text), 0);   /* its end */
  assert_int_equal(ambulo__flip_letter("LLEG_RRR", 0, text, sizeof text), 0); /* no room */
  assert_int_equal(ambulo__other_side("left_1", text, sizeof text), 1);
  assert_int_equal(ambulo__other_side("left_12", text, sizeof text), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(sides), cmocka_unit_test(letters)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
