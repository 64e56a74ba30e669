/* Axes of drawings: distinct values, their order and places. */
#include "study/plot.h"
#include "support/test.h"

enum { CASES = 6, COLUMNS = AMBULO__LISTING_AXES + 2 };

/* cases of a listing with two axes: numbers written in two ways, words */
static ambulo__listing listing_of(const char **cell) {
  static const char *const numbers[CASES] = {"10", "2", "1.0", "2.0", "10", "1"};
  static const char *const words[CASES] = {"male", "female", "male", "male", "female", "female"};
  for (int i = 0; i < (CASES + 1) * COLUMNS; i++) cell[i] = "";
  for (int k = 0; k < CASES; k++) {
    cell[(k + 1) * COLUMNS + AMBULO__LISTING_AXES] = numbers[k];
    cell[(k + 1) * COLUMNS + AMBULO__LISTING_AXES + 1] = words[k];
  }
  ambulo__listing l = {.allocator = ambulo__allocator_or_default(NULL),
                       .cell = cell,
                       .cases = CASES,
                       .columns = COLUMNS};
  return l;
}

static void numbers_stand_in_their_order(void **state) {
  (void)state;
  const char *cell[(CASES + 1) * COLUMNS];
  ambulo__listing l = listing_of(cell);
  ambulo__plot_axis axis = {0};
  ambulo__plot_point point[CASES] = {{.index = 0}};
  for (int i = 0; i < CASES; i++) point[i].index = i;
  assert_int_equal(ambulo__plot_axis_make(&l, point, CASES, AMBULO__LISTING_AXES, &axis),
                   AMBULO_OK);
  assert_true(axis.numeric);
  assert_int_equal(axis.count, 3);
  assert_true(axis.at[0] == 1.0 && axis.at[1] == 2.0 && axis.at[2] == 10.0);
  assert_string_equal(axis.text[0], "1.0");
  assert_int_equal(ambulo__plot_axis_place(&axis, "1"), 0);
  assert_int_equal(ambulo__plot_axis_place(&axis, "2.00"), 1);
  assert_int_equal(ambulo__plot_axis_place(&axis, "10"), 2);
  assert_close(ambulo__plot_axis_share(&axis, 1, 0.0), 1.0 / 9.0, 1e-15);
  assert_close(ambulo__plot_axis_share(&axis, 2, 0.1), 0.9, 1e-15);
  ambulo__plot_axis_free(&l, &axis);
}

static void words_stand_as_the_list_has_them(void **state) {
  (void)state;
  const char *cell[(CASES + 1) * COLUMNS];
  ambulo__listing l = listing_of(cell);
  ambulo__plot_axis axis = {0};
  ambulo__plot_point point[CASES] = {{.index = 0}};
  for (int i = 0; i < CASES; i++) point[i].index = i;
  assert_int_equal(ambulo__plot_axis_make(&l, point, CASES, AMBULO__LISTING_AXES + 1, &axis),
                   AMBULO_OK);
  assert_false(axis.numeric);
  assert_int_equal(axis.count, 2);
  assert_string_equal(axis.text[0], "male");
  assert_int_equal(ambulo__plot_axis_place(&axis, "female"), 1);
  assert_close(ambulo__plot_axis_share(&axis, 1, 0.25), 0.75, 1e-15);
  ambulo__plot_axis_free(&l, &axis);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(numbers_stand_in_their_order),
                                     cmocka_unit_test(words_stand_as_the_list_has_them)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
