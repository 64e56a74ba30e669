/* Rows, shared masses and memory of plans with coupled joints; what their kernels compute is
 * compared with the reference in test_kernels_*.c. */
#include "contact_fixture.h"
#include "mechanics/plan_coupled.h"
#include "support/fail_alloc.h"

/* Every joint has its place, and masses are shared above the diagonal alone. */
static void joints_and_followers(void **state) {
  (void)state;
  static kernel_case c;
  int shared = 0, followers = 0;
  for (int number = coupled_cases; number < case_count; number++) {
    case_open(&c, number);
    const struct ambulo__coupled_plan *p = c.plan->coupled;
    ambulo__plan_pattern pattern = ambulo__plan_get_pattern(c.plan);
    if (!p) { /* no joint was coupled */
      assert_int_equal(c.model->coupled_count, 0);
      case_close(&c);
      continue;
    }
    assert_int_equal(p->joint_count, c.d + c.model->coupled_count);
    assert_int_equal(p->follower_count, c.model->coupled_count);
    followers += p->follower_count;
    for (int row = 0; row < c.d; row++)
      for (int e = pattern.start[row]; e < pattern.start[row + 1]; e++) {
        int from = pattern.by_qdd[e];
        if (from == e) continue;
        shared++;
        assert_int_equal(pattern.column[from], row);
        assert_true(pattern.column[e] < row && pattern.by_qdd[from] == from);
      }
    case_close(&c);
  }
  assert_true(shared > 1000 && followers > 100);
}

/* A row of tau reacts if a joint does, and vanishes if all of its joints do. */
static void rows_are_those_of_their_joints(void **state) {
  (void)state;
  static contact_case c;
  int kinds[4] = {0};
  for (int number = contact_coupled_cases; number < contact_case_count; number++) {
    contact_case_open(&c, number);
    const struct ambulo__coupled_plan *p = c.body.plan->coupled;
    for (int k = 0; p && k < c.body.d; k++) {
      int reacts = 0, vanishes = 1, row = c.body.plan->joints[k].torque_row;
      for (int j = 0; j < p->joint_count; j++) {
        if (p->coordinate[j] != k) continue;
        reacts |= p->open->joints[j].torque_row == AMBULO__ROW_REACTS;
        vanishes &= p->open->joints[j].torque_row == AMBULO__ROW_VANISHES;
      }
      kinds[row]++;
      assert_int_equal(row == AMBULO__ROW_VANISHES, vanishes);
      assert_int_equal(row == AMBULO__ROW_REACTS, reacts);
      assert_int_equal(ambulo__plan_vanishes(c.body.plan, k), vanishes);
    }
    contact_case_close(&c);
  }
  assert_true(kinds[AMBULO__ROW_SPARSE] > 20 && kinds[AMBULO__ROW_REACTS] > 20);
}

/* A wrench that the plan is told of stands where the open body's kernels read it. */
static void a_wrench_has_its_place(void **state) {
  (void)state;
  static contact_case c;
  contact_case_open(&c, contact_coupled_cases + 7);
  ambulo__plan *plan = c.body.plan;
  size_t before = ambulo__plan_scratch(plan), at = ambulo__plan_take_wrench(plan);
  assert_int_equal(at, before);
  assert_int_equal(ambulo__plan_scratch(plan), before + 12 * (size_t)AMBULO__LANES);
  contact_case_close(&c);
}

static void failed_allocations_unwind(void **state) {
  (void)state;
  static kernel_case c;
  case_open(&c, coupled_cases + 2);
  for (int k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__plan *plan = NULL;
    ambulo_status status = ambulo__plan_create(c.model, &allocator, &plan);
    if (status == AMBULO_OK) {
      ambulo__plan_free(plan);
      assert_int_equal(memory.live, 0);
      assert_true(k > 20);
      break;
    }
    assert_int_equal(status, AMBULO_E_MEMORY);
    assert_null(plan);
    assert_int_equal(memory.live, 0);
  }
  case_close(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(joints_and_followers), cmocka_unit_test(rows_are_those_of_their_joints),
      cmocka_unit_test(a_wrench_has_its_place), cmocka_unit_test(failed_allocations_unwind)};
  return cmocka_run_group_tests_name("mechanics/plan coupled", tests, NULL, NULL);
}
