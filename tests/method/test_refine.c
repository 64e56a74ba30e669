/* Coarse grids: which, what they carry over, and when there are none. */
#include "method/refine.h"
#include "support/engine_fixture.h"

static double refine(engine_fixture *f, int *levels) {
  assert_int_equal(ambulo__refine(f->engine, NULL, f->x, levels), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(f->engine->workspace, f->x), AMBULO_OK);
  return f->engine->workspace->objective;
}

/* 36 intervals start from 12, whose optimum is known */
static void the_next_grid_is_carried_over(void **state) {
  (void)state;
  engine_fixture f;
  int levels = -1, forces = 0;
  engine_open(&f, "yardstick_36");
  for (int i = 0; i < f.engine->setup->inequalities; i++) f.engine->iterate.lambda[i] = -1.0;
  (void)refine(&f, &levels);
  assert_int_equal(levels, 1);
  assert_close(f.engine->iterate.carried_objective / 0.35640, 1.0, 2e-2); /* it is left early */
  for (int i = 0; i < f.engine->setup->inequalities; i++) {
    assert_true(f.engine->iterate.lambda[i] >= 0.0);
    forces += f.engine->iterate.lambda[i] > 0.0;
  }
  assert_true(forces > 10);
  engine_close(&f);
}

static void few_intervals_have_no_coarser_grid(void **state) {
  (void)state;
  engine_fixture f;
  int levels = -1;
  engine_open(&f, "yardstick_12");
  (void)refine(&f, &levels);
  assert_int_equal(levels, 0);
  for (int j = 0; j < f.n; j++) assert_true(f.x[j] == 0.0);
  assert_true(f.engine->iterate.carried_objective < 0.0);
  assert_int_equal(f.run.evaluations, 0);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_next_grid_is_carried_over),
                                     cmocka_unit_test(few_intervals_have_no_coarser_grid)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
