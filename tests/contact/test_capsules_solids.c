/* Rows of solids: a little less than the gap, slopes by differences, gaps by hand, strides of
 * lanes. */
#include "contact/curved.h"
#include "support/curved_slopes.h"
#include "support/random_model.h"
#include "support/test.h"
#include <string.h>

/* Rows of capsules: what they keep against the true gap, slopes against differences, near parallel,
 * touching and deep inside; in the lanes. */

enum { TEST_SOLID_CHANNELS = 14, ONE = 1, OTHER = 8 };

static ambulo__solid solid_of(ambulo__solid_kind kind, random_source *random) {
  ambulo__solid s = {.kind = kind, .one = ONE, .other = OTHER, .radius = 0.1, .distance = 0.13};
  double angle = random_between(random, -3.0, 3.0);
  s.weight[0] = ambulo__solid_weight(0.4, 0.05);
  s.weight[1] = kind == AMBULO__SOLID_BOX ? 0.0 : s.weight[0];
  for (int i = 0; i < 6; i++) s.ends[i / 3][i % 3] = random_between(random, -0.3, 0.3);
  for (int i = 0; i < 3; i++) {
    s.center[i] = random_between(random, -0.1, 0.1);
    s.half[i] = random_between(random, 0.05, 0.2);
  }
  s.axes[0][0] = s.axes[1][2] = cos(angle);
  s.axes[0][2] = sin(angle);
  s.axes[1][0] = -sin(angle);
  s.axes[2][1] = 1.0;
  return s;
}

static void test_solid_scatter(random_source *random, double *y) {
  for (int c = 0; c < TEST_SOLID_CHANNELS; c++) y[c] = random_between(random, -0.4, 0.4);
}

/* c >= 0 keeps D; so much more at most */
static void rows_are_a_little_less_than_the_gap(void **state) {
  (void)state;
  random_source random = {2};
  for (int trial = 0; trial < 6000; trial++) {
    double y[TEST_SOLID_CHANNELS];
    ambulo__solid s = solid_of((ambulo__solid_kind)(trial % 3), &random);
    test_solid_scatter(&random, y);
    double value = ambulo__solid_value(&s, y, 1, NULL);
    double gap = ambulo__solid_gap(&s, y, 1) - (s.distance - s.radius);
    double excess = ambulo__solid_excess(&s) / s.distance;
    if (value >= 0.0) assert_true(gap >= value - 1e-5);
    if (gap > 0.0) assert_true(value >= gap - excess - 1e-5);
  }
}

static void test_solid_slopes_are_those_of_the_value(void **state) {
  (void)state;
  random_source random = {6};
  int off = 0;
  for (int trial = 0; trial < 1500; trial++) {
    double y[TEST_SOLID_CHANNELS], slope[TEST_SOLID_CHANNELS] = {0.0};
    ambulo__solid s = solid_of((ambulo__solid_kind)(trial % 3), &random);
    test_solid_scatter(&random, y);
    for (int i = 0; trial % 4 == 0 && i < 3; i++) { /* next to parallel, 2 cm apart */
      y[OTHER + i] = s.ends[0][i] = y[ONE + i] + 0.02 * (i == 0);
      y[OTHER + 3 + i] = s.ends[1][i] = y[ONE + 3 + i] + 0.02 * (i == 0) + 1e-5 * i;
    }
    (void)ambulo__solid_value(&s, y, 1, slope);
    ambulo__curved row = {.form = AMBULO__CURVED_SOLID, .of.solid = s};
    for (int c = 0; c < TEST_SOLID_CHANNELS; c++) {
      double by = slope_by_difference(&row, y, c, 1e-6);
      if (s.kind == AMBULO__SOLID_BOX && fabs(slope[c] - by) > 1e-6)
        off++; /* where two ways out of a box are equally long */
      else
        assert_close(slope[c], by, 2e-6);
    }
  }
  assert_true(off <= 3);
}

/* axes that meet, one on the other: slopes are there, if none */
static void what_crosses_has_finite_slopes(void **state) {
  (void)state;
  random_source random = {8};
  for (int kind = 0; kind < 3; kind++) {
    double y[TEST_SOLID_CHANNELS] = {0.0}, slope[TEST_SOLID_CHANNELS] = {0.0};
    ambulo__solid s = solid_of((ambulo__solid_kind)kind, &random);
    memset(s.ends, 0, sizeof s.ends);
    memset(s.center, 0, sizeof s.center);
    y[ONE] = y[OTHER + 1] = s.ends[0][1] = -0.2;
    y[ONE + 3] = y[OTHER + 4] = s.ends[1][1] = 0.2;
    double value = ambulo__solid_value(&s, y, 1, slope);
    assert_true(value <= -s.distance);
    for (int c = 0; c < TEST_SOLID_CHANNELS; c++) assert_true(isfinite(slope[c]));
    if (kind != AMBULO__SOLID_BOX) continue;
    double size = 0.0; /* the way out of a box */
    for (int c = 0; c < TEST_SOLID_CHANNELS; c++) size += slope[c] * slope[c];
    assert_true(size > 0.4);
  }
}

/* 0.1 from the end cap of a capsule that stands, from the face and from the corner of a box */
static void gaps_by_hand(void **state) {
  (void)state;
  double y[TEST_SOLID_CHANNELS] = {0.0};
  ambulo__solid s = {.kind = AMBULO__SOLID_CAPSULE,
                     .one = ONE,
                     .radius = 0.08,
                     .distance = 0.08,
                     .weight = {1e-6, 1e-6},
                     .ends = {{1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}}};
  y[ONE] = 0.5;
  y[ONE + 3] = 0.82;
  assert_close(ambulo__solid_gap(&s, y, 1), 0.1, 1e-7);
  ambulo__solid box = {.kind = AMBULO__SOLID_BOX,
                       .one = ONE,
                       .radius = 0.05,
                       .distance = 0.05,
                       .weight = {1e-6, 0.0},
                       .center = {1.0, 0.0, 0.0},
                       .axes = {{1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}},
                       .half = {0.2, 0.3, 0.1}};
  y[ONE + 3] = 0.65; /* 0.15 before the face */
  assert_close(ambulo__solid_gap(&box, y, 1), 0.1, 1e-7);
  y[ONE + 3] = 0.9; /* 0.1 behind it */
  assert_close(ambulo__solid_gap(&box, y, 1), -0.15, 1e-6);
  y[ONE] = y[ONE + 3] = 1.2 + 0.03;
  y[ONE + 1] = y[ONE + 4] = 0.1 + 0.04;
  assert_close(ambulo__solid_gap(&box, y, 1), 0.0, 1e-7);
}

static void test_solid_strides_are_kept(void **state) {
  (void)state;
  random_source random = {21};
  for (int kind = 0; kind < 3; kind++) {
    double y[TEST_SOLID_CHANNELS], lanes[TEST_SOLID_CHANNELS * 8] = {0.0},
                                                               slope[TEST_SOLID_CHANNELS] = {0.0},
                                                               twice[TEST_SOLID_CHANNELS] = {0};
    int channel[AMBULO__SOLID_CHANNELS];
    ambulo__solid s = solid_of((ambulo__solid_kind)kind, &random);
    test_solid_scatter(&random, y);
    for (int c = 0; c < TEST_SOLID_CHANNELS; c++) lanes[8 * c] = y[c];
    assert_close(ambulo__solid_value(&s, lanes, 8, slope), ambulo__solid_value(&s, y, 1, twice),
                 0.0);
    (void)ambulo__solid_value(&s, y, 1, twice);
    for (int c = 0; c < TEST_SOLID_CHANNELS; c++) assert_close(twice[c], 2.0 * slope[c], 1e-15);
    int count = ambulo__solid_channels(&s, channel);
    assert_int_equal(count, kind == AMBULO__SOLID_MOVING ? 12 : 6);
    for (int k = 0; k < count; k++) slope[channel[k]] = 0.0;
    for (int c = 0; c < TEST_SOLID_CHANNELS; c++) assert_close(slope[c], 0.0, 0.0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(rows_are_a_little_less_than_the_gap),
                                     cmocka_unit_test(test_solid_slopes_are_those_of_the_value),
                                     cmocka_unit_test(what_crosses_has_finite_slopes),
                                     cmocka_unit_test(gaps_by_hand),
                                     cmocka_unit_test(test_solid_strides_are_kept)};
  return cmocka_run_group_tests_name("contact/capsules_solids", tests, NULL, NULL);
}
