/* Thinner scenes: every fourth sample, to half of a coarser unit; all else as it was. */
#include "page/thin.h"

#include "scene/series.h"
#include "support/scene_reading.h"

enum { SAMPLES = 161 };

static void write_scene(ambulo__text_buffer *text, int samples) {
  double values[SAMPLES];
  for (int k = 0; k < samples; k++) values[k] = 2.0 * sin(0.07 * k) - 1.0;
  ambulo__json json = {text, 0, 1};
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_text(&json, "name", "a [1,2] \"samples\" \\");
  ambulo__json_integer(&json, "samples", samples);
  ambulo__json_raw(&json, "pair", "[3, 4]");
  ambulo__json_raw(&json, "none", "[]");
  ambulo__json_open(&json, "points", '[');
  ambulo__series(&json, NULL, values, 1, samples, 1e-4);
  ambulo__json_close(&json, ']');
  ambulo__json_close(&json, '}');
}

static void every_fourth(void **state) {
  (void)state;
  ambulo__text_buffer whole, thin;
  ambulo__text_init(&whole, NULL);
  ambulo__text_init(&thin, NULL);
  write_scene(&whole, SAMPLES);
  ambulo__scene_thin(&thin, ambulo__text_data(&whole), whole.length);
  yaml_case c = yaml_open(ambulo__text_data(&thin));
  assert_int_equal(c.status, AMBULO_OK);
  const ambulo__yaml_node *series = ambulo__yaml_item(ambulo__yaml_get(c.root, "points"), 0);
  double coarse = ambulo__yaml_number(ambulo__yaml_get(c.root, "coarse"), 0);
  assert_int_equal(ambulo__yaml_integer(ambulo__yaml_get(c.root, "samples"), 0, 999, 0), 41);
  assert_int_equal(ambulo__yaml_items(series), 41);
  assert_close(coarse, 10.0, 0);
  for (int k = 0; k < 41; k++) {
    double want = 2.0 * sin(0.07 * 4 * k) - 1.0;
    assert_true(fabs(scene_value(series, k, 1e-4 * coarse) - want) <= 5.6e-4);
  }
  assert_string_equal(ambulo__yaml_text(ambulo__yaml_get(c.root, "name")),
                      "a [1,2] \"samples\" \\");
  assert_int_equal(ambulo__yaml_items(ambulo__yaml_get(c.root, "pair")), 2);
  yaml_shut(&c);
  ambulo__text_free(&whole);
  ambulo__text_free(&thin);
}

static void others_are_copied(void **state) {
  (void)state;
  ambulo__text_buffer whole, thin;
  ambulo__text_init(&whole, NULL);
  ambulo__text_init(&thin, NULL);
  write_scene(&whole, 160);
  ambulo__scene_thin(&thin, ambulo__text_data(&whole), whole.length);
  assert_string_equal(ambulo__text_data(&thin), ambulo__text_data(&whole));
  ambulo__text_clear(&thin);
  ambulo__scene_thin(&thin, "[1,2", 4); /* cut off */
  assert_string_equal(ambulo__text_data(&thin), "[1,2");
  ambulo__text_free(&whole);
  ambulo__text_free(&thin);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_fourth),
      cmocka_unit_test(others_are_copied),
  };
  return cmocka_run_group_tests_name("page/thin", tests, NULL, NULL);
}
