/* mechanics/lane_transpose.h - between callers' arrays, values[node][entry], and blocks of lanes,
 * lanes[entry][lane].
 *
 * Two entries of two nodes at a time, in registers that every processor with doubles in pairs has:
 * the kernels take less time than copying number by number would.
 */
#ifndef AMBULO_MECHANICS_LANE_TRANSPOSE_H
#define AMBULO_MECHANICS_LANE_TRANSPOSE_H

#include <string.h>

#include "mechanics/plan.h"

typedef double ambulo__two __attribute__((vector_size(16)));

static inline ambulo__two ambulo__load_two(const double *at) {
  ambulo__two v;
  memcpy(&v, at, sizeof v);
  return v;
}

static inline ambulo__two ambulo__square_two(const double *at) {
  ambulo__two v = ambulo__load_two(at);
  return v * v;
}

static inline void ambulo__store_two(double *at, double a, double b) {
  const ambulo__two v = {a, b};
  memcpy(at, &v, sizeof v);
}

/* The block of nodes that starts at `first`; lanes beyond the last node repeat it. NULL: zeros. */
static inline void ambulo__lanes_gather(double *lanes, const double *values, int entries, int first,
                                        int nodes) {
  if (!values) {
    memset(lanes, 0, (size_t)entries * AMBULO__LANES * sizeof *lanes);
    return;
  }
  for (int lane = 0; lane < AMBULO__LANES; lane += 2) {
    int node = first + lane < nodes ? first + lane : nodes - 1;
    int next = node + 1 < nodes ? node + 1 : nodes - 1, e = 0;
    const double *a = values + (size_t)node * (size_t)entries;
    const double *b = values + (size_t)next * (size_t)entries;
    double *to = lanes + lane;
    for (; e + 1 < entries; e += 2, to += 2 * AMBULO__LANES) {
      ambulo__two x = ambulo__load_two(a + e), y = ambulo__load_two(b + e);
      ambulo__store_two(to, x[0], y[0]);
      ambulo__store_two(to + AMBULO__LANES, x[1], y[1]);
    }
    if (e < entries) ambulo__store_two(to, a[e], b[e]);
  }
}

/* The way back; values may be NULL. */
static inline void ambulo__lanes_scatter(double *values, const double *lanes, int entries,
                                         int first, int nodes) {
  if (!values) return;
  int count = nodes - first < AMBULO__LANES ? nodes - first : AMBULO__LANES, lane = 0;
  double *a = values + (size_t)first * (size_t)entries;
  for (; lane + 1 < count; lane += 2, a += 2 * entries) {
    const double *from = lanes + lane;
    double *b = a + entries;
    int e = 0;
    for (; e + 1 < entries; e += 2, from += 2 * AMBULO__LANES) {
      ambulo__two x = ambulo__load_two(from), y = ambulo__load_two(from + AMBULO__LANES);
      ambulo__store_two(a + e, x[0], y[0]);
      ambulo__store_two(b + e, x[1], y[1]);
    }
    if (e == entries) continue;
    a[e] = from[0];
    b[e] = from[1];
  }
  for (int e = 0; lane < count && e < entries; e++) a[e] = lanes[e * AMBULO__LANES + lane];
}

#endif
