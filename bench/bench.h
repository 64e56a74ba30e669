/* bench/bench.h - clock and medians for the benchmarks. */
#ifndef AMBULO_BENCH_H
#define AMBULO_BENCH_H

#include "ambulo/ambulo.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* where models/ is: benches are run from the top folder unless built for another */
#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

static inline double bench_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static inline int bench_compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* sorts the values */
static inline double bench_median(double *values, int count) {
  qsort(values, (size_t)count, sizeof *values, bench_compare);
  return values[count / 2];
}

#endif
