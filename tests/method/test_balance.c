/* What rows are divided by: where they are long in the metric by more than their unit, wherever it
 * is asked from and how often. */
#include "method/balance.h"
#include "support/engine_fixture.h"

static double length_in_units(const engine_fixture *f, int i) {
  const ambulo__linearized *at = &f->engine->linearized;
  return ambulo__band_row_length(&at->base, &at->rows.inequality, i) * at->rows.size[i] /
         at->rows.unit[i];
}

/* v = -c / (s max(1, sqrt l)) */
static void long_rows_are_weakened(void **state) {
  (void)state;
  engine_fixture f;
  int weaker = 0, same = 0;
  engine_open_restored(&f, "walk_normal");
  ambulo__balance_rows(f.engine, f.x);
  for (int i = 0; i < f.engine->setup->inequalities; i++) {
    const ambulo__rows_split *rows = f.engine->setup->rows;
    double length = length_in_units(&f, i);
    double divided = rows->size[i] / rows->unit[i];
    if (fabs(length - 1.0) < 1e-9) continue;
    assert_close(length > 1.0 ? divided / sqrt(length) : divided, 1.0, 1e-12);
    assert_close(rows->inequality.scale[i] * rows->size[i], -1.0, 1e-15);
    weaker += length > 2.0;
    same += length < 0.5;
  }
  assert_true(weaker > 100 && same > 100);
  engine_close(&f);
}

/* forces lambda / size stay as they are, and a violation is in the rows' units as before */
static void forces_and_violations_stay(void **state) {
  (void)state;
  engine_fixture f;
  engine_open_restored(&f, "walk_normal");
  ambulo__engine *e = f.engine;
  int m = e->setup->inequalities;
  double *force = calloc((size_t)m, sizeof *force);
  for (int i = 0; i < m; i++) {
    e->iterate.lambda[i] = 1.0 + 0.01 * (i % 7);
    force[i] = e->iterate.lambda[i] / e->setup->rows->size[i];
  }
  assert_int_equal(ambulo__evaluate(e->workspace, f.x), AMBULO_OK);
  double before = ambulo__engine_excess(e, e->measured.excess);
  ambulo__balance_rows(e, f.x);
  double after = ambulo__engine_excess(e, e->measured.excess);
  assert_true(before > 0.0);
  assert_close(after / before, 1.0, 1e-12);
  for (int i = 0; i < m; i++)
    assert_close(e->iterate.lambda[i] / e->setup->rows->size[i] / force[i], 1.0, 1e-12);
  free(force);
  engine_close(&f);
}

/* sizes do not pile up */
static void twice_is_once(void **state) {
  (void)state;
  engine_fixture f;
  engine_open_restored(&f, "walk_normal");
  int m = f.engine->setup->inequalities;
  double *first = calloc((size_t)m, sizeof *first);
  ambulo__balance_rows(f.engine, f.x);
  memcpy(first, f.engine->setup->rows->size, (size_t)m * sizeof *first);
  ambulo__balance_rows(f.engine, f.x);
  for (int i = 0; i < m; i++) assert_close(f.engine->setup->rows->size[i] / first[i], 1.0, 1e-12);
  free(first);
  engine_close(&f);
}

/* a torque that is not a number: whoever comes next will say so */
static void what_is_not_finite_changes_nothing(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "walk_normal");
  int m = f.engine->setup->inequalities;
  for (int j = 0; j < f.n; j++) f.x[j] = (double)NAN;
  ambulo__balance_rows(f.engine, f.x);
  for (int i = 0; i < m; i++)
    assert_true(f.engine->setup->rows->size[i] == f.engine->setup->rows->unit[i]);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(long_rows_are_weakened),
      cmocka_unit_test(forces_and_violations_stay),
      cmocka_unit_test(twice_is_once),
      cmocka_unit_test(what_is_not_finite_changes_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
