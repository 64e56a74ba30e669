/* The laws of composite terms, and the table of all kinds. */
#include "ambulo/tools/load.h"
#include "form_fixture.h"
#include "problem/term.h"
#include "support/test.h"

static void passive_torque_and_its_derivative(void **state) {
  (void)state;
  /* hip, men of 18-25 years: Anderson et al. 2007, Table 3 */
  static const double curve[] = {-1.21, -6.351, 0.476, 5.91};
  for (double q = -0.4; q < 0.5; q += 0.11) {
    double slope, ignored, h = 1e-6;
    double value = ambulo__passive_torque(curve, q, &slope);
    assert_close(value, -1.21 * exp(-6.351 * q) + 0.476 * exp(5.91 * q), 1e-14);
    double numeric = (ambulo__passive_torque(curve, q + h, &ignored) -
                      ambulo__passive_torque(curve, q - h, &ignored)) /
                     (2.0 * h);
    assert_close(slope, numeric, 1e-7);
  }
}

static void strength_is_a_cosine_that_stays_positive(void **state) {
  (void)state;
  static const double curve[] = {200.0, 0.958, 0.932};
  double slope, ignored;
  assert_close(ambulo__strength(curve, 0.932, &slope), 200.0, 1e-15);
  assert_close(slope, 0.0, 1e-12);
  for (double q = -3.0; q < 3.0; q += 0.17) {
    double h = 1e-6, value = ambulo__strength(curve, q, &slope);
    assert_true(value > 0.0);
    double numeric =
        (ambulo__strength(curve, q + h, &ignored) - ambulo__strength(curve, q - h, &ignored)) /
        (2.0 * h);
    assert_close(slope, numeric, 1e-6);
  }
}

/* Active torque as a share of strength. */

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

/* Power of a joint per body mass. */

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

/* Differences of torque between neighbouring nodes. */

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

/* Direction cosines of a segment's line; a line over joints. */

static void a_leaning_line_has_its_cosines(void **state) {
  (void)state;
  form_fixture f;
  form_open(&f);
  ambulo_term term = {.kind = AMBULO_UPRIGHT, .point = {1, 0}};
  /* the two points of the arm are hypot(0.2, 0.05) apart on their link */
  double length = hypot(0.2, 0.05), lean = 0.3;
  for (int axis = 0; axis < 3; axis++)
    *form_at(&f, 2, ambulo__channel_point(&f.context.channels, 1, axis)) = 1.0;
  *form_at(&f, 2, ambulo__channel_point(&f.context.channels, 0, 0)) = 1.0 + length * sin(lean);
  *form_at(&f, 2, ambulo__channel_point(&f.context.channels, 0, 1)) = 1.0 + length * cos(lean);
  *form_at(&f, 2, ambulo__channel_point(&f.context.channels, 0, 2)) = 1.0;
  ambulo__form form;
  ambulo__term_form(&term, &f.context, 2, 0, &form);
  assert_close(form.u, sin(lean), 1e-14);
  ambulo__term_form(&term, &f.context, 2, 1, &form);
  assert_close(form.u, 0.0, 1e-14);
  check_form_slopes(&f, &term, 2, 0);
  check_form_slopes(&f, &term, 2, 1);
  form_close(&f);
}

/* hip to ball of the foot: 0.534643 of the stature below and 0.08 ahead at q = 0 */
static void a_line_over_joints_has_its_length_at_rest(void **state) {
  (void)state;
  ambulo_model *body = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_21.yaml", NULL, NULL, NULL, &body),
                   AMBULO_OK);
  int line[2] = {ambulo_model_find_point(body, "hip_r"), ambulo_model_find_point(body, "ball_r")};
  assert_close(ambulo__upright_length(body, line), 1.75 * hypot(0.534643, 0.08), 1e-9);
  ambulo_model_free(body);
}

/* The root force in body weights, less the weight itself. */

static void standing_costs_nothing(void **state) {
  (void)state;
  form_fixture f;
  form_open(&f);
  ambulo_term term = {.kind = AMBULO_GROUND_FORCE};
  double weight = 3.5 * 9.81;
  *form_at(&f, 0, ambulo__channel_force(&f.context.channels, 0)) = 0.2 * weight;
  *form_at(&f, 0, ambulo__channel_force(&f.context.channels, 1)) = weight;
  *form_at(&f, 0, ambulo__channel_force(&f.context.channels, 2)) = 0.0;
  static const double want[] = {0.2, 0.0, 0.0};
  for (int axis = 0; axis < 3; axis++) {
    ambulo__form form;
    ambulo__term_form(&term, &f.context, 0, axis, &form);
    assert_close(form.u, want[axis], 1e-14);
    check_form_slopes(&f, &term, 0, axis);
  }
  form_close(&f);
}

/* what other code takes for granted about a row */
static void rows_of_the_table_are_whole(void **state) {
  (void)state;
  int kinds = 0;
  for (int k = 1; ambulo__term_info_of((ambulo_term_kind)k); k++, kinds++) {
    const ambulo__term_info *info = ambulo__term_info_of((ambulo_term_kind)k);
    int by_coordinate = info->subject != AMBULO__TERM_OF_OTHERS;
    assert_non_null(info->name);
    assert_true(!info->forms == !info->form);
    assert_true(info->form || by_coordinate || info->members & AMBULO__TERM_CALLBACK);
    assert_int_equal(by_coordinate,
                     (info->members & (AMBULO__TERM_SCALE | AMBULO__TERM_REST)) != 0);
    if (by_coordinate) assert_int_equal(info->mirror, AMBULO__MIRROR_COORDINATES);
    ambulo_term term = ambulo_term_default((ambulo_term_kind)k);
    assert_true(term.weight == 1.0 && term.smoothing > 0.0 && term.power >= 2.0);
    for (int other = 1; other < k; other++)
      assert_string_not_equal(info->name, ambulo__term_info_of((ambulo_term_kind)other)->name);
  }
  assert_int_equal(kinds, AMBULO_PRESSURE_TRACKING);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_of_the_table_are_whole),
      cmocka_unit_test(passive_torque_and_its_derivative),
      cmocka_unit_test(strength_is_a_cosine_that_stays_positive),
      cmocka_unit_test(passive_torque_is_taken_off_and_strength_divides),
      cmocka_unit_test(power_is_torque_times_rate_over_mass),
      cmocka_unit_test(muscles_shorten_for_the_joint_and_for_the_tendon),
      cmocka_unit_test(what_a_tendon_takes_it_gives),
      cmocka_unit_test(steps_may_differ),
      cmocka_unit_test(the_rate_is_the_difference_over_the_step),
      cmocka_unit_test(a_leaning_line_has_its_cosines),
      cmocka_unit_test(a_line_over_joints_has_its_length_at_rest),
      cmocka_unit_test(standing_costs_nothing)};
  return cmocka_run_group_tests_name("problem/term_kinds", tests, NULL, NULL);
}
