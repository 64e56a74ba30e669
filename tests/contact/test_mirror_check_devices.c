/* Devices and their mirror images. */
#include "ambulo/tools/load.h"
#include "contact/devices.h"
#include "contact/row_families.h"
#include "model/model.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/planar_walker.h"
#include "support/test.h"

/* Mirror images of devices: twice is once, places are reflections, and what has none is refused. */

static ambulo_model *person(void) {
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_21.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  return model;
}

static ambulo_device between(const ambulo_model *m, const char *a, const char *b) {
  static const double places[2][3] = {{0.02, -0.1, 0.03}, {-0.04, 0.05, 0.01}};
  ambulo_device v = ambulo_device_default(AMBULO_DEVICE_SPRING);
  v.name = "band";
  v.stiffness = 90;
  v.rest = 0.3;
  v.link[0] = ambulo_model_find_link(m, a);
  v.link[1] = ambulo_model_find_link(m, b);
  memcpy(v.position, places, sizeof places);
  return v;
}

static void test_twice_is_once(void **state) {
  (void)state;
  ambulo_model *m = person();
  const ambulo_device one = between(m, "shank_r", "thorax");
  ambulo_device image = ambulo__device_mirrored(m, &one);
  ambulo_device back = ambulo__device_mirrored(m, &image);
  assert_string_equal(m->links[image.link[0]].name, "shank_l");
  assert_string_equal(m->links[image.link[1]].name, "thorax");
  for (int end = 0; end < 2; end++) {
    assert_int_equal(back.link[end], one.link[end]);
    for (int k = 0; k < 3; k++) assert_close(back.position[end][k], one.position[end][k], 1e-14);
    assert_true(ambulo__places_mirror(m, one.link[end], one.position[end], image.link[end],
                                      image.position[end]));
  }
  assert_true(
      !ambulo__places_mirror(m, one.link[0], one.position[0], one.link[0], one.position[0]));
  ambulo_model_free(m);
}

/* what bends to the left bends to the right */
static void test_a_turned_coordinate(void **state) {
  (void)state;
  ambulo_model *m = person();
  ambulo_device v = ambulo_device_default(AMBULO_DEVICE_SPRING);
  v.coordinate = ambulo_model_find_coordinate(m, "lumbar_bending");
  v.rest = 0.1;
  v.pretension = 3;
  v.amount = 2;
  v.side = AMBULO_DEVICE_ABOVE;
  v.foot = 0;
  ambulo_device image = ambulo__device_mirrored(m, &v);
  assert_int_equal(image.coordinate, v.coordinate);
  assert_close(image.rest, -0.1, 0);
  assert_close(image.pretension, -3, 0);
  assert_close(image.amount, -2, 0);
  assert_int_equal(image.side, AMBULO_DEVICE_BELOW);
  assert_int_equal(image.foot, 1);
  v.coordinate = ambulo_model_find_coordinate(m, "knee_angle_r");
  image = ambulo__device_mirrored(m, &v);
  assert_string_equal(m->coordinates[image.coordinate].name, "knee_angle_l");
  assert_close(image.rest, 0.1, 0);
  assert_int_equal(image.side, AMBULO_DEVICE_ABOVE);
  ambulo_model_free(m);
}

/* 1: accepted */
static int is_balanced(const ambulo_model *m, const ambulo_device *devices, int count) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = m;
  d.ends = AMBULO_ENDS_MIRRORED;
  d.devices = devices;
  d.device_count = count;
  ambulo_status status = ambulo__devices_mirror_check(&d, list);
  if (status) assert_message(list, 0, "has no equal on the other side of the body");
  d.ends = AMBULO_ENDS_PERIODIC;
  assert_int_equal(ambulo__devices_mirror_check(&d, NULL), AMBULO_OK);
  ambulo_diagnostics_free(list);
  return !status;
}

static void test_what_has_no_image_is_refused(void **state) {
  (void)state;
  ambulo_model *m = person();
  ambulo_device v[3] = {between(m, "shank_r", "thorax")};
  assert_true(!is_balanced(m, v, 1));
  v[1] = ambulo__device_mirrored(m, &v[0]);
  assert_true(is_balanced(m, v, 2));
  v[2] = v[1];
  assert_true(!is_balanced(m, v, 3)); /* two on one side */
  for (int number = 0; number < 7; number++) {
    ambulo_device other[2] = {v[0], v[1]};
    double *numbers[] = {&other[1].stiffness, &other[1].rest, &other[1].pretension,
                         &other[1].position[0][0], &other[1].position[1][2]};
    if (number < 5) *numbers[number] += 0.01;
    if (number == 5) other[1].side = AMBULO_DEVICE_ABOVE;
    if (number == 6) other[1].clutch = 1;
    assert_true(!is_balanced(m, other, 2));
  }
  ambulo_device feet = between(m, "foot_r", "foot_l");
  feet.position[1][0] = feet.position[0][0];
  feet.position[1][1] = feet.position[0][1];
  feet.position[1][2] = -feet.position[0][2];
  assert_true(is_balanced(m, &feet, 1)); /* its own image, end for end */
  feet.position[1][0] += 0.01;
  assert_true(!is_balanced(m, &feet, 1));
  ambulo_model_free(m);
}

/* balanced: 1 if v and its image are accepted with something of the image changed */
#define WITH(...)                                                                                  \
  do {                                                                                             \
    ambulo_device two[2] = {v, ambulo__device_mirrored(m, &v)};                                    \
    ambulo_device *other = &two[1];                                                                \
    assert_true(is_balanced(m, two, 2));                                                           \
    __VA_ARGS__;                                                                                   \
    balanced = is_balanced(m, two, 2);                                                             \
  } while (0)

#define DIFFERS(...)                                                                               \
  do {                                                                                             \
    int balanced;                                                                                  \
    WITH(__VA_ARGS__);                                                                             \
    assert_true(!balanced);                                                                        \
  } while (0)

#define IS_ALIKE(...)                                                                              \
  do {                                                                                             \
    int balanced;                                                                                  \
    WITH(__VA_ARGS__);                                                                             \
    assert_true(balanced);                                                                         \
  } while (0)

/* every number that counts is compared, and no other */
static void test_laws_and_clocks_are_compared(void **state) {
  (void)state;
  static const double rises[][2] = {{0.1, 1}, {0.5, 2}}, later[][2] = {{0.1, 1}, {0.6, 2}};
  static const double higher[][2] = {{0.1, 1}, {0.5, 3}};
  ambulo_model *m = person();
  ambulo_device v = ambulo_device_default(AMBULO_DEVICE_SPRING);
  v.name = "knee";
  v.coordinate = ambulo_model_find_coordinate(m, "knee_angle_r");
  v.stiffness = 90;
  v.from = 0.1;
  v.to = 0.6;
  v.foot = 0;
  IS_ALIKE(other->smoothing = 0.5);
  IS_ALIKE(other->from = 0.2; other->ramp = 0.1; other->foot = 0); /* without a clutch */
  DIFFERS(other->kind = AMBULO_DEVICE_DAMPER);
  v.side = AMBULO_DEVICE_ABOVE;
  DIFFERS(other->smoothing = 0.5);
  v.clutch = 1;
  DIFFERS(other->from = 0.2);
  DIFFERS(other->to = 0.7);
  DIFFERS(other->ramp = 0.1);
  DIFFERS(other->foot = 0);
  DIFFERS(other->clutch = 0);
  v.clutch = 0;
  v.kind = AMBULO_DEVICE_DAMPER;
  v.damping = 3;
  IS_ALIKE(other->stiffness = 1);
  DIFFERS(other->damping = 4);
  v.kind = AMBULO_DEVICE_ACTUATOR;
  IS_ALIKE(other->points = later; other->point_count = 2); /* constant */
  DIFFERS(other->amount = 2);
  v.clock = AMBULO_DEVICE_BY_TIME;
  v.points = rises;
  v.point_count = 2;
  IS_ALIKE(other->foot = 0);
  DIFFERS(other->points = later);
  DIFFERS(other->points = higher);
  DIFFERS(other->point_count = 1);
  DIFFERS(other->clock = AMBULO_DEVICE_BY_STRIDE);
  v.clock = AMBULO_DEVICE_BY_STRIDE;
  DIFFERS(other->foot = 0);
  ambulo_model_free(m);
}

static void test_partners(void **state) {
  (void)state;
  ambulo_model *m = person();
  ambulo_device v[4] = {between(m, "shank_r", "thorax"),
                        ambulo_device_default(AMBULO_DEVICE_DAMPER)};
  ambulo_problem_definition d = ambulo_problem_definition_default();
  double sign;
  v[1].coordinate = ambulo_model_find_coordinate(m, "lumbar_rotation");
  v[2] = ambulo__device_mirrored(m, &v[0]);
  v[3] = v[1]; /* two that are alike, each its own image */
  d.model = m;
  d.devices = v;
  d.device_count = 4;
  assert_int_equal(ambulo__device_partner(&d, 0, &sign), 2);
  assert_close(sign, 1, 0);
  assert_int_equal(ambulo__device_partner(&d, 2, &sign), 0);
  assert_int_equal(ambulo__device_partner(&d, 1, &sign), 1);
  assert_close(sign, -1, 0);
  assert_int_equal(ambulo__device_partner(&d, 3, &sign), 3);
  d.device_count = 2;
  assert_int_equal(ambulo__device_partner(&d, 0, &sign), -1);
  ambulo_model_free(m);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_twice_is_once), cmocka_unit_test(test_a_turned_coordinate),
      cmocka_unit_test(test_what_has_no_image_is_refused),
      cmocka_unit_test(test_laws_and_clocks_are_compared), cmocka_unit_test(test_partners)};
  return cmocka_run_group_tests_name("contact/mirror_check_devices", tests, NULL, NULL);
}
