/* Polygons: hulls of awkward point sets, areas, insets, regions of loaded feet. */
#include "base/diagnostics.h"
#include "contact/row_families.h"
#include "support/row_fixture.h"
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

static int test_support_polygon_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(hull_of_a_square),
                                     cmocka_unit_test(degenerate_hulls_have_no_area),
                                     cmocka_unit_test(the_box_counts_whole_feet),
                                     cmocka_unit_test(the_hull_counts_corners_in_contact)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* ZMP rows against a force applied at a known point of the ground: M = p x F. */

static const double body_weight = 72.0 * 9.81;

static const ambulo_contact contacts[] = {
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.3, 0.09}},
    {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.0, 1.0, .place = {0.0, -0.09}}};

/* the wrench of force F through p at every node */
static void apply(row_fixture *f, const double p[3], const double force[3]) {
  for (int k = 0; k < ROW_NODES; k++) {
    for (int i = 0; i < 3; i++) {
      int j = (i + 1) % 3, l = (i + 2) % 3;
      *row_channel(f, k, ambulo__channel_force(&f->context.channels, i)) = force[i];
      *row_channel(f, k, ambulo__channel_moment(&f->context.channels, i)) =
          p[j] * force[l] - p[l] * force[j];
    }
  }
}

static void open_left(row_fixture *f, int planar, ambulo_support support) {
  row_fixture_open(f, planar);
  f->definition.contacts = contacts;
  f->definition.contact_count = 2;
  f->definition.support = support;
  for (int k = 0; k < ROW_NODES; k++) f->active[2 * k + WALKER_LEFT] = 0;
}

/* left foot flat: 0.3 to 0.52 m forward, 0.05 to 0.13 m left; ZMP at (0.4, 0.1) */
static void box_rows_are_distances(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 0, AMBULO_SUPPORT_BOX);
  f.definition.ground_height = 0.2;
  f.definition.support_margin = 0.01;
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, NULL), AMBULO_OK);
  assert_int_equal(f.table.row_count, 4 * ROW_NODES);
  const double p[3] = {0.4, 0.2, -0.1}, force[3] = {35.0, body_weight, -20.0};
  apply(&f, p, force);
  static const char *const names[] = {"back", "front", "right", "left"};
  static const double expected[] = {0.09, 0.11, 0.04, 0.02};
  for (int i = 0; i < 4; i++) {
    assert_close(row_value(&f, row_find(&f, "zmp", "support", names[i], 0.5)), expected[i], 1e-13);
  }
  const double half[3] = {35.0, 0.5 * body_weight, -20.0};
  apply(&f, p, half);
  assert_close(row_value(&f, row_find(&f, "zmp", "support", "back", 0.5)), 0.045, 1e-13);
  row_fixture_close(&f);
}

/* the hull of one flat foot is its box: the same four distances, in another order */
static void hull_rows_are_distances(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 0, AMBULO_SUPPORT_HULL);
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, NULL), AMBULO_OK);
  const double p[3] = {0.4, 0.0, -0.1}, force[3] = {35.0, body_weight, -20.0};
  apply(&f, p, force);
  static const double expected[] = {0.05, 0.12, 0.03, 0.1};
  for (int i = 0; i < 4; i++) {
    assert_string_equal(f.table.rows[i].detail, "edge");
    assert_close(row_value(&f, i), expected[i], 1e-13);
  }
  row_fixture_close(&f);
}

static void planar_models_have_two_rows(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 1, AMBULO_SUPPORT_HULL);
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, NULL), AMBULO_OK);
  assert_int_equal(f.table.row_count, 2 * ROW_NODES);
  const double p[3] = {0.4, 0.0, 0.0}, force[3] = {35.0, body_weight, 0.0};
  apply(&f, p, force);
  assert_close(row_value(&f, 0), 0.1, 1e-13);
  assert_close(row_value(&f, 1), 0.12, 1e-13);
  row_fixture_close(&f);
}

static void normal_force_counts_body_weights(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 0, AMBULO_SUPPORT_OFF);
  f.definition.minimum_force = 0.3;
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, NULL), AMBULO_OK);
  assert_int_equal(f.table.row_count, ROW_NODES);
  const double p[3] = {0, 0, 0}, force[3] = {0, 2.0 * body_weight, 0};
  apply(&f, p, force);
  assert_close(row_value(&f, row_find(&f, "normal_force", "ground", "vertical", 1.0)), 1.7, 1e-14);
  row_fixture_close(&f);
}

/* from the left foot alone to both feet at 0.5 s: the point is over the left one still */
static void events_have_both_regions(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 0, AMBULO_SUPPORT_BOX);
  for (int k = 2; k < ROW_NODES; k++) f.active[2 * k + WALKER_RIGHT] = 1;
  row_event(&f, 2, WALKER_RIGHT, -1);
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, NULL), AMBULO_OK);
  assert_int_equal(f.table.row_count, 4 * (ROW_NODES + 1));
  assert_int_equal(row_count(&f, "zmp", "support", "back", 0.5), 2);
  assert_int_equal(row_count(&f, "zmp", "support", "back", 0.75), 1);
  const double p[3] = {0.4, 0.0, -0.1}, force[3] = {35.0, body_weight, -20.0};
  apply(&f, p, force);
  double near = INFINITY, far = -INFINITY;
  for (int r = 0; r < f.table.row_count; r++) {
    const ambulo__table_row *row = &f.table.rows[r];
    if (strcmp(row->detail, "back") != 0 || row->time != 0.5) continue;
    near = fmin(near, row_value(&f, r));
    far = fmax(far, row_value(&f, r));
  }
  assert_close(near, 0.1, 1e-13); /* from the left foot's back */
  assert_close(far, row_value(&f, row_find(&f, "zmp", "support", "back", 0.75)), 1e-13);
  assert_true(far > 0.3);
  row_fixture_close(&f);
}

static void empty_regions_are_refused(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 0, AMBULO_SUPPORT_HULL);
  f.active[2 * 3 + WALKER_LEFT] = -1;
  f.active[2 * 3 + WALKER_RIGHT] = 1;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, list), AMBULO_E_PROBLEM);
  expect_message(list, "the support polygon is empty at t = 0.75 s (right on its toes, margin 0 m");
  ambulo__diagnostics_clear(list);
  f.definition.support = AMBULO_SUPPORT_BOX;
  f.definition.support_margin = 0.04;
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, list), AMBULO_E_PROBLEM);
  expect_message(list, "empty at t = 0 s (left flat, margin 0.04 m");
  ambulo_diagnostics_free(list);
  row_fixture_close(&f);
}

static int test_zmp_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(box_rows_are_distances),
                                     cmocka_unit_test(hull_rows_are_distances),
                                     cmocka_unit_test(planar_models_have_two_rows),
                                     cmocka_unit_test(normal_force_counts_body_weights),
                                     cmocka_unit_test(events_have_both_regions),
                                     cmocka_unit_test(empty_regions_are_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_support_polygon_tests() + test_zmp_tests();
}
