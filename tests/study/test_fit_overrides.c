/* From steps to numbers of the problem. */
#include "support/fit_files.h"

static void changes(void **state) {
  (void)state;
  ambulo__fit_parameter p = {.scale = AMBULO__FIT_LOG, .step = 0.3, .range = {0.1, 10.0}};
  assert_close(ambulo__fit_change(&p, 0.0), 1.0, 0.0);
  assert_close(ambulo__fit_change(&p, 2.0), exp(0.6), 1e-15);
  assert_close(ambulo__fit_change(&p, 100.0), 10.0, 0.0);
  assert_close(ambulo__fit_value(&p, 5.0, -1.0), 5.0 * exp(-0.3), 1e-8);
  p = (ambulo__fit_parameter){.scale = AMBULO__FIT_LINEAR, .step = 0.01, .range = {-0.03, 0.02}};
  assert_close(ambulo__fit_change(&p, 1.0), 0.01, 0.0);
  assert_close(ambulo__fit_change(&p, 9.0), 0.02, 0.0);
  assert_close(ambulo__fit_value(&p, 0.62, -1.0), 0.61, 1e-12);
}

/* nine digits, and the file's own number as it is where nothing changes */
static void numbers_are_short(void **state) {
  (void)state;
  ambulo__fit_parameter p = {.scale = AMBULO__FIT_LOG, .step = 0.3, .range = {0.1, 10.0}};
  double own = 0.12345678901234567, value = ambulo__fit_value(&p, own, 1.0);
  assert_true(ambulo__fit_value(&p, own, 0.0) == own);
  char text[40];
  (void)snprintf(text, sizeof text, "%.9g", value);
  assert_true(strtod(text, NULL) == value);
  assert_close(ambulo__fit_value(&p, 3e-7, 1.0), 3e-7 * exp(0.3), 1e-14);
  assert_close(ambulo__fit_value(&p, 3e11, 1.0) / 3e11, exp(0.3), 1e-8);
}

static void overrides_of_a_condition(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE);
  const char **list = NULL;
  int count = 0;
  double u[2] = {1.0, -2.0};
  assert_int_equal(ambulo__fit_overrides(f, 1, u, &list, &count), AMBULO_OK);
  assert_int_equal(count, 3);
  assert_string_equal(list[0], "time.duration=0.7");
  assert_string_equal(list[1], "objective[acceleration].weight=2.69971762");
  assert_string_equal(list[2], "ends.final.pin=0.8");
  free((void *)list);
  ambulo_fit_free(f);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(changes), TEST(numbers_are_short),
                                     TEST(overrides_of_a_condition)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
