/* What points of a front are worth, told of numbers by hand. */
#include "support/known_front.h"

static ambulo__front_point points[8];

/* ends at (0, 1) and (1, 0) with weights that are right for ranges of 1 */
static ambulo__front made(int count) {
  ambulo__front f = {.terms = 2, .points = count, .wanted = 8, .least = 0.01, .point = points};
  f.own[0] = f.own[1] = 1.0;
  memset(points, 0, sizeof points);
  for (int k = 0; k < 2; k++) {
    points[k].weight[k] = 1.98;
    points[k].weight[1 - k] = 0.02;
  }
  return f;
}

static void put(int k, double a, double b, double w) {
  ambulo__front_point *p = &points[k];
  if (w > 0.0) {
    p->weight[0] = w;
    p->weight[1] = 2.0 - w;
  }
  p->value[0] = a;
  p->value[1] = b;
  p->total = p->weight[0] * a + p->weight[1] * b;
  p->solved = 1;
}

static void every_standing(void **state) {
  (void)state;
  ambulo__front f = made(7);
  ambulo__front_report r;
  put(0, 0.0, 1.0, 0.0);
  put(1, 1.0, 0.0, 0.0);
  put(2, 0.3, 0.3, 1.0);
  put(3, 0.301, 0.299, 1.01); /* where 2 is */
  put(4, 0.5, 0.5, 0.9);      /* 2 is better for its weights */
  points[5].weight[0] = 0.5;  /* no solution */
  put(6, 0.7, 0.0, 0.02);     /* with less of the other terms, 1 is dominated */
  points[6].total = 0.1;
  points[1].total = 0.02 - 0.3;
  ambulo__front_judge(&f, &r);
  const ambulo__front_standing want[] = {
      AMBULO__FRONT_ON,     AMBULO__FRONT_DOMINATED, AMBULO__FRONT_ON,    AMBULO__FRONT_REPEATS,
      AMBULO__FRONT_BEATEN, AMBULO__FRONT_UNKNOWN,   AMBULO__FRONT_BEATEN};
  const int better[] = {-1, 6, -1, 2, 2, -1, 1}, place[] = {0, -1, 1, -1, -1, -1, -1};
  for (int k = 0; k < 7; k++) {
    assert_int_equal(points[k].standing, want[k]);
    assert_int_equal(points[k].place, place[k]);
    if (k != 4) assert_int_equal(points[k].better, better[k]);
  }
  assert_true(points[4].better == 2 || points[4].better == 3);
  assert_true(r.on == 2 && r.beaten == 2 && r.dominated == 1 && r.repeats == 1 && r.unsolved == 1);
  assert_close(r.mean, hypot(0.3, 0.7), 1e-12);
  assert_close(r.largest, r.mean, 1e-12);
}

/* shares of the ends are of what is minimized, whatever the file's weights are */
static void ends_are_asked_for_again(void **state) {
  (void)state;
  ambulo__front f = made(2);
  int anchor[3], count = 0;
  double lowest[3], range[3];
  ambulo__front_request requests[3];
  put(0, 0.0, 0.1, 0.0);
  put(1, 1.0, 0.0, 0.0);
  /* at the first end the other term has the share 0.002 / 1.982, at the second 0.02 / 0.218 */
  assert_int_equal(ambulo__front_anchors(&f, anchor, lowest, range, requests, &count), 0);
  assert_int_equal(count, 2);
  for (int i = 0; i < 2; i++) {
    const double *w = requests[i].weight;
    assert_int_equal(requests[i].anchor, i);
    assert_close(w[1 - i] * range[1 - i] / (w[0] * range[0] + w[1] * range[1]), 0.01, 1e-4);
    assert_close(w[0] + w[1], 2.0, 1e-4);
  }
  /* once they are there they are the ends, and those before them are outside or on the front */
  f.points = 4;
  for (int i = 0; i < 2; i++)
    memcpy(points[2 + i].weight, requests[i].weight, sizeof points->weight);
  put(2, 0.002, 0.06, 0.0);
  put(3, 1.3, -0.001, 0.0);
  assert_int_equal(ambulo__front_anchors(&f, anchor, lowest, range, requests, &count), 1);
  assert_true(anchor[0] == 2 && anchor[1] == 3);
  assert_close(range[1], 0.061, 1e-12);
  assert_close(lowest[0], 0.002, 1e-12);
  ambulo__front_report r;
  ambulo__front_judge(&f, &r);
  assert_int_equal(points[0].standing, AMBULO__FRONT_OUTSIDE);
  assert_close(points[2].z[1], 1.0, 1e-12);
  assert_close(ambulo__front_distance(&f, 2, 3), sqrt(2.0), 1e-12);
}

/* ends of the first round beside those that took their place: one has clearly less of its own term,
 * one is where its successor is */
static void ends_come_before_those_they_replace(void **state) {
  (void)state;
  ambulo__front f = made(2);
  ambulo__front_request requests[3];
  ambulo__front_report r;
  int anchor[3], count = 0;
  double lowest[3], range[3];
  f.least = 0.05; /* so that shares of 0.01 are too little */
  put(0, -0.05, 1.01, 0.0);
  put(1, 1.0, 0.001, 0.0);
  assert_int_equal(ambulo__front_anchors(&f, anchor, lowest, range, requests, &count), 0);
  assert_int_equal(count, 2);
  f.points = 4;
  for (int i = 0; i < 2; i++)
    memcpy(points[2 + i].weight, requests[i].weight, sizeof points->weight);
  put(2, 0.0, 1.0, 0.0);
  put(3, 1.0, 0.0, 0.0);
  points[0].total += 0.096; /* other terms, by which each is the best of its own weights */
  ambulo__front_judge(&f, &r);
  assert_int_equal(points[0].standing, AMBULO__FRONT_OUTSIDE);
  assert_int_equal(points[1].standing, AMBULO__FRONT_REPEATS);
  assert_int_equal(points[1].better, 3);
  assert_int_equal(points[2].standing, AMBULO__FRONT_ON);
  assert_int_equal(points[3].standing, AMBULO__FRONT_ON);
}

/* of the weights of the file, whose shares sum to 1 */
static void first_ends_have_nearly_all(void **state) {
  (void)state;
  static const double own[] = {2.0, 0.5, 10.0};
  ambulo__front f = {.terms = 3, .wanted = 8, .least = 0.05, .point = points};
  ambulo__front_request requests[3];
  int anchor[3], count = 0;
  double lowest[3], range[3];
  memcpy(f.own, own, sizeof own);
  assert_int_equal(ambulo__front_anchors(&f, anchor, lowest, range, requests, &count), 0);
  assert_int_equal(count, 3);
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 3; i++)
      assert_close(requests[k].weight[i], 3.0 * own[i] * (i == k ? 0.9 : 0.05), 1e-12);
}

static void weights_lead_between(void **state) {
  (void)state;
  ambulo__front f = made(2);
  ambulo__front_request request;
  put(0, 0.0, 1.0, 0.0);
  put(1, 1.0, 0.0, 0.0);
  ambulo__front_report r;
  ambulo__front_judge(&f, &r);
  /* the chord has the slope -1 */
  assert_int_equal(ambulo__front_between(&f, 0, 1, 0.5, &request), 1);
  assert_close(request.weight[0], 1.0, 1e-9);
  assert_close(request.weight[1], 1.0, 1e-9);
  assert_close(ambulo__front_total(&f, request.weight, 0),
               ambulo__front_total(&f, request.weight, 1), 1e-9);
  assert_int_equal(ambulo__front_between(&f, 0, 1, 0.25, &request), 1);
  assert_true(request.weight[0] > 1.0 && request.from == -1);
  /* from the motion at the nearer end, where neighbours are starts */
  f.neighbour = 1;
  for (int i = 1; i < 4; i++) {
    assert_int_equal(ambulo__front_between(&f, 0, 1, 0.25 * i, &request), 1);
    assert_int_equal(request.from, i < 3 ? 0 : 1);
    assert_true(request.parent[0] == 0 && request.parent[1] == 1 && request.anchor == -1);
  }
  f.neighbour = 0;
  /* a solve that came back to an end settles it; one that failed does not */
  assert_int_equal(ambulo__front_is_refused(&f, 0, 1), 0);
  f.points = 3;
  put(2, 0.0, 1.0, 1.0);
  ambulo__front_judge(&f, &r);
  assert_int_equal(ambulo__front_is_refused(&f, 0, 1), 1);
  points[2].solved = 0;
  ambulo__front_judge(&f, &r);
  assert_int_equal(ambulo__front_is_refused(&f, 0, 1), 0);
  /* digits: as many as a list shows */
  assert_close(ambulo__front_round(0.123456789), 0.12346, 1e-15);
  assert_close(ambulo__front_round(123456.789), 123460.0, 1e-15);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_standing),
      cmocka_unit_test(ends_are_asked_for_again),
      cmocka_unit_test(ends_come_before_those_they_replace),
      cmocka_unit_test(first_ends_have_nearly_all),
      cmocka_unit_test(weights_lead_between),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
