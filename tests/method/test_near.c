/* Which rows between bodies a solve works with: those near where it starts, and those that it finds
 * broken when it is done; multipliers are kept, and NLopt's SLSQP has every row. */
#include "method/parameters.h"
#include "method/pipeline.h"
#include "support/engine_fixture.h"

#include <string.h>

static int is_between_bodies(const engine_fixture *f, int row) {
  return f->problem->table.rows[row].kind == AMBULO__KIND_COLLISION;
}

static int has_role(const engine_fixture *f, int row) {
  const ambulo__sparse_rows *rows = &f->engine->setup->rows->inequality;
  for (int i = 0; i < rows->count; i++) {
    if (rows->row[i] == row) return 1;
  }
  return 0;
}

static void rows_far_apart_at_the_start_have_no_role(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "walk_normal");
  int far = 0, near = 0;
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  for (int r = 0; r < f.problem->rows; r += 7) {
    if (f.problem->table.rows[r].relation == AMBULO_EQUAL) continue;
    int is_far = is_between_bodies(&f, r) && f.engine->workspace->row_value[r] > AMBULO__NEAR_ROWS;
    assert_int_equal(has_role(&f, r), !is_far);
    far += is_far;
    near += !is_far;
  }
  assert_true(far > 100 && near > 100);
  engine_close(&f);
}

/* without any row between bodies at first */
static void rows_that_are_broken_join(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "walk_normal");
  for (int r = 0; r < f.problem->rows; r++)
    f.engine->workspace->far[r] = (unsigned char)is_between_bodies(&f, r);
  assert_int_equal(ambulo__engine_renew(f.engine, f.x), AMBULO_OK);
  int before = f.engine->setup->inequalities, far = 0;
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
  assert_true(f.engine->setup->inequalities > before);
  f.engine->workspace->has_values = 0;
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  for (int r = 0; r < f.problem->rows; r++) {
    if (!is_between_bodies(&f, r)) continue;
    assert_true(f.engine->workspace->row_value[r] > -2e-6);
    far += f.engine->workspace->far[r];
  }
  assert_true(far > 0); /* most never came near */
  engine_close(&f);
}

/* a solve that begins where a far row is near takes in what is about it */
static void rows_seen_at_the_beginning_join(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "walk_normal");
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
  memset(f.engine->workspace->far, 0, (size_t)f.problem->rows);
  int row = -1;
  double least = AMBULO__NEAR_SEEN;
  for (int r = 0; r < f.problem->rows; r++) {
    if (!is_between_bodies(&f, r)) continue;
    f.engine->workspace->far[r] = 1;
    if (f.engine->workspace->row_value[r] < least) row = r;
  }
  assert_true(row >= 0); /* legs touch */
  assert_int_equal(ambulo__engine_renew(f.engine, f.x), AMBULO_OK);
  assert_false(has_role(&f, row));
  f.run.iterations = f.options.maximum_iterations = 1; /* as short as can be */
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__COARSE, f.x), AMBULO_OK);
  assert_true(has_role(&f, row));
  engine_close(&f);
}

static void all_rows_can_be_asked_for(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "walk_normal");
  int inequalities = 0;
  for (int r = 0; r < f.problem->rows; r++)
    inequalities += f.problem->table.rows[r].relation == AMBULO_NOT_NEGATIVE;
  assert_true(f.engine->setup->inequalities < inequalities);
  assert_int_equal(ambulo__near_all(f.engine, f.x), AMBULO_OK);
  assert_int_equal(f.engine->setup->inequalities, inequalities);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(rows_far_apart_at_the_start_have_no_role),
                                     cmocka_unit_test(rows_that_are_broken_join),
                                     cmocka_unit_test(rows_seen_at_the_beginning_join),
                                     cmocka_unit_test(all_rows_can_be_asked_for)};
  return cmocka_run_group_tests_name("method/near", tests, NULL, NULL);
}
