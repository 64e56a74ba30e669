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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_heavier_shank_is_refused),
      cmocka_unit_test(a_symmetric_body_is_accepted),
      cmocka_unit_test(limits_with_nothing_in_common_are_refused),
      cmocka_unit_test(a_range_and_its_image_may_have_nothing_in_common),
      cmocka_unit_test(tubes_are_as_wide_on_both_sides),
      cmocka_unit_test(room_for_the_travel_is_said_elsewhere),
      cmocka_unit_test(lack_of_memory_is_no_asymmetry)};
  return cmocka_run_group_tests_name("contact/mirror_check", tests, NULL, NULL);
}
