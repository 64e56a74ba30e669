/* The row table: growth, terms that belong to their row, memory running out. */
#include "gait/row_table.h"
#include "support/fail_alloc.h"
#include "support/test.h"

static void rows_and_terms_grow(void **state) {
  (void)state;
  ambulo__row_table table;
  ambulo__row_table_init(&table, NULL);
  for (int r = 0; r < 1000; r++) {
    ambulo__row_begin(&table, "family", "subject", "detail", "m", AMBULO_EQUAL, r, 0.1 * r, -r);
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

static void no_memory_is_remembered(void **state) {
  (void)state;
  for (long k = 0; k < 2; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__row_table table;
    ambulo__row_table_init(&table, &allocator);
    ambulo__row_begin(&table, "f", "s", "d", "m", AMBULO_EQUAL, 0, 0.0, 0.0);
    ambulo__row_term_add(&table, 0, 0, 1.0);
    ambulo__row_begin(&table, "f", "s", "d", "m", AMBULO_EQUAL, 0, 0.0, 0.0);
    assert_int_equal(table.status, AMBULO_E_MEMORY);
    assert_int_equal(table.row_count, k);
    assert_int_equal(table.term_count, 0);
    ambulo__row_table_clear(&table);
    assert_int_equal(memory.live, 0);
  }
}

static void sizes_go_with_units(void **state) {
  (void)state;
  static const char *const units[] = {"m",   "rad",   "body weights", "N",
                                      "N m", "rad/s", "m/s^2",        "anything"};
  static const double sizes[] = {1.0, 1.0, 1.0, 700.0, 700.0, 10.0, 100.0, 1.0};
  ambulo__row_table table;
  ambulo__row_table_init(&table, NULL);
  table.weight = 700.0;
  for (int i = 0; i < 8; i++) {
    ambulo__row_begin(&table, "f", "s", "d", units[i], AMBULO_EQUAL, 0, 0.0, 0.0);
    assert_close(table.rows[i].size, sizes[i], 0.0);
  }
  ambulo__row_table_clear(&table);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(rows_and_terms_grow),
                                     cmocka_unit_test(no_memory_is_remembered),
                                     cmocka_unit_test(sizes_go_with_units)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
