/* The table of cycles: what it holds, that it is read back as it was, what it is not written over.
 */
#include "people/compare_cycles.h"
#include "ambulo/tools/compare.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/subject_motion.h"

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
  assert_non_null(strstr(head, ",grf_vertical,grf_vertical sd\n,deg,deg,"));
  /* beside itself nothing is off, and its people are named */
  options.cycles = NULL;
  assert_int_equal(ambulo_compare(motion, out, &options, NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(ambulo_comparison_curve_count(c), 10);
  for (int i = 0; i < 10; i++) {
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(read_back, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(known_values, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(what_is_there_stays, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(memory_runs_out, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_cycles", tests, NULL, NULL);
}
