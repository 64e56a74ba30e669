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
  assert_close(ambulo__term_offset(&term, NULL, 3, 1, 2), 0.0, 0.0);
  term.scale = scale;
  term.offset = offset;
  term.reference = reference;
  assert_close(ambulo__term_scale(&term, 2), 3.0, 0.0);
  assert_close(ambulo__term_offset(&term, NULL, 3, 1, 2), 6.0, 0.0);
  term.kind = AMBULO_ACCELERATION;
  assert_close(ambulo__term_offset(&term, NULL, 3, 1, 2), 0.0, 0.0);
  term.kind = AMBULO_TRACKING;
  assert_close(ambulo__term_offset(&term, NULL, 3, 1, 2), 0.6, 0.0);
}

static void each_kind_has_its_function(void **state) {
  (void)state;
  ambulo_term term = {.kind = AMBULO_TORQUE_ABSOLUTE, .smoothing = 4.0};
  assert_close(ambulo__term_residual(&term, 3.0).value, 1.0, 1e-15);
  static const ambulo_term_kind of_squares[] = {AMBULO_TORQUE_SQUARED, AMBULO_ACCELERATION,
                                                AMBULO_TRACKING, AMBULO_POSTURE};
  for (int i = 0; i < 4; i++) {
    term.kind = of_squares[i];
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
        ambulo__term_lanes(&term, NULL, COORDINATES, k, NODES, i, y, u);
        ambulo__term_shapes(&term, ambulo__term_least(&term), u, value, slope);
        for (int l = 0; l < AMBULO__LANES && k + l < NODES; l++) {
          double from = ambulo__term_offset(&term, NULL, COORDINATES, k + l, i);
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
  ambulo__term_lanes(&term, NULL, COORDINATES, 8, NODES, 1, y, u);
  for (int l = 0; l < AMBULO__LANES; l++) assert_close(u[l], 8 + l < NODES ? 0.05 : 0.0, 0.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(names_are_those_of_problem_files),
                                     cmocka_unit_test(terms_look_at_their_channels),
                                     cmocka_unit_test(scales_and_offsets),
                                     cmocka_unit_test(each_kind_has_its_function),
                                     cmocka_unit_test(terms_with_curves_are_composite),
                                     cmocka_unit_test(composite_terms_count_their_residuals),
                                     cmocka_unit_test(blocks_are_their_nodes),
                                     cmocka_unit_test(tracking_has_nothing_beyond_the_last_node)};
  return cmocka_run_group_tests_name("problem/term", tests, NULL, NULL);
}
