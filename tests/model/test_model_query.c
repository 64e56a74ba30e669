#include "ambulo/tools/load.h"
#include "model/model.h"
#include "model/model_query.h"
#include "model/neutral_pose.h"
#include "support/chain_definition.h"
#include "support/find_capsule.h"
#include "support/messages.h"
#include "support/test.h"

#include <string.h>

static void by_index(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.definition.stature = 1.8;
  ambulo_model *model = chain_good(&c);
  assert_string_equal(ambulo_model_name(model), "model");
  assert_int_equal(ambulo_model_link_count(model), 3);
  assert_int_equal(ambulo_model_coordinate_count(model), 3);
  assert_int_equal(ambulo_model_point_count(model), 2);
  assert_int_equal(ambulo_model_foot_count(model), 1);
  assert_string_equal(ambulo_model_link(model, 2)->name, "c");
  assert_string_equal(ambulo_model_coordinate(model, 1)->name, "qb");
  assert_string_equal(ambulo_model_point(model, 0)->name, "heel");
  assert_string_equal(ambulo_model_foot(model, 0)->name, "foot");
  assert_close(ambulo_model_mass(model), 7, 0);
  assert_close(ambulo__model_weight(model), 7 * 9.81, 1e-12);
  assert_close(ambulo_model_stature(model), 1.8, 0);
  assert_close(ambulo__model_size(model), 1.8 / 1.75, 1e-15);
  assert_close(ambulo_model_gravity(model)[1], -9.81, 0);
  assert_close(ambulo_model_up(model)[1], 1, 0);
  assert_close(ambulo_model_forward(model)[0], 1, 0);
  assert_close(ambulo_model_left(model)[2], -1, 0);
  for (int index = -1; index <= 3; index += 4) {
    assert_null(ambulo_model_link(model, index));
    assert_null(ambulo_model_coordinate(model, index));
    assert_null(ambulo_model_point(model, index));
    assert_null(ambulo_model_foot(model, index));
  }
  ambulo_model_free(model);
}

static void by_name(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  ambulo_model *model = chain_good(&c);
  assert_int_equal(ambulo_model_find_link(model, "b"), 1);
  assert_int_equal(ambulo_model_find_coordinate(model, "qc"), 2);
  assert_int_equal(ambulo_model_find_point(model, "toe"), 1);
  assert_int_equal(ambulo_model_find_foot(model, "foot"), 0);
  assert_int_equal(ambulo_model_find_link(model, "qc"), -1);
  assert_int_equal(ambulo_model_find_coordinate(model, "Qc"), -1);
  assert_int_equal(ambulo_model_find_point(model, ""), -1);
  assert_int_equal(ambulo_model_find_foot(model, NULL), -1);
  ambulo_model_free(model);
}

static void of_nothing(void **state) {
  (void)state;
  assert_null(ambulo_model_name(NULL));
  assert_int_equal(ambulo_model_link_count(NULL), 0);
  assert_int_equal(ambulo_model_coordinate_count(NULL), 0);
  assert_int_equal(ambulo_model_point_count(NULL), 0);
  assert_int_equal(ambulo_model_foot_count(NULL), 0);
  assert_null(ambulo_model_link(NULL, 0));
  assert_int_equal(ambulo_model_find_link(NULL, "a"), -1);
  assert_close(ambulo_model_mass(NULL) + ambulo_model_stature(NULL), 0, 0);
  assert_null(ambulo_model_gravity(NULL));
  assert_null(ambulo_model_up(NULL));
  assert_null(ambulo_model_forward(NULL));
  assert_null(ambulo_model_left(NULL));
}

static int test_query_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(by_index), cmocka_unit_test(by_name),
                                     cmocka_unit_test(of_nothing)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* A copy of a model with the ends of some capsules among its points; which links are neighbours. */

static ambulo_model *body(const char *name) {
  ambulo_model *m = NULL;
  char path[100];
  (void)snprintf(path, sizeof path, "models/%s.yaml", name);
  assert_int_equal(ambulo_model_load(path, NULL, NULL, NULL, &m), AMBULO_OK);
  return m;
}

static void ends_are_points(void **state) {
  (void)state;
  ambulo_model *m = body("lower_body_18"), *extended = NULL, *more = NULL;
  int used[64] = {0}, head = find_capsule(m, "head");
  int foot = find_capsule(m, "foot_l");
  used[foot] = 1;
  assert_int_equal(ambulo__model_with_capsule_points(m, used, NULL, NULL, &extended), AMBULO_OK);
  assert_int_equal(extended->point_count, m->point_count + 2);
  assert_int_equal(extended->capsule_point[foot], m->point_count);
  assert_int_equal(extended->capsule_point[head], -1);
  assert_int_equal(m->capsule_point[foot], -1);
  const ambulo_point *to = ambulo_model_point(extended, m->point_count + 1);
  assert_string_equal(to->name, "foot_l.to");
  assert_int_equal(to->link, m->capsules[foot].link);
  assert_memory_equal(to->position, m->capsules[foot].to, sizeof to->position);
  double world[3], place[3];
  ambulo__neutral_point(extended, m->point_count + 1, world);
  ambulo__neutral_place(m, to->link, m->capsules[foot].to, place);
  assert_memory_equal(world, place, sizeof world);
  used[head] = 1; /* those that have points keep them */
  assert_int_equal(ambulo__model_with_capsule_points(extended, used, NULL, NULL, &more), AMBULO_OK);
  assert_int_equal(more->point_count, m->point_count + 4);
  assert_int_equal(more->capsule_point[foot], m->point_count);
  assert_int_equal(more->capsule_point[head], m->point_count + 2);
  ambulo_model_free(more);
  ambulo_model_free(extended);
  ambulo_model_free(m);
}

static void a_point_of_that_name_is_in_the_way(void **state) {
  (void)state;
  static const char text[] =
      "ambulo: 1\nkind: model\nname: rod\nunits: {angle: degrees}\nlinks:\n"
      "  - {name: rod, parent: none, joint: revolute, dh: [0, 0, 1, 0],\n"
      "     body: {mass: 1, com: [0, 0, 0], gyration: [1, 1, 1]}}\n"
      "points: [{name: c.to, link: rod, position: [0, 0, 0]}]\n"
      "capsules: [{name: c, link: rod, from: [0, 0, 0], to: [1, 0, 0], radius: 0.1}]\n";
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_model *m = NULL, *extended = NULL;
  int used = 1;
  assert_int_equal(ambulo_model_load_text(text, sizeof text - 1, "t", NULL, NULL, NULL, &m), 0);
  assert_int_equal(ambulo__model_with_capsule_points(m, &used, NULL, list, &extended),
                   AMBULO_E_MODEL);
  assert_message(list, 0, "two points are named 'c.to'");
  assert_null(extended);
  ambulo_diagnostics_free(list);
  ambulo_model_free(m);
}

static int neighbours(const ambulo_model *m, const char *one, const char *other) {
  int a = ambulo_model_find_link(m, one), b = ambulo_model_find_link(m, other);
  assert_true(a >= 0 && b >= 0);
  int answer = ambulo__links_are_neighbours(m, a, b);
  assert_int_equal(answer, ambulo__links_are_neighbours(m, b, a));
  return answer;
}

/* across links without a mass, whatever joints there are */
static void neighbours_are_joined_by_joints_alone(void **state) {
  (void)state;
  ambulo_model *m = body("lower_body_21");
  assert_true(neighbours(m, "thigh_l", "pelvis"));
  assert_true(neighbours(m, "thorax", "pelvis"));
  assert_true(neighbours(m, "foot_r", "shank_r"));
  assert_true(neighbours(m, "talus_r", "foot_r")); /* parts of one joint */
  assert_true(neighbours(m, "thigh_l", "thigh_l"));
  assert_false(neighbours(m, "thigh_l", "thigh_r"));
  assert_false(neighbours(m, "thorax", "thigh_l"));
  assert_false(neighbours(m, "thigh_l", "foot_l"));
  assert_false(neighbours(m, "shank_l", "foot_r"));
  ambulo_model_free(m);
}

static int test_capsule_points_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(ends_are_points),
                                     cmocka_unit_test(a_point_of_that_name_is_in_the_way),
                                     cmocka_unit_test(neighbours_are_joined_by_joints_alone)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_query_tests() + test_capsule_points_tests();
}
