/* Margins, places of obstacles, places and tolerances of reaches: by hand against central
 * differences. */
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(obstacles_and_places),
                                     cmocka_unit_test(legs_of_a_walk)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
