/* Bodies that overlap: shipped motions with the default pairs have none beyond a millimetre, and
 * without rows between bodies all that overlap is found, told by name and exact distance.
 */
#include "ambulo/tools/tools.h"
#include "problem/nlp.h"
#include "support/test.h"

#include <string.h>

static void solve(const char *path, const char *setting, ambulo_problem **problem,
                  ambulo_result **result) {
  assert_int_equal(ambulo_problem_load(path, &setting, setting ? 1 : 0, NULL, NULL, problem),
                   AMBULO_OK);
  assert_int_equal(ambulo_solve(*problem, NULL, NULL, NULL, NULL, result), AMBULO_OK);
  assert_true(ambulo_verdict_is_solution(ambulo_result_verdict(*result)));
}

static const ambulo_dense_audit *overlaps(const ambulo_result *result) {
  return ambulo_result_dense_audit(result);
}

/* the deepest of a pair in either order, m */
static double depth_of(const ambulo_result *result, const char *one, const char *other) {
  for (int i = 0; i < overlaps(result)->overlap_count; i++) {
    const ambulo_overlap *o = &overlaps(result)->overlaps[i];
    if ((!strcmp(o->one, one) && !strcmp(o->other, other)) ||
        (!strcmp(o->one, other) && !strcmp(o->other, one)))
      return o->depth;
  }
  return 0.0;
}

static void check_apart(const char *path) {
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  solve(path, NULL, &problem, &result);
  for (int i = 0; i < overlaps(result)->overlap_count; i++) {
    const ambulo_overlap *o = &overlaps(result)->overlaps[i];
    print_message("%s: %s in %s by %g m at %g s\n", path, o->one, o->other, o->depth, o->time);
  }
  assert_int_equal(overlaps(result)->overlap_count, 0);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void walks_keep_their_legs_apart(void **state) {
  (void)state;
  check_apart("models/walk_normal.yaml");
  check_apart("models/walk_loaded.yaml");
  check_apart("models/walk_uphill.yaml");
}

static void runs_keep_their_legs_apart(void **state) {
  (void)state;
  check_apart("models/run.yaml");
  check_apart("models/run_forefoot.yaml");
}

static void overlaps_without_rows_are_told(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  solve("models/walk_normal.yaml", "constraints.collision=off", &problem, &result);
  assert_int_equal(ambulo_problem_pairs(problem, 0, NULL), 0);
  assert_true(depth_of(result, "shank_r", "shank_l") > 0.01);
  assert_true(depth_of(result, "thigh_r", "thigh_l") > 0.01);
  const ambulo_overlap *deepest = overlaps(result)->overlaps;
  for (int i = 1; i < overlaps(result)->overlap_count; i++)
    assert_true(overlaps(result)->overlaps[i].depth <= deepest->depth);
  assert_true(deepest->time > 0.0 && deepest->time < ambulo_problem_duration(problem));
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(walks_keep_their_legs_apart),
      cmocka_unit_test(runs_keep_their_legs_apart),
      cmocka_unit_test(overlaps_without_rows_are_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
