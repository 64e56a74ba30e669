/* Contacts beyond the ends: a step of 0.5 s that travels 0.6 m and rises 0.2 m. */
#include "contact/contact_image.h"
#include "support/patched_walker.h"

static const ambulo_contact contacts[] = {
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.3, .place = {0.0, -0.1, 0.0},
     .normal = {0.1, 0.2, 1.0}, .heading = 0.3},
    {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.3, 0.4, .place = {0.0, -0.1, 0.0},
     .normal = {0.1, 0.2, 1.0}, .heading = 0.3},
    {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.35, 0.5, .place = {0.6, 0.1, 0.2}, .normal = {0, 0, 0},
     .heading = 0.0}};

static ambulo_problem_definition definition_of(ambulo_model *model, ambulo_ends ends) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.duration = 0.5;
  d.travel = 0.6;
  d.rise = 0.2;
  d.ends = ends;
  d.contacts = contacts;
  d.contact_count = 3;
  return d;
}

static void periods_move_on(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_PERIODIC);
  ambulo_contact c = ambulo__contact_image(&d, 0, -1);
  assert_int_equal(c.foot, WALKER_RIGHT);
  assert_close(c.from, -0.5, 1e-15);
  assert_close(c.to, -0.2, 1e-15);
  const double place[3] = {-0.6, -0.1, -0.2};
  for (int i = 0; i < 3; i++) assert_close(c.place[i], place[i], 1e-15);
  assert_close(c.heading, 0.3, 0.0);
  assert_int_equal(ambulo__image_periods(&d), 2);
  d.ends = AMBULO_ENDS_FREE;
  assert_int_equal(ambulo__image_periods(&d), 0);
  ambulo_model_free(model);
}

static void odd_periods_of_mirrored_ends_are_the_other_foot(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_MIRRORED);
  for (int period = -2; period <= 2; period++) {
    int odd = period % 2 != 0;
    ambulo_contact c = ambulo__contact_image(&d, 1, period);
    double side = odd ? -1.0 : 1.0;
    assert_int_equal(c.foot, odd ? WALKER_LEFT : WALKER_RIGHT);
    assert_int_equal(c.mode, AMBULO_CONTACT_TOE);
    assert_close(c.from, 0.3 + 0.5 * period, 1e-15);
    const double place[3] = {0.6 * period, -0.1 * side, 0.2 * period};
    const double normal[3] = {0.1, 0.2 * side, 1.0};
    for (int i = 0; i < 3; i++) assert_close(c.place[i], place[i], 1e-15);
    for (int i = 0; i < 3; i++) assert_close(c.normal[i], normal[i], 0.0);
    assert_close(c.heading, 0.3 * side, 0.0);
    ambulo__span span = ambulo__image_span(&d, 1, period);
    assert_close(span.to, c.to, 0.0);
    assert_int_equal(ambulo__image_effector(&d, 1, period), c.foot);
  }
  ambulo_model_free(model);
}

/* the left heel's stance goes on as the right foot's, mirrored: flat from 0.5, toe to 0.9 s */
static void touching_contacts_of_chosen_modes_are_one_span(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_MIRRORED);
  const ambulo__span heel = {0.35, 0.5, 2, 2};
  static const struct {
    double to;
    int modes, ends;
  } cases[] = {{0.9, AMBULO__ANY_MODE, 1},
               {0.5, 1 << AMBULO_CONTACT_HEEL, 2},
               {0.8, 1 << AMBULO_CONTACT_HEEL | 1 << AMBULO_CONTACT_FLAT, 0},
               {0.5, 1 << AMBULO_CONTACT_HEEL | 1 << AMBULO_CONTACT_TOE, 2}};
  for (int i = 0; i < 4; i++) {
    ambulo__span s = ambulo__uninterrupted(&d, WALKER_LEFT, cases[i].modes, heel);
    assert_close(s.from, 0.35, 1e-15);
    assert_close(s.to, cases[i].to, 1e-12);
    /* which contacts its ends are those of: the heel's, and the right foot's, one period on */
    assert_int_equal(s.begins, 2);
    assert_int_equal(s.ends, cases[i].ends);
  }
  d.ends = AMBULO_ENDS_FREE;
  ambulo__span cut = ambulo__uninterrupted(&d, WALKER_LEFT, AMBULO__ANY_MODE, heel);
  assert_close(cut.to, 0.5, 0.0);
  ambulo__span other =
      ambulo__uninterrupted(&d, WALKER_RIGHT, AMBULO__ANY_MODE, (ambulo__span){0.3, 0.4, 1, 1});
  assert_close(other.from, 0.0, 0.0);
  ambulo_model_free(model);
}

/* a hand of one side is the other one a mirrored step later; a seat is itself, and spans join */
static void odd_periods_of_mirrored_ends_are_the_other_patch(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  ambulo_problem_definition d = definition_of(model, AMBULO_ENDS_MIRRORED);
  const ambulo_contact hands[] = {OF_PATCH(HAND_R, 0.2, 0.5, {0.4, -0.25, 1.2}),
                                  OF_PATCH(HAND_L, 0.0, 0.1, {0.4, 0.25, 1.2}),
                                  OF_PATCH(SEAT, 0.0, 0.5, {0.0, 0.0, 0.4})};
  d.contacts = hands;
  for (int period = -2; period <= 2; period++) {
    int odd = period % 2 != 0;
    ambulo_contact hand = ambulo__contact_image(&d, 0, period);
    assert_int_equal(hand.foot, -1);
    assert_int_equal(hand.mode, AMBULO_CONTACT_PATCH);
    assert_int_equal(hand.patch, odd ? HAND_L : HAND_R);
    assert_close(hand.place[1], odd ? 0.25 : -0.25, 0.0);
    assert_int_equal(ambulo__contact_image(&d, 2, period).patch, SEAT);
    assert_int_equal(ambulo__image_effector(&d, 0, period), 2 + (odd ? HAND_L : HAND_R));
  }
  ambulo__span right =
      ambulo__uninterrupted(&d, 2 + HAND_R, AMBULO__ANY_MODE, (ambulo__span){0.2, 0.5, 0, 0});
  assert_close(right.from, 0.2, 1e-15);
  assert_close(right.to, 0.6, 1e-15); /* the left one's image */
  assert_int_equal(right.ends, 1);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(periods_move_on),
      cmocka_unit_test(odd_periods_of_mirrored_ends_are_the_other_foot),
      cmocka_unit_test(touching_contacts_of_chosen_modes_are_one_span),
      cmocka_unit_test(odd_periods_of_mirrored_ends_are_the_other_patch)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
