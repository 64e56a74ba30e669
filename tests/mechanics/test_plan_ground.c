/* Which joints carry the feet, which rows of tau vanish, and the pattern that follows. */
#include "ground_fixture.h"
#include "support/fail_alloc.h"

static void rows_of_a_walking_body(void **state) {
  (void)state;
  static ground_case c;
  for (int number = -shipped_count; number < 0; number++) {
    ground_case_open(&c, number);
    const ambulo__plan *plan = c.body.plan;
    ambulo__plan_pattern p = ambulo__plan_get_pattern(plan);
    ambulo__row_part part[AMBULO__MOST_PARTS];
    assert_true(ambulo__plan_is_grounded(plan));
    assert_int_equal(plan->vanishing, 6);
    for (int k = 0; k < 18; k++) {
      int both = plan->joints[k].feet == 3;
      assert_int_equal(both, k < 6);
      /* the root, a chain of six, the joint itself; the root force and the height by n = z */
      assert_int_equal(p.start[k + 1] - p.start[k], k < 6 ? 0 : 12);
      assert_int_equal(ambulo__plan_parts(plan, k, part), k < 6 ? 1 : 1 + 6 + 1);
      assert_int_equal(part[0].row, k);
    }
    for (int row = c.foot_row; row < c.body.rows; row++) {
      int of = row - c.foot_row, force = of < 8 && of % 4 < 3;
      assert_int_equal(p.start[row + 1] - p.start[row], 0);
      assert_true(p.rate_start[row] < 0);
      assert_int_equal(ambulo__plan_parts(plan, row, part), of >= 8 ? 1 : force ? 3 : 6);
    }
    ground_case_close(&c);
  }
}

/* Rows ascend; the rows that depend on rates fill jqd one after the other; every factor stands
 * behind the entries and is used. */
static void pattern_is_well_formed(void **state) {
  (void)state;
  static ground_case c;
  for (int number = 0; number < 80; number++) {
    ground_case_open(&c, number);
    ambulo__plan_pattern p = ambulo__plan_get_pattern(c.body.plan);
    int rates = 0, entries = p.start[c.body.rows];
    static int used[max_rows * 7];
    memset(used, 0, sizeof used);
    assert_int_equal(c.body.rows, c.foot_row + 11);
    assert_true(p.count - entries < (int)(sizeof used / sizeof *used));
    for (int row = 0; row < c.body.rows; row++) {
      for (int e = p.start[row]; e < p.start[row + 1]; e++) {
        assert_in_range(p.column[e], 0, c.body.d - 1);
        assert_true(e == p.start[row] || p.column[e] > p.column[e - 1]);
      }
      if (row >= c.body.d + 6) {
        assert_int_equal(p.rate_start[row], -1);
      } else {
        assert_int_equal(p.rate_start[row], rates);
        rates += p.start[row + 1] - p.start[row];
      }
      ambulo__row_part part[AMBULO__MOST_PARTS];
      int parts = ambulo__plan_parts(c.body.plan, row, part);
      assert_in_range(parts, 1, AMBULO__MOST_PARTS);
      for (int k = 0; k < parts; k++) {
        if (part[k].times < 0) continue;
        assert_in_range(part[k].times, entries, p.count - 1);
        used[part[k].times - entries]++;
      }
    }
    for (int k = 0; k < p.count - entries; k++) assert_in_range(used[k], 1, 6);
    assert_int_equal(rates, p.dynamic_count);
    ground_case_close(&c);
  }
}

/* A joint above both feet is not free of force if something else is held by the world. */
static void a_weight_elsewhere_keeps_the_row(void **state) {
  (void)state;
  static ground_case c;
  int kept = 0;
  for (int number = 0; number < ground_case_count; number++) {
    ground_case_open(&c, number);
    const ambulo__plan *plan = c.body.plan;
    for (int k = 0; k < c.body.d; k++) {
      int reacts = plan->joints[k].torque_row == AMBULO__ROW_REACTS;
      if (plan->joints[k].feet != 3 || !reacts) continue;
      double carried = plan->frames[k + 1].subtree_mass;
      assert_true(carried < plan->mass * (1 - 1e-12));
      kept++;
    }
    ground_case_close(&c);
  }
  assert_true(kept > 0);
}

static void two_feet_are_needed(void **state) {
  (void)state;
  static ground_case c;
  ground_case_open(&c, 12);
  ambulo_model model = *c.body.model;
  ambulo__plan *plan = NULL;
  for (model.foot_count = 0; model.foot_count < 2; model.foot_count++) {
    assert_int_equal(ambulo__plan_create_grounded(&model, 0, NULL, &plan), AMBULO_E_ARGUMENT);
    assert_null(plan);
  }
  assert_int_equal(ambulo__plan_create(c.body.model, NULL, &plan), AMBULO_OK);
  assert_false(ambulo__plan_is_grounded(plan));
  assert_int_equal(ambulo__plan_rows(plan), c.foot_row);
  ambulo__plan_free(plan);
  ground_case_close(&c);
}

static void failed_allocations_unwind(void **state) {
  (void)state;
  static ground_case c;
  ground_case_open(&c, 12);
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__plan *plan = NULL;
    ambulo_status status = ambulo__plan_create_grounded(c.body.model, 0, &allocator, &plan);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__plan_free(plan);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_true(k < 100);
  }
  ground_case_close(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_of_a_walking_body), cmocka_unit_test(pattern_is_well_formed),
      cmocka_unit_test(a_weight_elsewhere_keeps_the_row), cmocka_unit_test(two_feet_are_needed),
      cmocka_unit_test(failed_allocations_unwind)};
  return cmocka_run_group_tests_name("mechanics/plan_ground", tests, NULL, NULL);
}
