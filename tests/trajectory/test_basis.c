/* What every basis promises: refusals, clamped times, trimming, one map per node. */
#include "support/fail_alloc.h"
#include "trajectory/basis_fixture.h"

static void impossible_arguments_are_refused(void **state) {
  (void)state;
  ambulo__basis *basis = NULL;
  const double falling[4] = {0.0, 0.5, 0.4, 1.0}, short_of[4] = {0.0, 0.3, 0.6, 0.9};
  const double not_a_number[4] = {0.0, NAN, 0.6, 1.0};
  const struct {
    ambulo__basis_kind kind;
    int degree, intervals;
    double duration;
    const double *knots;
  } bad[] = {{AMBULO__BSPLINE, 2, 3, 1.0, NULL},
             {AMBULO__BSPLINE, 8, 3, 1.0, NULL},
             {AMBULO__BSPLINE, 3, 0, 1.0, NULL},
             {AMBULO__BSPLINE, 3, -5, 1.0, NULL},
             {AMBULO__BSPLINE, 3, 2000000000, 1.0, NULL},
             {AMBULO__BSPLINE, 3, 3, 0.0, NULL},
             {AMBULO__BSPLINE, 3, 3, -1.0, NULL},
             {AMBULO__HERMITE, 3, 3, INFINITY, NULL},
             {AMBULO__CENTRAL_DIFFERENCE, 3, 3, NAN, NULL},
             {AMBULO__BSPLINE, 3, 3, 1.0, falling},
             {AMBULO__BSPLINE, 3, 3, 1.0, short_of},
             {AMBULO__BSPLINE, 3, 3, 1.0, not_a_number},
             {(ambulo__basis_kind)7, 3, 3, 1.0, NULL}};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    ambulo_status status = ambulo__basis_create(bad[i].kind, bad[i].degree, bad[i].intervals,
                                                bad[i].duration, bad[i].knots, NULL, &basis);
    if (status != AMBULO_E_ARGUMENT) print_error("argument set %zu was accepted\n", i);
    assert_int_equal(status, AMBULO_E_ARGUMENT);
    assert_null(basis);
  }
  ambulo__basis_free(NULL);
}

static void sizes_follow_from_kind_and_intervals(void **state) {
  (void)state;
  const struct {
    ambulo__basis_kind kind;
    int degree, control_points, span;
  } want[] = {{AMBULO__BSPLINE, 3, 15, 4},
              {AMBULO__BSPLINE, 7, 19, 8},
              {AMBULO__CENTRAL_DIFFERENCE, 3, 15, 4},
              {AMBULO__HERMITE, 3, 26, 4}};
  for (size_t i = 0; i < sizeof want / sizeof *want; i++) {
    ambulo__basis *basis = make_basis(want[i].kind, want[i].degree, 12, 2.442, NULL);
    assert_int_equal(ambulo__basis_control_points(basis), want[i].control_points);
    assert_int_equal(ambulo__basis_span(basis), want[i].span);
    assert_int_equal(ambulo__basis_intervals(basis), 12);
    assert_int_equal(ambulo__basis_get_kind(basis), want[i].kind);
    assert_true(ambulo__basis_duration(basis) == 2.442);
    assert_true(ambulo__basis_breakpoints(basis)[12] == 2.442);
    ambulo__basis_free(basis);
  }
}

static void nodes_on_breakpoints_touch_three_control_points(void **state) {
  (void)state;
  /* k T / N for several N: many of them miss the breakpoint by rounding */
  for (int intervals = 4; intervals <= 144; intervals++) {
    ambulo__basis *basis = make_basis(AMBULO__BSPLINE, 3, intervals, 2.442, NULL);
    for (int k = 0; k <= 3 * intervals; k += 3) {
      ambulo__basis_point point;
      ambulo__basis_at(basis, k * (2.442 / (3 * intervals)), &point);
      assert_int_equal(point.span, 3);
      assert_int_equal(point.first, k == 3 * intervals ? intervals : k / 3);
      assert_int_equal(point.jerk_span, 4);
    }
    ambulo__basis_free(basis);
  }
}

static void times_outside_are_clamped(void **state) {
  (void)state;
  for (int kind = AMBULO__BSPLINE; kind <= AMBULO__HERMITE; kind++) {
    ambulo__basis *basis = make_basis((ambulo__basis_kind)kind, 3, 5, 2.0, NULL);
    const double pairs[4][2] = {{-1.0, 0.0}, {2.5, 2.0}, {INFINITY, 2.0}, {NAN, 0.0}};
    for (int i = 0; i < 4; i++) {
      ambulo__basis_point outside, edge;
      ambulo__basis_at(basis, pairs[i][0], &outside);
      ambulo__basis_at(basis, pairs[i][1], &edge);
      assert_memory_equal(&outside, &edge, sizeof edge);
    }
    ambulo__basis_free(basis);
  }
}

static void windows_carry_weight_at_both_ends_and_none_beyond(void **state) {
  (void)state;
  for (int kind = AMBULO__BSPLINE; kind <= AMBULO__HERMITE; kind++) {
    ambulo__basis *basis = make_basis((ambulo__basis_kind)kind, 5, 9, 1.1, NULL);
    int n = ambulo__basis_control_points(basis);
    for (int k = 0; k <= 270; k++) {
      ambulo__basis_point point;
      ambulo__basis_at(basis, 1.1 * k / 270, &point);
      assert_true(point.first >= 0 && point.span >= 1 && point.first + point.span <= n);
      double head = 0.0, tail = 0.0, beyond = 0.0;
      for (int order = 0; order < 3; order++) {
        head += fabs(point.weight[order][0]);
        tail += fabs(point.weight[order][point.span - 1]);
        for (int c = point.span; c < AMBULO__MAX_SPAN; c++) beyond += fabs(point.weight[order][c]);
      }
      assert_true(head > 0.0 && tail > 0.0 && beyond == 0.0);
    }
    ambulo__basis_free(basis);
  }
}

static void a_start_linear_in_time_is_linear(void **state) {
  (void)state;
  for (int kind = AMBULO__BSPLINE; kind <= AMBULO__HERMITE; kind++) {
    ambulo__basis *basis = make_basis((ambulo__basis_kind)kind, 4, 5, 2.0,
                                      kind == AMBULO__BSPLINE ? uneven_knots : NULL);
    double x[64], h = 2.0 / 5;
    for (int c = 0; c < ambulo__basis_control_points(basis); c++) {
      int is_value;
      double t = ambulo__basis_abscissa(basis, c, &is_value);
      x[c] = is_value ? 0.3 - 1.7 * t : -1.7 * h;
    }
    for (double t = 0.0; t <= 2.0; t += 0.0625) {
      assert_close(curve(basis, x, t, 0), 0.3 - 1.7 * t, 1e-14);
      assert_close(curve(basis, x, t, 1), -1.7, 1e-13);
      assert_close(curve(basis, x, t, 2), 0.0, 1e-10);
    }
    ambulo__basis_free(basis);
  }
}

static void every_failed_allocation_is_survived(void **state) {
  (void)state;
  for (int kind = AMBULO__BSPLINE; kind <= AMBULO__HERMITE; kind++) {
    for (long k = 0;; k++) {
      assert_in_range(k, 0, 100);
      fail_alloc memory = fail_alloc_at(k);
      ambulo_allocator hook = fail_alloc_hook(&memory);
      ambulo__basis *basis = NULL;
      ambulo_status status =
          ambulo__basis_create((ambulo__basis_kind)kind, 3, 5, 1.0, NULL, &hook, &basis);
      assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
      ambulo__basis_free(basis);
      assert_int_equal(memory.live, 0);
      if (!memory.failed) break;
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(impossible_arguments_are_refused),
      cmocka_unit_test(sizes_follow_from_kind_and_intervals),
      cmocka_unit_test(nodes_on_breakpoints_touch_three_control_points),
      cmocka_unit_test(times_outside_are_clamped),
      cmocka_unit_test(windows_carry_weight_at_both_ends_and_none_beyond),
      cmocka_unit_test(a_start_linear_in_time_is_linear),
      cmocka_unit_test(every_failed_allocation_is_survived),
  };
  return cmocka_run_group_tests_name("trajectory/basis", tests, NULL, NULL);
}
