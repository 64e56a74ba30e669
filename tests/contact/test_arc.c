/* Arcs that roll: a foot that does has e = 0, slopes are those of the value, and the centre of
 * pressure is where force and moment have it. */
#include "contact/arc.h"
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_rolling_foot_does_not_slip),
                                     cmocka_unit_test(slopes_are_those_of_the_value),
                                     cmocka_unit_test(pressure_is_where_the_force_acts),
                                     cmocka_unit_test(strides_are_kept)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
