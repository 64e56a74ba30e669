/* linear/band.c - see band.h. */
#include "linear/band.h"
#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

enum { FEW_ROWS = 24 }; /* fewer are mapped one by one: walks of 21 coordinates 3 % quicker */

ambulo_status ambulo__band_create(ambulo__pool *pool, int n, int kd, ambulo__band *band) {
  size_t padded = (size_t)ambulo__whole_tiles(n), tiles = padded / AMBULO__TILE;
  band->n = n;
  band->kd = kd < n ? kd : n - 1;
  band->kernels = ambulo__band_kernels_select();
  band->ld = ambulo__whole_tiles(band->kd + AMBULO__TILE) + 1;
  band->a = ambulo__pool_doubles(pool, padded * (size_t)band->ld);
  band->corner = ambulo__pool_doubles(pool, tiles * AMBULO__CORNER);
  band->below = ambulo__pool_ints(pool, tiles);
  band->work = ambulo__pool_doubles(pool, 2 * padded);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

static size_t size_of(const ambulo__band *band) {
  return (size_t)band->n * (size_t)band->ld * sizeof *band->a;
}

void ambulo__band_clear(ambulo__band *band) {
  memset(band->a, 0, size_of(band));
}

void ambulo__band_copy(const ambulo__band *from, ambulo__band *to) {
  memcpy(to->a, from->a, size_of(to));
}

void ambulo__band_add_diagonal(ambulo__band *band, double value) {
  for (int j = 0; j < band->n; j++) band->a[(size_t)j * (size_t)band->ld] += value;
}

void ambulo__band_add_rows(ambulo__band *band, int first, int width, int count, int stride,
                           const double *g) {
  if (count == 0) return;
  band->kernels->add_gram(count, width, stride, g, band->ld,
                          band->a + (size_t)first * (size_t)band->ld);
}

void ambulo__band_add_outer(ambulo__band *band, int first, int count, int stride, double weight,
                            const double *g) {
  for (int f = 0; f < count; f++) {
    double *diagonal = band->a + (size_t)(first + f * stride) * (size_t)band->ld;
    for (int e = f; e < count; e++)
      diagonal[(e - f) * stride] += weight * g[f * stride] * g[e * stride];
  }
}

void ambulo__band_add_form(ambulo__band *band, int first, int count, int stride,
                           const double *form) {
  for (int e = 0, at = 0; e < count; e++) {
    for (int f = 0; f <= e; f++)
      band->a[(size_t)(first + f * stride) * (size_t)band->ld + (size_t)((e - f) * stride)] +=
          form[at++];
  }
}

static void add_scaled(int count, double factor, const double *restrict from, double *restrict to) {
  for (int k = 0; k < count; k++) to[k] += factor * from[k];
}

void ambulo__band_add_sparse(ambulo__band *band, const ambulo__sparse_rows *rows, int i,
                             double weight) {
  int from = rows->start[i], to = rows->start[i + 1];
  const double *value = ambulo__sparse_rows_gradient(rows, i) - from;
  /* columns ascend: (e, f) with f <= e is the lower triangle */
  for (int f = from; f < to; f++) {
    double factor = weight * value[f];
    if (factor == 0.0) continue;
    double *diagonal = band->a + (size_t)rows->column[f] * (size_t)band->ld;
    for (int e = f; e < to; e = rows->run_end[e]) {
      add_scaled(rows->run_end[e] - e, factor, value + e,
                 diagonal + rows->column[e] - rows->column[f]);
    }
  }
}

void ambulo__band_raise_diagonal(ambulo__band *band, double share) {
  for (int j = 0; j < band->n; j++) band->a[(size_t)j * (size_t)band->ld] *= 1.0 + share;
}

double ambulo__band_row_length(const ambulo__band *band, const ambulo__sparse_rows *rows, int i) {
  const double *value = ambulo__sparse_rows_gradient(rows, i) - rows->start[i];
  double sum = 0.0;
  for (int e = rows->start[i]; e < rows->start[i + 1]; e++)
    sum += value[e] * value[e] / band->a[(size_t)rows->column[e] * (size_t)band->ld];
  return sqrt(sum);
}

double ambulo__band_largest(const ambulo__band *band) {
  double largest = 0.0;
  for (int j = 0; j < band->n; j++) {
    largest = ambulo__worse(largest, band->a[(size_t)j * (size_t)band->ld]);
  }
  return largest;
}

int ambulo__band_factor(ambulo__band *band) {
  return band->kernels->factor(band->n, band->kd, band->ld, band->a, band->below, band->corner);
}

/* Zeros in the padding, each time: an infinite right-hand side leaves NaN there. */
static void take_right_side(const ambulo__band *l, const double *x) {
  size_t n = (size_t)l->n, padding = (size_t)ambulo__whole_tiles(l->n) - n;
  memcpy(l->work, x, n * sizeof *x);
  memset(l->work + n, 0, padding * sizeof *x);
}

void ambulo__band_multiply(const ambulo__band *band, const double *x, double *y) {
  double *product = band->work + ambulo__whole_tiles(band->n);
  take_right_side(band, x);
  band->kernels->multiply(band->n, band->kd, band->ld, band->a, band->work, product);
  memcpy(y, product, (size_t)band->n * sizeof *y);
}

void ambulo__band_forward(const ambulo__band *l, double *x) {
  take_right_side(l, x);
  l->kernels->forward(l->n, l->ld, l->a, l->below, l->corner, l->work);
  memcpy(x, l->work, (size_t)l->n * sizeof *x);
}

void ambulo__band_backward(const ambulo__band *l, double *x) {
  take_right_side(l, x);
  l->kernels->backward(l->n, l->ld, l->a, l->below, l->corner, l->work);
  memcpy(x, l->work, (size_t)l->n * sizeof *x);
}

void ambulo__band_upper_multiply(const ambulo__band *l, double *x) {
  take_right_side(l, x);
  l->kernels->upper_multiply(l->n, l->ld, l->a, l->below, l->work);
  memcpy(x, l->work, (size_t)l->n * sizeof *x);
}

void ambulo__band_forward_many(const ambulo__band *l, int width, double *x) {
  l->kernels->forward_many(l->n, l->ld, l->a, l->below, l->corner, width, x);
}

/* -------------------------------------------------- spread over control points */

ambulo_status ambulo__spread_create(ambulo__pool *pool, int d, ambulo__spread *s) {
  s->d = d;
  s->sums = ambulo__pool_doubles(pool, (size_t)(AMBULO__ORDERS * d));
  return ambulo__band_create(pool, AMBULO__ORDERS * d, AMBULO__ORDERS * d - 1, &s->square);
}

/* the triangle above the diagonal from the one below, by tiles, which stay in the cache */
static void fill_upper(int n, size_t step, double *m) {
  enum { TILE = AMBULO__TILE };
  for (int column = 0; column < n; column += TILE) {
    int end = column + TILE < n ? column + TILE : n;
    for (int row = column; row < n; row++) {
      for (int j = column; j < end && j < row; j++)
        m[(size_t)row * step + (size_t)j] = m[(size_t)j * step + (size_t)row];
    }
  }
}

/* a row g of G to one of G P, zero up to whole tiles */
static void map_row(int d, int span, const double *const b[AMBULO__ORDERS], double *restrict copy,
                    double *restrict g) {
  const int motion = AMBULO__ORDERS * d, most = span * d > motion ? span * d : motion;
  memcpy(copy, g, (size_t)motion * sizeof *copy);
  memset(g, 0, (size_t)ambulo__whole_tiles(most) * sizeof *g);
  for (int c = 0; c < span; c++) {
    for (int i = 0; i < d; i++)
      g[c * d + i] = b[0][c] * copy[i] + b[1][c] * copy[d + i] + b[2][c] * copy[2 * d + i];
  }
}

void ambulo__spread_rows(ambulo__spread *s, int count, int stride, double *g, int span,
                         const double *const b[AMBULO__ORDERS], int first, ambulo__band *band) {
  if (count == 0) return;
  if (span <= AMBULO__ORDERS || count < FEW_ROWS) {
    for (int k = 0; k < count; k++) map_row(s->d, span, b, s->sums, g + (size_t)k * (size_t)stride);
    ambulo__band_add_rows(band, first, span * s->d, count, stride, g);
    return;
  }
  ambulo__band *square = &s->square;
  size_t step = (size_t)square->ld - 1;
  double *a = band->a + (size_t)first * (size_t)band->ld;
  ambulo__band_clear(square);
  band->kernels->add_sparse_gram(count, square->n, stride, g, square->ld, square->a);
  fill_upper(square->n, step, square->a);
  band->kernels->spread(s->d, span, b, square->a, step, s->sums, band->ld, a);
}
