/* linear/spread.c - see spread.h. */
#include "linear/spread_source.h"

#include <string.h>

enum { FEW_ROWS = 24 }; /* fewer are mapped one by one: walks of 21 coordinates 3 % quicker */

ambulo_status ambulo__spread_create(ambulo__pool *pool, int d, ambulo__spread *s) {
  s->d = d;
  s->sums = ambulo__pool_doubles(pool, (size_t)(AMBULO__ORDERS * d));
  return ambulo__band_create(pool, AMBULO__ORDERS * d, AMBULO__ORDERS * d - 1, &s->square);
}

/* the triangle above the diagonal from the one below, by tiles, which stay in the cache */
static void mirror(int n, size_t step, double *m) {
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
  if (band->kernels) {
    band->kernels->add_sparse_gram(count, square->n, stride, g, square->ld, square->a);
    mirror(square->n, step, square->a);
    band->kernels->spread(s->d, span, b, square->a, step, s->sums, band->ld, a);
  } else {
    ambulo__band_add_rows(square, 0, square->n, count, stride, g);
    mirror(square->n, step, square->a);
    spread(s->d, span, b, square->a, step, s->sums, band->ld, a);
  }
}
