/* Doubts are warnings; the strict make them errors. */
#include "people/doubt.h"
#include "support/messages.h"
#include "support/motion_text.h"

static void strictness_decides(void **state) {
  (void)state;
  for (int strict = 0; strict < 2; strict++) {
    ambulo__doubts doubts = {ambulo_diagnostics_create(NULL), strict, 0, 0};
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

static void headers_that_count_wrongly(void **state) {
  (void)state;
  static const char *const texts[] = {"t\nnColumns=3\nendheader\ntime\tq\n0\t1\n",
                                      "t\nnColumns=2\nendheader\ntime\tq\n0\t1\n",
                                      "t\nendheader\ntime\tq\n0\t1\n"};
  for (int i = 0; i < 3; i++) {
    ambulo__motion *motion = NULL;
    ambulo__doubts doubts = {ambulo_diagnostics_create(NULL), 0, 0, 0};
    assert_int_equal(motion_read_text(texts[i], strlen(texts[i]), "m.sto", AMBULO__MOTION_STO, NULL,
                                      NULL, &motion),
                     AMBULO_OK);
    ambulo__doubt_header(&doubts, "m.sto", motion);
    assert_int_equal(doubts.count, i == 0);
    if (i == 0)
      assert_message(doubts.diagnostics, 0, "m.sto: warning: 2 columns; the header says 3");
    ambulo_diagnostics_free(doubts.diagnostics);
    ambulo__motion_free(motion);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(strictness_decides),
                                     cmocka_unit_test(headers_that_count_wrongly)};
  return cmocka_run_group_tests_name("inverse/doubt", tests, NULL, NULL);
}
