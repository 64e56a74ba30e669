/* Banded matrices against dense ones. */
#include "linear/band.h"
#include "support/engine_fixture.h"

#include <math.h>

enum { N = 71, KD = 6, STRIDE = 8 }; /* several blocks of columns */

typedef struct banded {
  ambulo__pool pool;
  ambulo__band band;
  double dense[N][N];
} banded;

/* sum of outer products of rows on windows: positive definite with the diagonal added */
static void fill(banded *m, unsigned seed) {
  ambulo__pool_init(&m->pool, NULL);
  assert_int_equal(ambulo__band_create(&m->pool, N, KD, &m->band), AMBULO_OK);
  memset(m->dense, 0, sizeof m->dense);
  for (int first = 0; first + KD < N; first++) {
    _Alignas(64) double rows[3][STRIDE] = {{0.0}};
    for (int r = 0; r < 3; r++) {
      for (int j = 0; j <= KD; j++) rows[r][j] = random_number(&seed);
    }
    ambulo__band_add_rows(&m->band, first, KD + 1, 3, STRIDE, &rows[0][0]);
    for (int r = 0; r < 3; r++) {
      for (int i = 0; i <= KD; i++) {
        for (int j = 0; j <= KD; j++) m->dense[first + i][first + j] += rows[r][i] * rows[r][j];
      }
    }
  }
  ambulo__band_add_diagonal(&m->band, 0.5);
  for (int i = 0; i < N; i++) m->dense[i][i] += 0.5;
}

static void product_is_the_dense_one(void **state) {
  (void)state;
  banded m;
  double x[N], y[N];
  unsigned seed = 7;
  fill(&m, 1);
  for (int i = 0; i < N; i++) x[i] = random_number(&seed);
  ambulo__band_multiply(&m.band, x, y);
  for (int i = 0; i < N; i++) {
    double want = 0.0;
    for (int j = 0; j < N; j++) want += m.dense[i][j] * x[j];
    assert_close(y[i], want, 1e-13);
  }
  ambulo__pool_clear(&m.pool);
}

static void factor_solves_the_dense_system(void **state) {
  (void)state;
  banded m;
  double x[N], rhs[N];
  unsigned seed = 9;
  fill(&m, 2);
  for (int i = 0; i < N; i++) x[i] = random_number(&seed);
  for (int i = 0; i < N; i++) {
    rhs[i] = 0.0;
    for (int j = 0; j < N; j++) rhs[i] += m.dense[i][j] * x[j];
  }
  assert_int_equal(ambulo__band_factor(&m.band), 0);
  ambulo__band_forward(&m.band, rhs);
  ambulo__band_backward(&m.band, rhs);
  for (int i = 0; i < N; i++) assert_close(rhs[i], x[i], 1e-11);
  ambulo__band_upper_multiply(&m.band, rhs);
  ambulo__band_backward(&m.band, rhs);
  for (int i = 0; i < N; i++) assert_close(rhs[i], x[i], 1e-11);
  ambulo__pool_clear(&m.pool);
}

static void many_right_hand_sides_are_single_ones(void **state) {
  (void)state;
  enum { WIDTH = 16 };
  banded m;
  unsigned seed = 3;
  fill(&m, 4);
  double *many = ambulo__pool_doubles(&m.pool, (size_t)ambulo__whole_tiles(N) * WIDTH), one[N];
  double before[N][WIDTH];
  for (int i = 0; i < N; i++) {
    for (int k = 0; k < WIDTH; k++) many[i * WIDTH + k] = before[i][k] = random_number(&seed);
  }
  assert_int_equal(ambulo__band_factor(&m.band), 0);
  ambulo__band_forward_many(&m.band, WIDTH, many);
  for (int k = 0; k < WIDTH; k++) {
    for (int i = 0; i < N; i++) one[i] = before[i][k];
    ambulo__band_forward(&m.band, one);
    for (int i = 0; i < N; i++) assert_close(many[i * WIDTH + k], one[i], 1e-12);
  }
  ambulo__pool_clear(&m.pool);
}

static void a_right_hand_side_that_overflows_leaves_nothing_behind(void **state) {
  (void)state;
  banded m;
  double x[N], again[N];
  fill(&m, 6);
  assert_int_equal(ambulo__band_factor(&m.band), 0);
  for (int i = 0; i < N; i++) x[i] = again[i] = cos(i);
  ambulo__band_forward(&m.band, x);
  ambulo__band_backward(&m.band, x);
  for (int pass = 0; pass < 2; pass++) {
    double wild[N];
    for (int i = 0; i < N; i++) wild[i] = INFINITY;
    (pass ? ambulo__band_backward : ambulo__band_forward)(&m.band, wild);
    double good[N];
    memcpy(good, again, sizeof good);
    ambulo__band_forward(&m.band, good);
    ambulo__band_backward(&m.band, good);
    assert_memory_equal(good, x, sizeof x);
  }
  ambulo__pool_clear(&m.pool);
}

static void sparse_row_adds_its_outer_product(void **state) {
  (void)state;
  banded m;
  int start[] = {0, 4}, column[] = {4, 6, 7, 9}, run_end[4];
  double value[] = {2.0, -1.0, 0.7, 0.5}, x[N] = {0.0}, before[N], after[N];
  ambulo__sparse_rows rows = {
      .count = 1, .start = start, .column = column, .run_end = run_end, .value = value};
  const int ends[] = {1, 3, 3, 4};
  ambulo__sparse_rows_find_runs(&rows);
  for (int e = 0; e < 4; e++) assert_int_equal(run_end[e], ends[e]);
  fill(&m, 5);
  for (int i = 0; i < N; i++) x[i] = 0.1 * i;
  ambulo__band_multiply(&m.band, x, before);
  ambulo__band_add_sparse(&m.band, &rows, 0, 3.0);
  ambulo__band_multiply(&m.band, x, after);
  double dot = 2.0 * x[4] - x[6] + 0.7 * x[7] + 0.5 * x[9];
  for (int i = 0; i < N; i++) {
    double want = before[i];
    for (int e = 0; e < 4; e++) want += i == column[e] ? 3.0 * value[e] * dot : 0.0;
    assert_close(after[i], want, 1e-13);
  }
  ambulo__pool_clear(&m.pool);
}

/* J D^-1 J', and the diagonal that it is measured by */
static void a_row_has_a_length_in_the_diagonal(void **state) {
  (void)state;
  banded m;
  int start[] = {0, 2}, column[] = {4, 9}, run_end[] = {1, 2};
  double value[] = {2.0, -0.5};
  ambulo__sparse_rows rows = {
      .count = 1, .start = start, .column = column, .run_end = run_end, .value = value};
  fill(&m, 5);
  double want = sqrt(4.0 / m.dense[4][4] + 0.25 / m.dense[9][9]);
  assert_close(ambulo__band_row_length(&m.band, &rows, 0), want, 1e-14);
  ambulo__band_raise_diagonal(&m.band, 3.0);
  assert_close(ambulo__band_row_length(&m.band, &rows, 0), 0.5 * want, 1e-14);
  assert_close(m.band.a[1], m.dense[1][0], 0.0); /* nothing else */
  ambulo__pool_clear(&m.pool);
}

static void indefinite_matrix_is_refused(void **state) {
  (void)state;
  banded m;
  fill(&m, 6);
  ambulo__band_add_diagonal(&m.band, -100.0);
  assert_int_equal(ambulo__band_factor(&m.band), 1);
  ambulo__pool_clear(&m.pool);
}

/* a small matrix has no more diagonals than rows */
static void sizes_are_what_is_stored(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__band small;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__band_create(&pool, 4, 9, &small), AMBULO_OK);
  assert_int_equal(small.kd, 3);
  ambulo__pool_clear(&pool);
}

/* on the diagonal */
static void what_is_no_number_is_no_factor(void **state) {
  (void)state;
  banded m;
  fill(&m, 9);
  double *last = &m.band.a[(size_t)(N - 1) * (size_t)m.band.ld];
  *last = INFINITY;
  assert_true(ambulo__band_largest(&m.band) == INFINITY);
  *last = NAN;
  assert_true(isnan(ambulo__band_largest(&m.band)));
  assert_int_equal(ambulo__band_factor(&m.band), 1);
  ambulo__pool_clear(&m.pool);
}

/* --------------- Gram matrices on a motion against P' G'G P, with each instruction set */

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
  double *gp = ambulo__pool_doubles(&pool, (size_t)(count * width));
  assert_int_equal(ambulo__band_create(&pool, n, width + 2, &band), AMBULO_OK);
  assert_int_equal(ambulo__spread_create(&pool, d, &spread), AMBULO_OK);
  for (int k = 0; k < ORDERS; k++) {
    for (int c = 0; c < span; c++) b[k][c] = weight(k, c);
  }
  for (int r = 0; r < count; r++)
    for (int j = 0; j < width; j++) gp[r * width + j] = mapped(d, r, j / d, j % d);
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
          want += times * gp[r * width + row] * gp[r * width + column];
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
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(product_is_the_dense_one),
      cmocka_unit_test(factor_solves_the_dense_system),
      cmocka_unit_test(many_right_hand_sides_are_single_ones),
      cmocka_unit_test(a_right_hand_side_that_overflows_leaves_nothing_behind),
      cmocka_unit_test(sparse_row_adds_its_outer_product),
      cmocka_unit_test(a_row_has_a_length_in_the_diagonal),
      cmocka_unit_test(indefinite_matrix_is_refused),
      cmocka_unit_test(sizes_are_what_is_stored),
      cmocka_unit_test(what_is_no_number_is_no_factor),
      cmocka_unit_test(rows_are_spread),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
