/* Feet and patches in one numbering. */
#include "contact/effector.h"
#include "support/patched_walker.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(feet_come_first),
                                     cmocka_unit_test(contacts_of_what_is_not_there_are_unknown),
                                     cmocka_unit_test(patches_are_used_where_they_are_in_contact)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
