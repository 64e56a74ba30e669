/* Sums of squares of a coordinate's torque and motion, against the squares themselves. */
#include "method/joint_squares.h"
#include "support/random_model.h"
#include "support/test.h"

enum { SQUARES = 5, SPAN = 3 };

static double light_of(const ambulo__joint_squares *s, const double y[3]) {
  double sum = 0.0;
  for (int a = 0, at = 0; a < 3; a++) {
    for (int b = 0; b <= a; b++) sum += (a == b ? 1.0 : 2.0) * s->light[at++] * y[a] * y[b];
  }
  return sum;
}

static double value_of(const ambulo__joint_squares *s, const double y[4]) {
  double r = s->tau * y[3];
  for (int o = 0; o < 3; o++) r += s->motion[o] * y[o];
  return r * r + light_of(s, y);
}

/* squares with and without the torque, in any order */
static void turned_squares_have_the_same_sum(void **state) {
  (void)state;
  random_source source = {11};
  for (int trial = 0; trial < 20; trial++) {
    ambulo__joint_squares s = {0.0, {0.0}, {0.0}};
    double slope[SQUARES][4], least = 0.0;
    for (int k = 0; k < SQUARES; k++) {
      for (int o = 0; o < 4; o++) slope[k][o] = random_between(&source, -2.0, 2.0);
      if ((k + trial) % 3 == 0) slope[k][3] = 0.0;
      ambulo__joint_squares_add(&s, slope[k][3], slope[k]);
      least += slope[k][3] * slope[k][3];
    }
    assert_close(s.tau, sqrt(least), 1e-13);
    for (int point = 0; point < 6; point++) {
      double y[4], want = 0.0;
      for (int o = 0; o < 4; o++) y[o] = random_between(&source, -1.0, 1.0);
      for (int k = 0; k < SQUARES; k++) {
        double r = 0.0;
        for (int o = 0; o < 4; o++) r += slope[k][o] * y[o];
        want += r * r;
      }
      assert_close(value_of(&s, y), want, 1e-12);
    }
  }
}

/* the form by control points is that by q, qd and qdd of these control points */
static void control_points_move_the_motion(void **state) {
  (void)state;
  random_source source = {5};
  ambulo__joint_squares s = {0.0, {0.0}, {0.0}};
  ambulo__basis_point point = {.span = SPAN};
  double x[SPAN], y[3] = {0.0}, form[SPAN * (SPAN + 1) / 2];
  assert_int_equal(ambulo__joint_squares_light(&s, &point, form), 0);
  for (int k = 0; k < 4; k++) {
    double slope[4];
    for (int o = 0; o < 4; o++) slope[o] = random_between(&source, -2.0, 2.0);
    ambulo__joint_squares_add(&s, slope[3], slope);
  }
  for (int c = 0; c < SPAN; c++) {
    x[c] = random_between(&source, -1.0, 1.0);
    for (int o = 0; o < 3; o++) {
      point.weight[o][c] = random_between(&source, -1.0, 1.0);
      y[o] += point.weight[o][c] * x[c];
    }
  }
  double by_points = 0.0;
  assert_int_equal(ambulo__joint_squares_light(&s, &point, form), 1);
  for (int c = 0, at = 0; c < SPAN; c++) {
    for (int b = 0; b <= c; b++) by_points += (b == c ? 1.0 : 2.0) * form[at++] * x[b] * x[c];
  }
  assert_close(by_points, light_of(&s, y), 1e-13);
}

static void what_is_no_number_stays_none(void **state) {
  (void)state;
  const double motion[] = {1.0, 0.0, 0.0};
  ambulo__joint_squares s = {2.0, {0.0}, {0.0}};
  ambulo__joint_squares_add(&s, (double)NAN, motion);
  assert_true(isnan(s.tau));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(turned_squares_have_the_same_sum),
                                     cmocka_unit_test(control_points_move_the_motion),
                                     cmocka_unit_test(what_is_no_number_stays_none)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
