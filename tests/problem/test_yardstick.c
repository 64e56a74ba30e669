/* The shipped yardstick against an independent implementation: same control points, same
 * objective, same rows, to 1e-9. Objective terms are of size 60, rows of size 1. */
#include "problem/yardstick_reference.h"

#include "ambulo/solve.h"
#include "ambulo/tools/load.h"
#include "support/test.h"

enum { VARIABLES = 15 * 18, ROWS = 704 };

static ambulo_problem *load(int intervals) {
  char path[64];
  (void)snprintf(path, sizeof path, "models/yardstick_%d.yaml", intervals);
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &problem), AMBULO_OK);
  return problem;
}

static void point(int set, double *x, int count) {
  for (int j = 1; j <= count; j++) x[j - 1] = set ? 0.2 * cos(0.7 * j) : 0.1 * sin(j);
}

static void open_at(int set, ambulo_problem **problem, double *objective, double *rows) {
  double x[VARIABLES];
  *problem = load(12);
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(*problem, NULL, &workspace), AMBULO_OK);
  assert_int_equal(ambulo_problem_variable_count(*problem), VARIABLES);
  assert_int_equal(ambulo_problem_row_count(*problem), ROWS);
  point(set, x, VARIABLES);
  assert_int_equal(ambulo_problem_evaluate(*problem, workspace, x, objective, NULL, rows),
                   AMBULO_OK);
  ambulo_workspace_free(workspace);
}

static ambulo_row row_of(const ambulo_problem *problem, int index) {
  ambulo_row row;
  assert_int_equal(ambulo_problem_row(problem, index, &row), AMBULO_OK);
  return row;
}

/* position of a corner in the reference's order, -1 for other points */
static int corner_of(const char *name) {
  static const char *const corners[] = {"heel_lateral_l", "heel_medial_l", "toe_lateral_l",
                                        "toe_medial_l",   "heel_medial_r", "heel_lateral_r",
                                        "toe_medial_r",   "toe_lateral_r"};
  for (int c = 0; c < 8; c++) {
    if (strcmp(name, corners[c]) == 0) return c;
  }
  return -1;
}

static void check_heights(const ambulo_problem *problem, const double *rows,
                          const yardstick_values *want) {
  int seen = 0;
  for (int r = 0; r < ROWS; r++) {
    ambulo_row row = row_of(problem, r);
    if (strcmp(row.family, "ground_penetration") != 0) continue;
    int c = corner_of(row.subject);
    assert_true(c >= 0);
    assert_close(rows[r], want->height[row.node][c], 1e-9);
    assert_int_equal(row.relation == AMBULO_EQUAL, yardstick_contact[row.node] >> c & 1);
    seen++;
  }
  assert_int_equal(seen, 13 * 8);
}

static void check_in_order(const ambulo_problem *problem, const double *rows, const char *family,
                           const double *want, int count) {
  int seen = 0;
  for (int r = 0; r < ROWS; r++) {
    ambulo_row row = row_of(problem, r);
    if (strcmp(row.family, family) != 0) continue;
    assert_true(seen < count);
    if (fabs(rows[r] - want[seen]) > 1e-9) {
      print_error("%s %s %s at %g s\n", family, row.subject, row.detail, row.time);
    }
    assert_close(rows[r], want[seen], 1e-9);
    seen++;
  }
  assert_int_equal(seen, count);
}

static void check_limits(const ambulo_problem *problem, const double *rows,
                         const yardstick_values *want) {
  double lower = 0.0, upper = 0.0;
  for (int r = 0; r < ROWS; r++) {
    ambulo_row row = row_of(problem, r);
    if (strcmp(row.family, "joint_limit") != 0) continue;
    *(strcmp(row.detail, "lower") == 0 ? &lower : &upper) += rows[r];
  }
  assert_close(lower, want->lower_sum, 1e-11);
  assert_close(upper, want->upper_sum, 1e-11);
}

static void rows_and_objective_agree(void **state) {
  (void)state;
  for (int set = 0; set < 2; set++) {
    const yardstick_values *want = &yardstick_reference[set];
    ambulo_problem *problem = NULL;
    double objective = 0.0, rows[ROWS];
    open_at(set, &problem, &objective, rows);
    assert_close(objective, want->objective, 1e-11);
    check_heights(problem, rows, want);
    check_in_order(problem, rows, "foot_strike", want->strike, YARDSTICK_STRIKES);
    check_in_order(problem, rows, "zmp", want->zmp[0], 13 * 4);
    check_in_order(problem, rows, "periodic", want->periodic[0], 18 * 2);
    check_limits(problem, rows, want);
    ambulo_problem_free(problem);
  }
}

/* the finer grids: objective of both sets */
static void finer_grids_agree(void **state) {
  (void)state;
  static const double want[2][2] = {{2143.0801098583393, 12.263967436100835},
                                    {27197.38453027839, 40.775463499843575}};
  for (int grid = 0; grid < 2; grid++) {
    ambulo_problem *problem = load(grid ? 72 : 36);
    ambulo_workspace *workspace = NULL;
    assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
    int count = ambulo_problem_variable_count(problem);
    double *x = calloc((size_t)count, sizeof *x);
    for (int set = 0; set < 2; set++) {
      double objective = 0.0;
      point(set, x, count);
      assert_int_equal(ambulo_problem_evaluate(problem, workspace, x, &objective, NULL, NULL),
                       AMBULO_OK);
      assert_close(objective, want[grid][set], 1e-11);
    }
    free(x);
    ambulo_workspace_free(workspace);
    ambulo_problem_free(problem);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(rows_and_objective_agree),
                                     cmocka_unit_test(finer_grids_agree)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
