/* Sheets: which lines count, cells by text, numbers with their position, refusals. */
#include "formats/sheet.h"
#include "support/messages.h"
#include "support/scratch.h"

static void lines_and_cells(void **state) {
  const char *path = scratch_path(state, "t.csv");
  ambulo__sheet sheet;
  double value = 0.0;
  scratch_write(path, "\xEF\xBB\xBF# remark\r\na, b ,\"c\"\r\n,,\r\n\r\n1,,x\r\n");
  assert_int_equal(ambulo__sheet_read(path, NULL, NULL, &sheet), AMBULO_OK);
  assert_int_equal(sheet.line_count, 2);
  assert_int_equal(sheet.lines[1].number, 5);
  assert_int_equal(ambulo__sheet_find(&sheet, 0, "b"), 1);
  assert_int_equal(ambulo__sheet_find(&sheet, 0, "c"), 2);
  assert_int_equal(ambulo__sheet_find(&sheet, 0, "d"), -1);
  assert_null(ambulo__sheet_cell(&sheet, 1, 3));
  assert_null(ambulo__sheet_cell(&sheet, 2, 0));
  assert_int_equal(ambulo__sheet_number(&sheet, 1, 0, "a", NULL, &value), AMBULO_OK);
  assert_close(value, 1.0, 0.0);
  ambulo__sheet_free(&sheet);
}

static void a_name_stands_once(void **state) {
  const char *path = scratch_path(state, "twice.csv");
  ambulo__sheet sheet;
  int cell = 7;
  scratch_write(path, "a,b,a,,\n1,2,3,,\n");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__sheet_read(path, NULL, NULL, &sheet), AMBULO_OK);
  assert_int_equal(ambulo__sheet_find_one(&sheet, 0, "b", list, &cell), AMBULO_OK);
  assert_int_equal(cell, 1);
  assert_int_equal(ambulo__sheet_find_one(&sheet, 0, "c", list, &cell), AMBULO_OK);
  assert_int_equal(cell, -1);
  assert_int_equal(ambulo__sheet_find_one(&sheet, 0, "a", list, &cell), AMBULO_E_SCHEMA);
  assert_int_equal(cell, -1);
  assert_message(list, 0, "twice.csv:1:5: error[E_SCHEMA]: duplicate column 'a' (also column 1)");
  ambulo_diagnostics_free(list);
  ambulo__sheet_free(&sheet);
}

static void bad_numbers_have_a_place(void **state) {
  const char *path = scratch_path(state, "t.csv");
  ambulo__sheet sheet;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  double value = 7.0;
  scratch_write(path, "a,b\n\n12,nan\n");
  assert_int_equal(ambulo__sheet_read(path, NULL, list, &sheet), AMBULO_OK);
  assert_int_equal(ambulo__sheet_number(&sheet, 1, 1, "the b", list, &value), AMBULO_E_SCHEMA);
  assert_message(list, 0, "t.csv:3:4: error[E_SCHEMA]: the b is 'nan'; expected a finite number");
  assert_int_equal(ambulo__sheet_number(&sheet, 1, 2, "c", list, &value), AMBULO_E_SCHEMA);
  assert_message(list, 1, "t.csv:3:1: error[E_SCHEMA]: c is ''");
  assert_close(value, 7.0, 0.0);
  ambulo__sheet_free(&sheet);
  ambulo_diagnostics_free(list);
}

static void no_table(void **state) {
  const char *path = scratch_path(state, "t.csv");
  ambulo__sheet sheet;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  scratch_write(path, "# only\n,,\n");
  assert_int_equal(ambulo__sheet_read(path, NULL, list, &sheet), AMBULO_E_PARSE);
  assert_message(list, 0, "expected a table");
  assert_int_equal(ambulo__sheet_read(scratch_path(state, "none.csv"), NULL, list, &sheet),
                   AMBULO_E_IO);
  assert_int_equal(ambulo__sheet_read(*state, NULL, list, &sheet), AMBULO_E_IO);
  ambulo_diagnostics_free(list);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(a_name_stands_once, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(lines_and_cells, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(bad_numbers_have_a_place, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(no_table, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("format/sheet", tests, NULL, NULL);
}
