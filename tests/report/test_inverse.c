/* Inverse dynamics of a motion file: a swinging arm whose torques are known. */
#include "support/arm.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "support/walker_result.h"
#include "trajectory/motion_file.h"

/* quintic in time: the interpolating spline of degree 5 reproduces it and its rates */
static double shoulder(double t) {
  return 0.3 + t - 0.5 * t * t * t;
}
static double elbow(double t) {
  return -0.2 + 0.7 * t * t;
}

static void write_motion(const char *path, const char *header, int rows, double unit) {
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, "%s\n", header);
  for (int k = 0; k < rows; k++) {
    double t = 0.1 * k;
    fprintf(file, "%.17g,%.17g,%.17g\n", t, unit * shoulder(t), unit * elbow(t));
  }
  fclose(file);
}

static double cell(const ambulo__motion *m, int row, const char *name) {
  int column = ambulo__motion_column(m, name);
  if (column < 0) print_error("no column %s\n", name);
  assert_true(column >= 0);
  return m->values[row * m->columns + column];
}

static void check_torques(const ambulo_model *model, const char *text) {
  ambulo__motion *m = NULL;
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(
      ambulo__motion_read_text(text, strlen(text), "result", AMBULO__MOTION_CSV, NULL, NULL, &m),
      AMBULO_OK);
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(m->rows, 9);
  for (int k = 0; k < m->rows; k++) {
    double t = 0.1 * k, tau[2];
    double q[2] = {shoulder(t), elbow(t)}, qd[2] = {1.0 - 1.5 * t * t, 1.4 * t};
    double qdd[2] = {-3.0 * t, 1.4};
    assert_int_equal(ambulo_mechanics_inverse_dynamics(mechanics, 1, q, qd, qdd, tau, NULL, NULL),
                     0);
    assert_close(cell(m, k, "q.shoulder"), q[0], 1e-13);
    assert_close(cell(m, k, "qd.shoulder"), qd[0], 1e-10);
    assert_close(cell(m, k, "qdd.elbow"), qdd[1], 1e-8);
    assert_close(cell(m, k, "tau.shoulder"), tau[0], 1e-8);
    assert_close(cell(m, k, "tau.elbow"), tau[1], 1e-8);
  }
  ambulo_mechanics_free(mechanics);
  ambulo__motion_free(m);
}

static void test_torques(void **state) {
  ambulo_model *model = arm_create();
  const char *motion = scratch_path(state, "motion.csv"), *output = scratch_path(state, "out.csv");
  char *text = NULL;
  write_motion(motion, "time,shoulder,q.elbow", 9, 1.0);
  assert_int_equal(ambulo_inverse_dynamics_file(model, motion, NULL, NULL, NULL, &text), AMBULO_OK);
  check_torques(model, text);
  assert_int_equal(ambulo_inverse_dynamics_file(model, motion, output, NULL, NULL, NULL),
                   AMBULO_OK);
  char *written = read_text(output);
  assert_string_equal(written, text);
  ambulo_text_free(text, NULL);
  text = NULL;
  write_motion(motion, "# inDegrees=yes\ntime,shoulder,elbow", 9, 57.295779513082321);
  assert_int_equal(ambulo_inverse_dynamics_file(model, motion, NULL, NULL, NULL, &text), AMBULO_OK);
  check_torques(model, text);
  ambulo_text_free(text, NULL);
  free(written);
  ambulo_model_free(model);
}

static void test_missing_columns(void **state) {
  ambulo_model *model = arm_create();
  const char *motion = scratch_path(state, "motion.csv");
  char *text = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  write_motion(motion, "time,shoulder,wrist", 9, 1.0);
  assert_int_equal(ambulo_inverse_dynamics_file(model, motion, NULL, NULL, list, &text), AMBULO_OK);
  assert_message(list, 0, "warning");
  assert_message(list, 0, "'elbow'");
  ambulo_text_free(text, NULL);
  text = NULL;
  ambulo_diagnostics_clear(list);
  write_motion(motion, "time,ankle,wrist", 9, 1.0);
  assert_int_equal(ambulo_inverse_dynamics_file(model, motion, NULL, NULL, list, &text),
                   AMBULO_E_SCHEMA);
  assert_message(list, 0, "shoulder");
  ambulo_diagnostics_clear(list);
  write_motion(motion, "time,shoulder,elbow", 3, 1.0);
  assert_int_equal(ambulo_inverse_dynamics_file(model, motion, NULL, NULL, list, &text),
                   AMBULO_E_SCHEMA);
  assert_message(list, 0, "at least 4");
  assert_null(text);
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

static void test_full_device(void **state) {
  ambulo_model *model = arm_create();
  const char *motion = scratch_path(state, "motion.csv");
  write_motion(motion, "time,shoulder,elbow", 9, 1.0);
  assert_int_equal(ambulo_inverse_dynamics_file(model, motion, "/dev/full", NULL, NULL, NULL),
                   AMBULO_E_IO);
  ambulo_model_free(model);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(test_torques), SCRATCH_TEST(test_missing_columns),
                                     SCRATCH_TEST(test_full_device)};
  return cmocka_run_group_tests_name("report/inverse", tests, NULL, NULL);
}
