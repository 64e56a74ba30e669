/* Two segments: the smoothed distance against brute force over both, against the true distance, its
 * slopes against differences; parallel, crossing and touching segments, and points. */
#include "contact/curved.h"
#include "support/curved_slopes.h"
#include "support/random_model.h"
#include "support/test.h"
#include <string.h>

enum { GRID = 200 };

static void scatter(random_source *random, double ends[2][3]) {
  for (int i = 0; i < 6; i++) ends[i / 3][i % 3] = random_between(random, -0.4, 0.4);
}

static double value_at(double one[2][3], double other[2][3], const double weight[2], double s,
                       double t) {
  double sum = weight[0] * (s - 0.5) * (s - 0.5) + weight[1] * (t - 0.5) * (t - 0.5);
  for (int i = 0; i < 3; i++) {
    double e =
        one[0][i] + s * (one[1][i] - one[0][i]) - other[0][i] - t * (other[1][i] - other[0][i]);
    sum += e * e;
  }
  return sum;
}

/* the least of a grid, and of finer ones about it */
static double brute_force(double one[2][3], double other[2][3], const double weight[2]) {
  double s = 0.5, t = 0.5, width = 0.5, best = INFINITY;
  for (int round = 0; round < 8; round++, width *= 0.05) {
    double from[2] = {s, t};
    for (int i = -GRID / 2; i <= GRID / 2; i++) {
      for (int j = -GRID / 2; j <= GRID / 2; j++) {
        double a = fmin(1.0, fmax(0.0, from[0] + 2.0 * width * i / GRID));
        double b = fmin(1.0, fmax(0.0, from[1] + 2.0 * width * j / GRID));
        double value = value_at(one, other, weight, a, b);
        if (value >= best) continue;
        best = value;
        s = a;
        t = b;
      }
    }
  }
  return best;
}

static void the_minimum_is_that_of_brute_force(void **state) {
  (void)state;
  random_source random = {5};
  static const double weights[3][2] = {{2e-4, 1e-4}, {1e-2, 2e-2}, {1.0, 1e-3}};
  for (int trial = 0; trial < 60; trial++) {
    double one[2][3], other[2][3];
    const double *weight = weights[trial % 3];
    scatter(&random, one);
    scatter(&random, other);
    ambulo__segment_nearest n = ambulo__segments_nearest(one, other, weight);
    assert_close(n.value, brute_force(one, other, weight), 1e-9);
    assert_close(n.value, value_at(one, other, weight, n.at[0], n.at[1]), 1e-15);
    assert_true(n.at[0] >= 0.0 && n.at[0] <= 1.0 && n.at[1] >= 0.0 && n.at[1] <= 1.0);
  }
}

/* d^2 <= V and V - (w + v) / 4 <= d^2 */
static void it_bounds_the_distance_on_both_sides(void **state) {
  (void)state;
  random_source random = {11};
  static const double weight[2] = {3e-3, 2e-3}, none[2] = {1e-12, 1e-12};
  for (int trial = 0; trial < 3000; trial++) {
    double one[2][3], other[2][3];
    scatter(&random, one);
    scatter(&random, other);
    double square = ambulo__segments_nearest(one, other, none).value;
    double value = ambulo__segments_nearest(one, other, weight).value;
    assert_true(square <= value + 1e-12);
    assert_true(value - 0.25 * (weight[0] + weight[1]) <= square + 1e-12);
  }
}

/* turned from one side of parallel to the other the nearest points run along both, without a jump:
 * from one microradian to the next they move by less than 2e-4 of their lengths */
static void parallel_segments_have_one_nearest_pair(void **state) {
  (void)state;
  static const double weight[2] = {2e-4, 2e-4};
  double other[2][3] = {{-0.2, 0.1, 0.0}, {0.2, 0.1, 0.0}}, last = NAN, first = NAN;
  for (int k = -100000; k <= 100000; k++) {
    double angle = 1e-6 * k;
    double one[2][3] = {{-0.2 * cos(angle), -0.2 * sin(angle), 0.0},
                        {0.2 * cos(angle), 0.2 * sin(angle), 0.0}};
    ambulo__segment_nearest n = ambulo__segments_nearest(one, other, weight);
    if (k > -100000) assert_true(fabs(n.at[0] - last) < 2e-4);
    if (k == -100000) first = n.at[0];
    if (k == 0) assert_close(n.at[0], 0.5, 1e-9);
    if (k == 0) assert_close(n.value, 0.01, 1e-12);
    last = n.at[0];
  }
  assert_true(first < 0.05 && last > 0.95);
}

static double difference(double one[2][3], double other[2][3], const double weight[2], double *x) {
  const double here = *x, h = 1e-6;
  *x = here + h;
  double more = ambulo__segments_nearest(one, other, weight).value;
  *x = here - h;
  double less = ambulo__segments_nearest(one, other, weight).value;
  *x = here;
  return (more - less) / (2.0 * h);
}

/* e by the shares of both ends; some trials next to parallel, some crossing */
static void test_segments_slopes_are_those_of_the_value(void **state) {
  (void)state;
  random_source random = {29};
  static const double weight[2] = {2e-4, 1e-4};
  for (int trial = 0; trial < 500; trial++) {
    double one[2][3], other[2][3];
    scatter(&random, one);
    scatter(&random, other);
    for (int i = 0; trial % 5 == 0 && i < 3; i++) {
      other[0][i] = one[0][i] + 0.05 * (i == 1);
      other[1][i] = one[1][i] + 0.05 * (i == 1) + 1e-4 * random_between(&random, -1.0, 1.0);
    }
    for (int i = 0; trial % 5 == 1 && i < 3; i++)
      other[1][i] = one[0][i] + one[1][i] - other[0][i]; /* they meet in their middles */
    ambulo__segment_nearest n = ambulo__segments_nearest(one, other, weight);
    for (int i = 0; i < 6; i++) {
      double share = i / 3 ? n.at[0] : 1.0 - n.at[0], back = i / 3 ? n.at[1] : 1.0 - n.at[1];
      assert_close(2.0 * share * n.e[i % 3], difference(one, other, weight, &one[i / 3][i % 3]),
                   1e-8);
      assert_close(-2.0 * back * n.e[i % 3], difference(one, other, weight, &other[i / 3][i % 3]),
                   1e-8);
    }
  }
}

static void points_are_segments_too(void **state) {
  (void)state;
  static const double weight[2] = {1e-6, 1e-6};
  double point[2][3] = {{0.3, 0.0, 0.4}, {0.3, 0.0, 0.4}}, origin[2][3] = {{0.0}};
  double line[2][3] = {{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  assert_close(ambulo__segments_nearest(point, origin, weight).value, 0.25, 1e-12);
  ambulo__segment_nearest n = ambulo__segments_nearest(point, line, weight);
  assert_close(n.value, 0.16, 1e-6);
  assert_close(n.at[1], 0.65, 1e-6);
  double touching[2][3] = {{0.65, 0.0, 0.0}, {0.7, 0.3, 0.0}};
  assert_true(ambulo__segments_nearest(touching, line, weight).value < 1e-6);
}

static int test_segments_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_minimum_is_that_of_brute_force),
                                     cmocka_unit_test(it_bounds_the_distance_on_both_sides),
                                     cmocka_unit_test(parallel_segments_have_one_nearest_pair),
                                     cmocka_unit_test(test_segments_slopes_are_those_of_the_value),
                                     cmocka_unit_test(points_are_segments_too)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* A segment and a box: distance outside against brute force, depth inside against all directions,
 * one passing into the other without a jump, and the slopes of both. */

static void test_segment_box_scatter(random_source *random, double ends[2][3], double half[3],
                                     double size) {
  for (int i = 0; i < 6; i++) ends[i / 3][i % 3] = random_between(random, -size, size);
  for (int i = 0; i < 3; i++) half[i] = random_between(random, 0.05, 0.3);
}

static double test_segment_box_value_at(double ends[2][3], const double half[3], double weight,
                                        double s) {
  double sum = weight * (s - 0.5) * (s - 0.5);
  for (int k = 0; k < 3; k++) {
    double x = ends[0][k] + s * (ends[1][k] - ends[0][k]);
    double o = fmax(0.0, fabs(x) - half[k]);
    sum += o * o;
  }
  return sum;
}

static double test_segment_box_brute_force(double ends[2][3], const double half[3], double weight) {
  double best = INFINITY, s = 0.5, width = 0.5;
  for (int round = 0; round < 5; round++, width *= 0.01) {
    double middle = s;
    for (int i = -500; i <= 500; i++) {
      double at = fmin(1.0, fmax(0.0, middle + width * i / 500.0));
      double value = test_segment_box_value_at(ends, half, weight, at);
      if (value < best) {
        best = value;
        s = at;
      }
    }
  }
  return best;
}

static void test_segment_box_the_minimum_is_that_of_brute_force(void **state) {
  (void)state;
  random_source random = {3};
  for (int trial = 0; trial < 1000; trial++) {
    double ends[2][3], half[3], weight = trial % 2 ? 1e-4 : 1e-2;
    test_segment_box_scatter(&random, ends, half, trial % 3 ? 0.6 : 0.3);
    if (trial % 7 == 0) ends[1][1] = ends[0][1]; /* along a face */
    if (trial % 7 == 0) ends[1][2] = ends[0][2];
    ambulo__box_nearest n = ambulo__box_nearest_of(ends, half, weight);
    assert_close(n.value, test_segment_box_brute_force(ends, half, weight), 1e-11);
    assert_close(n.value, test_segment_box_value_at(ends, half, weight, n.at), 1e-15);
  }
}

/* how far the segment has to move along n to be outside */
static double overlap(double ends[2][3], const double half[3], const double n[3]) {
  double reach = 0.0, low = INFINITY;
  for (int end = 0; end < 2; end++) {
    double along = 0.0;
    for (int i = 0; i < 3; i++) along += n[i] * ends[end][i];
    low = fmin(low, along);
  }
  for (int i = 0; i < 3; i++) reach += half[i] * fabs(n[i]);
  return reach - low;
}

/* no direction is shorter, and one about the way out is hardly longer */
static void the_depth_is_the_shortest_way_out(void **state) {
  (void)state;
  random_source random = {17};
  int inside = 0, over_edges = 0;
  for (int trial = 0; trial < 400; trial++) {
    double ends[2][3], half[3], out[3] = {0.0}, share[2], best = INFINITY;
    test_segment_box_scatter(&random, ends, half, 0.35);
    double depth = ambulo__box_depth(ends, half, out, share);
    for (int k = 0; k < 4000; k++) {
      double n[3], size = 0.0, about = k % 2 && depth > 0.0 ? 0.02 : 100.0;
      for (int i = 0; i < 3; i++) n[i] = out[i] + about * random_between(&random, -1.0, 1.0);
      for (int i = 0; i < 3; i++) size += n[i] * n[i];
      for (int i = 0; i < 3; i++) n[i] /= sqrt(size);
      best = fmin(best, overlap(ends, half, n));
    }
    if (best < -1e-3) assert_close(depth, 0.0, 0.0);
    if (depth == 0.0) {
      assert_true(test_segment_box_value_at(ends, half, 0.0,
                                            ambulo__box_nearest_of(ends, half, 1e-9).at) >= 0.0);
      continue;
    }
    inside++;
    over_edges += out[0] * out[0] < 0.99 && out[1] * out[1] < 0.99 && out[2] * out[2] < 0.99;
    assert_true(depth <= best + 1e-12);
    assert_true(best <= depth + 0.02);
    assert_close(overlap(ends, half, out), depth, 1e-12);
    assert_close(test_segment_box_brute_force(ends, half, 0.0), 0.0, 1e-6);
  }
  assert_true(inside > 80 && over_edges > 5);
}

/* on a way straight through the box: outside less inside moves by no more than the segment does */
static void touching_is_neither_out_nor_in(void **state) {
  (void)state;
  random_source random = {41};
  for (int trial = 0; trial < 200; trial++) {
    double ends[2][3], half[3], way[3], last = NAN, step = 1e-3, size = 0.0;
    test_segment_box_scatter(&random, ends, half, 0.4);
    for (int i = 0; i < 3; i++) way[i] = random_between(&random, -1.0, 1.0);
    for (int i = 0; i < 3; i++) size += way[i] * way[i];
    for (int i = 0; i < 6; i++) ends[i / 3][i % 3] -= way[i % 3] / sqrt(size);
    for (int k = 0; k < 2000; k++) {
      double out[3], share[2];
      for (int i = 0; i < 6; i++) ends[i / 3][i % 3] += step * way[i % 3] / sqrt(size);
      double now = sqrt(ambulo__box_nearest_of(ends, half, 1e-14).value) -
                   ambulo__box_depth(ends, half, out, share);
      if (k) assert_true(fabs(now - last) <= step * (1.0 + 1e-6) + 1e-6);
      last = now;
    }
  }
}

static double depth_difference(double ends[2][3], const double half[3], int k) {
  const double here = ends[k / 3][k % 3], h = 1e-6;
  double out[3], share[2];
  ends[k / 3][k % 3] = here + h;
  double more = ambulo__box_depth(ends, half, out, share);
  ends[k / 3][k % 3] = here - h;
  double less = ambulo__box_depth(ends, half, out, share);
  ends[k / 3][k % 3] = here;
  return (more - less) / (2.0 * h);
}

static double value_difference(double ends[2][3], const double half[3], double weight, int k) {
  const double here = ends[k / 3][k % 3], h = 1e-6;
  ends[k / 3][k % 3] = here + h;
  double more = ambulo__box_nearest_of(ends, half, weight).value;
  ends[k / 3][k % 3] = here - h;
  double less = ambulo__box_nearest_of(ends, half, weight).value;
  ends[k / 3][k % 3] = here;
  return (more - less) / (2.0 * h);
}

static void slopes_are_those_of_the_values(void **state) {
  (void)state;
  random_source random = {7};
  int inside = 0, jumps = 0;
  for (int trial = 0; trial < 1000; trial++) {
    double ends[2][3], half[3], out[3], share[2];
    test_segment_box_scatter(&random, ends, half, 0.4);
    ambulo__box_nearest n = ambulo__box_nearest_of(ends, half, 1e-3);
    double depth = ambulo__box_depth(ends, half, out, share);
    inside += depth > 0.0;
    for (int k = 0; k < 6; k++) {
      double part = k / 3 ? n.at : 1.0 - n.at;
      assert_close(2.0 * part * n.o[k % 3], value_difference(ends, half, 1e-3, k), 1e-8);
      if (depth < 1e-5) continue;
      jumps += fabs(-share[k / 3] * out[k % 3] - depth_difference(ends, half, k)) > 1e-7;
    }
  }
  assert_true(inside > 200);
  assert_true(jumps <= 2); /* two ways out that are equally long within 1e-6 m */
}

static int test_segment_box_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_segment_box_the_minimum_is_that_of_brute_force),
      cmocka_unit_test(the_depth_is_the_shortest_way_out),
      cmocka_unit_test(touching_is_neither_out_nor_in),
      cmocka_unit_test(slopes_are_those_of_the_values)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

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

static void slopes_by_place_are_those_of_the_value(void **state) {
  (void)state;
  random_source random = {13};
  for (int trial = 0; trial < 200; trial++) {
    double y[TEST_SOLID_CHANNELS], by_place[2][3];
    ambulo__solid s = solid_of(trial % 2 ? AMBULO__SOLID_CAPSULE : AMBULO__SOLID_BOX, &random);
    test_solid_scatter(&random, y);
    y[ONE + 1] += 0.8; /* outside */
    y[ONE + 4] += 0.8;
    ambulo__solid_by_place(&s, y, 1, by_place);
    for (int k = 0; k < 6; k++) {
      double *place = s.kind == AMBULO__SOLID_BOX ? &s.center[k % 3] : &s.ends[k / 3][k % 3];
      if (s.kind == AMBULO__SOLID_BOX && k > 2) {
        assert_close(by_place[1][k % 3], 0.0, 0.0);
        continue;
      }
      double here = *place, value[2];
      for (int side = 0; side < 2; side++) {
        *place = here + (side ? 1e-6 : -1e-6);
        value[side] = ambulo__solid_value(&s, y, 1, NULL);
      }
      *place = here;
      assert_close(by_place[k / 3][k % 3], (value[1] - value[0]) / 2e-6, 1e-8);
    }
  }
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

static int test_solid_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(rows_are_a_little_less_than_the_gap),
                                     cmocka_unit_test(test_solid_slopes_are_those_of_the_value),
                                     cmocka_unit_test(what_crosses_has_finite_slopes),
                                     cmocka_unit_test(gaps_by_hand),
                                     cmocka_unit_test(slopes_by_place_are_those_of_the_value),
                                     cmocka_unit_test(test_solid_strides_are_kept)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_segments_tests() + test_segment_box_tests() + test_solid_tests();
}
