/* Series: whole numbers that add up to the rounded values, whatever the values are. */
#include "show/scene_series.h"

#include "support/scene_reading.h"

enum { COUNT = 200 };

/* the series of values, read back as numbers of units */
static void round_trip(const double *values, int count, double unit, double *back) {
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__json json = {&text, 0, 1};
  ambulo__json_open(&json, NULL, '{');
  ambulo__series(&json, "s", values, 1, count, unit);
  ambulo__json_close(&json, '}');
  yaml_case c = yaml_open(ambulo__text_data(&text));
  assert_int_equal(c.status, AMBULO_OK);
  const ambulo__yaml_node *series = ambulo__yaml_get(c.root, "s");
  assert_int_equal(ambulo__yaml_items(series), count);
  for (int k = 0; k < count; k++) back[k] = scene_value(series, k, unit);
  yaml_shut(&c);
  ambulo__text_free(&text);
}

static void half_a_unit_everywhere(void **state) {
  (void)state;
  double values[COUNT], back[COUNT];
  for (int k = 0; k < COUNT; k++) values[k] = 3.0 * sin(0.11 * k) + 1e3 * (k % 7 == 3) - 0.01 * k;
  round_trip(values, COUNT, 1e-4, back);
  for (int k = 0; k < COUNT; k++) assert_true(fabs(back[k] - values[k]) <= 0.5e-4 + 1e-9);
  round_trip(values, 1, 1e-4, back);
  assert_true(fabs(back[0] - values[0]) <= 0.5e-4);
}

/* every second of a table of two columns */
static void steps_over_columns(void **state) {
  (void)state;
  const double values[] = {1, -9, 2, -9, 4, -9};
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__json json = {&text, 0, 1};
  ambulo__series(&json, NULL, values, 2, 3, 1.0);
  assert_string_equal(ambulo__text_data(&text), "[1,1,1]");
  ambulo__text_free(&text);
}

static void what_is_not_finite_stays(void **state) {
  (void)state;
  double values[6] = {(double)NAN, 1.0, (double)INFINITY, -2.0, 1e300, 0.0}, back[6];
  const double want[6] = {0.0, 1.0, 1.0, -2.0, -2.0, 0.0};
  round_trip(values, 6, 1e-3, back);
  for (int k = 0; k < 6; k++) assert_close(back[k], want[k], 1e-12);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(half_a_unit_everywhere),
      cmocka_unit_test(steps_over_columns),
      cmocka_unit_test(what_is_not_finite_stays),
  };
  return cmocka_run_group_tests_name("scene/series", tests, NULL, NULL);
}
