/* Terms on the two sides of lower_body_18 with mirrored ends. What "alike" means is asked of the
 * objective itself: a motion and its mirror image cost the same. */
#include "objective/mirror_terms.h"

#include "ambulo/ambulo.h"
#include "model/model.h"
#include "model/neutral_pose.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/test.h"

enum { D = 18, ROTATION = 5, HIP_R = 6, KNEE_R = 9, KNEE_L = 15, MOST_TERMS = 4 };

/* terms with room for every array, all neutral */
typedef struct fixture {
  ambulo_model *model;
  ambulo_term terms[MOST_TERMS];
  double scale[MOST_TERMS][D], offset[MOST_TERMS][D];
  double passive[MOST_TERMS][4 * D], strength[MOST_TERMS][6 * D];
  ambulo_problem_definition definition;
} fixture;

static void open_fixture(fixture *f, int count, ambulo_term_kind kind) {
  memset(f, 0, sizeof *f);
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &f->model),
                   AMBULO_OK);
  for (int t = 0; t < count; t++) {
    f->terms[t] = ambulo_term_default(kind);
    for (int i = 0; i < D; i++) f->scale[t][i] = 0.01;
    f->terms[t].scale = f->scale[t];
    f->terms[t].offset = f->offset[t];
    f->terms[t].passive = f->passive[t];
    f->terms[t].strength = f->strength[t];
  }
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.terms = f->terms;
  f->definition.term_count = count;
  f->definition.ends = AMBULO_ENDS_MIRRORED;
}

/* cost of a made-up motion, less that of its mirror image, relative */
static double bias(const fixture *f) {
  ambulo_problem_definition d = f->definition;
  ambulo_problem *problem = NULL;
  ambulo_workspace *workspace = NULL;
  double cost[2];
  d.ends = AMBULO_ENDS_FREE;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  int n = ambulo_problem_variable_count(problem);
  double *x = malloc((size_t)n * sizeof *x), *image = malloc((size_t)n * sizeof *image);
  for (int j = 0; j < n; j++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(f->model, j % D);
    x[j] = 0.3 * sin(1.0 + 1.7 * j);
    image[j - j % D + c->mirror] = c->mirror_sign * x[j];
  }
  assert_int_equal(ambulo_problem_evaluate(problem, workspace, x, &cost[0], NULL, NULL), AMBULO_OK);
  assert_int_equal(ambulo_problem_evaluate(problem, workspace, image, &cost[1], NULL, NULL),
                   AMBULO_OK);
  free(x);
  free(image);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  return fabs(cost[0] - cost[1]) / fmax(fabs(cost[0]), 1e-300);
}

/* refused with `phrase`, or accepted (NULL), in agreement with the cost. Closes the fixture. */
static void expect(fixture *f, const char *phrase) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo__mirror_terms_check(&f->definition, NULL, list);
  if (phrase) {
    assert_message(list, 0, phrase);
    assert_message(list, 0, "hint: ends: {kind: periodic} predicts both sides");
    assert_true(bias(f) > 1e-9);
  } else {
    if (status) assert_message(list, 0, "nothing");
    assert_true(bias(f) < 1e-10);
  }
  assert_int_equal(status, phrase ? AMBULO_E_PROBLEM : AMBULO_OK);
  f->definition.ends = AMBULO_ENDS_PERIODIC;
  assert_int_equal(ambulo__mirror_terms_check(&f->definition, NULL, NULL), AMBULO_OK);
  ambulo_diagnostics_free(list);
  ambulo_model_free(f->model);
}

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

static void tendons_are_alike(void **state) {
  (void)state;
  for (int k = 0; k < 3; k++) {
    fixture f;
    double tendon[D] = {0.0};
    open_fixture(&f, 1, AMBULO_MECHANICAL_POWER);
    tendon[KNEE_R] = 300.0;
    if (k == 0) tendon[KNEE_L] = 300.0;
    if (k == 2) tendon[KNEE_L] = 250.0;
    f.terms[0].tendon = tendon;
    expect(&f, k == 0   ? NULL
               : k == 1 ? "the tendon of 'knee_angle_r' is 300 N m/rad, that of its mirror partner "
                          "'knee_angle_l' 0 N m/rad; expected the same"
                        : "'knee_angle_l' 250 N m/rad");
  }
}

/* power at the nodes on one side, of intervals on the other */
static void both_sides_are_at_nodes_or_between(void **state) {
  (void)state;
  for (int k = 0; k < 2; k++) {
    fixture f;
    const double none[D] = {0.0};
    open_fixture(&f, 2, AMBULO_MECHANICAL_POWER);
    for (int i = 0; i < D; i++) {
      f.scale[0][i] = i >= HIP_R && i < HIP_R + 6 ? 0.01 : 0.0;
      f.scale[1][i] = i >= HIP_R + 6 ? 0.01 : 0.0;
    }
    f.terms[0].tendon = none;
    if (k == 0) f.terms[1].tendon = none;
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
                                     cmocka_unit_test(tendons_are_alike),
                                     cmocka_unit_test(both_sides_are_at_nodes_or_between),
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
