/* Terms, margins, tubes, places of obstacles, places and tolerances of reaches: by hand against
 * central differences. */
#include "support/sensitivity_check.h"

#define STANDING                                                                                   \
  "time.intervals=10", "trajectory.intervals=6",                                                   \
      "objective=[{term: torque_squared, scale: "                                                  \
      "{default: 0.001}}, {term: upright, weight: 10, "                                            \
      "points: [lumbar, head_top]}]"

/* a box that is turned, a bar; to be within a tolerance, and there */
static void obstacles_and_places(void **state) {
  (void)state;
  static const setting c = {
      "models/reach_standing.yaml",
      {STANDING,
       "obstacles=[{name: fence, center: [0.15, 0.1, 0.5], half_size: [0.1, 0.2, 0.3], "
       "heading: 20}, {name: bar, from: [0.1, -1, 1.4], to: [0.2, 1, 1.3], radius: 0.02, "
       "margin: 0.03, capsules: [head, trunk]}]",
       "constraints.reach=[{point: head_top, place: [0.45, 0.2, 1.5], at: 1.2, tolerance: 0.005}, "
       "{point: knee_l, place: [0.1, 0.1, 0.5], at: [0.7, 1.3]}, "
       "{point: head_top, relative_to: hip_l, place: [0.3, 0, 0.5], at: 1.2, tolerance: 0.01}]",
       "constraints.collision.margin=0.05"},
      {"obstacles[fence].center[0]", "obstacles[fence].center[1]", "obstacles[fence].center[2]",
       "obstacles[fence].margin", "obstacles[bar].from[0]", "obstacles[bar].from[1]",
       "obstacles[bar].to[2]", "obstacles[bar].margin", "constraints.collision.margin",
       "constraints.reach[0].place[0]", "constraints.reach[0].place[1]",
       "constraints.reach[0].place[2]", "constraints.reach[0].tolerance",
       "constraints.reach[1].place[2]", "constraints.reach[2].place[0]",
       "constraints.reach[2].place[2]", "constraints.reach[2].tolerance",
       "constraints.ground_height"}};
  check(&c, "time.duration");
}

/* what is allowed for between the nodes goes with the duration */
static void legs_of_a_walk(void **state) {
  (void)state;
  static const setting c = {"models/walk_normal.yaml",
                            {"time.intervals=16", "trajectory.intervals=6", "time.duration=null",
                             "gait.step_time=0.54",
                             "constraints.collision={pairs: automatic, margin: 0.02}"},
                            {"constraints.collision.margin", "gait.step_time", "gait.step_width"}};
  check(&c, NULL);
}

static void a_walk_with_other_terms(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"load={link: pelvis, mass: 20, position: [-0.18, 0.35, 0]}",
       "objective=[{term: clearance, height: 0.06, weight: 3}, {term: posture, name: rests, "
       "scale: {knee_angle_r: 1, knee_angle_l: 1, hip_adduction_r: 2, hip_adduction_l: 2}, "
       "angles: {knee_angle_r: 10, knee_angle_l: 10, hip_adduction_r: 3, hip_adduction_l: 3}}, "
       "{term: mechanical_power, weight: 0.01}, {term: upright, weight: 10, "
       "points: [pelvis, head_top]}, {term: upright, name: right, points: [hip_r, heel_r]}, {term: "
       "upright, name: left, points: [hip_l, heel_l]}, {term: ground_force, weight: 0.3}]",
       "time.duration=null", "gait.speed=1.26"},
      {"objective[clearance].height", "objective[rests].angles.hip_adduction_r",
       "objective[rests].angles.knee_angle_r", "gait.speed", "gait.step_length",
       "constraints.clearance.turn", "constraints.contact_tolerance",
       "constraints.orientation_tolerance", "constraints.clearance.ceiling", "load.mass"}};
  check(&c, NULL);
}

static void a_walk_in_tubes(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_tracking.yaml",
      {"constraints.tubes=[{reference: walk_tracking_angles.csv, coordinates: {hip_flexion_r: "
       "20}}, "
       "{reference: walk_tracking_angles.csv, coordinates: {knee_angle_r: 9}}]",
       "ends=null"},
      {"constraints.tubes[0].coordinates.hip_flexion_r",
       "constraints.tubes[1].coordinates.knee_angle_r"}};
  check(&c, "time.duration");
}

static void a_step_in_a_tube_on_both_sides(void **state) {
  (void)state;
  static const setting c = {"models/walk_tracking.yaml",
                            {"constraints.tubes=[{reference: walk_tracking_angles.csv, "
                             "coordinates: {knee_angle_r: 20, knee_angle_l: 20}}]"},
                            {"constraints.tubes[0].coordinates.knee_angle_r"}};
  check(&c, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(obstacles_and_places), cmocka_unit_test(legs_of_a_walk),
      cmocka_unit_test(a_walk_with_other_terms), cmocka_unit_test(a_walk_in_tubes),
      cmocka_unit_test(a_step_in_a_tube_on_both_sides)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
