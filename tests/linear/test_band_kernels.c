/* The kernels of each instruction set against LAPACK, on sizes that fill no tile. */
#include "ambulo/mechanics.h"
#include "linear/band.h"
#include "support/engine_fixture.h"

#include <math.h>

typedef struct sizes {
  int n, kd;
} sizes;

static const sizes cases[] = {{1, 0},   {5, 4},    {8, 7},    {9, 3},    {31, 6},  {64, 16},
                              {71, 70}, {270, 53}, {270, 71}, {203, 95}, {60, 59}, {17, 1}};
enum { CASES = sizeof cases / sizeof *cases, WIDTH = 24 };

static void fill(ambulo__band *band) {
  for (int j = 0; j < band->n; j++) {
    double *column = band->a + (size_t)j * (size_t)band->ld;
    column[0] = 2.5;
    for (int k = 1; k <= band->kd && j + k < band->n; k++)
      column[k] = sin(0.7 * j + k) / (double)(band->kd + 1);
  }
}

static void equals_lapack(const ambulo__band_kernels *set, sizes size) {
  ambulo__pool pool;
  ambulo__band ours, theirs;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__band_create(&pool, size.n, size.kd, &ours), AMBULO_OK);
  assert_int_equal(ambulo__band_create(&pool, size.n, size.kd, &theirs), AMBULO_OK);
  size_t n = (size_t)size.n, tiles = (n + AMBULO__TILE - 1) / AMBULO__TILE;
  double *x = ambulo__pool_doubles(&pool, n), *y = ambulo__pool_doubles(&pool, n);
  double *wing = ambulo__pool_doubles(&pool, tiles * AMBULO__TILE * WIDTH);
  double *other = ambulo__pool_doubles(&pool, tiles * AMBULO__TILE * WIDTH);
  ours.kernels = set;
  ours.corner = ambulo__pool_doubles(&pool, tiles * AMBULO__CORNER);
  theirs.kernels = NULL;
  fill(&ours);
  fill(&theirs);
  for (int twice = 0; twice < 2; twice++) { /* the second time over the first one's remains */
    assert_int_equal(ambulo__band_factor(&ours), 0);
    assert_int_equal(ambulo__band_factor(&theirs), 0);
    for (size_t i = 0; i < n * (size_t)ours.ld; i++) assert_close(ours.a[i], theirs.a[i], 1e-14);
    for (size_t i = 0; i < n; i++) x[i] = y[i] = cos((double)i);
    ambulo__band_forward(&ours, x);
    ambulo__band_forward(&theirs, y);
    for (size_t i = 0; i < n; i++) assert_close(x[i], y[i], 1e-13);
    ambulo__band_backward(&ours, x);
    ambulo__band_backward(&theirs, y);
    for (size_t i = 0; i < n; i++) assert_close(x[i], y[i], 1e-13);
    for (size_t i = 0; i < n * WIDTH; i++) wing[i] = other[i] = cos(0.1 * (double)i);
    ambulo__band_forward_many(&ours, WIDTH, wing);
    ambulo__band_forward_many(&theirs, WIDTH, other);
    for (size_t i = 0; i < n * WIDTH; i++) assert_close(wing[i], other[i], 1e-13);
    ambulo__band_upper_multiply(&ours, x);
    ambulo__band_upper_multiply(&theirs, y);
    for (size_t i = 0; i < n; i++) assert_close(x[i], y[i], 1e-13);
    ambulo__band_clear(&ours);
    ambulo__band_clear(&theirs);
    fill(&ours);
    fill(&theirs);
    ambulo__band_multiply(&ours, x, wing);
    ambulo__band_multiply(&theirs, y, other);
    for (size_t i = 0; i < n; i++) assert_close(wing[i], other[i], 1e-13);
  }
  ours.a[(n - 1) * (size_t)ours.ld] = -1.0;
  assert_int_equal(ambulo__band_factor(&ours), 1);
  fill(&ours);
  ours.a[0] = NAN;
  assert_int_equal(ambulo__band_factor(&ours), 1);
  ambulo__pool_clear(&pool);
}

/* W [n][width] of a set against plain sums */
static void products_are_plain_sums(const ambulo__band_kernels *set, int n, int width) {
  ambulo__pool pool;
  ambulo__band square;
  ambulo__pool_init(&pool, NULL);
  size_t columns = (size_t)width, rows = (size_t)n;
  double *w = ambulo__pool_doubles(&pool, rows * columns);
  double *x = ambulo__pool_doubles(&pool, rows), *y = ambulo__pool_doubles(&pool, columns);
  assert_int_equal(ambulo__band_create(&pool, width, width - 1, &square), AMBULO_OK);
  for (size_t e = 0; e < rows * columns; e++) w[e] = sin(1.0 + 0.7 * (double)e);
  for (size_t k = 0; k < rows; k++) x[k] = cos(0.3 * (double)k);
  for (size_t e = 0; e < columns * (size_t)square.ld; e++) square.a[e] = 77.0;
  set->gram(n, width, w, square.ld, square.a);
  for (size_t j = 0; j < columns; j++) {
    y[j] = 77.0;
    for (size_t i = j; i < columns; i++) {
      double sum = 0.0;
      for (size_t k = 0; k < rows; k++) sum += w[k * columns + i] * w[k * columns + j];
      assert_close(square.a[j * (size_t)square.ld + i - j], sum, 1e-13);
    }
    /* nothing below the square */
    for (size_t i = columns - j; i < (size_t)square.ld; i++)
      assert_close(square.a[j * (size_t)square.ld + i], 77.0, 0.0);
  }
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

static void test_set(const ambulo__band_kernels *set, int runs) {
  if (!runs || !set->factor) skip();
  for (int i = 0; i < CASES; i++) equals_lapack(set, cases[i]);
  for (int i = 0; i < CASES; i++) products_are_plain_sums(set, cases[i].n, 8 * (1 + i));
  for (int i = 0; i < CASES; i++) eight_columns_at_once(set, cases[i].n, 8 * (1 + i));
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
  assert_null(ambulo__band_kernels_select());
  unsetenv("AMBULO_ISA");
  const ambulo__band_kernels *set = ambulo__band_kernels_select();
  if (set) assert_string_equal(set->name, ambulo_instruction_set());
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(avx2_equals_lapack),
      cmocka_unit_test(avx512_equals_lapack),
      cmocka_unit_test(the_environment_chooses),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
