/* Numbers and mappings of problem files that are written. */
#include "support/walk_case.h"

static void digits(void **state) {
  (void)state;
  assert_true(ambulo__significant(0.0012345678, 4) == 0.001235);
  assert_true(ambulo__significant(-98765.0, 4) == -98770.0);
  assert_true(ambulo__significant(0.0, 4) == 0.0);
}

/* no line is longer than 100 columns, and the text reads back */
static void lines(void **state) {
  (void)state;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__walk_map map = ambulo__walk_map_begin(&text, 4, "scale");
  for (int i = 0; i < 60; i++) {
    char name[16];
    const double pair[2] = {i, 0.5};
    (void)snprintf(name, sizeof name, "joint_%d", i);
    ambulo__walk_map_item(&map, name, pair, 1 + i % 2);
  }
  ambulo__walk_map_end(&map);
  size_t column = 0;
  for (const char *c = ambulo__text_data(&text); *c; c++) {
    column = *c == '\n' ? 0 : column + 1;
    assert_true(column <= 100);
  }
  assert_non_null(strstr(ambulo__text_data(&text), "    scale: {joint_0: 0, joint_1: [1, 0.5], "));
  assert_non_null(strstr(ambulo__text_data(&text), "joint_59: [59, 0.5]}\n"));
  ambulo__text_free(&text);
}

static void names_of_models(void **state) {
  (void)state;
  static const char *const names[][2] = {{"a-b/c_1.yaml", "model: a-b/c_1.yaml\n"},
                                         {"my robot's: 1.yaml", "model: 'my robot''s: 1.yaml'\n"}};
  for (int i = 0; i < 2; i++) {
    ambulo__text_buffer text;
    ambulo__text_init(&text, NULL);
    ambulo__walk_model(&text, names[i][0]);
    assert_string_equal(ambulo__text_data(&text), names[i][1]);
    ambulo__text_free(&text);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(digits),
      cmocka_unit_test(lines),
      cmocka_unit_test(names_of_models),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
