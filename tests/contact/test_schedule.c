/* The schedule: membership of nodes, and every contradiction with its message. */
#include "contact/contacts.h"
#include "support/patched_walker.h"
#include "support/row_fixture.h"

static const double times[] = {0.0, 0.25, 0.5, 0.75, 1.0};

static void nodes_belong_to_half_open_spans(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_HEEL, 0.0, 0.25, .place = {0, 0}},
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.25, 0.5 - 5e-10, .place = {0, 0}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.5, 1.0, .place = {0, 0}}};
  f.definition.contacts = contacts;
  f.definition.contact_count = 3;
  f.definition.ground_penetration = 1;
  int active[10];
  assert_int_equal(ambulo__schedule_fill(&f.definition, times, 5, active, NULL), AMBULO_OK);
  static const int expected[10] = {0, -1, 1, -1, -1, 2, -1, 2, -1, 2};
  for (int i = 0; i < 10; i++) assert_int_equal(active[i], expected[i]);
  assert_int_equal(ambulo__contact_holds(&contacts[0], 1.0, 0.25 - 1e-8), 1);
  assert_int_equal(ambulo__contact_holds(&contacts[0], 1.0, 0.25 - 1e-10), 0);
  assert_int_equal(ambulo__contact_holds(&contacts[1], 1.0, 0.25 - 1e-10), 1);
  row_fixture_close(&f);
}

/* just before a node: what ends there, and within 1e-9 s of it */
static void nodes_on_events_know_what_was_before(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_HEEL, 0.0, 0.25, .place = {0, 0}},
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.25, 0.5 - 5e-10, .place = {0, 0}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.5, 1.0, .place = {0, 0}},
      {WALKER_RIGHT, AMBULO_CONTACT_HEEL, 1.0, 1.0, .place = {0, 0}}};
  f.definition.contacts = contacts;
  f.definition.contact_count = 4;
  int active[10], before[10];
  assert_int_equal(ambulo__schedule_fill(&f.definition, times, 5, active, NULL), AMBULO_OK);
  ambulo__schedule_before(&f.definition, times, 5, active, before);
  static const int expected[10] = {0, -1, 0, -1, 1, -1, -1, 2, -1, 2};
  for (int i = 0; i < 10; i++) assert_int_equal(before[i], expected[i]);
  assert_int_equal(active[8], 3);
  row_fixture_close(&f);
}

static void expect_refusal(const ambulo_contact *contacts, int count, const char *text) {
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.contacts = contacts;
  f.definition.contact_count = count;
  f.definition.foot_strike = 1;
  int active[10];
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__schedule_fill(&f.definition, times, 5, active, list), AMBULO_E_PROBLEM);
  expect_message(list, text);
  ambulo_diagnostics_free(list);
  row_fixture_close(&f);
}

static void contradictions_are_named(void **state) {
  (void)state;
  ambulo_contact good = {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0, 0}};
  ambulo_contact bad = good;
  bad.foot = 5;
  expect_refusal(&bad, 1, "contacts[0]: no foot 5; the model 'walker' has 2");
  bad = good;
  bad.mode = (ambulo_contact_mode)5;
  expect_refusal(&bad, 1, "contacts[0]: the mode of foot 'left' is unknown (got 5)");
  bad.mode = AMBULO_CONTACT_MODE_NOT_SET;
  expect_refusal(&bad, 1, "contacts[0]: the mode of foot 'left' is not set (got 0); expected heel");
  bad = good;
  bad.place[1] = NAN;
  expect_refusal(&bad, 1, "expected finite lengths");
  bad = good;
  bad.to = 1.5;
  expect_refusal(&bad, 1, "foot 'left' from 0 s to 1.5 s; expected times in 0 to 1 s");
  bad.from = 0.6;
  bad.to = 0.4;
  expect_refusal(&bad, 1, "foot 'left' from 0.6 s to 0.4 s; expected from < to");
  const ambulo_contact overlap[] = {good,
                                    {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.7, 0.9, .place = {0, 0}}};
  expect_refusal(
      overlap, 2,
      "contacts[0] and contacts[1] overlap on foot 'left': 0 s to 1 s and 0.7 s to 0.9 s");
  const ambulo_contact gap[] = {{WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 0.3, .place = {0, 0}},
                                {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.45, 1.0, .place = {0, 0}}};
  expect_refusal(gap, 2, "no foot touches the ground from 0.3 s to 0.45 s");
  expect_refusal(NULL, 0, "no foot touches the ground from 0 s to 1 s");
}

/* only contacts that share the load, with no zero-moment point, let a body fly */
static void who_may_fly(void **state) {
  (void)state;
  static const ambulo_contact hop[] = {
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 0.3, .place = {0, 0}},
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.45, 1.0, .place = {0, 0}}};
  static const struct {
    ambulo_reaction_kind kind;
    ambulo_support support;
    double minimum_force;
    const char *phrase;
  } cases[] = {{AMBULO_REACTION_SHARED, AMBULO_SUPPORT_OFF, -1.0, NULL},
               {AMBULO_REACTION_SHARED, AMBULO_SUPPORT_OFF, 0.0, NULL},
               {AMBULO_REACTION_SHARED, AMBULO_SUPPORT_OFF, 0.2,
                "ground_reaction.minimum_force: nothing presses on the ground from 0.3 s to 0.45 "
                "s, where the body is in flight (got 0.2 body weights); expected none"},
               {AMBULO_REACTION_SHARED, AMBULO_SUPPORT_BOX, -1.0,
                "no foot touches the ground from 0.3 s to 0.45 s"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    row_fixture f;
    row_fixture_open(&f, 0);
    f.definition.contacts = hop;
    f.definition.contact_count = 2;
    f.definition.ground_reaction.kind = cases[i].kind;
    f.definition.support = cases[i].support;
    f.definition.minimum_force = cases[i].minimum_force;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    int active[10];
    assert_int_equal(ambulo__schedule_fill(&f.definition, times, 5, active, list),
                     cases[i].phrase ? AMBULO_E_PROBLEM : AMBULO_OK);
    if (cases[i].phrase) expect_message(list, cases[i].phrase);
    ambulo_diagnostics_free(list);
    row_fixture_close(&f);
  }
}

static void rows_without_contact_need_no_support(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  int active[10];
  assert_int_equal(ambulo__schedule_fill(&f.definition, times, 5, active, NULL), AMBULO_OK);
  for (int i = 0; i < 10; i++) assert_int_equal(active[i], -1);
  row_fixture_close(&f);
}

static void expect_refusal_of_patches(const ambulo_contact *contacts, int count, int zmp,
                                      const char *phrase) {
  row_fixture f;
  row_fixture_open(&f, 0);
  ambulo_model_free(f.model);
  f.model = patched_walker(0);
  f.definition.model = f.model;
  f.definition.foot_strike = 1;
  f.definition.contacts = contacts;
  f.definition.contact_count = count;
  if (zmp) f.definition.support = AMBULO_SUPPORT_HULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  int active[10];
  assert_int_equal(ambulo__schedule_fill(&f.definition, times, 5, active, list),
                   phrase ? AMBULO_E_PROBLEM : AMBULO_OK);
  if (phrase) expect_message(list, phrase);
  for (int i = 0; i < 10 && !phrase; i++) assert_int_equal(active[i], -1);
  ambulo_diagnostics_free(list);
  row_fixture_close(&f);
}

/* a patch carries the body as feet do; it points anywhere, but it has to be there */
static void patches_are_checked_too(void **state) {
  (void)state;
  ambulo_contact seat[] = {OF_PATCH(SEAT, 0.0, 0.6, {0.0}), OF_PATCH(SEAT, 0.6, 1.0, {0.0})};
  seat[0].normal[0] = -1.0;
  expect_refusal_of_patches(seat, 2, 0, NULL);
  expect_refusal_of_patches(seat, 2, 1,
                            "contacts[0]: patch 'seat' does not go with "
                            "constraints.zmp; expected feet alone");
  expect_refusal_of_patches(seat, 1, 0,
                            "no foot and no patch touches the ground from 0.6 s to 1 s");
  seat[1].from = 0.5;
  expect_refusal_of_patches(seat, 2, 0, "contacts[0] and contacts[1] overlap on patch 'seat'");
  ambulo_contact bad = OF_PATCH(7, 0.0, 1.0, {0.0});
  expect_refusal_of_patches(&bad, 1, 0, "contacts[0]: no patch 7; the model 'walker' has 3");
  bad.patch = HAND_R;
  bad.foot = 0;
  expect_refusal_of_patches(&bad, 1, 0, "contacts[0]: foot 0 in mode patch; expected foot -1");
  bad.foot = -1;
  bad.place[2] = NAN;
  expect_refusal_of_patches(&bad, 1, 0, "contacts[0]: patch 'hand_r' has the place (0, 0, nan) m");
  bad.place[2] = 0.0;
  bad.normal[1] = INFINITY;
  expect_refusal_of_patches(&bad, 1, 0, "expected a finite normal, and a finite angle");
  bad.normal[1] = 0.0;
  bad.to = 2.0;
  expect_refusal_of_patches(&bad, 1, 0, "patch 'hand_r' from 0 s to 2 s; expected times in 0 to 1");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(nodes_belong_to_half_open_spans),
                                     cmocka_unit_test(nodes_on_events_know_what_was_before),
                                     cmocka_unit_test(contradictions_are_named),
                                     cmocka_unit_test(who_may_fly),
                                     cmocka_unit_test(rows_without_contact_need_no_support),
                                     cmocka_unit_test(patches_are_checked_too)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
