/* Filters: one comparison of an axis, a number, a word. */
#include "study/study.h"
#include "support/test.h"

static const char *text_of(void *user, const char *name) {
  (void)user;
  static const char *const axes[][2] = {
      {"speed", "1.40"}, {"sex", "female"}, {"limit", "1.4"}, {"unset", ""}};
  for (size_t i = 0; i < sizeof axes / sizeof *axes; i++)
    if (strcmp(axes[i][0], name) == 0) return axes[i][1];
  return NULL;
}

static void comparisons(void **state) {
  (void)state;
  static const struct {
    const char *filter;
    int holds;
  } cases[] = {
      {"speed < 1.5", 1},   {"speed<1.4", 0},      {"speed <= 1.4", 1},   {" 1.4 >= speed ", 1},
      {"speed > 1.39", 1},  {"speed == limit", 1}, {"speed != limit", 0}, {"sex == female", 1},
      {"sex != female", 0}, {"sex == male", 0},    {"speed != fast", 1},  {"sex < 2", -1},
      {"unset < 2", -1},    {"unset == 2", 0},     {"speed", -1},         {"speed <", -1},
      {"< 2", -1},          {"speed = 1.4", -1},   {"speed ! 1.4", -1},   {"", -1},
      {"speed >= 1e0", 1}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    int holds = ambulo__filter_holds(cases[i].filter, text_of, NULL);
    if (holds != cases[i].holds) print_error("%s\n", cases[i].filter);
    assert_int_equal(holds, cases[i].holds);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(comparisons)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
