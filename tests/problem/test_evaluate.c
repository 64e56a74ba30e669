/* Objective and rows at a point, caching, non-finite points. */
#include "support/arm.h"
#include "support/test.h"
#include "problem/nlp.h"

/* a pendulum at rest: constant torque, closed-form objective */
static void torque_of_an_arm_at_rest_integrates_to_t_tau_squared(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  assert_non_null(model);
  ambulo_problem_definition definition = arm_definition(model);
  definition.duration = 2.0;
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  double *x = calloc((size_t)ambulo_problem_variable_count(problem), sizeof *x);
  double g = 9.81, lower = 1.5 * g * (0.25 - 0.12);
  double upper = 2.0 * g * (0.3 - 0.16) + 1.5 * g * (0.3 + 0.25 - 0.12);
  double objective = 0.0;
  assert_int_equal(ambulo_problem_evaluate(problem, workspace, x, &objective, NULL, NULL),
                   AMBULO_OK);
  assert_close(objective, 2.0 * (upper * upper + lower * lower), 1e-12);
  free(x);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

static void same_point_is_evaluated_once(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition definition = arm_definition(model);
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  int n = ambulo_problem_variable_count(problem);
  double *x = calloc((size_t)n, sizeof *x), *gradient = calloc((size_t)n, sizeof *gradient);
  arm_point(x, n, 0.3);
  double objective;
  for (int i = 0; i < 3; i++) {
    assert_int_equal(ambulo_problem_evaluate(problem, workspace, x, &objective, NULL, NULL), 0);
    assert_int_equal(ambulo_problem_gradient(problem, workspace, x, 1.0, NULL, gradient), 0);
  }
  assert_int_equal(workspace->evaluations, 1);
  x[n - 1] += 1e-9;
  assert_int_equal(ambulo_problem_evaluate(problem, workspace, x, &objective, NULL, NULL), 0);
  assert_int_equal(workspace->evaluations, 2);
  free(x);
  free(gradient);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

static void non_finite_point_is_refused_and_outputs_stay(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition definition = arm_definition(model);
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  int n = ambulo_problem_variable_count(problem);
  double *x = calloc((size_t)n, sizeof *x);
  x[3] = NAN;
  double objective = 77.0;
  assert_int_equal(ambulo_problem_evaluate(problem, workspace, x, &objective, NULL, NULL),
                   AMBULO_E_NUMERIC);
  assert_true(objective == 77.0);
  /* the workspace recovers */
  x[3] = 0.0;
  assert_int_equal(ambulo_problem_evaluate(problem, workspace, x, &objective, NULL, NULL), 0);
  assert_true(isfinite(objective));
  free(x);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

typedef struct spoiled_row {
  int node;
  double value; /* there */
} spoiled_row;

static double spoiled(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  const spoiled_row *row = user;
  (void)gradient;
  return state->node == row->node ? row->value : 1.0;
}

/* the objective is finite: only the rows tell */
static void one_row_that_is_not_finite_is_noticed(void **state) {
  (void)state;
  static const double values[] = {NAN, INFINITY, -INFINITY, 1.0};
  spoiled_row row = {0, 0.0};
  ambulo_user_row user = {"spoiled", "-", AMBULO_NOT_NEGATIVE, 0.0, 1.0, spoiled, &row};
  ambulo_model *model = arm_create();
  ambulo_problem_definition definition = arm_definition(model);
  definition.user_rows = &user;
  definition.user_row_count = 1;
  ambulo_problem *problem = NULL;
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  double *x = calloc((size_t)ambulo_problem_variable_count(problem), sizeof *x);
  for (int k = 0; k < ambulo_problem_node_count(problem); k++) {
    for (int v = 0; v < 4; v++) {
      row.node = k;
      row.value = values[v];
      x[0] += 1e-3;
      double objective = 77.0;
      ambulo_status status = ambulo_problem_evaluate(problem, workspace, x, &objective, NULL, NULL);
      assert_int_equal(status, v < 3 ? AMBULO_E_NUMERIC : AMBULO_OK);
      assert_true((objective == 77.0) == (v < 3));
    }
  }
  free(x);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

static void rows_are_what_their_names_say(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition definition = arm_definition(model);
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  int n = ambulo_problem_variable_count(problem), m = ambulo_problem_row_count(problem);
  double *x = calloc((size_t)n, sizeof *x), *rows = calloc((size_t)m, sizeof *rows);
  /* constant control points: q is constant, rates are zero */
  for (int i = 0; i < n; i++) x[i] = i % 2 ? 0.7 : -0.4;
  assert_int_equal(ambulo_problem_evaluate(problem, workspace, x, NULL, NULL, rows), 0);
  int seen = 0;
  for (int r = 0; r < m; r++) {
    ambulo_row row;
    assert_int_equal(ambulo_problem_row(problem, r, &row), AMBULO_OK);
    int elbow = strcmp(row.subject, "elbow") == 0;
    double q = elbow ? 0.7 : -0.4;
    if (strcmp(row.family, "joint_limit") == 0) {
      int upper = strcmp(row.detail, "upper") == 0;
      assert_close(rows[r], upper ? 2.5 - q : q + 2.0, 1e-13);
      seen++;
    } else if (strcmp(row.family, "speed_limit") == 0) {
      assert_close(rows[r], 8.0, 1e-12);
      seen++;
    }
  }
  assert_int_equal(seen, 2 * 2 * 2 * 11);
  assert_int_equal(ambulo_problem_equality_count(problem), 8);
  free(x);
  free(rows);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

/* the node before a time and the share of the way to the next; times outside stand at the ends */
static void nodes_before_times(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
  int last = ambulo_problem_node_count(problem) - 1;
  double share = -1.0, end = ambulo_problem_node_time(problem, last);
  for (int k = 0; k < last; k++) {
    double from = ambulo_problem_node_time(problem, k),
           to = ambulo_problem_node_time(problem, k + 1);
    assert_int_equal(ambulo__node_at(problem, from, &share), k);
    assert_close(share, 0.0, 1e-12);
    assert_int_equal(ambulo__node_at(problem, from + 0.25 * (to - from), &share), k);
    assert_close(share, 0.25, 1e-12);
  }
  assert_int_equal(ambulo__node_at(problem, -5.0, &share), 0);
  assert_true(share == 0.0);
  assert_int_equal(ambulo__node_at(problem, 5.0 * end, &share), last - 1);
  assert_true(share == 1.0);
  assert_true(isnan(ambulo_problem_node_time(problem, -1)));
  assert_true(isnan(ambulo_problem_node_time(problem, last + 1)));
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nodes_before_times),
      cmocka_unit_test(torque_of_an_arm_at_rest_integrates_to_t_tau_squared),
      cmocka_unit_test(same_point_is_evaluated_once),
      cmocka_unit_test(non_finite_point_is_refused_and_outputs_stay),
      cmocka_unit_test(one_row_that_is_not_finite_is_noticed),
      cmocka_unit_test(rows_are_what_their_names_say),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
