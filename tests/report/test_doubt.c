/* Doubts are warnings; the strict make them errors. */
#include "report/doubt.h"
#include "support/messages.h"

static void strictness_decides(void **state) {
  (void)state;
  for (int strict = 0; strict < 2; strict++) {
    ambulo__doubts doubts = {ambulo_diagnostics_create(NULL), strict, 0};
    assert_int_equal(ambulo__doubts_status(&doubts), AMBULO_OK);
    ambulo__doubt(&doubts, "m.csv", "--angles degrees", "the knee is at %g rad", 65.0);
    assert_int_equal(doubts.count, 1);
    assert_int_equal(ambulo__doubts_status(&doubts), strict ? AMBULO_E_SCHEMA : AMBULO_OK);
    assert_int_equal(ambulo_diagnostics_error_count(doubts.diagnostics), strict);
    assert_message(doubts.diagnostics, 0,
                   strict ? "m.csv: error[E_SCHEMA]: the knee is at 65 rad"
                          : "m.csv: warning: the knee is at 65 rad");
    assert_message(doubts.diagnostics, 0, "hint: --angles degrees");
    ambulo_diagnostics_free(doubts.diagnostics);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(strictness_decides)};
  return cmocka_run_group_tests_name("report/doubt", tests, NULL, NULL);
}
