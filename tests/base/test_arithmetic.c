/* The worst of many numbers keeps what is not a number. */
#include "base/arithmetic.h"
#include "support/test.h"

static void worse_is_the_larger(void **state) {
  (void)state;
  assert_close(ambulo__worse(1.0, 2.0), 2.0, 0.0);
  assert_close(ambulo__worse(2.0, 1.0), 2.0, 0.0);
  assert_close(ambulo__worse(-2.0, -1.0), -1.0, 0.0);
  assert_true(isinf(ambulo__worse(INFINITY, 1.0)) && isinf(ambulo__worse(1.0, INFINITY)));
}

static void nan_is_the_worst(void **state) {
  (void)state;
  const double nan = NAN;
  assert_true(isnan(ambulo__worse(nan, 1.0)) && isnan(ambulo__worse(1.0, nan)));
  assert_true(isnan(ambulo__worse(nan, INFINITY)) && isnan(ambulo__worse(INFINITY, nan)));
  assert_true(ambulo__is_worse(1.0, nan) && ambulo__is_worse(INFINITY, nan));
  assert_false(ambulo__is_worse(nan, INFINITY));
  assert_false(ambulo__is_worse(nan, nan));
  assert_true(ambulo__is_worse(1.0, 2.0));
  assert_false(ambulo__is_worse(2.0, 2.0));
}

/* at every place of arrays of every length up to three times the unrolled eight */
static void every_place_counts(void **state) {
  (void)state;
  const double spoilt[] = {NAN, INFINITY, -INFINITY};
  double v[25];
  for (size_t count = 0; count <= 25; count++) {
    for (size_t i = 0; i < count; i++) v[i] = -1.0 - (double)i;
    assert_true(ambulo__all_finite(v, count));
    assert_close(ambulo__largest(v, count), (double)count, 0.0);
    for (size_t at = 0; at < count; at++) {
      for (size_t kind = 0; kind < 3; kind++) {
        double kept = v[at];
        v[at] = spoilt[kind];
        assert_false(ambulo__all_finite(v, count));
        double largest = ambulo__largest(v, count);
        assert_true(kind == 0 ? isnan(largest) : isinf(largest) && largest > 0.0);
        v[at] = kept;
      }
    }
  }
}

static void large_numbers_are_finite(void **state) {
  (void)state;
  const double v[] = {DBL_MAX, -DBL_MAX, DBL_MIN, 0.0};
  assert_true(ambulo__all_finite(v, 4));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(worse_is_the_larger), cmocka_unit_test(nan_is_the_worst),
      cmocka_unit_test(every_place_counts), cmocka_unit_test(large_numbers_are_finite)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
