/* The table of terms: names, channels, scales, offsets, and which function belongs to which. */
#include "problem/term.h"
#include "support/test.h"

static const ambulo__channels channels = {.coordinates = 3, .points = 2};

static void names_are_those_of_problem_files(void **state) {
  (void)state;
  assert_string_equal(ambulo__term_info_of(AMBULO_TORQUE_SQUARED)->name, "torque_squared");
  assert_string_equal(ambulo__term_info_of(AMBULO_TORQUE_ABSOLUTE)->name, "torque_absolute");
  assert_string_equal(ambulo__term_info_of(AMBULO_ACCELERATION)->name, "acceleration");
  assert_string_equal(ambulo__term_info_of(AMBULO_TRACKING)->name, "tracking");
  assert_string_equal(ambulo__term_info_of(AMBULO_USER_TERM)->name, "user");
  assert_null(ambulo__term_info_of((ambulo_term_kind)99));
  assert_true(ambulo__term_info_of(AMBULO_TORQUE_ABSOLUTE)->uses_tau);
  assert_false(ambulo__term_info_of(AMBULO_TRACKING)->uses_tau);
}

static void terms_look_at_their_channels(void **state) {
  (void)state;
  ambulo_term term = {.kind = AMBULO_TORQUE_SQUARED};
  assert_int_equal(ambulo__term_channel(&term, &channels, 1), 10);
  term.kind = AMBULO_TORQUE_ABSOLUTE;
  assert_int_equal(ambulo__term_channel(&term, &channels, 2), 11);
  term.kind = AMBULO_ACCELERATION;
  assert_int_equal(ambulo__term_channel(&term, &channels, 1), 7);
  term.kind = AMBULO_TRACKING;
  assert_int_equal(ambulo__term_channel(&term, &channels, 1), 1);
}

static void scales_and_offsets(void **state) {
  (void)state;
  static const double scale[] = {1.0, 2.0, 3.0}, offset[] = {4.0, 5.0, 6.0};
  static const double reference[] = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  ambulo_term term = {.kind = AMBULO_TORQUE_SQUARED};
  assert_close(ambulo__term_scale(&term, 2), 1.0, 0.0);
  assert_close(ambulo__term_offset(&term, 3, 1, 2), 0.0, 0.0);
  term.scale = scale;
  term.offset = offset;
  term.reference = reference;
  assert_close(ambulo__term_scale(&term, 2), 3.0, 0.0);
  assert_close(ambulo__term_offset(&term, 3, 1, 2), 6.0, 0.0);
  term.kind = AMBULO_ACCELERATION;
  assert_close(ambulo__term_offset(&term, 3, 1, 2), 0.0, 0.0);
  term.kind = AMBULO_TRACKING;
  assert_close(ambulo__term_offset(&term, 3, 1, 2), 0.6, 0.0);
}

static void each_kind_has_its_function(void **state) {
  (void)state;
  ambulo_term term = {.kind = AMBULO_TORQUE_ABSOLUTE, .smoothing = 4.0};
  assert_close(ambulo__term_residual(&term, 3.0).value, 1.0, 1e-15);
  static const ambulo_term_kind squares[] = {AMBULO_TORQUE_SQUARED, AMBULO_ACCELERATION,
                                             AMBULO_TRACKING, AMBULO_POSTURE};
  for (int i = 0; i < 4; i++) {
    term.kind = squares[i];
    assert_close(ambulo__term_residual(&term, 3.0).value, 9.0, 0.0);
  }
}

static void terms_with_curves_are_composite(void **state) {
  (void)state;
  static const double curve[12] = {0.0};
  ambulo_term term = {.kind = AMBULO_TORQUE_POWER, .power = 4.0, .smoothing = 1e-3};
  assert_true(ambulo__term_is_simple(&term));
  assert_close(ambulo__term_residual(&term, 2.0).value, 16.0, 1e-5);
  term.passive = curve;
  assert_false(ambulo__term_is_simple(&term));
  term.kind = AMBULO_UPRIGHT;
  assert_false(ambulo__term_is_simple(&term));
  term.kind = AMBULO_POSTURE;
  assert_true(ambulo__term_is_simple(&term));
  assert_int_equal(ambulo__term_channel(&term, &channels, 2), 2);
}

static void composite_terms_count_their_residuals(void **state) {
  (void)state;
  ambulo__term_context context = {.channels = channels, .nodes = 5};
  ambulo_term term = {.kind = AMBULO_TORQUE_RATE};
  assert_int_equal(ambulo__term_forms(&term, &context, 3), 3);
  assert_int_equal(ambulo__term_forms(&term, &context, 4), 0);
  term.kind = AMBULO_UPRIGHT;
  assert_int_equal(ambulo__term_forms(&term, &context, 4), 2);
  term.kind = AMBULO_GROUND_FORCE;
  assert_int_equal(ambulo__term_forms(&term, &context, 0), 3);
  term.kind = AMBULO_TORQUE_SQUARED;
  assert_int_equal(ambulo__term_forms(&term, &context, 0), 0);
}

/* what finds no room is no part that may be missing: the residual has no value any more */
static void a_full_form_has_no_value(void **state) {
  (void)state;
  ambulo__form form = {.u = 1.0};
  for (int c = 0; c < AMBULO__FORM_CHANNELS; c++) ambulo__form_add(&form, c, 0, 1.0);
  assert_int_equal(form.count, AMBULO__FORM_CHANNELS);
  assert_close(form.u, 1.0, 0.0);
  ambulo__form_add(&form, 0, 0, 1.0);
  assert_int_equal(form.count, AMBULO__FORM_CHANNELS);
  assert_true(isnan(form.u));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(names_are_those_of_problem_files),
                                     cmocka_unit_test(terms_look_at_their_channels),
                                     cmocka_unit_test(scales_and_offsets),
                                     cmocka_unit_test(each_kind_has_its_function),
                                     cmocka_unit_test(terms_with_curves_are_composite),
                                     cmocka_unit_test(composite_terms_count_their_residuals),
                                     cmocka_unit_test(a_full_form_has_no_value)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
