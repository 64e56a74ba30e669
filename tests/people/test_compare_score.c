/* Scores of curves with known answers, and landmarks of made-up curves. */
#include "ambulo/tools/report.h"
#include "people/compare.h"
#include "support/gait_folder.h"
#include "support/messages.h"
#include "support/test.h"

static const ambulo__map_entry entry = {"c", "c", "q.c", 1, 0, 0, AMBULO__UNIT_ANGLE, 0, 0};

static void known_numbers(void **state) {
  (void)state;
  double percent[4] = {0, 25, 50, 100}, mean[4] = {1, 2, 3, 2}, sd[4] = {1, 1, 1, 1};
  double values[4] = {2, 1, 6, 2}, fine[AMBULO__FINE] = {0};
  fine[33] = 6.5;
  ambulo__reference_curve curve = {&entry, 4, percent, mean, sd};
  ambulo_curve_score score;
  ambulo__score_curve(&curve, values, fine, &score);
  assert_int_equal(score.points, 4);
  assert_close(score.rmse, sqrt(11.0 / 4.0), 1e-15);
  /* deviations (-0.75, -1.75, 3.25, -0.75) and (-1, 0, 1, 0): 4 / sqrt(14.75 2) */
  assert_close(score.r, 4.0 / sqrt(29.5), 1e-15);
  assert_close(score.within_2sd, 0.75, 0.0);
  assert_close(score.peak, 6.5, 0.0);
  assert_close(score.peak_time, 16.5, 0.0);
  assert_close(score.reference_peak, 3.0, 0.0);
  assert_close(score.reference_peak_time, 50.0, 0.0);
}

static void what_does_not_exist_is_nan(void **state) {
  (void)state;
  double percent[3] = {0, 50, 100}, mean[3] = {1, 2, 1}, values[3] = {4, 4, 4};
  double fine[AMBULO__FINE] = {0};
  ambulo__reference_curve curve = {&entry, 3, percent, mean, NULL};
  ambulo_curve_score score;
  ambulo__score_curve(&curve, values, fine, &score);
  assert_true(isnan(score.r));
  assert_true(isnan(score.within_2sd));
}

static const ambulo_landmark *find(const ambulo_landmark *landmarks, int count, const char *name) {
  for (int i = 0; i < count; i++) {
    if (strcmp(landmarks[i].name, name) == 0) return &landmarks[i];
  }
  print_error("no landmark %s\n", name);
  fail();
  return NULL;
}

static void landmarks_stand_where_they_should(void **state) {
  (void)state;
  double fine[AMBULO__FINE] = {0};
  ambulo_landmark found[AMBULO__MAX_LANDMARKS];
  int count = 0;
  fine[0] = 4.0;
  fine[30] = 18.0;  /* 15 % */
  fine[90] = 99.0;  /* 45 %: neither loading nor swing */
  fine[147] = 60.0; /* 73.5 % */
  ambulo__knee_landmarks(fine, found, &count);
  assert_close(find(found, count, "knee at strike")->value, 4.0, 0.0);
  assert_close(find(found, count, "knee loading peak")->value, 18.0, 0.0);
  assert_close(find(found, count, "knee swing peak")->value, 60.0, 0.0);
  assert_close(find(found, count, "knee swing peak")->time, 73.5, 0.0);
  fine[124] = -20.0; /* 62 % */
  fine[190] = -50.0; /* 95 % */
  ambulo__ankle_landmarks(fine, found, &count);
  assert_close(find(found, count, "ankle dorsiflexion")->time, 45.0, 0.0);
  assert_close(find(found, count, "ankle push-off")->value, -20.0, 0.0);
  ambulo__forward_landmarks(fine, found, &count);
  assert_close(find(found, count, "forward force smallest")->time, 95.0, 0.0);
  assert_close(find(found, count, "forward force largest")->value, 99.0, 0.0);
}

/* f = 10 + p^2 / 100 N/kg for p percent: the second difference over 2 percent is 8 / 100 */
static void vertical_force_in_body_weights(void **state) {
  (void)state;
  double fine[AMBULO__FINE];
  ambulo_landmark found[AMBULO__MAX_LANDMARKS];
  int count = 0;
  for (int i = 0; i < AMBULO__FINE; i++) fine[i] = 10.0 + 0.25e-2 * i * i;
  ambulo__vertical_landmarks(fine, 10.0, found, &count);
  assert_close(find(found, count, "vertical force roughness")->value, 8e-3, 1e-12);
  assert_true(isnan(find(found, count, "vertical force roughness")->time));
  fine[24] = 30.0;
  fine[60] = 7.0;
  fine[100] = 60.0;
  count = 0;
  ambulo__vertical_landmarks(fine, 10.0, found, &count);
  assert_close(find(found, count, "vertical force first peak")->value, 3.0, 1e-15);
  assert_close(find(found, count, "vertical force first peak")->time, 12.0, 0.0);
  assert_close(find(found, count, "vertical force valley")->value, 0.7, 1e-15);
  assert_close(find(found, count, "vertical force second peak")->time, 50.0, 0.0);
}

static int test_compare_score_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(known_numbers),
                                     cmocka_unit_test(what_does_not_exist_is_nan),
                                     cmocka_unit_test(landmarks_stand_where_they_should),
                                     cmocka_unit_test(vertical_force_in_body_weights)};
  return cmocka_run_group_tests_name("compare/compare_score", tests, NULL, NULL);
}

/* References over part of the cycle or in radians, curves that nobody has, strikes and durations of
 * another motion: each is told; none of it is told about a good comparison. */

/* hip over `from` to `to` percent, in units of 1 / factor degrees */
static const char *write_reference(void **state, double from, double to, double factor) {
  const char *path = scratch_path(state, "band.csv");
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fprintf(f, "variable,percent,mean_deg,sd_deg\n");
  for (int p = 0; p <= 50; p++) {
    double percent = from + (to - from) * p / 50.0;
    fprintf(f, "hip_flexion,%.12g,%.12g,2\n", percent, factor * gait_hip(0.01 * percent));
  }
  for (int p = 0; p <= 100; p += 2) fprintf(f, "knee_flexion,%d,%.12g,1\n", p, gait_knee(0.01 * p));
  assert_int_equal(fclose(f), 0);
  return path;
}

/* compares; the first message contains `message` (NULL: there is none) */
static void told(void **state, const char *reference, const ambulo_compare_options *options,
                 ambulo_status expected, const char *message) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_comparison *c = NULL;
  assert_int_equal(ambulo_compare(*state, reference, options, NULL, list, &c), expected);
  if (message) assert_message(list, 0, message);
  if (!message) assert_int_equal(ambulo_diagnostics_count(list), 0);
  ambulo_comparison_free(c);
  ambulo_diagnostics_free(list);
}

static void folder(void **state, const char *summary) {
  gait_motion(*state, 0.0, 1);
  gait_summary(*state, summary);
}

#define GOOD "{\"verdict\": \"optimal\", " GAIT_STRIKES ", " GAIT_BODY "}"

static void references_are_doubted(void **state) {
  folder(state, GOOD);
  told(state, write_reference(state, 0.0, 100.0, 1.0), NULL, AMBULO_OK, NULL);
  told(state, write_reference(state, 4.0, 96.0, 1.0), NULL, AMBULO_OK, NULL);
  told(state, write_reference(state, 0.0, 100.0, 0.5), NULL, AMBULO_OK, NULL);
  told(state, write_reference(state, 0.0, 100.0, GAIT_PI / 180.0), NULL, AMBULO_OK,
       "they look like radians");
  told(state, write_reference(state, 0.0, 60.0, 1.0), NULL, AMBULO_OK,
       "'hip_flexion' covers 0 to 60 percent of the cycle; it is compared there");
  told(state, write_reference(state, 0.0, 1.0, 1.0), NULL, AMBULO_OK,
       "a cycle is 0 to 100 percent, not 0 to 1");
}

/* the hip is largest at 0 percent: not there, where the reference says nothing */
static void peaks_are_of_what_is_covered(void **state) {
  ambulo_comparison *c = NULL;
  folder(state, GOOD);
  assert_int_equal(
      ambulo_compare(*state, write_reference(state, 20.0, 70.0, 1.0), NULL, NULL, NULL, &c),
      AMBULO_OK);
  assert_close(ambulo_comparison_curve(c, 0)->peak_time, 20.0, 1e-12);
  assert_close(ambulo_comparison_curve(c, 0)->reference_peak_time, 20.0, 1e-12);
  ambulo_comparison_free(c);
}

static void curves_that_nobody_has_are_named(void **state) {
  ambulo_compare_options options = ambulo_compare_options_default();
  const char *reference = write_reference(state, 0.0, 100.0, 1.0);
  static const char *const bad[] = {
      "knee_flexion,hip_flexoin", "hip", "", "knee_flexion,", ",knee_flexion",
      "hip_flexion knee_flexion"};
  folder(state, GOOD);
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    options.curves = bad[i];
    told(state, reference, &options, AMBULO_E_SCHEMA, "expected some of hip_flexion, knee_flexion");
  }
  options.curves = "knee_flexion,hip_flexion";
  told(state, reference, &options, AMBULO_OK, NULL);
}

static void another_motion_is_told(void **state) {
  ambulo_compare_options options = ambulo_compare_options_default();
  const char *reference = write_reference(state, 0.0, 100.0, 1.0);
  static const double outside[] = {0.0, -1.0, 1.4, 99.0, 1e300};
  folder(state, GOOD);
  for (size_t i = 0; i < sizeof outside / sizeof *outside; i++) {
    options.strike = outside[i];
    told(state, reference, &options, AMBULO_E_SCHEMA, "the motion lasts from 0.1 to 1.3 s");
  }
  folder(state, "{\"strikes\": [{\"foot\": \"left\", \"time\": 4}], " GAIT_BODY "}");
  told(state, reference, NULL, AMBULO_E_SCHEMA, "a strike at 4 s");
  folder(state, "{\"strikes\": [{\"foot\": \"left\"}], " GAIT_BODY "}");
  told(state, reference, NULL, AMBULO_E_SCHEMA, "a strike without 'time'");
  folder(state, "{\"duration\": 1.2, " GAIT_STRIKES ", " GAIT_BODY "}");
  told(state, reference, NULL, AMBULO_OK, NULL);
  folder(state, "{\"duration\": 0.6, " GAIT_STRIKES ", " GAIT_BODY "}");
  told(state, reference, NULL, AMBULO_OK, NULL);
  folder(state, "{\"duration\": 1.1, " GAIT_STRIKES ", " GAIT_BODY "}");
  told(state, reference, NULL, AMBULO_OK, "a duration of 1.1 s beside a motion of 1.2 s");
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

static int test_compare_doubt_tests(void) {
  const struct CMUnitTest tests[] = {
      SCRATCH_TEST(references_are_doubted), SCRATCH_TEST(peaks_are_of_what_is_covered),
      SCRATCH_TEST(curves_that_nobody_has_are_named), SCRATCH_TEST(another_motion_is_told)};
  return cmocka_run_group_tests_name("compare/compare_doubt", tests, NULL, NULL);
}

int main(void) {
  return test_compare_score_tests() + test_compare_doubt_tests();
}
