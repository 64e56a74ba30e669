/* Files with the prescribed split of the load, tests/two_step/, still load, solve and come to the
 * objectives that they had as shipped walks. */
#include "support/problem_path.h"
#include "support/test.h"

#include "ambulo/tools/tools.h"

static void files_with_a_prescribed_split_still_solve(void **state) {
  (void)state;
  static const struct {
    const char *name;
    double objective;
  } walks[] = {{"two_step/walk_normal", 0.06399},    {"two_step/walk_normal_21", 0.05942},
               {"two_step/walk_slow", 0.05692},      {"two_step/walk_fast", 0.07987},
               {"two_step/walk_loaded", 0.11389},    {"two_step/walk_uphill", 0.05793},
               {"two_step/walk_asymmetric", 0.11515}};
  for (size_t i = 0; i < sizeof walks / sizeof *walks; i++) {
    char path[96];
    ambulo_problem *problem = NULL;
    ambulo_result *result = NULL;
    assert_int_equal(ambulo_problem_load(problem_path(walks[i].name, path, sizeof path), NULL, 0,
                                         NULL, NULL, &problem),
                     AMBULO_OK);
    assert_int_equal(ambulo_problem_ground_reaction(problem)->kind, AMBULO_REACTION_TWO_STEP);
    assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
    assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
    assert_close(ambulo_result_objective(result) / walks[i].objective, 1.0, 1e-3);
    ambulo_result_free(result);
    ambulo_problem_free(problem);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(files_with_a_prescribed_split_still_solve)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
