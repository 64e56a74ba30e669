/* Forward kinematics of points against those of the dynamics. */
#include "mechanics/pose.h"
#include "support/fail_alloc.h"
#include "support/walker_result.h"

static void test_points_agree_with_the_mechanics(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  ambulo_mechanics *mechanics = NULL;
  assert_int_equal(ambulo_mechanics_create(model, NULL, &mechanics), AMBULO_OK);
  ambulo__pose pose;
  assert_int_equal(ambulo__pose_create(model, NULL, &pose), AMBULO_OK);
  double q[WALKER_COORDINATES], zero[WALKER_COORDINATES] = {0.0}, points[3 * WALKER_POINTS];
  for (int i = 0; i < WALKER_COORDINATES; i++) q[i] = sin(1.0 + 1.3 * i);
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       mechanics, 1, q, zero, zero,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .points = points}),
                   AMBULO_OK);
  ambulo__pose_at(&pose, q);
  for (int p = 0; p < WALKER_POINTS; p++) {
    const ambulo_point *point = ambulo_model_point(model, p);
    double world[3];
    ambulo__pose_point(&pose, point->link, point->position, world);
    for (int k = 0; k < 3; k++) assert_close(world[k], points[3 * p + k], 1e-13);
  }
  ambulo__pose_free(&pose);
  ambulo_mechanics_free(mechanics);
  ambulo_model_free(model);
}

static void test_a_point_of_the_world_stays(void **state) {
  (void)state;
  const ambulo__pose nothing = {.model = NULL};
  const double place[3] = {1.0, -2.0, 3.0};
  double world[3];
  ambulo__pose_point(&nothing, -1, place, world);
  for (int k = 0; k < 3; k++) assert_close(world[k], place[k], 0.0);
}

static void test_memory_may_fail(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  ambulo__pose pose = {.model = NULL};
  fail_alloc memory = fail_alloc_at(0);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  assert_int_equal(ambulo__pose_create(model, &allocator, &pose), AMBULO_E_MEMORY);
  assert_null(pose.model);
  assert_int_equal(memory.live, 0);
  ambulo__pose_free(&pose);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_points_agree_with_the_mechanics),
                                     cmocka_unit_test(test_a_point_of_the_world_stays),
                                     cmocka_unit_test(test_memory_may_fail)};
  return cmocka_run_group_tests_name("mechanics/pose", tests, NULL, NULL);
}
