/* Power of a joint per body mass. */
#include "form_fixture.h"

static void power_is_torque_times_rate_over_mass(void **state) {
  (void)state;
  static const double scale[] = {0.0, 2.0};
  form_fixture f;
  form_open(&f);
  ambulo_term term = {.kind = AMBULO_MECHANICAL_POWER, .smoothing = 0.05, .scale = scale};
  ambulo__form form;
  *form_at(&f, 1, ambulo__channel_tau(&f.context.channels, 1)) = -20.0;
  *form_at(&f, 1, ambulo__channel_qd(&f.context.channels, 1)) = 3.5;
  ambulo__term_form(&term, &f.context, 1, 1, &form);
  assert_close(form.u, 2.0 * -20.0 * 3.5 / 3.5, 1e-14);
  check_form_slopes(&f, &term, 1, 1);
  ambulo__term_form(&term, &f.context, 1, 0, &form);
  assert_int_equal(form.count, 0);
  form_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(power_is_torque_times_rate_over_mass)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
