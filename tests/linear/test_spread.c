/* Gram matrices of rows on a motion against the dense product P' G'G P, with each instruction set.
 */
#include "linear/spread.h"
#include "support/engine_fixture.h"

#include <math.h>

enum { ORDERS = AMBULO__ORDERS, SPANS = 6 };

static double weight(int order, int c) {
  return cos(1.0 + 2.0 * order + 0.7 * c);
}

/* nothing in some limbs, as rows of one leg have */
static double slope(int row, int column) {
  return (row + column / 5) % 3 ? sin(1.0 + 0.7 * row + 0.3 * column) : 0.0;
}

/* a row of G P */
static double mapped(int d, int row, int c, int i) {
  double sum = 0.0;
  for (int k = 0; k < ORDERS; k++) sum += weight(k, c) * slope(row, k * d + i);
  return sum;
}

/* on unknowns from 3 on of a band that has more, twice: what is there stays */
static void equals_dense(int d, int span, int count) {
  ambulo__pool pool;
  ambulo__band band;
  ambulo__spread spread;
  double b[ORDERS][SPANS];
  const double *const weights[] = {b[0], b[1], b[2]};
  ambulo__pool_init(&pool, NULL);
  int width = span * d, n = width + 9, most = span > ORDERS ? span : ORDERS,
      stride = ambulo__whole_tiles(most * d) + 8;
  double *g = ambulo__pool_doubles(&pool, (size_t)(count * stride));
  assert_int_equal(ambulo__band_create(&pool, n, width + 2, &band), AMBULO_OK);
  assert_int_equal(ambulo__spread_create(&pool, d, &spread), AMBULO_OK);
  for (int k = 0; k < ORDERS; k++) {
    for (int c = 0; c < span; c++) b[k][c] = weight(k, c);
  }
  for (int times = 1; times <= 2; times++) {
    for (int r = 0; r < count; r++) {
      for (int j = 0; j < ORDERS * d; j++) g[r * stride + j] = slope(r, j);
    }
    ambulo__spread_rows(&spread, count, stride, g, span, weights, 3, &band);
    for (int j = 0; j < n; j++) {
      for (int e = 0; e < band.ld; e++) {
        int column = j - 3, row = column + e, inside = column >= 0 && row < width;
        double want = 0.0;
        for (int r = 0; inside && r < count; r++)
          want += times * mapped(d, r, row / d, row % d) * mapped(d, r, column / d, column % d);
        assert_close(band.a[(size_t)j * (size_t)band.ld + (size_t)e], want, inside ? 1e-12 : 0.0);
      }
    }
  }
  ambulo__pool_clear(&pool);
}

/* fewer and more control points than orders; coordinates that fill tiles, or not; few rows and
 * many, none */
static void rows_are_spread(void **state) {
  (void)state;
  static const char *const sets[] = {"avx512", "avx2", "baseline"};
  for (int s = 0; s < 3; s++) {
    setenv("AMBULO_ISA", sets[s], 1);
    for (int span = 1; span <= SPANS; span++) {
      for (int d = 1; d <= 18; d++) {
        equals_dense(d, span, 1 + d);
        equals_dense(d, span, 30 + d);
      }
    }
    equals_dense(45, 5, 80);
    equals_dense(45, 4, 0);
  }
  unsetenv("AMBULO_ISA");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(rows_are_spread)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
