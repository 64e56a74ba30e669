/* Grids on events: f* is a smooth function of the event times, contacts hold up to them, and what
 * is predicted about finer grids comes true. */
#include "support/problem_path.h"
#include "support/test.h"

#include "ambulo/tools/tools.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SETTINGS = 5 };

static double slope_of_toe_off(const ambulo_problem *problem, const ambulo_result *result) {
  ambulo_sensitivity_list *list = NULL;
  double slope = NAN;
  assert_int_equal(ambulo_sensitivities(problem, result, NULL, &list), AMBULO_OK);
  for (int i = 0; i < list->count; i++)
    if (!strcmp(list->items[i].name, "gait.phases.toe_off")) slope = list->items[i].derivative;
  ambulo_sensitivities_free(list);
  return slope;
}

/* Feet press in boxes that are wide enough for f* to be smooth over the steps below: a rigid heel
 * that presses at its edge brings rows in and out within 0.003 of the stride.
 * *slope, if not NULL: of toe-off, from the sensitivities */
static ambulo_result *solve_with_slope(const char *const *settings, int count, double tolerance,
                                       double *slope) {
  const char *all[MOST_SETTINGS + 1] = {
      "ground_reaction.pressure={heel: [-0.02, 0.03], flat: [-0.005, 0.02], toe: [-0.02, 0.055], "
      "width: 0.035}"};
  assert_true(count <= MOST_SETTINGS);
  for (int i = 0; i < count; i++) all[i + 1] = settings[i];
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", all, count + 1, NULL, NULL, &problem),
      AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  if (tolerance > 0.0) options.optimality_tolerance = options.feasibility_tolerance = tolerance;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  if (slope) *slope = slope_of_toe_off(problem, result);
  ambulo_problem_free(problem);
  return result;
}

static ambulo_result *solve_walk(const char *const *settings, int count, double tolerance) {
  return solve_with_slope(settings, count, tolerance, NULL);
}

/* f* with the rear foot's toe-off at that part of the stride; 12 intervals of degree 4 */
static double best_at(double toe_off, const char *grid, const char *knots) {
  char toe[64];
  (void)snprintf(toe, sizeof toe, "gait.phases.toe_off=%.17g", toe_off);
  const char *const settings[] = {grid, knots, "trajectory.degree=4", "trajectory.intervals=12",
                                  toe};
  ambulo_result *result = solve_walk(settings, 5, 1e-9); /* as far as it goes */
  double value = ambulo_result_objective(result);
  assert_true(ambulo_result_audit(result)->kkt <= 2e-4);
  ambulo_result_free(result);
  return value;
}

/* df* / dtoe_off at .62 without another solve */
static double slope_by_hand(void) {
  static const char *const settings[] = {"time.grid=events", "trajectory.knots=events",
                                         "trajectory.degree=4", "trajectory.intervals=12"};
  double slope;
  ambulo_result_free(solve_with_slope(settings, 4, 1e-5, &slope));
  return slope;
}

/* toe-off at .62 of the stride is node 6 of 25 equally spaced ones. There the uniform grid's f*
 * jumps by a tenth; on events central differences converge with the square of their step */
static void the_best_is_smooth_in_an_event_time(void **state) {
  (void)state;
  static const double steps[3] = {0.003, 0.0015, 0.00075};
  double slope[3];
  for (int i = 0; i < 3; i++) {
    double step = steps[i];
    slope[i] = (best_at(0.62 + step, "time.grid=events", "trajectory.knots=events") -
                best_at(0.62 - step, "time.grid=events", "trajectory.knots=events")) /
               (2.0 * step);
  }
  double ratio = (slope[0] - slope[1]) / (slope[1] - slope[2]);
  if (!(ratio > 2.5 && ratio < 6.5))
    print_error("slopes %.8f %.8f %.8f, ratio %g\n", slope[0], slope[1], slope[2], ratio);
  assert_true(ratio > 2.5 && ratio < 6.5); /* 4, and 1e-7 of noise in f*; first order: 2 */
  assert_true(fabs(slope[1] - slope[2]) < 1e-3 * fabs(slope[2]));
  double limit = (4.0 * slope[2] - slope[1]) / 3.0, by_hand = slope_by_hand();
  if (!(fabs(by_hand - limit) < 1e-3 * fabs(limit)))
    print_error("slope %.8f by hand, %.8f by solves\n", by_hand, limit);
  assert_true(fabs(by_hand - limit) < 1e-3 * fabs(limit));
  double jump = best_at(0.62 + 1e-4, "time.grid=uniform", "trajectory.knots=uniform") -
                best_at(0.62 - 1e-4, "time.grid=uniform", "trajectory.knots=uniform");
  assert_true(fabs(jump) >
              20.0 * 2e-4 * slope[2]); /* what this test would see without nodes there */
}

static double worst_between(const ambulo_result *result, const char *family, const char *unit) {
  const ambulo_dense_audit *audit = ambulo_result_dense_audit(result);
  for (int i = 0; i < audit->family_count; i++) {
    const ambulo_violation *v = &audit->families[i].violation;
    if (!strcmp(v->family, family) && !strcmp(v->unit, unit)) return v->worst;
  }
  return 0.0;
}

static ambulo_result *solve_rolling(const char *grid, const char *intervals) {
  const char *const settings[] = {grid, intervals, "trajectory.intervals=16"};
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_problem_load("models/walk_normal.yaml", settings, intervals ? 3 : 1, NULL,
                                       NULL, &problem),
                   AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  ambulo_problem_free(problem);
  return result;
}

static void contacts_hold_up_to_their_events(void **state) {
  (void)state;
  ambulo_result *before = solve_rolling("time.grid=uniform", "time.intervals=25");
  ambulo_result *after = solve_rolling("time.grid=events", "time.intervals=25");
  ambulo_result *shipped = solve_rolling("time.grid=events", NULL);
  assert_int_equal(ambulo_result_verdict(shipped), AMBULO_OPTIMAL);
  assert_true(worst_between(before, "contact", "m") > 0.008);
  assert_true(worst_between(after, "contact", "m") < 0.002);
  assert_true(worst_between(before, "contact", "rad") > 0.01);
  assert_true(worst_between(after, "contact", "rad") < 0.003);
  ambulo_result_free(before);
  ambulo_result_free(after);
  ambulo_result_free(shipped);
}

/* every family of rows and every term, at a point of no importance */
static void gradients_are_exact(void **state) {
  (void)state;
  enum { MOST = 40 };
  static const char *const walks[] = {"support/walk_rigid", "yardstick_12", "walk_tracking",
                                      "support/walker_2d_step"};
  static const char *const settings[] = {"time.grid=events", "trajectory.knots=events",
                                         "time.intervals=42", "trajectory.intervals=30"};
  for (size_t i = 0; i < sizeof walks / sizeof *walks; i++) {
    char path[64];
    ambulo_problem *problem = NULL;
    ambulo_workspace *workspace = NULL;
    ambulo_derivative_error errors[MOST];
    int count = 0;
    problem_path(walks[i], path, sizeof path);
    assert_int_equal(ambulo_problem_load(path, settings, 4, NULL, NULL, &problem), AMBULO_OK);
    assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
    int n = ambulo_problem_variable_count(problem);
    double *x = calloc((size_t)n, sizeof *x);
    for (int k = 0; k < n; k++) x[k] = 0.1 * sin(1.0 + 1.7 * k);
    assert_int_equal(
        ambulo_problem_check_derivatives(problem, workspace, x, 0.0, errors, MOST, &count),
        AMBULO_OK);
    assert_true(count > 3 && count <= MOST);
    for (int k = 0; k < count; k++) {
      if (!(errors[k].error <= 1e-7))
        print_error("%s %s: %g\n", walks[i], errors[k].family, errors[k].error);
      assert_true(errors[k].error <= 1e-7);
    }
    free(x);
    ambulo_workspace_free(workspace);
    ambulo_problem_free(problem);
  }
}

static void what_is_predicted_comes_true(void **state) {
  (void)state;
  const char *settings[] = {"time.grid=events", "trajectory.knots=events", "trajectory.degree=4",
                            "trajectory.intervals=12", "time.intervals=25"};
  ambulo_result *coarse = solve_walk(settings, 5, 0.0);
  char finer[64];
  const ambulo_dense_audit *audit = ambulo_result_dense_audit(coarse);
  assert_true(audit->failing > 0);
  assert_true(audit->intervals > 25 && audit->intervals < 100);
  assert_int_equal(audit->spline_intervals, 12);
  (void)snprintf(finer, sizeof finer, "time.intervals=%d", audit->intervals);
  ambulo_result_free(coarse);
  settings[4] = finer;
  ambulo_result *fine = solve_walk(settings, 5, 0.0);
  assert_int_equal(ambulo_result_verdict(fine), AMBULO_OPTIMAL);
  audit = ambulo_result_dense_audit(fine);
  if (audit->failing > 0) print_error("%s: %s\n", finer, audit->summary);
  assert_int_equal(audit->failing, 0);
  ambulo_result_free(fine);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_best_is_smooth_in_an_event_time),
      cmocka_unit_test(contacts_hold_up_to_their_events),
      cmocka_unit_test(gradients_are_exact),
      cmocka_unit_test(what_is_predicted_comes_true),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
