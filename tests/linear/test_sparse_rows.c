/* Compressed gradients are the dense ones of the public interface. */
#include "support/engine_fixture.h"

static void compare(engine_fixture *f, const ambulo__sparse_rows *rows) {
  double *want = calloc((size_t)f->n, sizeof *want), *got = calloc((size_t)f->n, sizeof *got);
  for (int i = 0; i < rows->count; i += 7) {
    assert_int_equal(
        ambulo_problem_row_gradient(f->problem, f->engine->workspace, f->x, rows->row[i], want),
        AMBULO_OK);
    memset(got, 0, (size_t)f->n * sizeof *got);
    for (int e = rows->start[i]; e < rows->start[i + 1]; e++)
      got[rows->column[e]] += rows->value[e] / rows->scale[i];
    for (int j = 0; j < f->n; j++) assert_close(got[j], want[j], 1e-12);
  }
  free(want);
  free(got);
}

static void check_gradients(const char *name, const char *override, double size) {
  engine_fixture f;
  unsigned seed = 5;
  engine_open_with(&f, name, override);
  ambulo__rows_split *rows = &f.engine->rows;
  for (int j = 0; j < f.n; j++) f.x[j] = size * random_number(&seed);
  assert_int_equal(ambulo__evaluate_jacobian(f.engine->workspace, f.x), AMBULO_OK);
  ambulo__sparse_rows_fill(&rows->equality, f.engine->workspace, 0);
  ambulo__sparse_rows_fill(&rows->inequality, f.engine->workspace, 0);
  compare(&f, &rows->equality);
  compare(&f, &rows->inequality);
  compare(&f, &rows->border);
  engine_close(&f);
}

/* with ground reaction, too, where rows of the mechanics are made of others; limits of torques that
 * depend on all coordinates */
static void gradients_are_the_dense_ones(void **state) {
  (void)state;
  check_gradients("yardstick_12", NULL, 0.2);
  check_gradients("walk_normal", NULL, 0.01);
  check_gradients("walk_normal", "constraints.torque_limits=true", 0.01);
}

static void transpose_is_adjoint_of_product(void **state) {
  (void)state;
  engine_fixture f;
  unsigned seed = 6;
  engine_open(&f, "yardstick_12");
  ambulo__sparse_rows *rows = &f.engine->rows.inequality;
  size_t n = (size_t)f.n, m = (size_t)rows->count;
  double *d = calloc(n, sizeof *d), *y = calloc(n, sizeof *y);
  double *w = calloc(m, sizeof *w), *v = calloc(m, sizeof *v);
  for (size_t j = 0; j < n; j++) d[j] = random_number(&seed);
  for (size_t i = 0; i < m; i++) w[i] = random_number(&seed);
  ambulo__sparse_rows_multiply(rows, d, v);
  ambulo__sparse_rows_add_transpose(rows, 2.0, w, y);
  double left = 0.0, right = 0.0;
  for (size_t i = 0; i < m; i++) left += 2.0 * w[i] * v[i];
  for (size_t j = 0; j < n; j++) right += y[j] * d[j];
  assert_close(left, right, 1e-11);
  free(d);
  free(y);
  free(w);
  free(v);
  engine_close(&f);
}

/* row i has i entries, every fourth column left out */
static void products_are_sums_over_entries(void **state) {
  (void)state;
  enum { ROWS = 11, COLUMNS = 30 };
  int start[ROWS + 1] = {0}, column[ROWS * ROWS], run_end[ROWS * ROWS];
  double value[ROWS * ROWS], d[COLUMNS], w[ROWS], out[ROWS], y[COLUMNS], want[COLUMNS];
  unsigned seed = 8;
  for (int i = 0; i < ROWS; i++) {
    start[i + 1] = start[i] + i;
    for (int e = 0; e < i; e++) {
      column[start[i] + e] = i + e + (i + e) / 3;
      value[start[i] + e] = random_number(&seed);
    }
    w[i] = i == 4 ? 0.0 : random_number(&seed);
  }
  for (int j = 0; j < COLUMNS; j++) {
    d[j] = random_number(&seed);
    y[j] = want[j] = random_number(&seed);
  }
  ambulo__sparse_rows rows = {
      .count = ROWS, .start = start, .column = column, .run_end = run_end, .value = value};
  ambulo__sparse_rows_find_runs(&rows);
  ambulo__sparse_rows_multiply(&rows, d, out);
  ambulo__sparse_rows_add_transpose(&rows, -2.0, w, y);
  for (int i = 0; i < ROWS; i++) {
    double sum = 0.0;
    for (int e = start[i]; e < start[i + 1]; e++) {
      sum += value[e] * d[column[e]];
      want[column[e]] -= 2.0 * w[i] * value[e];
    }
    assert_close(out[i], sum, 1e-14);
  }
  for (int j = 0; j < COLUMNS; j++) assert_close(y[j], want[j], 1e-14);
}

static void control_point_rows_find_a_host(void **state) {
  (void)state;
  const char *overrides[] = {"constraints.joint_limits=control_points"};
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load("models/yardstick_12.yaml", overrides, 1, NULL, NULL, &problem),
      AMBULO_OK);
  int periodic = 0, limits = 0;
  for (int r = 0; r < problem->rows; r++) {
    const ambulo__table_row *row = &problem->table.rows[r];
    int host = ambulo__row_host(problem, r);
    if (strcmp(row->family, "periodic") == 0) {
      assert_int_equal(host, -1);
      periodic++;
    }
    if (strcmp(row->family, "joint_limit") == 0) {
      assert_true(host >= 0);
      limits++;
    }
  }
  assert_int_equal(periodic, 36);
  assert_true(limits > 500);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gradients_are_the_dense_ones),
      cmocka_unit_test(transpose_is_adjoint_of_product),
      cmocka_unit_test(products_are_sums_over_entries),
      cmocka_unit_test(control_point_rows_find_a_host),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
