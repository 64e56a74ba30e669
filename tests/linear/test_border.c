/* Banded systems with border rows, put back into the equations they solve. */
#include "linear/border.h"
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(solutions_satisfy_their_equations),
                                     cmocka_unit_test(the_relative_shift_is_one_of_the_largest),
                                     cmocka_unit_test(dependent_rows_are_noticed),
                                     cmocka_unit_test(no_rows_change_nothing)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
