/* linear/band.c - see band.h. */
#include "linear/band.h"
#include "base/lapack.h"
#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

enum { BLOCK = 24 }; /* columns that ambulo__band_forward_many takes at once */

ambulo_status ambulo__band_create(ambulo__pool *pool, int n, int kd, ambulo__band *band) {
  band->n = n;
  band->kd = kd < n ? kd : n - 1;
  band->kernels = ambulo__band_kernels_select();
  band->ld = ambulo__whole_tiles(band->kd + (band->kernels ? AMBULO__TILE : BLOCK)) + 1;
  band->a = ambulo__pool_doubles(pool, (size_t)ambulo__whole_tiles(n) * (size_t)band->ld);
  band->corner = NULL;
  band->below = NULL;
  if (band->kernels) {
    size_t tiles = (size_t)ambulo__whole_tiles(n) / AMBULO__TILE;
    band->corner = ambulo__pool_doubles(pool, tiles * AMBULO__CORNER);
    band->below = ambulo__pool_ints(pool, tiles);
  }
  band->work = ambulo__pool_doubles(pool, 2 * (size_t)ambulo__whole_tiles(n));
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

void ambulo__band_copy_factor(const ambulo__band *from, ambulo__band *to) {
  size_t tiles = (size_t)ambulo__whole_tiles(to->n) / AMBULO__TILE;
  ambulo__band_copy(from, to);
  if (!to->kernels) return;
  memcpy(to->corner, from->corner, tiles * AMBULO__CORNER * sizeof *to->corner);
  memcpy(to->below, from->below, tiles * sizeof *to->below);
}

void ambulo__band_add_diagonal(ambulo__band *band, double value) {
  for (int j = 0; j < band->n; j++) band->a[(size_t)j * (size_t)band->ld] += value;
}

void ambulo__band_add_rows(ambulo__band *band, int first, int width, int count, int stride,
                           const double *g) {
  if (count == 0) return;
  double one = 1.0, *a = band->a + (size_t)first * (size_t)band->ld;
  int ld = band->ld - 1;
  if (band->kernels) {
    band->kernels->add_gram(count, width, stride, g, band->ld, a);
  } else { /* g is [count][stride] row-major, that is stride x count column-major */
    dsyrk_("L", "N", &width, &count, &one, g, &stride, &one, a, &ld);
  }
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

/* four sums side by side, since one waits for itself */
static double dot(int count, const double *restrict a, const double *restrict b) {
  double sum[4] = {0.0};
  int k = 0;
  for (; k + 4 <= count; k += 4) {
    for (int l = 0; l < 4; l++) sum[l] += a[k + l] * b[k + l];
  }
  for (; k < count; k++) sum[0] += a[k] * b[k];
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* elements of column j on and below the diagonal */
static int height(const ambulo__band *band, int j) {
  return band->n - j <= band->kd ? band->n - j : band->kd + 1;
}

int ambulo__band_factor(ambulo__band *band) {
  int info = 0;
  if (band->kernels)
    return band->kernels->factor(band->n, band->kd, band->ld, band->a, band->below, band->corner);
  dpbtrf_("L", &band->n, &band->kd, band->a, &band->ld, &info);
  /* its pivots are asked to be at most zero, which NaN is not */
  for (int j = 0; j < band->n && info == 0; j++)
    info = !isfinite(band->a[(size_t)j * (size_t)band->ld]);
  return info != 0;
}

/* Zeros in the padding, each time: an infinite right-hand side leaves NaN there. */
static void take_right_side(const ambulo__band *l, const double *x) {
  size_t n = (size_t)l->n, padding = (size_t)ambulo__whole_tiles(l->n) - n;
  memcpy(l->work, x, n * sizeof *x);
  memset(l->work + n, 0, padding * sizeof *x);
}

/* not by dsbmv and dtbmv, which start threads for matrices of this size */
void ambulo__band_multiply(const ambulo__band *band, const double *x, double *y) {
  size_t padded = (size_t)ambulo__whole_tiles(band->n);
  if (band->kernels) {
    take_right_side(band, x);
    band->kernels->multiply(band->n, band->kd, band->ld, band->a, band->work, band->work + padded);
    memcpy(y, band->work + padded, (size_t)band->n * sizeof *y);
    return;
  }
  memset(y, 0, (size_t)band->n * sizeof *y);
  for (int j = 0; j < band->n; j++) {
    const double *column = band->a + (size_t)j * (size_t)band->ld;
    int rows = height(band, j);
    y[j] += dot(rows, column, x + j);
    add_scaled(rows - 1, x[j], column + 1, y + j + 1);
  }
}

void ambulo__band_forward(const ambulo__band *l, double *x) {
  size_t bytes = (size_t)l->n * sizeof *x;
  int step = 1;
  if (l->kernels) {
    take_right_side(l, x);
    l->kernels->forward(l->n, l->ld, l->a, l->below, l->corner, l->work);
    memcpy(x, l->work, bytes);
  } else {
    dtbsv_("L", "N", "N", &l->n, &l->kd, l->a, &l->ld, x, &step);
  }
}

void ambulo__band_backward(const ambulo__band *l, double *x) {
  size_t bytes = (size_t)l->n * sizeof *x;
  int step = 1;
  if (l->kernels) {
    take_right_side(l, x);
    l->kernels->backward(l->n, l->ld, l->a, l->below, l->corner, l->work);
    memcpy(x, l->work, bytes);
  } else {
    dtbsv_("L", "T", "N", &l->n, &l->kd, l->a, &l->ld, x, &step);
  }
}

void ambulo__band_upper_multiply(const ambulo__band *l, double *x) {
  if (l->kernels) {
    take_right_side(l, x);
    l->kernels->upper_multiply(l->n, l->ld, l->a, l->below, l->work);
    memcpy(x, l->work, (size_t)l->n * sizeof *x);
    return;
  }
  for (int j = 0; j < l->n; j++) x[j] = dot(height(l, j), l->a + (size_t)j * (size_t)l->ld, x + j);
}

/* Block columns: X_1 = L_11^-1 X_1, X_2 -= L_21 X_1, the blocks read from the band with
 * leading dimension ld - 1; to LAPACK, which counts by columns, X is its transpose. */
void ambulo__band_forward_many(const ambulo__band *l, int width, double *x) {
  if (l->kernels) {
    l->kernels->forward_many(l->n, l->ld, l->a, l->below, l->corner, width, x);
    return;
  }
  double one = 1.0, minus = -1.0;
  int ld = l->ld - 1;
  int block = ld - l->kd < BLOCK ? ld - l->kd : BLOCK; /* below it, ld - 1 reads the right rows */
  for (int j = 0; j < l->n; j += block) {
    int columns = l->n - j < block ? l->n - j : block;
    int below = l->n - j - columns < l->kd ? l->n - j - columns : l->kd;
    const double *corner = l->a + (size_t)j * (size_t)l->ld;
    double *rows = x + (size_t)j * (size_t)width;
    dtrsm_("R", "L", "T", "N", &width, &columns, &one, corner, &ld, rows, &width);
    if (below == 0) continue;
    dgemm_("N", "T", &width, &below, &columns, &minus, rows, &width, corner + columns, &ld, &one,
           rows + (size_t)columns * (size_t)width, &width);
  }
}
