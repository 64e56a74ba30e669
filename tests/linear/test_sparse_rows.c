/* Compressed gradients are the dense ones of the public interface. */
#include "support/engine_fixture.h"
#include "ambulo/tools/load.h"
#include "support/problem_fixture.h"

static void compare(engine_fixture *f, const ambulo__sparse_rows *rows) {
  double *want = calloc((size_t)f->n, sizeof *want), *got = calloc((size_t)f->n, sizeof *got);
  for (int i = 0; i < rows->count; i += 7) {
    assert_int_equal(
        ambulo_problem_row_gradient(f->problem, f->engine->workspace, f->x, rows->row[i], want),
        AMBULO_OK);
    memset(got, 0, (size_t)f->n * sizeof *got);
    for (int e = rows->start[i]; e < rows->start[i + 1]; e++)
      got[rows->column[e]] +=
          ambulo__sparse_rows_gradient(rows, i)[e - rows->start[i]] / rows->scale[i];
    for (int j = 0; j < f->n; j++) assert_close(got[j], want[j], 1e-12);
  }
  free(want);
  free(got);
}

static void check_gradients(const char *name, const char *override, double size) {
  engine_fixture f;
  unsigned seed = 5;
  engine_open_with(&f, name, override);
  ambulo__row_roles *rows = &f.engine->linearized.rows;
  for (int j = 0; j < f.n; j++) f.x[j] = size * random_number(&seed);
  assert_int_equal(ambulo__evaluate_jacobian(f.engine->workspace, f.x), AMBULO_OK);
  ambulo__sparse_rows_fill(&rows->equality, f.engine->workspace, 0);
  ambulo__sparse_rows_fill(&rows->inequality, f.engine->workspace, 0);
  compare(&f, &rows->equality);
  compare(&f, &rows->inequality);
  compare(&f, &rows->border);
  for (int i = 0; i < rows->inequality.count; i++)
    ambulo__sparse_rows_set_scale(&rows->inequality, i, -0.1 - 0.01 * (i % 7));
  ambulo__sparse_rows_fill(&rows->inequality, f.engine->workspace, 1);
  compare(&f, &rows->inequality);
  engine_close(&f);
}

/* with ground reaction, too, where rows of the mechanics are made of others; limits of torques that
 * depend on all coordinates */
static void gradients_are_the_dense_ones(void **state) {
  (void)state;
  check_gradients("yardstick_12", NULL, 0.2);
  check_gradients("yardstick_12", "constraints.joint_limits=control_points", 0.2);
  check_gradients("support/walk_rigid", NULL, 0.01);
  check_gradients("support/walk_rigid", "constraints.torque_limits=true", 0.01);
  check_gradients("walk_carrying", "constraints.torque_limits=true", 0.01); /* by both hands */
  check_gradients("walk_exotendon", "constraints.torque_limits=true", 0.01);
}

static void transpose_is_adjoint_of_product(void **state) {
  (void)state;
  engine_fixture f;
  unsigned seed = 6;
  engine_open(&f, "yardstick_12");
  ambulo__sparse_rows *rows = &f.engine->linearized.rows.inequality;
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

static void scales_multiply_values_and_gradients(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo__sparse_rows *rows = &f.engine->linearized.rows.inequality;
  double *plain = calloc((size_t)rows->count, sizeof *plain);
  double *scaled = calloc((size_t)rows->count, sizeof *scaled);
  unsigned seed = 4;
  for (int j = 0; j < f.n; j++) f.x[j] = 0.1 * random_number(&seed);
  for (int i = 0; i < rows->count; i++) ambulo__sparse_rows_set_scale(rows, i, 1.0);
  assert_int_equal(ambulo__evaluate_jacobian(f.engine->workspace, f.x), AMBULO_OK);
  assert_int_equal(ambulo__sparse_rows_fill(rows, f.engine->workspace, 1), AMBULO_OK);
  ambulo__sparse_rows_values(rows, f.engine->workspace, plain);
  int last = rows->count - 1;
  double norm = ambulo__sparse_rows_norm(rows, last);
  assert_true(norm > 0.0);
  ambulo__sparse_rows_set_scale(rows, last, -2.0);
  assert_close(ambulo__sparse_rows_norm(rows, last), 2.0 * norm, 1e-12);
  ambulo__sparse_rows_set_scale(rows, last, -6.0);
  assert_close(ambulo__sparse_rows_norm(rows, last), 6.0 * norm, 1e-12);
  ambulo__sparse_rows_values(rows, f.engine->workspace, scaled);
  assert_close(scaled[last], -6.0 * plain[last], 1e-14);
  assert_true(scaled[0] == plain[0] && plain[last] != 0.0);
  free(plain);
  free(scaled);
  engine_close(&f);
}

static void a_gradient_that_is_not_finite_is_named(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo__sparse_rows *rows = &f.engine->linearized.rows.inequality;
  assert_int_equal(ambulo__evaluate_jacobian(f.engine->workspace, f.x), AMBULO_OK);
  assert_int_equal(ambulo__sparse_rows_fill(rows, f.engine->workspace, 1), AMBULO_OK);
  int bad = rows->count / 2;
  rows->scale[bad] = INFINITY;
  assert_int_equal(ambulo__sparse_rows_fill(rows, f.engine->workspace, 1), AMBULO_E_NUMERIC);
  const ambulo__table_row *row = &f.problem->table.rows[rows->row[bad]];
  const ambulo_fault *fault = &f.engine->workspace->fault;
  assert_string_equal(fault->name, row->family);
  assert_close(fault->time, row->time, 0.0);
  engine_close(&f);
}

/* all columns of a row lie in its host's window; rows of the caller may have any of those */
static void hosts_have_all_columns(void **state) {
  (void)state;
  engine_fixture f;
  engine_open_with(&f, "yardstick_12", "constraints.joint_limits=control_points");
  const ambulo__sparse_rows *rows = &f.engine->linearized.rows.inequality;
  for (int i = 0; i < rows->count; i++) {
    const ambulo__table_row *row = &f.problem->table.rows[rows->row[i]];
    int from = ambulo__node_first(f.problem, rows->host[i]);
    int to = from + ambulo__node_width(f.problem, rows->host[i]);
    if (row->node >= 0) continue;
    for (int t = 0; t < row->term_count; t++) {
      int unknown = f.problem->table.terms[row->first_term + t].channel;
      assert_true(unknown >= from && unknown < to);
    }
  }
  engine_close(&f);
}

static double height_of_hand(void *user, const ambulo_node_state *state,
                             ambulo_node_gradient *gradient) {
  (void)user;
  if (gradient) gradient->points[1] += 2.0 * state->points[1];
  return state->points[1] * state->points[1];
}

/* they may depend on all unknowns of their node, and are no straight lines */
static void rows_of_the_caller_are_filled_anew(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition d = arm_definition(f.model);
  ambulo_user_row own = {"hand", "m", AMBULO_NOT_NEGATIVE, 0.2, 0.8, height_of_hand, NULL};
  ambulo__sparse_rows rows;
  ambulo__pool pool;
  int seen = 0;
  d.user_rows = &own;
  d.user_row_count = 1;
  fixture_open(&f, &d);
  int *list = calloc((size_t)f.m, sizeof *list);
  for (int r = 0; r < f.m; r++) list[r] = r;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__sparse_rows_create(f.problem, list, f.m, NULL, &pool, &rows), AMBULO_OK);
  for (int fill = 1; fill >= 0; fill--) {
    for (int j = 0; j < f.n; j++) f.x[j] += 0.1;
    assert_int_equal(ambulo__evaluate_jacobian(f.workspace, f.x), AMBULO_OK);
    assert_int_equal(ambulo__sparse_rows_fill(&rows, f.workspace, fill), AMBULO_OK);
  }
  for (int i = 0; i < f.m; i++) {
    assert_int_equal(
        ambulo_problem_row_gradient(f.problem, f.workspace, f.x, rows.row[i], f.gradient),
        AMBULO_OK);
    seen += f.problem->table.rows[i].user >= 0;
    for (int e = rows.start[i]; e < rows.start[i + 1]; e++)
      f.gradient[rows.column[e]] -= rows.value[e];
    for (int j = 0; j < f.n; j++) assert_close(f.gradient[j], 0.0, 1e-12);
  }
  assert_true(seen > 0);
  free(list);
  ambulo__pool_clear(&pool);
  fixture_close(&f);
}

/* of a row that nobody has asked for yet, too */
static void what_is_not_finite_is_found(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo_workspace *w = f.engine->workspace;
  ambulo__sparse_rows *rows = &f.engine->linearized.rows.inequality;
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(f.problem->plan);
  size_t entries = (size_t)f.problem->blocks * (size_t)pattern.count * AMBULO__LANES;
  assert_int_equal(ambulo__evaluate_jacobian(w, f.x), AMBULO_OK);
  assert_int_equal(ambulo__sparse_rows_fill(rows, w, 0), AMBULO_OK);
  for (size_t e = 0; e < entries; e++) w->jq[e] = (double)NAN;
  assert_int_equal(ambulo__sparse_rows_fill(rows, w, 0), AMBULO_E_NUMERIC);
  assert_true(isnan(w->fault.value));
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gradients_are_the_dense_ones),
      cmocka_unit_test(what_is_not_finite_is_found),
      cmocka_unit_test(transpose_is_adjoint_of_product),
      cmocka_unit_test(products_are_sums_over_entries),
      cmocka_unit_test(control_point_rows_find_a_host),
      cmocka_unit_test(scales_multiply_values_and_gradients),
      cmocka_unit_test(a_gradient_that_is_not_finite_is_named),
      cmocka_unit_test(hosts_have_all_columns),
      cmocka_unit_test(rows_of_the_caller_are_filled_anew),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
