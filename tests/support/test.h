/* tests/support/test.h - cmocka, and numbers that say what they are when they differ. */
#ifndef AMBULO_TESTS_TEST_H
#define AMBULO_TESTS_TEST_H

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* |got - want| <= tolerance * max(1, |want|) */
#define assert_close(got, want, tolerance)                                                         \
  check_close((double)(got), (double)(want), (double)(tolerance), #got, __FILE__, __LINE__)

static inline void check_close(double got, double want, double tolerance, const char *what,
                               const char *file, int line) {
  double size = fabs(want) > 1.0 ? fabs(want) : 1.0;
  if (fabs(got - want) <= tolerance * size) return;
  print_error("%s is %.17g, expected %.17g (relative error %.3g, allowed %.3g)\n", what, got, want,
              fabs(got - want) / size, tolerance);
  _fail(file, line);
}

/* A test that begins with it takes many seconds: make check-long runs it, make check does not. */
#define ONLY_IN_CHECK_LONG()                                                                       \
  do {                                                                                             \
    if (!getenv("AMBULO_LONG")) skip();                                                            \
  } while (0)

#endif
