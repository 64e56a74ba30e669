/* Joints that follow others, written for another program and read back: the same torques; and what
 * other programs cannot have. */
#include "support/import_case.h"

enum { most = 32 };

static void torques(const ambulo_model *model, const ambulo_model *names, double tau[most]) {
  const int d = ambulo_model_coordinate_count(names);
  double q[most], qd[most], qdd[most], out[most];
  int at[most];
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_model_coordinate_count(model), d);
  for (int i = 0; i < d; i++) {
    at[i] = ambulo_model_find_coordinate(model, ambulo_model_coordinate(names, i)->name);
    assert_true(at[i] >= 0);
    q[at[i]] = 0.4 * sin(1.0 + i);
    qd[at[i]] = 0.7 * cos(2.0 + i);
    qdd[at[i]] = 1.3 * sin(3.0 + 2.0 * i);
  }
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  ambulo_outputs outputs = {.size = sizeof outputs, .tau = out};
  assert_int_equal(ambulo_mechanics_inverse_dynamics(mechanics, 1, q, qd, qdd, &outputs),
                   AMBULO_OK);
  for (int i = 0; i < d; i++) tau[i] = out[at[i]];
  ambulo_mechanics_free(mechanics);
}

static void goes_round(void **state, const char *source, ambulo_export_format format,
                       const char *name) {
  import_case c = import_file(source, NULL);
  const char *file = scratch_path(state, name);
  ambulo_export_options options = ambulo_export_options_default();
  ambulo_import_options fixed = ambulo_import_options_default();
  double want[most], got[most];
  options.format = format;
  fixed.root = AMBULO_ROOT_FIXED;
  assert_int_equal(ambulo_export(c.model, NULL, file, &options, NULL, c.list), AMBULO_OK);
  import_case back = import_file(file, &fixed);
  assert_int_equal(back.status, AMBULO_OK);
  torques(c.model, c.model, want);
  torques(back.model, c.model, got);
  for (int i = 0; i < ambulo_model_coordinate_count(c.model); i++)
    assert_close(got[i], want[i], 1e-11);
  import_shut(&back);
  import_shut(&c);
}

static void open_sim(void **state) {
  goes_round(state, "tests/import/every_joint_v4.osim", AMBULO_EXPORT_OPENSIM, "a.osim");
  goes_round(state, "tests/import/coupled_joints.xml", AMBULO_EXPORT_OPENSIM, "b.osim");
}

static void urdf(void **state) {
  goes_round(state, "tests/import/every_joint.urdf", AMBULO_EXPORT_URDF, "a.urdf");
}

static void what_cannot_be_written(void **state) {
  import_case c = import_file("tests/import/coupled_joints.xml", NULL);
  const char *file = scratch_path(state, "c.urdf");
  ambulo_export_options options = ambulo_export_options_default();
  options.format = AMBULO_EXPORT_URDF;
  assert_int_equal(ambulo_export(c.model, NULL, file, &options, NULL, c.list), AMBULO_E_MODEL);
  assert_told(&c, "follows 'knee' by a curve; a URDF has straight lines alone");
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(open_sim), cmocka_unit_test(urdf),
                                     cmocka_unit_test(what_cannot_be_written)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
