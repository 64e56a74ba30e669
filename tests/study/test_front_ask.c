/* Fronts that are known: their points are found even, and what weights cannot reach is told. */
#include "support/known_front.h"

/* a quarter of a circle, its corner towards less of both */
static void circle(double s, double *value, double *rest) {
  value[0] = 1.0 - cos(s * acos(0.0));
  value[1] = 1.0 - sin(s * acos(0.0));
  *rest = 0.0;
}

/* J_1 = 1 / J_0 over two decades: nearly a corner */
static void corner(double s, double *value, double *rest) {
  value[0] = pow(100.0, s);
  value[1] = 1.0 / value[0];
  *rest = 0.0;
}

/* convex where s < 0.5, not convex beyond */
static void wave(double s, double *value, double *rest) {
  value[0] = s;
  value[1] = 1.0 - s - 0.1 * sin(2.0 * acos(-1.0) * s);
  *rest = 0.0;
}

static void straight(double s, double *value, double *rest) {
  value[0] = s;
  value[1] = 1.0 - s;
  *rest = 0.0;
}

/* the other terms have their least somewhere between */
static void with_rest(double s, double *value, double *rest) {
  circle(s, value, rest);
  *rest = 0.4 * (s - 0.3) * (s - 0.3);
}

static void one_is_best(double s, double *value, double *rest) {
  value[0] = value[1] = 1.0 + s;
  *rest = 0.0;
}

static void open_front(known_front *k, void (*motion)(double, double *, double *)) {
  memset(k, 0, sizeof *k);
  k->motion = motion;
  for (int i = 0; i < AMBULO__FRONT_TERMS; i++) k->unit[i] = k->front.own[i] = 1.0;
}

static known_front k;

static void even(double most) {
  if (k.report.largest > most * k.report.mean)
    print_error("largest gap %.3f mean gaps of %d points, %d solves\n",
                k.report.largest / k.report.mean, k.report.on, k.front.points);
  assert_true(k.report.largest <= most * k.report.mean);
}

static void points_are_even(void **state) {
  (void)state;
  void (*const motions[])(double, double *, double *) = {circle, corner, with_rest};
  for (int wanted = 5; wanted <= 40; wanted += 7) {
    for (int i = 0; i < 3; i++) {
      open_front(&k, motions[i]);
      known_run(&k, 2, wanted);
      assert_true(k.report.on >= wanted && k.report.on <= 2 * wanted);
      assert_int_equal(k.report.unsolved + k.report.beaten + k.report.dominated, 0);
      even(1.5);
    }
  }
}

/* what one term costs in another unit changes neither the places nor the number of points much:
 * ends are asked for again until the shares there are right */
static void units_do_not_matter(void **state) {
  (void)state;
  for (int power = -4; power <= 4; power += 2) {
    open_front(&k, circle);
    k.unit[0] = pow(10.0, power);
    k.unit[1] = 7.0;
    known_run(&k, 2, 12);
    assert_true(k.report.on >= 12);
    even(1.5);
    int anchor[3], count;
    double lowest[3], range[3], share;
    ambulo__front_request requests[3];
    assert_true(ambulo__front_anchors(&k.front, anchor, lowest, range, requests, &count));
    for (int i = 0; i < 2; i++) {
      const double *w = k.points[anchor[i]].weight;
      share = w[1 - i] * range[1 - i] / (w[0] * range[0] + w[1] * range[1]);
      assert_true(share < 0.03 && share > 0.0033);
    }
    /* weights go with the file's: of shares that sum to 1 */
    for (int j = 0; j < k.front.points; j++)
      assert_close(0.5 * (k.points[j].weight[0] + k.points[j].weight[1]), 1.0, 1e-3);
  }
}

static void what_is_not_convex_refuses(void **state) {
  (void)state;
  open_front(&k, wave);
  known_run(&k, 2, 20);
  ambulo__front_gap gap[200];
  int gaps = 0, refused = 0;
  ambulo__front_gaps(&k.front, gap, &gaps);
  for (int i = 0; i < gaps; i++) {
    double from = k.points[gap[i].a].value[0], to = k.points[gap[i].b].value[0];
    if (gap[i].length <= 1.5 * k.report.mean) continue;
    assert_true(gap[i].refused);
    refused++;
    /* from where the tangent meets the end of the front, tan(2 pi s) = -2 pi (1 - s), to the end */
    assert_true(from > 0.27 && from < 0.3 && to > 0.98);
  }
  assert_int_equal(refused, 1);
  /* the rest of it is found, and evenly */
  assert_true(k.report.on >= 20);
}

static void a_straight_one_refuses(void **state) {
  (void)state;
  open_front(&k, straight);
  known_run(&k, 2, 20);
  ambulo__front_gap gap[200];
  int gaps = 0;
  ambulo__front_gaps(&k.front, gap, &gaps);
  assert_int_equal(gaps, 1);
  assert_true(gap[0].refused);
  assert_true(k.front.points < 10);
}

static void terms_without_conflict(void **state) {
  (void)state;
  open_front(&k, one_is_best);
  known_run(&k, 2, 20);
  assert_true(k.report.complete && !k.report.conflict);
  assert_int_equal(k.front.points, 2);
  assert_int_equal(k.report.on, 0);
}

/* from zero, solves of a range of weights end where more of both is */
static int valley(const double *weight, double *s) {
  if (weight[0] < 0.8 || weight[0] > 1.3) return 0;
  *s = 0.97;
  return 1;
}

static void valleys_are_left(void **state) {
  (void)state;
  int again = 0;
  open_front(&k, circle);
  k.valley = valley;
  known_run(&k, 2, 12);
  assert_true(k.report.beaten > 0);
  assert_true(k.report.on >= 12);
  even(1.5);
  for (int i = 0; i < k.front.points; i++) {
    const ambulo__front_point *p = &k.points[i];
    if (p->standing == AMBULO__FRONT_BEATEN) assert_true(p->better >= 0 && p->place < 0);
    if (p->standing == AMBULO__FRONT_BEATEN) assert_true(valley(p->weight, &(double){0.0}));
    if (p->from < 0) continue;
    again++;
    assert_int_equal(p->standing, AMBULO__FRONT_ON);
    /* from what was better for the same weights */
    const ambulo__front_point *left = &k.points[p->parent[1]];
    assert_memory_equal(p->weight, left->weight, sizeof p->weight);
    assert_true(ambulo__front_total(&k.front, p->weight, p->from) < left->total);
  }
  assert_true(again > 0);
}

static void failures_end(void **state) {
  (void)state;
  open_front(&k, circle);
  k.fails_after = 4;
  known_run(&k, 2, 12);
  assert_true(k.front.points <= 36 && k.report.unsolved > 0);
  ambulo__front_gap gap[200];
  int gaps = 0;
  ambulo__front_gaps(&k.front, gap, &gaps);
  for (int i = 0; i < gaps; i++) assert_true(gap[i].refused);
  /* an end without a solution: there is no front, and nothing more is asked for */
  open_front(&k, circle);
  k.fails_after = 1;
  known_run(&k, 2, 12);
  assert_int_equal(k.front.points, 2);
  assert_false(k.report.complete);
}

static void neighbours_start(void **state) {
  (void)state;
  open_front(&k, circle);
  k.front.neighbour = 1;
  known_run(&k, 2, 12);
  for (int i = 0; i < k.front.points; i++) {
    const ambulo__front_point *p = &k.points[i];
    if (p->parent[0] < 0) {
      assert_int_equal(p->from, -1);
    } else {
      assert_true(p->from == p->parent[0] || p->from == p->parent[1]);
      assert_true(p->from < i);
    }
  }
}

static void three_terms(void **state) {
  (void)state;
  for (int wanted = 10; wanted <= 60; wanted += 25) {
    open_front(&k, NULL);
    k.unit[1] = 50.0;
    known_run(&k, 3, wanted);
    assert_true(k.report.on >= wanted);
    assert_int_equal(k.report.beaten + k.report.dominated, 0);
    even(2.5);
    /* the middle is not empty: some point has about as much of all */
    double nearest = INFINITY;
    for (int i = 0; i < k.front.points; i++) {
      const double *z = k.points[i].z;
      double mean = (z[0] + z[1] + z[2]) / 3.0, off = 0.0;
      for (int j = 0; j < 3; j++) off = fmax(off, fabs(z[j] - mean));
      nearest = fmin(nearest, off);
    }
    assert_true(nearest < 0.3);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(points_are_even),
      cmocka_unit_test(units_do_not_matter),
      cmocka_unit_test(what_is_not_convex_refuses),
      cmocka_unit_test(a_straight_one_refuses),
      cmocka_unit_test(terms_without_conflict),
      cmocka_unit_test(valleys_are_left),
      cmocka_unit_test(failures_end),
      cmocka_unit_test(neighbours_start),
      cmocka_unit_test(three_terms),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
