/* Footholds of any height, slope and heading: every number that a file has a name for, by hand
 * against central differences. */
#include "ambulo/tools/load.h"
#include "support/sensitivity_check.h"
#include "support/shared_ground.h"

#define STAIRS                                                                                     \
  "contacts=[{foot: left, mode: flat, from: 0, to: 0.585, place: [0, 0.06, 0.01], "                \
  "heading: 4, normal: [-0.1, 0.05, 1]}, "                                                         \
  "{foot: left, mode: toe, from: 0.585, to: 0.65, place: [0, 0.06, 0.01], heading: 5, "            \
  "normal: [-0.1, 0.05, 1]}, "                                                                     \
  "{foot: right, mode: toe, from: 0, to: 0.13, place: [-0.29, -0.06, -0.16], heading: -5, "        \
  "normal: [-0.1, -0.05, 1]}]"

static void up_stairs(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"gait=null", "ends={kind: mirrored, order: 2, travel: 0.29, rise: 0.17}", SHARED,
       "time.duration=0.65", "time.intervals=40", "ground={slope: 2}", STAIRS},
      {"contacts[0].place[0]", "contacts[0].place[1]", "contacts[0].place[2]",
       "contacts[0].heading", "contacts[0].normal[0]", "contacts[0].normal[1]",
       "contacts[0].normal[2]", "ground_reaction.moment_arm", "constraints.clearance.height",
       "constraints.clearance.inward", "constraints.ground_height"}};
  check(&c, "time.duration");
  /* footholds at both ends would have to go along */
  expect_absent(&c, (const char *const[]){"ends.rise", "ends.travel", "contacts[2].place[2]",
                                          "contacts[1].normal[0]", NULL});
}

/* up, then down, off a steep side; events of one foot within the swing of the other; ends that do
 * not repeat, on events */
#define UP_AND_DOWN                                                                                \
  "contacts=[{foot: left, mode: flat, from: 0, to: 0.35, place: [0, 0.06, 0.02], heading: 4}, "    \
  "{foot: left, mode: toe, from: 0.35, to: 0.62, place: [0.001, 0.06, 0.021], heading: 5, "        \
  "normal: [-0.1, 0.05, 1]}, "                                                                     \
  "{foot: right, mode: toe, from: 0, to: 0.13, place: [-0.29, -0.06, -0.16], heading: -5, "        \
  "normal: [0, -1.7, 1]}, "                                                                        \
  "{foot: right, mode: heel, from: 0.45, to: 0.55, place: [0.3, -0.07, 0.15], heading: -3, "       \
  "normal: [0.2, -0.1, 2]}, "                                                                      \
  "{foot: right, mode: flat, from: 0.55, to: 1, place: [0.302, -0.07, 0.152], heading: -2, "       \
  "normal: [0.2, -0.1, 2]}, "                                                                      \
  "{foot: left, mode: flat, from: 0.85, to: 1, place: [0.6, 0.08, -0.05], heading: 2, "            \
  "normal: [0.1, 0.02, 1]}]"

static void up_and_down_on_events(void **state) {
  (void)state;
  static const setting c = {"tests/support/walk_rigid.yaml",
                            {"gait=null", "ends=null", SHARED, "time.duration=1",
                             "time.intervals=56", UP_AND_DOWN, "ground={slope: 2}",
                             "constraints.ground_penetration=true", ON_EVENTS},
                            {"contacts[2].place[2]", "contacts[2].heading", "contacts[3].place[0]",
                             "contacts[3].place[2]", "contacts[3].normal[0]", "contacts[3].heading",
                             "contacts[4].heading", "contacts[5].place[2]", "contacts[5].normal[1]",
                             "contacts[5].from", "contacts[2].to", "contacts[3].from",
                             "contacts[1].to", "contacts[5].place[1]", "ground.slope"}};
  check(&c, "time.duration");
}

static void up_and_down_on_arcs(void **state) {
  (void)state;
  static const setting c = {"tests/support/walk_rigid.yaml",
                            {"gait=null", "ends=null", SHARED, "time.duration=1",
                             "time.intervals=40", UP_AND_DOWN, "ground={slope: 2}", ARCS},
                            {"contacts[2].place[2]", "contacts[2].heading", "contacts[3].place[0]",
                             "contacts[3].normal[0]", "contacts[3].heading",
                             "contacts[1].normal[0]", "contacts[1].place[2]",
                             "constraints.contact_tolerance"}};
  check(&c, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(up_stairs),
      cmocka_unit_test(up_and_down_on_events),
      cmocka_unit_test(up_and_down_on_arcs),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
