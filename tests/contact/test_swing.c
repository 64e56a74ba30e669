/* Between which contacts a foot in the air is: right foot down 0 .. 0.3 s and 0.8 .. 1 s. */
#include "contact/swing.h"
#include "support/walker_fixture.h"

static const ambulo_contact contacts[] = {
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.2, .place = {0.0, -0.1, 0.0}, .normal = {0, 0, 0},
     .heading = 0.1},
    {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.2, 0.3, .place = {0.0, -0.1, 0.0}, .normal = {0, 0, 0},
     .heading = 0.1},
    {WALKER_RIGHT, AMBULO_CONTACT_HEEL, 0.8, 1.0, .place = {0.9, -0.1, 0.3},
     .normal = {-0.1, 0.2, 1.0}, .heading = 0.2},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.2, 0.7, .place = {0.5, 0.1, 0.15}, .normal = {0, 0, 0},
     .heading = 0.0}};

static ambulo_problem_definition definition_of(ambulo_model *model, ambulo_ends ends) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.contacts = contacts;
  d.contact_count = 4;
  d.ends = ends;
  d.travel = 1.0;
  d.rise = 0.3;
  return d;
}

static void a_swing_is_between_its_neighbours(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_FREE);
  ambulo_contact from, to;
  static const double time[] = {0.3, 0.5, 0.8};
  for (int i = 0; i < 3; i++) { /* at its ends too */
    assert_int_equal(ambulo__swing_contacts(&d, WALKER_RIGHT, time[i], &from, &to), 1);
    assert_int_equal(from.mode, AMBULO_CONTACT_TOE);
    assert_int_equal(to.mode, AMBULO_CONTACT_HEEL);
    assert_close(to.place[2], 0.3, 0.0);
  }
  ambulo_model_free(model);
}

static void a_cut_motion_knows_one_side(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_FREE);
  ambulo_contact from, to;
  assert_int_equal(ambulo__swing_contacts(&d, WALKER_LEFT, 0.1, &from, &to), 1);
  assert_close(from.from, 0.2, 0.0);
  assert_close(to.from, 0.2, 0.0);
  assert_int_equal(ambulo__swing_contacts(&d, WALKER_LEFT, 0.9, &from, &to), 1);
  assert_close(from.to, 0.7, 0.0);
  assert_close(to.to, 0.7, 0.0);
  d.contact_count = 3;
  assert_int_equal(ambulo__swing_contacts(&d, WALKER_LEFT, 0.9, &from, &to), 0);
  ambulo_model_free(model);
}

/* left, periodic: comes from the period before, lower by the rise, and goes to the next one */
static void a_repeating_motion_goes_on(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_PERIODIC);
  ambulo_contact from, to;
  assert_int_equal(ambulo__swing_contacts(&d, WALKER_LEFT, 0.1, &from, &to), 1);
  assert_close(from.to, -0.3, 1e-12);
  assert_close(from.place[0], -0.5, 1e-12);
  assert_close(from.place[2], -0.15, 1e-12);
  assert_close(to.place[0], 0.5, 1e-12);
  /* mirrored: the right heel that is down up to -0.0 s of the period before is the left's */
  d.ends = AMBULO_ENDS_MIRRORED;
  assert_int_equal(ambulo__swing_contacts(&d, WALKER_LEFT, 0.1, &from, &to), 1);
  assert_int_equal(from.mode, AMBULO_CONTACT_HEEL);
  assert_close(from.to, 0.0, 1e-12);
  assert_close(from.place[0], -0.1, 1e-12);
  assert_close(from.place[1], 0.1, 1e-12);
  assert_close(from.place[2], 0.0, 1e-12);
  assert_close(from.normal[1], -0.2, 0.0);
  assert_close(from.heading, -0.2, 0.0);
  ambulo_model_free(model);
}

static void corners_stay_above_the_lower_of_both(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_FREE);
  d.ground_height = 0.05;
  ambulo__contact_frame swing = ambulo__surface_below(&d, WALKER_RIGHT, 0.5);
  assert_close(swing.origin[1], 0.05, 1e-15); /* of the contact that it leaves */
  ambulo__contact_frame down = ambulo__surface_below(&d, WALKER_RIGHT, 0.9);
  assert_close(down.origin[1], 0.35, 1e-15);
  assert_true(down.up[0] < -0.05);
  d.ends = AMBULO_ENDS_PERIODIC; /* right after 1 s is where it was at 0 s, 0.3 m higher */
  ambulo__contact_frame left = ambulo__surface_below(&d, WALKER_LEFT, 0.9);
  assert_close(left.origin[1], 0.2, 1e-15);
  d.ends = AMBULO_ENDS_FREE;
  d.contact_count = 3;
  ambulo__contact_frame none = ambulo__surface_below(&d, WALKER_LEFT, 0.5);
  assert_close(none.origin[1], 0.05, 1e-15);
  assert_close(none.up[1], 1.0, 0.0);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_swing_is_between_its_neighbours),
                                     cmocka_unit_test(a_cut_motion_knows_one_side),
                                     cmocka_unit_test(a_repeating_motion_goes_on),
                                     cmocka_unit_test(corners_stay_above_the_lower_of_both)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
