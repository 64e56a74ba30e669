/* The reverse sweep against row gradients, central differences, and a sabotaged callback. */
#include "problem/nlp.h"
#include "ambulo/tools/load.h"
#include "support/engine_fixture.h"
#include "support/problem_fixture.h"

static double hand_height(void *user, const ambulo_node_state *state,
                          ambulo_node_gradient *gradient) {
  double factor = *(const double *)user;
  if (gradient) {
    gradient->points[1] += 2.0 * factor * state->points[1] * state->qd[0];
    gradient->qd[0] += factor * state->points[1] * state->points[1];
    gradient->wrench[4] += 0.001;
    gradient->tau[1] += 0.01 * state->qdd[1];
    gradient->qdd[1] += 0.01 * state->tau[1];
    gradient->q[0] += cos(state->q[0]);
  }
  return factor * state->points[1] * state->points[1] * state->qd[0] + 0.001 * state->wrench[4] +
         0.01 * state->tau[1] * state->qdd[1] + sin(state->q[0]);
}

/* the same function with one slope forgotten */
static double hand_height_wrong(void *user, const ambulo_node_state *state,
                                ambulo_node_gradient *gradient) {
  double value = hand_height(user, state, gradient);
  if (gradient) gradient->qd[0] = 0.0;
  return value;
}

static double worst_error(fixture *f, const char *family) {
  ambulo_derivative_error errors[32];
  int count = 0;
  double worst = -1.0;
  assert_int_equal(
      ambulo_problem_check_derivatives(f->problem, f->workspace, f->x, 0.0, errors, 32, &count),
      AMBULO_OK);
  for (int i = 0; i < count; i++) {
    if (family && strcmp(errors[i].family, family) != 0) continue;
    if (errors[i].error > worst) worst = errors[i].error;
  }
  return worst;
}

/* rows of a family, or of all and the terms (NULL), by hand and by differences */
static void expect_agreement(fixture *f, const char *family) {
  double error = worst_error(f, family);
  if (!(error < 1e-7)) print_error("worst relative error %.3g\n", error);
  assert_true(error >= 0.0 && error < 1e-7);
}

/* the reverse sweep over weighted rows is the sum of their own gradients */
static void expect_sum_of_rows(fixture *f, double objective, const double *weights) {
  double *row = calloc((size_t)f->n, sizeof *row), *sum = calloc((size_t)f->n, sizeof *sum);
  assert_int_equal(ambulo_problem_gradient(f->problem, f->workspace, f->x, objective, NULL, sum),
                   0);
  for (int r = 0; r < f->m; r++) {
    if (weights[r] == 0.0) continue;
    assert_int_equal(ambulo_problem_row_gradient(f->problem, f->workspace, f->x, r, row), 0);
    for (int j = 0; j < f->n; j++) sum[j] += weights[r] * row[j];
  }
  assert_int_equal(
      ambulo_problem_gradient(f->problem, f->workspace, f->x, objective, weights, f->gradient), 0);
  for (int j = 0; j < f->n; j++) assert_close(f->gradient[j], sum[j], 1e-10);
  free(row);
  free(sum);
}

static void every_family_and_term_agrees_with_central_differences(void **state) {
  (void)state;
  static double factor = 0.8;
  fixture f = {.model = arm_create()};
  double scale[2] = {0.3, 0.5}, offset[2] = {1.0, -2.0}, reference[11 * 2];
  for (int i = 0; i < 22; i++) reference[i] = cos(0.3 * i);
  static const double passive[] = {0.2, 1.0, -0.1, -2.0, -0.3, -1.5, 0.2, 1.2};
  static const double strength[] = {20.0, 0.9, 0.4, 30.0, 0.7, -0.2,
                                    25.0, 0.8, 0.1, 15.0, 1.0, 0.3};
  static const double tendon[] = {0.0, 7.0};
  enum { KINDS = AMBULO_CLEARANCE + 1 };
  ambulo_term terms[KINDS + 1];
  for (int k = 1; k < KINDS; k++) { /* 0 is none */
    terms[k] = ambulo_term_default((ambulo_term_kind)k);
    terms[k].weight = 0.2 * k - 0.1;
    terms[k].scale = scale;
  }
  terms[AMBULO_TORQUE_SQUARED].offset = offset;
  terms[AMBULO_TORQUE_ABSOLUTE].smoothing = 0.7;
  terms[AMBULO_TORQUE_POWER].passive = passive;
  terms[AMBULO_TORQUE_POWER].strength = strength;
  terms[AMBULO_UPRIGHT].point[1] = 1;
  terms[AMBULO_TRACKING].reference = reference;
  terms[AMBULO_USER_TERM].function = hand_height;
  terms[AMBULO_USER_TERM].user = &factor;
  terms[KINDS] = terms[AMBULO_MECHANICAL_POWER]; /* with and without */
  terms[KINDS].tendon = tendon;
  terms[KINDS].negative = terms[AMBULO_MECHANICAL_POWER].negative = 0.3;
  ambulo_user_row row = {"hand", "m", AMBULO_NOT_NEGATIVE, 0.25, 0.75, hand_height, &factor};
  ambulo_problem_definition definition = arm_definition(f.model);
  definition.terms = terms + 1;
  definition.term_count = KINDS;
  definition.user_rows = &row;
  definition.user_row_count = 1;
  definition.ends = AMBULO_ENDS_PERIODIC;
  definition.ends_order = 2;
  definition.end_value_count = 4; /* those at the start: others would contradict the period */
  fixture_open(&f, &definition);
  expect_agreement(&f, NULL);
  expect_agreement(&f, "hand");
  fixture_close(&f);
}

static void a_wrong_callback_is_found(void **state) {
  (void)state;
  static double factor = 0.8;
  fixture f = {.model = arm_create()};
  ambulo_user_row row = {"hand", "m", AMBULO_EQUAL, 0.0, 1.0, hand_height_wrong, &factor};
  ambulo_problem_definition definition = arm_definition(f.model);
  definition.user_rows = &row;
  definition.user_row_count = 1;
  fixture_open(&f, &definition);
  assert_true(worst_error(&f, "hand") > 1e-4);
  expect_agreement(&f, "torque_limit");
  fixture_close(&f);
}

static void other_bases_have_right_gradients_too(void **state) {
  (void)state;
  for (int basis = AMBULO_BSPLINE; basis <= AMBULO_HERMITE; basis++) {
    fixture f = {.model = arm_create()};
    ambulo_problem_definition definition = arm_definition(f.model);
    definition.discretization = (ambulo_discretization)basis;
    definition.degree = 5;
    fixture_open(&f, &definition);
    expect_agreement(&f, NULL);
    fixture_close(&f);
  }
}

static void weights_combine_objective_and_rows(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  fixture_open(&f, &definition);
  double *weights = calloc((size_t)f.m, sizeof *weights);
  for (int r = 0; r < f.m; r++) weights[r] = r % 3 ? 0.0 : cos(r);
  expect_sum_of_rows(&f, 0.5, weights);
  free(weights);
  fixture_close(&f);
}

static void rows_on_unknowns_and_terms_on_one_channel(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  ambulo_term terms[] = {ambulo_term_default(AMBULO_TORQUE_SQUARED),
                         ambulo_term_default(AMBULO_TORQUE_ABSOLUTE)};
  definition.joint_limits = AMBULO_LIMIT_CONTROL_POINTS;
  definition.terms = terms;
  definition.term_count = 2;
  fixture_open(&f, &definition);
  double *weights = calloc((size_t)f.m, sizeof *weights);
  double *rows = calloc((size_t)f.m, sizeof *rows);
  expect_agreement(&f, NULL);
  for (int r = 0; r < f.m; r++) weights[r] = cos(r);
  assert_int_equal(ambulo_problem_gradient(f.problem, f.workspace, f.x, 0.7, weights, f.gradient),
                   0);
  for (int j = 0; j < f.n; j++) {
    double value[2], keep = f.x[j], objective;
    for (int side = 0; side < 2; side++) {
      f.x[j] = keep + (side ? 1e-5 : -1e-5);
      assert_int_equal(ambulo_problem_evaluate(f.problem, f.workspace, f.x, &objective, NULL, rows),
                       0);
      value[side] = 0.7 * objective;
      for (int r = 0; r < f.m; r++) value[side] += weights[r] * rows[r];
    }
    f.x[j] = keep;
    double slope = (value[1] - value[0]) / 2e-5;
    assert_close(f.gradient[j], slope, 1e-6);
  }
  assert_int_equal(ambulo_problem_evaluate(f.problem, f.workspace, f.x, NULL, NULL, rows), 0);
  int limits = 0;
  for (int r = 0; r < f.m; r++) {
    const ambulo__table_row *row = &f.problem->table.rows[r];
    if (strcmp(row->family, "joint_limit")) continue;
    double x = f.x[f.problem->table.terms[row->first_term].channel];
    assert_close(rows[r], strcmp(row->detail, "upper") ? x + 2.0 : 2.5 - x, 1e-14);
    limits++;
  }
  assert_int_equal(limits, 2 * f.n);
  free(weights);
  free(rows);
  fixture_close(&f);
}

/* by row, by the reverse sweep and by central differences; any body pose */
static void expect_curved_rows(const char *path, const char *const settings[3], const char *family,
                               ambulo__curved_form form) {
  fixture f = {.model = NULL};
  assert_int_equal(ambulo_problem_load(path, settings, 3, NULL, NULL, &f.problem), AMBULO_OK);
  f.n = f.problem->variables;
  f.m = f.problem->rows;
  assert_int_equal(ambulo_workspace_create(f.problem, NULL, &f.workspace), AMBULO_OK);
  f.x = calloc((size_t)f.n, sizeof *f.x);
  f.gradient = calloc((size_t)f.n, sizeof *f.gradient);
  double *weights = calloc((size_t)f.m, sizeof *weights);
  for (int j = 0; j < f.n; j++) f.x[j] = 0.2 * sin(3.0 * j);
  expect_agreement(&f, family);
  int rows = 0;
  for (int r = 0; r < f.m; r++) {
    const ambulo__curved *curved =
        ambulo__row_curved_of(&f.problem->table, &f.problem->table.rows[r]);
    if (!curved || curved->form != form) continue;
    weights[r] = cos(rows++);
  }
  assert_true(rows > 20);
  expect_sum_of_rows(&f, 0.0, weights);
  free(weights);
  fixture_close(&f);
}

static void feet_that_pass_agree_with_central_differences(void **state) {
  (void)state;
  static const char *const settings[] = {"constraints.clearance.feet=0.01", "time.intervals=16",
                                         "trajectory.intervals=6"};
  expect_curved_rows("models/walk_normal.yaml", settings, "clearance", AMBULO__CURVED_APART);
}

static void flight_agrees_with_central_differences(void **state) {
  (void)state;
  static const char *const settings[] = {"gait.speed=2.5", "time.intervals=24",
                                         "trajectory.intervals=8"};
  expect_curved_rows("models/run.yaml", settings, "flight", AMBULO__CURVED_SPIN);
}

/* the slopes that an evaluation leaves behind, against each term's own sweep */
static void expect_sum_of_terms(fixture *f) {
  const size_t n = (size_t)f->n;
  double *sum = calloc(n, sizeof *sum), *one = calloc(n, sizeof *one), largest = 0.0;
  assert_int_equal(ambulo__evaluate(f->workspace, f->x), AMBULO_OK);
  for (int t = 0; t < f->problem->definition.term_count; t++) {
    assert_int_equal(ambulo__term_gradient(f->workspace, t, one), AMBULO_OK);
    for (size_t j = 0; j < n; j++) sum[j] += -1.5 * one[j];
  }
  assert_int_equal(ambulo__gradient(f->workspace, -1.5, NULL, f->gradient), AMBULO_OK);
  for (size_t j = 0; j < n; j++) largest = fmax(largest, fabs(sum[j]));
  for (size_t j = 0; j < n; j++) assert_close(f->gradient[j] / largest, sum[j] / largest, 1e-13);
  assert_int_equal(ambulo__gradient(f->workspace, 0.0, NULL, f->gradient), AMBULO_OK);
  for (size_t j = 0; j < n; j++) assert_true(f->gradient[j] == 0.0);
  free(sum);
  free(one);
}

static void the_objective_is_the_sum_of_its_terms(void **state) {
  (void)state;
  static const char *const names[] = {"walk", "walk_normal", "walk_tracking", "fig5b_torque"};
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    fixture f = {.problem = load_problem(names[n])};
    f.n = ambulo_problem_variable_count(f.problem);
    assert_int_equal(ambulo_workspace_create(f.problem, NULL, &f.workspace), AMBULO_OK);
    f.x = calloc((size_t)f.n, sizeof(double));
    f.gradient = calloc((size_t)f.n, sizeof(double));
    for (int j = 0; j < f.n; j++) f.x[j] = 0.1 * sin(1.0 + j);
    expect_sum_of_terms(&f);
    fixture_close(&f);
  }
}

static void terms_of_the_caller_are_in_the_sum(void **state) {
  (void)state;
  static double factor = 0.8;
  fixture f = {.model = arm_create()};
  ambulo_term terms[] = {ambulo_term_default(AMBULO_TORQUE_SQUARED),
                         ambulo_term_default(AMBULO_USER_TERM),
                         ambulo_term_default(AMBULO_USER_SQUARE)};
  ambulo_problem_definition definition = arm_definition(f.model);
  for (int k = 1; k < 3; k++) {
    terms[k].function = hand_height;
    terms[k].user = &factor;
    terms[k].weight = 10.0 * k;
  }
  definition.terms = terms;
  definition.term_count = 3;
  fixture_open(&f, &definition);
  expect_sum_of_terms(&f);
  fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_family_and_term_agrees_with_central_differences),
      cmocka_unit_test(a_wrong_callback_is_found),
      cmocka_unit_test(other_bases_have_right_gradients_too),
      cmocka_unit_test(weights_combine_objective_and_rows),
      cmocka_unit_test(rows_on_unknowns_and_terms_on_one_channel),
      cmocka_unit_test(feet_that_pass_agree_with_central_differences),
      cmocka_unit_test(flight_agrees_with_central_differences),
      cmocka_unit_test(the_objective_is_the_sum_of_its_terms),
      cmocka_unit_test(terms_of_the_caller_are_in_the_sum),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
