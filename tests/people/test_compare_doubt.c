/* References over part of the cycle or in radians, curves that nobody has, strikes and durations of
 * another motion: each is told; none of it is told about a good comparison. */
#include "ambulo/tools/report.h"
#include "ambulo/tools/compare.h"
#include "people/compare_score.h"
#include "support/gait_folder.h"
#include "support/messages.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {
      SCRATCH_TEST(references_are_doubted), SCRATCH_TEST(peaks_are_of_what_is_covered),
      SCRATCH_TEST(curves_that_nobody_has_are_named), SCRATCH_TEST(another_motion_is_told)};
  return cmocka_run_group_tests_name("compare/compare_doubt", tests, NULL, NULL);
}
