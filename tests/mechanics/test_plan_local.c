/* Which constants the kernels in the frames' own axes leave out, and where they fork. */
#include "mechanics/kernel_fixture.h"
#include "mechanics/plan_layout.h"

static const double quarter = 1.5707963267948966;

enum { link_count = 6 };

/* A slider, a trunk that turns, two limbs of one joint, and one more joint on the first limb. */
static void make_links(ambulo_link *links) {
  static const char *const names[] = {"lift", "trunk", "knee", "ankle", "hip", "plate"};
  static const int parents[] = {-1, 0, 1, 2, 1, 4};
  for (int i = 0; i < link_count; i++) {
    links[i] = ambulo_link_default();
    links[i].name = names[i];
    links[i].parent = parents[i];
    links[i].type = i == 0 ? AMBULO_PRISMATIC : i == 5 ? AMBULO_FIXED : AMBULO_REVOLUTE;
    links[i].mass = i == 0 ? 0 : 2;
    for (int k = 0; k < 3 && i > 0; k++) links[i].inertia[k] = 0.1 + 0.01 * k;
  }
  links[1].alpha = quarter;
  links[1].com[1] = 0.3;
  links[2].a = 0.2;
  links[3].com[0] = links[3].com[2] = 0.1;
  links[4].theta = 0.3;
  links[5].inertia[3] = 0.02;
}

/* Heel and toe of two feet. */
static void add_feet(ambulo_model_definition *definition, const int links[2], ambulo_point *points,
                     ambulo_foot *feet) {
  static const char *const names[] = {"heel_0", "toe_0", "heel_1", "toe_1"};
  for (int i = 0; i < 4; i++) {
    points[i] = (ambulo_point){.name = names[i], .link = links[i / 2], .position = {i % 2, 0, 0}};
  }
  for (int f = 0; f < 2; f++) {
    feet[f] = (ambulo_foot){.name = f ? "right" : "left",
                            .heel = {2 * f, -1},
                            .toe = {2 * f + 1, -1},
                            .heel_center = 2 * f,
                            .toe_center = 2 * f + 1,
                            .mirror = -1};
  }
  definition->points = points;
  definition->point_count = 4;
  definition->feet = feet;
  definition->foot_count = 2;
}

/* feet: the links of two feet, NULL: in the air. */
static ambulo__plan *make_plan(const int feet_on[2]) {
  ambulo_point points[4];
  ambulo_foot feet[2];
  ambulo_link links[link_count];
  ambulo_coordinate coordinates[link_count];
  ambulo_model_definition definition = ambulo_model_definition_default();
  ambulo_model *model = NULL;
  ambulo__plan *plan = NULL;
  make_links(links);
  for (int i = 0; i < link_count - 1; i++) {
    coordinates[i] = ambulo_coordinate_default();
    coordinates[i].name = links[i].name;
    coordinates[i].type = links[i].type;
    coordinates[i].mirror = i;
  }
  definition.links = links;
  definition.link_count = link_count;
  definition.coordinates = coordinates;
  definition.coordinate_count = link_count - 1;
  if (feet_on) add_feet(&definition, feet_on, points, feet);
  assert_int_equal(ambulo_model_create(&definition, NULL, NULL, &model), AMBULO_OK);
  if (feet_on) {
    const int link[] = {points[0].link, points[1].link};
    assert_int_equal(ambulo__plan_create_contacts(model, link, 2, 0.05, 0.3, NULL, &plan),
                     AMBULO_OK);
  } else {
    assert_int_equal(ambulo__plan_create(model, NULL, &plan), AMBULO_OK);
  }
  ambulo_model_free(model);
  return plan;
}

static void limbs_are_carried_and_branches_kept(void **state) {
  (void)state;
  ambulo__plan *plan = make_plan(NULL);
  const ambulo__local_step *steps = plan->local.steps;
  static const int carried[] = {1, 1, 1, 1, 0};
  for (int k = 0; k < 5; k++) {
    if (steps[k].carried != carried[k]) {
      print_error("step %d: carried %d\n", k, steps[k].carried);
      fail();
    }
    assert_int_equal(steps[k].kept, k == 1);
    assert_int_equal(steps[k].first_adjoint, k == 4);
  }
  /* the first limb ends at the trunk, whose own body writes its load first; the second goes on to
   * the root */
  const ambulo__limb *limbs = plan->local.limbs;
  assert_int_equal(plan->local.limb_count, 2);
  assert_true(limbs[0].first == 0 && limbs[0].leaf == 3 && limbs[0].top == 2);
  assert_true(limbs[1].first == 4 && limbs[1].leaf == 4 && limbs[1].top == 0);
  assert_int_equal(steps[2].first, 0);
  assert_int_equal(steps[0].first, 1);
  assert_int_equal(plan->local.branched, 0);
  /* lift and trunk have their virtual motions for themselves, the limbs share places */
  assert_true(limbs[0].stem == 1 && limbs[1].stem == 3);
  assert_int_equal(steps[1].virtual_at, steps[1].at + local_turn);
  assert_int_equal(steps[2].virtual_at, steps[4].virtual_at);
  assert_true(steps[3].virtual_at > steps[2].virtual_at);
  ambulo__plan_free(plan);
}

static void zeros_of_joints_and_bodies_are_found(void **state) {
  (void)state;
  ambulo__plan *plan = make_plan(NULL);
  const ambulo__local_step *steps = plan->local.steps;
  assert_int_equal(steps[0].joint, AMBULO__SLIDES_Z);
  assert_int_equal(steps[0].body, AMBULO__BODY_NONE);
  assert_int_equal(steps[1].joint, AMBULO__TURNS_Z);
  assert_int_equal(steps[1].still, 1);
  assert_int_equal(steps[2].still, 0);
  assert_int_equal(steps[2].joint, AMBULO__TURNS_Y);
  /* the trunk's y is turned to its frame's z by the link's alpha */
  assert_int_equal(steps[1].body, AMBULO__BODY_Z);
  assert_close(fabs(steps[1].com[2]), 0.3, 1e-15);
  assert_int_equal(steps[2].offset, AMBULO__OFFSET_NONE);
  assert_int_equal(steps[3].offset, AMBULO__OFFSET_X);
  assert_close(fabs(steps[3].length), 0.2, 1e-15);
  assert_int_equal(steps[3].body, AMBULO__BODY_DIAGONAL);
  assert_int_equal(steps[4].offset, AMBULO__OFFSET_NONE);
  assert_int_equal(steps[4].body, AMBULO__BODY_ANY);
  ambulo__plan_free(plan);
}

/* The factors of the inertia, put together again, are the inertia. */
static void inertia_is_that_of_the_links(void **state) {
  (void)state;
  ambulo__plan *plan = make_plan(NULL);
  const ambulo__local_step *hip = &plan->local.steps[4], *trunk = &plan->local.steps[1];
  const double want[6] = {0.2, 0.22, 0.24, 0.02, 0, 0}, turned[3] = {0.1, 0.12, 0.11};
  double largest = 0, trace = 0;
  for (int i = 0; i < 3; i++) {
    assert_close(trunk->inertia[i], turned[i], 1e-12);
    trace += hip->inertia[i];
    largest = fmax(largest, fabs(hip->inertia[3 + i]));
    assert_close(hip->difference[i], hip->inertia[(i + 2) % 3] - hip->inertia[(i + 1) % 3], 1e-15);
  }
  assert_close(trace, want[0] + want[1] + want[2], 1e-12);
  assert_close(largest, want[3], 1e-12);
  ambulo__plan_free(plan);
}

/* Feet on ankle and hip: trunk and lift carry the whole body. */
static void loads_end_below_what_carries_the_body(void **state) {
  (void)state;
  static const int feet[2] = {3, 4};
  ambulo__plan *plan = make_plan(feet);
  const ambulo__limb *limbs = plan->local.limbs;
  assert_true(limbs[0].top == 2 && limbs[0].rise == 2 && limbs[0].ends);
  assert_true(limbs[1].top == 0 && limbs[1].rise == 4 && limbs[1].ends);
  ambulo__plan_free(plan);
  plan = make_plan(NULL);
  for (int i = 0; i < 2; i++) {
    assert_true(plan->local.limbs[i].rise == plan->local.limbs[i].top);
    assert_false(plan->local.limbs[i].ends);
  }
  ambulo__plan_free(plan);
}

/* The bodies stand on the slider: each counts where it is fixed, and only there. */
static void masses_stand_at_fixed_origins(void **state) {
  (void)state;
  static const int feet[2] = {3, 4};
  ambulo__plan *plan = make_plan(feet);
  const ambulo__local_step *steps = plan->local.steps;
  double knee = hypot(steps[2].moment[0], hypot(steps[2].moment[1], steps[2].moment[2]));
  assert_int_equal(steps[0].weighs, 8);
  assert_close(steps[0].anchored, 10, 1e-15);
  for (int k = 1; k < 5; k++) assert_close(steps[k].anchored, 0, 0);
  /* its own body has its centre of mass at 0.2, where the ankle's stands */
  assert_close(knee, (2 + 2) * 0.2, 1e-15);
  for (int i = 0; i < 3; i++) {
    assert_close(steps[3].moment[i], steps[3].first_moment[i], 0);
    assert_close(steps[1].moment[i], steps[1].first_moment[i], 0);
  }
  ambulo__plan_free(plan);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(limbs_are_carried_and_branches_kept),
                                     cmocka_unit_test(zeros_of_joints_and_bodies_are_found),
                                     cmocka_unit_test(inertia_is_that_of_the_links),
                                     cmocka_unit_test(loads_end_below_what_carries_the_body),
                                     cmocka_unit_test(masses_stand_at_fixed_origins)};
  return cmocka_run_group_tests_name("mechanics/plan_local", tests, NULL, NULL);
}
