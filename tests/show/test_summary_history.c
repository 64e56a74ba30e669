/* "convergence" of summary.json: lists of one length, null for what is not finite, no clock but in
 * seconds. */
#include "show/summary_json.h"

#include "method/run.h"
#include "support/walker_result.h"
#include "support/wellformed.h"
#include "support/yaml.h"

static const char *const columns[] = {"iteration", "evaluations", "intervals", "objective",
                                      "violation", "gradient",    "seconds"};
enum { COLUMNS = sizeof columns / sizeof *columns };

static char *written(const ambulo_result *result) {
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__json json = {&text, 0, 1};
  ambulo__json_open(&json, NULL, '{');
  ambulo__history_json(&json, result);
  ambulo__json_close(&json, '}');
  char *copy = strdup(ambulo__text_data(&text));
  ambulo__text_free(&text);
  assert_true(is_json(copy));
  return copy;
}

static void a_list_for_each_column(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  static const ambulo_iteration way[] = {{1, 8, 6, 2.5, 0.125, (double)NAN, 0.1234567},
                                         {2, 16, 12, 0.1 + 0.2, 3e-7, 1e-3, 0.5}};
  for (int i = 0; i < 2; i++) ambulo__history_add(w.result->history, &way[i]);
  w.result->history->shown.tolerance = 1e-6;
  char *text = written(w.result);
  yaml_case c = yaml_open(text);
  const ambulo__yaml_node *all = ambulo__yaml_get(c.root, "convergence");
  static const char *const want[COLUMNS][2] = {
      {"1", "2"},         {"8", "16"},       {"6", "12"},        {"2.5", "0.30000000000000004"},
      {"0.125", "3e-07"}, {"null", "0.001"}, {"0.123457", "0.5"}};
  for (int k = 0; k < COLUMNS; k++) {
    const ambulo__yaml_node *list = ambulo__yaml_get(all, columns[k]);
    assert_int_equal(ambulo__yaml_items(list), 2);
    for (int i = 0; i < 2; i++)
      assert_string_equal(ambulo__yaml_text(ambulo__yaml_item(list, i)), want[k][i]);
  }
  assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(all, "every")), "1");
  assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(all, "tolerance")), "1e-06");
  yaml_shut(&c);
  free(text);
  walk_close(&w);
}

static void nothing_of_a_point_that_was_judged(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  char *text = written(w.result);
  assert_null(strstr(text, "convergence"));
  free(text);
  walk_close(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_list_for_each_column),
      cmocka_unit_test(nothing_of_a_point_that_was_judged),
  };
  return cmocka_run_group_tests_name("report/history_json", tests, NULL, NULL);
}
