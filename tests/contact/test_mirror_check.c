/* What mirrored ends ask of a body and its limits, through ambulo_problem_create. */
#include "ambulo/tools/load.h"
#include "contact/devices.h"
#include "contact/row_families.h"
#include "model/model.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/planar_walker.h"
#include "support/test.h"

enum { TILT = 2, KNEE_R = 4, KNEE_L = 7 };

typedef struct fixture {
  ambulo_model *model;
  ambulo_problem_definition definition;
  ambulo_term term;
  size_t others; /* messages that are expected after the first one */
} fixture;

static void open_fixture(fixture *f) {
  f->model = planar_walker_create();
  assert_non_null(f->model);
  f->others = 0;
  f->term = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.terms = &f->term;
  f->definition.term_count = 1;
  f->definition.ends = AMBULO_ENDS_MIRRORED;
}

static void set(double *interval, double low, double high) {
  interval[0] = low;
  interval[1] = high;
}

/* refused with `phrase` and the hint; NULL: accepted. Closes the fixture. */
static void expect(fixture *f, const char *phrase) {
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_problem_create(&f->definition, NULL, list, &problem);
  if (phrase) {
    assert_int_equal(status, AMBULO_E_PROBLEM);
    assert_message(list, 0, phrase);
    assert_message(list, 0, "hint: ends: {kind: periodic} predicts both sides");
    assert_int_equal(ambulo_diagnostics_count(list), 1 + f->others);
  } else {
    if (status) assert_message(list, 0, "nothing");
    assert_int_equal(status, AMBULO_OK);
  }
  ambulo_problem_free(problem);
  ambulo_diagnostics_free(list);
  ambulo_model_free(f->model);
}

static void a_heavier_shank_is_refused(void **state) {
  (void)state;
  for (int ends = AMBULO_ENDS_FREE; ends <= AMBULO_ENDS_MIRRORED; ends++) {
    fixture f;
    open_fixture(&f);
    ambulo_conditions load = ambulo_conditions_default();
    load.load_link = ambulo_model_find_link(f.model, "shank_l");
    load.load_mass = 3.0;
    ambulo_model *loaded = NULL;
    assert_int_equal(ambulo_model_adapt(f.model, &load, NULL, NULL, &loaded), AMBULO_OK);
    ambulo_model_free(f.model);
    f.definition.model = f.model = loaded;
    f.definition.ends = (ambulo_ends)ends;
    expect(&f, ends == AMBULO_ENDS_MIRRORED
                   ? "ends.kind: mirrored ends, but the mass of 'shank_r' is 3.5 kg, that of its "
                     "mirror partner 'shank_l' 6.5 kg; expected the same"
                   : NULL);
  }
}

static void a_symmetric_body_is_accepted(void **state) {
  (void)state;
  fixture f;
  open_fixture(&f);
  f.definition.joint_limits = AMBULO_LIMIT_NODES;
  f.definition.speed_limits = f.definition.torque_limits = 1;
  set(f.model->coordinates[KNEE_R].range, -1.0, 1.0);
  set(f.model->coordinates[KNEE_L].range, 1.0, 2.0); /* one point in common */
  expect(&f, NULL);
}

/* ranges, speeds and torques; only where they are rows */
static void limits_with_nothing_in_common_are_refused(void **state) {
  (void)state;
  static const char *const phrases[3] = {
      ("constraints.joint_limits: the range of 'knee_angle_r', 0 to 1 rad, and that of its mirror "
       "partner 'knee_angle_l', 1.5 to 2 rad, have nothing in common; mirrored ends keep both"),
      "constraints.speed_limits: the speed limits of 'knee_angle_r', 0 to 1 rad/s, and that",
      "constraints.torque_limits: the torque limits of 'knee_angle_r', 0 to 1 N m, and that"};
  for (int what = 0; what < 3; what++) {
    for (int asked = 0; asked < 2; asked++) {
      fixture f;
      open_fixture(&f);
      ambulo_coordinate *r = &f.model->coordinates[KNEE_R], *l = &f.model->coordinates[KNEE_L];
      double *own[3] = {r->range, r->speed, r->torque}, *other[3] = {l->range, l->speed, l->torque};
      set(own[what], 0.0, 1.0);
      set(other[what], 1.5, 2.0);
      f.definition.joint_limits = asked && what == 0 ? AMBULO_LIMIT_NODES : AMBULO_LIMIT_OFF;
      f.definition.speed_limits = asked && what == 1;
      f.definition.torque_limits = asked && what == 2;
      f.others = what == 1 ? 2 : 0; /* no motion that repeats has such a speed on average */
      expect(&f, asked ? phrases[what] : NULL);
    }
  }
}

/* spatial bodies have coordinates that change their sign */
static void a_range_and_its_image_may_have_nothing_in_common(void **state) {
  (void)state;
  fixture f;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  open_fixture(&f);
  ambulo_model_free(f.model);
  f.definition.model = f.model = model;
  f.definition.joint_limits = AMBULO_LIMIT_NODES;
  set(model->coordinates[5].range, 0.1, 0.3);
  expect(&f, "constraints.joint_limits: the range of 'pelvis_rotation', 0.1 to 0.3 rad, and its "
             "mirror image, -0.3 to -0.1 rad, have nothing in common");
}

/* a width on one side only is one that the reference lacks on the other */
static void tubes_are_as_wide_on_both_sides(void **state) {
  (void)state;
  static const double reference[2 * WALKER_COORDINATES];
  static const double widths[3] = {0.1, 0.2, INFINITY};
  for (int i = 0; i < 3; i++) {
    fixture f;
    double width[WALKER_COORDINATES];
    for (int k = 0; k < WALKER_COORDINATES; k++) width[k] = INFINITY;
    width[KNEE_R] = 0.1;
    width[KNEE_L] = widths[i];
    ambulo_tube tube = {2, reference, width};
    open_fixture(&f);
    f.definition.tubes = &tube;
    f.definition.tube_count = 1;
    expect(&f, i == 1
                   ? "constraints.tubes[0]: the half width of 'knee_angle_r' is 0.1 rad, that of "
                     "its mirror partner 'knee_angle_l' 0.2 rad; expected the same with mirrored "
                     "ends, or none on one side"
                   : NULL);
  }
}

/* what travels needs room for its two steps: contact/ends.c says so, once */
static void room_for_the_travel_is_said_elsewhere(void **state) {
  (void)state;
  fixture f;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  open_fixture(&f);
  f.definition.joint_limits = AMBULO_LIMIT_NODES;
  f.definition.travel = 0.7;
  int i = ambulo_model_find_coordinate(f.model, "pelvis_tx");
  set(f.model->coordinates[i].range, 0.0, 0.5);
  assert_int_equal(ambulo__mirror_check(&f.definition, NULL, list), AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_count(list), 0);
  ambulo_diagnostics_free(list);
  ambulo_model_free(f.model);
}

/* without memory nothing is said about the body, or its limits */
static void lack_of_memory_is_no_asymmetry(void **state) {
  (void)state;
  fixture f;
  fail_alloc memory = fail_alloc_at(0);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  open_fixture(&f);
  f.definition.torque_limits = 1;
  set(f.model->coordinates[KNEE_R].torque, 0.0, 1.0);
  set(f.model->coordinates[KNEE_L].torque, 1.5, 2.0);
  assert_int_equal(ambulo__mirror_check(&f.definition, &allocator, NULL), AMBULO_E_MEMORY);
  assert_int_equal(memory.live, 0);
  ambulo_model_free(f.model);
}

static int test_mirror_check_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_heavier_shank_is_refused),
      cmocka_unit_test(a_symmetric_body_is_accepted),
      cmocka_unit_test(limits_with_nothing_in_common_are_refused),
      cmocka_unit_test(a_range_and_its_image_may_have_nothing_in_common),
      cmocka_unit_test(tubes_are_as_wide_on_both_sides),
      cmocka_unit_test(room_for_the_travel_is_said_elsewhere),
      cmocka_unit_test(lack_of_memory_is_no_asymmetry)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

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

static int test_mirror_devices_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_twice_is_once), cmocka_unit_test(test_a_turned_coordinate),
      cmocka_unit_test(test_what_has_no_image_is_refused),
      cmocka_unit_test(test_laws_and_clocks_are_compared), cmocka_unit_test(test_partners)};
  return cmocka_run_group_tests_name("device/mirror_devices", tests, NULL, NULL);
}

int main(void) {
  return test_mirror_check_tests() + test_mirror_devices_tests();
}
