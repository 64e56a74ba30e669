/* Places and slopes along a path against matrices from the world on. */
#include "contact/device_path.h"
#include "device_fixture.h"
#include "mechanics/pose.h"

/* from the world: all that carries the link */
static void check_path(const ambulo_model *m, int link, const double local[3], const double *lanes,
                       const double *q) {
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  ambulo__device_path path;
  ambulo__pose pose;
  double point[3], world[3], axis[3 * most_coordinates], slope[3 * most_coordinates];
  assert_int_equal(ambulo__path_create(m, -1, link, local, &a, &path), AMBULO_OK);
  assert_int_equal(ambulo__pose_create(m, NULL, &pose), AMBULO_OK);
  ambulo__pose_at(&pose, q);
  ambulo__pose_point(&pose, link, local, world);
  ambulo__path_point(&path, lanes, point, axis, slope);
  for (int k = 0; k < 3; k++) assert_close(point[k], world[k], 1e-12);
  for (int i = 0; i < path.count; i++) {
    number z[most_coordinates], moved[3];
    for (int k = 0; k < m->coordinate_count; k++) z[k] = q[k];
    z[path.joints[i].coordinate] += 1e-40 * I;
    reference_point(m, link, local, z, moved);
    for (int k = 0; k < 3; k++) assert_close(slope[3 * i + k], cimag(moved[k]) / 1e-40, 1e-11);
  }
  ambulo__pose_free(&pose);
  ambulo__path_free(&a, &path);
}

static void test_points_and_slopes(void **state) {
  (void)state;
  for (int index = 0; index < 60; index++) {
    device_case c;
    device_case_open(&c, index);
    double q[most_coordinates], local[3] = {0.1, -0.2, 0.3};
    for (int i = 0; i < c.d; i++) q[i] = c.q[i * AMBULO__LANES];
    for (int link = 0; link < c.model->link_count; link += 3)
      check_path(c.model, link, local, c.q, q);
    device_case_close(&c);
  }
}

static void test_the_deepest_link_in_common(void **state) {
  (void)state;
  device_case c;
  device_case_open(&c, 33);
  const ambulo_model *m = c.model;
  for (int a = 0; a < m->link_count; a++) {
    for (int b = 0; b < m->link_count; b++) {
      const int pair[2] = {a, b};
      int common = ambulo__path_common(m, pair), i = a, j = b;
      while (i >= 0 && i != common) i = m->links[i].parent;
      while (j >= 0 && j != common) j = m->links[j].parent;
      assert_int_equal(i, common);
      assert_int_equal(j, common);
      if (a == b) assert_int_equal(common, a);
    }
  }
  device_case_close(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_points_and_slopes),
                                     cmocka_unit_test(test_the_deepest_link_in_common)};
  return cmocka_run_group_tests_name("device/path", tests, NULL, NULL);
}
