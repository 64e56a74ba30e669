/* Means and deviations over strides and feet; the tilt of a pelvis that is tilted already. */
#include "people/compare_curve.h"
#include "ambulo/tools/compare.h"
#include "support/gait_folder.h"
#include "support/messages.h"
#include "support/subject_motion.h"

static const ambulo__map_entry hip = {"hip", "hip", "q.hip_flexion_{side}", 1,
                                      0,     1,     AMBULO__UNIT_ANGLE};

/* a hip that goes from 0 by `rise` degrees within each stride, more by `more` in each next one */
static const char *steps(void **state, double more, double limp) {
  const char *path = scratch_path(state, "steps.csv");
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fprintf(f, "# inDegrees=yes\ntime,hip_flexion_l,hip_flexion_r\n");
  for (int k = 0; k <= 400; k++) {
    double t = 0.01 * k, stride = floor(t + 1e-9), s = 2.0 * SUBJECT_PI * t;
    fprintf(f, "%.10g,%.10g,%.10g\n", t, 20.0 * sin(s) + more * stride,
            20.0 * sin(s) + more * stride + limp);
  }
  assert_int_equal(fclose(f), 0);
  return path;
}

static void over_strides(void **state) {
  static const struct {
    double limp, mean;
    int strides;
    const char *foot;
  } cases[] = {{0.0, 20.0 + 3.0, 6, NULL},
               {0.0, 20.0 + 3.0, 3, "left"},
               {30.0, 20.0 + 3.0, 3, NULL},
               {30.0, 20.0 + 33.0, 3, "right"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo_compare_options options = ambulo_compare_options_default();
    ambulo__cycle cycle;
    ambulo__sampler sampler;
    double percent = 25.0, value = 0.0, deviation = 0.0;
    int strides = 0;
    options.pelvic_tilt = 0.0;
    options.foot = cases[i].foot;
    options.strikes = "left=0,1,2,3;right=0,1,2,3";
    assert_int_equal(
        ambulo__cycle_open_subject(steps(state, 3.0, cases[i].limp), &options, NULL, NULL, &cycle),
        AMBULO_OK);
    assert_int_equal(ambulo__sampler_create(&cycle, &options, 3, &sampler), AMBULO_OK);
    assert_int_equal(
        ambulo__sample_curve(&sampler, &hip, &percent, 1, &value, &deviation, &strides), AMBULO_OK);
    assert_int_equal(strides, cases[i].strides);
    assert_close(value, cases[i].mean, 0.02);
    /* strides of 20, 23 and 26: of three 3, of two times three sqrt(6 / 5 * 6) */
    assert_close(deviation, cases[i].strides == 3 ? 3.0 : sqrt(6.0 / 5.0 * 6.0), 0.02);
    ambulo__sampler_free(&sampler);
    ambulo__cycle_close(&cycle);
  }
}

static void one_stride_has_no_deviation(void **state) {
  ambulo_compare_options options = ambulo_compare_options_default();
  ambulo__cycle cycle;
  ambulo__sampler sampler;
  double percent = 0.0, value = 0.0, deviation = 0.0;
  int strides = 0;
  options.strikes = "right=1,2";
  options.pelvic_tilt = 10.0 * SUBJECT_PI / 180.0;
  assert_int_equal(ambulo__cycle_open_subject(steps(state, 0.0, 2.0), &options, NULL, NULL, &cycle),
                   AMBULO_OK);
  assert_int_equal(ambulo__sampler_create(&cycle, &options, 3, &sampler), AMBULO_OK);
  assert_int_equal(ambulo__sample_curve(&sampler, &hip, &percent, 1, &value, &deviation, &strides),
                   AMBULO_OK);
  assert_int_equal(strides, 1); /* the left foot has none: the right one stands */
  assert_close(value, 12.0, 1e-6);
  assert_true(deviation != deviation);
  cycle.subject->marker_pelvis = 1;
  assert_int_equal(ambulo__sample_curve(&sampler, &hip, &percent, 1, &value, NULL, &strides),
                   AMBULO_OK);
  assert_close(value, 2.0, 1e-6);
  ambulo__sampler_free(&sampler);
  ambulo__cycle_close(&cycle);
}

/* a motion whose end does not lead to its beginning, as that of a result does */
static void at_the_ends(void **state) {
  ambulo_compare_options options = ambulo_compare_options_default();
  ambulo__cycle cycle;
  const char *path = scratch_path(state, "ends.csv");
  double percents[2] = {0.0, 100.0}, values[2];
  int found = 0;
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fprintf(f, "# inDegrees=yes\ntime,hip_flexion_l\n");
  for (int k = 0; k <= 8; k++) fprintf(f, "%g,%.10g\n", 0.5 * k, 5.0 * k * k);
  assert_int_equal(fclose(f), 0);
  options.strikes = "left=0.25,3.75";
  assert_int_equal(ambulo__cycle_open_subject(path, &options, NULL, NULL, &cycle), AMBULO_OK);
  assert_int_equal(
      ambulo__cycle_spread(&cycle, &hip, AMBULO__CYCLE_LEFT, percents, 2, values, NULL, &found),
      AMBULO_OK);
  assert_close(values[0], 5.0 * 0.25, 0.7); /* at an end the slope is that of its interval */
  assert_close(values[1], 5.0 * 7.5 * 7.5, 0.005);
  ambulo__cycle_close(&cycle);
}

/* of a result both feet are one stride each */
static void of_a_result(void **state) {
  ambulo_compare_options options = ambulo_compare_options_default();
  ambulo__cycle cycle;
  ambulo__sampler sampler;
  double percents[3] = {0.0, 30.0, 80.0}, values[3], deviations[3];
  int strides = 0;
  options.pelvic_tilt = 0.0;
  gait_motion(*state, 1.0, 1);
  gait_summary(*state, "{" GAIT_STRIKES ", " GAIT_BODY "}");
  assert_int_equal(ambulo__cycle_open(*state, &options, NULL, NULL, &cycle), AMBULO_OK);
  assert_int_equal(ambulo__sampler_create(&cycle, &options, 3, &sampler), AMBULO_OK);
  assert_int_equal(ambulo__sample_curve(&sampler, &hip, percents, 3, values, deviations, &strides),
                   AMBULO_OK);
  assert_int_equal(strides, 2);
  for (int i = 0; i < 3; i++) assert_close(values[i], gait_hip(0.01 * percents[i]) + 0.5, 1e-2);
  assert_close(deviations[0], 1.0 / sqrt(2.0), 1e-2);
  ambulo__sampler_free(&sampler);
  ambulo__cycle_close(&cycle);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(over_strides, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(one_stride_has_no_deviation, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(at_the_ends, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(of_a_result, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_curve", tests, NULL, NULL);
}
