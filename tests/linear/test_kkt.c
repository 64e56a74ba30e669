/* Equality-constrained solves against a dense LU factorization of the KKT matrix. */
#include "linear/kkt.h"
#include "base/lapack.h"
#include "support/engine_fixture.h"

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

/* worst |J d - h| of the local rows */
static double worst_row(const kkt_case *s, const double *d) {
  double out[LOCAL], worst = 0.0;
  ambulo__sparse_rows_multiply(&s->local, d, out);
  for (int i = 0; i < LOCAL; i++) worst = fmax(worst, fabs(out[i] - s->rhs_local[i]));
  return worst;
}

/* the penalty is raised for the next factor, and that one solves */
static void rows_that_nearly_depend_get_stiffer(void **state) {
  (void)state;
  static kkt_case s;
  double d[N], l[LOCAL] = {0.0};
  open_system(&s);
  /* row 1 becomes row 0 but for a trace of another column, with another right-hand side */
  memcpy(s.column[0] + s.start[0][1], s.column[0], 4 * sizeof(int));
  memcpy(s.value[0] + s.start[0][1], s.value[0], 4 * sizeof(double));
  s.value[0][s.start[0][1]] += 1e-4;
  s.rhs_local[1] = s.rhs_local[0] + 1e-4;
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
  ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, d, l, NULL);
  double before = worst_row(&s, d);
  assert_true(before > 1e-5);
  for (int k = 0; k < 2; k++) {
    memset(l, 0, sizeof l);
    assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
    ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, d, l, NULL);
  }
  assert_true(worst_row(&s, d) < 1e-3 * before);
  ambulo__pool_clear(&s.pool);
}

/* one penalty for all rows drowns a metric of very uneven size; one for each row does not */
static void uneven_metrics_are_solved_row_by_row(void **state) {
  (void)state;
  static kkt_case s;
  double d[N], l[LOCAL] = {0.0};
  open_system(&s);
  ambulo__band_clear(&s.h);
  ambulo__band_add_diagonal(&s.h, 1e-6);
  s.h.a[(size_t)(N - 1) * (size_t)s.h.ld] = 1e10;
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 1);
  assert_int_equal(ambulo__kkt_by_row(&s.kkt), 1);
  assert_int_equal(ambulo__kkt_by_row(&s.kkt), 0);
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
  ambulo__kkt_solve(&s.kkt, s.a, s.rhs_local, s.rhs_border, d, l, NULL);
  assert_true(worst_row(&s, d) < 1e-9 * fabs(d[0]));
  ambulo__pool_clear(&s.pool);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(solution_is_the_dense_one),
      cmocka_unit_test(rows_hold_to_rounding),
      cmocka_unit_test(dependent_rows_do_no_harm),
      cmocka_unit_test(a_border_row_that_vanishes_does_no_harm),
      cmocka_unit_test(rows_that_nearly_depend_get_stiffer),
      cmocka_unit_test(uneven_metrics_are_solved_row_by_row),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
