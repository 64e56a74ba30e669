/* Which joints carry the contacts, which rows of tau vanish, the pattern that follows, and what is
 * refused. */
#include "contact_fixture.h"
#include "support/fail_alloc.h"

static void sizes_follow_the_contacts(void **state) {
  (void)state;
  static contact_case c;
  for (int number = 0; number < 30; number++) {
    contact_case_open(&c, number);
    const ambulo__plan *plan = c.body.plan;
    int contacts = c.contacts.count;
    assert_int_equal(ambulo__plan_contacts(plan), contacts);
    assert_int_equal(ambulo__plan_ground_entries(plan), 3 + 4 * contacts);
    assert_int_equal(c.body.rows, c.first_row + 6 * contacts + 3);
    assert_int_equal(c.first_row, c.body.d + 6 + 3 * ambulo__plan_points(plan));
    contact_case_close(&c);
  }
}

static void a_plan_in_the_air_has_no_contacts(void **state) {
  (void)state;
  static contact_case c;
  ambulo__plan *air = NULL;
  contact_case_open(&c, -1);
  assert_int_equal(ambulo__plan_create(c.body.model, NULL, &air), AMBULO_OK);
  assert_int_equal(ambulo__plan_contacts(air), 0);
  assert_int_equal(ambulo__plan_ground_entries(air), 0);
  assert_int_equal(ambulo__plan_rows(air), c.first_row);
  ambulo__plan_free(air);
  contact_case_close(&c);
}

/* Six joints carry a walking body on both feet, a chain of six each foot. */
static void rows_of_a_walking_body(void **state) {
  (void)state;
  static contact_case c;
  for (int number = -2; number < 0; number++) {
    contact_case_open(&c, number);
    const ambulo__plan *plan = c.body.plan;
    ambulo__plan_pattern p = ambulo__plan_get_pattern(plan);
    ambulo__row_part part[AMBULO__MOST_PARTS];
    assert_int_equal(plan->vanishing, 6);
    for (int k = 0; k < 18; k++) {
      assert_int_equal(plan->joints[k].contacts, k < 6 ? 3 : k < 12 ? 1 : 2);
      assert_int_equal(p.start[k + 1] - p.start[k], k < 6 ? 0 : 12);
      assert_int_equal(ambulo__plan_parts(plan, k, part), k < 6 ? 1 : 1 + 6 + 3);
    }
    for (int row = c.first_row; row < c.body.rows; row++) {
      int center = row - c.first_row - 12;
      assert_int_equal(p.start[row + 1] - p.start[row], 0);
      assert_true(p.rate_start[row] < 0);
      assert_int_equal(ambulo__plan_parts(plan, row, part), center >= 0 ? 1 : 6 + 3);
    }
    contact_case_close(&c);
  }
}

/* Every factor stands behind the entries and belongs to one part of one row. */
static void factors_have_one_use(void **state) {
  (void)state;
  static contact_case c;
  for (int number = -shipped_contact_count; number < 80; number++) {
    contact_case_open(&c, number);
    ambulo__plan_pattern p = ambulo__plan_get_pattern(c.body.plan);
    int entries = p.start[c.body.rows];
    int *used = calloc((size_t)(p.count - entries), sizeof *used);
    assert_non_null(used);
    for (int row = 0; row < c.body.rows; row++) {
      ambulo__row_part part[AMBULO__MOST_PARTS];
      int parts = ambulo__plan_parts(c.body.plan, row, part);
      assert_in_range(parts, 1, AMBULO__MOST_PARTS);
      for (int k = 0; k < parts; k++) {
        int from = part[k].row - c.body.d;
        if (part[k].by_acceleration) assert_in_range(from, 3, 5);
        if (part[k].times < 0) continue;
        assert_in_range(from, 0, 5);
        assert_in_range(part[k].times, entries, p.count - 1);
        used[part[k].times - entries]++;
      }
    }
    for (int k = 0; k < p.count - entries; k++) assert_int_equal(used[k], 1);
    free(used);
    contact_case_close(&c);
  }
}

/* What a joint carries is what acts on its link and on those beyond. */
static void joints_carry_what_acts_beyond_them(void **state) {
  (void)state;
  static contact_case c;
  int vanish = 0, several = 0, none = 0;
  for (int number = -shipped_contact_count; number < contact_coupled_cases; number++) {
    contact_case_open(&c, number);
    const ambulo_model *model = c.body.model;
    for (int l = 0; l < model->link_count; l++) {
      int k = model->links[l].coordinate, carried = 0;
      if (k < 0) continue;
      for (int i = 0; i < c.contacts.count; i++) {
        carried |= reference_carries(model, l, c.contacts.link[i]) << i;
      }
      int all = reference_carries_all(model, &c.contacts, l);
      int row = c.body.plan->joints[k].torque_row;
      assert_int_equal(c.body.plan->joints[k].contacts, carried);
      assert_int_equal(row, all           ? AMBULO__ROW_VANISHES
                            : carried > 0 ? AMBULO__ROW_REACTS
                                          : AMBULO__ROW_SPARSE);
      vanish += all;
      several += !all && (carried & (carried - 1)) != 0;
      none += carried == 0;
    }
    contact_case_close(&c);
  }
  assert_true(vanish > 20 && several > 20 && none > 20);
}

static void what_is_no_contact_is_refused(void **state) {
  (void)state;
  static contact_case c;
  contact_case_open(&c, 12);
  const ambulo_model *model = c.body.model;
  const int links[7] = {0}, beyond[2] = {0, model->link_count}, before[2] = {0, -1};
  const double bad[] = {0, -0.1, NAN, INFINITY};
  ambulo__plan *plan = NULL;
#define assert_refused(link, count, arm, slant)                                                    \
  assert_int_equal(ambulo__plan_create_contacts(model, link, count, arm, slant, NULL, &plan),      \
                   AMBULO_E_ARGUMENT)
  assert_refused(links, 0, 0.1, 0.2);
  assert_refused(links, AMBULO__MOST_CONTACTS + 1, 0.1, 0.2);
  assert_refused(beyond, 2, 0.1, 0.2);
  assert_refused(before, 2, 0.1, 0.2);
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    assert_refused(links, 1, bad[i], 0.2);
    assert_refused(links, 1, 0.1, bad[i]);
  }
#undef assert_refused
  assert_null(plan);
  contact_case_close(&c);
}

static void failed_allocations_unwind(void **state) {
  (void)state;
  static contact_case c;
  contact_case_open(&c, 17);
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__plan *plan = NULL;
    ambulo_status status = ambulo__plan_create_contacts(
        c.body.model, c.contacts.link, c.contacts.count, 0.1, 0.2, &allocator, &plan);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__plan_free(plan);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_true(k < 100);
  }
  contact_case_close(&c);
}

/* the sum over all links has a place of its own, kept until the contacts take it */
static void the_sum_over_all_has_its_place(void **state) {
  (void)state;
  static contact_case c;
  for (int number = -shipped_contact_count; number < 30; number++) {
    contact_case_open(&c, number);
    const ambulo__plan *plan = c.body.plan;
    int all = plan->frames[0].subtree_at, size = AMBULO__SUBTREE * AMBULO__LANES;
    assert_true(all > 0);
    for (int k = 0; k < plan->coordinates; k++) {
      int own = plan->frames[k + 1].subtree_at, motion = plan->joints[k].motion_at;
      assert_true(own < 0 || own >= all + size || own + size <= all);
      assert_true(motion >= all + size || motion + 18 * AMBULO__LANES <= all);
    }
    contact_case_close(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(sizes_follow_the_contacts),
                                     cmocka_unit_test(a_plan_in_the_air_has_no_contacts),
                                     cmocka_unit_test(rows_of_a_walking_body),
                                     cmocka_unit_test(factors_have_one_use),
                                     cmocka_unit_test(joints_carry_what_acts_beyond_them),
                                     cmocka_unit_test(what_is_no_contact_is_refused),
                                     cmocka_unit_test(the_sum_over_all_has_its_place),
                                     cmocka_unit_test(failed_allocations_unwind)};
  return cmocka_run_group_tests_name("mechanics/plan_contacts", tests, NULL, NULL);
}
