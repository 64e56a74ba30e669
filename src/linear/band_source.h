/* linear/band_source.h - the text of a set of band kernels; included once by each
 * band_kernels_*.c after AMBULO__BAND_KERNELS, AMBULO__BAND_KERNELS_NAME, AMBULO__LARGEST_KD and
 * AMBULO__WIDTH, the numbers in a vector (8 or 4).
 *
 * Right-looking Cholesky by block columns of 8: factor the corner, X = A L^-T for the tiles
 * below, C -= X X' for the tiles to the right. Fill stays inside the band: the row i of a panel
 * is zero before column i - kd, and so are its products. The columns of a tile are aligned,
 * since ld - 1 is a multiple of 8.
 *
 * Solves: what waits in a triangular solve is the chain through the corners. Their inverses
 * (8 x 8, kept by columns and by rows) make each link one product.
 */
#include "linear/band_kernels.h"

#include <math.h>
#include <stddef.h>

enum { T = AMBULO__TILE, W = AMBULO__WIDTH };

typedef double wide __attribute__((vector_size(8 * AMBULO__WIDTH), may_alias));
typedef double loose __attribute__((vector_size(8 * AMBULO__WIDTH), may_alias, aligned(8)));

static inline wide load(const double *at) {
  return *(const wide *)at;
}

static inline void store(double *at, wide value) {
  *(wide *)at = value;
}

static int blocks_of(int n) {
  return (n + T - 1) / T;
}

/* tiles below the corner of block column `block` */
static int tiles_below(int n, int kd, int block) {
  int reach = (kd + T - 1) / T, left = blocks_of(n) - 1 - block;
  return reach < left ? reach : left;
}

/* L and the inverses of its diagonal elements; l is [column][row] */
static int factor_corner(double *a, size_t step, double l[T][T], double inverse[T]) {
  for (int c = 0; c < T; c++) {
    for (int i = c; i < T; i++) l[c][i] = a[(size_t)c * step + (size_t)i];
  }
  for (int c = 0; c < T; c++) {
    if (!(l[c][c] > 0.0)) return 1;
    l[c][c] = sqrt(l[c][c]);
    inverse[c] = 1.0 / l[c][c];
    for (int i = c + 1; i < T; i++) l[c][i] *= inverse[c];
    for (int k = c + 1; k < T; k++) {
      for (int i = k; i < T; i++) l[k][i] -= l[c][i] * l[c][k];
    }
  }
  for (int c = 0; c < T; c++) {
    for (int i = c; i < T; i++) a[(size_t)c * step + (size_t)i] = l[c][i];
  }
  return 0;
}

/* L^-1 by columns, then by rows */
static void invert_corner(double l[T][T], const double inverse[T], double *corner) {
  double *by_rows = corner + T * T;
  for (int c = 0; c < T; c++) {
    for (int i = 0; i < T; i++) {
      double sum = i == c ? 1.0 : 0.0;
      for (int k = c; k < i; k++) sum -= l[k][i] * corner[c * T + k];
      corner[c * T + i] = by_rows[i * T + c] = i < c ? 0.0 : sum * inverse[i];
    }
  }
}

/* W rows of the product of an 8 x 8 matrix and x, in two chains; columns at this distance */
static inline wide product(const double *columns, size_t step, const double x[T]) {
  wide even = load(columns) * x[0], odd = load(columns + step) * x[1];
  for (size_t c = 2; c < T; c += 2) {
    even += load(columns + c * step) * x[c];
    odd += load(columns + (c + 1) * step) * x[c + 1];
  }
  return even + odd;
}

/* numbers of two vectors, those of the second counted from W on */
#if defined(__clang__) || __GNUC__ >= 12
#define PICK(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#else
typedef long long places __attribute__((vector_size(8 * AMBULO__WIDTH)));
#define PICK(a, b, ...) __builtin_shuffle(a, b, (places){__VA_ARGS__})
#endif

/* the sums of W vectors, by halves: pairs, pairs of these, ... */
#if AMBULO__WIDTH == 8
static inline wide sum_of_pairs(wide a, wide b) {
  return PICK(a, b, 0, 8, 2, 10, 4, 12, 6, 14) + PICK(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
}

static inline wide sum_of_quarters(wide a, wide b) {
  return PICK(a, b, 0, 1, 8, 9, 4, 5, 12, 13) + PICK(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
}

static inline wide sums_of(const wide v[W]) {
  wide low = sum_of_quarters(sum_of_pairs(v[0], v[1]), sum_of_pairs(v[2], v[3]));
  wide high = sum_of_quarters(sum_of_pairs(v[4], v[5]), sum_of_pairs(v[6], v[7]));
  return PICK(low, high, 0, 1, 2, 3, 8, 9, 10, 11) + PICK(low, high, 4, 5, 6, 7, 12, 13, 14, 15);
}
#else
static inline wide sum_of_pairs(wide a, wide b) {
  return PICK(a, b, 0, 4, 2, 6) + PICK(a, b, 1, 5, 3, 7);
}

static inline wide sums_of(const wide v[W]) {
  wide low = sum_of_pairs(v[0], v[1]), high = sum_of_pairs(v[2], v[3]);
  return PICK(low, high, 0, 1, 4, 5) + PICK(low, high, 2, 3, 6, 7);
}
#endif

static inline double sum_of(wide v) {
  double part[W], sum = 0.0;
  for (int i = 0; i < W; i++) part[i] = v[i];
  for (int i = 0; i < W; i += 4) sum += (part[i] + part[i + 1]) + (part[i + 2] + part[i + 3]);
  return sum;
}

/* X L' = A for W rows of a tile */
static inline void solve_rows(double *a, size_t step, double l[T][T], const double inverse[T]) {
  wide x[T];
  for (size_t c = 0; c < T; c++) {
    wide v = load(a + c * step);
    for (size_t k = 0; k < c; k++) v -= x[k] * l[k][c];
    x[c] = v * inverse[c];
    store(a + c * step, x[c]);
  }
}

/* C -= X Y' for W rows of a tile, Y the tile of the rows that are C's columns */
static inline void update_rows(double *c, const double *x, const double *y, size_t step) {
  wide sum[T];
  for (size_t j = 0; j < T; j++) sum[j] = load(c + j * step);
  for (size_t k = 0; k < T; k++) {
    wide column = load(x + k * step);
    for (size_t j = 0; j < T; j++) sum[j] -= column * y[k * step + j];
  }
  for (size_t j = 0; j < T; j++) store(c + j * step, sum[j]);
}

/* the same on the diagonal: what is above it belongs to other columns and stays */
static inline void update_corner(double *c, const double *x, size_t step) {
  for (size_t j = 0; j < T; j++) {
    for (size_t h = j / W * W; h < T; h += W) {
      wide sum = load(x + h) * x[j];
      for (size_t k = 1; k < T; k++) sum += load(x + h + k * step) * x[k * step + j];
      for (size_t i = 0; i < W; i++) {
        if (h + i >= j) c[j * step + h + i] -= sum[i];
      }
    }
  }
}

/* the tiles below the corner of a block column, then those to the right of them */
static void update_tiles(double *corner, size_t ld, int tiles, double l[T][T],
                         const double inverse[T]) {
  size_t step = ld - 1;
  for (int i = T; i < (tiles + 1) * T; i += W) solve_rows(corner + i, step, l, inverse);
  for (int k = 1; k <= tiles; k++) {
    double *right = corner + (size_t)(k * T) * ld;
    const double *y = corner + k * T;
    update_corner(right, y, step);
    for (int i = T; i < (tiles + 1 - k) * T; i += W) update_rows(right + i, y + i, y, step);
  }
}

static int factor(int n, int kd, int ld, double *a, double *corners) {
  int blocks = blocks_of(n);
  for (int j = n; j < blocks * T; j++) a[(size_t)j * (size_t)ld] = 1.0;
  for (int block = 0; block < blocks; block++) {
    double l[T][T], inverse[T];
    double *corner = a + (size_t)(block * T) * (size_t)ld;
    if (factor_corner(corner, (size_t)ld - 1, l, inverse)) return 1;
    invert_corner(l, inverse, corners + (size_t)block * AMBULO__CORNER);
    update_tiles(corner, (size_t)ld, tiles_below(n, kd, block), l, inverse);
  }
  return 0;
}

static void forward(int n, int kd, int ld, const double *a, const double *corners, double *x) {
  size_t step = (size_t)ld - 1;
  for (int block = 0; block < blocks_of(n); block++) {
    const double *corner = a + (size_t)(block * T) * (size_t)ld;
    const double *inverse = corners + (size_t)block * AMBULO__CORNER;
    double *at = x + block * T, v[T];
    int rows = tiles_below(n, kd, block) * T;
    for (int c = 0; c < T; c++) v[c] = at[c];
    for (int h = 0; h < T; h += W) store(at + h, product(inverse + h, T, v));
    for (int c = 0; c < T; c++) v[c] = at[c];
    for (int i = T; i < T + rows; i += W)
      store(at + i, load(at + i) - product(corner + i, step, v));
  }
}

/* the elements of a corner on and below the diagonal; above it stand those of other columns */
static inline void take_corner(const double *a, size_t step, double l[T][T]) {
  for (size_t c = 0; c < T; c++) {
    for (size_t i = 0; i < T; i++) l[c][i] = i < c ? 0.0 : a[c * step + i];
  }
}

/* y = sums[0 .. 7] of the columns of a block: those below the corner, times x */
static inline void sums_below(const double *corner, size_t step, int rows, const double *x,
                              double *sums) {
  wide sum[T] = {{0}};
  for (int i = T; i < T + rows; i += W) {
    wide other = load(x + i);
    for (size_t c = 0; c < T; c++) sum[c] += load(corner + i + c * step) * other;
  }
  for (int c = 0; c < T; c += W) *(loose *)(sums + c) = sums_of(sum + c);
}

static void upper_multiply(int n, int kd, int ld, const double *a, double *x) {
  size_t step = (size_t)ld - 1;
  for (int block = 0; block < blocks_of(n); block++) {
    const double *corner = a + (size_t)(block * T) * (size_t)ld;
    double *at = x + block * T, l[T][T], sum[T];
    take_corner(corner, step, l);
    sums_below(corner, step, tiles_below(n, kd, block) * T, at, sum);
    for (int c = 0; c < T; c++) {
      for (int i = c; i < T; i++) sum[c] += l[c][i] * at[i];
    }
    for (int c = 0; c < T; c++) at[c] = sum[c];
  }
}

static void multiply(int n, int kd, int ld, const double *a, const double *x, double *y) {
  size_t step = (size_t)ld - 1;
  for (int j = 0; j < blocks_of(n) * T; j++) y[j] = 0.0;
  for (int block = 0; block < blocks_of(n); block++) {
    const double *corner = a + (size_t)(block * T) * (size_t)ld, *v = x + block * T;
    double *at = y + block * T, l[T][T], sum[T];
    int rows = tiles_below(n, kd, block) * T;
    take_corner(corner, step, l);
    sums_below(corner, step, rows, v, sum);
    for (int c = 0; c < T; c++) {
      for (int i = c; i < T; i++) sum[c] += l[c][i] * v[i];
      for (int i = 0; i < c; i++) sum[c] += l[i][c] * v[i];
    }
    for (int c = 0; c < T; c++) at[c] += sum[c];
    for (int i = T; i < T + rows; i += W)
      store(at + i, load(at + i) + product(corner + i, step, v));
  }
}

static void backward(int n, int kd, int ld, const double *a, const double *corners, double *x) {
  size_t step = (size_t)ld - 1;
  for (int block = blocks_of(n) - 1; block >= 0; block--) {
    const double *corner = a + (size_t)(block * T) * (size_t)ld;
    const double *inverse = corners + (size_t)block * AMBULO__CORNER + T * T;
    double *at = x + block * T, v[T];
    sums_below(corner, step, tiles_below(n, kd, block) * T, at, v);
    for (int c = 0; c < T; c++) v[c] = at[c] - v[c];
    for (int h = 0; h < T; h += W) store(at + h, product(inverse + h, T, v));
  }
}

/* W numbers of the 8 rows of one block of X: X_I = L_II^-1 (X_I - sum_J L_IJ X_J) */
static inline void forward_block(int block, int reach, size_t ld, const double *a,
                                 const double *by_rows, size_t width, double *x) {
  wide sum[T];
  double *rows = x + (size_t)(block * T) * width;
  for (size_t r = 0; r < T; r++) sum[r] = load(rows + r * width);
  for (int other = block - reach; other < block; other++) {
    const double *tile = a + (size_t)(other * T) * ld + (size_t)((block - other) * T);
    const double *above = x + (size_t)(other * T) * width;
    for (size_t c = 0; c < T; c++) {
      wide value = load(above + c * width);
      for (size_t r = 0; r < T; r++) sum[r] -= value * tile[c * (ld - 1) + r];
    }
  }
  for (size_t r = 0; r < T; r++) {
    wide value = sum[0] * by_rows[r * T];
    for (size_t c = 1; c <= r; c++) value += sum[c] * by_rows[r * T + c];
    store(rows + r * width, value);
  }
}

static void forward_many(int n, int kd, int ld, const double *a, const double *corners, int width,
                         double *x) {
  int most = (kd + T - 1) / T;
  for (int block = 0; block < blocks_of(n); block++) {
    const double *by_rows = corners + (size_t)block * AMBULO__CORNER + T * T;
    for (int v = 0; v < width; v += W)
      forward_block(block, most < block ? most : block, (size_t)ld, a, by_rows, (size_t)width,
                    x + v);
  }
}

#include "linear/wing_source.h"

const ambulo__band_kernels AMBULO__BAND_KERNELS = {.name = AMBULO__BAND_KERNELS_NAME,
                                                   .largest_kd = AMBULO__LARGEST_KD,
                                                   .factor = factor,
                                                   .forward = forward,
                                                   .backward = backward,
                                                   .upper_multiply = upper_multiply,
                                                   .multiply = multiply,
                                                   .forward_many = forward_many,
                                                   .gram = gram,
                                                   .add_gram = add_gram,
                                                   .cross = cross,
                                                   .subtract = subtract,
                                                   .gather = gather,
                                                   .scatter = scatter};
