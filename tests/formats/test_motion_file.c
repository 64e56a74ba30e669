/* Motion tables from files: names, units, a published motion. */
#include "formats/motion_columns.h"
#include "support/messages.h"
#include "support/scratch.h"

static void columns_are_found_by_name(void **state) {
  (void)state;
  const char *names[4] = {"q.hip_flexion_r", "/jointset/knee_r/knee_angle_r/value",
                          "/jointset/knee_r/knee_angle_r/speed", "hip_flexion_l"};
  ambulo__motion *motion = NULL;
  assert_int_equal(ambulo__motion_create(1, 4, names, NULL, &motion), AMBULO_OK);
  assert_int_equal(ambulo__motion_column(motion, "hip_flexion_l"), 3);
  assert_int_equal(ambulo__motion_column(motion, "hip_flexion_r"), -1);
  ambulo__motion_free(motion);
  ambulo__motion_free(NULL);
}

static void only_angles_are_converted_and_only_once(void **state) {
  (void)state;
  const char *names[2] = {"tilt", "tx"};
  const unsigned char is_angle[2] = {1, 0};
  ambulo__motion *motion = NULL;
  assert_int_equal(ambulo__motion_create(1, 2, names, NULL, &motion), AMBULO_OK);
  motion->values[0] = motion->values[1] = 180.0;
  ambulo__motion_to_radians(motion, is_angle);
  assert_true(motion->values[0] == 180.0);
  motion->in_degrees = 1;
  ambulo__motion_to_radians(motion, is_angle);
  ambulo__motion_to_radians(motion, is_angle);
  assert_close(motion->values[0], 3.14159265358979312, 1e-15);
  assert_true(motion->values[1] == 180.0);
  assert_int_equal(motion->in_degrees, 0);
  ambulo__motion_free(motion);
}

static void endings_tell_the_format(void **state) {
  (void)state;
  assert_int_equal(ambulo__motion_format_of("a.b/run.CSV"), AMBULO__MOTION_CSV);
  assert_int_equal(ambulo__motion_format_of("run.sto"), AMBULO__MOTION_STO);
  assert_int_equal(ambulo__motion_format_of("run.mot"), AMBULO__MOTION_STO);
  assert_int_equal(ambulo__motion_format_of("run.txt"), AMBULO__MOTION_AUTO);
  assert_int_equal(ambulo__motion_format_of("run"), AMBULO__MOTION_AUTO);
}

static void files_are_read_and_faults_name_them(void **state) {
  const char *path = scratch_path(state, "walk.csv");
  scratch_write(path, "time,q\n0,1\n0.5,2\n");
  ambulo__motion *motion = NULL;
  assert_int_equal(ambulo__motion_read(path, NULL, NULL, &motion), AMBULO_OK);
  assert_int_equal(motion->rows, 2);
  ambulo__motion_free(motion);
  motion = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  scratch_write(path, "time,q\n0,one\n");
  assert_int_equal(ambulo__motion_read(path, NULL, list, &motion), AMBULO_E_SCHEMA);
  assert_message(list, 0, "walk.csv:2:3: ");
  path = scratch_path(state, "missing.sto");
  assert_int_equal(ambulo__motion_read(path, NULL, list, &motion), AMBULO_E_IO);
  assert_message(list, 1, "missing.sto: error[E_IO]");
  assert_null(motion);
  ambulo_diagnostics_free(list);
}

static void sparse_files_beyond_64_mebibytes_are_refused(void **state) {
  const char *path = scratch_path(state, "large.csv");
  scratch_write(path, "");
  assert_int_equal(truncate(path, (off_t)AMBULO__MOTION_MAX_BYTES + 1), 0);
  ambulo__motion *motion = NULL;
  assert_int_equal(ambulo__motion_read(path, NULL, NULL, &motion), AMBULO_E_LIMIT);
}

/* measured walking: skipped where the reference data are not at hand */
static void a_published_opensim_motion_is_read(void **state) {
  (void)state;
  const char *folder = getenv("AMBULO_SHARED_DATA"), *source = getenv("AMBULO_SOURCE_DIR");
  char path[SCRATCH_PATH];
  if (folder) {
    snprintf(path, sizeof path, "%s/opensim_moco_2dwalking_referenceCoordinates.sto", folder);
  } else {
    snprintf(path, sizeof path, "%s/../shared/data/opensim_moco_2dwalking_referenceCoordinates.sto",
             source ? source : ".");
  }
  if (access(path, R_OK) != 0) skip();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__motion *motion = NULL;
  ambulo_status status = ambulo__motion_read(path, NULL, list, &motion);
  if (status) assert_message(list, 0, "(no message)");
  assert_int_equal(motion->rows, 50);
  assert_int_equal(motion->columns, 10);
  assert_int_equal(motion->in_degrees, 0);
  int height = ambulo__motion_column(motion, "/jointset/groundPelvis/pelvis_ty/value");
  assert_int_equal(height, 2);
  assert_true(motion->values[height] == 0.88365423);
  assert_true(motion->time[1] == 0.00959366);
  int knee = -1;
  assert_int_equal(
      ambulo__motion_find(motion, path, "knee_angle_r", AMBULO__ORDER_VALUE, list, &knee),
      AMBULO_OK);
  assert_int_equal(knee, 6);
  ambulo__motion_free(motion);
  ambulo_diagnostics_free(list);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(columns_are_found_by_name),
      cmocka_unit_test(only_angles_are_converted_and_only_once),
      cmocka_unit_test(endings_tell_the_format),
      cmocka_unit_test_setup_teardown(files_are_read_and_faults_name_them, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(sparse_files_beyond_64_mebibytes_are_refused, scratch_open,
                                      scratch_close),
      cmocka_unit_test(a_published_opensim_motion_is_read),
  };
  return cmocka_run_group_tests_name("format/motion_file", tests, NULL, NULL);
}
