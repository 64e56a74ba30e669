/* linear/border.c - see border.h. */
#include "linear/border.h"

#include <string.h>

ambulo_status ambulo__border_create(const ambulo__sparse_rows *rows, ambulo__pool *pool,
                                    ambulo__border *border) {
  memset(border, 0, sizeof *border);
  border->rows = rows;
  border->n = rows->problem->variables;
  border->count = rows->count;
  border->width = ambulo__whole_tiles(rows->count);
  border->kernels = ambulo__band_kernels_select();
  if (border->count == 0) return AMBULO_OK;
  size_t n = (size_t)ambulo__whole_tiles(border->n), width = (size_t)border->width;
  border->wing = ambulo__pool_doubles(pool, n * width);
  border->rest = ambulo__pool_doubles(pool, width);
  if (pool->failed) return AMBULO_E_MEMORY;
  return ambulo__band_create(pool, border->count, border->count - 1, &border->schur);
}

/* W = L^-1 C' */
static void fill_wing(ambulo__border *border, const ambulo__band *factor, const int *active) {
  const ambulo__sparse_rows *rows = border->rows;
  size_t width = (size_t)border->width;
  memset(border->wing, 0, (size_t)border->n * width * sizeof *border->wing);
  for (int i = 0; i < border->count; i++) {
    if (active && !active[i]) continue;
    for (int e = rows->start[i]; e < rows->start[i + 1]; e++)
      border->wing[(size_t)rows->column[e] * width + (size_t)i] += rows->value[e];
  }
  ambulo__band_forward_many(factor, border->width, border->wing);
}

int ambulo__border_factor(ambulo__border *border, const ambulo__band *factor, const int *active,
                          double shift, double relative) {
  if (border->count == 0) return 0;
  fill_wing(border, factor, active);
  ambulo__band_clear(&border->schur);
  ambulo__band_add_rows(&border->schur, 0, border->count, border->n, border->width, border->wing);
  ambulo__band_add_diagonal(&border->schur,
                            shift + relative * ambulo__band_largest(&border->schur));
  return ambulo__band_factor(&border->schur);
}

/* (P.3) the Schur complement's part of a pass */
void ambulo__border_eliminate(ambulo__border *border, const double *b, double *z) {
  if (border->count == 0) return;
  double *rest = border->rest;
  border->kernels->gather(border->n, border->width, border->wing, z, rest);
  for (int i = 0; b && i < border->count; i++) rest[i] -= b[i];
  ambulo__band_forward(&border->schur, rest);
  ambulo__band_backward(&border->schur, rest);
  border->kernels->scatter(border->n, border->width, border->wing, rest, z);
}
