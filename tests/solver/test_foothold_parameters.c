/* Shipped motions with listed contacts: every number that they have a name for, by hand against
 * central differences; which contacts move together, and what is not listed. */
#include "support/sensitivity_check.h"
#include "ambulo/tools/load.h"

static void walk_start(void **state) {
  (void)state;
  static const setting c = {"models/walk_start.yaml",
                            {NULL},
                            {"contacts[0].place[0]", "contacts[2].place[1]", "contacts[4].place[0]",
                             "contacts[7].place[0]", "contacts[0].to", "contacts[1].to",
                             "contacts[3].to", "contacts[4].from", "subject.mass",
                             "ground_reaction.moment_arm", "ground_reaction.loading_rate",
                             "ends.final_speed.pelvis_tx", "constraints.clearance.height"}};
  check(&c, "contacts[5].place[0]");
}

static void walk_turn(void **state) {
  (void)state;
  static const setting c = {"models/walk_turn.yaml",
                            {NULL},
                            {"contacts[1].place[0]", "contacts[1].heading", "contacts[4].heading",
                             "contacts[4].place[1]", "contacts[10].heading", "subject.mass",
                             "ends.final.pelvis_rotation", "ground.slope"}};
  check(&c, "contacts[1].to"); /* the tracked curve stays in seconds */
}

static void stairs(void **state) {
  (void)state;
  static const setting up = {"models/stairs_up.yaml",
                             {NULL},
                             {"contacts[0].to", "contacts[2].to", "constraints.clearance.height",
                              "constraints.clearance.ceiling", "subject.mass"}};
  static const setting down = {"models/stairs_down.yaml",
                               {NULL},
                               {"contacts[0].to", "contacts[1].to", "constraints.clearance.height",
                                "constraints.clearance.ceiling", "subject.mass"}};
  check(&up, "ends.travel");
  check(&down, "contacts[3].place[0]");
}

static void walk_on_arcs(void **state) {
  (void)state;
  static const setting c = {"models/walk_normal.yaml",
                            {NULL},
                            {"gait.phases.foot_flat", "gait.phases.heel_off", "gait.phases.toe_off",
                             "gait.step_length", "gait.step_width", "time.duration", "subject.mass",
                             "ground_reaction.moment_arm", "ground_reaction.slant",
                             "ground_reaction.loading_rate", "constraints.contact_tolerance"}};
  check(&c, NULL);
}

/* the same foot on the same place once more, after a while in the air, is another foothold */
#define IN_PLACE                                                                                   \
  "contacts=[{foot: right, mode: flat, from: 0.6, to: 1, place: [0, -0.05]}, "                     \
  "{foot: left, mode: flat, from: 0, to: 1, place: [0, 0.05]}, "                                   \
  "{foot: right, mode: toe, from: 0.27, to: 0.4, place: [0, -0.05]}, "                             \
  "{foot: right, mode: flat, from: 0, to: 0.27, place: [0, -0.05]}]"

static const ambulo_sensitivity *find(const ambulo_sensitivity_list *list, const char *name) {
  for (int i = 0; i < list->count; i++)
    if (strcmp(list->items[i].name, name) == 0) return &list->items[i];
  fail_msg("no sensitivity '%s'", name);
  return NULL;
}

static void a_stance_moves_as_one(void **state) {
  (void)state;
  static const char *const overrides[] = {
      "gait=null", "ends=null", "time={duration: 1, intervals: 40, grid: events}", IN_PLACE};
  ambulo_problem *problem = NULL;
  ambulo_sensitivity_list *list = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", overrides, 4, NULL, NULL, &problem),
      AMBULO_OK);
  ambulo_result *result = scattered(problem);
  assert_int_equal(ambulo_sensitivities(problem, result, NULL, &list), AMBULO_OK);
  assert_string_equal(find(list, "contacts[0].place[0]")->with, "");
  assert_string_equal(find(list, "contacts[2].place[0]")->with, "contacts[3].place[0]");
  assert_close(find(list, "contacts[2].place[0]")->with_sign, 1.0, 0.0);
  assert_string_equal(find(list, "contacts[2].from")->with, "contacts[3].to");
  assert_string_equal(find(list, "contacts[2].from")->label,
                      "start of contact 2 and end of contact 3");
  ambulo_sensitivities_free(list);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(walk_start),
      cmocka_unit_test(walk_turn),
      cmocka_unit_test(stairs),
      cmocka_unit_test(walk_on_arcs),
      cmocka_unit_test(a_stance_moves_as_one),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
