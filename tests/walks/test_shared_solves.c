/* What contacts that share the load carry at solutions. */
#include "support/contact_index.h"
#include "ambulo/tools/tools.h"
#include "support/test.h"

#define STANDING                                                                                   \
  "ambulo: 1\nkind: problem\nname: stand\nmodel: models/lower_body_18.yaml\n"                      \
  "subject: {mass: 75, stature: 1.75, sex: male}\nangles: degrees\n"                               \
  "time: {duration: 1.0, intervals: 12}\ntrajectory: {basis: bspline, intervals: 6}\n"             \
  "contacts:\n"                                                                                    \
  "  - {foot: left, mode: flat, from: 0, to: 1, place: [0, 0.1]}\n"                                \
  "  - {foot: right, mode: flat, from: 0, to: 1, place: [0, -0.1]}\n"                              \
  "ground_reaction: {kind: shared}\n"                                                              \
  "constraints: {contact_tolerance: 0.002}\nends: {kind: periodic, travel: 0}\n"                   \
  "objective:\n"                                                                                   \
  "  - {term: torque_squared, scale: {default: 0.01}}\n"                                           \
  "  - {term: upright, weight: 10, points: [pelvis, head_top]}\n"                                  \
  "  - {term: acceleration, weight: 1e-4}\n"

/* who stands on both feet alike has half of the weight on each */
static void standing_feet_carry_half_each(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_workspace *workspace = NULL;
  assert_int_equal(
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = STANDING,
                                                      .length = strlen(STANDING),
                                                      .name = "stand",
                                                      .directory = "."},
                               NULL, NULL, &problem),
      AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  enum { TIMES = 9 };
  double times[TIMES], grf[6 * TIMES], cop[6 * TIMES], weight = 75.0 * 9.81;
  for (int k = 0; k < TIMES; k++) times[k] = k / (TIMES - 1.0);
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .grf = grf, .cop = cop};
  assert_int_equal(
      ambulo_problem_motion(problem, workspace, ambulo_result_x(result), TIMES, times, &motion),
      AMBULO_OK);
  for (int k = 0; k < TIMES; k++) {
    const double *right = grf + 6 * k, *left = right + 3, *place = cop + 6 * k;
    assert_close(right[1] / weight, 0.5, 1e-4); /* stands still, but for what the solver left */
    assert_close((left[1] - right[1]) / weight, 0.0, 1e-9);
    assert_close((left[0] - right[0]) / weight, 0.0, 1e-9);
    assert_close((left[2] + right[2]) / weight, 0.0, 1e-9);
    assert_close(place[0], place[3], 1e-9);
    assert_close(place[2], -place[5], 1e-9);
    assert_true(right[2] < 0.0); /* they push at the body between them */
  }
  ambulo_workspace_free(workspace);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* at most what the loading rate lets it carry; the forces' own bounds hold between the nodes */
static void a_solved_walk_loads_its_feet_in_time(void **state) {
  (void)state;
  static const char *const settings[] = {"ground_reaction={kind: shared, loading_rate: 12}",
                                         "time.grid=events",
                                         "trajectory.knots=events",
                                         "trajectory.degree=4",
                                         "trajectory.intervals=12",
                                         "time.intervals=32"};
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_workspace *workspace = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", settings, 6, NULL, NULL, &problem),
      AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  enum { TIMES = 26 };
  double times[TIMES], grf[6 * TIMES], weight = 75.0 * 9.81, last = 0.0;
  for (int k = 0; k < TIMES; k++) times[k] = 0.005 * k;
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .grf = grf};
  assert_int_equal(
      ambulo_problem_motion(problem, workspace, ambulo_result_x(result), TIMES, times, &motion),
      AMBULO_OK);
  int strikes = contact_index_at(problem, 0, 0.2) < 0;
  for (int k = 0; k < TIMES; k++) {
    double upward = grf[6 * k + 3 * strikes + 1] / weight;
    assert_true(upward <= 12.0 * times[k] + 0.02);
    last = fmax(last, upward);
  }
  assert_true(last > 0.5);
  ambulo_workspace_free(workspace);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(standing_feet_carry_half_each),
                                     cmocka_unit_test(a_solved_walk_loads_its_feet_in_time)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
