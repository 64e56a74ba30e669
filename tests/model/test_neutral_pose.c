/* The neutral pose: places and axes known from the walker's construction. */
#include "model/neutral_pose.h"
#include "support/walker_fixture.h"

static void points_stand_where_built(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  static const struct {
    const char *name;
    double place[3];
  } expected[] = {{"r_heel", {-0.05, 0.0, 0.09}},
                  {"l_toe", {0.17, 0.0, -0.09}},
                  {"r_toe_out", {0.17, 0.0, 0.13}},
                  {"l_heel_in", {-0.05, 0.0, -0.13}}};
  for (int i = 0; i < 4; i++) {
    double r[3];
    ambulo__neutral_point(model, ambulo_model_find_point(model, expected[i].name), r);
    for (int axis = 0; axis < 3; axis++) assert_close(r[axis], expected[i].place[axis], 1e-15);
  }
  ambulo_model_free(model);
}

static void axes_point_as_named(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  static const double expected[5][3] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 1}};
  for (int i = 0; i < 5; i++) {
    double axis[3];
    ambulo__neutral_axis(model, i, axis);
    for (int k = 0; k < 3; k++) assert_close(axis[k], expected[i][k], 1e-15);
    assert_int_equal(ambulo__is_root_translation(model, i), i < 3);
  }
  ambulo_model_free(model);
}

static void planar_models_are_recognised(void **state) {
  (void)state;
  for (int planar = 0; planar < 2; planar++) {
    ambulo_model *model = walker_create(planar);
    assert_int_equal(ambulo__model_moves_sideways(model), !planar);
    assert_int_equal(ambulo__link_moves_sideways(model, model->link_count - 1), !planar);
    ambulo_model_free(model);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(points_stand_where_built),
                                     cmocka_unit_test(axes_point_as_named),
                                     cmocka_unit_test(planar_models_are_recognised)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
