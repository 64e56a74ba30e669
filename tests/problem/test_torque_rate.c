/* Differences of torque between neighbouring nodes. */
#include "form_fixture.h"

static void the_rate_is_the_difference_over_the_step(void **state) {
  (void)state;
  form_fixture f;
  form_open(&f);
  ambulo_term term = {.kind = AMBULO_TORQUE_RATE};
  int channel = ambulo__channel_tau(&f.context.channels, 1);
  *form_at(&f, 0, channel) = 4.0;
  *form_at(&f, 1, channel) = 6.5;
  ambulo__form form;
  ambulo__term_form(&term, &f.context, 0, 1, &form);
  assert_close(form.u, 25.0, 1e-14);
  assert_int_equal(form.count, 2);
  assert_int_equal(form.ahead[0] + form.ahead[1], 1);
  check_form_slopes(&f, &term, 0, 1);
  form_close(&f);
}

/* of an interval that lasts longer */
static void steps_may_differ(void **state) {
  (void)state;
  static const double times[FORM_NODES] = {0.0, 0.1, 0.35};
  form_fixture f;
  form_open(&f);
  f.context.times = times;
  ambulo_term term = {.kind = AMBULO_TORQUE_RATE};
  int channel = ambulo__channel_tau(&f.context.channels, 0);
  *form_at(&f, 0, channel) = *form_at(&f, 1, channel) = 4.0;
  *form_at(&f, 2, channel) = 6.0;
  ambulo__form form;
  ambulo__term_form(&term, &f.context, 1, 0, &form);
  assert_close(form.u, 8.0, 1e-14);
  check_form_slopes(&f, &term, 1, 0);
  form_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(steps_may_differ),
                                     cmocka_unit_test(the_rate_is_the_difference_over_the_step)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
