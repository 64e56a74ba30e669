/* What is suggested where feet miss their places, their angles or their height in the air. */
#include "support/suggest_cases.h"

static const miss misses[] = {
    {WALK,
     {0},
     "contact",
     "heel_l",
     "ahead",
     -0.003,
     "is 0.003 m further ahead than its contact lets",
     {"constraints.contact_tolerance=0.0052"},
     0},
    {WALK,
     {0},
     "contact",
     "left",
     "left side low",
     -0.02,
     "widen the tolerance of its direction",
     {"constraints.orientation_tolerance=0.0201"},
     1},
    {WALK, {0}, "contact", "left", "toes high", -0.01, "to turn further", {0}, 1},
    {WALK,
     {0},
     "clearance",
     "ball_r",
     "low",
     -0.005,
     "lower the clearance of feet in the air from "
     "0.02 m to ",
     {"constraints.clearance.height="},
     0},
    {WALK,
     {0},
     "clearance",
     "ball_r",
     "high",
     -0.01,
     "let the height of feet in the air be up to "
     "0.3602",
     {"constraints.clearance.ceiling=0.3602"},
     0},
    {WALK,
     {0},
     "clearance",
     "right",
     "turned left",
     -0.05,
     "let the turn (sine)",
     {"constraints.clearance.turn=0.2505"},
     0},
    {WALK,
     {0},
     "clearance",
     "heel_r",
     "to the right",
     -0.01,
     "outward of feet",
     {"constraints.clearance.outward=0.0702"},
     0},
    {WALK,
     {0},
     "mirrored",
     "pelvis_ty",
     "value",
     -0.08,
     "stay 0.08 m apart",
     {"ends.kind=free"},
     1},
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_a_row_misses_can_be_set),
                                     cmocka_unit_test(without_a_file_there_are_no_settings)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
