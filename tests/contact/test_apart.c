/* A point and a segment seen from above: their distance, and its slopes, which have no jump where
 * the nearest point comes to an end of the segment. */
#include "contact/apart.h"
#include "support/curved_slopes.h"
#include "support/random_model.h"
#include "support/test.h"

#include <string.h>

enum { CHANNELS = 9, POINT = 3, FROM = 6, TO = 0 };

/* from (0, 0) to (0.2, 0) along x at a height of 0.3; up is y */
static const ambulo__apart level = {
    .up = {0.0, 1.0, 0.0}, .distance = 0.1, .point = POINT, .from = FROM, .to = TO};

static void put(double *y, double x, double height, double z) {
  const double all[CHANNELS] = {0.2, 0.3, 0.0, x, height, z, 0.0, 0.3, 0.0};
  memcpy(y, all, sizeof all);
}

static double of_distance(double d) {
  return (d * d - 0.01) / 0.2;
}

static void distances_are_to_the_nearest_point_from_above(void **state) {
  (void)state;
  double y[CHANNELS];
  put(y, 0.1, 0.5, 0.1);
  assert_close(ambulo__apart_value(&level, y, 1, NULL), 0.0, 1e-15);
  put(y, 0.05, -2.0, -0.101);
  assert_close(ambulo__apart_value(&level, y, 1, NULL), of_distance(0.101), 1e-15);
  assert_close(ambulo__apart_value(&level, y, 1, NULL), 0.001, 1e-5); /* near D: in metres */
  put(y, 0.23, 0.0, 0.04);
  assert_close(ambulo__apart_value(&level, y, 1, NULL), of_distance(0.05), 1e-15);
  put(y, -0.06, 0.0, 0.08);
  assert_close(ambulo__apart_value(&level, y, 1, NULL), of_distance(0.1), 1e-15);
  put(y, 0.1, 0.3, 0.0);
  assert_close(ambulo__apart_value(&level, y, 1, NULL), -0.05, 1e-15);
}

/* a foot on the tip of its toes, its segment upright, is the point where it stands */
static void an_upright_segment_is_a_point(void **state) {
  (void)state;
  double y[CHANNELS] = {0.0, 0.0, 0.0, 0.03, 0.7, 0.04, 0.0, 0.2, 0.0}, slope[CHANNELS] = {0.0};
  assert_close(ambulo__apart_value(&level, y, 1, slope), of_distance(0.05), 1e-15);
  for (int c = 0; c < CHANNELS; c++) assert_true(isfinite(slope[c]));
  assert_close(slope[POINT], 0.3, 1e-15);
}

/* along any vertical, nearest at either end and between them */
static void slopes_are_those_of_the_value(void **state) {
  (void)state;
  random_source random = {23};
  for (int trial = 0; trial < 300; trial++) {
    ambulo__apart apart = level;
    double y[CHANNELS], slope[CHANNELS] = {0.0}, size = 0.0;
    for (int i = 0; i < 3; i++) {
      apart.up[i] = random_between(&random, -1.0, 1.0);
      size += apart.up[i] * apart.up[i];
    }
    for (int i = 0; i < 3; i++) apart.up[i] /= sqrt(size);
    for (int c = 0; c < CHANNELS; c++) y[c] = random_between(&random, -0.3, 0.3);
    (void)ambulo__apart_value(&apart, y, 1, slope);
    ambulo__curved row = {.form = AMBULO__CURVED_APART, .of.apart = apart};
    for (int c = 0; c < CHANNELS; c++)
      assert_close(slope[c], slope_by_difference(&row, y, c, 1e-6), 1e-5);
  }
}

static void slopes_have_no_jump_at_the_ends(void **state) {
  (void)state;
  for (int end = 0; end < 2; end++) {
    double y[CHANNELS], before[CHANNELS] = {0.0}, after[CHANNELS] = {0.0};
    put(y, 0.2 * end - 1e-9, 0.0, 0.07);
    (void)ambulo__apart_value(&level, y, 1, before);
    put(y, 0.2 * end + 1e-9, 0.0, 0.07);
    (void)ambulo__apart_value(&level, y, 1, after);
    for (int c = 0; c < CHANNELS; c++) assert_close(before[c], after[c], 1e-7);
  }
}

/* channels may stand apart, as they do in the lanes; slopes are added */
static void strides_are_kept(void **state) {
  (void)state;
  double y[CHANNELS], lanes[CHANNELS * 8] = {0.0}, slope[CHANNELS] = {0.0}, twice[CHANNELS] = {0.0};
  put(y, 0.13, 0.1, 0.06);
  for (int c = 0; c < CHANNELS; c++) lanes[8 * c] = y[c];
  assert_close(ambulo__apart_value(&level, lanes, 8, slope),
               ambulo__apart_value(&level, y, 1, twice), 0.0);
  (void)ambulo__apart_value(&level, y, 1, twice);
  for (int c = 0; c < CHANNELS; c++) assert_close(twice[c], 2.0 * slope[c], 1e-15);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(distances_are_to_the_nearest_point_from_above),
      cmocka_unit_test(an_upright_segment_is_a_point),
      cmocka_unit_test(slopes_are_those_of_the_value),
      cmocka_unit_test(slopes_have_no_jump_at_the_ends), cmocka_unit_test(strides_are_kept)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
