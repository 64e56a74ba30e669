/* The neutral pose: places and axes known from the walker's construction. */
#include "ambulo/ambulo.h"
#include "mechanics/lagrangian.h"
#include "model/neutral_pose.h"
#include "support/fail_alloc.h"
#include "support/random_model.h"
#include "support/test.h"
#include "support/walker_fixture.h"

static void points_stand_where_built(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  static const struct {
    const char *name;
    double place[3];
  } expected[] = {{"r_heel", {-0.05, 0.0, 0.09}},
                  {"l_toe", {0.17, 0.0, -0.09}},
                  {"r_toe_out", {0.17, 0.0, 0.13}},
                  {"l_heel_in", {-0.05, 0.0, -0.13}}};
  for (int i = 0; i < 4; i++) {
    double r[3];
    ambulo__neutral_point(model, ambulo_model_find_point(model, expected[i].name), r);
    for (int axis = 0; axis < 3; axis++) assert_close(r[axis], expected[i].place[axis], 1e-15);
  }
  ambulo_model_free(model);
}

static void axes_point_as_named(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  static const double expected[5][3] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 1}};
  for (int i = 0; i < 5; i++) {
    double axis[3];
    ambulo__neutral_axis(model, i, axis);
    for (int k = 0; k < 3; k++) assert_close(axis[k], expected[i][k], 1e-15);
    assert_int_equal(ambulo__is_root_translation(model, i), i < 3);
  }
  ambulo_model_free(model);
}

static void planar_models_are_recognised(void **state) {
  (void)state;
  for (int planar = 0; planar < 2; planar++) {
    ambulo_model *model = walker_create(planar);
    assert_int_equal(ambulo__model_moves_sideways(model), !planar);
    assert_int_equal(ambulo__link_moves_sideways(model, model->link_count - 1), !planar);
    ambulo_model_free(model);
  }
}

static int test_neutral_pose_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(points_stand_where_built),
                                     cmocka_unit_test(axes_point_as_named),
                                     cmocka_unit_test(planar_models_are_recognised)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The body at q = 0, against the equations of motion of the reference: its wrench at rest gives
 * the centre of mass, its points their places; a body in two links is one segment. */

static ambulo_model *random_model(uint64_t seed) {
  random_tree tree;
  ambulo_model *model = NULL;
  random_tree_make(&tree, seed, 6);
  if (seed % 2) random_tree_couple(&tree, seed);
  assert_int_equal(ambulo_model_create(&tree.definition, NULL, NULL, &model), AMBULO_OK);
  return model;
}

static double along(const double direction[3], const double v[3]) {
  return direction[0] * v[0] + direction[1] * v[1] + direction[2] * v[2];
}

/* M = r x F with F = -m g; places of points */
static void places_and_centres_agree_with_the_mechanics(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 30; seed++) {
    ambulo_model *model = random_model(seed);
    const double zero[6] = {0};
    double tau[6], wrench[6], points[3 * random_max_points], r[3] = {0}, place[3];
    void *scratch = malloc(ambulo__lagrangian_scratch_size(model));
    assert_int_equal(ambulo__lagrangian(0, model, zero, zero, zero,
                                        &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                          .tau = tau,
                                                          .wrench = wrench,
                                                          .points = points},
                                        scratch),
                     AMBULO_OK);
    ambulo__segments s;
    assert_int_equal(ambulo__segments_create(model, NULL, &s), AMBULO_OK);
    double mass = 0.0;
    for (int k = 0; k <= model->coordinate_count; k++) {
      mass += s.body[k].mass;
      for (int i = 0; i < 3; i++) r[i] += s.body[k].mass * s.body[k].com[i];
    }
    assert_close(mass, model->mass, 1e-14);
    /* M = r x F has, in (forward, up, left): M . left = F_up r_forward, M . forward = F_up r_left,
     * with signs of l = u x f */
    double up = along(model->up, wrench + 3);
    assert_close(along(model->left, wrench), -up * r[0] / mass, 1e-10);
    assert_close(along(model->forward, wrench), up * r[2] / mass, 1e-10);
    for (int p = 0; p < model->point_count; p++) {
      ambulo__segment_point(&s, p, place);
      assert_close(place[0], along(model->forward, points + 3 * p), 1e-13);
      assert_close(place[1], along(model->up, points + 3 * p), 1e-13);
      assert_close(place[2], along(model->left, points + 3 * p), 1e-13);
    }
    ambulo__segments_free(&s);
    ambulo_model_free(model);
    free(scratch);
  }
}

/* a pendulum of two bodies on a fixed and a moving link, turned out of the axes */
static void fixed_links_belong_to_what_carries_them(void **state) {
  (void)state;
  const double quarter = 0.5 * acos(-1);
  ambulo_link links[4];
  for (int i = 0; i < 4; i++) {
    static const char *const names[] = {"base", "rod", "tip", "stand"};
    links[i] = ambulo_link_default();
    links[i].name = names[i];
    links[i].parent = i == 3 ? -1 : i - 1;
  }
  links[1].type = AMBULO_REVOLUTE;
  links[1].a = 2.0;
  links[1].mass = 1.0;
  links[1].inertia[0] = links[1].inertia[1] = 0.1; /* a thin rod along its z */
  links[2].theta = quarter;
  links[2].a = 1.0;
  links[2].mass = 3.0;
  links[3].mass = 5.0;
  ambulo_coordinate swing = ambulo_coordinate_default();
  swing.name = "swing";
  ambulo_model_definition d = ambulo_model_definition_default();
  d.links = links;
  d.link_count = 4;
  d.coordinates = &swing;
  d.coordinate_count = 1;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_create(&d, NULL, NULL, &model), AMBULO_OK);
  ambulo__segments s;
  assert_int_equal(ambulo__segments_create(model, NULL, &s), AMBULO_OK);
  assert_int_equal(s.of_link[0], 0);
  assert_int_equal(s.of_link[1], 1);
  assert_int_equal(s.of_link[2], 1);
  assert_int_equal(s.of_link[3], 0);
  assert_int_equal(s.heaviest[0], 3);
  assert_int_equal(s.heaviest[1], 2);
  assert_int_equal(ambulo__segment_parent(&s, 0), 0);
  assert_close(s.body[0].mass, 5.0, 0);
  assert_close(s.body[1].mass, 4.0, 0);
  assert_close(s.body[1].com[0], 2.0, 1e-15);
  assert_close(s.body[1].com[1], 0.75, 1e-15);
  /* reduced mass 3/4, 1 m apart along up; the rod's own about forward and up */
  assert_close(s.body[1].inertia[0], 0.85, 1e-15);
  assert_close(s.body[1].inertia[1], 0.1, 1e-15);
  assert_close(s.body[1].inertia[2], 0.75, 1e-15);
  ambulo__segment_frame joint = ambulo__segment_joint(&s, 0);
  assert_close(joint.axes[2][2], -1.0, 0); /* world z points to the right */
  ambulo__segments_free(&s);
  ambulo_model_free(model);
}

static void any_allocation_may_fail(void **state) {
  (void)state;
  ambulo_model *model = random_model(3);
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__segments s = {.frame = NULL};
    ambulo_status status = ambulo__segments_create(model, &allocator, &s);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__segments_free(&s);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  ambulo_model_free(model);
}

static int test_segments_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(places_and_centres_agree_with_the_mechanics),
                                     cmocka_unit_test(fixed_links_belong_to_what_carries_them),
                                     cmocka_unit_test(any_allocation_may_fail)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_neutral_pose_tests() + test_segments_tests();
}
