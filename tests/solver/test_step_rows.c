/* Feet that pass the edges of steps: footholds, heights, times and the ground, by hand against
 * central differences, on grids on events. */
#include "support/sensitivity_check.h"
#include "ambulo/tools/load.h"

/* two steps down, the way turned a little to the side, the other foot on the step between */
#define DOWN                                                                                       \
  "contacts=[{foot: left, mode: flat, from: 0, to: 0.35, place: [0, 0.06, 0.2]}, "                 \
  "{foot: left, mode: toe, from: 0.35, to: 0.51, place: [0, 0.06, 0.2]}, "                         \
  "{foot: right, mode: flat, from: 0, to: 0.13, place: [-0.02, -0.06, 0.2]}, "                     \
  "{foot: right, mode: flat, from: 0.413, to: 1.02, place: [0.27, -0.1, 0.02]}, "                  \
  "{foot: right, mode: toe, from: 1.02, to: 1.08, place: [0.27, -0.1, 0.02]}, "                    \
  "{foot: left, mode: flat, from: 0.9, to: 1.1, place: [0.62, 0.04, -0.18]}]"

static void down_two_steps(void **state) {
  (void)state;
  static const setting c = {"models/stairs_up.yaml",
                            {"ends=null", "time.duration=1.1", "time.intervals=96",
                             "trajectory.intervals=20", "ground={slope: 2}", DOWN},
                            {"contacts[0].place[0]", "contacts[0].place[1]", "contacts[0].place[2]",
                             "contacts[2].place[0]", "contacts[2].place[2]", "contacts[3].place[0]",
                             "contacts[3].place[1]", "contacts[3].place[2]", "contacts[5].place[0]",
                             "contacts[5].place[2]", "contacts[5].heading", "contacts[2].to",
                             "contacts[3].from", "contacts[5].from",
                             "constraints.clearance.ceiling", "constraints.ground_height"}};
  check(&c, "contacts[1].place[0]"); /* goes along with contact 0 */
}

/* up past the other foot's step, which is lower than half-way up: the plane lies on the upper edge
 */
#define UP                                                                                         \
  "contacts=[{foot: right, mode: flat, from: 0, to: 0.17, place: [-0.3, -0.06, 0]}, "              \
  "{foot: left, mode: flat, from: 0, to: 0.57, place: [0, 0.08, 0.1]}, "                           \
  "{foot: left, mode: toe, from: 0.57, to: 0.72, place: [0, 0.08, 0.1]}, "                         \
  "{foot: right, mode: flat, from: 0.61, to: 0.8, place: [0.28, -0.07, 0.3]}]"

static void up_two_steps(void **state) {
  (void)state;
  static const setting c = {
      "models/stairs_up.yaml",
      {"ends=null", "time.duration=0.8", "time.intervals=72", "trajectory.intervals=18", UP},
      {"contacts[0].place[0]", "contacts[0].place[1]", "contacts[0].place[2]",
       "contacts[1].place[0]", "contacts[1].place[2]", "contacts[3].place[0]",
       "contacts[3].place[1]", "contacts[3].place[2]", "contacts[0].to", "contacts[3].from",
       "contacts[1].to", "constraints.clearance.height", "constraints.ground_height"}};
  check(&c, NULL);
}

/* equal steps: the plane lies on both edges, and raising one of them alone has a kink */
#define EQUAL                                                                                      \
  "contacts=[{foot: right, mode: flat, from: 0, to: 0.17, place: [-0.3, -0.06, 0]}, "              \
  "{foot: left, mode: flat, from: 0, to: 0.57, place: [0, 0.06, 0.15]}, "                          \
  "{foot: left, mode: toe, from: 0.57, to: 0.72, place: [0, 0.06, 0.15]}, "                        \
  "{foot: right, mode: flat, from: 0.61, to: 0.8, place: [0.3, -0.06, 0.3]}]"

static void kinks_are_left_out(void **state) {
  (void)state;
  static const setting c = {
      "models/stairs_up.yaml",
      {"ends=null", "time.duration=0.8", "time.intervals=72", "trajectory.intervals=18", EQUAL},
      {"contacts[0].place[0]", "contacts[3].place[1]"}};
  check(&c, NULL);
  expect_absent(&c, (const char *const[]){"contacts[0].place[2]", "contacts[1].place[2]",
                                          "contacts[3].place[2]", NULL});
  ambulo_problem *problem =
      NULL; /* nor can they be free: that is known before there is a solution */
  const char *const overrides[] = {"model=lower_body_18_rigid.yaml",
                                   "ends=null",
                                   "time.duration=0.8",
                                   "time.intervals=72",
                                   "trajectory.intervals=18",
                                   EQUAL,
                                   "free={\"contacts[1].place[2]\": [0.1, 0.2]}"};
  assert_int_equal(ambulo_problem_load("models/stairs_up.yaml", overrides, 6, NULL, NULL, &problem),
                   AMBULO_OK);
  ambulo_problem_free(problem);
  assert_int_equal(ambulo_problem_load("models/stairs_up.yaml", overrides, 7, NULL, NULL, &problem),
                   AMBULO_E_SCHEMA);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(down_two_steps),
      cmocka_unit_test(up_two_steps),
      cmocka_unit_test(kinks_are_left_out),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
