/* The least violation: zero where a motion exists, balanced forces where none does. */
#include "judge/elastic.h"
#include "support/engine_fixture.h"

typedef struct elastic_fixture {
  engine_fixture engine;
  ambulo__pool pool;
  ambulo__elastic elastic;
} elastic_fixture;

static void open_problem(elastic_fixture *f, const char *name) {
  ambulo_allocator allocator = ambulo__allocator_or_default(NULL);
  engine_open(&f->engine, name);
  ambulo__pool_init(&f->pool, &allocator);
  ambulo_workspace *workspace = f->engine.engine->workspace;
  assert_int_equal(ambulo__evaluate(workspace, f->engine.x), AMBULO_OK);
  assert_int_equal(
      ambulo__elastic_create(f->engine.problem, workspace, &f->engine.run, &f->pool, &f->elastic),
      AMBULO_OK);
}

static void close_problem(elastic_fixture *f) {
  ambulo__pool_clear(&f->pool);
  engine_close(&f->engine);
}

static double worst_excess(const elastic_fixture *f) {
  double worst = 0.0;
  for (int r = 0; r < f->engine.problem->rows; r++)
    worst = fmax(worst, ambulo__elastic_excess(&f->elastic, r, f->elastic.workspace->row_value[r]));
  return worst;
}

static void feasible_problems_end_at_zero(void **state) {
  (void)state;
  static const char *const names[] = {"yardstick_12", "yardstick_36", "pendulum_swing"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    elastic_fixture f;
    open_problem(&f, names[i]);
    assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 1);
    if (worst_excess(&f) > 1e-7) print_error("%s: %g left\n", names[i], worst_excess(&f));
    assert_true(worst_excess(&f) <= 1e-7);
    close_problem(&f);
  }
}

/* at the minimum sum w^2 e grad e vanishes: the gradient of the energy, by one reverse sweep */
static void forces_balance_where_rows_conflict(void **state) {
  (void)state;
  elastic_fixture f;
  open_problem(&f, "../tests/infeasible/range_excludes_posture");
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 1);
  const ambulo_problem *p = f.engine.problem;
  double *weight = calloc((size_t)p->rows, sizeof *weight), largest = 0.0, single = 0.0;
  double *gradient = calloc((size_t)f.engine.n, sizeof *gradient);
  for (int r = 0; r < p->rows; r++) {
    double value = f.elastic.workspace->row_value[r], size = f.elastic.size[r];
    if (p->table.rows[r].relation == AMBULO_EQUAL || value < 0.0) weight[r] = value / (size * size);
    single = fmax(single, fabs(weight[r]));
  }
  ambulo__gradient(f.elastic.workspace, 0.0, weight, gradient);
  for (int j = 0; j < f.engine.n; j++) largest = fmax(largest, fabs(gradient[j]));
  assert_true(worst_excess(&f) > 0.02);
  if (largest > 0.02 * single) print_error("gradient %g, forces %g\n", largest, single);
  assert_true(largest <= 0.02 * single);
  free(gradient);
  free(weight);
  close_problem(&f);
}

static void a_passed_deadline_leaves_x_alone(void **state) {
  (void)state;
  elastic_fixture f;
  open_problem(&f, "walker_2d_step");
  f.elastic.deadline = 0.0;
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 0);
  for (int j = 0; j < f.engine.n; j++) assert_true(f.engine.x[j] == 0.0);
  close_problem(&f);
}

static int refuse(void *user, const ambulo_progress *progress) {
  (void)progress;
  ++*(int *)user;
  return 1;
}

static void the_caller_can_stop_it(void **state) {
  (void)state;
  elastic_fixture f;
  int calls = 0;
  open_problem(&f, "walker_2d_step");
  f.engine.options.progress = refuse;
  f.engine.options.user = &calls;
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 0);
  assert_int_equal(calls, 1);
  assert_true(f.elastic.cancelled);
  close_problem(&f);
}

static int refuse_later(void *user, const ambulo_progress *progress) {
  (void)progress;
  return --*(int *)user < 0;
}

/* before every factorization, which takes seconds for large problems */
static void the_caller_is_asked_at_every_step(void **state) {
  (void)state;
  for (int calls = 1; calls < 8; calls++) {
    elastic_fixture f;
    int left = calls;
    open_problem(&f, "walker_2d_step");
    f.engine.options.progress = refuse_later;
    f.engine.options.user = &left;
    assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 0);
    assert_true(f.elastic.cancelled);
    assert_true(f.elastic.work <= (double)calls);
    close_problem(&f);
  }
}

static void stiff_rows_hold_while_others_give_way(void **state) {
  (void)state;
  elastic_fixture f;
  open_problem(&f, "../tests/infeasible/torque_too_weak");
  const ambulo_problem *p = f.engine.problem;
  for (int r = 0; r < p->rows; r++)
    f.elastic.weight[r] = strcmp(p->table.rows[r].family, "torque_limit") ? 1e3 : 1.0;
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 1);
  for (int r = 0; r < p->rows; r++) {
    if (f.elastic.weight[r] > 1.0)
      assert_close(f.elastic.workspace->row_value[r] < 0.0 ? f.elastic.workspace->row_value[r]
                                                           : 0.0,
                   0.0, 1e-4);
  }
  double weight = p->table.weight; /* torques are measured by the body weight times 1 m */
  assert_close(weight, 3.0 * 9.81, 1e-9);
  assert_true(worst_excess(&f) * weight > 1.8); /* of a limit of 6 N m */
  close_problem(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(feasible_problems_end_at_zero),
                                     cmocka_unit_test(forces_balance_where_rows_conflict),
                                     cmocka_unit_test(a_passed_deadline_leaves_x_alone),
                                     cmocka_unit_test(the_caller_can_stop_it),
                                     cmocka_unit_test(the_caller_is_asked_at_every_step),
                                     cmocka_unit_test(stiff_rows_hold_while_others_give_way)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
