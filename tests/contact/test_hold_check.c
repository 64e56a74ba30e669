/* What hands cannot hold: every refusal by name. */
#include "contact/holds.h"

#include "model/model.h"
#include "support/messages.h"
#include "support/planar_walker.h"

static ambulo_hold sound(void) {
  ambulo_hold h = ambulo_hold_default();
  h.name = "box";
  h.hand[0] = 0;
  h.hand[1] = 3;
  h.mass = 5;
  h.from = 0.5;
  h.to = 1.5;
  return h;
}

typedef ambulo_status check(const ambulo_problem_definition *d, ambulo_diagnostics *list);

static void refuses(check *function, const ambulo_hold *holds, int count, ambulo_ends ends,
                    ambulo_reaction_kind kind, const char *what) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_model *model = walker_create();
  d.model = model;
  d.duration = 2;
  d.ends = ends;
  d.ground_reaction.kind = kind;
  d.holds = holds;
  d.hold_count = count;
  assert_int_equal(function(&d, list), what ? AMBULO_E_PROBLEM : AMBULO_OK);
  if (what) assert_message(list, 0, what);
  ambulo_model_free(model);
  ambulo_diagnostics_free(list);
}

/* a sound hold but for one member */
#define REFUSES(what, ...)                                                                         \
  do {                                                                                             \
    ambulo_hold h = sound();                                                                       \
    __VA_ARGS__;                                                                                   \
    refuses(ambulo__holds_check, &h, 1, AMBULO_ENDS_FREE, AMBULO_REACTION_NONE, what);             \
  } while (0)

static void test_hands(void **state) {
  (void)state;
  REFUSES(NULL, (void)h);
  REFUSES(NULL, h.hand[1] = -1);
  REFUSES("held by points 99 and 3; expected points of the model", h.hand[0] = 99);
  REFUSES("held by points 0 and 99", h.hand[1] = 99);
  REFUSES("held by points -1 and 3", h.hand[0] = -1);
  REFUSES("twice; expected two points", h.hand[1] = 0);
  REFUSES("has an inertia or a center, but one hand", h.hand[1] = -1; h.inertia = 0.1);
  REFUSES("has an inertia or a center, but one hand", h.hand[1] = -1; h.center[2] = 0.1);
  REFUSES("without a name", h.name = NULL);
}

static void test_numbers(void **state) {
  (void)state;
  REFUSES("mass -1 kg, inertia 0 kg m^2; expected 0 to 1e+06", h.mass = -1);
  REFUSES("inertia nan", h.inertia = NAN);
  REFUSES("center, size or force beyond 100 m", h.center[0] = 101);
  REFUSES("center, size or force beyond 100 m", h.size[1] = NAN);
  REFUSES("center, size or force beyond 100 m or 1e+06 N", h.force[1] = 2e6);
  REFUSES("has neither mass nor force", h.mass = 0);
  REFUSES(NULL, h.mass = 0; h.force[0] = 50);
}

static void test_windows(void **state) {
  (void)state;
  REFUSES("is held from 2 s to 3 s; expected times within 0 to 2 s", h.from = 2; h.to = 3);
  REFUSES("is held from 1.5 s to 0.5 s", h.from = 1.5; h.to = 0.5);
  REFUSES("is held from nan s", h.from = NAN);
  REFUSES("taken up and set down over 0 s each", h.ramp = 0);
  REFUSES("taken up and set down over 0.6 s each; expected above 0, and no more than the 1 s",
          h.ramp = 0.6);
  REFUSES(NULL, h.ramp = 0.5);
  REFUSES(NULL, h.ramp = 0.9; h.from = 0); /* one ramp only */
}

static void test_names_and_ground(void **state) {
  (void)state;
  const ambulo_hold two[2] = {sound(), sound()};
  refuses(ambulo__holds_check, two, 2, AMBULO_ENDS_FREE, AMBULO_REACTION_NONE,
          "two loads in hands are named 'box'");
  refuses(ambulo__holds_check, two, 1, AMBULO_ENDS_FREE, AMBULO_REACTION_SHARED, NULL);
}

static void test_mirrored_ends(void **state) {
  (void)state;
  ambulo_hold h = sound();
  ambulo_model *model = walker_create();
  const ambulo_foot *feet = model->feet;
  h.hand[0] = feet[0].heel_center;
  h.hand[1] = feet[1].heel_center;
  refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_PERIODIC, AMBULO_REACTION_NONE, NULL);
  refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED, AMBULO_REACTION_NONE,
          "is held from 0.5 s to 1.5 s; with mirrored ends expected all along");
  h.from = 0;
  h.to = INFINITY;
  refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED, AMBULO_REACTION_NONE, NULL);
  h.force[1] = 1;
  refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED, AMBULO_REACTION_NONE,
          "is not its own mirror image");
  h.force[1] = 0;
  h.center[1] = 0.1;
  refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED, AMBULO_REACTION_NONE,
          "is not its own mirror image");
  h.center[1] = 0;
  h.hand[1] = feet[1].toe_center;
  refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED, AMBULO_REACTION_NONE,
          "is not its own mirror image");
  h.hand[1] = -1;
  refuses(ambulo__holds_mirror_check, &h, 1, AMBULO_ENDS_MIRRORED, AMBULO_REACTION_NONE,
          "is not its own mirror image");
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_hands), cmocka_unit_test(test_numbers), cmocka_unit_test(test_windows),
      cmocka_unit_test(test_names_and_ground), cmocka_unit_test(test_mirrored_ends)};
  return cmocka_run_group_tests_name("device/hold_check", tests, NULL, NULL);
}
