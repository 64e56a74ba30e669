/* Axes of a contact's surface, and what a foot in the air swings over. World of the walker: x
 * forward, y up, z right. */
#include "contact/contacts.h"
#include "model/model.h"
#include "model/neutral_pose.h"
#include "support/walker_fixture.h"

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void expect(const double got[3], double x, double y, double z) {
  assert_close(got[0], x, 1e-14);
  assert_close(got[1], y, 1e-14);
  assert_close(got[2], z, 1e-14);
}

static ambulo_problem_definition definition_of(ambulo_model *model) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.ground_height = 0.25;
  return d;
}

static void level_ground_has_the_axes_of_the_world(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model);
  ambulo_contact c = {.place = {0.5, 0.1, 0.0}};
  ambulo__contact_frame frame = ambulo__contact_frame_of(&d, &c);
  expect(frame.origin, 0.5, 0.25, -0.1);
  expect(frame.forward, 1.0, 0.0, 0.0);
  expect(frame.left, 0.0, 0.0, -1.0);
  expect(frame.up, 0.0, 1.0, 0.0);
  assert_true(ambulo__contact_is_level(&c));
  c.normal[2] = 3.0; /* of any length */
  assert_true(ambulo__contact_is_level(&c));
  frame = ambulo__contact_frame_of(&d, &c);
  expect(frame.up, 0.0, 1.0, 0.0);
  c.place[2] = 0.2;
  assert_false(ambulo__contact_is_level(&c));
  frame = ambulo__contact_frame_of(&d, &c);
  expect(frame.origin, 0.5, 0.45, -0.1);
  const double point[3] = {0.6, 0.5, 0.0};
  assert_close(ambulo__contact_frame_along(&frame, frame.up, point), 0.05, 1e-15);
  assert_close(ambulo__contact_frame_along(&frame, frame.left, point), -0.1, 1e-15);
  ambulo_model_free(model);
}

/* a quarter turn to the left: ahead is to the left, to the left is backward */
static void a_heading_turns_about_up(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model);
  ambulo_contact c = {.heading = 0.5 * WALKER_PI};
  ambulo__contact_frame frame = ambulo__contact_frame_of(&d, &c);
  expect(frame.forward, 0.0, 0.0, -1.0);
  expect(frame.left, -1.0, 0.0, 0.0);
  expect(frame.up, 0.0, 1.0, 0.0);
  assert_false(ambulo__contact_is_level(&c));
  ambulo_model_free(model);
}

/* 30 degrees up the slope; whatever the normal's length */
static void a_slope_leans_backward(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model);
  double c30 = cos(WALKER_PI / 6.0);
  ambulo_contact c = {.normal = {-1.0, 0.0, 2.0 * c30}};
  ambulo__contact_frame frame = ambulo__contact_frame_of(&d, &c);
  expect(frame.up, -0.5, c30, 0.0);
  expect(frame.forward, c30, 0.5, 0.0);
  expect(frame.left, 0.0, 0.0, -1.0);
  assert_false(ambulo__contact_is_level(&c));
  ambulo_model_free(model);
}

/* a foot keeps its heading seen from above, on whatever it stands */
static void axes_are_orthonormal_and_ahead_is_where_the_heading_is(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model);
  for (int i = 0; i < 20; i++) {
    ambulo_contact c = {.normal = {sin(1.3 * i), cos(2.1 * i), 1.5}, .heading = 0.3 * (i - 10)};
    ambulo__contact_frame f = ambulo__contact_frame_of(&d, &c);
    const double *axes[3] = {f.forward, f.left, f.up};
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) assert_close(dot(axes[a], axes[b]), a == b, 1e-14);
    double ahead = dot(f.forward, model->forward), aside = dot(f.forward, model->left);
    double of_left[2] = {dot(f.left, model->forward), dot(f.left, model->left)};
    /* across the foot is square to the heading */
    assert_close(of_left[0] * cos(c.heading) + of_left[1] * sin(c.heading), 0.0, 1e-14);
    assert_true(ahead * cos(c.heading) + aside * sin(c.heading) > 0.0);
  }
  ambulo_model_free(model);
}

static void normals_lean_at_most_sixty_degrees(void **state) {
  (void)state;
  static const double legal[][3] = {{0, 0, 0}, {0, 0, 1e-3}, {-1.7, 0, 1}, {3, 4, 5}};
  static const double illegal[][3] = {
      {0, 0, -1}, {1, 0, 0}, {-1.8, 0, 1}, {NAN, 0, 1}, {0, 0, INFINITY}};
  for (int i = 0; i < 4; i++) assert_true(ambulo__contact_normal_is_legal(legal[i]));
  for (int i = 0; i < 5; i++) assert_false(ambulo__contact_normal_is_legal(illegal[i]));
}

static void places_differ_in_any_number(void **state) {
  (void)state;
  const ambulo_contact one = {.place = {0.1, 0.2, 0.3}, .normal = {0.1, 0.2, 1.0}, .heading = 0.4};
  ambulo_contact other = one;
  other.foot = 1;
  other.from = 3.0;
  assert_true(ambulo__contacts_same_place(&one, &other));
  double *numbers[7] = {&other.place[0],  &other.place[1],  &other.place[2], &other.normal[0],
                        &other.normal[1], &other.normal[2], &other.heading};
  for (int i = 0; i < 7; i++) {
    *numbers[i] += 0.01;
    assert_false(ambulo__contacts_same_place(&one, &other));
    *numbers[i] -= 0.01;
    other = one;
  }
}

static void one_contact_off_the_plane_is_enough(void **state) {
  (void)state;
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_contact contacts[3] = {{.foot = 0}, {.foot = 1}, {.foot = 0}};
  d.contacts = contacts;
  d.contact_count = 3;
  assert_true(ambulo__contacts_are_level(&d));
  contacts[2].heading = 0.1;
  assert_false(ambulo__contacts_are_level(&d));
}

/* up a step: high by half-way; down it: still high half-way */
static void a_swing_passes_the_edge_of_a_step(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model);
  ambulo_contact low = {.place = {0.0, 0.1, 0.0}};
  ambulo_contact high = {.place = {0.8, -0.1, 0.2}, .heading = 0.4, .normal = {0.6, 0.0, 1.2}};
  static const double share[] = {0.0, 0.25, 0.5, 0.75, 1.0};
  static const double upward[] = {0.0, 0.1, 0.2, 0.2, 0.2};
  for (int i = 0; i < 5; i++) {
    double along = share[i] * share[i] * (3.0 - 2.0 * share[i]);
    ambulo__contact_frame up = ambulo__contact_frame_between(&d, &low, &high, share[i]);
    ambulo__contact_frame down = ambulo__contact_frame_between(&d, &high, &low, 1.0 - share[i]);
    expect(up.origin, 0.8 * along, 0.25 + upward[i], -(0.1 - 0.2 * along));
    expect(down.origin, up.origin[0], up.origin[1], up.origin[2]);
    ambulo_contact between = {.heading = 0.4 * along,
                              .normal = {0.6 * along, 0.0, 1.0 + 0.2 * along}};
    ambulo__contact_frame axes = ambulo__contact_frame_of(&d, &between);
    expect(up.forward, axes.forward[0], axes.forward[1], axes.forward[2]);
    expect(up.up, axes.up[0], axes.up[1], axes.up[2]);
    expect(down.up, axes.up[0], axes.up[1], axes.up[2]);
  }
  ambulo_model_free(model);
}

/* a wall ahead, one behind, one to the right: forward is up where the heading runs into it */
static void walls_have_up_for_forward(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model);
  ambulo_contact c = {.foot = -1, .mode = AMBULO_CONTACT_PATCH, .normal = {-2.0, 0.0, 0.0}};
  ambulo__contact_frame frame = ambulo__contact_frame_of(&d, &c);
  expect(frame.up, -1.0, 0.0, 0.0);
  expect(frame.forward, 0.0, 1.0, 0.0);
  expect(frame.left, 0.0, 0.0, -1.0);
  c.normal[0] = 1.0;
  frame = ambulo__contact_frame_of(&d, &c);
  expect(frame.forward, 0.0, 1.0, 0.0);
  expect(frame.left, 0.0, 0.0, 1.0);
  c.normal[0] = 0.0;
  c.normal[1] = 1.0;
  frame = ambulo__contact_frame_of(&d, &c);
  expect(frame.up, 0.0, 0.0, -1.0);
  expect(frame.forward, 1.0, 0.0, 0.0);
  expect(frame.left, 0.0, -1.0, 0.0);
  /* leaning by 32 degrees from the heading, to one side: forward is still that of the heading */
  c.normal[0] = -0.8;
  c.normal[1] = 0.3;
  c.normal[2] = 0.5;
  frame = ambulo__contact_frame_of(&d, &c);
  assert_close(dot(frame.left, model->forward), 0.0, 1e-14);
  c.normal[0] = c.normal[1] = c.normal[2] = 0.0;
  /* a ceiling */
  c.normal[1] = 0.0;
  c.normal[2] = -1.0;
  frame = ambulo__contact_frame_of(&d, &c);
  expect(frame.up, 0.0, -1.0, 0.0);
  expect(frame.forward, 1.0, 0.0, 0.0);
  /* the steepest ground that feet stand on has the heading for forward */
  ambulo_contact steep = {.normal = {-sqrt(3.0), 0.0, 1.0}};
  assert_true(ambulo__contact_normal_is_legal(steep.normal));
  frame = ambulo__contact_frame_of(&d, &steep);
  expect(frame.forward, 0.5, 0.5 * sqrt(3.0), 0.0);
  ambulo_model_free(model);
}

static int test_contact_frame_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(level_ground_has_the_axes_of_the_world),
      cmocka_unit_test(a_heading_turns_about_up),
      cmocka_unit_test(a_slope_leans_backward),
      cmocka_unit_test(axes_are_orthonormal_and_ahead_is_where_the_heading_is),
      cmocka_unit_test(normals_lean_at_most_sixty_degrees),
      cmocka_unit_test(places_differ_in_any_number),
      cmocka_unit_test(one_contact_off_the_plane_is_enough),
      cmocka_unit_test(a_swing_passes_the_edge_of_a_step),
      cmocka_unit_test(walls_have_up_for_forward)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The flat foot: corners, length, a foot that is built turned out, held points. */

static void corners_lie_as_built(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo__foot_outline outline = ambulo__foot_outline_of(model, WALKER_LEFT);
  static const double expected[4][2] = {{0.0, 0.04}, {0.0, -0.04}, {0.22, 0.04}, {0.22, -0.04}};
  assert_int_equal(outline.count, 4);
  assert_int_equal(outline.moves_sideways, 1);
  assert_close(outline.length, 0.22, 1e-15);
  for (int c = 0; c < 4; c++) {
    assert_int_equal(outline.is_heel[c], c < 2);
    assert_close(outline.place[c][0], expected[c][0], 1e-15);
    assert_close(outline.place[c][1], expected[c][1], 1e-15);
  }
  ambulo_model_free(model);
}

/* A toe centre built 0.1 m to the right comes to lie straight ahead: the outline turns by
 * atan(0.1 / 0.22) to the left. */
static void a_turned_foot_is_put_straight(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  int toe = model->feet[WALKER_RIGHT].toe_center;
  model->points[toe].position[2] = 0.1;
  ambulo__neutral_points(model);
  ambulo__foot_outline outline = ambulo__foot_outline_of(model, WALKER_RIGHT);
  double angle = atan2(0.1, 0.22), c = cos(angle), s = sin(angle);
  assert_close(outline.length, hypot(0.22, 0.1), 1e-15);
  assert_close(outline.place[3][0], c * 0.22 - s * -0.04, 1e-14);
  assert_close(outline.place[3][1], s * 0.22 + c * -0.04, 1e-14);
  ambulo_model_free(model);
}

static void a_planar_foot_has_two_corners(void **state) {
  (void)state;
  ambulo_model *model = walker_create(1);
  ambulo__foot_outline outline = ambulo__foot_outline_of(model, WALKER_LEFT);
  assert_int_equal(outline.count, 2);
  assert_int_equal(outline.moves_sideways, 0);
  assert_close(outline.place[1][0] - outline.place[0][0], 0.22, 1e-15);
  ambulo_model_free(model);
}

static void modes_hold_their_points(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition definition = ambulo_problem_definition_default();
  double place[3];
  definition.model = model;
  ambulo_contact contact = {.foot = WALKER_LEFT, .place = {0.6, 0.09}};
  for (int mode = AMBULO_CONTACT_HEEL; mode <= AMBULO_CONTACT_TOE; mode++) {
    contact.mode = (ambulo_contact_mode)mode;
    int toe = mode == AMBULO_CONTACT_TOE;
    ambulo__foot_outline outline = ambulo__foot_outline_of(model, WALKER_LEFT);
    int point = ambulo__contact_point(&definition, &outline, &contact, place);
    assert_string_equal(model->points[point].name, toe ? "l_toe" : "l_heel");
    double along[2] = {0.0, 0.0};
    for (int i = 0; i < 3; i++) {
      along[0] += place[i] * model->forward[i];
      along[1] += place[i] * model->left[i];
    }
    assert_close(along[0], toe ? 0.82 : 0.6, 1e-15);
    assert_close(along[1], 0.09, 0.0);
    assert_int_equal(ambulo__corner_in_contact(contact.mode, 1), !toe);
    assert_int_equal(ambulo__corner_in_contact(contact.mode, 0), mode != AMBULO_CONTACT_HEEL);
  }
  ambulo_model_free(model);
}

static int test_foot_outline_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(corners_lie_as_built), cmocka_unit_test(a_turned_foot_is_put_straight),
      cmocka_unit_test(a_planar_foot_has_two_corners), cmocka_unit_test(modes_hold_their_points)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_contact_frame_tests() + test_foot_outline_tests();
}
