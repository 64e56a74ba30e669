/* tests/support/packed_motions.h - motions as they were before show/motion_pack.h wrote them. */
#ifndef AMBULO_TESTS_PACKED_MOTIONS_H
#define AMBULO_TESTS_PACKED_MOTIONS_H

#include "support/test.h"

typedef struct packed_motions {
  int components, order;
  size_t length;  /* bytes that were read */
  double *values; /* [count][series][samples], in steps */
} packed_motions;

static double next_whole(const char *bytes, size_t length, size_t *at) {
  double value = 0.0, times = 1.0;
  for (;;) {
    assert_true(*at < length);
    unsigned byte = (unsigned char)bytes[(*at)++];
    value += times * (byte & 127u);
    times *= 128.0;
    if (byte < 128u) break;
  }
  return fmod(value, 2.0) != 0.0 ? -(value + 1.0) / 2.0 : value / 2.0;
}

static void add_up(double *values, int series, int samples, int order) {
  for (int s = 0; s < series; s++, values += samples)
    for (int round = 0; round < order; round++)
      for (int k = 1; k < samples; k++) values[k] += values[k - 1];
}

/* values are to be freed */
static packed_motions read_motions(const char *bytes, size_t length, int count, int series,
                                   int samples) {
  size_t at = 0, n = (size_t)series * (size_t)samples;
  packed_motions p = {.components = (int)next_whole(bytes, length, &at)};
  p.order = (int)next_whole(bytes, length, &at);
  double q = 2.0 * ceil(sqrt(p.components + 1.0));
  double *row = calloc(n * (size_t)(p.components + 1), sizeof *row);
  p.values = calloc(n * (size_t)count, sizeof *p.values);
  for (int k = 0; k <= p.components; k++) {
    for (size_t v = 0; v < n; v++) row[(size_t)k * n + v] = next_whole(bytes, length, &at);
    add_up(row + (size_t)k * n, series, samples, k ? 1 : 2);
  }
  for (int i = 0; i < count; i++)
    for (size_t v = 0; v < n; v++) p.values[(size_t)i * n + v] = row[v] / q;
  for (int k = 1; k <= p.components; k++) {
    double largest = 1.0;
    for (size_t v = 0; v < n; v++) largest = fmax(largest, fabs(row[(size_t)k * n + v]));
    for (int i = 0; i < count; i++) {
      double weight = next_whole(bytes, length, &at) * q / (4.0 * largest);
      for (size_t v = 0; v < n; v++)
        p.values[(size_t)i * n + v] += weight * row[(size_t)k * n + v] / q;
    }
  }
  for (int i = 0; i < count; i++) {
    memset(row, 0, n * sizeof *row);
    size_t place = 0;
    for (double left = next_whole(bytes, length, &at); left > 0.0; left -= 1.0, place++) {
      place += (size_t)next_whole(bytes, length, &at);
      assert_true(place < n);
      row[place] = next_whole(bytes, length, &at);
    }
    add_up(row, series, samples, p.order);
    for (size_t v = 0; v < n; v++) p.values[(size_t)i * n + v] += row[v];
  }
  free(row);
  p.length = at;
  return p;
}

#endif
