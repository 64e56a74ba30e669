/* Equality-constrained solves against a dense LU factorization of the KKT matrix. */
#include "base/lapack.h"
#include "linear/kkt.h"
#include "support/engine_fixture.h"
#include "support/test.h"

enum { N = 40, KD = 7, LOCAL = 15, BORDER = 4, ALL = N + LOCAL + BORDER };

typedef struct kkt_case {
  ambulo__pool pool;
  struct ambulo_problem problem; /* only its size is used */
  ambulo__band h;
  ambulo__sparse_rows local, border;
  ambulo__kkt kkt;
  double dense[ALL * ALL], a[N], rhs_local[LOCAL], rhs_border[BORDER];
  int start[2][LOCAL + 1], column[2][LOCAL * KD], run_end[2][LOCAL * KD];
  double value[2][LOCAL * KD];
} kkt_case;

static void entry(kkt_case *s, int set, int row, int column, double value) {
  int e = s->start[set][row + 1]++;
  s->column[set][e] = column;
  s->value[set][e] = value;
  int r = N + (set == 1 ? LOCAL : 0) + row;
  s->dense[(size_t)column * ALL + (size_t)r] = value;
  s->dense[(size_t)r * ALL + (size_t)column] = value;
}

static void fill_rows(kkt_case *s, unsigned *seed) {
  for (int r = 0; r < LOCAL; r++) {
    s->start[0][r + 1] = s->start[0][r];
    for (int j = 0; j < 4; j++) entry(s, 0, r, 2 * r + j, random_number(seed));
  }
  for (int r = 0; r < BORDER; r++) {
    s->start[1][r + 1] = s->start[1][r];
    entry(s, 1, r, r, 1.0);
    entry(s, 1, r, N - BORDER + r, -1.0);
  }
  ambulo__sparse_rows local = {.problem = &s->problem,
                               .count = LOCAL,
                               .start = s->start[0],
                               .column = s->column[0],
                               .run_end = s->run_end[0],
                               .value = s->value[0]};
  ambulo__sparse_rows border = {.problem = &s->problem,
                                .count = BORDER,
                                .start = s->start[1],
                                .column = s->column[1],
                                .run_end = s->run_end[1],
                                .value = s->value[1]};
  ambulo__sparse_rows_find_runs(&local);
  ambulo__sparse_rows_find_runs(&border);
  s->local = local;
  s->border = border;
}

static void open_system(kkt_case *s) {
  unsigned seed = 11;
  memset(s, 0, sizeof *s);
  s->problem.variables = N;
  ambulo__pool_init(&s->pool, NULL);
  assert_int_equal(ambulo__band_create(&s->pool, N, KD, &s->h), AMBULO_OK);
  for (int first = 0; first + KD < N; first++) {
    double row[KD + 1];
    for (int j = 0; j <= KD; j++) row[j] = 10.0 * random_number(&seed);
    ambulo__band_add_outer(&s->h, first, KD + 1, 1, 1.0, row);
    for (int i = 0; i <= KD; i++) {
      for (int j = 0; j <= KD; j++)
        s->dense[(size_t)(first + j) * ALL + (size_t)(first + i)] += row[i] * row[j];
    }
  }
  ambulo__band_add_diagonal(&s->h, 0.02);
  for (int i = 0; i < N; i++) s->dense[(size_t)i * ALL + (size_t)i] += 0.02;
  fill_rows(s, &seed);
  for (int i = 0; i < N; i++) s->a[i] = random_number(&seed);
  for (int i = 0; i < LOCAL; i++) s->rhs_local[i] = random_number(&seed);
  for (int i = 0; i < BORDER; i++) s->rhs_border[i] = random_number(&seed);
  assert_int_equal(ambulo__kkt_create(&s->local, &s->border, KD, &s->pool, &s->kkt), AMBULO_OK);
  assert_int_equal(ambulo__kkt_factor(&s->kkt, &s->h), 0);
}

static void solution_is_the_dense_one(void **state) {
  (void)state;
  static kkt_case s;
  double want[ALL], d[N], l[LOCAL] = {0.0}, m[BORDER];
  int n = ALL, one = 1, info, pivot[ALL];
  open_system(&s);
  memcpy(want, s.a, sizeof s.a);
  memcpy(want + N, s.rhs_local, sizeof s.rhs_local);
  memcpy(want + N + LOCAL, s.rhs_border, sizeof s.rhs_border);
  dgesv_(&n, &one, s.dense, &n, pivot, want, &n, &info);
  assert_int_equal(info, 0);
  ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, d, l, m);
  for (int i = 0; i < N; i++) assert_close(d[i], want[i], 1e-8);
  for (int i = 0; i < LOCAL; i++) assert_close(l[i], want[N + i], 1e-6);
  for (int i = 0; i < BORDER; i++) assert_close(m[i], want[N + LOCAL + i], 1e-6);
  ambulo__pool_clear(&s.pool);
}

static void rows_hold_to_rounding(void **state) {
  (void)state;
  static kkt_case s;
  double d[N], l[LOCAL] = {0.0}, out[LOCAL];
  open_system(&s);
  ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, d, l, NULL);
  ambulo__sparse_rows_multiply(&s.local, d, out);
  for (int i = 0; i < LOCAL; i++) assert_close(out[i], s.rhs_local[i], 1e-10);
  ambulo__sparse_rows_multiply(&s.border, d, out);
  for (int i = 0; i < BORDER; i++) assert_close(out[i], s.rhs_border[i], 1e-10);
  ambulo__pool_clear(&s.pool);
}

static void dependent_rows_do_no_harm(void **state) {
  (void)state;
  static kkt_case s;
  double d[N], l[LOCAL] = {0.0}, out[LOCAL];
  open_system(&s);
  /* row 1 becomes a copy of row 0, with its right-hand side */
  memcpy(s.column[0] + s.start[0][1], s.column[0], 4 * sizeof(int));
  memcpy(s.value[0] + s.start[0][1], s.value[0], 4 * sizeof(double));
  s.rhs_local[1] = s.rhs_local[0];
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
  ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, d, l, NULL);
  ambulo__sparse_rows_multiply(&s.local, d, out);
  for (int i = 0; i < LOCAL; i++) assert_close(out[i], s.rhs_local[i], 1e-9);
  ambulo__pool_clear(&s.pool);
}

/* the complement is singular then; a shift to rounding keeps it solvable */
static void a_border_row_that_vanishes_does_no_harm(void **state) {
  (void)state;
  static kkt_case s;
  double d[N], l[LOCAL] = {0.0}, out[BORDER];
  open_system(&s);
  for (int e = s.start[1][1]; e < s.start[1][2]; e++) s.value[1][e] = 0.0;
  s.rhs_border[1] = 0.0;
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
  ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, d, l, NULL);
  ambulo__sparse_rows_multiply(&s.border, d, out);
  for (int i = 0; i < BORDER; i++) assert_close(out[i], s.rhs_border[i], 1e-9);
  ambulo__pool_clear(&s.pool);
}

/* the least accurate multiplier decides how stiff the rows become; there is a bound */
static void rows_that_nearly_depend_are_made_stiffer(void **state) {
  (void)state;
  static kkt_case s;
  double d[N], before = 0.0;
  open_system(&s);
  for (int e = 0; e < 4; e++) {
    s.column[0][s.start[0][1] + e] = s.column[0][e];
    s.value[0][s.start[0][1] + e] = s.value[0][e] * (1.0 + 1e-7 * e);
  }
  for (int k = 0; k < 4; k++) {
    double l[LOCAL] = {0.0};
    assert_true(s.kkt.stiffness <= 1e8);
    before = s.kkt.stiffness;
    s.rhs_local[1] = s.rhs_local[0] + 1.0;
    assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
    ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, d, l, NULL);
    assert_close(s.kkt.stiffness, fmin(1e8, 100.0 * before), 0.0);
  }
  s.kkt.stiffness = 1e20; /* drowns H: back to where it started */
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
  assert_close(s.kkt.stiffness, 1e4, 0.0);
  assert_int_equal(s.kkt.by_row, 0); /* that was enough */
  ambulo__pool_clear(&s.pool);
}

/* Curvature that varies by more than the digits of a double, as between the smoothest and the
 * roughest motion of a fine grid: penalties in the measure of the largest drown the rest, so they
 * become relative to each unknown's own; rows hold then as well. Only then: elsewhere rows that
 * nearly depend on each other want the stronger ones. */
static void what_drowns_the_metric_goes_row_by_row(void **state) {
  (void)state;
  for (int even = 0; even < 2; even++) {
    static kkt_case s;
    double d[N], l[LOCAL] = {0.0}, out[LOCAL], unit[N];
    open_system(&s);
    for (int j = 0; j < N; j++) unit[j] = even ? 1.0 : pow(10.0, -0.5 * j);
    for (int j = 0; j < N; j++) {
      for (int i = j; i < N && i <= j + KD; i++)
        s.h.a[(size_t)j * (size_t)s.h.ld + (size_t)(i - j)] *= unit[i] * unit[j];
      s.a[j] *= unit[j];
    }
    assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
    assert_int_equal(s.kkt.by_row, !even);
    for (int i = 0; i < LOCAL; i++) {
      double give = 0.0, square = 0.0;
      for (int e = s.start[0][i]; e < s.start[0][i + 1]; e++) {
        double part = s.value[0][e] * s.value[0][e];
        give += part / s.h.a[(size_t)s.column[0][e] * (size_t)s.h.ld];
        square += part;
      }
      double size = even ? square / ambulo__band_largest(&s.h) : give;
      assert_close(s.kkt.penalty[i] * size, 1e4, 1e-6);
    }
    ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, d, l, NULL);
    ambulo__sparse_rows_multiply(&s.local, d, out);
    for (int i = 0; i < LOCAL; i++) { /* to rounding of its parts, which cancel */
      double parts = 0.0;
      for (int e = s.start[0][i]; e < s.start[0][i + 1]; e++)
        parts += fabs(s.value[0][e] * d[s.column[0][e]]);
      assert_close((out[i] - s.rhs_local[i]) / parts, 0.0, 1e-11);
    }
    ambulo__pool_clear(&s.pool);
  }
}

/* where nothing can be factored, every measure has been tried, and it is said */
static void an_indefinite_metric_is_refused(void **state) {
  (void)state;
  static kkt_case s;
  open_system(&s);
  s.h.a[(size_t)(N - 1) * (size_t)s.h.ld] = -1e30;
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 1);
  assert_int_equal(s.kkt.by_row, 1);
  assert_close(s.kkt.stiffness, 1e2, 0.0);
  assert_close(s.kkt.most_stiffness, 1e2, 0.0); /* what has drowned it once does so again */
  ambulo__pool_clear(&s.pool);
}

static void a_local_row_that_vanishes_does_no_harm(void **state) {
  (void)state;
  static kkt_case s;
  double d[N], l[LOCAL] = {0.0};
  open_system(&s);
  for (int e = s.start[0][3]; e < s.start[0][4]; e++) s.value[0][e] = 0.0;
  s.rhs_local[3] = 0.0;
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
  assert_true(s.kkt.penalty[3] == 0.0);
  ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, d, l, NULL);
  for (int i = 0; i < N; i++) assert_true(isfinite(d[i]));
  ambulo__pool_clear(&s.pool);
}

/* what is left counts beside the parts that make it up */
static void small_right_hand_sides_are_as_exact(void **state) {
  (void)state;
  static kkt_case s;
  double d[N], small[N], l[LOCAL] = {0.0}, other[LOCAL] = {0.0};
  const double tiny = ldexp(1.0, -40);
  open_system(&s);
  ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, d, l, NULL);
  for (int i = 0; i < N; i++) s.a[i] *= tiny;
  for (int i = 0; i < LOCAL; i++) s.rhs_local[i] *= tiny;
  for (int i = 0; i < BORDER; i++) s.rhs_border[i] *= tiny;
  ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, small, other, NULL);
  for (int i = 0; i < N; i++) assert_true(small[i] == tiny * d[i]);
  ambulo__pool_clear(&s.pool);
}

/* Mixing solves a linear fixed-point problem that plain iteration does not. */

enum { TEST_MIXING_N = 3 };

/* x <- x - r(x), r = A x - b, with an A for which that diverges */
static void residual(const double *x, double *r) {
  static const double a[TEST_MIXING_N][TEST_MIXING_N] = {
      {3.0, 0.2, 0.0}, {0.1, 2.5, 0.3}, {0.0, -0.2, 0.4}};
  static const double b[TEST_MIXING_N] = {1.0, 2.0, 3.0};
  for (int i = 0; i < TEST_MIXING_N; i++) {
    r[i] = -b[i];
    for (int j = 0; j < TEST_MIXING_N; j++) r[i] += a[i][j] * x[j];
  }
}

static double size(const double *r) {
  return fabs(r[0]) + fabs(r[1]) + fabs(r[2]);
}

static void linear_problem_is_solved_in_a_few_steps(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mixing mixing;
  double x[TEST_MIXING_N] = {0.0}, r[TEST_MIXING_N];
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mixing_create(&pool, TEST_MIXING_N, TEST_MIXING_N, &mixing), AMBULO_OK);
  ambulo__mixing_reset(&mixing);
  for (int k = 0; k < 8; k++) {
    residual(x, r);
    for (int i = 0; i < TEST_MIXING_N; i++) x[i] -= r[i];
    ambulo__mixing_apply(&mixing, r, x);
  }
  residual(x, r);
  assert_close(size(r), 0.0, 1e-9);
  ambulo__pool_clear(&pool);
}

static void repeated_residual_leaves_the_image_finite(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mixing mixing;
  double r[TEST_MIXING_N] = {1.0, 1.0, 1.0};
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mixing_create(&pool, TEST_MIXING_N, TEST_MIXING_N, &mixing), AMBULO_OK);
  for (int k = 0; k < 4; k++) {
    double image[TEST_MIXING_N] = {1.0, 2.0, 3.0};
    ambulo__mixing_apply(&mixing, r, image);
    assert_close(image[2], 3.0, 1e-12);
  }
  ambulo__pool_clear(&pool);
}

/* all differences point the same way: the secant all the same */
static void parallel_residuals_are_extrapolated(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mixing mixing;
  double image[TEST_MIXING_N] = {0.0};
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mixing_create(&pool, TEST_MIXING_N, TEST_MIXING_N, &mixing), AMBULO_OK);
  for (int k = 0; k < 3; k++) {
    double r[TEST_MIXING_N] = {1.0 - 0.1 * k, 0.5, 2.0 - 0.2 * k};
    for (int i = 0; i < TEST_MIXING_N; i++) image[i] = k + 1.0;
    ambulo__mixing_apply(&mixing, r, image);
  }
  for (int i = 0; i < TEST_MIXING_N; i++) assert_close(image[i], 11.0, 1e-3);
  ambulo__pool_clear(&pool);
}

/* the newest pairs are kept, none after a reset */
static void the_oldest_pair_gives_way(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mixing mixing;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mixing_create(&pool, TEST_MIXING_N, TEST_MIXING_N, &mixing), AMBULO_OK);
  for (int k = 0; k <= AMBULO__MIXING_DEPTH; k++) {
    double r[TEST_MIXING_N] = {k + 1.0, cos(k), sin(k)}, image[TEST_MIXING_N] = {k, k, k};
    ambulo__mixing_apply(&mixing, r, image);
  }
  assert_int_equal(mixing.count, AMBULO__MIXING_DEPTH);
  for (int slot = 0; slot < AMBULO__MIXING_DEPTH; slot++)
    assert_true(mixing.residual[slot][0] == (slot ? slot + 1.0 : AMBULO__MIXING_DEPTH + 1.0));
  double r[TEST_MIXING_N] = {0.3, 0.2, 0.1}, image[TEST_MIXING_N] = {5.0, 6.0, 7.0};
  ambulo__mixing_reset(&mixing);
  ambulo__mixing_apply(&mixing, r, image);
  assert_true(image[0] == 5.0 && image[1] == 6.0 && image[2] == 7.0);
  assert_int_equal(mixing.count, 1);
  ambulo__pool_clear(&pool);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(solution_is_the_dense_one),
      cmocka_unit_test(rows_hold_to_rounding),
      cmocka_unit_test(dependent_rows_do_no_harm),
      cmocka_unit_test(a_border_row_that_vanishes_does_no_harm),
      cmocka_unit_test(rows_that_nearly_depend_are_made_stiffer),
      cmocka_unit_test(what_drowns_the_metric_goes_row_by_row),
      cmocka_unit_test(an_indefinite_metric_is_refused),
      cmocka_unit_test(a_local_row_that_vanishes_does_no_harm),
      cmocka_unit_test(small_right_hand_sides_are_as_exact),
      cmocka_unit_test(linear_problem_is_solved_in_a_few_steps),
      cmocka_unit_test(repeated_residual_leaves_the_image_finite),
      cmocka_unit_test(parallel_residuals_are_extrapolated),
      cmocka_unit_test(the_oldest_pair_gives_way),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
