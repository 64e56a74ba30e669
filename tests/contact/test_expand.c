/* Expansion of a regular gait: the whole table, cutting at the ends, refusals. */
#include "contact/gait.h"
#include "support/walker_fixture.h"

static ambulo_gait two_steps(void) {
  ambulo_gait gait = {.size = sizeof(ambulo_gait),
                      .contact_size = sizeof(ambulo_contact),
                      .steps = 2,
                      .first_foot = WALKER_LEFT,
                      .step_length = 0.6,
                      .step_time = 0.7,
                      .step_width = 0.18,
                      .start = 0.05,
                      .heel_strike = -1.0 / 14.0,
                      .foot_flat = 1.0 / 14.0,
                      .heel_off = 6.0 / 14.0,
                      .toe_off = 8.0 / 14.0,
                      .other_step_length = AMBULO_OFF,
                      .other_step_time = AMBULO_OFF};
  return gait;
}

/* stride 1.4 s: a fourteenth of it is 0.1 s */
static void the_table_is_as_written_by_hand(void **state) {
  (void)state;
  static const ambulo_contact expected[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.0, 0.1, .place = {-0.55, -0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.1, .place = {0.05, 0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.1, 0.6, .place = {0.05, 0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.6, 0.8, .place = {0.05, 0.09}},
      {WALKER_RIGHT, AMBULO_CONTACT_HEEL, 0.6, 0.8, .place = {0.65, -0.09}},
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.8, 1.3, .place = {0.65, -0.09}},
      {WALKER_RIGHT, AMBULO_CONTACT_TOE, 1.3, 1.4, .place = {0.65, -0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_HEEL, 1.3, 1.4, .place = {1.25, 0.09}}};
  ambulo_model *model = walker_create(0);
  ambulo_gait gait = two_steps();
  ambulo_contact contacts[8];
  int count = 0;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 8, &count), AMBULO_OK);
  assert_int_equal(count, 8);
  for (int i = 0; i < 8; i++) {
    assert_int_equal(contacts[i].foot, expected[i].foot);
    assert_int_equal(contacts[i].mode, expected[i].mode);
    assert_close(contacts[i].from, expected[i].from, 1e-14);
    assert_close(contacts[i].to, expected[i].to, 1e-14);
    assert_close(contacts[i].place[0], expected[i].place[0], 1e-14);
    assert_close(contacts[i].place[1], expected[i].place[1], 1e-14);
  }
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 3, &count), AMBULO_E_LIMIT);
  assert_int_equal(count, 8);
  ambulo_model_free(model);
}

/* A foot that strikes exactly at the end is in contact at that instant; phases of no
 * length do not appear. */
static void the_last_instant_counts(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_gait gait = two_steps();
  gait.heel_strike = 0.0;
  gait.foot_flat = 0.0;
  gait.toe_off = gait.heel_off = 0.5;
  ambulo_contact contacts[16];
  int count = 0;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 16, &count), AMBULO_OK);
  assert_int_equal(count, 3);
  for (int i = 0; i < count; i++) assert_int_equal(contacts[i].mode, AMBULO_CONTACT_FLAT);
  assert_int_equal(contacts[2].foot, WALKER_LEFT);
  assert_close(contacts[2].from, 1.4, 1e-14);
  assert_close(contacts[2].to, 1.4, 1e-14);
  ambulo_model_free(model);
}

/* toes, sole, toes; a stance of less than half a stride leaves times without contact */
static void feet_may_land_on_their_toes(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_gait gait = two_steps();
  ambulo_contact contacts[16];
  int count = 0;
  gait.heel_strike = 0.0;
  gait.heel_off = 4.0 / 14.0;
  gait.toe_off = 5.0 / 14.0;
  gait.forefoot = 1;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 16, &count), AMBULO_OK);
  assert_int_equal(count, 7);
  for (int i = 0; i < 6; i++) {
    assert_int_equal(contacts[i].foot, i < 3 ? WALKER_LEFT : WALKER_RIGHT);
    assert_int_equal(contacts[i].mode, i % 3 == 1 ? AMBULO_CONTACT_FLAT : AMBULO_CONTACT_TOE);
    if (i % 3) assert_close(contacts[i].from, contacts[i - 1].to, 1e-14);
  }
  assert_close(contacts[2].to, 0.5, 1e-14);
  assert_close(contacts[3].from, 0.7, 1e-14);
  assert_int_equal(contacts[6].mode, AMBULO_CONTACT_TOE);
  gait.forefoot = 2;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 16, &count), AMBULO_E_ARGUMENT);
  ambulo_model_free(model);
}

static void impossible_gaits_are_refused(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  const ambulo_gait good = two_steps();
  ambulo_gait bad[] = {good, good, good, good, good, good};
  bad[0].steps = 0;
  bad[1].first_foot = 2;
  bad[2].step_time = 0.0;
  bad[3].foot_flat = 0.7;
  bad[4].toe_off = 1.0;
  bad[5].step_length = NAN;
  int count = -7;
  for (int i = 0; i < 6; i++) {
    assert_int_equal(ambulo_gait_expand(model, &bad[i], NULL, 0, &count), AMBULO_E_ARGUMENT);
    assert_int_equal(count, -7);
  }
  ambulo_model_free(model);
}

/* steps of 0.6 m in 0.5 s to the right and of 0.7 m in 0.6 s to the left: a stride of 1.1 s */
static void steps_may_alternate(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_gait gait = two_steps();
  gait.first_foot = WALKER_LEFT;
  gait.step_length = 0.6;
  gait.step_time = 0.5;
  gait.other_step_length = 0.7;
  gait.other_step_time = 0.6;
  gait.heel_strike = 0.0;
  gait.foot_flat = 0.1;
  static const double strikes[] = {-1.1, -0.6, 0.0, 0.5, 1.1, 1.6};
  static const double places[] = {-1.3, -0.7, 0.0, 0.6, 1.3, 1.9};
  for (int s = -2; s <= 3; s++) {
    assert_close(ambulo__gait_strike(&gait, s), strikes[s + 2], 1e-12);
    assert_close(ambulo__gait_place(&gait, s), places[s + 2], 1e-12);
  }
  ambulo_contact contacts[16];
  int count = 0, found = 0;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 16, &count), AMBULO_OK);
  for (int i = 0; i < count; i++) {
    const ambulo_contact *c = &contacts[i];
    if (c->foot != WALKER_RIGHT || c->mode != AMBULO_CONTACT_HEEL || c->from < 0.2) continue;
    assert_close(c->from, 0.5, 1e-12);
    assert_close(c->to, 0.61, 1e-12);
    assert_close(c->place[0] - gait.start, 0.6, 1e-12);
    found = 1;
  }
  assert_true(found);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(steps_may_alternate), cmocka_unit_test(the_table_is_as_written_by_hand),
      cmocka_unit_test(the_last_instant_counts), cmocka_unit_test(feet_may_land_on_their_toes),
      cmocka_unit_test(impossible_gaits_are_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
