/* Footholds within and beyond the legs' length.
 *
 * From heel to heel: 2 (|(0.08, 0.05)| + 0.42 + |(0.42, 0.09)|) = 1.887749 m. */
#include "support/row_fixture.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_limit_is_the_length_of_the_legs),
                                     cmocka_unit_test(feet_that_hand_over_are_compared),
                                     cmocka_unit_test(a_tolerance_shortens_the_way),
                                     cmocka_unit_test(the_message_says_where_and_how_far),
                                     cmocka_unit_test(toes_are_held_ahead_of_the_foothold)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
