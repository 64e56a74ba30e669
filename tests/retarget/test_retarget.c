/* The folder of a task: its problem loads, its map reads back, what is there is not written over;
 * and how a result is judged. */
#include "ambulo/tools/tools.h"

#include "support/given_motion.h"
#include "support/messages.h"
#include "support/scratch.h"

static ambulo_status write_task(void **state, const person *p, const char *map, int overwrite,
                                ambulo_diagnostics *messages) {
  const char *motion = scratch_path(state, "squat.csv");
  ambulo_retarget_options options = ambulo_retarget_options_default();
  write_squat(motion, 41);
  options.body = p->model;
  options.map = map;
  options.overwrite = overwrite;
  return ambulo_retarget_write(motion, person_file, scratch_path(state, "task"), &options, NULL,
                               messages);
}

static void problem_loads(void **state) {
  person p = person_open(person_file, 0.0);
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  char *text = NULL;
  assert_int_equal(write_task(state, &p, NULL, 0, NULL), AMBULO_OK);
  assert_int_equal(
      ambulo_problem_load(scratch_path(state, "task/problem.yaml"), NULL, 0, NULL, NULL, &problem),
      AMBULO_OK);
  assert_close(ambulo_problem_duration(problem), 2.0, 1e-9);
  /* at rest in the start pose it is as far from the motion as that bends its knees */
  double *x = calloc((size_t)ambulo_problem_variable_count(problem), sizeof *x);
  assert_int_equal(ambulo_audit_point(problem, NULL, x, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_retarget_report(problem, result, NULL, &text), AMBULO_OK);
  assert_non_null(strstr(text, "knee_angle_r"));
  double rms = atof(strstr(text, "knee_angle_r") + strlen("knee_angle_r"));
  assert_close(rms, 30.0 * sqrt(1.5), 0.01); /* of 30 (1 - cos) */
  assert_non_null(strstr(text, "degrees rms; worst 36.7"));
  assert_non_null(strstr(text, "feet slip by up to"));
  ambulo_text_free(text, NULL);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  free(x);
  person_close(&p);
}

static void map_reads_back(void **state) {
  person p = person_open(person_file, 0.0);
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  assert_int_equal(write_task(state, &p, NULL, 1, NULL), AMBULO_OK);
  char *first = read_whole(scratch_path(state, "task/map.yaml"));
  const char *copy = scratch_path(state, "map.yaml");
  scratch_write(copy, first);
  assert_int_equal(write_task(state, &p, copy, 1, NULL), AMBULO_OK);
  char *second = read_whole(scratch_path(state, "task/map.yaml"));
  assert_string_equal(first, second);
  scratch_write(copy, "target: {torso: [spine]}\nsauce: {}\n");
  assert_int_equal(write_task(state, &p, copy, 1, messages), AMBULO_E_SCHEMA);
  assert_message(messages, 0, "map.yaml:2:1");
  free(first);
  free(second);
  ambulo_diagnostics_free(messages);
  person_close(&p);
}

static void nothing_is_written_over(void **state) {
  person p = person_open(person_file, 0.0);
  assert_int_equal(write_task(state, &p, NULL, 1, NULL), AMBULO_OK);
  assert_int_equal(write_task(state, &p, NULL, 0, NULL), AMBULO_E_IO);
  scratch_write(scratch_path(state, "task/mine.txt"), "mine");
  assert_int_equal(write_task(state, &p, NULL, 1, NULL), AMBULO_E_IO);
  assert_file_equal(scratch_path(state, "task/mine.txt"), "mine");
  assert_int_equal(unlink(scratch_path(state, "task/mine.txt")), 0);
  person_close(&p);
}

static void arguments(void **state) {
  (void)state;
  assert_int_equal(ambulo_retarget_write(NULL, "m.yaml", "d", NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_retarget_report(NULL, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(problem_loads), cmocka_unit_test(map_reads_back),
      cmocka_unit_test(nothing_is_written_over), cmocka_unit_test(arguments)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
