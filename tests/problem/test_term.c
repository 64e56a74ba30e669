/* The table of terms: names, channels, scales, offsets, and which function belongs to which. */
#include "base/lanes.h"
#include "problem/term.h"
#include "support/random_model.h"
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
  assert_true(ambulo__term_info_of(AMBULO_TORQUE_ABSOLUTE)->subject == AMBULO__TERM_OF_TORQUE);
  assert_true(ambulo__term_info_of(AMBULO_TRACKING)->subject == AMBULO__TERM_OF_POSITION);
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

/* The scalar functions: squares, smoothed absolute value, power law. */

static void values_by_hand(void **state) {
  (void)state;
  ambulo__residual r = ambulo__absolute(-3.0, 4.0);
  assert_close(r.value, 1.0, 1e-15);
  assert_close(r.slope, -0.6, 1e-15);
  assert_close(r.curvature, 0.2, 1e-15);
  r = ambulo__absolute(0.0, 0.5);
  assert_close(r.value, 0.0, 0.0);
  assert_close(r.slope, 0.0, 0.0);
  assert_close(r.curvature, 2.0, 1e-15);
}

static void it_tends_to_the_absolute_value(void **state) {
  (void)state;
  assert_close(ambulo__absolute(-7.0, 1e-6).value, 7.0, 1e-6);
  assert_close(ambulo__absolute(1e200, 1.0).value, 1e200, 1e-15);
}

/* 1e-9^2 / (2 s): the plain formula would lose every digit */
static void small_arguments_keep_their_digits(void **state) {
  (void)state;
  assert_close(ambulo__absolute(1e-9, 1.0).value * 1e18, 0.5, 1e-12);
}

static void the_slope_is_the_derivative(void **state) {
  (void)state;
  for (double u = -2.0; u < 2.0; u += 0.37) {
    double h = 1e-6, s = 0.3;
    double numeric =
        (ambulo__absolute(u + h, s).value - ambulo__absolute(u - h, s).value) / (2.0 * h);
    assert_close(ambulo__absolute(u, s).slope, numeric, 1e-8);
  }
}

/* phi(v) <= phi(u) + phi'(u) (v - u) + curvature (v - u)^2 / 2 */
static void the_parabola_lies_above(void **state) {
  (void)state;
  ambulo__residual r = ambulo__absolute(1.1, 0.2);
  for (double v = -3.0; v < 3.0; v += 0.1) {
    double step = v - 1.1;
    double parabola = r.value + r.slope * step + 0.5 * r.curvature * step * step;
    assert_true(ambulo__absolute(v, 0.2).value <= parabola + 1e-12);
  }
}

static void squares(void **state) {
  (void)state;
  ambulo__residual r = ambulo__squared(-3.0);
  assert_close(r.value, 9.0, 0.0);
  assert_close(r.slope, -6.0, 0.0);
  assert_close(r.curvature, 2.0, 0.0);
}

static void power_laws_by_hand_and_by_differences(void **state) {
  (void)state;
  /* (3^2 + 4^2)^(3/2) - 4^3 = 125 - 64 */
  assert_close(ambulo__power_law(3.0, 3.0, 4.0, 64.0).value, 61.0, 1e-15);
  assert_close(ambulo__power_law(3.0, 2.0, 4.0, 16.0).value, 9.0, 1e-14);
  for (double power = 2.0; power < 5.0; power += 0.5) {
    for (double u = -1.5; u < 1.5; u += 0.29) {
      double h = 1e-6, s = 0.2;
      ambulo__residual r = ambulo__power_law(u, power, s, ambulo__power_least(power, s));
      ambulo__residual a = ambulo__power_law(u - h, power, s, ambulo__power_least(power, s));
      ambulo__residual b = ambulo__power_law(u + h, power, s, ambulo__power_least(power, s));
      assert_close(r.slope, (b.value - a.value) / (2.0 * h), 1e-8);
      assert_close(r.curvature, (b.slope - a.slope) / (2.0 * h), 1e-8);
    }
  }
}

/* Terms at a block of nodes, against the same terms one node and residual at a time. */

enum { COORDINATES = 3, NODES = 11 };

static const double scale[] = {1.0, 0.05, 2.0}, offset[] = {0.3, -0.2, 5.0};

static ambulo_term term_of(ambulo_term_kind kind, const double *reference) {
  ambulo_term term = {.kind = kind,
                      .scale = scale,
                      .offset = offset,
                      .reference = reference,
                      .smoothing = 0.1,
                      .power = 3.0};
  return term;
}

static void blocks_are_their_nodes(void **state) {
  (void)state;
  static const ambulo_term_kind kinds[] = {AMBULO_TORQUE_SQUARED, AMBULO_TORQUE_ABSOLUTE,
                                           AMBULO_ACCELERATION,   AMBULO_TRACKING,
                                           AMBULO_TORQUE_POWER,   AMBULO_POSTURE};
  double reference[NODES * COORDINATES], y[AMBULO__LANES];
  random_source source = {3};
  for (int e = 0; e < NODES * COORDINATES; e++) reference[e] = random_between(&source, -1.0, 1.0);
  for (size_t n = 0; n < sizeof kinds / sizeof *kinds; n++) {
    ambulo_term term = term_of(kinds[n], reference);
    assert_true(ambulo__term_is_simple(&term));
    for (int k = 0; k < NODES; k += AMBULO__LANES) {
      for (int i = 0; i < COORDINATES; i++) {
        double u[AMBULO__LANES], value[AMBULO__LANES], slope[AMBULO__LANES];
        for (int l = 0; l < AMBULO__LANES; l++) y[l] = random_between(&source, -1.0, 1.0);
        ambulo__term_lanes(&term, COORDINATES, k, NODES, i, y, u);
        ambulo__term_shapes(&term, ambulo__term_least(&term), u, value, slope);
        for (int l = 0; l < AMBULO__LANES && k + l < NODES; l++) {
          double from = ambulo__term_offset(&term, COORDINATES, k + l, i);
          ambulo__residual want = ambulo__term_residual(&term, scale[i] * (y[l] - from));
          assert_close(value[l], want.value, 0.0);
          assert_close(slope[l], want.slope, 0.0);
        }
      }
    }
  }
}

static void tracking_has_nothing_beyond_the_last_node(void **state) {
  (void)state;
  double reference[NODES * COORDINATES] = {0.0}, y[AMBULO__LANES], u[AMBULO__LANES];
  ambulo_term term = term_of(AMBULO_TRACKING, reference);
  for (int l = 0; l < AMBULO__LANES; l++) y[l] = 1.0;
  ambulo__term_lanes(&term, COORDINATES, 8, NODES, 1, y, u);
  for (int l = 0; l < AMBULO__LANES; l++) assert_close(u[l], 8 + l < NODES ? 0.05 : 0.0, 0.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(names_are_those_of_problem_files),
                                     cmocka_unit_test(terms_look_at_their_channels),
                                     cmocka_unit_test(scales_and_offsets),
                                     cmocka_unit_test(each_kind_has_its_function),
                                     cmocka_unit_test(terms_with_curves_are_composite),
                                     cmocka_unit_test(composite_terms_count_their_residuals),
                                     cmocka_unit_test(a_full_form_has_no_value),
                                     cmocka_unit_test(squares),
                                     cmocka_unit_test(power_laws_by_hand_and_by_differences),
                                     cmocka_unit_test(values_by_hand),
                                     cmocka_unit_test(it_tends_to_the_absolute_value),
                                     cmocka_unit_test(small_arguments_keep_their_digits),
                                     cmocka_unit_test(the_slope_is_the_derivative),
                                     cmocka_unit_test(the_parabola_lies_above),
                                     cmocka_unit_test(blocks_are_their_nodes),
                                     cmocka_unit_test(tracking_has_nothing_beyond_the_last_node)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
