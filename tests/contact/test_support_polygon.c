/* Polygons: hulls of awkward point sets, areas, insets, regions of loaded feet. */
#include "contact/support_polygon.h"
#include "support/walker_fixture.h"

static void hull_of_a_square(void **state) {
  (void)state;
  double points[][2] = {{1, 1},   {0.5, 0.5}, {0, 0}, {1, 0}, {0, 1},
                        {0.5, 0}, {1, 0},     {0, 0}, {1, 1}};
  ambulo__polygon hull, inset;
  ambulo__convex_hull(points, 9, &hull);
  static const double expected[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  assert_int_equal(hull.count, 4);
  for (int i = 0; i < 4; i++) {
    assert_close(hull.vertex[i][0], expected[i][0], 0.0);
    assert_close(hull.vertex[i][1], expected[i][1], 0.0);
  }
  assert_close(ambulo__polygon_area(&hull), 1.0, 1e-15);
  ambulo__polygon_inset(&hull, 0.1, &inset);
  assert_close(ambulo__polygon_area(&inset), 0.64, 1e-14);
  ambulo__polygon_inset(&hull, 0.5001, &inset);
  assert_close(ambulo__polygon_area(&inset), 0.0, 1e-15);
}

static void degenerate_hulls_have_no_area(void **state) {
  (void)state;
  double line[][2] = {{0, 0}, {1, 1}, {0.25, 0.25}, {1, 1}, {0.5, 0.5}};
  double same[][2] = {{2, 3}, {2, 3}, {2, 3}};
  double one[][2] = {{2, 3}};
  ambulo__polygon hull;
  ambulo__convex_hull(line, 5, &hull);
  assert_true(hull.count < 3);
  ambulo__convex_hull(same, 3, &hull);
  assert_true(hull.count < 3);
  ambulo__convex_hull(one, 1, &hull);
  assert_true(hull.count < 3);
  ambulo__convex_hull(one, 0, &hull);
  assert_int_equal(hull.count, 0);
  assert_close(ambulo__polygon_area(&hull), 0.0, 0.0);
}

typedef struct setting {
  ambulo_problem_definition definition;
  ambulo_contact contacts[2];
  int active[2];
} setting;

/* left foot at (0.6, 0.09) in `left`, right foot at (0, -0.09) in `right` */
static setting two_feet(ambulo_model *model, ambulo_contact_mode left, ambulo_contact_mode right) {
  setting s = {
      .definition = ambulo_problem_definition_default(),
      .contacts = {{.foot = WALKER_LEFT, .mode = left, .to = 1.0, .place = {0.6, 0.09}},
                   {.foot = WALKER_RIGHT, .mode = right, .to = 1.0, .place = {0.0, -0.09}}},
      .active = {1, 0}};
  s.definition.model = model;
  return s;
}

static void the_box_counts_whole_feet(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  setting s = two_feet(model, AMBULO_CONTACT_HEEL, AMBULO_CONTACT_TOE);
  s.definition.contacts = s.contacts;
  s.definition.support = AMBULO_SUPPORT_BOX;
  ambulo__support_region region;
  assert_int_equal(ambulo__support_region_of(&s.definition, s.active, 0, &region), AMBULO_OK);
  assert_int_equal(region.count, 4);
  static const double offset[4] = {0.0, -0.82, -0.13, -0.13};
  for (int k = 0; k < 4; k++) assert_close(region.side[k].offset, offset[k], 1e-14);
  assert_close(region.size, 0.82 * 0.26, 1e-13);
  s.definition.support_margin = 0.02;
  assert_int_equal(ambulo__support_region_of(&s.definition, s.active, 0, &region), AMBULO_OK);
  for (int k = 0; k < 4; k++) assert_close(region.side[k].offset, offset[k] + 0.02, 1e-14);
  assert_close(region.size, 0.78 * 0.22, 1e-13);
  assert_int_equal(ambulo__support_region_of(&s.definition, s.active, 1, &region), AMBULO_OK);
  assert_int_equal(region.count, 2);
  assert_close(region.size, 0.78, 1e-13);
  ambulo_model_free(model);
}

/* heel corners of the left foot (0.6, 0.05) (0.6, 0.13), toe corners of the right one
 * (0.22, -0.13) (0.22, -0.05): a parallelogram of 0.38 m by 0.08 m */
static void the_hull_counts_corners_in_contact(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  setting s = two_feet(model, AMBULO_CONTACT_HEEL, AMBULO_CONTACT_TOE);
  s.definition.contacts = s.contacts;
  s.definition.support = AMBULO_SUPPORT_HULL;
  ambulo__support_region region;
  assert_int_equal(ambulo__support_region_of(&s.definition, s.active, 0, &region), AMBULO_OK);
  assert_int_equal(region.count, 4);
  assert_close(region.size, 0.38 * 0.08, 1e-13);
  static const double center[2] = {0.41, 0.0};
  for (int k = 0; k < 4; k++) {
    const ambulo__half_plane *side = &region.side[k];
    assert_close(hypot(side->normal[0], side->normal[1]), 1.0, 1e-15);
    assert_true(side->normal[0] * center[0] + side->normal[1] * center[1] > side->offset);
  }
  s.active[WALKER_LEFT] = -1;
  assert_int_equal(ambulo__support_region_of(&s.definition, s.active, 0, &region), AMBULO_OK);
  assert_close(region.size, 0.0, 0.0);
  s.active[WALKER_RIGHT] = -1;
  assert_int_equal(ambulo__support_region_of(&s.definition, s.active, 0, &region), AMBULO_OK);
  assert_int_equal(region.count, 0);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(hull_of_a_square),
                                     cmocka_unit_test(degenerate_hulls_have_no_area),
                                     cmocka_unit_test(the_box_counts_whole_feet),
                                     cmocka_unit_test(the_hull_counts_corners_in_contact)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
