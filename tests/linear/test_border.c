/* Banded systems with border rows, put back into the equations they solve. */
#include "base/lapack.h"
#include "linear/border.h"
#include "linear/kkt.h"
#include "support/engine_fixture.h"

enum { N = 203, KD = 17, MOST = 140 };

typedef struct bordered {
  ambulo__pool pool;
  ambulo_problem problem;
  ambulo__band m, factor;
  ambulo__sparse_rows rows;
  ambulo__border border;
  int start[MOST + 1], column[4 * MOST];
  double value[4 * MOST], a[N], b[MOST];
} bordered;

/* rows on two unknowns in the first half and two in the second */
static void add_row(bordered *s, int row, unsigned *seed) {
  int columns[] = {row % 100, row % 100 + 1 + row / 100, 102 + row % 99, N - 1 - row / 100};
  s->start[row + 1] = s->start[row] + 4;
  for (int e = 0; e < 4; e++) {
    s->column[s->start[row] + e] = columns[e];
    s->value[s->start[row] + e] = random_number(seed);
  }
}

static void open_system(bordered *s, int count) {
  unsigned seed = 5;
  memset(s, 0, sizeof *s);
  ambulo__pool_init(&s->pool, NULL);
  s->problem.variables = N;
  assert_int_equal(ambulo__band_create(&s->pool, N, KD, &s->m), AMBULO_OK);
  assert_int_equal(ambulo__band_create(&s->pool, N, KD, &s->factor), AMBULO_OK);
  for (int first = 0; first + KD < N; first++) {
    double row[KD + 1];
    for (int j = 0; j <= KD; j++) row[j] = random_number(&seed);
    ambulo__band_add_outer(&s->m, first, KD + 1, 1, 1.0, row);
  }
  ambulo__band_add_diagonal(&s->m, 1.0);
  for (int r = 0; r < count; r++) add_row(s, r, &seed);
  for (int i = 0; i < N; i++) s->a[i] = random_number(&seed);
  for (int i = 0; i < count; i++) s->b[i] = random_number(&seed);
  ambulo__sparse_rows rows = {.problem = &s->problem,
                              .count = count,
                              .start = s->start,
                              .column = s->column,
                              .value = s->value};
  s->rows = rows;
  ambulo__band_copy(&s->m, &s->factor);
  assert_int_equal(ambulo__band_factor(&s->factor), 0);
  assert_int_equal(ambulo__border_create(&s->rows, &s->pool, &s->border), AMBULO_OK);
}

static void solve(bordered *s, const double *b, double *d) {
  memcpy(d, s->a, sizeof s->a);
  ambulo__band_forward(&s->factor, d);
  ambulo__border_eliminate(&s->border, b, d);
  ambulo__band_backward(&s->factor, d);
}

/* M d + C'm = a over the active rows, and C d - shift m = b */
static void check(const bordered *s, const int *active, double shift, const double *b,
                  const double *d) {
  double left[N];
  ambulo__band_multiply(&s->m, d, left);
  for (int i = 0; i < s->rows.count; i++) {
    double along = 0.0, m = s->border.rest[i];
    if (active && !active[i]) {
      assert_close(m, 0.0, 1e-12);
      continue;
    }
    for (int e = s->start[i]; e < s->start[i + 1]; e++) {
      left[s->column[e]] += s->value[e] * m;
      along += s->value[e] * d[s->column[e]];
    }
    assert_close(along - shift * m, b ? b[i] : 0.0, 1e-9);
  }
  for (int i = 0; i < N; i++) assert_close(left[i], s->a[i], 1e-9);
}

static void solutions_satisfy_their_equations(void **state) {
  (void)state;
  static const int counts[] = {1, 7, 8, 54, MOST};
  static const char *const sets[] = {"avx512", "avx2", "baseline"};
  static bordered s;
  int active[MOST];
  double d[N];
  for (int i = 0; i < MOST; i++) active[i] = i % 3 != 1;
  for (int run = 0; run < 5 * 3; run++) {
    setenv("AMBULO_ISA", sets[run % 3], 1);
    open_system(&s, counts[run / 3]);
    assert_int_equal(ambulo__border_factor(&s.border, &s.factor, NULL, 0.0, 0.0), 0);
    solve(&s, s.b, d);
    check(&s, NULL, 0.0, s.b, d);
    /* over the remains of the last factor */
    assert_int_equal(ambulo__border_factor(&s.border, &s.factor, active, 1.0, 0.0), 0);
    solve(&s, NULL, d);
    check(&s, active, 1.0, NULL, d);
    ambulo__pool_clear(&s.pool);
  }
  unsetenv("AMBULO_ISA");
}

static void the_relative_shift_is_one_of_the_largest(void **state) {
  (void)state;
  static bordered s;
  double d[N], largest;
  open_system(&s, 9);
  assert_int_equal(ambulo__border_factor(&s.border, &s.factor, NULL, 0.0, 0.0), 0);
  /* W'W = L L' of the complement: its largest diagonal element */
  largest = 0.0;
  for (int i = 0; i < 9; i++) {
    double sum = 0.0;
    for (int j = 0; j <= i; j++) {
      double l = s.border.schur.a[(size_t)j * (size_t)s.border.schur.ld + (size_t)(i - j)];
      sum += l * l;
    }
    largest = fmax(largest, sum);
  }
  assert_int_equal(ambulo__border_factor(&s.border, &s.factor, NULL, 0.0, 0.5), 0);
  solve(&s, s.b, d);
  check(&s, NULL, 0.5 * largest, s.b, d);
  ambulo__pool_clear(&s.pool);
}

static void dependent_rows_are_noticed(void **state) {
  (void)state;
  static bordered s;
  open_system(&s, 3);
  for (int e = 0; e < 4; e++) {
    s.column[8 + e] = s.column[e];
    s.value[8 + e] = 0.0;
  }
  assert_int_equal(ambulo__border_factor(&s.border, &s.factor, NULL, 0.0, 0.0), 1);
  assert_int_equal(ambulo__border_factor(&s.border, &s.factor, NULL, 0.0, 1e-14), 0);
  ambulo__pool_clear(&s.pool);
}

static void no_rows_change_nothing(void **state) {
  (void)state;
  static bordered s;
  double z[N], before[N];
  open_system(&s, 0);
  for (int i = 0; i < N; i++) z[i] = before[i] = cos(i);
  assert_int_equal(ambulo__border_factor(&s.border, &s.factor, NULL, 1.0, 0.0), 0);
  ambulo__border_eliminate(&s.border, NULL, z);
  assert_memory_equal(z, before, sizeof z);
  ambulo__pool_clear(&s.pool);
}

/* Rows that come and go, against a dense LU factorization of the changed system. */

enum {
  TEST_UPDATE_N = 60,
  TEST_UPDATE_KD = 9,
  LOCAL = 10,
  BORDER = 5,
  MOVING = 48,
  ALL = TEST_UPDATE_N + LOCAL + BORDER
};
enum { SETS = 3, ROOM = AMBULO__UPDATE_TILES * AMBULO__TILE };

typedef struct row_set {
  ambulo__sparse_rows rows;
  int start[MOVING + 1], column[4 * MOVING], run_end[4 * MOVING];
  double value[4 * MOVING];
} row_set;

typedef struct changing {
  ambulo__pool pool;
  struct ambulo_problem problem; /* only its size is used */
  ambulo__band h;
  row_set set[SETS]; /* equalities, border rows, rows that come and go */
  ambulo__kkt kkt;
  double a[TEST_UPDATE_N], b[LOCAL + BORDER], weight[MOVING];
} changing;

static void test_update_add_row(row_set *set, int row, const int column[4], unsigned *seed) {
  set->start[row + 1] = set->start[row] + 4;
  for (int e = 0; e < 4; e++) {
    set->column[set->start[row] + e] = column[e];
    set->value[set->start[row] + e] = random_number(seed);
  }
}

static void fill_sets(changing *s, unsigned *seed) {
  const int count[SETS] = {LOCAL, BORDER, MOVING};
  for (int k = 0; k < SETS; k++) {
    row_set *set = &s->set[k];
    for (int r = 0; r < count[k]; r++) {
      int first = k == 0 ? 5 * r : 7 * r % (TEST_UPDATE_N - TEST_UPDATE_KD);
      int local[4] = {first, first + 1, first + 4, first + TEST_UPDATE_KD};
      int border[4] = {r, r + 1, TEST_UPDATE_N - 8 + r, TEST_UPDATE_N - 1};
      test_update_add_row(set, r, k == 1 ? border : local, seed);
    }
    ambulo__sparse_rows rows = {.problem = &s->problem,
                                .count = count[k],
                                .start = set->start,
                                .column = set->column,
                                .run_end = set->run_end,
                                .value = set->value};
    ambulo__sparse_rows_find_runs(&rows);
    set->rows = rows;
  }
}

static void test_update_open_system(changing *s) {
  unsigned seed = 7;
  memset(s, 0, sizeof *s);
  s->problem.variables = TEST_UPDATE_N;
  ambulo__pool_init(&s->pool, NULL);
  assert_int_equal(ambulo__band_create(&s->pool, TEST_UPDATE_N, TEST_UPDATE_KD, &s->h), AMBULO_OK);
  for (int first = 0; first + TEST_UPDATE_KD < TEST_UPDATE_N; first++) {
    double row[TEST_UPDATE_KD + 1];
    for (int j = 0; j <= TEST_UPDATE_KD; j++) row[j] = random_number(&seed);
    ambulo__band_add_outer(&s->h, first, TEST_UPDATE_KD + 1, 1, 1.0, row);
  }
  ambulo__band_add_diagonal(&s->h, 0.5);
  fill_sets(s, &seed);
  for (int i = 0; i < TEST_UPDATE_N; i++) s->a[i] = random_number(&seed);
  for (int i = 0; i < LOCAL + BORDER; i++) s->b[i] = random_number(&seed);
  assert_int_equal(
      ambulo__kkt_create(&s->set[0].rows, &s->set[1].rows, TEST_UPDATE_KD, &s->pool, &s->kkt),
      AMBULO_OK);
  assert_int_equal(ambulo__kkt_factor(&s->kkt, &s->h), 0);
}

/* H and the update change alike */
static void change(changing *s, int row, double weight) {
  ambulo__band_add_sparse(&s->h, &s->set[2].rows, row, weight);
  ambulo__update_row(&s->kkt.update, &s->set[2].rows, row, weight);
  s->weight[row] += weight;
}

static void dense_solution(const changing *s, double *want) {
  static double dense[ALL * ALL];
  int n = ALL, one = 1, info, pivot[ALL];
  memset(dense, 0, sizeof dense);
  for (int j = 0; j < TEST_UPDATE_N; j++) {
    for (int k = 0; k <= TEST_UPDATE_KD && j + k < TEST_UPDATE_N; k++)
      dense[j * ALL + j + k] = dense[(j + k) * ALL + j] = s->h.a[j * s->h.ld + k];
  }
  for (int k = 0, at = TEST_UPDATE_N; k < 2; k++) {
    const row_set *set = &s->set[k];
    for (int r = 0; r < set->rows.count; r++, at++) {
      for (int e = set->start[r]; e < set->start[r + 1]; e++)
        dense[set->column[e] * ALL + at] = dense[at * ALL + set->column[e]] = set->value[e];
    }
  }
  memcpy(want, s->a, sizeof s->a);
  memcpy(want + TEST_UPDATE_N, s->b, sizeof s->b);
  dgesv_(&n, &one, dense, &n, pivot, want, &n, &info);
  assert_int_equal(info, 0);
}

static void test_update_check(changing *s) {
  double want[ALL], d[TEST_UPDATE_N], l[LOCAL] = {0.0}, m[BORDER];
  dense_solution(s, want);
  ambulo__kkt_solve(&s->kkt, s->a, s->b, s->b + LOCAL, d, l, m);
  for (int i = 0; i < TEST_UPDATE_N; i++) assert_close(d[i], want[i], 1e-9);
  for (int i = 0; i < LOCAL; i++) assert_close(l[i], want[TEST_UPDATE_N + i], 1e-6);
  for (int i = 0; i < BORDER; i++) assert_close(m[i], want[TEST_UPDATE_N + LOCAL + i], 1e-7);
}

static void solutions_are_those_of_the_changed_system(void **state) {
  (void)state;
  static const char *const sets[] = {"avx512", "avx2", "baseline"};
  static const int more[] = {1, 3, 9, 8, 11}; /* tiles partly filled, full, and several */
  static changing s;
  for (int set = 0; set < 3; set++) {
    setenv("AMBULO_ISA", sets[set], 1);
    test_update_open_system(&s);
    for (int k = 0, row = 0; k < 5; k++) {
      for (int i = 0; i < more[k]; i++, row++) change(&s, row, 1.0 + 0.5 * row);
      if (k > 1) change(&s, 2, s.weight[2] == 0.0 ? 3.0 : -s.weight[2]);
      assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
      assert_int_equal(s.kkt.update.taken, row); /* not factored anew */
      test_update_check(&s);
    }
    ambulo__pool_clear(&s.pool);
  }
  unsetenv("AMBULO_ISA");
}

/* H without rows that it was factored with */
static void rows_that_go(void **state) {
  (void)state;
  static changing s;
  test_update_open_system(&s);
  for (int r = 0; r < 20; r++) change(&s, r, 2.0);
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
  for (int r = 4; r < 15; r++) change(&s, r, -2.0);
  for (int r = 30; r < 33; r++) change(&s, r, 2.0);
  assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
  assert_int_equal(s.kkt.update.taken, 14);
  test_update_check(&s);
  ambulo__pool_clear(&s.pool);
}

static void without_room_it_is_factored_anew(void **state) {
  (void)state;
  static changing s;
  test_update_open_system(&s);
  for (int r = 0; r < ROOM; r++) change(&s, r, 1.0);
  assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
  assert_int_equal(s.kkt.update.taken, ROOM);
  test_update_check(&s);
  change(&s, ROOM, 1.0);
  change(&s, 3, -1.0);
  assert_int_equal(ambulo__update_factor(&s.kkt.update), 1);
  assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
  assert_int_equal(s.kkt.update.taken, 0);
  test_update_check(&s);
  change(&s, 7, -1.0); /* and there is room again */
  assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
  assert_int_equal(s.kkt.update.taken, 1);
  test_update_check(&s);
  ambulo__pool_clear(&s.pool);
}

/* what one row made up is a difference of large numbers once it goes */
static void lost_digits_are_noticed(void **state) {
  (void)state;
  static changing s;
  test_update_open_system(&s);
  change(&s, 5, 1e10);
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
  change(&s, 5, -1e10);
  assert_int_equal(ambulo__update_factor(&s.kkt.update), 1);
  assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
  assert_int_equal(s.kkt.update.taken, 0);
  ambulo__pool_clear(&s.pool);
}

static void more_stiffness_takes_a_factor(void **state) {
  (void)state;
  static changing s;
  double d[TEST_UPDATE_N], l[LOCAL] = {0.0};
  test_update_open_system(&s);
  for (int e = 0; e < 4; e++) {
    s.set[0].column[4 + e] = s.set[0].column[e];
    s.set[0].value[4 + e] = s.set[0].value[e] * (1.0 + 1e-7 * e);
  }
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
  ambulo__kkt_solve(&s.kkt, s.a, s.b, s.b + LOCAL, d, l, NULL);
  assert_true(s.kkt.stiffness > 1e4);
  double before = s.kkt.penalty[0];
  change(&s, 0, 1.0);
  assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
  assert_int_equal(s.kkt.update.taken, 0);
  assert_true(s.kkt.penalty[0] > 50.0 * before);
  ambulo__pool_clear(&s.pool);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(solutions_satisfy_their_equations),
      cmocka_unit_test(the_relative_shift_is_one_of_the_largest),
      cmocka_unit_test(dependent_rows_are_noticed),
      cmocka_unit_test(no_rows_change_nothing),
      cmocka_unit_test(solutions_are_those_of_the_changed_system),
      cmocka_unit_test(rows_that_go),
      cmocka_unit_test(without_room_it_is_factored_anew),
      cmocka_unit_test(lost_digits_are_noticed),
      cmocka_unit_test(more_stiffness_takes_a_factor),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
