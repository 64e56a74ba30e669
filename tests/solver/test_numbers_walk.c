/* Footholds, phases and times of contacts: by hand against central differences; which contacts move
 * together, and what is not listed. */
#include "ambulo/tools/load.h"
#include "support/sensitivity_check.h"
#include "support/shared_ground.h"

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

/* two hands on one place are two footholds, however long each of them stays */
#define ON_ONE_PLACE                                                                               \
  "contacts=[{foot: left, mode: flat, from: 0, to: 3, place: [0, 0.1]}, "                          \
  "{foot: right, mode: flat, from: 0, to: 3, place: [0, -0.1]}, "                                  \
  "{patch: hand_l, from: 0, to: 1.5, " PLACE "}, {patch: hand_l, from: 1.5, to: 3, " PLACE "}, "   \
  "{patch: hand_r, from: 0, to: 3, " PLACE "}]"
#define PLACE "place: [0.95, 0, 1.3], normal: [-1, 0, 0]"

static void each_patch_moves_by_itself(void **state) {
  (void)state;
  static const char *const overrides[] = {"ends=null", "constraints.tubes=null", "time.intervals=6",
                                          "trajectory.intervals=4", ON_ONE_PLACE};
  ambulo_problem *problem = NULL;
  ambulo_sensitivity_list *list = NULL;
  assert_int_equal(
      ambulo_problem_load("models/push_up_wall.yaml", overrides, 5, NULL, NULL, &problem),
      AMBULO_OK);
  ambulo_result *result = scattered(problem);
  assert_int_equal(ambulo_sensitivities(problem, result, NULL, &list), AMBULO_OK);
  assert_string_equal(find(list, "contacts[2].place[0]")->with, "contacts[3].place[0]");
  assert_string_equal(find(list, "contacts[4].place[0]")->with, "");
  ambulo_sensitivities_free(list);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void phases_of_a_walk_on_arcs(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_loaded.yaml",
      {SHARED, ARCS, "ground={slope: 2}",
       "gait.phases={heel_strike: 0.015, foot_flat: 0.14, heel_off: 0.38, toe_off: 0.62}",
       "time.intervals=40", ON_EVENTS},
      {"gait.phases.heel_strike", "gait.phases.foot_flat", "gait.phases.heel_off",
       "gait.phases.toe_off", "time.duration", "gait.step_length", "gait.step_width",
       "subject.mass", "load.mass", "ground.slope", "constraints.contact_tolerance",
       "constraints.ground_height", "ground_reaction.pressure.width",
       "ground_reaction.moment_arm"}};
  check(&c, NULL);
}

static void phases_of_a_walk(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {SHARED, "objective=[{term: force_rate, weight: 0.02}, {term: ground_force, weight: 0.3}]",
       "time.intervals=36", ON_EVENTS, "load={link: pelvis, mass: 10, position: [-0.1, 0.3, 0]}"},
      {"gait.phases.foot_flat", "gait.phases.heel_off", "gait.phases.toe_off", "time.duration",
       "ground_reaction.loading_rate", "gait.step_length", "subject.mass"}};
  check(&c, NULL);
}

/* strikes after 0, on the heel until the other foot has left; the slow load keeps the greatest
 * force low for long */
static void phases_of_a_walk_that_strikes_late(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_loaded.yaml",
      {SHARED, "ground_reaction.loading_rate=3", "subject.stature=1.6",
       "gait.phases={heel_strike: 0.015, foot_flat: 0.14, heel_off: 0.38, toe_off: 0.62}",
       "time.intervals=40", ON_EVENTS},
      {"gait.phases.heel_strike", "gait.phases.foot_flat", "gait.phases.heel_off",
       "gait.phases.toe_off", "time.duration", "ground_reaction.loading_rate"}};
  check(&c, NULL);
}

/* the other foot leaves just after this one is flat, and comes just before its heel rises: centres
 * glide over a sixteenth of the time between */
static void phases_that_are_close(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {SHARED, "gait.phases={heel_strike: 0.0, foot_flat: 0.08, heel_off: 0.51, toe_off: 0.588}",
       "time.intervals=40", ON_EVENTS},
      {"gait.phases.foot_flat", "gait.phases.heel_off", "gait.phases.toe_off", "time.duration"}};
  check(&c, NULL);
}

/* two steps, periodic, of other lengths */
static void phases_of_a_limp(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_asymmetric.yaml",
      {SHARED, "gait.phases={heel_strike: 0.01, foot_flat: 0.08, heel_off: 0.38, toe_off: 0.62}",
       "objective[0].weight=2", "time.intervals=56", ON_EVENTS},
      {"gait.phases.heel_strike", "gait.phases.foot_flat", "gait.phases.heel_off",
       "gait.phases.toe_off"}};
  check(&c, NULL);
}

/* feet in two parts, balls on the link before: patches end at the joint, and centres stay */
#define BALL(side, up)                                                                             \
  "model.points[ball_" side "]={name: ball_" side ", link: subtalar_" side                         \
  ", position: [0, 0.08, " up "]}"

static void phases_of_a_walk_with_toes(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {SHARED, "objective[0].weight=2", BALL("r", "-0.042857"), BALL("l", "0.042857"),
       "gait.phases={heel_strike: 0.015, foot_flat: 0.08, heel_off: 0.38, toe_off: 0.62}",
       "time.intervals=40", ON_EVENTS},
      {"gait.phases.heel_strike", "gait.phases.foot_flat", "gait.phases.heel_off",
       "gait.phases.toe_off", "ground_reaction.pressure.flat[0]",
       "ground_reaction.pressure.flat[1]", "ground_reaction.pressure.toe[1]",
       "ground_reaction.pressure.heel[1]", "gait.step_width", "ground_reaction.slant"}};
  check(&c, NULL);
}

/* backwards: feet come down on their toes and leave over their heels, on slopes */
#define BACKWARDS                                                                                  \
  "contacts=[{foot: right, mode: flat, from: 0, to: 0.27, place: [0, -0.05]}, "                    \
  "{foot: right, mode: heel, from: 0.27, to: 0.42, place: [0, -0.05]}, "                           \
  "{foot: left, mode: toe, from: 0.19, to: 0.335, place: [-0.3, 0.05, 0.03], " TILTED "}, "        \
  "{foot: left, mode: flat, from: 0.335, to: 0.71, place: [-0.3, 0.05, 0.03], " TILTED "}, "       \
  "{foot: left, mode: heel, from: 0.71, to: 0.83, place: [-0.3, 0.05, 0.03], " TILTED "}, "        \
  "{foot: right, mode: toe, from: 0.6, to: 0.765, place: [-0.6, -0.05]}, "                         \
  "{foot: right, mode: flat, from: 0.765, to: 1.0, place: [-0.6, -0.05]}]"
#define TILTED "heading: 3, normal: [0.1, 0.05, 1]"

static void backwards_with_toes(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"gait=null", "ends=null", SHARED, BALL("r", "-0.042857"), BALL("l", "0.042857"),
       "constraints.strike_pitch=null", "time={duration: 1, intervals: 60, grid: events}",
       "trajectory.knots=events", "trajectory.degree=4", BACKWARDS},
      {"contacts[0].to", "contacts[1].to", "contacts[2].from", "contacts[2].to", "contacts[3].to",
       "contacts[4].to", "contacts[5].from", "contacts[5].to", "contacts[2].place[0]",
       "contacts[2].place[2]", "contacts[2].normal[0]", "contacts[2].heading",
       "ground_reaction.pressure.flat[1]"}};
  check(&c, "contacts[3].place[0]");
}

/* a foot that comes down beside one that outlasts it: half its stance; ends that do not repeat */
static void times_of_contacts(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"gait=null", "ends=null", SHARED, "time={duration: 1, intervals: 50, grid: events}",
       "contacts=[{foot: right, mode: flat, from: 0, to: 1, place: [0, -0.05]}, "
       "{foot: left, mode: heel, from: 0.21, to: 0.33, place: [0.102, 0.05]}, "
       "{foot: left, mode: flat, from: 0.33, to: 0.71, place: [0.1, 0.05]}, "
       "{foot: left, mode: toe, from: 0.71, to: 0.83, place: [0.1, 0.05]}]",
       "trajectory.knots=events", "trajectory.degree=4"},
      {"contacts[1].from", "contacts[3].to", "contacts[1].place[0]", "contacts[0].place[1]"}};
  check(&c, "time.duration");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(walk_start),
      cmocka_unit_test(walk_turn),
      cmocka_unit_test(stairs),
      cmocka_unit_test(walk_on_arcs),
      cmocka_unit_test(a_stance_moves_as_one),
      cmocka_unit_test(each_patch_moves_by_itself),
      cmocka_unit_test(phases_of_a_walk),
      cmocka_unit_test(phases_of_a_walk_that_strikes_late),
      cmocka_unit_test(phases_that_are_close),
      cmocka_unit_test(phases_of_a_limp),
      cmocka_unit_test(phases_of_a_walk_on_arcs),
      cmocka_unit_test(phases_of_a_walk_with_toes),
      cmocka_unit_test(backwards_with_toes),
      cmocka_unit_test(times_of_contacts),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
