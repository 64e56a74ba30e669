/* Feet that pass: the solved motions keep the gap that they were asked to keep, and the same
 * motions without it do not.
 *
 * Seen from above, feet are the lines from their heel to their toe centre; nearest of all on a grid
 * ten times as fine. */
#include "support/test.h"

#include "ambulo/tools/tools.h"

enum { FEET = 2, SETTINGS = 4 };

static const double width = 0.08; /* twice half the sole of the shipped bodies */

static double from_line(const double *p, const double *a, const double *b) {
  double u[2] = {b[0] - a[0], b[2] - a[2]}, w[2] = {p[0] - a[0], p[2] - a[2]};
  double s = (u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1]);
  s = fmin(1.0, fmax(0.0, s));
  return hypot(w[0] - s * u[0], w[1] - s * u[1]);
}

static double nearest(const ambulo_problem *problem, const double *x) {
  const ambulo_model *m = ambulo_problem_model(problem);
  const size_t samples = 10 * (size_t)ambulo_problem_node_count(problem);
  const size_t columns = 3 * (size_t)ambulo_model_point_count(m);
  double *times = calloc(samples, sizeof *times), least = INFINITY;
  double *points = calloc(samples * columns, sizeof *points);
  ambulo_workspace *workspace = NULL;
  assert_true(times && points);
  for (size_t k = 0; k < samples; k++)
    times[k] = ambulo_problem_duration(problem) * (double)k / (double)(samples - 1);
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .points = points};
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  assert_int_equal(ambulo_problem_motion(problem, workspace, x, (int)samples, times, &motion),
                   AMBULO_OK);
  for (size_t k = 0; k < samples; k++) {
    for (int foot = 0; foot < FEET; foot++) {
      const ambulo_foot *own = ambulo_model_foot(m, foot), *other = ambulo_model_foot(m, 1 - foot);
      const double *all = points + k * columns;
      const double *heel = all + 3 * other->heel_center, *toe = all + 3 * other->toe_center;
      least = fmin(least, from_line(all + 3 * own->heel_center, heel, toe));
      least = fmin(least, from_line(all + 3 * own->toe_center, heel, toe));
    }
  }
  ambulo_workspace_free(workspace);
  free(times);
  free(points);
  return least - width;
}

static double gap_of(const char *path, const char *const *settings, int count) {
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  const char *all[SETTINGS + 1] = {"constraints.collision=off"}; /* of legs: feet are asked about */
  for (int i = 0; i < count; i++) all[i + 1] = settings[i];
  assert_int_equal(ambulo_problem_load(path, all, count + 1, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  double gap = nearest(problem, ambulo_result_x(result));
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  return gap;
}

/* without the rows they pass through each other; half a millimetre between the nodes */
static void feet_keep_their_gap(void **state) {
  (void)state;
  static const struct {
    const char *path;
    const char *off[SETTINGS], *on[SETTINGS];
    int settings;
    double gap, through;
  } walks[] = {
      {"models/walk_normal.yaml",
       {"gait.step_width=0.04"},
       {"gait.step_width=0.04", "constraints.clearance.feet=0.01"},
       2,
       0.01,
       -0.065},
      {"models/walk_normal.yaml",
       {"gait.step_width=0.04", "constraints.clearance.outward=0.1"},
       {"gait.step_width=0.04", "constraints.clearance.outward=0.1",
        "constraints.clearance.feet=0.02"},
       3,
       0.02,
       -0.065},
      {"models/walk_turn.yaml",
       {"constraints.clearance={height: 0.02, tip_from: 0.3}"},
       {"constraints.clearance.feet=0.02"},
       1,
       0.02,
       -0.065},
  };
  for (size_t i = 0; i < sizeof walks / sizeof *walks; i++) {
    int count = walks[i].settings;
    double off = gap_of(walks[i].path, walks[i].off, count > 1 ? count - 1 : 1);
    double on = gap_of(walks[i].path, walks[i].on, count);
    if (!(on >= walks[i].gap - 0.001 && off < walks[i].through))
      print_error("%s: gap %.4f m with the rows, %.4f m without\n", walks[i].path, on, off);
    assert_true(on >= walks[i].gap - 0.001 && off < walks[i].through);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(feet_keep_their_gap)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
