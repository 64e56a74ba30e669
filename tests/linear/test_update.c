/* Rows that come and go, against a dense LU factorization of the changed system. */
#include "linear/kkt.h"
#include "base/lapack.h"
#include "support/engine_fixture.h"

enum { N = 60, KD = 9, LOCAL = 10, BORDER = 5, MOVING = 48, ALL = N + LOCAL + BORDER };
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
  double a[N], b[LOCAL + BORDER], weight[MOVING];
} changing;

static void add_row(row_set *set, int row, const int column[4], unsigned *seed) {
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
      int first = k == 0 ? 5 * r : 7 * r % (N - KD);
      int local[4] = {first, first + 1, first + 4, first + KD};
      int border[4] = {r, r + 1, N - 8 + r, N - 1};
      add_row(set, r, k == 1 ? border : local, seed);
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

static void open_system(changing *s) {
  unsigned seed = 7;
  memset(s, 0, sizeof *s);
  s->problem.variables = N;
  ambulo__pool_init(&s->pool, NULL);
  assert_int_equal(ambulo__band_create(&s->pool, N, KD, &s->h), AMBULO_OK);
  for (int first = 0; first + KD < N; first++) {
    double row[KD + 1];
    for (int j = 0; j <= KD; j++) row[j] = random_number(&seed);
    ambulo__band_add_outer(&s->h, first, KD + 1, 1, 1.0, row);
  }
  ambulo__band_add_diagonal(&s->h, 0.5);
  fill_sets(s, &seed);
  for (int i = 0; i < N; i++) s->a[i] = random_number(&seed);
  for (int i = 0; i < LOCAL + BORDER; i++) s->b[i] = random_number(&seed);
  assert_int_equal(ambulo__kkt_create(&s->set[0].rows, &s->set[1].rows, KD, &s->pool, &s->kkt),
                   AMBULO_OK);
  assert_int_equal(ambulo__kkt_factor(&s->kkt, &s->h), 0);
}

/* H and the update change alike */
static void change(changing *s, int row, double weight) {
  ambulo__band_add_sparse(&s->h, &s->set[2].rows, row, weight);
  ambulo__kkt_change(&s->kkt, &s->set[2].rows, row, weight);
  s->weight[row] += weight;
}

static void dense_solution(const changing *s, double *want) {
  static double dense[ALL * ALL];
  int n = ALL, one = 1, info, pivot[ALL];
  memset(dense, 0, sizeof dense);
  for (int j = 0; j < N; j++) {
    for (int k = 0; k <= KD && j + k < N; k++)
      dense[j * ALL + j + k] = dense[(j + k) * ALL + j] = s->h.a[j * s->h.ld + k];
  }
  for (int k = 0, at = N; k < 2; k++) {
    const row_set *set = &s->set[k];
    for (int r = 0; r < set->rows.count; r++, at++) {
      for (int e = set->start[r]; e < set->start[r + 1]; e++)
        dense[set->column[e] * ALL + at] = dense[at * ALL + set->column[e]] = set->value[e];
    }
  }
  memcpy(want, s->a, sizeof s->a);
  memcpy(want + N, s->b, sizeof s->b);
  dgesv_(&n, &one, dense, &n, pivot, want, &n, &info);
  assert_int_equal(info, 0);
}

static void check(changing *s) {
  double want[ALL], d[N], l[LOCAL] = {0.0}, m[BORDER];
  dense_solution(s, want);
  ambulo__kkt_solve(&s->kkt, s->a, s->b, s->b + LOCAL, d, l, m);
  for (int i = 0; i < N; i++) assert_close(d[i], want[i], 1e-9);
  for (int i = 0; i < LOCAL; i++) assert_close(l[i], want[N + i], 1e-6);
  for (int i = 0; i < BORDER; i++) assert_close(m[i], want[N + LOCAL + i], 1e-7);
}

static void solutions_are_those_of_the_changed_system(void **state) {
  (void)state;
  static const char *const sets[] = {"avx512", "avx2", "baseline"};
  static const int more[] = {1, 3, 9, 8, 11}; /* tiles partly filled, full, and several */
  static changing s;
  for (int set = 0; set < 3; set++) {
    setenv("AMBULO_ISA", sets[set], 1);
    open_system(&s);
    for (int k = 0, row = 0; k < 5; k++) {
      for (int i = 0; i < more[k]; i++, row++) change(&s, row, 1.0 + 0.5 * row);
      if (k > 1) change(&s, 2, s.weight[2] == 0.0 ? 3.0 : -s.weight[2]);
      assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
      assert_int_equal(s.kkt.update.taken, row); /* not factored anew */
      check(&s);
    }
    ambulo__pool_clear(&s.pool);
  }
  unsetenv("AMBULO_ISA");
}

/* H without rows that it was factored with */
static void rows_that_go(void **state) {
  (void)state;
  static changing s;
  open_system(&s);
  for (int r = 0; r < 20; r++) change(&s, r, 2.0);
  assert_int_equal(ambulo__kkt_factor(&s.kkt, &s.h), 0);
  for (int r = 4; r < 15; r++) change(&s, r, -2.0);
  for (int r = 30; r < 33; r++) change(&s, r, 2.0);
  assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
  assert_int_equal(s.kkt.update.taken, 14);
  check(&s);
  ambulo__pool_clear(&s.pool);
}

static void without_room_it_is_factored_anew(void **state) {
  (void)state;
  static changing s;
  open_system(&s);
  for (int r = 0; r < ROOM; r++) change(&s, r, 1.0);
  assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
  assert_int_equal(s.kkt.update.taken, ROOM);
  check(&s);
  change(&s, ROOM, 1.0);
  change(&s, 3, -1.0);
  assert_int_equal(ambulo__update_factor(&s.kkt.update), 1);
  assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
  assert_int_equal(s.kkt.update.taken, 0);
  check(&s);
  change(&s, 7, -1.0); /* and there is room again */
  assert_int_equal(ambulo__kkt_renew(&s.kkt, &s.h), 0);
  assert_int_equal(s.kkt.update.taken, 1);
  check(&s);
  ambulo__pool_clear(&s.pool);
}

/* what one row made up is a difference of large numbers once it goes */
static void lost_digits_are_noticed(void **state) {
  (void)state;
  static changing s;
  open_system(&s);
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
  double d[N], l[LOCAL] = {0.0};
  open_system(&s);
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
      cmocka_unit_test(solutions_are_those_of_the_changed_system),
      cmocka_unit_test(rows_that_go),
      cmocka_unit_test(without_room_it_is_factored_anew),
      cmocka_unit_test(lost_digits_are_noticed),
      cmocka_unit_test(more_stiffness_takes_a_factor),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
