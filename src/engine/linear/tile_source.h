/* linear/tile_source.h - the part of band_source.h on vectors and tiles of 8 x 8: sums of vectors,
 * and the one product that factors, solves of many right-hand sides and Gram matrices are made of.
 * Included by it alone.
 *
 * A product of a strip of rows with a few columns stays in registers over its whole depth, and is
 * stored once: what it reads of the caches is a vector or two and COLUMNS numbers for each step.
 * With the 32 registers of AVX-512 a strip is two tiles high and 8 columns wide, 16 sums; with 16
 * registers one tile and 4 columns, 8 sums: as many as two units with a latency of four steps have
 * under way.
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
#else
static const lanes counting = {0, 1, 2, 3};
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
