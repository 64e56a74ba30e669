/* Reference curves: the three layouts by their headers, deviations, faults with their place. */
#include "people/compare_reference.h"
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(band, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(quantity, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(wide, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(wide_with_deviations, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(faults, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_reference", tests, NULL, NULL);
}
