/* Reference curves: the three layouts by their headers, deviations, faults with their place. */
#include "ambulo/tools/report.h"
#include "people/compare.h"
#include "support/fail_alloc.h"
#include "support/gait_folder.h"
#include "support/messages.h"
#include "support/scratch.h"

typedef struct reading {
  ambulo__sheet sheet;
  ambulo__map map;
  ambulo__reference reference;
  ambulo__reference_layout layout;
  int header;
} reading;

static ambulo_status open_text(void **state, const char *text, ambulo_diagnostics *list,
                               reading *r) {
  const char *path = scratch_path(state, "reference.csv");
  memset(r, 0, sizeof *r);
  scratch_write(path, text);
  assert_int_equal(ambulo__sheet_read(path, NULL, list, &r->sheet), AMBULO_OK);
  ambulo_status status = ambulo__reference_layout_of(&r->sheet, list, &r->layout, &r->header);
  if (!status) status = ambulo__map_default(r->layout, NULL, &r->map);
  if (status) return status;
  return ambulo__reference_curves(&r->sheet, r->layout, r->header, &r->map, list, &r->reference);
}

static void close_text(reading *r) {
  ambulo__reference_free(&r->reference);
  ambulo__map_free(&r->map);
  ambulo__sheet_free(&r->sheet);
}

static void band(void **state) {
  reading r;
  assert_int_equal(open_text(state,
                             "variable,percent,mean_deg,sd_deg\n"
                             "elbow,0,1,1\n"
                             "knee_flexion,0,5,1\nknee_flexion,50,10,2\nknee_flexion,100,6,3\n",
                             NULL, &r),
                   AMBULO_OK);
  assert_int_equal(r.layout, AMBULO__LAYOUT_BAND);
  assert_int_equal(r.reference.count, 1);
  const ambulo__reference_curve *c = &r.reference.curves[0];
  assert_string_equal(c->entry->curve, "knee_flexion");
  assert_int_equal(c->points, 3);
  assert_close(c->percent[1], 50.0, 0.0);
  assert_close(c->mean[1], 10.0, 0.0);
  assert_close(c->sd[2], 3.0, 0.0);
  close_text(&r);
}

static void quantity(void **state) {
  reading r;
  assert_int_equal(open_text(state,
                             "quantity,variable,percent,mean,sd\n"
                             "power_w_per_kg,hip,0,1,1\n"
                             "angle_deg,hip_flexion,0,1,1\nangle_deg,hip_flexion,1,2,1\n"
                             "angle_deg,hip_flexion,2,3,1\n"
                             "moment_nm_per_kg,knee_extension,0,.1,1\n"
                             "moment_nm_per_kg,knee_extension,1,.2,1\n"
                             "moment_nm_per_kg,knee_extension,2,.3,1\n",
                             NULL, &r),
                   AMBULO_E_SCHEMA);
  close_text(&r);
  assert_int_equal(open_text(state,
                             "quantity,variable,percent,mean,sd\n"
                             "angle_deg,hip_flexion,0,1,1\nangle_deg,hip_flexion,1,2,1\n"
                             "angle_deg,hip_flexion,2,3,1\n"
                             "moment_nm_per_kg,knee_extension,0,.1,1\n"
                             "moment_nm_per_kg,knee_extension,1,.2,1\n"
                             "moment_nm_per_kg,knee_extension,2,.3,1\n",
                             NULL, &r),
                   AMBULO_OK);
  assert_int_equal(r.reference.count, 2);
  assert_string_equal(r.reference.curves[1].entry->curve, "knee_extension_moment");
  assert_close(r.reference.curves[1].mean[2], 0.3, 0.0);
  close_text(&r);
}

/* three lines of text, a blank one, two header lines and a byte-order mark */
static void wide(void **state) {
  reading r;
  assert_int_equal(open_text(state,
                             "\xEF\xBB\xBFSome title,,,,,,,\nDuration:,,1.1,s.,,,,\n"
                             "Speed: ,,1.3,s.,,,,\n,,,,,,,\n"
                             "sample,%gait cycle,,,hip angle    ,knee angle    ,vertical GRF,x\n"
                             ",,,,(deg),(deg),(N/kg),\n"
                             "1,0.00,,,19,3,0.6,\n2,2.00,,,18,7,2.9,\n3,4.00,,,17,10,5.3,\n",
                             NULL, &r),
                   AMBULO_OK);
  assert_int_equal(r.layout, AMBULO__LAYOUT_WIDE);
  assert_int_equal(r.reference.count, 3);
  const ambulo__reference_curve *force = &r.reference.curves[2];
  assert_string_equal(force->entry->curve, "grf_vertical");
  assert_int_equal(force->points, 3);
  assert_null(force->sd);
  assert_close(force->mean[2], 5.3, 0.0);
  assert_close(force->percent[2], 4.0, 0.0);
  close_text(&r);
}

static void wide_with_deviations(void **state) {
  reading r;
  assert_int_equal(open_text(state,
                             "percent,knee angle,knee angle sd\n0,1,0.5\n50,2,0.6\n100,1,0.7\n",
                             NULL, &r),
                   AMBULO_OK);
  assert_non_null(r.reference.curves[0].sd);
  assert_close(r.reference.curves[0].sd[1], 0.6, 0.0);
  close_text(&r);
}

static void faults(void **state) {
#define BAND "variable,percent,mean_deg,sd_deg\nknee_flexion,0,1,1\n"
  static const char *const cases[][2] = {
      {"time,x\n0,1\n", "reference.csv:1:1: error[E_SCHEMA]: no header of a known layout"},
      {BAND "knee_flexion,2,x,1\n", "reference.csv:3:16: error[E_SCHEMA]: the mean is 'x'"},
      {BAND "knee_flexion,2,1\n", "reference.csv:3:1: error[E_SCHEMA]: the deviation is ''"},
      {BAND "knee_flexion,0,1,1\n", "reference.csv:3:14: error[E_SCHEMA]: percent 0"},
      {BAND "knee_flexion,101,1,1\n", "percent 101"},
      {BAND "knee_flexion,2,1,-1\n", "the deviation is -1"},
      {BAND "knee_flexion,2,1,1\n", "'knee_flexion' has 2 points; expected at least 3"},
      {"variable,percent,mean_deg,sd_deg\nelbow,0,1,1\n", "no curve of the column map"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    reading r;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    assert_int_equal(open_text(state, cases[i][0], list, &r), AMBULO_E_SCHEMA);
    assert_message(list, 0, cases[i][1]);
    close_text(&r);
    ambulo_diagnostics_free(list);
  }
}

static int test_compare_reference_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(band, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(quantity, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(wide, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(wide_with_deviations, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(faults, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_reference", tests, NULL, NULL);
}

/* The shipped curves of people: what is read of them, their signs, and of which motions they are.
 */

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

static int test_compare_people_tests(void) {
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

int main(void) {
  return test_compare_reference_tests() + test_compare_people_tests();
}
