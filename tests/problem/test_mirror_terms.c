/* Terms on the two sides of lower_body_18 with mirrored ends. What "alike" means is asked of the
 * objective itself: a motion and its mirror image cost the same. */
#include "mirror_fixture.h"

static const ambulo_term_kind by_coordinate[] = {
    AMBULO_TORQUE_SQUARED, AMBULO_TORQUE_ABSOLUTE,  AMBULO_ACCELERATION, AMBULO_TORQUE_POWER,
    AMBULO_TORQUE_RATE,    AMBULO_MECHANICAL_POWER, AMBULO_POSTURE};

static void equal_terms_are_accepted(void **state) {
  (void)state;
  for (size_t k = 0; k < sizeof by_coordinate / sizeof *by_coordinate; k++) {
    fixture f;
    open_fixture(&f, 1, by_coordinate[k]);
    expect(&f, NULL);
  }
}

static void an_unequal_scale_is_refused(void **state) {
  (void)state;
  for (size_t k = 0; k < sizeof by_coordinate / sizeof *by_coordinate; k++) {
    fixture f;
    open_fixture(&f, 1, by_coordinate[k]);
    f.scale[0][KNEE_L] = 0.05;
    expect(&f, "the scale of 'knee_angle_r' is 0.01, that of its mirror partner 'knee_angle_l' "
               "0.05; expected the same with mirrored ends");
  }
}

static void one_side_only_is_refused(void **state) {
  (void)state;
  fixture f;
  open_fixture(&f, 2, AMBULO_TORQUE_SQUARED);
  f.scale[1][KNEE_R] = 0.0;
  expect(&f, "objective[1] (torque_squared): the scale of 'knee_angle_r' is 0, that of its mirror "
             "partner 'knee_angle_l' 0.01");
  open_fixture(&f, 1, AMBULO_TORQUE_SQUARED);
  f.terms[0].weight = 2.0;
  for (int i = 0; i < D; i++) f.scale[0][i] = i == KNEE_R;
  expect(&f, "'knee_angle_r' is 1, that of its mirror partner 'knee_angle_l' 0;");
}

/* efforts of the two legs as terms of their own, as reports may want them */
static void sides_may_stand_in_different_terms(void **state) {
  (void)state;
  for (int k = 0; k < 4; k++) {
    fixture f;
    open_fixture(&f, 2, AMBULO_TORQUE_POWER);
    for (int i = 0; i < D; i++) {
      f.scale[0][i] = i >= HIP_R && i < HIP_R + 6 ? 0.01 : 0.0;
      f.scale[1][i] = i >= HIP_R + 6 ? 0.01 : 0.0;
    }
    if (k == 1) f.terms[1].weight = 1.5;
    if (k == 2) f.terms[1].power = 4.0;
    if (k == 3) f.terms[1].smoothing = 0.02;
    expect(&f,
           k ? "of 'hip_flexion_r' is 0.01, that of its mirror partner 'hip_flexion_l' 0;" : NULL);
  }
}

/* power of either side at a price of its own for braking */
static void sides_brake_at_one_price(void **state) {
  (void)state;
  for (int k = 0; k < 2; k++) {
    fixture f;
    open_fixture(&f, 2, AMBULO_MECHANICAL_POWER);
    for (int i = 0; i < D; i++) {
      f.scale[0][i] = i >= HIP_R && i < HIP_R + 6 ? 0.01 : 0.0;
      f.scale[1][i] = i >= HIP_R + 6 ? 0.01 : 0.0;
    }
    f.terms[0].negative = f.terms[1].negative = 0.3;
    if (k) f.terms[1].negative = 0.4;
    expect(&f,
           k ? "of 'hip_flexion_r' is 0.01, that of its mirror partner 'hip_flexion_l' 0;" : NULL);
  }
}

/* what a term holds to or takes off turns with the sign */
static void offsets_turn_with_the_sign(void **state) {
  (void)state;
  fixture f;
  open_fixture(&f, 1, AMBULO_POSTURE);
  f.offset[0][KNEE_R] = 0.1;
  expect(&f, "objective[0] (posture): the offset of 'knee_angle_r' is 0.1 rad, that of its mirror "
             "partner 'knee_angle_l' 0 rad; expected the same");
  open_fixture(&f, 1, AMBULO_POSTURE);
  f.offset[0][ROTATION] = 0.1;
  expect(&f, "the offset of 'pelvis_rotation' is 0.1 rad; expected 0 with mirrored ends, since it "
             "is its own mirror image");
  open_fixture(&f, 2, AMBULO_POSTURE); /* to either side */
  f.offset[0][ROTATION] = 0.1;
  f.offset[1][ROTATION] = -0.1;
  expect(&f, NULL);
  open_fixture(&f, 1, AMBULO_TORQUE_SQUARED);
  f.offset[0][1] = 700.0; /* pelvis_ty carries the body */
  f.offset[0][KNEE_R] = f.offset[0][KNEE_L] = 3.0;
  expect(&f, NULL);
  open_fixture(&f, 1, AMBULO_TORQUE_SQUARED);
  f.offset[0][KNEE_R] = 3.0;
  expect(&f, "the offset of 'knee_angle_r' is 3 N m, that");
  open_fixture(&f, 1, AMBULO_ACCELERATION); /* has none */
  f.offset[0][KNEE_R] = 3.0;
  expect(&f, NULL);
}

static void set(double *to, int i, int size, const double *from) {
  memcpy(to + i * size, from, (size_t)size * sizeof *to);
}

/* the cost of nothing but i and m, so that small differences show */
static void open_with_two(fixture *f, int i, int m) {
  open_fixture(f, 1, AMBULO_TORQUE_POWER);
  for (int k = 0; k < D; k++) f->scale[0][k] = k == i || k == m ? 1.0 : 0.0;
}

static void curves_are_compared_as_functions(void **state) {
  (void)state;
  const double passive[4] = {-2.0, 3.0, 0.5, -1.5}, ordered_otherwise[4] = {0.5, -1.5, -2.0, 3.0};
  const double weaker[4] = {-1.0, 3.0, 0.5, -1.5}, opposite[4] = {2.0, -3.0, -0.5, 1.5};
  for (int k = 0; k < 3; k++) {
    fixture f;
    open_with_two(&f, KNEE_R, KNEE_L);
    set(f.passive[0], KNEE_R, 4, passive);
    set(f.passive[0], KNEE_L, 4, k == 0 ? ordered_otherwise : k == 1 ? weaker : opposite);
    if (k == 2) { /* coordinates of opposite sense have curves of opposite sense */
      expect(&f, "the passive torque of 'knee_angle_r' at -1 rad is");
      continue;
    }
    expect(&f, k ? "the passive torque of 'knee_angle_r' at -1 rad is 2.14127 N m, that of its "
                   "mirror partner 'knee_angle_l' at -1 rad 2.19106 N m; expected the same"
                 : NULL);
  }
}

static void strength_belongs_to_a_direction(void **state) {
  (void)state;
  const double strength[6] = {100.0, 1.0, 0.2, 60.0, 1.1, -0.1};
  const double turned[6] = {60.0, 1.1, -0.1, 100.0, 1.0, 0.2};
  for (int k = 0; k < 3; k++) {
    fixture f;
    open_with_two(&f, KNEE_R, KNEE_L);
    set(f.strength[0], KNEE_R, 6, strength);
    if (k < 2) set(f.strength[0], KNEE_L, 6, k ? turned : strength);
    expect(&f, k == 0   ? NULL
               : k == 1 ? "the strength for positive torque of 'knee_angle_r' at -1 rad is"
                        : "of 'knee_angle_r' at -1 rad is 36.2358 N m, that of its mirror partner "
                          "'knee_angle_l' at -1 rad 1 N m");
  }
}

/* pelvis_rotation changes its sign: its strength for one direction at q is that for the other
 * at -q, its passive torque is odd */
static void curves_of_what_changes_its_sign(void **state) {
  (void)state;
  const double strength[6] = {100.0, 1.0, 0.2, 100.0, 1.0, -0.2};
  const double lopsided[6] = {100.0, 1.0, 0.2, 100.0, 1.0, 0.2};
  const double odd[4] = {1.0, 2.0, -1.0, -2.0}, even[4] = {1.0, 2.0, 1.0, -2.0};
  for (int k = 0; k < 3; k++) {
    fixture f;
    open_with_two(&f, ROTATION, ROTATION);
    set(f.strength[0], ROTATION, 6, k == 1 ? lopsided : strength);
    set(f.passive[0], ROTATION, 4, k == 2 ? even : odd);
    expect(&f,
           k == 0 ? NULL
           : k == 1
               ? "the strength for positive torque of 'pelvis_rotation' at -1 rad"
               : "the passive torque of 'pelvis_rotation' at -1 rad is 7.52439 N m, that of its "
                 "mirror partner 'pelvis_rotation' at 1 rad 7.52439 N m; expected the opposite");
  }
}

/* any term may be the odd one, and curves that meet at one angle part at others */
static void nothing_hides_a_difference(void **state) {
  (void)state;
  fixture f;
  open_fixture(&f, 2, AMBULO_TORQUE_SQUARED);
  f.scale[0][KNEE_L] = 0.05;
  expect(&f, "objective[0] (torque_squared): the scale of 'knee_angle_r' is 0.01");
  static const double right[4] = {1.0, 1.0, 0.0, 0.0}, left[4] = {2.718281828459045, 2.0, 0.0, 0.0};
  open_with_two(&f, KNEE_R, KNEE_L);
  set(f.passive[0], KNEE_R, 4, right);
  set(f.passive[0], KNEE_L, 4, left);
  expect(&f, "the passive torque of 'knee_angle_r' at -0.5 rad");
}

static void a_term_without_weight_is_left_alone(void **state) {
  (void)state;
  fixture f;
  open_fixture(&f, 2, AMBULO_TORQUE_SQUARED);
  f.terms[1].weight = 0.0;
  f.scale[1][KNEE_L] = 0.05;
  expect(&f, NULL);
}

static int point(const fixture *f, const char *name) {
  int index = ambulo_model_find_point(f->model, name);
  assert_true(index >= 0);
  return index;
}

static void line(fixture *f, int t, const char *from, const char *to) {
  f->terms[t].point[0] = point(f, from);
  f->terms[t].point[1] = point(f, to);
}

/* a line in the mirror plane, beside it, or one for each leg */
static void upright_lines_have_an_image(void **state) {
  (void)state;
  fixture f;
  open_fixture(&f, 1, AMBULO_UPRIGHT);
  line(&f, 0, "pelvis", "head_top");
  expect(&f, NULL);
  open_fixture(&f, 1, AMBULO_UPRIGHT);
  line(&f, 0, "heel_r", "toe_r");
  expect(&f, "objective[0] (upright): the line from 'heel_r' to 'toe_r' has no mirror image; it "
             "moves with 'subtalar_angle_r' and points 0 to the left at q = 0");
  open_fixture(&f, 1, AMBULO_UPRIGHT);
  line(&f, 0, "pelvis", "head_top");
  f.model->points[f.terms[0].point[0]].position[2] = 0.1;
  expect(&f, "it moves with 'pelvis_rotation' and points 0.116");
  open_fixture(&f, 2, AMBULO_UPRIGHT);
  line(&f, 0, "heel_r", "toe_r");
  line(&f, 1, "heel_l", "toe_l");
  expect(&f, NULL);
  open_fixture(&f, 2, AMBULO_UPRIGHT);
  line(&f, 0, "heel_r", "toe_r");
  line(&f, 1, "heel_l", "toe_l");
  f.terms[1].weight = 2.0;
  expect(&f, "another upright term of weight 1 on the other side");
  /* only its direction counts: it may stand elsewhere, and in the other sense */
  open_fixture(&f, 1, AMBULO_UPRIGHT);
  line(&f, 0, "pelvis", "head_top");
  for (int end = 0; end < 2; end++) f.model->points[f.terms[0].point[end]].position[2] += 0.1;
  expect(&f, NULL);
  open_fixture(&f, 2, AMBULO_UPRIGHT);
  line(&f, 0, "heel_r", "toe_r");
  line(&f, 1, "toe_l", "heel_l");
  for (int end = 0; end < 2; end++) f.model->points[f.terms[1].point[end]].position[1] += 0.02;
  expect(&f, NULL);
}

/* Ends on different links: each has to have its image, on the link's partner; a line may be the
 * image of itself turned round. Neither the first end alone nor the direction at q = 0 tells. */
static void upright_lines_over_joints_have_an_image(void **state) {
  (void)state;
  static const char other[] = "another upright term of weight 1 on the other side";
  static const struct {
    const char *line[2][2]; /* one or two */
    const char *phrase;
  } cases[] = {
      {{{"heel_r", "heel_l"}}, NULL}, /* from foot to foot: it is its own image */
      {{{"head_top", "heel_r"}},      /* the first end is its own image */
       "is 0 m to the left at q = 0, 'heel_r' with 'subtalar_angle_r' -0."},
      {{{"head_top", "heel_r"}, {"head_top", "heel_l"}}, NULL},
      {{{"head_top", "heel_r"}, {"heel_l", "head_top"}}, NULL}, /* in either sense */
      {{{"heel_r", "toe_l"}, {"heel_l", "toe_r"}}, NULL},
      {{{"head_top", "heel_r"}, {"head_top", "toe_l"}}, other},
      {{{"heel_r", "head_top"}, {"toe_l", "head_top"}}, other},
  };
  fixture f;
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    int count = cases[k].line[1][0] ? 2 : 1;
    open_fixture(&f, count, AMBULO_UPRIGHT);
    for (int t = 0; t < count; t++) line(&f, t, cases[k].line[t][0], cases[k].line[t][1]);
    expect(&f, cases[k].phrase);
  }
  open_fixture(&f, 2, AMBULO_UPRIGHT); /* of the same direction, beside where it should be */
  line(&f, 0, "heel_r", "toe_l");
  line(&f, 1, "heel_l", "toe_r");
  for (int end = 0; end < 2; end++) f.model->points[f.terms[1].point[end]].position[1] += 0.02;
  expect(&f, "the line from 'heel_r' to 'toe_l' has no mirror image");
  open_fixture(&f, 2, AMBULO_UPRIGHT); /* the same place at q = 0, on another link */
  line(&f, 0, "head_top", "heel_r");
  line(&f, 1, "head_top", "heel_l");
  ambulo_point *heel = &f.model->points[point(&f, "heel_l")];
  double place[3];
  ambulo__neutral_place(f.model, heel->link, heel->position, place);
  heel->link = ambulo_model_find_link(f.model, "shank_l");
  ambulo__neutral_local(f.model, heel->link, place, heel->position);
  expect(&f, "the line from 'head_top' to 'heel_r' has no mirror image");
}

/* tracking follows the data of one step: what they lack on one side is no difference */
static void a_reference_may_lack_a_side(void **state) {
  (void)state;
  for (int k = 0; k < 2; k++) {
    fixture f;
    static const double reference[13 * D];
    open_fixture(&f, 1, AMBULO_TRACKING);
    f.terms[0].reference = reference;
    f.scale[0][KNEE_L] = k ? 0.05 : 0.0;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    assert_int_equal(ambulo__mirror_terms_check(&f.definition, NULL, list),
                     k ? AMBULO_E_PROBLEM : AMBULO_OK);
    if (k) assert_message(list, 0, "objective[0] (tracking): the scale of 'knee_angle_r' is 0.01");
    ambulo_diagnostics_free(list);
    ambulo_model_free(f.model);
  }
}

static void any_allocation_may_fail(void **state) {
  (void)state;
  fixture f;
  open_fixture(&f, 1, AMBULO_TORQUE_SQUARED);
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_status status = ambulo__mirror_terms_check(&f.definition, &allocator, NULL);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  ambulo_model_free(f.model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(equal_terms_are_accepted),
                                     cmocka_unit_test(an_unequal_scale_is_refused),
                                     cmocka_unit_test(one_side_only_is_refused),
                                     cmocka_unit_test(sides_may_stand_in_different_terms),
                                     cmocka_unit_test(sides_brake_at_one_price),
                                     cmocka_unit_test(offsets_turn_with_the_sign),
                                     cmocka_unit_test(curves_are_compared_as_functions),
                                     cmocka_unit_test(nothing_hides_a_difference),
                                     cmocka_unit_test(strength_belongs_to_a_direction),
                                     cmocka_unit_test(curves_of_what_changes_its_sign),
                                     cmocka_unit_test(a_term_without_weight_is_left_alone),
                                     cmocka_unit_test(upright_lines_have_an_image),
                                     cmocka_unit_test(upright_lines_over_joints_have_an_image),
                                     cmocka_unit_test(a_reference_may_lack_a_side),
                                     cmocka_unit_test(any_allocation_may_fail)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
