/* What is suggested for rows on capsules, obstacles and places to reach: the sentence, and settings
 * that the problem takes. */
#include "support/suggest_cases.h"

#define OBSTACLE                                                                                   \
  "obstacles=[{name: crate, center: [1, 0, 0.1], half_size: [0.1, 0.1, 0.1], margin: 0.03}]"
static const char NORMAL[] = "models/walk_normal.yaml";
static const char STAND[] = "models/reach_standing.yaml";

static const miss cases[] = {
    {NORMAL,
     {"constraints.collision={margin: 0.02}"},
     "collision",
     "shank_r",
     "shank_l",
     -0.004,
     "m too near: keep a margin of 0.0158 m instead of 0.02 m",
     {"constraints.collision.margin=0.0158"},
     1},
    {NORMAL,
     {"constraints.collision={margin: 0.02}"},
     "collision",
     "shank_r",
     "shank_l",
     -0.06,
     "s: give them another way past each other",
     {0},
     1},
    {STAND,
     {OBSTACLE},
     "obstacle",
     "foot_l",
     "crate",
     -0.01,
     "foot_l comes within 0.0307 m of obstacle 'crate' at t = 2.4 s, 0.01 m too near: keep a "
     "margin "
     "of 0.0198 m instead of 0.03 m",
     {"obstacles[crate].margin=0.0198"},
     1},
    {STAND,
     {OBSTACLE},
     "obstacle",
     "foot_l",
     "crate",
     -0.09,
     "m inside obstacle 'crate' at t = 2.4 s: make 'crate' smaller",
     {0},
     1},
    {STAND,
     {0},
     "reach",
     "head_top",
     "up lower",
     -0.02,
     "head_top does not come to its place at t = 1.2 s, by 0.02 m (up lower)",
     {"constraints.reach[0].tolerance=0.0252"},
     1},
};

static void each_is_said_and_followed(void **state) {
  (void)state;
  try_misses(cases, (int)(sizeof cases / sizeof *cases));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(each_is_said_and_followed)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
