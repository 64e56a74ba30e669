/* linear/border.c - see border.h. */
#include "linear/border.h"

#include <math.h>
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
  border->columns = ambulo__pool_doubles(pool, n * width);
  border->rest = ambulo__pool_doubles(pool, width);
  if (pool->failed) return AMBULO_E_MEMORY;
  return ambulo__band_create(pool, border->count, border->count - 1, &border->schur);
}

/* W = L^-1 C' */
static void fill_columns(ambulo__border *border, const ambulo__band *factor, const int *active) {
  const ambulo__sparse_rows *rows = border->rows;
  size_t width = (size_t)border->width;
  memset(border->columns, 0, (size_t)border->n * width * sizeof *border->columns);
  for (int i = 0; i < border->count; i++) {
    if (active && !active[i]) continue;
    for (int e = rows->start[i]; e < rows->start[i + 1]; e++)
      border->columns[(size_t)rows->column[e] * width + (size_t)i] += rows->value[e];
  }
  ambulo__band_forward_many(factor, border->width, border->columns);
}

int ambulo__border_factor(ambulo__border *border, const ambulo__band *factor, const int *active,
                          double shift, double relative) {
  if (border->count == 0) return 0;
  fill_columns(border, factor, active);
  ambulo__band_clear(&border->schur);
  ambulo__band_add_rows(&border->schur, 0, border->count, border->n, border->width,
                        border->columns);
  ambulo__band_add_diagonal(&border->schur,
                            shift + relative * ambulo__band_largest(&border->schur));
  return ambulo__band_factor(&border->schur);
}

/* (P.3) the Schur complement's part of a pass */
void ambulo__border_eliminate(ambulo__border *border, const double *b, double *z) {
  if (border->count == 0) return;
  double *rest = border->rest;
  border->kernels->gather(border->n, border->width, border->columns, z, rest);
  for (int i = 0; b && i < border->count; i++) rest[i] -= b[i];
  ambulo__band_forward(&border->schur, rest);
  ambulo__band_backward(&border->schur, rest);
  border->kernels->scatter(border->n, border->width, border->columns, rest, z);
}

enum { T = AMBULO__TILE, ROOM = AMBULO__UPDATE_TILES * T };

ambulo_status ambulo__update_create(const ambulo__band *factor, ambulo__border *border,
                                    ambulo__pool *pool, ambulo__update *u) {
  size_t n = (size_t)ambulo__whole_tiles(factor->n), square = (size_t)ROOM * ROOM;
  memset(u, 0, sizeof *u);
  u->factor = factor;
  u->border = border;
  u->n = factor->n;
  u->row = ambulo__pool_ints(pool, ROOM);
  u->weight = ambulo__pool_doubles(pool, ROOM);
  u->columns = ambulo__pool_doubles(pool, n * ROOM);
  u->cross = ambulo__pool_doubles(pool, (size_t)border->width * ROOM);
  u->products = ambulo__pool_doubles(pool, square);
  u->complement = ambulo__pool_doubles(pool, square);
  u->rest = ambulo__pool_doubles(pool, ROOM);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__update_clear(ambulo__update *u) {
  u->taken = u->solved = u->full = 0;
}

static double *columns_of(const ambulo__update *u, int tile) {
  return u->columns + (size_t)tile * (size_t)ambulo__whole_tiles(u->n) * T;
}

static double *cross_of(const ambulo__update *u, int tile) {
  return u->cross + (size_t)tile * (size_t)u->border->width * T;
}

void ambulo__update_row(ambulo__update *u, const ambulo__sparse_rows *rows, int i, double weight) {
  for (int k = 0; k < u->taken; k++) {
    if (u->row[k] != i) continue;
    u->weight[k] += weight; /* a row that came goes, or the other way round: exactly zero */
    return;
  }
  if (u->taken == ROOM) {
    u->full = 1;
    return;
  }
  u->row[u->taken] = i;
  u->weight[u->taken++] = weight;
  u->rows = rows;
}

/* Z and T of a tile from its rows */
static void solve_tile(ambulo__update *u, int tile) {
  const ambulo__sparse_rows *rows = u->rows;
  ambulo__border *border = u->border;
  double *z = columns_of(u, tile), *cross = cross_of(u, tile);
  int columns = u->taken - tile * T < T ? u->taken - tile * T : T;
  memset(z, 0, (size_t)ambulo__whole_tiles(u->n) * T * sizeof *z);
  for (int c = 0; c < columns; c++) {
    int i = u->row[tile * T + c];
    const double *value = ambulo__sparse_rows_gradient(rows, i) - rows->start[i];
    for (int e = rows->start[i]; e < rows->start[i + 1]; e++) z[rows->column[e] * T + c] = value[e];
  }
  ambulo__band_forward_many(u->factor, T, z);
  if (border->count == 0) return;
  border->kernels->cross(u->n, border->width, border->columns, z, cross);
  for (int c = 0; c < T; c++) {
    for (int i = 0; i < border->count; i++) border->rest[i] = cross[i * T + c];
    ambulo__band_forward(&border->schur, border->rest);
    ambulo__band_backward(&border->schur, border->rest);
    for (int i = 0; i < border->count; i++) cross[i * T + c] = border->rest[i];
  }
  border->kernels->subtract(u->n, border->width, border->columns, cross, z);
}

/* Z'Z of a tile with those before it and with itself */
static void multiply_tile(ambulo__update *u, int tile) {
  double product[T * T] __attribute__((aligned(64)));
  for (int other = 0; other <= tile; other++) {
    u->border->kernels->cross(u->n, T, columns_of(u, tile), columns_of(u, other), product);
    for (int i = 0; i < T; i++)
      memcpy(u->products + (tile * T + i) * ROOM + other * T, product + i * T, T * sizeof *product);
  }
}

/* one row of L D L'; 1 when its pivot is rounding */
static int eliminate_row(ambulo__update *u, int i) {
  double *l = u->complement + i * ROOM;
  for (int j = 0; j < i; j++) {
    const double *above = u->complement + j * ROOM;
    for (int k = 0; k < j; k++) l[j] -= l[k] * above[k];
  }
  double pivot = l[i];
  for (int j = 0; j < i; j++) {
    double scaled = l[j] / u->complement[j * ROOM + j];
    pivot -= scaled * l[j];
    l[j] = scaled;
  }
  l[i] = pivot;
  double size = u->products[i * ROOM + i] + fabs(1.0 / u->weight[i]);
  return !(fabs(pivot) > AMBULO__HALF_DIGITS * size);
}

/* columns without a weight have a row of the unit matrix */
static int factor_complement(ambulo__update *u) {
  for (int i = 0; i < u->taken; i++) {
    double *l = u->complement + i * ROOM;
    int none = u->weight[i] == 0.0;
    for (int j = 0; j <= i; j++)
      l[j] = none || u->weight[j] == 0.0 ? 0.0 : u->products[i * ROOM + j];
    if (none) {
      l[i] = 1.0;
      continue;
    }
    l[i] += 1.0 / u->weight[i];
    if (eliminate_row(u, i)) return 1;
  }
  return 0;
}

int ambulo__update_factor(ambulo__update *u) {
  if (u->full) return 1;
  for (int tile = u->solved / T; tile * T < u->taken && u->solved < u->taken; tile++) {
    solve_tile(u, tile);
    multiply_tile(u, tile);
  }
  u->solved = u->taken;
  return factor_complement(u);
}

/* y from its right-hand side */
static void solve_complement(const ambulo__update *u, double *y) {
  for (int i = 0; i < u->taken; i++) {
    const double *l = u->complement + i * ROOM;
    for (int j = 0; j < i; j++) y[i] -= l[j] * y[j];
  }
  for (int i = 0; i < u->taken; i++) y[i] /= u->complement[i * ROOM + i];
  for (int i = u->taken - 1; i >= 0; i--) {
    const double *l = u->complement + i * ROOM;
    for (int j = 0; j < i; j++) y[j] -= l[j] * y[i];
  }
}

/* (P.14) the changed rows' part of a pass */
void ambulo__update_eliminate(ambulo__update *u, const double *b, double *z) {
  const ambulo__border *border = u->border;
  int tiles = (u->taken + T - 1) / T;
  double *y = u->rest;
  for (int tile = 0; tile < tiles; tile++)
    border->kernels->gather(u->n, T, columns_of(u, tile), z, y + tile * T);
  for (int c = 0; c < u->taken; c++) {
    const double *cross = cross_of(u, c / T) + c % T;
    for (int i = 0; b && i < border->count; i++) y[c] += cross[i * T] * b[i];
    if (u->weight[c] == 0.0) y[c] = 0.0;
  }
  for (int c = u->taken; c < tiles * T; c++) y[c] = 0.0;
  solve_complement(u, y);
  for (int tile = 0; tile < tiles; tile++) {
    border->kernels->scatter(u->n, T, columns_of(u, tile), y + tile * T, z);
    const double *cross = cross_of(u, tile);
    for (int i = 0; i < border->count; i++) {
      for (int c = 0; c < T; c++) border->rest[i] -= cross[i * T + c] * y[tile * T + c];
    }
  }
}
