/* Numbers of what hands hold, and all others beside it, by hand against central differences. */
#include "support/sensitivity_check.h"

/* held all along in a step that is its own mirror image: the body's numbers are not the box's */
static void a_box_in_both_hands(void **state) {
  (void)state;
  static const setting c = {"models/walk_carrying.yaml",
                            {"written_for=null", "time.intervals=40"},
                            {"load[box].mass", "load[box].inertia", "load[box].center[0]",
                             "load[box].center[2]", "subject.mass", "ground.slope",
                             "gait.step_width", "gait.speed", "gait.phases.toe_off.comfortable",
                             "ground_reaction.moment_arm", "ground_reaction.loading_rate"}};
  check(&c, "load[box].center[1]");
}

/* times of its own on a grid on events: nodes go along */
static void from_the_floor_to_a_table(void **state) {
  (void)state;
  static const setting c = {"models/lift.yaml",
                            {"load[box].from=0.85", "load[box].to=2.87", "time.intervals=50"},
                            {"load[box].mass", "load[box].inertia", "load[box].center[0]",
                             "load[box].center[1]", "load[box].center[2]", "load[box].from",
                             "load[box].to", "load[box].ramp", "subject.mass", "ground.slope"}};
  check(&c, "time.duration");
}

/* times at which rows of a reach begin, too */
static void times_that_are_shared_have_none(void **state) {
  (void)state;
  static const setting c = {"models/lift.yaml", {"time.intervals=50"}, {NULL}};
  static const char *const absent[] = {"load[box].from", "load[box].to", "load[box].ramp", NULL};
  expect_absent(&c, absent);
  /* a longer motion would have its end inside */
  static const setting at_the_end = {"models/two_link_reach.yaml",
                                     {"load={hands: [hand], mass: 1.5, from: 0.2, to: 0.8}"},
                                     {NULL}};
  static const char *const no_duration[] = {"time.duration", "load.to", NULL};
  expect_absent(&at_the_end, no_duration);
}

/* one hand, and both; a load on a link between them in the list; nodes that stay */
static void a_wall_and_a_bag(void **state) {
  (void)state;
  static const setting c = {
      "models/push_wall.yaml",
      {"load=[{name: wall, hands: [hand_r, hand_l], force: [250, 20, -30], from: 0.71, to: 1.93, "
       "ramp: 0.25}, {link: thorax, mass: 7, position: [0, 0.1, 0.1]}, {hands: [hand_l], mass: 3, "
       "force: [40, 5, 20], from: 1.31}]",
       "time.grid=uniform", "time.intervals=50"},
      {"load[wall].force[0]", "load[wall].force[1]", "load[wall].force[2]", "load[wall].from",
       "load[wall].to", "load[wall].ramp", "load[1].mass", "load[2].mass", "load[2].force[1]",
       "load[2].from", "load[2].ramp", "subject.mass", "ground.slope"}};
  check(&c, "load[2].to");
}

/* without a ground: the window stays in seconds while the motion is slowed down */
static void in_the_hand_of_an_arm(void **state) {
  (void)state;
  static const setting c = {"models/two_link_reach.yaml",
                            {"load={hands: [hand], mass: 1.5, force: [3, 0, -2], from: 0.21, to: "
                             "0.69, ramp: 0.1}"},
                            {"load.mass", "load.force[0]", "load.force[2]", "load.from", "load.to",
                             "load.ramp", "time.duration"}};
  check(&c, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_box_in_both_hands), cmocka_unit_test(from_the_floor_to_a_table),
      cmocka_unit_test(times_that_are_shared_have_none), cmocka_unit_test(a_wall_and_a_bag),
      cmocka_unit_test(in_the_hand_of_an_arm)};
  return cmocka_run_group_tests_name("sensitivity/holds", tests, NULL, NULL);
}
