/* What was understood of a fit file, in words. */
#include "ambulo/tools/load.h"
#include "ambulo/tools/report.h"
#include "study/fit.h"
#include "support/fit_files.h"
#include "support/test.h"

static void in_words(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS
                         "conditions:\n  - {name: slow, reference: slow.csv}\n"
                         "  - {name: quick, set: {time.duration: 0.7}, reference: quick.csv,\n"
                         "     held_out: true}\n"
                         "  - {name: bare, curves: [low, both]}\n"
                         "distance: {curves: {pin: 1,\n"
                         "  low: {curve: pin, of: lowest, at_least: -5.5, sd: 2},\n"
                         "  both: {curve: pin, of: range, at_least: 3, at_most: 60, sd: 2}}}\n"
                         "method: {iterations: 4}\n");
  char *text = NULL;
  assert_int_equal(ambulo_fit_describe(f, NULL, &text), AMBULO_OK);
  static const char *const parts[] = {
      "parameter    price, times 0.05 to 20\n",
      "             objective[acceleration].weight: 2\n",
      "parameter    last, plus -0.5 to 0.5\n",
      "condition    slow, ",
      "condition    quick, held out, ",
      "quick.csv, time.duration=0.7\n",
      "             pin: 21 points, deviation 2 deg\n",
      "             low: at least -5.5, deviation 2 deg\n",
      "             both: at least 3, at most 60, deviation 2 deg\n",
      "condition    bare, without reference\n",
      "residuals    27\n"};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
    if (!strstr(text, parts[i])) print_error("%s is missing from\n%s\n", parts[i], text);
    assert_non_null(strstr(text, parts[i]));
  }
  /* 3 at the start, 4 times (2 + 5) of two conditions, 1 held out and 3 from zero at the end */
  assert_int_equal(ambulo__fit_expected(f), 3 + 4 * 7 * 2 + 1 + 3);
  assert_non_null(strstr(text, "solves       about 63\n"));
  ambulo_text_free(text, NULL);
  assert_int_equal(ambulo_fit_describe(NULL, NULL, &text), AMBULO_E_ARGUMENT);
  ambulo_fit_free(f);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(in_words),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
