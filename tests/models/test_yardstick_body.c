/* The yardstick body against numbers of an independent formulation, and its layout. */
#include "mechanics/lagrangian.h"
#include "ambulo/tools/tools.h"
#include "models/yardstick_reference.h"
#include "support/test.h"

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

static const double MASS = 69.6, WEIGHT = 69.6 * 9.81; /* kg, N */

static ambulo_model *load(void) {
  ambulo_model *model = NULL;
  const char *path = AMBULO_SOURCE_DIR "/models/yardstick_body.yaml";
  assert_int_equal(ambulo_model_load(path, NULL, NULL, NULL, &model), AMBULO_OK);
  return model;
}

static void layout(void **state) {
  (void)state;
  static const char *const names[] = {
      "pelvis_tx",   "pelvis_ty",     "pelvis_tz",       "pelvis_yaw",      "pelvis_pitch",
      "pelvis_roll", "hip_flexion_l", "hip_abduction_l", "hip_rotation_l",  "knee_l",
      "ankle_l",     "inversion_l",   "hip_flexion_r",   "hip_abduction_r", "hip_rotation_r",
      "knee_r",      "ankle_r",       "inversion_r"};
  static const double low[] = {-1.5, -.3, -.25, -.35, -.35, -.35, -.6, -.5, -.6, 0., -.9, -.5};
  static const double high[] = {4.0, .3, .10, .35, .35, .35, 1.6, .5, .6, 2.2, .6, .5};
  ambulo_model *model = load();
  assert_int_equal(ambulo_model_coordinate_count(model), YARDSTICK_COORDINATES);
  for (int i = 0; i < YARDSTICK_COORDINATES; i++) {
    const ambulo_coordinate *q = ambulo_model_coordinate(model, i);
    int k = i < 12 ? i : i - 6;
    assert_string_equal(q->name, names[i]);
    assert_true(q->range[0] == low[k] && q->range[1] == high[k]);
    assert_int_equal(q->actuated, i >= 6);
    assert_int_equal(q->mirror, i < 6 ? i : i < 12 ? i + 6 : i - 6);
    assert_true(q->mirror_sign == (i == 1 || i == 3 || i == 5 ? -1 : 1));
  }
  assert_close(ambulo_model_mass(model), MASS, 1e-15);
  assert_close(ambulo_model_up(model)[2], 1, 0);
  assert_close(ambulo_model_left(model)[1], 1, 0);
  for (int f = 0; f < 2; f++) {
    const ambulo_foot *foot = ambulo_model_foot(model, f);
    assert_string_equal(foot->name, f ? "right" : "left");
    assert_int_equal(foot->heel[0], 4 * f);
    assert_int_equal(foot->heel[1], 4 * f + 1);
    assert_int_equal(foot->toe[0], 4 * f + 2);
    assert_int_equal(foot->toe[1], 4 * f + 3);
    assert_int_equal(foot->heel_center, 8 + 2 * f);
    assert_int_equal(foot->toe_center, 9 + 2 * f);
    assert_int_equal(foot->mirror, 1 - f);
  }
  ambulo_model_free(model);
}

static void outputs(const ambulo_model *model, int k, double out[YARDSTICK_OUTPUTS]) {
  double tau[YARDSTICK_COORDINATES], wrench[6];
  int count = ambulo_model_point_count(model);
  double(*points)[3] = malloc((size_t)count * sizeof *points);
  void *scratch = malloc(ambulo__lagrangian_scratch_size(model));
  assert_int_equal(ambulo__lagrangian(0, model, yardstick_q[k], yardstick_qd[k], yardstick_qdd[k],
                                      &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                        .tau = tau,
                                                        .wrench = wrench,
                                                        .points = points[0]},
                                      scratch),
                   AMBULO_OK);
  for (int i = 0; i < 18; i++) {
    out[i] = i < 3 ? 0.05 * (tau[i] - (i == 2 ? WEIGHT : 0)) : tau[i];
  }
  for (int i = 0; i < 8; i++) out[18 + i] = points[i][2];
  for (int i = 0; i < 8; i++) out[26 + i] = points[8 + i / 2][i % 2];
  out[34] = -wrench[1] / WEIGHT;
  out[35] = wrench[0] / WEIGHT;
  out[36] = wrench[5] / WEIGHT;
  free(points);
  free(scratch);
}

static void reference(void **state) {
  (void)state;
  ambulo_model *model = load();
  for (int k = 0; k < YARDSTICK_STATES; k++) {
    double out[YARDSTICK_OUTPUTS];
    outputs(model, k, out);
    for (int i = 0; i < YARDSTICK_OUTPUTS; i++) {
      if (fabs(out[i] - yardstick_outputs[k][i]) > 1e-12 * fmax(1, fabs(yardstick_outputs[k][i])))
        print_error("state %d, output %d:\n", k, i);
      assert_close(out[i], yardstick_outputs[k][i], 1e-12);
    }
  }
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(layout), cmocka_unit_test(reference)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
