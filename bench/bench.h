/* bench/bench.h - clock and medians for the benchmarks.
 *
 * Times are processor seconds of the measuring thread: on a machine that does other work they
 * count only the time in which this program ran. */
#ifndef AMBULO_BENCH_H
#define AMBULO_BENCH_H

#include "ambulo/ambulo.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* where models/ is: benches are run from the top folder unless built for another */
#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

static inline double bench_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
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

/* Of sorted values the least but for one in twenty, which a clock that jumps may have made. */
static inline double bench_least(const double *values, int count) {
  return values[count / 20];
}

/* Slope of log(y) over log(x): y grows like x to that power. */
static inline double bench_power(const double *x, const double *y, int count) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 0; i < count; i++) {
    double u = log(x[i]), v = log(y[i]);
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

#endif
