/* The shipped curves of people: what is read of them, their signs, and of which motions they are.
 */
#include "people/compare_people.h"
#include "ambulo/tools/report.h"
#include "ambulo/tools/compare.h"
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"
#include "support/gait_folder.h"
#include "support/messages.h"

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

static const char norms[] = AMBULO_SOURCE_DIR "/models/norms";

#define GAIT "\"gait\": {\"steps\": 2}"

static const ambulo__reference_curve *curve_of(const ambulo__people_file *file, const char *name) {
  for (int i = 0; i < file->reference.count; i++) {
    if (strcmp(file->reference.curves[i].entry->curve, name) == 0)
      return &file->reference.curves[i];
  }
  return NULL;
}

static void shipped_tables(void **state) {
  (void)state;
  static const char *const angles[] = {
      "pelvis_anterior_tilt", "pelvis_up_obliquity", "pelvis_internal_rotation",
      "hip_flexion",          "hip_adduction",       "hip_internal_rotation",
      "knee_flexion",         "ankle_dorsiflexion"};
  static const char *const loads[] = {"grf_forward", "grf_vertical", "hip_extension_moment",
                                      "knee_extension_moment", "ankle_plantarflexion_moment"};
  ambulo__people people;
  assert_int_equal(ambulo__norms_read(norms, NULL, NULL, &people), AMBULO_OK);
  assert_int_equal(people.count, 2);
  assert_int_equal(people.files[0].reference.count, 8);
  assert_int_equal(people.files[1].reference.count, 5); /* its angles are those of the first */
  for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
    const ambulo__reference_curve *curve = curve_of(&people.files[0], angles[i]);
    assert_non_null(curve);
    assert_int_equal(curve->points, 51);
    assert_non_null(curve->sd);
  }
  for (size_t i = 0; i < sizeof loads / sizeof *loads; i++) {
    const ambulo__reference_curve *curve = curve_of(&people.files[1], loads[i]);
    assert_non_null(curve);
    assert_int_equal(curve->points, 51);
    assert_null(curve->sd);
  }
  assert_close(curve_of(&people.files[0], "knee_flexion")->mean[37], 62.16476, 0.0);
  assert_close(curve_of(&people.files[1], "grf_vertical")->mean[7], 10.82, 0.0);
  assert_non_null(strstr(people.files[0].source, "Fukuchi"));
  assert_non_null(strstr(people.files[1].source, "Winter"));
  ambulo__people_free(&people);
}

/* credit and licence travel in the files themselves */
static void credit(void **state) {
  (void)state;
  static const char *const words[][3] = {
      {"young_adults.csv", "CC BY 4.0", "10.7717/peerj.4640"},
      {"normal_cadence.csv", "Winter", "mechmotum/gait-closed-loop-id"},
      {"README.md", "creativecommons.org/licenses/by/4.0", "PhysioGaitNorm"}};
  for (size_t i = 0; i < 3; i++) {
    char path[512], text[2000];
    (void)snprintf(path, sizeof path, "%s/%s", norms, words[i][0]);
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    text[fread(text, 1, sizeof text - 1, f)] = '\0';
    assert_int_equal(fclose(f), 0);
    for (int k = 1; k < 3; k++) assert_non_null(strstr(text, words[i][k]));
  }
}

/* a pelvis that does, on each side, what the reference says of the side that strikes */
static void signs_of_the_pelvis(void **state) {
  char path[SCRATCH_PATH + 64];
  (void)snprintf(path, sizeof path, "%s/motion.csv", (const char *)*state);
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fprintf(f, "time,q.pelvis_tilt,q.pelvis_list,q.pelvis_rotation,q.hip_rotation_l,"
             "q.hip_rotation_r\n");
  for (int k = 0; k <= 40; k++) {
    double t = 0.1 + 0.03 * k, turn = 2.0 * GAIT_PI * (t - 0.4) / 1.2, rad = GAIT_PI / 180.0;
    /* positive: backward; right side down; right side forward; inward, each leg */
    fprintf(f, "%.12g,%.12g,%.12g,%.12g,%.12g,%.12g\n", t, -rad * 2.0 * cos(2.0 * turn),
            rad * 4.0 * cos(turn), -rad * 5.0 * sin(turn), rad * 6.0 * cos(turn),
            -rad * 6.0 * cos(turn));
  }
  assert_int_equal(fclose(f), 0);
  gait_summary(*state, "{\"verdict\": \"optimal\", " GAIT_STRIKES ", " GAIT_BODY "}");
  const char *band = scratch_path(state, "band.csv");
  f = fopen(band, "w");
  assert_non_null(f);
  fprintf(f, "variable,percent,mean_deg,sd_deg\n");
  for (int v = 0; v < 4; v++) {
    static const char *const names[] = {"pelvic_tilt", "pelvic_obliquity", "pelvic_rotation",
                                        "hip_rotation"};
    for (int p = 0; p <= 100; p += 2) {
      double turn = 0.02 * GAIT_PI * p;
      double value[] = {11.4 + 2.0 * cos(2.0 * turn), 4.0 * cos(turn), 5.0 * sin(turn),
                        6.0 * cos(turn)};
      fprintf(f, "%s,%d,%.12g,1\n", names[v], p, value[v]);
    }
  }
  assert_int_equal(fclose(f), 0);
  for (int foot = 0; foot < 3; foot++) {
    ambulo_compare_options options = ambulo_compare_options_default();
    ambulo_comparison *c = NULL;
    options.foot = foot == 0 ? NULL : foot == 1 ? "left" : "right";
    assert_int_equal(ambulo_compare(*state, band, &options, NULL, NULL, &c), AMBULO_OK);
    assert_int_equal(ambulo_comparison_curve_count(c), 4);
    for (int i = 0; i < 4; i++) {
      const ambulo_curve_score *score = ambulo_comparison_curve(c, i);
      if (!(score->rmse < 0.02)) print_error("%s: %g\n", score->name, score->rmse);
      assert_true(score->rmse < 0.02);
      assert_null(score->source);
    }
    ambulo_comparison_free(c);
  }
}

static void folder(void **state, int forces, const char *summary) {
  gait_motion(*state, 0.0, forces);
  gait_summary(*state, summary);
}

static void angles_of_one_loads_of_the_other(void **state) {
  ambulo_comparison *c = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  char *text = NULL;
  folder(state, 1, "{\"verdict\": \"optimal\", " GAIT_STRIKES ", " GAIT ", " GAIT_BODY "}");
  assert_int_equal(ambulo_compare_norms(*state, norms, NULL, NULL, list, &c), AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_count(list), 0);
  assert_int_equal(ambulo_comparison_curve_count(c), 5);
  for (int i = 0; i < 5; i++) {
    const ambulo_curve_score *score = ambulo_comparison_curve(c, i);
    int is_angle = strcmp(score->unit, "deg") == 0;
    assert_non_null(strstr(score->source, is_angle ? "Fukuchi" : "Winter"));
    assert_true(is_angle ? score->within_2sd >= 0.0 : isnan(score->within_2sd));
  }
  assert_int_equal(ambulo_comparison_landmark_count(c), 9);
  assert_int_equal(ambulo_comparison_json(c, NULL, &text), AMBULO_OK);
  assert_non_null(strstr(text, "\"source\": \"24 young adults"));
  ambulo_text_free(text, NULL);
  ambulo_comparison_free(c);
  /* torques without the ground's forces are left out */
  folder(state, 0, "{\"verdict\": \"optimal\", " GAIT_STRIKES ", " GAIT ", " GAIT_BODY "}");
  assert_int_equal(ambulo_compare_norms(*state, norms, NULL, NULL, list, &c), AMBULO_OK);
  assert_int_equal(ambulo_comparison_curve_count(c), 2);
  ambulo_comparison_free(c);
  ambulo_diagnostics_free(list);
}

static void only_walks(void **state) {
  static const struct {
    const char *summary, *message;
    ambulo_status status;
  } cases[] = {
      {"{\"strikes\": [], " GAIT_BODY "}", "no foot strikes in this motion", AMBULO_E_SCHEMA},
      {"{" GAIT_BODY "}", "expected a walk", AMBULO_E_SCHEMA},
      {"{" GAIT_STRIKES ", " GAIT_BODY "}", "warning: no 'gait' in this summary", AMBULO_OK}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo_comparison *c = NULL;
    folder(state, 1, cases[i].summary);
    assert_int_equal(ambulo_compare_norms(*state, norms, NULL, NULL, list, &c), cases[i].status);
    assert_message(list, 0, cases[i].message);
    ambulo_comparison_free(c);
    ambulo_diagnostics_free(list);
  }
}

static void refusals(void **state) {
  ambulo_compare_options options = ambulo_compare_options_default();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_comparison *c = NULL;
  folder(state, 1, "{" GAIT_STRIKES ", " GAIT ", " GAIT_BODY "}");
  assert_int_equal(ambulo_compare_norms(*state, "/no/such", NULL, NULL, list, &c), AMBULO_E_IO);
  assert_message(list, 0, "/no/such/young_adults.csv");
  options.curves = "grf_vertical,elbow";
  assert_int_equal(ambulo_compare_norms(*state, norms, &options, NULL, list, &c), AMBULO_E_SCHEMA);
  assert_message(list, 1, "no curve 'elbow'");
  assert_message(list, 1, "grf_vertical");
  options.map = "map.csv";
  assert_int_equal(ambulo_compare_norms(*state, norms, &options, NULL, NULL, &c),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_compare_norms(*state, NULL, NULL, NULL, NULL, &c), AMBULO_E_ARGUMENT);
  ambulo_diagnostics_free(list);
}

static void memory_runs_out(void **state) {
  folder(state, 1, "{" GAIT_STRIKES ", " GAIT ", " GAIT_BODY "}");
  for (long k = 0; k < 10000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_comparison *c = NULL;
    ambulo_status status = ambulo_compare_norms(*state, norms, NULL, &allocator, NULL, &c);
    if (status) assert_int_equal(status, AMBULO_E_MEMORY);
    ambulo_comparison_free(c);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) return;
  }
  fail();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(shipped_tables),
      cmocka_unit_test(credit),
      cmocka_unit_test_setup_teardown(signs_of_the_pelvis, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(angles_of_one_loads_of_the_other, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(only_walks, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(refusals, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(memory_runs_out, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_people", tests, NULL, NULL);
}
