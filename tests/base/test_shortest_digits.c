/* Numbers by whole numbers of 128 bits are those that printf writes. */
#include "base/numtext.h"
#include "base/shortest_digits.h"
#include "support/test.h"

#include <stdio.h>

/* 1 when it was not left to printf */
static int expect_as_printed(double value) {
  char got[AMBULO__NUMTEXT_SIZE], want[AMBULO__NUMTEXT_SIZE];
  size_t length = ambulo__shortest_digits(got, value);
  if (length == 0) return 0;
  for (int digits = 15; digits <= 17; digits++) {
    (void)snprintf(want, sizeof want, "%.*g", digits, value);
    if (strtod(want, NULL) == value) break;
  }
  assert_string_equal(got, want);
  assert_int_equal(length, strlen(want));
  return 1;
}

static void numbers_are_those_of_printf(void **state) {
  (void)state;
  uint64_t seed = 88172645463325252ULL;
  int taken = 0, tried = 0;
  for (int decade = -14; decade < 18; decade++) {
    for (int i = 0; i < 3000; i++) {
      seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
      double part = (double)(seed >> 11) / 9007199254740992.0; /* any digits */
      double few = (double)(seed >> 44) / 1048576.0;           /* and few of them */
      double value = (i & 1 ? part : few) * pow(10.0, decade) * (i & 2 ? -1.0 : 1.0);
      taken += expect_as_printed(value);
      tried++;
      (void)expect_as_printed(round(part * 1e6) / 1e6 * pow(10.0, decade));
    }
  }
  assert_true(taken > tried / 2);
}

static void edges(void **state) {
  (void)state;
  static const double values[] = {1e-6,
                                  1e-7,
                                  1e-9,
                                  0.1,
                                  0.3,
                                  1e-4,
                                  9.9999999999999991e-5,
                                  1e-5,
                                  0.999999999999999944,
                                  9.999999999999999,
                                  99999999999999.98,
                                  123456789012345680.0,
                                  1e15,
                                  1e16,
                                  1.5,
                                  2.5,
                                  1e-11,
                                  9007199254740991.0,
                                  0.0,
                                  1.0,
                                  0.5,
                                  4503599627370497.5,
                                  1e300,
                                  5e-324,
                                  0.1 + 0.2,
                                  999999999999999.9};
  for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
    for (int k = -3; k <= 3; k++) { /* and the numbers beside them */
      double value = values[i];
      for (int step = 0; step < abs(k); step++)
        value = nextafter(value, k < 0 ? -HUGE_VAL : HUGE_VAL);
      (void)expect_as_printed(value);
      (void)expect_as_printed(-value);
    }
  }
  char text[AMBULO__NUMTEXT_SIZE];
  assert_int_equal(ambulo__shortest_digits(text, 0.0), 0); /* left to printf */
  assert_int_equal(ambulo__shortest_digits(text, 1e300), 0);
  assert_int_equal(ambulo__shortest_digits(text, 0.5), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_are_those_of_printf),
                                     cmocka_unit_test(edges)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
