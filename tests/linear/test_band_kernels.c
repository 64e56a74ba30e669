/* The kernels of each instruction set against LAPACK and plain sums, on sizes that fill no tile. */
#include "mechanics/plan.h"
#include "ambulo/mechanics.h"
#include "base/lapack.h"
#include "linear/band.h"
#include "support/engine_fixture.h"

#include <math.h>

typedef struct sizes {
  int n, kd;
  int stair; /* columns that end together, the first of them at the band's edge; 0: all end there;
                LONE: few do, the others are a diagonal */
} sizes;

enum { LONE = -1, LONE_PERIOD = 19 };

static const sizes cases[] = {{270, 53, 18},  {270, 71, 18},  {203, 95, 0},
                              {378, 125, 21}, {60, 59, 0},    {133, 131, 44},
                              {97, 300, 0},   {150, 140, 47}, {150, 60, LONE}};
static const int widths[] = {0, 1, 3, 7, 8, 9, 15, 16, 17, 23, 24, 31};
enum {
  CASES = sizeof cases / sizeof *cases,
  WIDTHS = sizeof widths / sizeof *widths,
  LARGEST = 33,
  WIDTH = 24
};

/* the last row of a column that is not zero */
static int end_of(const ambulo__band *band, int stair, int j) {
  int end = j + band->kd;
  if (stair > 0) end = j / stair * stair + band->kd;
  if (stair == LONE && j % LONE_PERIOD) end = j;
  return end < band->n ? end : band->n - 1;
}

static void fill(ambulo__band *band, int stair) {
  for (int j = 0; j < band->n; j++) {
    double *column = band->a + (size_t)j * (size_t)band->ld;
    column[0] = 2.5;
    for (int k = 1; j + k <= end_of(band, stair, j); k++)
      column[k] = sin(0.7 * j + k) / (double)(band->kd + 1);
  }
}

/* tiles below the corners are no more than those that columns up to there come to */
static void profile_is_the_matrix(const ambulo__band *band, int stair) {
  int end = 0;
  for (int j = 0; j < band->n; j++) {
    if (end_of(band, stair, j) > end) end = end_of(band, stair, j);
    if (j + 1 < band->n && (j + 1) % AMBULO__TILE) continue;
    assert_int_equal(band->below[j / AMBULO__TILE], end / AMBULO__TILE - j / AMBULO__TILE);
  }
}

/* y = A x and y = L' x from the band, column by column */
static void plain_products(const ambulo__band *band, const double *x, double *product,
                           double *upper) {
  memset(product, 0, (size_t)band->n * sizeof *product);
  for (int j = 0; j < band->n; j++) {
    const double *column = band->a + (size_t)j * (size_t)band->ld;
    product[j] += column[0] * x[j];
    upper[j] = column[0] * x[j];
    for (int k = 1; k <= band->kd && j + k < band->n; k++) {
      product[j] += column[k] * x[j + k];
      product[j + k] += column[k] * x[j];
      upper[j] += column[k] * x[j + k];
    }
  }
}

static void solve_by_lapack(const ambulo__band *l, const char *trans, double *x, int step) {
  dtbsv_("L", trans, "N", &l->n, &l->kd, l->a, &l->ld, x, &step);
}

typedef struct pair {
  ambulo__band ours, theirs;
  double *x, *y, *columns, *other; /* [n], [n]; [n rounded up][WIDTH] */
} pair;

/* solves with factors that are there */
static void solves_are_lapacks(const pair *p) {
  const size_t n = (size_t)p->ours.n;
  for (size_t i = 0; i < n; i++) p->x[i] = p->y[i] = cos((double)i);
  ambulo__band_forward(&p->ours, p->x);
  solve_by_lapack(&p->theirs, "N", p->y, 1);
  for (size_t i = 0; i < n; i++) assert_close(p->x[i], p->y[i], 1e-13);
  ambulo__band_backward(&p->ours, p->x);
  solve_by_lapack(&p->theirs, "T", p->y, 1);
  for (size_t i = 0; i < n; i++) assert_close(p->x[i], p->y[i], 1e-13);
  for (size_t zeros = 0; zeros < n; zeros += 1 + n / 3) { /* rows of them before the first */
    for (size_t i = 0; i < n * WIDTH; i++)
      p->columns[i] = p->other[i] = i < zeros * WIDTH ? 0.0 : cos(0.1 * (double)i);
    ambulo__band_forward_many(&p->ours, WIDTH, p->columns);
    for (int k = 0; k < WIDTH; k++) solve_by_lapack(&p->theirs, "N", p->other + k, WIDTH);
    for (size_t i = 0; i < n * WIDTH; i++) assert_close(p->columns[i], p->other[i], 1e-13);
  }
  plain_products(&p->theirs, p->y, p->columns, p->other);
  ambulo__band_upper_multiply(&p->ours, p->x);
  for (size_t i = 0; i < n; i++) assert_close(p->x[i], p->other[i], 1e-13);
}

static void equals_lapack(const ambulo__band_kernels *set, sizes size) {
  ambulo__pool pool;
  pair p;
  int info;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__band_create(&pool, size.n, size.kd, &p.ours), AMBULO_OK);
  assert_int_equal(ambulo__band_create(&pool, size.n, size.kd, &p.theirs), AMBULO_OK);
  size_t n = (size_t)size.n, padded = (size_t)ambulo__whole_tiles(size.n);
  p.x = ambulo__pool_doubles(&pool, n);
  p.y = ambulo__pool_doubles(&pool, n);
  p.columns = ambulo__pool_doubles(&pool, padded * WIDTH);
  p.other = ambulo__pool_doubles(&pool, padded * WIDTH);
  p.ours.kernels = set;
  for (int twice = 0; twice < 2; twice++) { /* the second time over the first one's remains */
    ambulo__band_clear(&p.ours);
    ambulo__band_clear(&p.theirs);
    fill(&p.ours, size.stair);
    fill(&p.theirs, size.stair);
    for (size_t i = 0; i < n; i++) p.y[i] = sin((double)i);
    plain_products(&p.theirs, p.y, p.other, p.x);
    ambulo__band_multiply(&p.ours, p.y, p.columns);
    for (size_t i = 0; i < n; i++) assert_close(p.columns[i], p.other[i], 1e-13);
    assert_int_equal(ambulo__band_factor(&p.ours), 0);
    dpbtrf_("L", &p.theirs.n, &p.theirs.kd, p.theirs.a, &p.theirs.ld, &info);
    assert_int_equal(info, 0);
    profile_is_the_matrix(&p.ours, size.stair);
    for (size_t i = 0; i < n * (size_t)p.ours.ld; i++)
      assert_close(p.ours.a[i], p.theirs.a[i], 1e-14);
    solves_are_lapacks(&p);
  }
  p.ours.a[(n - 1) * (size_t)p.ours.ld] = -1.0;
  assert_int_equal(ambulo__band_factor(&p.ours), 1);
  fill(&p.ours, size.stair);
  p.ours.a[0] = NAN;
  assert_int_equal(ambulo__band_factor(&p.ours), 1);
  ambulo__pool_clear(&pool);
}

/* what a row has in a column: nothing in about half of the panels */
static double sparse(size_t row, size_t column) {
  size_t panel = column / 8;
  return (row * 5 + panel * 3) % 7 < 3 ? 0.0 : sin(1.0 + 0.7 * (double)row + 0.3 * (double)column);
}

typedef void gram_function(int count, int width, int stride, const double *g, int ld, double *a);

/* A += G'G at unknown `first` of a band of n, by rows of half zeros; nothing else changes */
static void gram_is_plain_sums(gram_function *add, int n, int first, int width, int count) {
  ambulo__pool pool;
  ambulo__band band;
  ambulo__pool_init(&pool, NULL);
  size_t stride = (size_t)ambulo__whole_tiles(width) + 8;
  double *g = ambulo__pool_doubles(&pool, (size_t)count * stride);
  assert_int_equal(ambulo__band_create(&pool, n, width - 1, &band), AMBULO_OK);
  size_t size = (size_t)n * (size_t)band.ld, last = (size_t)(first + width) * (size_t)band.ld;
  for (size_t k = 0; k < (size_t)count; k++) {
    for (size_t j = 0; j < (size_t)width; j++) g[k * stride + j] = sparse(k, j);
  }
  for (size_t e = 0; e < size; e++) band.a[e] = e < last ? 77.0 : -0.0; /* -0 + 0 is 0 */
  add(count, width, (int)stride, g, band.ld, band.a + (size_t)first * (size_t)band.ld);
  for (size_t e = last; e < size; e++) assert_true(signbit(band.a[e]));
  for (int j = 0; j < first + width; j++) {
    for (int i = 0; i < band.ld; i++) {
      double sum = 77.0;
      int there = j >= first && j < first + width && j + i < first + width;
      for (int k = 0; there && k < count; k++)
        sum += sparse((size_t)k, (size_t)(j + i - first)) * sparse((size_t)k, (size_t)(j - first));
      assert_close(band.a[(size_t)j * (size_t)band.ld + (size_t)i], sum, there ? 1e-13 : 0.0);
    }
  }
  ambulo__pool_clear(&pool);
}

/* a row without a number is in no tile forgotten */
static void gram_keeps_what_is_not_finite(gram_function *add) {
  ambulo__pool pool;
  ambulo__band band;
  ambulo__pool_init(&pool, NULL);
  double *g = ambulo__pool_doubles(&pool, 24);
  assert_int_equal(ambulo__band_create(&pool, 24, 23, &band), AMBULO_OK);
  g[11] = NAN;
  add(1, 24, 24, g, band.ld, band.a);
  assert_true(isnan(band.a[11 * (size_t)band.ld]));
  ambulo__pool_clear(&pool);
}

/* W [n][width] of a set against plain sums */
static void products_are_plain_sums(const ambulo__band_kernels *set, int n, int width) {
  ambulo__pool pool;
  ambulo__pool_init(&pool, NULL);
  size_t columns = (size_t)width, rows = (size_t)n;
  double *w = ambulo__pool_doubles(&pool, rows * columns);
  double *x = ambulo__pool_doubles(&pool, rows), *y = ambulo__pool_doubles(&pool, columns);
  for (size_t e = 0; e < rows * columns; e++) w[e] = sin(1.0 + 0.7 * (double)e);
  for (size_t k = 0; k < rows; k++) x[k] = cos(0.3 * (double)k);
  for (size_t j = 0; j < columns; j++) y[j] = 77.0;
  set->gather(n, width, w, x, y);
  for (size_t j = 0; j < columns; j++) {
    double sum = 0.0;
    for (size_t k = 0; k < rows; k++) sum += w[k * columns + j] * x[k];
    assert_close(y[j], sum, 1e-13);
  }
  set->scatter(n, width, w, y, x);
  for (size_t k = 0; k < rows; k++) {
    double sum = cos(0.3 * (double)k);
    for (size_t j = 0; j < columns; j++) sum -= w[k * columns + j] * y[j];
    assert_close(x[k], sum, 1e-12);
  }
  ambulo__pool_clear(&pool);
}

/* W [n][width], X [n][8], both with room for n rounded up: Y = W'X, X -= W Y */
static void eight_columns_at_once(const ambulo__band_kernels *set, int n, int width) {
  ambulo__pool pool;
  ambulo__pool_init(&pool, NULL);
  size_t columns = (size_t)width, rows = (size_t)n, padded = (size_t)ambulo__whole_tiles(n);
  double *w = ambulo__pool_doubles(&pool, padded * columns);
  double *x = ambulo__pool_doubles(&pool, padded * 8);
  double *y = ambulo__pool_doubles(&pool, columns * 8);
  for (size_t e = 0; e < rows * columns; e++) w[e] = sin(1.0 + 0.7 * (double)e);
  for (size_t e = 0; e < rows * 8; e++) x[e] = cos(0.3 * (double)e);
  for (size_t e = 0; e < columns * 8; e++) y[e] = 77.0;
  set->cross(n, width, w, x, y);
  for (size_t e = 0; e < columns * 8; e++) {
    double sum = 0.0;
    for (size_t k = 0; k < rows; k++) sum += w[k * columns + e / 8] * x[k * 8 + e % 8];
    assert_close(y[e], sum, 1e-13);
  }
  set->subtract(n, width, w, y, x);
  for (size_t e = 0; e < padded * 8; e++) {
    double sum = e < rows * 8 ? cos(0.3 * (double)e) : 0.0;
    for (size_t j = 0; j < columns; j++) sum -= w[e / 8 * columns + j] * y[j * 8 + e % 8];
    assert_close(x[e], sum, 1e-12);
  }
  ambulo__pool_clear(&pool);
}

static void test_gram(gram_function *add) {
  for (int width = 1; width <= LARGEST; width++)
    gram_is_plain_sums(add, width + 10, width % 11, width, 1 + 3 * (width % 5));
  gram_is_plain_sums(add, 290, 3, 285, 5); /* more panels than are known at once */
  gram_is_plain_sums(add, 40, 5, 30, 64);  /* words of rows */
  gram_is_plain_sums(add, 60, 1, 45, 300); /* more rows than at once */
  gram_keeps_what_is_not_finite(add);
}

static void test_set(const ambulo__band_kernels *set, int runs) {
  if (!runs || !set->factor) skip();
  for (int i = 0; i < CASES; i++) equals_lapack(set, cases[i]);
  for (int n = 1; n <= LARGEST; n++) { /* all remainders of tiles, and of strips of two */
    for (int i = 0; i < WIDTHS; i++)
      equals_lapack(set, (sizes){n, widths[i], n % 3 ? 0 : 1 + widths[i] / 3});
    products_are_plain_sums(set, n, 8 * (1 + n % 7));
    eight_columns_at_once(set, n, 8 * (1 + n % 7));
  }
  test_gram(set->add_gram);
  test_gram(set->add_sparse_gram);
}

static void baseline_equals_lapack(void **state) {
  (void)state;
  test_set(&ambulo__band_kernels_baseline, 1);
}

static void avx2_equals_lapack(void **state) {
  (void)state;
#if defined(__x86_64__)
  test_set(&ambulo__band_kernels_avx2,
           __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"));
#else
  skip();
#endif
}

static void avx512_equals_lapack(void **state) {
  (void)state;
#if defined(__x86_64__)
  test_set(&ambulo__band_kernels_avx512, __builtin_cpu_supports("avx512f"));
#else
  skip();
#endif
}

static void the_environment_chooses(void **state) {
  (void)state;
  setenv("AMBULO_ISA", "baseline", 1);
  assert_ptr_equal(ambulo__band_kernels_select(), &ambulo__band_kernels_baseline);
  unsetenv("AMBULO_ISA");
  assert_string_equal(ambulo__band_kernels_select()->name, ambulo__instruction_set());
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(baseline_equals_lapack),
      cmocka_unit_test(avx2_equals_lapack),
      cmocka_unit_test(avx512_equals_lapack),
      cmocka_unit_test(the_environment_chooses),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
