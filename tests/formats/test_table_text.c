/* Lines and cells of a table. */
#include "formats/table_text.h"
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(commas_separate_cells),
      cmocka_unit_test(tabs_and_blanks_separate_cells),
      cmocka_unit_test(cells_know_their_column),
      cmocka_unit_test(lines_end_in_every_way),
  };
  return cmocka_run_group_tests_name("format/table_text", tests, NULL, NULL);
}
