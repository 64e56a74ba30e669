/* The row table: growth, terms that belong to their row, families, memory running out. */
#include "contact/row_table.h"
#include "support/fail_alloc.h"
#include "support/test.h"

static void rows_and_terms_grow(void **state) {
  (void)state;
  ambulo__row_table table;
  ambulo__row_table_init(&table, NULL);
  for (int r = 0; r < 1000; r++) {
    ambulo__row_begin(&table, AMBULO__KIND_ZMP, "subject", "detail", AMBULO__METRES, AMBULO_EQUAL,
                      r, 0.1 * r, -r);
    for (int t = 0; t < r % 4; t++) ambulo__row_term_add(&table, r, t, 1.0 + t);
    ambulo__row_term_add(&table, r, 99, 0.0);
  }
  assert_int_equal(table.status, AMBULO_OK);
  assert_int_equal(table.row_count, 1000);
  assert_int_equal(table.term_count, 1500);
  int next = 0;
  for (int r = 0; r < 1000; r++) {
    assert_int_equal(table.rows[r].first_term, next);
    assert_int_equal(table.rows[r].term_count, r % 4);
    assert_int_equal(table.rows[r].user, -1);
    assert_close(table.rows[r].constant, -r, 0.0);
    next += r % 4;
  }
  assert_int_equal(table.terms[next - 1].node, 999);
  assert_close(table.terms[next - 1].coefficient, 3.0, 0.0);
  ambulo__row_table_clear(&table);
  assert_int_equal(table.row_count, 0);
  ambulo__row_table_clear(&table);
}

static void rows_know_which_phase_they_are_of(void **state) {
  (void)state;
  ambulo__row_table table;
  ambulo__row_table_init(&table, NULL);
  for (int r = 0; r < 4; r++) {
    table.before = r / 2;
    ambulo__row_begin(&table, AMBULO__KIND_ZMP, "s", "d", AMBULO__METRES, AMBULO_EQUAL, r, 0.0,
                      0.0);
  }
  for (int r = 0; r < 4; r++) assert_int_equal(table.rows[r].before, r / 2);
  ambulo__row_table_clear(&table);
}

static void no_memory_is_remembered(void **state) {
  (void)state;
  for (long k = 0; k < 3; k++) { /* the rows, their families, the terms */
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__row_table table;
    ambulo__row_table_init(&table, &allocator);
    ambulo__row_begin(&table, AMBULO__KIND_ZMP, "s", "d", AMBULO__METRES, AMBULO_EQUAL, 0, 0.0,
                      0.0);
    ambulo__row_term_add(&table, 0, 0, 1.0);
    ambulo__row_begin(&table, AMBULO__KIND_ZMP, "s", "d", AMBULO__METRES, AMBULO_EQUAL, 0, 0.0,
                      0.0);
    assert_int_equal(table.status, AMBULO_E_MEMORY);
    assert_int_equal(table.row_count, k == 2);
    assert_int_equal(table.term_count, 0);
    ambulo__row_table_clear(&table);
    assert_int_equal(memory.live, 0);
  }
}

static void what_is_missed(void **state) {
  (void)state;
  ambulo__table_row row = {.relation = AMBULO_EQUAL};
  assert_close(ambulo__row_missed(&row, 0.25), 0.25, 0.0);
  assert_close(ambulo__row_missed(&row, -0.25), 0.25, 0.0);
  assert_true(ambulo__row_missed(&row, NAN) == HUGE_VAL);
  row.relation = AMBULO_NOT_NEGATIVE;
  assert_close(ambulo__row_missed(&row, 0.25), 0.0, 0.0);
  assert_close(ambulo__row_missed(&row, -0.25), 0.25, 0.0);
  assert_true(ambulo__row_missed(&row, NAN) == HUGE_VAL);
  assert_true(ambulo__row_missed(&row, INFINITY) == HUGE_VAL);
}

static void begin(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                  const char *detail, int node) {
  ambulo__row_begin(table, kind, subject, detail, AMBULO__METRES, AMBULO_EQUAL, node, 0.1 * node,
                    0.0);
}

static void families_are_numbered_as_they_begin(void **state) {
  (void)state;
  ambulo__row_table table;
  ambulo__row_table_init(&table, NULL);
  begin(&table, AMBULO__KIND_ZMP, "s", "front", 0);
  begin(&table, AMBULO__KIND_CONTACT, "s", "front", 0);
  begin(&table, AMBULO__KIND_ZMP, "s", "front", 1);
  begin(&table, AMBULO__KIND_ZMP, "s", "back", 1);
  begin(&table, AMBULO__KIND_ZMP, "other", "front", 1);
  begin(&table, AMBULO__KIND_SLIP, "s", "front", 1);
  static const int group[] = {0, 1, 0, 0, 0, 2}, alike[] = {1, 0, 1, 0, 0, 0};
  assert_int_equal(table.group_count, 3);
  for (int r = 0; r < 6; r++) {
    assert_int_equal(table.rows[r].group, group[r]);
    assert_int_equal(ambulo__rows_alike(&table.rows[0], &table.rows[r]), alike[r]);
  }
  assert_int_equal(table.group_row[1], 1);
  assert_int_equal(table.group_row[2], 5);
  ambulo__row_table_clear(&table);
  assert_int_equal(table.group_count, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_and_terms_grow), cmocka_unit_test(rows_know_which_phase_they_are_of),
      cmocka_unit_test(no_memory_is_remembered), cmocka_unit_test(what_is_missed),
      cmocka_unit_test(families_are_numbered_as_they_begin)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
