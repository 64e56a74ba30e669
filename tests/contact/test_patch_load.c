/* What the law that shares the load is told of patches: slots behind those of the feet, ramps. */
#include "contact/contacts.h"
#include "support/patched_walker.h"

static double smooth(double u) {
  return u * u * (3.0 - 2.0 * u);
}

/* of the patches those in contact, behind the feet's slots */
static void patches_in_contact_are_slots(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  const ambulo_contact contacts[] = {{WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0}},
                                     OF_PATCH(SEAT, 0.0, 0.5, {0.0}),
                                     OF_PATCH(HAND_L, 0.2, 0.4, {0.0})};
  ambulo_problem_definition d = {.model = model, .contacts = contacts, .contact_count = 3};
  static const int effectors[] = {0, 1, 2 + HAND_L, 2 + SEAT};
  static const char *const names[] = {"right", "left", "hand_l", "seat"};
  ambulo__slots slots = ambulo__slots_of(&d);
  assert_int_equal(slots.count, 4);
  for (int i = 0; i < 4; i++) {
    assert_int_equal(slots.effector[i], effectors[i]);
    assert_string_equal(ambulo__slot_name(model, &slots, i), names[i]);
    assert_int_equal(slots.part[i], i < 2 ? AMBULO__WHOLE_FOOT : AMBULO__WHOLE_PATCH);
  }
  assert_int_equal(slots.link[2], ambulo_model_find_link(model, "pelvis"));
  d.contact_count = 1;
  assert_int_equal(ambulo__slots_of(&d).count, 2);
  ambulo_model_free(model);
}

/* beside feet that are there all the time, a hand comes in half of its time and goes in the other;
 * a seat that was there before only goes; its centre is its place, pressure within its size */
static void patches_ramp_as_feet_do(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.0, -0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.0, 0.1}},
      OF_PATCH(HAND_R, 0.2, 0.6, {0.4, -0.3, 1.1}),
      OF_PATCH(SEAT, 0.0, 0.5, {-0.2, 0.0, 0.45})};
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.contacts = contacts;
  d.contact_count = 4;
  ambulo__slots slots = ambulo__slots_of(&d);
  ambulo__foot_outline outlines[2] = {ambulo__foot_outline_of(model, 0),
                                      ambulo__foot_outline_of(model, 1)};
  static const double time[] = {0.1, 0.2, 0.25, 0.35, 0.45, 0.55, 0.7};
  for (int i = 0; i < 7; i++) {
    double t = time[i];
    ambulo__contact_load foot = ambulo__contact_load_at(&d, outlines, &slots, 0, NULL, t);
    ambulo__contact_load hand = ambulo__contact_load_at(&d, outlines, &slots, 2, NULL, t);
    ambulo__contact_load seat = ambulo__contact_load_at(&d, outlines, &slots, 3, NULL, t);
    assert_close(foot.weight, 1.0, 0.0);
    assert_int_equal(hand.loaded, t >= 0.2 && t < 0.6);
    assert_int_equal(seat.loaded, t < 0.5);
    /* others outlast both ends of the hand; as it begins the seat is there until 0.5 s, so are the
     * feet: half of its stance, 0.4 s */
    double in = fmin(1.0, (t - 0.2) / 0.2), out = fmax(0.0, (t - 0.4) / 0.2);
    if (hand.loaded) assert_close(hand.weight, smooth(in) * (1.0 - smooth(out)), 1e-12);
    /* as the seat ends, the hand has been there since 0.2 s, feet for ever: half of 0.5 s */
    double gone = fmax(0.0, (t - 0.25) / 0.25);
    if (seat.loaded) assert_close(seat.weight, 1.0 - smooth(gone), 1e-12);
    if (!seat.loaded) continue;
    assert_close(seat.center[0], -0.2, 1e-15);
    assert_close(seat.center[1], 0.45, 1e-15);
    assert_close(seat.box[0], -0.1, 0.0);
    assert_close(seat.box[1], 0.1, 0.0);
    assert_close(seat.side, 0.15, 0.0);
    assert_int_equal(seat.arc, -1);
    double s = 0.5 - t;
    assert_close(seat.most, 15.0 * (s - 0.0065 * (1.0 - exp(-s / 0.0065))), 1e-12);
  }
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(patches_in_contact_are_slots),
                                     cmocka_unit_test(patches_ramp_as_feet_do)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
