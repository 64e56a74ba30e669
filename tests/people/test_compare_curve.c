/* Means and deviations over strides and feet; the tilt of a pelvis that is tilted already. */
#include "people/compare.h"
#include "support/fail_alloc.h"
#include "support/gait_folder.h"
#include "support/messages.h"
#include "support/subject_motion.h"

static const ambulo__map_entry hip = {
    "hip", "hip", "q.hip_flexion_{side}", 1, 0, 1, AMBULO__UNIT_ANGLE, 0, 0};

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

static int test_compare_curve_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(over_strides, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(one_stride_has_no_deviation, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(at_the_ends, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(of_a_result, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_curve", tests, NULL, NULL);
}

/* The table of cycles: what it holds, that it is read back as it was, what it is not written over.
 */

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

static const char norms[] = AMBULO_SOURCE_DIR "/models/norms";

static ambulo_compare_options options_for(void **state, const char *out) {
  ambulo_compare_options options = ambulo_compare_options_default();
  options.cycles = out;
  options.mass = 70.0;
  options.forces = subject_forces(state, "ground_force_l", "ground_force_r", 0.0);
  options.strikes = "left=0.5,1.7,2.9,4.1;right=1.1,2.3,3.5";
  return options;
}

static void read_back(void **state) {
  const char *motion = subject_plain(state), *out = scratch_path(state, "cycles.csv");
  ambulo_compare_options options = options_for(state, out);
  ambulo_comparison *c = NULL;
  char head[800] = "";
  assert_int_equal(ambulo_compare_norms(motion, norms, &options, NULL, NULL, &c), AMBULO_OK);
  ambulo_comparison_free(c);
  FILE *f = fopen(out, "r");
  assert_non_null(f);
  assert_true(fread(head, 1, sizeof head - 1, f) > 200);
  assert_int_equal(fclose(f), 0);
  assert_non_null(strstr(head, "# ambulo cycles"));
  assert_non_null(strstr(head, "plain.csv, strides: 3 left, 2 right"));
  assert_non_null(strstr(head, "\npercent,pelvis_anterior_tilt,pelvis_anterior_tilt sd,"));
  assert_non_null(strstr(head, ",grf_medial,grf_medial sd\n,deg,deg,"));
  /* beside itself nothing is off, and its people are named */
  options.cycles = NULL;
  assert_int_equal(ambulo_compare(motion, out, &options, NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(ambulo_comparison_curve_count(c), 11);
  for (int i = 0; i < 11; i++) {
    const ambulo_curve_score *score = ambulo_comparison_curve(c, i);
    assert_true(score->rmse < 1e-5);
    assert_true(score->within_2sd >= 0.0); /* not NaN */
    assert_non_null(strstr(score->source, "plain.csv"));
  }
  ambulo_comparison_free(c);
}

static void known_values(void **state) {
  const char *motion = subject_plain(state), *band = scratch_path(state, "band.csv");
  ambulo_compare_options options = options_for(state, NULL);
  ambulo_comparison *c = NULL;
  FILE *f = fopen(band, "w");
  assert_non_null(f);
  fprintf(f, "percent,knee_flexion,hip_internal_rotation,pelvis_internal_rotation,"
             "pelvis_up_obliquity,grf_vertical,grf_forward\n");
  for (int p = 0; p <= 100; p += 5) {
    double s = 0.01 * p, turn = 2.0 * SUBJECT_PI * s, on = s < 0.6;
    fprintf(f, "%d,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g\n", p, subject_angle("knee_angle", 0, s),
            3.0 * sin(turn), 6.0 * cos(turn), 4.0 * cos(turn),
            on * 10.0 * sin(SUBJECT_PI * s / 0.6),
            -on * 100.0 / 70.0 * sin(2.0 * SUBJECT_PI * s / 0.6));
  }
  assert_int_equal(fclose(f), 0);
  for (int part = 0; part < 2; part++) {
    /* forces of all strides, or of those until 3 s: the others are left out */
    options.forces = subject_forces(state, "ground_force_l", "ground_force_r", part ? -3.0 : 0.0);
    assert_int_equal(ambulo_compare(motion, band, &options, NULL, NULL, &c), AMBULO_OK);
    assert_int_equal(ambulo_comparison_curve_count(c), 6);
    for (int i = 0; i < 6; i++) {
      const ambulo_curve_score *score = ambulo_comparison_curve(c, i);
      if (!(score->rmse < 0.02)) print_error("%s: %g\n", score->name, score->rmse);
      assert_true(score->rmse < 0.02);
    }
    ambulo_comparison_free(c);
  }
}

static void what_is_there_stays(void **state) {
  const char *motion = subject_plain(state), *out = scratch_path(state, "mine.csv");
  ambulo_compare_options options = options_for(state, out);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_comparison *c = NULL;
  scratch_write(out, "my own table\n");
  assert_int_equal(ambulo_compare_norms(motion, norms, &options, NULL, list, &c), AMBULO_E_IO);
  assert_message(list, 0, "mine.csv");
  options.cycles = motion;
  assert_int_equal(ambulo_compare_norms(motion, norms, &options, NULL, list, &c), AMBULO_E_IO);
  options.cycles = options.forces;
  assert_int_equal(ambulo_compare_norms(motion, norms, &options, NULL, list, &c), AMBULO_E_IO);
  options.cycles = out;
  options.overwrite = 1;
  assert_int_equal(ambulo_compare_norms(motion, norms, &options, NULL, list, &c), AMBULO_OK);
  ambulo_comparison_free(c);
  options.overwrite = 0; /* now it is ambulo's own */
  assert_int_equal(ambulo_compare_norms(motion, norms, &options, NULL, list, &c), AMBULO_OK);
  ambulo_comparison_free(c);
  ambulo_diagnostics_free(list);
}

static void memory_runs_out(void **state) {
  const char *motion = subject_plain(state), *out = scratch_path(state, "cycles.csv");
  ambulo_compare_options options = options_for(state, out);
  for (long k = 0; k < 10000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_comparison *c = NULL;
    ambulo_status status = ambulo_compare_norms(motion, norms, &options, &allocator, NULL, &c);
    if (status) assert_int_equal(status, AMBULO_E_MEMORY);
    ambulo_comparison_free(c);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) return;
  }
  fail();
}

static int test_compare_cycles_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(read_back, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(known_values, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(what_is_there_stays, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(memory_runs_out, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_cycles", tests, NULL, NULL);
}

int main(void) {
  return test_compare_curve_tests() + test_compare_cycles_tests();
}
