/* The planar OpenSim model: sizes and signs, and that its published motion needs the published
 * ground forces. */
#include "mechanics/lagrangian.h"
#include "ambulo/tools/report.h"
#include "ambulo/tools/load.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "support/shared_data.h"

enum { COORDINATES = 10, POINTS = 4 };

static ambulo_model *load(void) {
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load(AMBULO_SOURCE_DIR "/models/opensim_2d_gait10.yaml", NULL, NULL,
                                     NULL, &model),
                   AMBULO_OK);
  assert_int_equal(ambulo_model_coordinate_count(model), COORDINATES);
  assert_int_equal(ambulo_model_point_count(model), POINTS);
  return model;
}

/* the heels at q, [2][3]: right, left */
static void heels(const ambulo_model *model, const double *q, double heel[2][3]) {
  static const double zero[COORDINATES];
  double points[POINTS][3];
  void *scratch = malloc(ambulo__lagrangian_scratch_size(model));
  assert_int_equal(
      ambulo__lagrangian(0, model, q, zero, zero,
                         &(ambulo_outputs){.size = sizeof(ambulo_outputs), .points = points[0]},
                         scratch),
      AMBULO_OK);
  free(scratch);
  memcpy(heel[0], points[ambulo_model_find_point(model, "heel_r")], sizeof heel[0]);
  memcpy(heel[1], points[ambulo_model_find_point(model, "heel_l")], sizeof heel[1]);
}

static void sizes_and_signs(void **state) {
  (void)state;
  ambulo_model *model = load();
  double q[COORDINATES] = {0}, standing[2][3], moved[2][3];
  assert_close(ambulo_model_mass(model), 62.0, 1e-5);
  heels(model, q, standing);
  /* hip, knee and ankle offsets of the file, then the heel below the ankle */
  double height = -0.0638354 - 0.3969072 - 0.4156948 - 0.0383391 + 0.0104358 - 0.035;
  double ahead = -0.0682778 - 0.0045122 - 0.0445721 + 0.0313075;
  for (int side = 0; side < 2; side++) {
    assert_close(standing[side][0], ahead, 1e-6);
    assert_close(standing[side][1], height, 1e-6);
  }
  q[ambulo_model_find_coordinate(model, "hip_flexion_r")] = 0.1;
  q[ambulo_model_find_coordinate(model, "knee_angle_l")] = -0.1;
  heels(model, q, moved);
  assert_true(moved[0][0] > standing[0][0] + 0.08);
  assert_true(moved[1][0] < standing[1][0] - 0.04);
  ambulo_model_free(model);
}

static void the_published_motion_needs_the_published_forces(void **state) {
  char motion[512], forces[512];
  ambulo_ground_residual r;
  if (!shared_data_path("opensim_moco_2dwalking_referenceCoordinates.sto", motion, sizeof motion) ||
      !shared_data_path("opensim_moco_2dwalking_referenceGRF.sto", forces, sizeof forces))
    skip();
  ambulo_model *model = load();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_inverse_options options = ambulo_inverse_options_default();
  ambulo_inverse_outputs outputs = ambulo_inverse_outputs_default();
  options.forces = forces;
  outputs.residual = &r;
  assert_int_equal(ambulo_inverse_dynamics_motion(model, motion, scratch_path(state, "out.csv"),
                                                  &options, NULL, list, &outputs),
                   AMBULO_OK);
  assert_message(list, 0, "have no points; they are applied at the zero-moment point");
  assert_message(list, 2, "note: left over at the root");
  assert_close(r.given_vertical_impulse, r.vertical_impulse, 1e-3);
  assert_true(r.force_rms[0] < 0.04);
  assert_true(r.force_rms[1] < 0.07);
  assert_close(r.force_rms[2], 0.0, 1e-9);
  assert_true(isnan(r.moment_rms));
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sizes_and_signs),
      cmocka_unit_test_setup_teardown(the_published_motion_needs_the_published_forces, scratch_open,
                                      scratch_close)};
  return cmocka_run_group_tests_name("models/opensim_gait", tests, NULL, NULL);
}
