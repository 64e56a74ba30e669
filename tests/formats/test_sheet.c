/* Lines and cells of a table. */
#include "formats/sheet.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "support/test.h"

/* the cells of one line, joined by '|' */
static const char *joined(const char *text, ambulo__table_cells cells) {
  static char result[256];
  ambulo__table_line line = {.start = text, .length = strlen(text), .number = 1};
  ambulo__table_cell cell;
  size_t position = 0, length = 0;
  int count = 0;
  while (ambulo__table_next_cell(&line, cells, &position, &cell)) {
    if (count++) result[length++] = '|';
    memcpy(result + length, cell.start, cell.length);
    length += cell.length;
  }
  result[length] = '\0';
  assert_int_equal(ambulo__table_count_cells(&line, cells), count);
  return result;
}

static void commas_separate_cells(void **state) {
  (void)state;
  assert_string_equal(joined("a,b,c", AMBULO__CELLS_COMMA), "a|b|c");
  assert_string_equal(joined(" a , b\t,c ", AMBULO__CELLS_COMMA), "a|b|c");
  assert_string_equal(joined("a,,c,", AMBULO__CELLS_COMMA), "a||c|");
  assert_string_equal(joined("\"x, y\",\"2\"", AMBULO__CELLS_COMMA), "x, y|2");
  assert_string_equal(joined("\"open,2", AMBULO__CELLS_COMMA), "\"open,2");
}

static void tabs_and_blanks_separate_cells(void **state) {
  (void)state;
  assert_string_equal(joined("time\thip angle\tz\t\t", AMBULO__CELLS_TAB), "time|hip angle|z");
  assert_string_equal(joined("a\t\tb", AMBULO__CELLS_TAB), "a||b");
  assert_string_equal(joined("  1\t 2   3 \t", AMBULO__CELLS_BLANK), "1|2|3");
  assert_string_equal(joined("   ", AMBULO__CELLS_BLANK), "");
}

static void cells_know_their_column(void **state) {
  (void)state;
  ambulo__table_line line = {.start = "1,  22,\"3\"", .length = 10, .number = 1};
  ambulo__table_cell cell;
  size_t position = 0;
  const int want[3] = {1, 5, 9};
  for (int i = 0; i < 3; i++) {
    assert_true(ambulo__table_next_cell(&line, AMBULO__CELLS_COMMA, &position, &cell));
    assert_int_equal(cell.column, want[i]);
  }
}

static void lines_end_in_every_way(void **state) {
  (void)state;
  const char *text = "\xEF\xBB\xBFone\r\ntwo\n\n \t\nlast";
  const char *want[5] = {"one", "two", "", " \t", "last"};
  const int empty[5] = {0, 0, 1, 1, 0};
  ambulo__table_line line = {0};
  for (int i = 0; i < 5; i++) {
    assert_true(ambulo__table_next_line(text, strlen(text), &line));
    assert_int_equal(line.number, i + 1);
    assert_int_equal(line.length, strlen(want[i]));
    assert_memory_equal(line.start, want[i], line.length);
    assert_int_equal(ambulo__table_line_is_empty(&line), empty[i]);
  }
  assert_false(ambulo__table_next_line(text, strlen(text), &line));
}

/* Sheets: which lines count, cells by text, numbers with their position, refusals. */

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
      cmocka_unit_test(commas_separate_cells),
      cmocka_unit_test(tabs_and_blanks_separate_cells),
      cmocka_unit_test(cells_know_their_column),
      cmocka_unit_test(lines_end_in_every_way),
      cmocka_unit_test_setup_teardown(a_name_stands_once, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(lines_and_cells, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(bad_numbers_have_a_place, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(no_table, scratch_open, scratch_close)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
