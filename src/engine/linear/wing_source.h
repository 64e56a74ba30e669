/* linear/wing_source.h - the part of band_source.h on matrices W [n][width] of columns side by
 * side: products with eight columns, with a vector. Included by it alone. */

/* W numbers of 8 rows of Y = W'X */
static inline void cross_rows(int n, size_t width, const double *w, const double *x, double *y) {
  wide sum[T] = {{0}};
  for (size_t k = 0; k < (size_t)n; k++) {
    wide value = load(x + k * T);
    for (size_t r = 0; r < T; r++) sum[r] += value * w[k * width + r];
  }
  for (size_t r = 0; r < T; r++) store(y + r * T, sum[r]);
}

static void cross(int n, int width, const double *w, const double *x, double *y) {
  for (int i = 0; i < width; i += T) {
    for (int v = 0; v < T; v += W) cross_rows(n, (size_t)width, w + i, x + v, y + i * T + v);
  }
}

/* W numbers of 8 rows of X -= W Y */
static inline void subtract_rows(size_t width, const double *w, const double *y, double *x) {
  wide sum[T];
  for (size_t r = 0; r < T; r++) sum[r] = load(x + r * T);
  for (size_t i = 0; i < width; i++) {
    wide value = load(y + i * T);
    for (size_t r = 0; r < T; r++) sum[r] -= value * w[r * width + i];
  }
  for (size_t r = 0; r < T; r++) store(x + r * T, sum[r]);
}

/* rows of W and X beyond n are there, and X's stay zero (band_kernels.h) */
static void subtract(int n, int width, const double *w, const double *y, double *x) {
  size_t stride = (size_t)width;
  for (size_t k = 0; k < (size_t)blocks_of(n) * T; k += T) {
    for (size_t v = 0; v < T; v += W) subtract_rows(stride, w + k * stride, y + v, x + k * T + v);
  }
}

/* four sums side by side, since one waits for itself */
static void gather(int n, int width, const double *w, const double *x, double *y) {
  const size_t stride = (size_t)width, end = (size_t)n;
  for (size_t v = 0; v < stride; v += W) {
    const double *column = w + v;
    wide sum[4] = {{0}};
    size_t k = 0;
    for (; k + 4 <= end; k += 4, column += 4 * stride) {
      for (size_t l = 0; l < 4; l++) sum[l] += load(column + l * stride) * x[k + l];
    }
    for (; k < end; k++, column += stride) sum[0] += load(column) * x[k];
    store(y + v, (sum[0] + sum[1]) + (sum[2] + sum[3]));
  }
}

static inline wide row_product(size_t width, const double *row, const double *y) {
  wide sum = load(row) * load(y);
  for (size_t v = W; v < width; v += W) sum += load(row + v) * load(y + v);
  return sum;
}

static void scatter(int n, int width, const double *w, const double *y, double *x) {
  size_t stride = (size_t)width, k = 0, end = (size_t)n;
  for (; k + W <= end; k += W) {
    wide row[W];
    for (size_t r = 0; r < W; r++) row[r] = row_product(stride, w + (k + r) * stride, y);
    *(loose *)(x + k) -= sums_of(row);
  }
  for (; k < end; k++) x[k] -= sum_of(row_product(stride, w + k * stride, y));
}
