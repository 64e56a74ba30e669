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

static const double tendon[] = {0.0, 50.0};

/* u is at most of second degree in each channel: differences of any width are exact */
static void check_slopes_exactly(form_fixture *f, const ambulo_term *term, int node, int j) {
  ambulo__form form, plus, minus;
  ambulo__term_form(term, &f->context, node, j, &form);
  assert_int_equal(form.count, 4);
  for (int c = 0; c < form.count; c++) {
    double *value = form_at(f, node + form.ahead[c], form.channel[c]), kept = *value;
    *value = kept + 8.0;
    ambulo__term_form(term, &f->context, node, j, &plus);
    *value = kept - 8.0;
    ambulo__term_form(term, &f->context, node, j, &minus);
    *value = kept;
    assert_close(form.slope[c], (plus.u - minus.u) / 16.0, 1e-14);
  }
}

static void muscles_shorten_for_the_joint_and_for_the_tendon(void **state) {
  (void)state;
  static const double scale[] = {1.0, 2.0};
  form_fixture f;
  form_open(&f);
  ambulo_term term = {
      .kind = AMBULO_MECHANICAL_POWER, .smoothing = 0.05, .scale = scale, .tendon = tendon};
  ambulo__form form;
  for (int i = 0; i < 2; i++) {
    *form_at(&f, 1, ambulo__channel_tau(&f.context.channels, i)) = -10.0;
    *form_at(&f, 2, ambulo__channel_tau(&f.context.channels, i)) = -14.0;
    *form_at(&f, 1, ambulo__channel_qd(&f.context.channels, i)) = 2.0;
    *form_at(&f, 2, ambulo__channel_qd(&f.context.channels, i)) = 3.0;
  }
  ambulo__term_form(&term, &f.context, 1, 1, &form);
  assert_close(form.u, 2.0 * -12.0 * (2.5 - 40.0 / 50.0) / 3.5, 1e-14);
  assert_close(form.difference, 2.0 * -12.0 * (-40.0 / 50.0) / 3.5, 1e-14);
  check_slopes_exactly(&f, &term, 1, 1);
  ambulo__term_form(&term, &f.context, 1, 0, &form); /* of a joint without: means alone */
  assert_close(form.u, -12.0 * 2.5 / 3.5, 1e-14);
  assert_close(form.difference, 0.0, 0.0);
  check_slopes_exactly(&f, &term, 1, 0);
  assert_int_equal(ambulo__term_forms(&term, &f.context, 2), 0); /* no interval after the last */
  assert_true(ambulo__term_is_rate(&term));
  term.tendon = NULL;
  assert_false(ambulo__term_is_rate(&term));
  form_close(&f);
}

/* a joint at rest whose torque comes and goes: what muscles put in, tau^2 / 2k, they get back */
static void what_a_tendon_takes_it_gives(void **state) {
  (void)state;
  static const double times[FORM_NODES] = {0.0, 0.1, 0.35}, torque[FORM_NODES] = {3.0, 17.0, 3.0};
  form_fixture f;
  form_open(&f);
  f.context.times = times;
  ambulo_term term = {.kind = AMBULO_MECHANICAL_POWER, .smoothing = 0.05, .tendon = tendon};
  ambulo__form form[2];
  for (int k = 0; k < FORM_NODES; k++) {
    *form_at(&f, k, ambulo__channel_tau(&f.context.channels, 1)) = torque[k];
    *form_at(&f, k, ambulo__channel_qd(&f.context.channels, 1)) = 0.0;
  }
  for (int k = 0; k < 2; k++) ambulo__term_form(&term, &f.context, k, 1, &form[k]);
  assert_close(0.1 * form[0].u, (17.0 * 17.0 - 3.0 * 3.0) / (2.0 * 50.0) / 3.5, 1e-14);
  assert_close(0.25 * form[1].u, -0.1 * form[0].u, 1e-14);
  form_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(power_is_torque_times_rate_over_mass),
      cmocka_unit_test(muscles_shorten_for_the_joint_and_for_the_tendon),
      cmocka_unit_test(what_a_tendon_takes_it_gives)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
