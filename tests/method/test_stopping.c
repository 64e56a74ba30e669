/* What ends the method on one grid, point by point. */
#include "method/stopping.h"
#include "support/engine_fixture.h"

/* a point with these figures; x is what polishing would move */
static ambulo_ending at(ambulo__stopping *s, engine_fixture *f, double objective, double violation,
                        double gradient) {
  f->engine->reached.objective = objective;
  f->engine->reached.violation = violation;
  f->engine->reached.gradient_norm = gradient;
  f->engine->reached.value = objective;
  return ambulo__stopping_test(s, f->engine, f->x);
}

static void rows_value_and_gradient_have_to_be_right(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo__stopping s = ambulo__stopping_begin(0);
  assert_int_equal(at(&s, &f, 2.0, 1e-7, 1e-5), AMBULO_ENDING_NONE);                /* the first */
  assert_int_equal(at(&s, &f, 2.0 * (1.0 + 3e-5), 1e-7, 1e-5), AMBULO_ENDING_NONE); /* moved */
  assert_int_equal(at(&s, &f, 2.0 * (1.0 + 3.1e-5), 1e-3, 1e-5), AMBULO_ENDING_NONE); /* rows */
  assert_int_equal(at(&s, &f, 2.0 * (1.0 + 3.1e-5), 1e-7, 1e-3), AMBULO_ENDING_NONE); /* slope */
  assert_int_equal(at(&s, &f, 2.0 * (1.0 + 3.1e-5), 1e-7, 5e-5), AMBULO_ENDING_CONVERGED);
  engine_close(&f);
}

static void a_value_that_stays_ends_it(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo__stopping s = ambulo__stopping_begin(0);
  assert_int_equal(at(&s, &f, 2.0, 1e-7, 1.0), AMBULO_ENDING_NONE);
  assert_int_equal(at(&s, &f, 2.0, 1e-7, 1.0), AMBULO_ENDING_NONE);
  assert_int_equal(at(&s, &f, 2.0, 1e-7, 1.0), AMBULO_ENDING_NONE);
  assert_int_equal(at(&s, &f, 2.0, 1e-7, 1.0), AMBULO_ENDING_SETTLED);
  engine_close(&f);
}

static void coarse_grids_are_content_with_less(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo__stopping s = ambulo__stopping_begin(1);
  assert_int_equal(at(&s, &f, 2.0, 9e-3, 1.0), AMBULO_ENDING_NONE);
  assert_int_equal(at(&s, &f, 2.018, 9e-3, 1.0), AMBULO_ENDING_CONVERGED);
  s = ambulo__stopping_begin(1);
  (void)at(&s, &f, 2.0, 9e-3, 1.0);
  assert_int_equal(at(&s, &f, 2.022, 9e-3, 1.0), AMBULO_ENDING_NONE);
  assert_int_equal(at(&s, &f, 2.022, 1.1e-2, 1.0), AMBULO_ENDING_NONE);
  engine_close(&f);
}

static void what_vanishes_ends_it(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo__stopping s = ambulo__stopping_begin(0);
  double tiny = 0.5 * f.engine->negligible * f.engine->objective_scale;
  assert_true(tiny > 0.0);
  (void)at(&s, &f, 1e4 * tiny, 1e-7, 1.0);
  assert_int_equal(at(&s, &f, 3.0 * tiny, 1e-7, 1.0), AMBULO_ENDING_NONE);
  assert_int_equal(at(&s, &f, tiny, 1e-7, 1.0), AMBULO_ENDING_VANISHED);
  s = ambulo__stopping_begin(0); /* small from the first: relative tests do */
  (void)at(&s, &f, 2.0 * tiny, 1e-7, 1.0);
  assert_int_equal(at(&s, &f, tiny, 1e-7, 1.0), AMBULO_ENDING_NONE);
  engine_close(&f);
}

/* rows that do not give way raise the penalty's bound, twice, and then end it */
static void stalls_raise_the_bound(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo__stopping s = ambulo__stopping_begin(0);
  double bounds[3];
  int points = 0, raised = 0;
  ambulo_ending ending = AMBULO_ENDING_NONE;
  bounds[0] = s.penalty_limit;
  for (; points < 200 && !ending; points++) {
    double bound = s.penalty_limit;
    f.engine->rho = bound;
    ending = at(&s, &f, 2.0, 0.3, 1.0);
    if (s.penalty_limit != bound) bounds[++raised] = s.penalty_limit;
  }
  assert_int_equal(ending, AMBULO_ENDING_STALLED);
  assert_int_equal(raised, 2);
  assert_close(bounds[1] / bounds[0], 10.0, 1e-12);
  assert_close(bounds[2] / bounds[0], 100.0, 1e-12);
  s = ambulo__stopping_begin(0); /* below the bound nothing is a stall */
  f.engine->rho = 0.5 * s.penalty_limit;
  for (int k = 0; k < 60; k++) assert_int_equal(at(&s, &f, 2.0, 0.3, 1.0), AMBULO_ENDING_NONE);
  assert_true(s.penalty_limit == bounds[0]);
  engine_close(&f);
}

/* slowly, while the objective moves on: only the bound rises */
static void slow_rows_raise_the_bound(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo__stopping s = ambulo__stopping_begin(0);
  double first = s.penalty_limit, violation = 0.3, objective = 2.0;
  f.engine->rho = first;
  for (int k = 0; k < 18; k++) {
    assert_int_equal(at(&s, &f, objective, violation, 1.0), AMBULO_ENDING_NONE);
    violation *= 0.99;
    objective *= 1.01;
  }
  assert_close(s.penalty_limit / first, 10.0, 1e-12);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(rows_value_and_gradient_have_to_be_right),
                                     cmocka_unit_test(a_value_that_stays_ends_it),
                                     cmocka_unit_test(coarse_grids_are_content_with_less),
                                     cmocka_unit_test(what_vanishes_ends_it),
                                     cmocka_unit_test(stalls_raise_the_bound),
                                     cmocka_unit_test(slow_rows_raise_the_bound)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
