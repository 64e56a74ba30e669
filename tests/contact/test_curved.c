/* Arcs that roll: a foot that does has e = 0, slopes are those of the value, and the centre of
 * pressure is where force and moment have it. */
#include "contact/curved.h"
#include "support/curved_slopes.h"
#include "support/random_model.h"
#include "support/test.h"
#include <string.h>

enum { CHANNELS = 15, CENTER = 0, HEEL = 3, TOE = 6, FORCE = 9, MOMENT = 12 };

static const ambulo__arc level = {.sign = 1.0,
                                  .room = 0.0,
                                  .radius = 0.04,
                                  .length = 0.2,
                                  .forward = {1.0, 0.0, 0.0},
                                  .left = {0.0, 0.0, -1.0},
                                  .up = {0.0, 1.0, 0.0},
                                  .flat = 0.3,
                                  .center = CENTER,
                                  .heel = HEEL,
                                  .toe = TOE,
                                  .force = -1,
                                  .moment = -1};

/* a foot whose toes point up by theta and whose arc has rolled to it from flat */
static void roll(const ambulo__arc *arc, double theta, double *y) {
  memset(y, 0, CHANNELS * sizeof *y);
  y[CENTER] = arc->flat - arc->radius * theta;
  y[CENTER + 1] = arc->radius;
  y[TOE] = y[HEEL] + arc->length * cos(theta);
  y[TOE + 1] = y[HEEL + 1] + arc->length * sin(theta);
}

static void a_rolling_foot_does_not_slip(void **state) {
  (void)state;
  double y[CHANNELS];
  for (double theta = -1.2; theta <= 0.6; theta += 0.1) {
    roll(&level, theta, y);
    assert_close(ambulo__arc_value(&level, y, 1, NULL), 0.0, 1e-15);
    y[CENTER] += 0.001;
    assert_close(ambulo__arc_value(&level, y, 1, NULL), 0.001, 1e-15);
    ambulo__arc other = level;
    other.sign = -1.0;
    other.room = 0.003;
    assert_close(ambulo__arc_value(&other, y, 1, NULL), 0.002, 1e-15);
  }
}

static ambulo__arc random_arc(random_source *random, int pressure) {
  ambulo__arc arc = level;
  double *axes[3] = {arc.forward, arc.left, arc.up};
  for (int i = 0; i < 9; i++) axes[i / 3][i % 3] = random_between(random, -1.0, 1.0);
  arc.sign = random_between(random, -1.0, 1.0) < 0.0 ? -1.0 : 1.0;
  arc.room = random_between(random, 0.0, 0.01);
  arc.along = random_between(random, -1.0, 1.0);
  arc.weight = 700.0;
  if (pressure) {
    arc.force = FORCE;
    arc.moment = MOMENT;
  }
  return arc;
}

/* central differences, also beyond the steepest sine, where asin goes on straight */
static void slopes_are_those_of_the_value(void **state) {
  (void)state;
  random_source random = {17};
  for (int trial = 0; trial < 200; trial++) {
    ambulo__arc arc = random_arc(&random, trial % 2);
    double y[CHANNELS], slope[CHANNELS] = {0.0};
    for (int c = 0; c < CHANNELS; c++) y[c] = random_between(&random, -0.3, 0.3);
    (void)ambulo__arc_value(&arc, y, 1, slope);
    ambulo__curved row = {.form = AMBULO__CURVED_ARC, .of.arc = arc};
    int channel[AMBULO__ARC_CHANNELS], on[CHANNELS] = {0};
    int count = ambulo__arc_channels(&arc, channel);
    for (int i = 0; i < count; i++) on[channel[i]] = 1;
    for (int c = 0; c < CHANNELS; c++) {
      assert_close(slope[c], slope_by_difference(&row, y, c, 1e-6), 1e-8);
      if (slope[c] != 0.0) assert_true(on[c]);
    }
  }
}

/* F at a point d ahead of the centre has, about p, the moment (p_cop - p) x F */
static void pressure_is_where_the_force_acts(void **state) {
  (void)state;
  double y[CHANNELS] = {0.0}, p[3] = {0.1, 0.0, 0.0};
  ambulo__arc arc = level;
  arc.force = FORCE;
  arc.moment = MOMENT;
  arc.room = 0.005;
  arc.along = p[0];
  arc.weight = 700.0;
  y[CENTER] = 0.25;
  y[FORCE] = -60.0;
  y[FORCE + 1] = 500.0;
  for (double d = -0.01; d <= 0.0101; d += 0.005) {
    double r[3] = {y[CENTER] + d - p[0], 0.0, 0.0};
    y[MOMENT + 2] = r[0] * y[FORCE + 1] - r[1] * y[FORCE];
    for (int side = 0; side < 2; side++) {
      arc.sign = side ? -1.0 : 1.0;
      double expected = (0.005 + arc.sign * d) * 500.0 / 700.0;
      assert_close(ambulo__arc_value(&arc, y, 1, NULL), expected, 1e-15);
    }
  }
}

/* channels may stand apart, as they do in the lanes */
static void strides_are_kept(void **state) {
  (void)state;
  double y[CHANNELS], lanes[CHANNELS * 8] = {0.0};
  roll(&level, 0.3, y);
  y[CENTER] += 0.01;
  for (int c = 0; c < CHANNELS; c++) lanes[8 * c] = y[c];
  assert_close(ambulo__arc_value(&level, lanes, 8, NULL), ambulo__arc_value(&level, y, 1, NULL),
               0.0);
}

static int test_arc_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_rolling_foot_does_not_slip),
                                     cmocka_unit_test(slopes_are_those_of_the_value),
                                     cmocka_unit_test(pressure_is_where_the_force_acts),
                                     cmocka_unit_test(strides_are_kept)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* A point and a segment seen from above: their distance, and its slopes, which have no jump where
 * the nearest point comes to an end of the segment. */

enum { TEST_APART_CHANNELS = 9, POINT = 3, FROM = 6, TO = 0 };

/* from (0, 0) to (0.2, 0) along x at a height of 0.3; up is y */
static const ambulo__apart test_apart_level = {
    .up = {0.0, 1.0, 0.0}, .distance = 0.1, .point = POINT, .from = FROM, .to = TO};

static void put(double *y, double x, double height, double z) {
  const double all[TEST_APART_CHANNELS] = {0.2, 0.3, 0.0, x, height, z, 0.0, 0.3, 0.0};
  memcpy(y, all, sizeof all);
}

static double of_distance(double d) {
  return (d * d - 0.01) / 0.2;
}

static void distances_are_to_the_nearest_point_from_above(void **state) {
  (void)state;
  double y[TEST_APART_CHANNELS];
  put(y, 0.1, 0.5, 0.1);
  assert_close(ambulo__apart_value(&test_apart_level, y, 1, NULL), 0.0, 1e-15);
  put(y, 0.05, -2.0, -0.101);
  assert_close(ambulo__apart_value(&test_apart_level, y, 1, NULL), of_distance(0.101), 1e-15);
  assert_close(ambulo__apart_value(&test_apart_level, y, 1, NULL), 0.001,
               1e-5); /* near D: in metres */
  put(y, 0.23, 0.0, 0.04);
  assert_close(ambulo__apart_value(&test_apart_level, y, 1, NULL), of_distance(0.05), 1e-15);
  put(y, -0.06, 0.0, 0.08);
  assert_close(ambulo__apart_value(&test_apart_level, y, 1, NULL), of_distance(0.1), 1e-15);
  put(y, 0.1, 0.3, 0.0);
  assert_close(ambulo__apart_value(&test_apart_level, y, 1, NULL), -0.05, 1e-15);
}

/* a foot on the tip of its toes, its segment upright, is the point where it stands */
static void an_upright_segment_is_a_point(void **state) {
  (void)state;
  double y[TEST_APART_CHANNELS] = {0.0, 0.0, 0.0, 0.03, 0.7, 0.04, 0.0, 0.2, 0.0},
         slope[TEST_APART_CHANNELS] = {0.0};
  assert_close(ambulo__apart_value(&test_apart_level, y, 1, slope), of_distance(0.05), 1e-15);
  for (int c = 0; c < TEST_APART_CHANNELS; c++) assert_true(isfinite(slope[c]));
  assert_close(slope[POINT], 0.3, 1e-15);
}

/* along any vertical, nearest at either end and between them */
static void test_apart_slopes_are_those_of_the_value(void **state) {
  (void)state;
  random_source random = {23};
  for (int trial = 0; trial < 300; trial++) {
    ambulo__apart apart = test_apart_level;
    double y[TEST_APART_CHANNELS], slope[TEST_APART_CHANNELS] = {0.0}, size = 0.0;
    for (int i = 0; i < 3; i++) {
      apart.up[i] = random_between(&random, -1.0, 1.0);
      size += apart.up[i] * apart.up[i];
    }
    for (int i = 0; i < 3; i++) apart.up[i] /= sqrt(size);
    for (int c = 0; c < TEST_APART_CHANNELS; c++) y[c] = random_between(&random, -0.3, 0.3);
    (void)ambulo__apart_value(&apart, y, 1, slope);
    ambulo__curved row = {.form = AMBULO__CURVED_APART, .of.apart = apart};
    for (int c = 0; c < TEST_APART_CHANNELS; c++)
      assert_close(slope[c], slope_by_difference(&row, y, c, 1e-6), 1e-5);
  }
}

static void slopes_have_no_jump_at_the_ends(void **state) {
  (void)state;
  for (int end = 0; end < 2; end++) {
    double y[TEST_APART_CHANNELS], before[TEST_APART_CHANNELS] = {0.0},
                                   after[TEST_APART_CHANNELS] = {0.0};
    put(y, 0.2 * end - 1e-9, 0.0, 0.07);
    (void)ambulo__apart_value(&test_apart_level, y, 1, before);
    put(y, 0.2 * end + 1e-9, 0.0, 0.07);
    (void)ambulo__apart_value(&test_apart_level, y, 1, after);
    for (int c = 0; c < TEST_APART_CHANNELS; c++) assert_close(before[c], after[c], 1e-7);
  }
}

/* channels may stand apart, as they do in the lanes; slopes are added */
static void test_apart_strides_are_kept(void **state) {
  (void)state;
  double y[TEST_APART_CHANNELS], lanes[TEST_APART_CHANNELS * 8] = {0.0},
                                                             slope[TEST_APART_CHANNELS] = {0.0},
                                                             twice[TEST_APART_CHANNELS] = {0.0};
  put(y, 0.13, 0.1, 0.06);
  for (int c = 0; c < TEST_APART_CHANNELS; c++) lanes[8 * c] = y[c];
  assert_close(ambulo__apart_value(&test_apart_level, lanes, 8, slope),
               ambulo__apart_value(&test_apart_level, y, 1, twice), 0.0);
  (void)ambulo__apart_value(&test_apart_level, y, 1, twice);
  for (int c = 0; c < TEST_APART_CHANNELS; c++) assert_close(twice[c], 2.0 * slope[c], 1e-15);
}

static int test_apart_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(distances_are_to_the_nearest_point_from_above),
      cmocka_unit_test(an_upright_segment_is_a_point),
      cmocka_unit_test(test_apart_slopes_are_those_of_the_value),
      cmocka_unit_test(slopes_have_no_jump_at_the_ends),
      cmocka_unit_test(test_apart_strides_are_kept)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The moment about the centre of mass: slopes are those of the value, the world origin may be
 * anywhere, and a force through the centre has none. */

enum { TEST_SPIN_CHANNELS = 12, TEST_SPIN_MOMENT = 0, TEST_SPIN_FORCE = 4, TEST_SPIN_CENTER = 8 };

static ambulo__spin random_spin(random_source *random) {
  ambulo__spin spin = {.bound = 0.01,
                       .weight = 700.0,
                       .moment = TEST_SPIN_MOMENT,
                       .force = TEST_SPIN_FORCE,
                       .center = TEST_SPIN_CENTER};
  spin.sign = random_between(random, -1.0, 1.0) < 0.0 ? -1.0 : 1.0;
  for (int i = 0; i < 3; i++) spin.axis[i] = random_between(random, -1.0, 1.0);
  return spin;
}

static void random_wrench(random_source *random, double *y) {
  for (int c = 0; c < TEST_SPIN_CHANNELS; c++)
    y[c] = random_between(random, -1.0, 1.0) * (c < TEST_SPIN_CENTER ? 700.0 : 1.0);
}

/* the value is quadratic: central differences have no error but rounding */
static void test_spin_slopes_are_those_of_the_value(void **state) {
  (void)state;
  random_source random = {23};
  for (int trial = 0; trial < 200; trial++) {
    ambulo__spin spin = random_spin(&random);
    double y[TEST_SPIN_CHANNELS], slope[TEST_SPIN_CHANNELS] = {0.0};
    random_wrench(&random, y);
    (void)ambulo__spin_value(&spin, y, 1, slope);
    ambulo__curved row = {.form = AMBULO__CURVED_SPIN, .of.spin = spin};
    for (int c = 0; c < TEST_SPIN_CHANNELS; c++)
      assert_close(slope[c], slope_by_difference(&row, y, c, 0.125), 1e-13);
  }
}

/* with d added to every place the moment of the same wrench is d x F more */
static void the_origin_may_be_anywhere(void **state) {
  (void)state;
  random_source random = {5};
  for (int trial = 0; trial < 50; trial++) {
    ambulo__spin spin = random_spin(&random);
    double y[TEST_SPIN_CHANNELS], d[3];
    random_wrench(&random, y);
    double before = ambulo__spin_value(&spin, y, 1, NULL);
    const double *f = y + TEST_SPIN_FORCE;
    for (int i = 0; i < 3; i++) d[i] = random_between(&random, -5.0, 5.0);
    for (int i = 0; i < 3; i++) {
      int j = (i + 1) % 3, k = (i + 2) % 3;
      y[TEST_SPIN_CENTER + i] += d[i];
      y[TEST_SPIN_MOMENT + i] += d[j] * f[k] - d[k] * f[j];
    }
    assert_close(ambulo__spin_value(&spin, y, 1, NULL), before, 1e-12);
  }
}

/* a force of a body weight d ahead of the centre tips the body about left by -d; forward is x, up
 * is y, left is -z */
static void it_is_the_moment_about_the_centre(void **state) {
  (void)state;
  ambulo__spin spin = {.axis = {0.0, 0.0, -1.0},
                       .sign = 1.0,
                       .weight = 700.0,
                       .moment = TEST_SPIN_MOMENT,
                       .force = TEST_SPIN_FORCE,
                       .center = TEST_SPIN_CENTER};
  double lanes[8 * TEST_SPIN_CHANNELS] = {0.0}, y[TEST_SPIN_CHANNELS] = {0.0}, d = 0.03;
  y[TEST_SPIN_CENTER] = 1.2;
  y[TEST_SPIN_CENTER + 1] = 0.9;
  y[TEST_SPIN_FORCE] = 80.0;
  y[TEST_SPIN_FORCE + 1] = 700.0;
  /* r x F, and that of d ahead */
  y[TEST_SPIN_MOMENT + 2] = (y[TEST_SPIN_CENTER] + d) * y[TEST_SPIN_FORCE + 1] -
                            y[TEST_SPIN_CENTER + 1] * y[TEST_SPIN_FORCE];
  assert_close(ambulo__spin_value(&spin, y, 1, NULL), -d, 1e-15);
  spin.sign = -1.0;
  spin.bound = 0.01;
  assert_close(ambulo__spin_value(&spin, y, 1, NULL), 0.01 + d, 1e-15);
  for (int c = 0; c < TEST_SPIN_CHANNELS; c++) lanes[8 * c] = y[c];
  assert_close(ambulo__spin_value(&spin, lanes, 8, NULL), 0.01 + d, 1e-15);
}

static int test_spin_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_spin_slopes_are_those_of_the_value),
                                     cmocka_unit_test(the_origin_may_be_anywhere),
                                     cmocka_unit_test(it_is_the_moment_about_the_centre)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The cone of friction: what it limits, its slopes, and its curvature, tip included. */

enum { TEST_CONE_CHANNELS = 3 };

static ambulo__cone random_cone(random_source *random, double *y) {
  ambulo__cone cone = {
      .friction = random_between(random, 0.1, 1.0), .smoothing = 1e-3, .weight = 700.0, .force = 0};
  double size = 0.0;
  for (int i = 0; i < 3; i++) {
    cone.up[i] = random_between(random, -1.0, 1.0);
    size += cone.up[i] * cone.up[i];
  }
  for (int i = 0; i < 3; i++) {
    cone.up[i] /= sqrt(size);
    y[i] = random_between(random, -500.0, 500.0);
  }
  return cone;
}

static void the_resultant_is_limited(void **state) {
  (void)state;
  const ambulo__cone cone = {
      .up = {0.0, 1.0, 0.0}, .friction = 0.5, .smoothing = 1e-9, .weight = 100.0, .force = 0};
  const double held[3] = {30.0, 100.0, 40.0}, slips[3] = {-48.0, 100.0, 36.0}, none[3] = {0.0};
  assert_close(ambulo__cone_value(&cone, held, 1, NULL), 0.0, 1e-8);
  assert_close(ambulo__cone_value(&cone, slips, 1, NULL), -0.1, 1e-8);
  assert_close(ambulo__cone_value(&cone, none, 1, NULL), 0.0, 1e-15);
}

static void cone_slopes_are_those_of_the_value(void **state) {
  (void)state;
  random_source random = {29};
  for (int trial = 0; trial < 100; trial++) {
    double y[TEST_CONE_CHANNELS], slope[TEST_CONE_CHANNELS] = {0.0};
    ambulo__curved row = {.form = AMBULO__CURVED_CONE, .of.cone = random_cone(&random, y)};
    for (int c = 0; trial % 5 == 0 && c < TEST_CONE_CHANNELS; c++) y[c] *= 1e-3; /* at the tip */
    int channel[AMBULO__CURVED_CHANNELS];
    assert_int_equal(ambulo__curved_channels(&row, channel), 3);
    (void)ambulo__curved_value(&row, y, 1, slope);
    for (int c = 0; c < TEST_CONE_CHANNELS; c++)
      assert_close(slope[c], slope_by_difference(&row, y, c, 1e-4), 1e-9);
  }
}

/* differences of slopes; without drag the two rows span what is level */
static void curvature_is_the_change_of_slopes(void **state) {
  (void)state;
  random_source random = {31};
  for (int trial = 0; trial < 100; trial++) {
    double y[TEST_CONE_CHANNELS], rows[2][3];
    ambulo__cone cone = random_cone(&random, y);
    for (int c = 0; trial % 5 == 0 && c < TEST_CONE_CHANNELS; c++) y[c] *= 1e-3;
    for (int c = 0; trial % 10 == 0 && c < TEST_CONE_CHANNELS; c++) y[c] = 9.0 * cone.up[c];
    if (trial == 0) memset(y, 0, sizeof y);
    ambulo__cone_curvature(&cone, y, 1, rows);
    for (int c = 0; c < TEST_CONE_CHANNELS; c++) {
      double more[3] = {0.0}, less[3] = {0.0}, here = y[c], h = 1e-3;
      y[c] = here + h;
      (void)ambulo__cone_value(&cone, y, 1, more);
      y[c] = here - h;
      (void)ambulo__cone_value(&cone, y, 1, less);
      y[c] = here;
      for (int k = 0; k < 3; k++) {
        double bend = rows[0][c] * rows[0][k] + rows[1][c] * rows[1][k];
        assert_close(bend, -(more[k] - less[k]) / (2.0 * h), 1e-8);
      }
    }
  }
}

static int test_cone_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_resultant_is_limited),
                                     cmocka_unit_test(cone_slopes_are_those_of_the_value),
                                     cmocka_unit_test(curvature_is_the_change_of_slopes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_cone_tests() + test_arc_tests() + test_apart_tests() + test_spin_tests();
}
