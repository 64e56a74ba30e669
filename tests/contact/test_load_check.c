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
  ambulo_model *model = planar_walker_create();
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
  REFUSES("would act on", v.coordinate = -1; v.link[0] = 0; v.link[1] = 6);
  REFUSES(NULL, v.coordinate = -1; v.link[0] = 6; v.link[1] = 9);
  const ambulo_device two[2] = {sound(), sound()};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_model *model = planar_walker_create();
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
  ambulo_model *model = planar_walker_create();
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

static int test_device_check_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_numbers),
                                     cmocka_unit_test(test_profiles),
                                     cmocka_unit_test(test_clutches), cmocka_unit_test(test_places),
                                     cmocka_unit_test(test_a_foot_that_never_strikes)};
  return cmocka_run_group_tests_name("device/device_check", tests, NULL, NULL);
}

/* What hands cannot hold: every refusal by name. */

static ambulo_hold test_hold_check_sound(void) {
  ambulo_hold h = ambulo_hold_default();
  h.name = "box";
  h.hand[0] = 0;
  h.hand[1] = 3;
  h.mass = 5;
  h.from = 0.5;
  h.to = 1.5;
  return h;
}

typedef ambulo_status check(const ambulo_problem_definition *d, ambulo_diagnostics *list);

static void test_hold_check_refuses(check *function, const ambulo_hold *holds, int count,
                                    ambulo_ends ends, ambulo_reaction_kind kind, const char *what) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_model *model = planar_walker_create();
  d.model = model;
  d.duration = 2;
  d.ends = ends;
  d.ground_reaction.kind = kind;
  d.holds = holds;
  d.hold_count = count;
  assert_int_equal(function(&d, list), what ? AMBULO_E_PROBLEM : AMBULO_OK);
  if (what) assert_message(list, 0, what);
  ambulo_model_free(model);
  ambulo_diagnostics_free(list);
}

/* a sound hold but for one member */
#define TEST_HOLD_CHECK_REFUSES(what, ...)                                                         \
  do {                                                                                             \
    ambulo_hold h = test_hold_check_sound();                                                       \
    __VA_ARGS__;                                                                                   \
    test_hold_check_refuses(ambulo__holds_check, &h, 1, AMBULO_ENDS_FREE, AMBULO_REACTION_NONE,    \
                            what);                                                                 \
  } while (0)

static void test_hands(void **state) {
  (void)state;
  TEST_HOLD_CHECK_REFUSES(NULL, (void)h);
  TEST_HOLD_CHECK_REFUSES(NULL, h.hand[1] = -1);
  TEST_HOLD_CHECK_REFUSES("held by points 99 and 3; expected points of the model", h.hand[0] = 99);
  TEST_HOLD_CHECK_REFUSES("held by points 0 and 99", h.hand[1] = 99);
  TEST_HOLD_CHECK_REFUSES("held by points -1 and 3", h.hand[0] = -1);
  TEST_HOLD_CHECK_REFUSES("twice; expected two points", h.hand[1] = 0);
  TEST_HOLD_CHECK_REFUSES("has an inertia or a center, but one hand", h.hand[1] = -1;
                          h.inertia = 0.1);
  TEST_HOLD_CHECK_REFUSES("has an inertia or a center, but one hand", h.hand[1] = -1;
                          h.center[2] = 0.1);
  TEST_HOLD_CHECK_REFUSES("without a name", h.name = NULL);
}

static void test_hold_check_test_numbers(void **state) {
  (void)state;
  TEST_HOLD_CHECK_REFUSES("mass -1 kg, inertia 0 kg m^2; expected 0 to 1e+06", h.mass = -1);
  TEST_HOLD_CHECK_REFUSES("inertia nan", h.inertia = NAN);
  TEST_HOLD_CHECK_REFUSES("center, size or force beyond 100 m", h.center[0] = 101);
  TEST_HOLD_CHECK_REFUSES("center, size or force beyond 100 m", h.size[1] = NAN);
  TEST_HOLD_CHECK_REFUSES("center, size or force beyond 100 m or 1e+06 N", h.force[1] = 2e6);
  TEST_HOLD_CHECK_REFUSES("has neither mass nor force", h.mass = 0);
  TEST_HOLD_CHECK_REFUSES(NULL, h.mass = 0; h.force[0] = 50);
}

static void test_windows(void **state) {
  (void)state;
  TEST_HOLD_CHECK_REFUSES("is held from 2 s to 3 s; expected times within 0 to 2 s", h.from = 2;
                          h.to = 3);
  TEST_HOLD_CHECK_REFUSES("is held from 1.5 s to 0.5 s", h.from = 1.5; h.to = 0.5);
  TEST_HOLD_CHECK_REFUSES("is held from nan s", h.from = NAN);
  TEST_HOLD_CHECK_REFUSES("taken up and set down over 0 s each", h.ramp = 0);
  TEST_HOLD_CHECK_REFUSES(
      "taken up and set down over 0.6 s each; expected above 0, and no more than the 1 s",
      h.ramp = 0.6);
  TEST_HOLD_CHECK_REFUSES(NULL, h.ramp = 0.5);
  TEST_HOLD_CHECK_REFUSES(NULL, h.ramp = 0.9; h.from = 0); /* one ramp only */
}

static void test_names_and_ground(void **state) {
  (void)state;
  const ambulo_hold two[2] = {test_hold_check_sound(), test_hold_check_sound()};
  test_hold_check_refuses(ambulo__holds_check, two, 2, AMBULO_ENDS_FREE, AMBULO_REACTION_NONE,
                          "two loads in hands are named 'box'");
  test_hold_check_refuses(ambulo__holds_check, two, 1, AMBULO_ENDS_FREE, AMBULO_REACTION_SHARED,
                          NULL);
}

static void test_mirrored_ends(void **state) {
  (void)state;
  ambulo_hold h = test_hold_check_sound();
  ambulo_model *model = planar_walker_create();
  const ambulo_foot *feet = model->feet;
  h.hand[0] = feet[0].heel_center;
  h.hand[1] = feet[1].heel_center;
  test_hold_check_refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_PERIODIC,
                          AMBULO_REACTION_NONE, NULL);
  test_hold_check_refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED,
                          AMBULO_REACTION_NONE,
                          "is held from 0.5 s to 1.5 s; with mirrored ends expected all along");
  h.from = 0;
  h.to = INFINITY;
  test_hold_check_refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED,
                          AMBULO_REACTION_NONE, NULL);
  h.force[1] = 1;
  test_hold_check_refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED,
                          AMBULO_REACTION_NONE, "is not its own mirror image");
  h.force[1] = 0;
  h.center[1] = 0.1;
  test_hold_check_refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED,
                          AMBULO_REACTION_NONE, "is not its own mirror image");
  h.center[1] = 0;
  h.hand[1] = feet[1].toe_center;
  test_hold_check_refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED,
                          AMBULO_REACTION_NONE, "is not its own mirror image");
  h.hand[1] = -1;
  test_hold_check_refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED,
                          AMBULO_REACTION_NONE, "is not its own mirror image");
  ambulo_model_free(model);
}

static int test_hold_check_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_hands), cmocka_unit_test(test_hold_check_test_numbers),
      cmocka_unit_test(test_windows), cmocka_unit_test(test_names_and_ground),
      cmocka_unit_test(test_mirrored_ends)};
  return cmocka_run_group_tests_name("device/hold_check", tests, NULL, NULL);
}

int main(void) {
  return test_device_check_tests() + test_hold_check_tests();
}
