/* Feet and patches in one numbering. */
#include "contact/contacts.h"
#include "contact/row_families.h"
#include "support/patched_walker.h"
#include "support/walker_fixture.h"

static void feet_come_first(void **state) {
  (void)state;
  static const char *const names[] = {"right", "left", "hand_r", "hand_l", "seat"};
  static const int mirrors[] = {1, 0, 3, 2, 4};
  ambulo_model *model = patched_walker(0);
  assert_int_equal(ambulo__effector_count(model), 5);
  for (int e = 0; e < 5; e++) {
    ambulo_contact of_foot = {.foot = e}, of_patch = OF_PATCH(e - 2, 0.0, 1.0, {0.0});
    assert_int_equal(ambulo__effector_of(model, e < 2 ? &of_foot : &of_patch), e);
    assert_int_equal(ambulo__effector_patch(model, e), e < 2 ? -1 : e - 2);
    assert_int_equal(ambulo__effector_mirror(model, e), mirrors[e]);
    assert_string_equal(ambulo__effector_name(model, e), names[e]);
    assert_string_equal(ambulo__effector_kind(model, e), e < 2 ? "foot" : "patch");
  }
  ambulo_model_free(model);
}

static void contacts_of_what_is_not_there_are_unknown(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  const ambulo_contact good[] = {{.foot = 1}, OF_PATCH(SEAT, 0.0, 1.0, {0.0})};
  const ambulo_contact bad[] = {{.foot = 2},
                                {.foot = -1, .patch = 0},
                                {.foot = 0, .mode = AMBULO_CONTACT_PATCH},
                                OF_PATCH(3, 0.0, 1.0, {0.0}),
                                OF_PATCH(-1, 0.0, 1.0, {0.0})};
  for (int i = 0; i < 2; i++) assert_true(ambulo__effector_is_known(model, &good[i]));
  for (int i = 0; i < 5; i++) assert_false(ambulo__effector_is_known(model, &bad[i]));
  ambulo_model_free(model);
}

/* of a mirrored step also the hand on the other side, which is down in the next one */
static void patches_are_used_where_they_are_in_contact(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  const ambulo_contact contacts[] = {{.foot = 0, .to = 1.0}, OF_PATCH(HAND_L, 0.0, 1.0, {0.0})};
  ambulo_problem_definition d = {.model = model, .contacts = contacts, .contact_count = 2};
  for (int ends = AMBULO_ENDS_FREE; ends <= AMBULO_ENDS_MIRRORED; ends++) {
    d.ends = (ambulo_ends)ends;
    assert_true(ambulo__patch_is_used(&d, HAND_L));
    assert_int_equal(ambulo__patch_is_used(&d, HAND_R), ends == AMBULO_ENDS_MIRRORED);
    assert_false(ambulo__patch_is_used(&d, SEAT));
  }
  ambulo_model_free(model);
}

static int test_effector_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(feet_come_first),
                                     cmocka_unit_test(contacts_of_what_is_not_there_are_unknown),
                                     cmocka_unit_test(patches_are_used_where_they_are_in_contact)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Contacts beyond the ends: a step of 0.5 s that travels 0.6 m and rises 0.2 m. */

static const ambulo_contact two_feet[] = {
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
  d.contacts = two_feet;
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

static int test_contact_image_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(periods_move_on),
      cmocka_unit_test(odd_periods_of_mirrored_ends_are_the_other_foot),
      cmocka_unit_test(touching_contacts_of_chosen_modes_are_one_span),
      cmocka_unit_test(odd_periods_of_mirrored_ends_are_the_other_patch)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* How long feet are down and in the air: a mirrored step of 0.5 s, left strikes at 0, phases 0 /
 * 0.1 / 0.4 / 0.6 of the stride of 1 s: double support from 0 to 0.1 s. Heel to toe 0.22 m. */

typedef struct fixture {
  ambulo_model *model;
  ambulo_contact contacts[12];
  ambulo_problem_definition definition;
} fixture;

static void open_with(fixture *f, double heel_strike) {
  f->model = walker_create(0);
  ambulo_gait gait = {.size = sizeof(ambulo_gait),
                      .contact_size = sizeof(ambulo_contact),
                      .steps = 1,
                      .first_foot = WALKER_LEFT,
                      .step_length = 0.6,
                      .step_time = 0.5,
                      .step_width = 0.18,
                      .heel_strike = heel_strike,
                      .foot_flat = 0.1 + heel_strike,
                      .heel_off = 0.4 + heel_strike,
                      .toe_off = 0.6 + heel_strike,
                      .other_step_length = AMBULO_OFF,
                      .other_step_time = AMBULO_OFF};
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.duration = 0.5;
  f->definition.ends = AMBULO_ENDS_MIRRORED;
  f->definition.contacts = f->contacts;
  assert_int_equal(
      ambulo_gait_expand(f->model, &gait, f->contacts, 12, &f->definition.contact_count), 0);
}

/* with strikes 0.05 s early the double support spans both ends: half of it is over at 0 */
static void double_support_goes_on_beyond_the_ends(void **state) {
  (void)state;
  fixture f;
  open_with(&f, -0.05);
  ambulo__span span;
  assert_int_equal(ambulo__loaded_span(&f.definition, WALKER_LEFT, 0.0, &span), 1);
  assert_close(span.from, -0.05, 1e-12);
  assert_close(span.to, 0.55, 1e-12);
  f.definition.ends = AMBULO_ENDS_FREE;
  assert_int_equal(ambulo__loaded_span(&f.definition, WALKER_LEFT, 0.0, &span), 1);
  assert_close(span.from, 0.0, 1e-12);
  ambulo_model_free(f.model);
}

static void time_in_the_air(void **state) {
  (void)state;
  fixture f;
  open_with(&f, 0.0);
  ambulo__span air = ambulo__air_span(&f.definition, WALKER_RIGHT, 0.2);
  assert_close(air.from, 0.1, 1e-12);
  assert_close(air.to, 0.5, 1e-12);
  ambulo__span span;
  assert_int_equal(ambulo__loaded_span(&f.definition, WALKER_RIGHT, 0.2, &span), 0);
  ambulo_model_free(f.model);
}

/* whose times a span has */
static void spans_know_their_contacts(void **state) {
  (void)state;
  fixture f;
  ambulo__span span;
  open_with(&f, -0.05);
  const ambulo_contact *c = f.contacts;
  assert_int_equal(ambulo__loaded_span(&f.definition, WALKER_LEFT, 0.0, &span), 1);
  assert_int_equal(c[span.begins].foot, WALKER_RIGHT); /* the mirror image of what strikes at .45 */
  assert_close(c[span.begins].from - 0.5, span.from, 1e-12);
  assert_int_equal(c[span.ends].foot, WALKER_RIGHT);
  assert_close(c[span.ends].to + 0.5, span.to, 1e-12);
  span = ambulo__air_span(&f.definition, WALKER_RIGHT, 0.2);
  assert_close(c[span.begins].to, span.from, 1e-12);
  assert_close(c[span.ends].from, span.to, 1e-12);
  f.definition.ends = AMBULO_ENDS_FREE;
  span = ambulo__air_span(&f.definition, WALKER_LEFT, 0.02);
  assert_int_equal(span.begins, -1);
  ambulo_model_free(f.model);
}

static int test_loading_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(double_support_goes_on_beyond_the_ends),
                                     cmocka_unit_test(time_in_the_air),
                                     cmocka_unit_test(spans_know_their_contacts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_effector_tests() + test_contact_image_tests() + test_loading_tests();
}
