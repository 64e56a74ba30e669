/* From zero to a point that satisfies every equality. */
#include "support/engine_fixture.h"

static void equalities_hold_after(const char *name) {
  engine_fixture f;
  engine_open_restored(&f, name);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  for (int r = 0; r < f.problem->rows; r++) {
    if (f.problem->table.rows[r].relation != AMBULO_EQUAL) continue;
    assert_close(f.engine->workspace->row_value[r], 0.0, 1e-8);
  }
  engine_close(&f);
}

static void yardstick_walks(void **state) {
  (void)state;
  equalities_hold_after("yardstick_12");
}

static void mirrored_step_closes(void **state) {
  (void)state;
  equalities_hold_after("walker_2d_step");
}

static void end_states_are_met(void **state) {
  (void)state;
  equalities_hold_after("two_link_reach");
}

static void a_run_that_is_over_does_not_move(void **state) {
  (void)state;
  engine_fixture f;
  double error;
  engine_open(&f, "yardstick_12");
  unsigned seed = 7;
  double *start = calloc((size_t)f.n, sizeof *start);
  for (int j = 0; j < f.n; j++) f.x[j] = start[j] = 2.0 * random_number(&seed);
  f.options.maximum_evaluations = 0; /* the first point is all there is */
  assert_int_equal(ambulo__restore(f.engine, f.x, &error), AMBULO_OK);
  assert_true(error > 1e-3 && memcmp(start, f.x, (size_t)f.n * sizeof *start) == 0);
  free(start);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(yardstick_walks), cmocka_unit_test(mirrored_step_closes),
      cmocka_unit_test(end_states_are_met), cmocka_unit_test(a_run_that_is_over_does_not_move)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
