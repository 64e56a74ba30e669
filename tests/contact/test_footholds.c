/* Places of contacts against each other: within reach, and again where a motion repeats. */
#include "ambulo/tools/tools.h"
#include "contact/row_families.h"
#include "contact/schedule.h"
#include "model/model.h"
#include "support/messages.h"
#include "support/patched_walker.h"
#include "support/planar_walker.h"
#include "support/row_fixture.h"
#include "support/test.h"

/* Footholds at T against those at 0, through ambulo_gait_expand: which numbers of steps go with
 * which ends, and travels that do not fit. */

enum { MOST_CONTACTS = 64 };

typedef struct fixture {
  ambulo_model *model;
  ambulo_problem_definition definition;
  ambulo_contact contacts[MOST_CONTACTS];
} fixture;

static void open_fixture(fixture *f, const ambulo_gait *gait) {
  f->model = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &f->model),
                   AMBULO_OK);
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.foot_strike = 1;
  assert_int_equal(
      ambulo_gait_expand(f->model, gait, f->contacts, MOST_CONTACTS, &f->definition.contact_count),
      AMBULO_OK);
  f->definition.contacts = f->contacts;
  f->definition.duration = ambulo__gait_strike(gait, gait->steps);
  f->definition.travel = ambulo__gait_place(gait, gait->steps);
}

static void expect(fixture *f, const char *phrase) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo__schedule_check_ends(&f->definition, list);
  if (phrase) assert_message(list, 0, phrase);
  assert_int_equal(status, phrase ? AMBULO_E_PROBLEM : AMBULO_OK);
  ambulo_diagnostics_free(list);
  ambulo_model_free(f->model);
}

static ambulo_gait walk(int steps) {
  ambulo_gait gait = {.size = sizeof(ambulo_gait),
                      .contact_size = sizeof(ambulo_contact),
                      .steps = steps,
                      .first_foot = 1,
                      .step_length = 0.6,
                      .step_time = 0.5,
                      .step_width = 0.1,
                      .foot_flat = 0.08,
                      .heel_off = 0.38,
                      .toe_off = 0.62,
                      .other_step_length = AMBULO_OFF,
                      .other_step_time = AMBULO_OFF};
  return gait;
}

/* also when the strike comes early; a foot that comes down after T is down at neither end */
static void odd_steps_mirrored_even_steps_periodic(void **state) {
  (void)state;
  static const double strikes[] = {-0.07, 0.0};
  for (int steps = 1; steps <= 5; steps++) {
    for (int s = 0; s < 2; s++) {
      for (int ends = AMBULO_ENDS_FREE; ends <= AMBULO_ENDS_MIRRORED; ends++) {
        fixture f;
        ambulo_gait gait = walk(steps);
        gait.heel_strike = strikes[s];
        open_fixture(&f, &gait);
        f.definition.ends = (ambulo_ends)ends;
        int fits = ends == AMBULO_ENDS_FREE || (ends == AMBULO_ENDS_MIRRORED) == (steps % 2);
        expect(&f,
               fits ? NULL
                    : "mirrored ends go with an odd number of equal steps, periodic ends with an "
                      "even number");
      }
    }
  }
}

static void the_message_has_both_places(void **state) {
  (void)state;
  fixture f;
  ambulo_gait gait = walk(1);
  open_fixture(&f, &gait);
  f.definition.ends = AMBULO_ENDS_MIRRORED;
  f.definition.travel = 0.5;
  expect(&f,
         "ends.travel: foot 'left' stands at (0, 0.05) m at t = 0.5 s, but mirrored ends with a "
         "travel of 0.5 m put it at (-0.1, 0.05) m, from foot 'right' at (-0.6, -0.05) m at "
         "t = 0; expected the same place");
}

/* footholds 0.02 m further left than the mirror plane allows */
static void the_walk_straddles_the_mirror_plane(void **state) {
  (void)state;
  for (int ends = AMBULO_ENDS_PERIODIC; ends <= AMBULO_ENDS_MIRRORED; ends++) {
    fixture f;
    ambulo_gait gait = walk(ends == AMBULO_ENDS_PERIODIC ? 2 : 1);
    open_fixture(&f, &gait);
    for (int i = 0; i < f.definition.contact_count; i++) f.contacts[i].place[1] += 0.02;
    f.definition.ends = (ambulo_ends)ends;
    expect(&f, ends == AMBULO_ENDS_PERIODIC ? NULL : "put it at (0, 0.03) m");
  }
}

static void unlike_steps_repeat_after_two(void **state) {
  (void)state;
  for (int steps = 1; steps <= 2; steps++) {
    fixture f;
    ambulo_gait gait = walk(steps);
    gait.other_step_length = 0.7;
    open_fixture(&f, &gait);
    f.definition.ends = steps == 1 ? AMBULO_ENDS_MIRRORED : AMBULO_ENDS_PERIODIC;
    expect(&f, steps == 1 ? "expected the same place" : NULL);
  }
}

/* places that enter no row say nothing */
static void only_where_places_are_rows(void **state) {
  (void)state;
  for (int use = 0; use < 5; use++) {
    fixture f;
    ambulo_gait gait = walk(1);
    open_fixture(&f, &gait);
    f.definition.ends = AMBULO_ENDS_MIRRORED;
    f.definition.travel = 0.5;
    f.definition.foot_strike = use == 1;
    f.definition.contact_tolerance = use == 2 ? 0.002 : 0.0;
    f.definition.support = use == 3 ? AMBULO_SUPPORT_BOX : AMBULO_SUPPORT_OFF;
    if (use == 4) f.definition.ground_reaction.kind = AMBULO_REACTION_SHARED;
    expect(&f, use ? "expected the same place" : NULL);
  }
}

/* a step up whose foot is turned or leans begins the next one as it began */
static void footholds_of_any_kind_go_on_as_they_began(void **state) {
  (void)state;
  static const struct {
    int number; /* which is changed: 0 height, 1 heading, 2 to 4 the normal */
    double first, last;
    const char *phrase;
  } cases[] = {
      {0, 0.0, 0.2, NULL},   {0, 0.1, 0.2, "ends.rise: foot 'right' stands 0.2 m high"},
      {1, 0.1, -0.1, NULL},  {1, 0.1, 0.1, "is turned by 0.1 rad at t = 0.5 s, and by -0.1 rad"},
      {2, -0.1, -0.1, NULL}, {2, -0.1, 0.0, "expected the same direction"},
      {3, 0.1, -0.1, NULL},  {3, 0.1, 0.1, "expected the same direction"},
      {4, 1.0, 2.0, NULL}}; /* of any length */
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    fixture f;
    ambulo_gait gait = walk(1);
    open_fixture(&f, &gait);
    f.definition.ends = AMBULO_ENDS_MIRRORED;
    f.definition.rise = 0.2;
    for (int i = 0; i < f.definition.contact_count; i++) {
      ambulo_contact *c = &f.contacts[i];
      /* the foot ahead is down at 0 as the left one, at T as the right one; the one behind it */
      int last = c->to >= 0.5 && c->place[0] > 0.5, before = c->place[0] < -0.3;
      double rise = last ? 0.2 : before ? -0.2 : 0.0;
      double *number[5] = {&c->place[2], &c->heading, &c->normal[0], &c->normal[1], &c->normal[2]};
      c->place[2] = rise;
      c->normal[2] = 1.0;
      if (c->from <= 0.0 && !before && !last)
        *number[cases[k].number] = cases[k].number ? cases[k].first : rise + cases[k].first;
      if (last) *number[cases[k].number] = cases[k].last;
    }
    expect(&f, cases[k].phrase);
  }
}

/* a seat that goes on stands where it stood, moved on; of a mirrored motion on the other side */
static void patches_go_on_too(void **state) {
  (void)state;
  static const double place[2][2] = {{0.5, 0.2}, {0.5, -0.2}};
  for (int mirrored = 0; mirrored < 2; mirrored++) {
    for (int off = 0; off < 4; off++) {
      const ambulo_contact contacts[] = {OF_PATCH(HAND_R, 0.0, 0.4, {0.0, 0.2, 1.0}),
                                         OF_PATCH(HAND_R, 0.7, 1.0, {0.5, 0.2, 1.0})};
      fixture f = {.model = patched_walker(0)};
      memcpy(f.contacts, contacts, sizeof contacts);
      f.definition = ambulo_problem_definition_default();
      f.definition.model = f.model;
      f.definition.foot_strike = 1;
      f.definition.contacts = f.contacts;
      f.definition.contact_count = 2;
      f.definition.travel = 0.5;
      f.definition.ends = mirrored ? AMBULO_ENDS_MIRRORED : AMBULO_ENDS_PERIODIC;
      memcpy(f.contacts[1].place, place[mirrored], sizeof place[mirrored]);
      if (mirrored) f.contacts[1].patch = HAND_L;
      if (off == 1) f.contacts[1].place[0] += 0.1;
      if (off == 2) f.contacts[1].place[2] += 0.1;
      if (off == 3) f.contacts[1].normal[0] = -1.0;
      static const char *const said[] = {NULL, "ends.travel: patch 'hand_",
                                         "ends.rise: patch 'hand_", "contacts: patch 'hand_"};
      expect(&f, said[off]);
    }
  }
}

/* Footholds within and beyond the legs' length.
 *
 * From heel to heel: 2 (|(0.08, 0.05)| + 0.42 + |(0.42, 0.09)|) = 1.887749 m. */

static ambulo_status check_within(double tolerance, double apart, double left_to, double right_from,
                                  int strike, ambulo_diagnostics *list) {
  row_fixture f;
  row_fixture_open(&f, 0);
  const ambulo_contact contacts[] = {
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, left_to, .place = {0.0, 0.0}},
      {WALKER_RIGHT, AMBULO_CONTACT_HEEL, right_from, 1.0, .place = {apart, 0.0}}};
  f.definition.contacts = contacts;
  f.definition.contact_count = 2;
  f.definition.foot_strike = strike;
  f.definition.contact_tolerance = tolerance;
  int active[2 * ROW_NODES];
  assert_int_equal(ambulo__schedule_fill(&f.definition, f.times, ROW_NODES, active, NULL),
                   AMBULO_OK);
  ambulo_status status =
      ambulo__schedule_check_reach(&f.definition, f.times, ROW_NODES, active, list);
  row_fixture_close(&f);
  return status;
}

static ambulo_status check(double apart, double left_to, double right_from, int strike,
                           ambulo_diagnostics *list) {
  return check_within(0.0, apart, left_to, right_from, strike, list);
}

/* contacts within a tolerance are compared too, each end of the legs that much closer */
static void a_tolerance_shortens_the_way(void **state) {
  (void)state;
  double reach = 2.0 * (hypot(0.08, 0.05) + 0.42 + hypot(0.42, 0.09)) + 2.0 * sqrt(3.0) * 0.01;
  assert_int_equal(check_within(0.01, reach - 1e-6, 0.6, 0.4, 0, NULL), AMBULO_OK);
  assert_int_equal(check_within(0.01, reach + 1e-6, 0.6, 0.4, 0, NULL), AMBULO_E_PROBLEM);
}

static void the_limit_is_the_length_of_the_legs(void **state) {
  (void)state;
  double reach = 2.0 * (hypot(0.08, 0.05) + 0.42 + hypot(0.42, 0.09));
  assert_close(reach, 1.887749, 1e-6);
  assert_int_equal(check(reach - 1e-6, 0.6, 0.4, 1, NULL), AMBULO_OK);
  assert_int_equal(check(reach + 1e-6, 0.6, 0.4, 1, NULL), AMBULO_E_PROBLEM);
  assert_int_equal(check(reach + 1e-6, 0.6, 0.4, 0, NULL), AMBULO_OK);
}

static void feet_that_hand_over_are_compared(void **state) {
  (void)state;
  assert_int_equal(check(2.0, 0.6, 0.6, 1, NULL), AMBULO_E_PROBLEM);
}

static void the_message_says_where_and_how_far(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(check(2.0, 0.6, 0.4, 1, list), AMBULO_E_PROBLEM);
  expect_message(list, "contacts[0] (foot 'left') and contacts[1] (foot 'right') are out of reach "
                       "at t = 0.5 s: 2 m apart; expected at most 1.888 m");
  ambulo_diagnostics_free(list);
}

/* on its toes a foot is held by them, ahead of its foothold by its length of 0.22 m */
static void toes_are_held_ahead_of_the_foothold(void **state) {
  (void)state;
  double reach = 0.42 + 2.0 * hypot(0.42, 0.09) + 0.42 + hypot(0.08, 0.05) + hypot(0.08, 0.17);
  for (int beyond = 0; beyond < 2; beyond++) {
    row_fixture f;
    row_fixture_open(&f, 0);
    const ambulo_contact contacts[] = {
        {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.0, 0.6, .place = {0.0, 0.0}},
        {WALKER_RIGHT, AMBULO_CONTACT_HEEL, 0.4, 1.0,
         .place = {0.22 + reach + (beyond ? 1e-6 : -1e-6), 0.0}}};
    f.definition.contacts = contacts;
    f.definition.contact_count = 2;
    f.definition.foot_strike = 1;
    int active[2 * ROW_NODES];
    assert_int_equal(ambulo__schedule_fill(&f.definition, f.times, ROW_NODES, active, NULL),
                     AMBULO_OK);
    assert_int_equal(ambulo__schedule_check_reach(&f.definition, f.times, ROW_NODES, active, NULL),
                     beyond ? AMBULO_E_PROBLEM : AMBULO_OK);
    row_fixture_close(&f);
  }
}

static int reach_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_limit_is_the_length_of_the_legs),
                                     cmocka_unit_test(feet_that_hand_over_are_compared),
                                     cmocka_unit_test(a_tolerance_shortens_the_way),
                                     cmocka_unit_test(the_message_says_where_and_how_far),
                                     cmocka_unit_test(toes_are_held_ahead_of_the_foothold)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

static int ends_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(odd_steps_mirrored_even_steps_periodic),
                                     cmocka_unit_test(the_message_has_both_places),
                                     cmocka_unit_test(the_walk_straddles_the_mirror_plane),
                                     cmocka_unit_test(unlike_steps_repeat_after_two),
                                     cmocka_unit_test(only_where_places_are_rows),
                                     cmocka_unit_test(footholds_of_any_kind_go_on_as_they_began),
                                     cmocka_unit_test(patches_go_on_too)};
  return cmocka_run_group_tests_name("contact/footholds", tests, NULL, NULL);
}

int main(void) {
  return reach_tests() + ends_tests();
}
