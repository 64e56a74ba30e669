/* Devices that are none: every refusal by name. */
#include "contact/devices.h"

#include "model/model.h"
#include "support/messages.h"
#include "support/planar_walker.h"

static const double profile[][2] = {{0, 1}, {0.5, 2}};

static ambulo_device sound(void) {
  ambulo_device v = ambulo_device_default(AMBULO_DEVICE_SPRING);
  v.name = "spring";
  v.coordinate = 4;
  v.stiffness = 100;
  v.foot = 0;
  v.from = 0.1;
  v.to = 0.6;
  v.ramp = 0.1;
  v.points = profile;
  v.point_count = 2;
  return v;
}

static void refuses(const ambulo_device *device, ambulo_ends ends, const char *what) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_model *model = walker_create();
  d.model = model;
  d.ends = ends;
  d.devices = device;
  d.device_count = 1;
  ambulo_status status = ambulo__devices_check(&d, list);
  assert_int_equal(status, what ? AMBULO_E_PROBLEM : AMBULO_OK);
  if (what) assert_message(list, 0, what);
  ambulo_model_free(model);
  ambulo_diagnostics_free(list);
}

/* a sound device but for one member */
#define REFUSES(what, ...)                                                                         \
  do {                                                                                             \
    ambulo_device v = sound();                                                                     \
    __VA_ARGS__;                                                                                   \
    refuses(&v, AMBULO_ENDS_PERIODIC, what);                                                       \
  } while (0)

static void test_numbers(void **state) {
  (void)state;
  REFUSES(NULL, (void)v);
  REFUSES("devices[0].stiffness of 'spring' is -5; expected 0 to 1e+09", v.stiffness = -5);
  REFUSES(NULL, v.stiffness = 0);
  REFUSES("rest of 'spring' is nan", v.rest = NAN);
  REFUSES("pretension of 'spring' is inf", v.pretension = INFINITY);
  REFUSES("smoothing of 'spring' is 0", v.side = AMBULO_DEVICE_ABOVE; v.smoothing = 0);
  REFUSES(NULL, v.smoothing = 0);
  REFUSES("the side of 'spring' is unknown (got 7)", v.side = (ambulo_device_side)7);
  REFUSES("damping of 'spring' is -1", v.kind = AMBULO_DEVICE_DAMPER; v.damping = -1);
  REFUSES("amount of 'spring' is nan", v.kind = AMBULO_DEVICE_ACTUATOR; v.amount = NAN);
  REFUSES("is unknown (got 9); expected an ambulo_device_kind", v.kind = (ambulo_device_kind)9);
  REFUSES("the side of 'spring' is not set (got 0)", v.side = AMBULO_DEVICE_SIDE_NOT_SET);
  REFUSES("the kind of 'spring' is not set (got 0)", v.kind = AMBULO_DEVICE_KIND_NOT_SET);
  REFUSES("the clock of 'spring' is not set (got 0)", v.kind = AMBULO_DEVICE_ACTUATOR;
          v.clock = AMBULO_DEVICE_CLOCK_NOT_SET);
  REFUSES("has no name", v.name = "");
}

static void test_profiles(void **state) {
  (void)state;
  static const double falls[][2] = {{0.4, 1}, {0.2, 2}}, late[][2] = {{0.2, 1}, {1.2, 2}};
  static const double level[][2] = {{0.4, 1}, {0.4, 2}}, whole[][2] = {{0.2, 1}, {1.0, 2}};
  REFUSES(NULL, v.kind = AMBULO_DEVICE_ACTUATOR; v.clock = AMBULO_DEVICE_BY_STRIDE);
  REFUSES("points[1] of 'spring' is at 0.2; expected rising numbers",
          v.kind = AMBULO_DEVICE_ACTUATOR;
          v.clock = AMBULO_DEVICE_BY_TIME; v.points = falls);
  REFUSES("from 0.2 to 1.2 of the stride", v.kind = AMBULO_DEVICE_ACTUATOR;
          v.clock = AMBULO_DEVICE_BY_STRIDE; v.points = late);
  REFUSES(NULL, v.kind = AMBULO_DEVICE_ACTUATOR; v.clock = AMBULO_DEVICE_BY_TIME; v.points = late);
  REFUSES("points[1] of 'spring' is at 0.4; expected rising numbers",
          v.kind = AMBULO_DEVICE_ACTUATOR;
          v.clock = AMBULO_DEVICE_BY_TIME; v.points = level);
  REFUSES("from 0.2 to 1 of the stride; expected from 0 to less than 1",
          v.kind = AMBULO_DEVICE_ACTUATOR;
          v.clock = AMBULO_DEVICE_BY_STRIDE; v.points = whole);
  REFUSES("has no points", v.kind = AMBULO_DEVICE_ACTUATOR; v.clock = AMBULO_DEVICE_BY_TIME;
          v.points = NULL);
  REFUSES("is unknown (got 5); expected one of its three", v.kind = AMBULO_DEVICE_ACTUATOR;
          v.clock = (ambulo_device_clock)5);
}

static void test_clutches(void **state) {
  (void)state;
  REFUSES(NULL, v.clutch = 1);
  REFUSES(NULL, v.clutch = 1; v.from = 0.9; v.to = 0.2);
  REFUSES("engaged.from of 'spring' is 1.5 of the stride", v.clutch = 1; v.from = 1.5);
  REFUSES("from 0.1 to 0.1 of the stride; expected a part of it", v.clutch = 1; v.to = 0.1);
  REFUSES(
      "engaged.ramp of 'spring' is 0.3 of the stride; expected up to half of what it is engaged "
      "for, 0.25",
      v.clutch = 1;
      v.ramp = 0.3);
  REFUSES("goes by the stride of foot 2; the model has 2", v.clutch = 1; v.foot = 2);
  ambulo_device v = sound();
  v.clutch = 1;
  refuses(&v, AMBULO_ENDS_FREE, "the ends are free");
}

static void test_places(void **state) {
  (void)state;
  REFUSES("acts at coordinate 99; the model has 9", v.coordinate = 99);
  REFUSES("would act on 'pelvis_ty', which moves the whole body", v.coordinate = 1);
  REFUSES("fixed to link -1; the model has 10", v.coordinate = -1);
  REFUSES("fixed at [0, 1000, 0] m of 'foot_r'", v.coordinate = -1; v.link[0] = 6; v.link[1] = 9;
          v.position[0][1] = 1000);
  REFUSES("between 'foot_r' and 'foot_r', which do not move against each other", v.coordinate = -1;
          v.link[0] = v.link[1] = 6);
  REFUSES("would act on 'pelvis_tilt'", v.coordinate = -1; v.link[0] = 2; v.link[1] = 6);
  REFUSES(NULL, v.coordinate = -1; v.link[0] = 6; v.link[1] = 9);
  const ambulo_device two[2] = {sound(), sound()};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_model *model = walker_create();
  d.model = model;
  d.devices = two;
  d.device_count = 2;
  assert_int_equal(ambulo__devices_check(&d, list), AMBULO_E_PROBLEM);
  assert_message(list, 0, "devices[1]: there are two named 'spring'");
  ambulo_model_free(model);
  ambulo_diagnostics_free(list);
}

static void test_a_foot_that_never_strikes(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_model *model = walker_create();
  ambulo_device v = sound();
  v.clutch = 1;
  d.model = model;
  d.ends = AMBULO_ENDS_PERIODIC;
  d.devices = &v;
  d.device_count = 1;
  assert_int_equal(ambulo__devices_check_strides(&d, list), AMBULO_E_PROBLEM);
  assert_message(list, 0, "goes by the stride of 'right', which does not strike");
  v.clutch = 0;
  assert_int_equal(ambulo__devices_check_strides(&d, list), AMBULO_OK);
  ambulo_model_free(model);
  ambulo_diagnostics_free(list);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_numbers),
                                     cmocka_unit_test(test_profiles),
                                     cmocka_unit_test(test_clutches), cmocka_unit_test(test_places),
                                     cmocka_unit_test(test_a_foot_that_never_strikes)};
  return cmocka_run_group_tests_name("device/device_check", tests, NULL, NULL);
}
