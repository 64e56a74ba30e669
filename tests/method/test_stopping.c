/* What ends the method on one grid, point by point. */
#include "method/pipeline.h"
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
  for (int k = 0; k < 6; k++) assert_int_equal(at(&s, &f, 2.0, 1e-7, 1.0), AMBULO_ENDING_NONE);
  assert_int_equal(at(&s, &f, 2.0, 1e-7, 1.0), AMBULO_ENDING_SETTLED);
  engine_close(&f);
}

static void coarse_grids_are_content_with_less(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo__stopping s = ambulo__stopping_begin(1);
  assert_int_equal(at(&s, &f, 2.0, 9e-3, 0.19), AMBULO_ENDING_NONE);
  assert_int_equal(at(&s, &f, 2.003, 9e-3, 0.21), AMBULO_ENDING_NONE); /* slope */
  assert_int_equal(at(&s, &f, 2.005, 9e-3, 0.19), AMBULO_ENDING_CONVERGED);
  s = ambulo__stopping_begin(1);
  (void)at(&s, &f, 2.0, 9e-3, 0.19);
  assert_int_equal(at(&s, &f, 2.007, 9e-3, 0.19), AMBULO_ENDING_NONE);
  assert_int_equal(at(&s, &f, 2.007, 1.1e-2, 0.19), AMBULO_ENDING_NONE);
  engine_close(&f);
}

static void what_vanishes_ends_it(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo__stopping s = ambulo__stopping_begin(0);
  double tiny = 0.5 * f.engine->setup->negligible * f.engine->setup->objective_scale;
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
    f.engine->iterate.rho = bound;
    ending = at(&s, &f, 2.0, 0.3, 1.0);
    if (s.penalty_limit != bound) bounds[++raised] = s.penalty_limit;
  }
  assert_int_equal(ending, AMBULO_ENDING_STALLED);
  assert_int_equal(points, 1 + 3 * 6); /* a point that does not move at all */
  assert_int_equal(raised, 2);
  assert_close(bounds[1] / bounds[0], 10.0, 1e-12);
  assert_close(bounds[2] / bounds[0], 100.0, 1e-12);
  s = ambulo__stopping_begin(0); /* below the bound nothing is a stall */
  f.engine->iterate.rho = 0.5 * s.penalty_limit;
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
  f.engine->iterate.rho = first;
  for (int k = 0; k < 18; k++) {
    assert_int_equal(at(&s, &f, objective, violation, 1.0), AMBULO_ENDING_NONE);
    violation *= 0.99;
    objective *= 1.01;
  }
  assert_close(s.penalty_limit / first, 10.0, 1e-12);
  engine_close(&f);
}

/* at the first bound: neither a violation that creeps nor a value that moves keeps a coarse grid */
static void coarse_grids_stall_sooner(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  for (int run = 0; run < 3; run++) {
    ambulo__stopping s = ambulo__stopping_begin(1);
    ambulo_ending ending = AMBULO_ENDING_NONE;
    double bound = s.penalty_limit, violation = 0.3;
    int points = 0;
    f.engine->iterate.rho = run == 2 ? 0.5 * bound : bound;
    for (; points < 14 && !ending; points++) {
      ending = at(&s, &f, 2.0 + 0.1 * points, violation, 1.0);
      if (run == 1) violation *= 0.8;
    }
    assert_int_equal(ending, run == 0 ? AMBULO_ENDING_STALLED : AMBULO_ENDING_NONE);
    assert_int_equal(points, run == 0 ? 8 : 14);
    assert_true(s.penalty_limit == bound);
  }
  engine_close(&f);
}

/* what settles while rows are violated, or vanishes there, says nothing */
static void only_points_near_the_rows_count(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  ambulo__stopping s = ambulo__stopping_begin(0);
  f.engine->iterate.rho = 10.0;
  for (int k = 0; k < 6; k++) assert_int_equal(at(&s, &f, 2.0, 1e-3, 1.0), AMBULO_ENDING_NONE);
  assert_int_equal(at(&s, &f, 2.0, 1e-7, 1.0), AMBULO_ENDING_NONE);
  double tiny = 0.1 * f.engine->setup->negligible * f.engine->setup->objective_scale;
  s = ambulo__stopping_begin(0);
  (void)at(&s, &f, 1e6 * tiny, 1e-7, 1.0);
  assert_int_equal(at(&s, &f, tiny, 1e-3, 1.0), AMBULO_ENDING_NONE);
  engine_close(&f);
}

/* beside the motionless body, where the terms have no measure of their own */
static void terms_without_a_measure_vanish_too(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "walk_tracking");
  assert_true(f.engine->setup->negligible < 0.0 && f.engine->setup->at_rest > 0.0);
  double rest = f.engine->setup->at_rest * f.engine->setup->objective_scale;
  ambulo__stopping s = ambulo__stopping_begin(0);
  assert_int_equal(at(&s, &f, 2e-6 * rest, 1e-7, 1.0), AMBULO_ENDING_NONE);
  assert_int_equal(at(&s, &f, -5e-7 * rest, 1e-7, 1.0), AMBULO_ENDING_VANISHED);
  engine_close(&f);
}

/* at the last bound: a stall is no tenth off the violation and no thousandth of the value */
static void what_counts_as_progress(void **state) {
  (void)state;
  static const double violations[] = {0.98, 0.85, 0.98}, values[] = {1.0, 1.0, 1.002};
  engine_fixture f;
  engine_open(&f, "yardstick_12");
  for (int run = 0; run < 3; run++) {
    ambulo__stopping s = ambulo__stopping_begin(0);
    ambulo_ending ending = AMBULO_ENDING_NONE;
    double violation = 0.9, objective = 2.0;
    int points = 0;
    f.engine->iterate.rho = s.penalty_limit = 3e5;
    for (; points < 20 && !ending; points++) {
      ending = at(&s, &f, objective, violation, 1.0);
      violation *= violations[run];
      objective *= values[run];
    }
    assert_int_equal(ending, run == 0 ? AMBULO_ENDING_STALLED : AMBULO_ENDING_NONE);
    assert_int_equal(points, run == 0 ? 17 : 20);
  }
  engine_close(&f);
}

/* a point between polish_reach and stalled_reach, the engine's, with the multipliers there */
static void open_off_the_rows(engine_fixture *f) {
  engine_open(f, "yardstick_12");
  f->options.maximum_iterations = 5;
  assert_int_equal(ambulo__pipeline(f->engine, AMBULO__FAR, f->x), AMBULO_OK);
  memcpy(f->x, f->engine->reached.x, (size_t)f->n * sizeof *f->x);
  if (!(f->engine->reached.violation > 1e-5 && f->engine->reached.violation < 1e-2))
    print_error("violation %g\n", f->engine->reached.violation);
  assert_true(f->engine->reached.violation > 1e-5 && f->engine->reached.violation < 1e-2);
}

static int rows_hold(engine_fixture *f) {
  assert_int_equal(ambulo__evaluate(f->engine->workspace, f->x), AMBULO_OK);
  return ambulo__engine_excess(f->engine, f->engine->measured.excess) <=
         f->options.feasibility_tolerance;
}

static void a_stall_reaches_further(void **state) {
  (void)state;
  for (int stalled = 0; stalled < 2; stalled++) {
    engine_fixture f;
    open_off_the_rows(&f);
    ambulo__stopping s = ambulo__stopping_begin(0);
    s.objective = s.first = f.engine->reached.objective;
    s.least_violation = s.halved = f.engine->reached.violation;
    s.since_better = stalled ? 100 : 0;
    s.points = 1;
    f.engine->iterate.rho = s.penalty_limit;
    assert_int_equal(ambulo__stopping_test(&s, f.engine, f.x),
                     stalled ? AMBULO_ENDING_STALLED : AMBULO_ENDING_NONE);
    assert_int_equal(rows_hold(&f), stalled);
    engine_close(&f);
  }
}

/* polished where that is close, and wanted */
static void a_run_that_is_cut_is_polished(void **state) {
  (void)state;
  for (int run = 0; run < 4; run++) {
    engine_fixture f;
    open_off_the_rows(&f);
    ambulo__stopping s = ambulo__stopping_begin(run == 1);
    if (run == 2) f.engine->reached.violation = 0.02;
    if (run == 3) f.engine->reached.value = HUGE_VAL;
    ambulo__stopping_cut(&s, f.engine, f.x);
    assert_int_equal(rows_hold(&f), run == 0);
    engine_close(&f);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(rows_value_and_gradient_have_to_be_right),
                                     cmocka_unit_test(a_value_that_stays_ends_it),
                                     cmocka_unit_test(coarse_grids_are_content_with_less),
                                     cmocka_unit_test(what_vanishes_ends_it),
                                     cmocka_unit_test(stalls_raise_the_bound),
                                     cmocka_unit_test(slow_rows_raise_the_bound),
                                     cmocka_unit_test(coarse_grids_stall_sooner),
                                     cmocka_unit_test(only_points_near_the_rows_count),
                                     cmocka_unit_test(terms_without_a_measure_vanish_too),
                                     cmocka_unit_test(what_counts_as_progress),
                                     cmocka_unit_test(a_stall_reaches_further),
                                     cmocka_unit_test(a_run_that_is_cut_is_polished)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
