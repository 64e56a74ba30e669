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

/* -- curvature of rows -- */

static ambulo__solid two_capsules(void) {
  return (ambulo__solid){.kind = AMBULO__SOLID_MOVING,
                         .other = 6,
                         .about = -1,
                         .distance = 0.1,
                         .weight = {2e-4, 1e-4}};
}

/* second difference of the row's value along `way` */
static double bend_along(const ambulo__solid *solid, const double *y, const double *way) {
  double h = 1e-4, value[3], moved[AMBULO__SOLID_CHANNELS];
  for (int k = 0; k < 3; k++) {
    for (int c = 0; c < AMBULO__SOLID_CHANNELS; c++) moved[c] = y[c] + h * (k - 1) * way[c];
    value[k] = ambulo__solid_value(solid, moved, 1, NULL);
  }
  return -(value[0] - 2.0 * value[1] + value[2]) / (h * h);
}

static double rows_along(const ambulo__solid *solid, const double *y, const double *way,
                         int expected) {
  double rows[2][AMBULO__SOLID_CHANNELS], sum = 0.0;
  int count = ambulo__solid_curvature(solid, y, 1, rows);
  assert_int_equal(count, expected);
  for (int j = 0; j < count; j++) {
    double one = 0.0;
    for (int c = 0; c < AMBULO__SOLID_CHANNELS; c++) one += rows[j][c] * way[c];
    sum += one * one;
  }
  return sum;
}

/* Parallel capsules that turn about their middles: the nearest points run from end to end. The
 * curvature is all in the rows, and large. */
static void parallel_capsules_have_the_curvature_of_their_turning(void **state) {
  (void)state;
  ambulo__solid solid = two_capsules();
  const double y[] = {-0.2, 0.0, 0.1, 0.2, 0.0, 0.1, -0.2, 0.0, 0.0, 0.2, 0.0, 0.0};
  const double turns[3][AMBULO__SOLID_CHANNELS] = {{[2] = -1.0, [5] = 1.0},
                                                   {[8] = -1.0, [11] = 1.0},
                                                   {[2] = -1.0, [5] = 1.0, [8] = 2.0, [11] = -2.0}};
  for (int k = 0; k < 3; k++) {
    double bend = bend_along(&solid, y, turns[k]);
    assert_true(bend > 100.0); /* 1/m */
    assert_close(rows_along(&solid, y, turns[k], 2), bend, 1e-3 * bend);
  }
  const double lift[AMBULO__SOLID_CHANNELS] = {[2] = 1.0, [5] = 1.0};
  assert_close(rows_along(&solid, y, lift, 2), 0.0, 1e-12); /* distance alone has none */
}

/* of a capsule beside one that stands still, and over the face of a box: one row */
static void what_stands_still_has_half_of_it(void **state) {
  (void)state;
  const double y[] = {-0.2, 0.0, 0.1, 0.2, 0.0, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const double turn[AMBULO__SOLID_CHANNELS] = {[2] = -1.0, [5] = 1.0};
  ambulo__solid fixed = two_capsules();
  fixed.kind = AMBULO__SOLID_CAPSULE;
  fixed.ends[0][0] = -0.2;
  fixed.ends[1][0] = 0.2;
  double bend = bend_along(&fixed, y, turn);
  assert_close(rows_along(&fixed, y, turn, 1), bend, 1e-3 * bend);
  ambulo__solid box = {.kind = AMBULO__SOLID_BOX,
                       .about = -1,
                       .distance = 0.05,
                       .weight = {2e-4, 0.0},
                       .half = {1.0, 1.0, 0.05},
                       .axes = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  bend = bend_along(&box, y, turn);
  assert_true(bend > 100.0);
  assert_close(rows_along(&box, y, turn, 1), bend, 1e-3 * bend);
}

/* ends stay the nearest points: nothing runs */
static void ends_have_none(void **state) {
  (void)state;
  ambulo__solid solid = two_capsules();
  const double y[] = {0.3, 0.0, 0.1, 0.6, 0.0, 0.4, -0.2, 0.0, 0.0, 0.2, 0.0, 0.0};
  const double turn[AMBULO__SOLID_CHANNELS] = {[2] = -1.0, [5] = 1.0};
  assert_close(rows_along(&solid, y, turn, 0), 0.0, 0.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_minimum_is_that_of_brute_force),
      cmocka_unit_test(it_bounds_the_distance_on_both_sides),
      cmocka_unit_test(parallel_segments_have_one_nearest_pair),
      cmocka_unit_test(test_segments_slopes_are_those_of_the_value),
      cmocka_unit_test(points_are_segments_too),
      cmocka_unit_test(parallel_capsules_have_the_curvature_of_their_turning),
      cmocka_unit_test(what_stands_still_has_half_of_it),
      cmocka_unit_test(ends_have_none)};
  return cmocka_run_group_tests_name("contact/capsules", tests, NULL, NULL);
}
