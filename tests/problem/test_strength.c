/* Active torque as a share of strength. */
#include "form_fixture.h"

static void passive_torque_is_taken_off_and_strength_divides(void **state) {
  (void)state;
  static const double passive[] = {0, 0, 0, 0, -1.5, -2.0, 0.5, 3.0};
  static const double strength[] = {0, 0, 0, 0, 0, 0, 50.0, 0.9, 0.4, 80.0, 0.7, -0.2};
  form_fixture f;
  form_open(&f);
  ambulo_term term = {.kind = AMBULO_TORQUE_POWER,
                      .power = 3.0,
                      .smoothing = 0.01,
                      .passive = passive,
                      .strength = strength};
  int tau = ambulo__channel_tau(&f.context.channels, 1),
      q = ambulo__channel_q(&f.context.channels, 1);
  *form_at(&f, 0, q) = 0.3;
  for (int sign = -1; sign <= 1; sign += 2) {
    *form_at(&f, 0, tau) = sign * 30.0;
    double active = sign * 30.0 - (-1.5 * exp(-0.6) + 0.5 * exp(0.9));
    double peak = sign > 0 ? 50.0 * cos(0.9 * (0.3 - 0.4)) : 80.0 * cos(0.7 * (0.3 + 0.2));
    ambulo__form form;
    ambulo__term_form(&term, &f.context, 0, 1, &form);
    assert_close(form.u, active / peak, 1e-14);
    check_form_slopes(&f, &term, 0, 1);
  }
  /* no curve: strength 1, nothing passive */
  ambulo__form form;
  ambulo__term_form(&term, &f.context, 0, 0, &form);
  assert_close(form.u, *form_at(&f, 0, ambulo__channel_tau(&f.context.channels, 0)), 1e-15);
  form_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(passive_torque_is_taken_off_and_strength_divides)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
