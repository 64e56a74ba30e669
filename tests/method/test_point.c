/* What is measured at the point that the workspace holds: errors relative to sizes; and that
 * nothing in it takes NaN for zero. */
#include "method/parameters.h"
#include "method/point.h"
#include "solver/session.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"
#include "support/test.h"

static void scatter(double *x, int n, double size) {
  unsigned seed = 5;
  for (int j = 0; j < n; j++) x[j] += size * random_number(&seed);
}

/* of rows whose values the problem has, relative to their sizes; those that depend are left out */
static double worst_of(const engine_fixture *f, const ambulo__sparse_rows *rows, int equal) {
  double worst = 0.0;
  for (int i = 0; i < rows->count; i++) {
    const ambulo__table_row *row = &f->problem->table.rows[rows->row[i]];
    double value = f->engine->workspace->row_value[rows->row[i]];
    worst = fmax(worst, (equal ? fabs(value) : fmax(0.0, -value)) / row->size);
  }
  return worst;
}

/* lengths, rates and torques, each beside its own size */
static void errors_are_relative_to_sizes(void **state) {
  (void)state;
  static const char *const names[] = {"support/two_link_reach", "support/walker_2d_step",
                                      "support/walk_rigid"};
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 4; k++) {
      engine_fixture f;
      engine_open(&f, names[i]);
      scatter(f.x, f.n, pow(10.0, -k));
      assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
      double equal = fmax(worst_of(&f, &f.engine->linearized.rows.equality, 1),
                          worst_of(&f, &f.engine->linearized.rows.border, 1));
      double other = worst_of(&f, &f.engine->linearized.rows.inequality, 0);
      assert_close(ambulo__engine_equality_error(f.engine), equal, 1e-12 * equal);
      assert_close(ambulo__engine_excess(f.engine, f.engine->measured.excess), other,
                   1e-12 * other);
      assert_close(ambulo__violation_at(f.engine, f.x), fmax(equal, other),
                   1e-12 * (equal + other));
      engine_close(&f);
    }
  }
}

/* border rows alone: matching ends */
static void ends_count_among_the_equalities(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "support/walker_2d_step");
  assert_true(f.engine->setup->borders > 0);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  memset(f.engine->workspace->row_value, 0,
         (size_t)f.problem->rows * sizeof *f.engine->workspace->row_value);
  int row = f.engine->linearized.rows.border.row[0];
  f.engine->workspace->row_value[row] = 0.25 * f.problem->table.rows[row].size;
  assert_close(ambulo__engine_equality_error(f.engine), 0.25, 1e-12);
  engine_close(&f);
}

static void nan_is_no_zero(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "support/two_link_reach");
  ambulo__engine *e = f.engine;
  assert_int_equal(ambulo__evaluate_jacobian(e->workspace, f.x), AMBULO_OK);
  double *weights = calloc((size_t)e->setup->inequalities, sizeof *weights);
  assert_int_equal(ambulo__engine_gradient(e, 1.0, weights, NULL, e->quadratic->gradient),
                   AMBULO_OK);
  assert_int_equal(e->run->faults, 0);
  weights[e->setup->inequalities / 2] = NAN;
  assert_int_equal(ambulo__engine_gradient(e, 1.0, weights, NULL, e->quadratic->gradient),
                   AMBULO_E_NUMERIC);
  assert_int_equal(e->run->faults, 1);
  free(weights);
  e->workspace->row_value[e->linearized.rows.inequality.row[0]] = NAN;
  assert_true(isnan(ambulo__engine_excess(e, e->measured.excess)));
  e->workspace->row_value[e->linearized.rows.equality.row[0]] = NAN;
  assert_true(isnan(ambulo__engine_equality_error(e)));
  memset(e->quadratic->step, 0, (size_t)e->setup->n * sizeof *e->quadratic->step);
  e->quadratic->step[1] = NAN;
  assert_true(isnan(ambulo__step_limit(e->setup, e->quadratic->step, 0.5)));
  engine_close(&f);
}

static void fill_at(engine_fixture *f, const double *x, double mu) {
  assert_int_equal(ambulo__evaluate_jacobian(f->engine->workspace, x), AMBULO_OK);
  assert_int_equal(ambulo__engine_fill_metric(f->engine, mu), 0);
}

/* largest difference of the base from what it is when filled afresh at `x` with mu */
static double difference_from_fresh(engine_fixture *f, const double *x, double mu) {
  ambulo__band *base = &f->engine->linearized.base;
  size_t count = (size_t)base->n * (size_t)base->ld;
  double *kept = malloc(count * sizeof *kept), worst = 0.0;
  memcpy(kept, base->a, count * sizeof *kept);
  f->engine->linearized.filled_mu = -1.0;
  fill_at(f, x, mu);
  for (size_t i = 0; i < count; i++) worst = fmax(worst, fabs(kept[i] - base->a[i]));
  free(kept);
  return worst;
}

/* H0 is kept over steps within the reach, mu follows; beyond, it is that of the point, wherever
 * each of several short steps began */
static void curvature_is_kept_nearby_only(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  double *moved = calloc((size_t)f.n, sizeof *moved), reach = ambulo__engine_roughness(f.engine);
  assert_close(reach, 0.01, 1e-15);
  for (int j = 0; j < f.n; j++) f.x[j] = 0.3 * sin(j);
  fill_at(&f, f.x, 0.25);
  for (int j = 0; j < f.n; j++) moved[j] = f.x[j] + 0.9 * reach;
  fill_at(&f, moved, 0.5);
  assert_true(difference_from_fresh(&f, moved, 0.5) > 1e-6);
  f.engine->linearized.filled_mu = -1.0;
  fill_at(&f, f.x, 0.25);
  fill_at(&f, moved, 0.5);
  assert_true(difference_from_fresh(&f, f.x, 0.5) <= 1e-12);
  fill_at(&f, moved, 0.25);
  moved[f.n / 2] += 0.2 * reach;
  fill_at(&f, moved, 0.25);
  assert_true(difference_from_fresh(&f, moved, 0.25) == 0.0);
  moved[f.n / 2] = NAN;
  assert_true(ambulo__evaluate_jacobian(f.engine->workspace, moved) != AMBULO_OK);
  free(moved);
  engine_close(&f);
}

/* A point and all that belongs to it, copied. */

enum { N = 5, INEQUALITIES = 3, EQUALITIES = 2 };

static void a_copy_has_everything(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__trial from, to;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__trial_create(N, INEQUALITIES, EQUALITIES, &pool, &from), AMBULO_OK);
  assert_int_equal(ambulo__trial_create(N, INEQUALITIES, EQUALITIES, &pool, &to), AMBULO_OK);
  assert_true(from.value == HUGE_VAL);
  for (int j = 0; j < N; j++) from.x[j] = 1.0 + j;
  for (int i = 0; i < INEQUALITIES; i++) {
    from.excess[i] = -1.0 - i;
    from.multiplier[i] = 10.0 + i;
  }
  for (int i = 0; i < EQUALITIES; i++) from.equality_multiplier[i] = 20.0 + i;
  from.value = 1.5;
  from.objective = 2.5;
  from.violation = 3.5;
  from.gradient_norm = 4.5;
  ambulo__trial_copy(&from, &to);
  assert_memory_equal(to.x, from.x, sizeof(double) * N);
  assert_memory_equal(to.excess, from.excess, sizeof(double) * INEQUALITIES);
  assert_memory_equal(to.multiplier, from.multiplier, sizeof(double) * INEQUALITIES);
  assert_memory_equal(to.equality_multiplier, from.equality_multiplier,
                      sizeof(double) * EQUALITIES);
  assert_true(to.x != from.x && to.value == 1.5 && to.objective == 2.5);
  assert_true(to.violation == 3.5 && to.gradient_norm == 4.5);
  ambulo__pool_clear(&pool);
}

static void memory_that_is_out_is_told(void **state) {
  (void)state;
  for (long k = 0; k < 5; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__pool pool;
    ambulo__trial trial;
    ambulo__pool_init(&pool, &hook);
    assert_int_equal(ambulo__trial_create(N, INEQUALITIES, EQUALITIES, &pool, &trial),
                     k < 4 ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__pool_clear(&pool);
    assert_int_equal(memory.live, 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(errors_are_relative_to_sizes),
      cmocka_unit_test(curvature_is_kept_nearby_only),
      cmocka_unit_test(ends_count_among_the_equalities),
      cmocka_unit_test(nan_is_no_zero),
      cmocka_unit_test(a_copy_has_everything),
      cmocka_unit_test(memory_that_is_out_is_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
