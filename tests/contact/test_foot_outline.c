/* The flat foot: corners, length, a foot that is built turned out, held points. */
#include "contact/foot_outline.h"
#include "model/neutral_pose.h"
#include "support/walker_fixture.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(corners_lie_as_built), cmocka_unit_test(a_turned_foot_is_put_straight),
      cmocka_unit_test(a_planar_foot_has_two_corners), cmocka_unit_test(modes_hold_their_points)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
