/* A segment and a box: the smoothed distance against brute force, the depth inside, slopes by
 * differences. */
#include "contact/curved.h"
#include "support/curved_slopes.h"
#include "support/random_model.h"
#include "support/test.h"
#include <string.h>

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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_segment_box_the_minimum_is_that_of_brute_force),
      cmocka_unit_test(the_depth_is_the_shortest_way_out),
      cmocka_unit_test(touching_is_neither_out_nor_in),
      cmocka_unit_test(slopes_are_those_of_the_values)};
  return cmocka_run_group_tests_name("contact/capsules_boxes", tests, NULL, NULL);
}
