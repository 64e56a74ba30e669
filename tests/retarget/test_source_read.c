/* Tables of angles: units, parts, gaps, other bodies' columns. */
#include "retarget/source.h"

#include "model/model.h"
#include "support/given_motion.h"
#include "support/messages.h"
#include "support/scratch.h"

static void parts_and_units(void **state) {
  const char *path = scratch_path(state, "squat.csv");
  person p = person_open(person_file, 0.0);
  ambulo_retarget_options options = ambulo_retarget_options_default();
  ambulo__given given;
  write_squat(path, 41);
  options.body = p.model;
  options.from = 0.5;
  options.to = 1.5;
  assert_int_equal(ambulo__given_read(path, &options, NULL, NULL, &given), AMBULO_OK);
  assert_int_equal(given.rows, 21);
  assert_close(given.time[0], 0.0, 1e-12);
  assert_close(given.time[20], 1.0, 1e-12);
  int knee = ambulo_model_find_coordinate(p.model, "knee_angle_r");
  assert_close(given.q[10 * p.model->coordinate_count + knee], acos(-1.0) / 3.0, 1e-6);
  ambulo__given_free(&given);
  person_close(&p);
}

static void faults(void **state) {
  const char *path = scratch_path(state, "bad.csv");
  person p = person_open(person_file, 0.0);
  ambulo_retarget_options options = ambulo_retarget_options_default();
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  ambulo__given given;
  write_squat(path, 41);
  assert_int_equal(ambulo__given_read(path, &options, NULL, messages, &given), AMBULO_E_ARGUMENT);
  options.body = p.model;
  options.to = 0.1;
  assert_int_equal(ambulo__given_read(path, &options, NULL, messages, &given), AMBULO_E_SCHEMA);
  assert_message(messages, 1, "3 rows are left of the motion; expected at least 8");
  options.to = INFINITY;
  scratch_write(path, "time,elbow\n0,1\n1,2\n");
  assert_int_equal(ambulo__given_read(path, &options, NULL, messages, &given), AMBULO_E_SCHEMA);
  assert_message(messages, 2, "no column is named after a coordinate of model");
  scratch_write(path, "time,knee_angle_r\n0,0\n1,0\n2,0\n3,0\n4,nan\n5,0\n6,0\n7,0\n8,0\n");
  assert_int_equal(ambulo__given_read(path, &options, NULL, messages, &given), AMBULO_E_SCHEMA);
  assert_message(messages, 3, "'knee_angle_r' has no value at 4 s");
  ambulo_diagnostics_free(messages);
  person_close(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(parts_and_units), cmocka_unit_test(faults)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
