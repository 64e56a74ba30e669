/* linear/band_source.h - the text of a set of band kernels; included once by each
 * band_kernels_*.c after AMBULO__BAND_KERNELS, AMBULO__BAND_KERNELS_NAME and AMBULO__WIDTH, the
 * numbers in a vector (8 or 4).
 *
 * Left-looking Cholesky by block columns of 8, within the profile: below[J] is how many tiles below
 * the corner of block column J anything stands in, which never ends higher than the column before
 * it. Fill stays inside, since the row block I of L begins where that of A does, at the first
 * column that reaches it (start_of): of a band of whole control points a third less work than the
 * full band for 4 of them, a sixth for 6. For each block column
 *
 *     C = A - sum_K L_IK L_JK'  for its corner (I = J) and strips of rows below,
 *     L_JJ of the corner,  L_IJ = C L_JJ^-T
 *
 * so that a tile is read once and written once, and its sums stay in registers (product_source.h).
 * The columns of a tile are aligned, since ld - 1 is a multiple of 8.
 *
 * Solves: what waits in a triangular solve is the chain through the corners. Their inverses
 * (8 x 8, kept by columns and by rows) make each link one product.
 */
#include "linear/band_kernels.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "linear/product_source.h"

/* ---------------------------------------------------------------- profile */

static int is_zero(const double *tile, size_t step) {
  lanes any[V] = {{0}};
  for (size_t c = 0; c < T; c++) {
    for (int v = 0; v < V; v++) any[v] |= (lanes)(load(tile + c * step + v * W) != (wide){0});
  }
  for (int v = 1; v < V; v++) any[0] |= any[v];
  for (int i = 0; i < W; i++) {
    if (any[0][i]) return 0;
  }
  return 1;
}

/* tiles below the corner of a block column within the band */
static int band_below(int n, int kd, int block) {
  int reach = (kd + T - 1) / T, left = blocks_of(n) - 1 - block;
  return reach < left ? reach : left;
}

/* below[block], those before it being known; tiles that they reach are not looked at */
static int tiles_below(int n, int kd, size_t step, const double *a, const int *below, int block) {
  int least = block > 0 && below[block - 1] > 0 ? below[block - 1] - 1 : 0;
  int tiles = band_below(n, kd, block);
  while (tiles > least && is_zero(a + place((block + tiles) * T, block * T, step), step)) tiles--;
  return tiles;
}

/* the first block column that reaches block row `row`, which is none before `first` */
static inline int start_of(const int *below, int first, int row) {
  while (first + below[first] < row) first++;
  return first;
}

/* ----------------------------------------------------------------- factor */

/* L in place and the inverses of its diagonal elements; l is [column][row]. What the next pivot
 * waits for is a quotient, a product and a difference; the root of this one is beside that. */
static int factor_corner(double l[T][T], double inverse[T]) {
  UNROLLED for (int c = 0; c < T; c++) {
    double pivot = l[c][c];
    if (!(pivot > 0.0)) return 1;
    double quotient = 1.0 / pivot;
    UNROLLED for (int k = c + 1; k < T; k++) {
      double factor = l[c][k] * quotient;
      UNROLLED for (int i = k; i < T; i++) l[k][i] -= l[c][i] * factor;
    }
    double root = sqrt(pivot);
    inverse[c] = 1.0 / root;
    l[c][c] = root;
    UNROLLED for (int i = c + 1; i < T; i++) l[c][i] *= inverse[c];
  }
  return 0;
}

/* L^-1 by columns, then by rows: row i is (e_i - sum_k l_ik row_k) / l_ii */
static void invert_corner(double l[T][T], const double inverse[T], double *corner) {
  wide row[T][V];
  double *by_rows = corner + T * T;
  UNROLLED for (int i = 0; i < T; i++) {
    UNROLLED for (int v = 0; v < V; v++) {
      wide sum = {0};
      if (i / W == v) sum[i % W] = 1.0;
      UNROLLED for (int k = 0; k < i; k++) sum -= row[k][v] * l[k][i];
      row[i][v] = sum * inverse[i];
      store(by_rows + i * T + v * W, row[i][v]);
    }
  }
  for (int c = 0; c < T; c++) {
    for (int i = 0; i < T; i++) corner[c * T + i] = by_rows[i * T + c];
  }
}

/* sums = the products of a strip of rows with COLUMNS columns, over the columns from the first that
 * reaches the rows up to `to` */
ALWAYS void strip_products(int tiles, const double *a, size_t step, const int *below, int start,
                           int row, int column, int to, wide sums[][COLUMNS]) {
  const double *x = a + row * T, *y = a + column;
  size_t from = (size_t)start * T, end = (size_t)to;
  for (int v = 0; v < tiles * V; v++) {
    for (int c = 0; c < COLUMNS; c++) sums[v][c] = (wide){0};
  }
  if (tiles > 1) { /* its second tile begins further right, and has no room for zeros there */
    size_t next = (size_t)start_of(below, start, row + 1) * T;
    add_products(1, next - from, x + from * step, step, y + from * step, step, sums);
    from = next;
  }
  add_products(tiles, end - from, x + from * step, step, y + from * step, step, sums);
}

/* X L' = A - sums for COLUMNS columns from h of the corner on, those before them being there */
ALWAYS void solve_strip(int tiles, double *at, size_t step, double l[T][T], const double inverse[T],
                        int h, wide sums[][COLUMNS]) {
  UNROLLED for (int v = 0; v < tiles * V; v++) {
    UNROLLED for (int c = 0; c < COLUMNS; c++) {
      wide x = load(at + (size_t)c * step + v * W) - sums[v][c];
      const double *before = at - (size_t)h * step + v * W;
      for (int k = 0; k < h; k++) x -= load(before + (size_t)k * step) * l[k][h + c];
      UNROLLED for (int k = 0; k < c; k++) x -= sums[v][k] * l[h + k][h + c];
      sums[v][c] = x * inverse[h + c];
      store(at + (size_t)c * step + v * W, sums[v][c]);
    }
  }
}

ALWAYS void factor_strip(int tiles, double *a, size_t step, const int *below, int start, int row,
                         int block, double l[T][T], const double inverse[T]) {
  for (int h = 0; h < T; h += COLUMNS) {
    wide sums[STRIP * V][COLUMNS];
    int column = block * T + h;
    strip_products(tiles, a, step, below, start, row, column, block * T, sums);
    solve_strip(tiles, a + place(row * T, column, step), step, l, inverse, h, sums);
  }
}

/* the corner less its products; what is above the diagonal means nothing */
static void take_products(const double *a, size_t step, const int *below, int start, int block,
                          double l[T][T]) {
  const double *corner = a + place(block * T, block * T, step);
  for (int h = 0; h < T; h += COLUMNS) {
    wide sums[V][COLUMNS];
    strip_products(1, a, step, below, start, block, block * T + h, block * T, sums);
    for (int c = 0; c < COLUMNS; c++) {
      for (int v = 0; v < V; v++) {
        const double *at = corner + (size_t)(h + c) * step + v * W;
        store(l[h + c] + v * W, load(at) - sums[v][c]);
      }
    }
  }
}

static int factor(int n, int kd, int ld, double *a, int *below, double *corners) {
  int blocks = blocks_of(n), first = 0;
  size_t step = (size_t)ld - 1;
  for (int j = n; j < blocks * T; j++) a[(size_t)j * (size_t)ld] = 1.0;
  for (int block = 0; block < blocks; block++) {
    double l[T][T] __attribute__((aligned(64))), inverse[T];
    double *corner = a + place(block * T, block * T, step);
    below[block] = tiles_below(n, kd, step, a, below, block);
    first = start_of(below, first, block);
    take_products(a, step, below, first, block, l);
    if (factor_corner(l, inverse)) return 1;
    for (int c = 0; c < T; c++) {
      for (int i = c; i < T; i++) corner[(size_t)c * step + (size_t)i] = l[c][i];
    }
    invert_corner(l, inverse, corners + (size_t)block * AMBULO__CORNER);
    int row = block + 1, end = row + below[block], start = first;
    for (; row + STRIP <= end; row += STRIP) {
      start = start_of(below, start, row);
      factor_strip(STRIP, a, step, below, start, row, block, l, inverse);
    }
    if (row < end)
      factor_strip(1, a, step, below, start_of(below, start, row), row, block, l, inverse);
  }
  return 0;
}

/* ----------------------------------------------------------------- solves */

static void forward(int n, int ld, const double *a, const int *below, const double *corners,
                    double *x) {
  size_t step = (size_t)ld - 1;
  for (int block = 0; block < blocks_of(n); block++) {
    const double *corner = a + (size_t)(block * T) * (size_t)ld;
    const double *inverse = corners + (size_t)block * AMBULO__CORNER;
    double *at = x + block * T, v[T];
    int rows = below[block] * T;
    for (int c = 0; c < T; c++) v[c] = at[c];
    for (int h = 0; h < T; h += W) store(at + h, product(inverse + h, T, v));
    for (int c = 0; c < T; c++) v[c] = at[c];
    for (int i = T; i < T + rows; i += W)
      store(at + i, load(at + i) - product(corner + i, step, v));
  }
}

/* sums[0 .. 7] of the columns of a block times x, from row `from` of its corner on: 0, or T for
 * what is below it. Above the diagonal of the corner are rows below the band of other columns:
 * zeros. */
static inline void sums_of_columns(const double *corner, size_t step, int from, int rows,
                                   const double *x, double *sums) {
  for (int h = 0; h < T; h += W) {
    wide sum[V][W] = {{{0}}}, part[V];
    for (int i = from; i < T + rows; i += T) {
      for (int v = 0; v < V; v++) {
        wide other = load(x + i + v * W);
        for (int c = 0; c < W; c++)
          sum[v][c] += load(corner + i + v * W + (size_t)(h + c) * step) * other;
      }
    }
    for (int v = 0; v < V; v++) part[v] = sums_of(sum[v]);
    *(loose *)(sums + h) = joined(part);
  }
}

static void upper_multiply(int n, int ld, const double *a, const int *below, double *x) {
  size_t step = (size_t)ld - 1;
  for (int block = 0; block < blocks_of(n); block++) {
    double *at = x + block * T, sums[T];
    sums_of_columns(a + place(block * T, block * T, step), step, 0, below[block] * T, at, sums);
    for (int c = 0; c < T; c++) at[c] = sums[c];
  }
}

static void multiply(int n, int kd, int ld, const double *a, const double *x, double *y) {
  size_t step = (size_t)ld - 1;
  for (int j = 0; j < blocks_of(n) * T; j++) y[j] = 0.0;
  for (int block = 0; block < blocks_of(n); block++) {
    const double *corner = a + place(block * T, block * T, step), *v = x + block * T;
    double *at = y + block * T, sums[T];
    int rows = band_below(n, kd, block) * T;
    sums_of_columns(corner, step, 0, rows, v, sums);
    for (int h = 0; h < T;
         h += W) { /* rows of the corner, which the sums had from the diagonal on */
      wide sum = load(at + h) + *(loose *)(sums + h);
      UNROLLED for (int c = 0; c < T; c++) {
        lanes strictly = (lanes)(counting + h > (lanes){0} + c);
        sum += (wide)((lanes)load(corner + h + (size_t)c * step) & strictly) * v[c];
      }
      store(at + h, sum);
    }
    for (int i = T; i < T + rows; i += W)
      store(at + i, load(at + i) + product(corner + i, step, v));
  }
}

static void backward(int n, int ld, const double *a, const int *below, const double *corners,
                     double *x) {
  size_t step = (size_t)ld - 1;
  for (int block = blocks_of(n) - 1; block >= 0; block--) {
    const double *corner = a + (size_t)(block * T) * (size_t)ld;
    const double *inverse = corners + (size_t)block * AMBULO__CORNER + T * T;
    double *at = x + block * T, v[T];
    sums_of_columns(corner, step, T, below[block] * T, at, v);
    for (int c = 0; c < T; c++) v[c] = at[c] - v[c];
    for (int h = 0; h < T; h += W) store(at + h, product(inverse + h, T, v));
  }
}

/* X_I = L_II^-1 (X_I - sum_K L_IK X_K) for `tiles` tiles of columns, the sums for COLUMNS rows at a
 * time */
ALWAYS void forward_block(int tiles, int block, int start, size_t step, const double *a,
                          const double *by_rows, size_t width, double *x) {
  size_t from = (size_t)start * T, row = (size_t)block * T;
  wide left[STRIP * V][T];
  double *at = x + row * width;
  for (int h = 0; h < T; h += COLUMNS) {
    wide sums[STRIP * V][COLUMNS] = {{{0}}};
    add_products(tiles, row - from, x + from * width, width, a + from * step + row + h, step, sums);
    UNROLLED for (int v = 0; v < tiles * V; v++) {
      UNROLLED for (int r = 0; r < COLUMNS; r++) left[v][h + r] =
          load(at + (size_t)(h + r) * width + v * W) - sums[v][r];
    }
  }
  UNROLLED for (int v = 0; v < tiles * V; v++) {
    UNROLLED for (int r = 0; r < T; r++) {
      wide value = left[v][0] * by_rows[r * T];
      UNROLLED for (int c = 1; c <= r; c++) value += left[v][c] * by_rows[r * T + c];
      store(at + (size_t)r * width + v * W, value);
    }
  }
}

/* Block columns of zeros lead to zeros. */
static int leading_zeros(int n, int width, const double *x) {
  size_t count = (size_t)n * (size_t)width, k = 0;
  while (k < count && x[k] == 0.0) k++; /* NaN is none */
  return (int)(k / (size_t)width) / T;
}

static void forward_many(int n, int ld, const double *a, const int *below, const double *corners,
                         int width, double *x) {
  int first = leading_zeros(n, width, x), start = 0;
  for (int block = first; block < blocks_of(n); block++) {
    const double *by_rows = corners + (size_t)block * AMBULO__CORNER + T * T;
    start = start_of(below, start, block);
    int from = start > first ? start : first, v = 0;
    for (; v + STRIP * T <= width; v += STRIP * T)
      forward_block(STRIP, block, from, (size_t)ld - 1, a, by_rows, (size_t)width, x + v);
    if (v < width) forward_block(1, block, from, (size_t)ld - 1, a, by_rows, (size_t)width, x + v);
  }
}

const ambulo__band_kernels AMBULO__BAND_KERNELS = {.name = AMBULO__BAND_KERNELS_NAME,
                                                   .factor = factor,
                                                   .forward = forward,
                                                   .backward = backward,
                                                   .upper_multiply = upper_multiply,
                                                   .multiply = multiply,
                                                   .forward_many = forward_many,
                                                   .add_gram = add_gram,
                                                   .add_sparse_gram = add_sparse_gram,
                                                   .spread = spread,
                                                   .cross = cross,
                                                   .subtract = subtract,
                                                   .gather = gather,
                                                   .scatter = scatter};
