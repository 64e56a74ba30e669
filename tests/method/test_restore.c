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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(yardstick_walks),
                                     cmocka_unit_test(mirrored_step_closes),
                                     cmocka_unit_test(end_states_are_met)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
