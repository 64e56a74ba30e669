/* What is suggested when one row is missed by a known amount: the sentence, and settings that can
 * be handed to --set as they stand. With them the row gives way by that amount. Limits and ends. */
#include "support/suggest_cases.h"

static const miss misses[] = {
    {WALK,
     {0},
     "joint_limit",
     "knee_angle_l",
     "upper",
     -0.1,
     "raise the upper end of the range of "
     "knee_angle_l by 0.1 rad: from 2.094 (120 deg) to 2.196 rad (126 deg)",
     {"model.links[shank_l].coordinate.range=[0, 125.",
      "model.links[shank_r].coordinate.range=[0, 125."},
     0},
    {WALK,
     {0},
     "joint_limit",
     "pelvis_list",
     "lower",
     -0.1,
     "lower the lower end of the range of "
     "pelvis_list by 0.1 rad",
     {"model.links[pelvis_lean].coordinate.range=[-25."},
     1},
    {WALK,
     {"constraints.torque_limits=true"},
     "torque_limit",
     "ankle_angle_r",
     "lower",
     -10.0,
     "lower the lower torque limit of ankle_angle_r by 10 N m",
     {"model.links[talus_r].coordinate.torque=[-0.1",
      "model.links[talus_l].coordinate.torque=[-0.1"},
     0},
    {WALK,
     {"model.links[shank_r].coordinate.speed=[-500, none]",
      "model.links[shank_l].coordinate.speed=[-500, none]", "constraints.speed_limits=true"},
     "speed_limit",
     "knee_angle_r",
     "lower",
     -1.0,
     "lower the lower speed limit of knee_angle_r",
     {"model.links[shank_r].coordinate.speed=[-55", "model.links[shank_l].coordinate.speed=[-55"},
     0},
    {WALK,
     {0},
     "pressure",
     "left",
     "right",
     -0.005,
     "of left go 0.005 m further right",
     {"ground_reaction.pressure={heel: [-0.02, 0.03], roll: 0.04, flat: [-0.005, 0.02], toe: [-0.02"
      ", 0.055], width: 0.0402}"},
     1},
    {WALK,
     {0},
     "mirrored",
     "pelvis_tx",
     "value",
     -0.08,
     "gets 0.6 m forward where 0.68 m",
     {"gait.step_length=0.6"},
     0},
    {WALK,
     {"time.duration=null", "gait.speed=1.25"},
     "mirrored",
     "pelvis_tx",
     "value",
     -0.08,
     "gets 0.6 m forward where 0.68 m",
     {"gait.step_length=0.6", "gait.speed=1.10"},
     0},
    {WALK,
     {"ends.travel=0.68"},
     "mirrored",
     "pelvis_tx",
     "value",
     -0.08,
     "gets 0.6 m forward",
     {"gait.step_length=0.6", "ends.travel=0.6"},
     0},
    {"tests/infeasible/support_too_narrow.yaml",
     {0},
     "zmp",
     "support",
     "front",
     -0.02,
     "lower the margin of the zero-moment point by 0.02 m: from 0.08 m to 0.0598",
     {"constraints.zmp_margin=0.0598"},
     1},
    {"tests/infeasible/equalities_contradict.yaml",
     {0},
     "periodic",
     "pelvis_tx",
     "value",
     -0.3,
     "change the travel from 0.3 m to 0 m",
     {"ends.travel=0"},
     0},
    {"tests/infeasible/equalities_contradict.yaml",
     {0},
     "tracking_tube",
     "pelvis_tx",
     "on",
     0.15,
     "leave the motion that it follows by 0.15 m",
     {"constraints.tubes[0].coordinates.pelvis_tx=0.1515"},
     1},
    {"models/two_link_reach.yaml",
     {0},
     "final_state",
     "elbow",
     "value",
     0.1,
     "ask for another final "
     "value of elbow",
     {"ends.final.elbow="},
     0},
    {"models/two_link_reach.yaml",
     {0},
     "initial_state",
     "elbow",
     "rate",
     0.1,
     "ask for another initial "
     "rate of elbow",
     {"ends.initial_speed.elbow=5.72"},
     0},
};
enum { MISSES = sizeof misses / sizeof *misses };

static void what_a_row_misses_can_be_set(void **state) {
  (void)state;
  try_misses(misses, MISSES);
}

static void without_a_file_there_are_no_settings(void **state) {
  (void)state;
  try_without_keys(misses, MISSES);
}

static void new_values_are_rounded_outward(void **state) {
  (void)state;
  assert_close(ambulo__outward(0.123449, 1), 0.1235, 1e-15);
  assert_close(ambulo__outward(0.123451, 0), 0.1234, 1e-15);
  assert_close(ambulo__outward(-123.44, 0), -123.5, 1e-12);
  assert_close(ambulo__outward(-123.46, 1), -123.4, 1e-12);
  assert_close(ambulo__outward(0.25, 1), 0.25, 1e-15);
  assert_true(ambulo__outward(0.0, 1) == 0.0 && isinf(ambulo__outward(INFINITY, 1)));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_a_row_misses_can_be_set),
                                     cmocka_unit_test(without_a_file_there_are_no_settings),
                                     cmocka_unit_test(new_values_are_rounded_outward)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
