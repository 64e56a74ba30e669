/* linear/product_source.h - the part of band_source.h on vectors, tiles of 8 x 8 and their
 * products: the one that factors and solves of many right-hand sides are made of, Gram matrices,
 * products with columns side by side, and the spread of a Gram matrix. Included by it alone.
 *
 * A product of a strip of rows with a few columns stays in registers over its whole depth, and is
 * stored once: what it reads of the caches is a vector or two and COLUMNS numbers for each step.
 * With the 32 registers of AVX-512 a strip is two tiles high and 8 columns wide, 16 sums; with 16
 * registers one tile and 4 columns, 8 sums: as many as two units with a latency of four steps have
 * under way. With vectors of two numbers a tile is 4 vectors high, and has 2 columns.
 *
 * Every set rounds alike, and a solve is the same on every processor: no product is fused with a
 * sum (Makefile), each number is summed in the same order whatever the width, and what is summed
 * along a vector is summed as if it had T lanes: ((0 + 1) + (2 + 3)) + ((4 + 5) + (6 + 7)).
 */

enum { T = AMBULO__TILE, W = AMBULO__WIDTH, V = T / W, COLUMNS = W, STRIP = W == 8 ? 2 : 1 };

typedef double wide __attribute__((vector_size(8 * AMBULO__WIDTH), may_alias));
typedef int64_t lanes __attribute__((vector_size(8 * AMBULO__WIDTH)));
typedef double loose __attribute__((vector_size(8 * AMBULO__WIDTH), may_alias, aligned(8)));

static inline wide load(const double *at) {
  return *(const wide *)at;
}

static inline void store(double *at, wide value) {
  *(wide *)at = value;
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
#define PICK(a, b, ...) __builtin_shuffle(a, b, (lanes){__VA_ARGS__})
#endif

#if AMBULO__WIDTH == 8
static const lanes counting = {0, 1, 2, 3, 4, 5, 6, 7};
#elif AMBULO__WIDTH == 4
static const lanes counting = {0, 1, 2, 3};
#else
static const lanes counting = {0, 1};
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
#elif AMBULO__WIDTH == 4
static inline wide sum_of_pairs(wide a, wide b) {
  return PICK(a, b, 0, 4, 2, 6) + PICK(a, b, 1, 5, 3, 7);
}

static inline wide sums_of(const wide v[W]) {
  wide low = sum_of_pairs(v[0], v[1]), high = sum_of_pairs(v[2], v[3]);
  return PICK(low, high, 0, 1, 4, 5) + PICK(low, high, 2, 3, 6, 7);
}
#else
static inline wide sums_of(const wide v[W]) {
  return PICK(v[0], v[1], 0, 2) + PICK(v[0], v[1], 1, 3);
}
#endif

/* sums of T lanes from the sums of V parts of them: V = 1, 2, 4 */
static inline wide joined(const wide part[V]) {
  wide sum = part[0];
  if (V > 1) sum += part[V > 1 ? 1 : 0];
  if (V > 2) sum += part[V > 2 ? 2 : 0] + part[V > 2 ? 3 : 0];
  return sum;
}

static inline double joined_one(const double part[V]) {
  double sum = part[0];
  if (V > 1) sum += part[V > 1 ? 1 : 0];
  if (V > 2) sum += part[V > 2 ? 2 : 0] + part[V > 2 ? 3 : 0];
  return sum;
}

static inline double sum_of(wide v) {
  double part[4] = {0.0}, sum = 0.0;
  enum { FOUR = W < 4 ? W : 4 };
  for (int from = 0; from < W; from += FOUR) {
    for (int i = 0; i < FOUR; i++) part[i] = v[from + i];
    sum += (part[0] + part[1]) + (part[2] + part[3]);
  }
  return sum;
}

/* loops of known length that neither compiler unrolls by itself, since their bounds depend on
 * others */
#if defined(__clang__)
#define UNROLLED _Pragma("unroll")
#else
#define UNROLLED _Pragma("GCC unroll 8")
#endif

/* for text that is compiled for each number of tiles, whose sums stay in registers */
#define ALWAYS static inline __attribute__((always_inline))

/* sums += X Y' of `tiles` tiles of rows and COLUMNS columns:
 * sums[v][c] += sum_k x[k x_step + v W ...] y[k y_step + c] */
ALWAYS void add_products(int tiles, size_t depth, const double *x, size_t x_step, const double *y,
                         size_t y_step, wide sums[][COLUMNS]) {
  for (size_t k = 0; k < depth; k++) {
    for (int v = 0; v < tiles * V; v++) {
      wide rows = load(x + k * x_step + v * W);
      for (int c = 0; c < COLUMNS; c++) sums[v][c] += rows * y[k * y_step + (size_t)c];
    }
  }
}

static int blocks_of(int n) {
  return (n + T - 1) / T;
}

/* the element in this row and column; those of one column follow each other */
static inline size_t place(int row, int column, size_t step) {
  return (size_t)column * step + (size_t)row;
}

/* ---------------------------------------------------------------- Gram matrices
 *
 * A += G'G, tile by tile of A's lower triangle. Gradients are zero on the limbs that they do not
 * concern, in half of all places of a whole body. Of such rows a tile takes those that have
 * something in both of its panels of 8 columns, which a bit for each row and panel says: of 45
 * coordinates about half. The bits are found for as many rows and panels at a time as have room on
 * the stack. */

/* adds sums to `there` columns of `tiles` tiles */
ALWAYS void add_sums(int tiles, int there, wide sums[][COLUMNS], size_t step, double *tile) {
  for (int c = 0; c < there; c++) {
    for (int v = 0; v < tiles * V; v++) *(loose *)(tile + (size_t)c * step + v * W) += sums[v][c];
  }
}

/* the same from column h of a corner on; what is above the diagonal belongs to other columns */
static inline void add_corner(int h, int there, wide sums[][COLUMNS], size_t step, double *tile) {
  UNROLLED for (int c = 0; c < COLUMNS; c++) {
    if (c >= there) break;
    for (int v = 0; v < V; v++) {
      lanes below = (lanes)(counting + v * W >= (lanes){0} + (h + c));
      *(loose *)(tile + (size_t)c * step + v * W) += (wide)((lanes)sums[v][c] & below);
    }
  }
}

/* how many of COLUMNS columns from one on there are */
static inline int columns_there(int width, int column) {
  return width - column < COLUMNS ? width - column : COLUMNS;
}

/* ------------------------------------------------------------ rows without zeros */

ALWAYS void add_strip(int tiles, int count, size_t stride, const double *g, int row, int column,
                      int there, size_t step, double *a) {
  wide sums[STRIP * V][COLUMNS] = {{{0}}};
  double *tile = a + place(row, column, step);
  add_products(tiles, (size_t)count, g + row, stride, g + column, stride, sums);
  if (row / T == column / T) {
    add_corner(column % T, there, sums, step, tile);
  } else {
    add_sums(tiles, there, sums, step, tile);
  }
}

static void add_gram(int count, int width, int stride, const double *g, int ld, double *a) {
  size_t step = (size_t)ld - 1;
  for (int column = 0; column < width; column += COLUMNS) {
    int there = columns_there(width, column), row = column / T * T, end = blocks_of(width) * T;
    add_strip(1, count, (size_t)stride, g, row, column, there, step, a);
    for (row += T; row + STRIP * T <= end; row += STRIP * T)
      add_strip(STRIP, count, (size_t)stride, g, row, column, there, step, a);
    if (row < end) add_strip(1, count, (size_t)stride, g, row, column, there, step, a);
  }
}

/* --------------------------------------------------------- rows of many zeros */

enum { BITS = 64, WORDS = 2, PANELS = 32 };

typedef uint64_t marks __attribute__((vector_size(8 * AMBULO__WIDTH)));

typedef struct gram {
  int count; /* rows, at most BITS * WORDS */
  size_t stride;
  const double *g;
  uint64_t use[PANELS][WORDS];     /* of the panels that are A's rows */
  const double *row[BITS * WORDS]; /* at the columns of a tile */
} gram;

/* bit k: row k is not zero in a panel, or not a number */
static void find_rows(const gram *m, int panel, uint64_t use[WORDS]) {
  for (int w = 0; w < WORDS; w++) {
    const double *row = m->g + (size_t)(w * BITS) * m->stride + (size_t)(panel * T);
    marks bits[V] = {{0}}, bit = (marks){0} + 1;
    int left = m->count - w * BITS, end = left < BITS ? left : BITS;
    for (int k = 0; k < end; k++, bit += bit, row += m->stride) {
      for (int v = 0; v < V; v++) bits[v] |= (marks)(load(row + v * W) != (wide){0}) & bit;
    }
    use[w] = 0;
    for (int i = 0; i < T; i++) use[w] |= bits[i / W][i % W];
  }
}

/* sums of a tile, `ahead` from its columns to its rows; by itself, for the registers */
static __attribute__((noinline)) void sum_tile(const gram *m, const uint64_t use[WORDS],
                                               const uint64_t own[WORDS], int ahead,
                                               wide sums[V][COLUMNS]) {
  wide sum[V][COLUMNS] = {{{0}}};
  for (int w = 0; w < WORDS; w++) {
    const double *const *rows = m->row + w * BITS;
    for (uint64_t both = use[w] & own[w]; both; both &= both - 1) {
      const double *row = rows[__builtin_ctzll(both)];
      add_products(1, 1, row + ahead, 0, row, 0, sum);
    }
  }
  for (int v = 0; v < V; v++) {
    for (int c = 0; c < COLUMNS; c++) sums[v][c] = sum[v][c];
  }
}

/* COLUMNS columns of A from `column` on, `there` of which are in A, on the panels [from, end) */
static void add_columns(gram *m, int column, int there, const uint64_t own[WORDS], int from,
                        int end, size_t step, double *a) {
  for (int k = 0; k < m->count; k++) m->row[k] = m->g + (size_t)k * m->stride + (size_t)column;
  for (int panel = from; panel < end; panel++) {
    wide sums[V][COLUMNS];
    double *tile = a + place(panel * T, column, step);
    sum_tile(m, m->use[panel % PANELS], own, panel * T - column, sums);
    if (panel == column / T) {
      add_corner(column % T, there, sums, step, tile);
    } else {
      add_sums(1, there, sums, step, tile);
    }
  }
}

/* the panels [from, end) of A's rows, whose rows in use are known */
static void add_panels(gram *m, int width, int from, int end, size_t step, double *a) {
  for (int panel = 0; panel < end; panel++) {
    uint64_t other[WORDS];
    const uint64_t *own = panel < from ? other : m->use[panel % PANELS];
    if (panel < from) find_rows(m, panel, other);
    for (int column = panel * T; column < (panel + 1) * T && column < width; column += COLUMNS)
      add_columns(m, column, columns_there(width, column), own, panel < from ? from : panel, end,
                  step, a);
  }
}

static void add_sparse_gram(int count, int width, int stride, const double *g, int ld, double *a) {
  int panels = blocks_of(width);
  gram m = {.stride = (size_t)stride};
  for (int k = 0; k < count; k += BITS * WORDS) {
    m.g = g + (size_t)k * m.stride;
    m.count = count - k < BITS * WORDS ? count - k : BITS * WORDS;
    for (int from = 0; from < panels; from += PANELS) {
      int end = from + PANELS < panels ? from + PANELS : panels;
      for (int panel = from; panel < end; panel++) find_rows(&m, panel, m.use[panel % PANELS]);
      add_panels(&m, width, from, end, (size_t)ld - 1, a);
    }
  }
}

/* ------------------------------------------- columns side by side, W [n][width] */

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

/* W rows times y, `there` of which there are */
static inline void row_products(size_t width, const double *rows, const double *y, size_t there,
                                wide sums[V][W]) {
  for (int v = 0; v < V; v++) {
    for (size_t r = 0; r < there; r++) sums[v][r] = (wide){0};
  }
  for (size_t i = 0; i < width; i += T) {
    for (int v = 0; v < V; v++) {
      wide other = load(y + i + (size_t)(v * W));
      for (size_t r = 0; r < there; r++)
        sums[v][r] += load(rows + r * width + i + (size_t)(v * W)) * other;
    }
  }
}

static void scatter(int n, int width, const double *w, const double *y, double *x) {
  size_t stride = (size_t)width, k = 0, end = (size_t)n;
  wide sums[V][W];
  for (; k + W <= end; k += W) {
    wide part[V];
    row_products(stride, w + k * stride, y, W, sums);
    for (int v = 0; v < V; v++) part[v] = sums_of(sums[v]);
    *(loose *)(x + k) -= joined(part);
  }
  for (; k < end; k++) {
    double part[V];
    row_products(stride, w + k * stride, y, 1, sums);
    for (int v = 0; v < V; v++) part[v] = sum_of(sums[v][0]);
    x[k] -= joined_one(part);
  }
}

/* ------------------------------------------- spread over control points (band.h) */

/* A += P' M P, m [3 d][step], column by column of M P */
static void spread(int d, int span, const double *const b[AMBULO__ORDERS], const double *m,
                   size_t step, double *restrict sums, int ld, double *restrict a) {
  for (int j = 0; j < d; j++) {
    const double *value = m + (size_t)j * step, *rate = value + (size_t)d * step;
    const double *acceleration = rate + (size_t)d * step;
    for (int right = 0; right < span; right++) {
      const double r0 = b[0][right], r1 = b[1][right], r2 = b[2][right];
      double *column = a + (size_t)(right * d + j) * (size_t)ld;
      for (int i = 0; i < AMBULO__ORDERS * d; i++)
        sums[i] = r0 * value[i] + r1 * rate[i] + r2 * acceleration[i];
      for (int left = right; left < span; left++) {
        const double b0 = b[0][left], b1 = b[1][left], b2 = b[2][left];
        double *block = column + (left - right) * d - j;
        for (int i = left == right ? j : 0; i < d; i++)
          block[i] += b0 * sums[i] + b1 * sums[d + i] + b2 * sums[2 * d + i];
      }
    }
  }
}
