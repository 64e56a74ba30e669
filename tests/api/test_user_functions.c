/* Objective terms and constraint rows of the caller's own: they solve like built-in ones, and
 * the derivative check covers them by name. */
#include "support/problem_fixture.h"

/* tau^2 summed: what AMBULO_TORQUE_SQUARED computes */
static double torque_squared(void *user, const ambulo_node_state *state,
                             ambulo_node_gradient *gradient) {
  (void)user;
  double sum = 0.0;
  for (int i = 0; i < ARM_COORDINATES; i++) {
    sum += state->tau[i] * state->tau[i];
    if (gradient) gradient->tau[i] += 2.0 * state->tau[i];
  }
  return sum;
}

/* height of the hand above a plane that the caller chose, m */
static double hand_above(void *user, const ambulo_node_state *state,
                         ambulo_node_gradient *gradient) {
  double plane = *(const double *)user;
  if (gradient) gradient->points[1] += 1.0;
  return state->points[1] - plane;
}

/* the same value with a slope that is 10 % off */
static double hand_above_wrong(void *user, const ambulo_node_state *state,
                               ambulo_node_gradient *gradient) {
  double value = hand_above(user, state, NULL);
  if (gradient) gradient->points[1] += 1.1;
  return value;
}

static ambulo_result *solve(const ambulo_problem *problem, const double *start) {
  ambulo_options options = ambulo_options_default();
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, &options, start, NULL, NULL, &result), AMBULO_OK);
  ambulo_verdict verdict = ambulo_result_verdict(result);
  if (verdict != AMBULO_OPTIMAL)
    print_error("verdict %s: %s\n", ambulo_verdict_name(verdict), ambulo_result_ending(result));
  assert_int_equal(verdict, AMBULO_OPTIMAL);
  return result;
}

/* The swing has several local optima: from zero the two may end in different ones, but the
 * optimum of either is an optimum of the other. */
static void own_term_has_the_optima_of_the_built_in_one(void **state) {
  (void)state;
  fixture built_in = {.model = arm_create()}, own = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(built_in.model);
  fixture_open(&built_in, &definition);
  ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
  term.name = "my effort";
  term.function = torque_squared;
  definition = arm_definition(own.model);
  definition.terms = &term;
  fixture_open(&own, &definition);
  assert_string_equal(ambulo_problem_term_name(own.problem, 0), "my effort");
  ambulo_result *a = solve(built_in.problem, NULL), *b = solve(own.problem, NULL);
  ambulo_result *from_a = solve(own.problem, ambulo_result_x(a));
  ambulo_result *from_b = solve(built_in.problem, ambulo_result_x(b));
  assert_true(ambulo_result_objective(a) > 1.0);
  assert_close(ambulo_result_objective(from_a), ambulo_result_objective(a), 1e-5);
  assert_close(ambulo_result_objective(from_b), ambulo_result_objective(b), 1e-5);
  assert_close(ambulo_result_terms(b)[0], ambulo_result_objective(b), 1e-12);
  ambulo_result_free(a);
  ambulo_result_free(b);
  ambulo_result_free(from_a);
  ambulo_result_free(from_b);
  fixture_close(&built_in);
  fixture_close(&own);
}

/* smallest value of the rows of one family, and how many there are */
static double lowest(const ambulo_problem *problem, const double *rows, const char *family,
                     int *count) {
  double least = INFINITY;
  *count = 0;
  for (int r = 0; r < ambulo_problem_row_count(problem); r++) {
    ambulo_row row;
    assert_int_equal(ambulo_problem_row(problem, r, &row), AMBULO_OK);
    if (strcmp(row.family, family) != 0) continue;
    assert_string_equal(row.unit, "m");
    (*count)++;
    if (rows[r] < least) least = rows[r];
  }
  return least;
}

static void own_row_binds_at_the_solution(void **state) {
  (void)state;
  static double plane = -0.1;
  fixture f = {.model = arm_create()};
  /* the hand has to be above the plane around mid-time, where it would otherwise hang lower */
  ambulo_user_row row = {"hand above", "m", AMBULO_NOT_NEGATIVE, 0.35, 0.65, hand_above, &plane};
  ambulo_problem_definition definition = arm_definition(f.model);
  fixture free_of_it = {.model = arm_create()};
  ambulo_problem_definition without = arm_definition(free_of_it.model);
  fixture_open(&free_of_it, &without);
  definition.user_rows = &row;
  definition.user_row_count = 1;
  fixture_open(&f, &definition);

  ambulo_result *cheap = solve(free_of_it.problem, NULL), *result = solve(f.problem, NULL);
  int count;
  assert_int_equal(
      ambulo_problem_evaluate(f.problem, f.workspace, ambulo_result_x(cheap), NULL, NULL, f.rows),
      AMBULO_OK);
  assert_true(lowest(f.problem, f.rows, "hand above", &count) < -0.01);
  assert_int_equal(count, 3); /* nodes 0.4, 0.5, 0.6 s of ten intervals in one second */
  double least = lowest(f.problem, ambulo_result_rows(result), "hand above", &count);
  if (!(fabs(least) < 1e-6)) print_error("lowest hand height above the plane: %.3g m\n", least);
  assert_true(fabs(least) < 1e-6);
  assert_true(ambulo_result_objective(result) > ambulo_result_objective(cheap) * (1.0 + 1e-4));
  ambulo_result_free(cheap);
  ambulo_result_free(result);
  fixture_close(&free_of_it);
  fixture_close(&f);
}

static double reported_error(fixture *f, const char *family) {
  ambulo_derivative_error errors[16];
  int count = 0;
  assert_int_equal(
      ambulo_problem_check_derivatives(f->problem, f->workspace, f->x, 0.0, errors, 16, &count),
      AMBULO_OK);
  for (int i = 0; i < count; i++)
    if (strcmp(errors[i].family, family) == 0) return errors[i].error;
  print_error("the derivative check does not name '%s'\n", family);
  fail();
  return 0.0;
}

static double checked(ambulo_node_function row_function, const char *family) {
  static double plane = -0.1;
  fixture f = {.model = arm_create()};
  ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
  term.name = "my effort";
  term.function = torque_squared;
  ambulo_user_row row = {"hand above", "m", AMBULO_NOT_NEGATIVE, 0.0, 1.0, row_function, &plane};
  ambulo_problem_definition definition = arm_definition(f.model);
  definition.terms = &term;
  definition.user_rows = &row;
  definition.user_row_count = 1;
  fixture_open(&f, &definition);
  double error = reported_error(&f, family);
  fixture_close(&f);
  return error;
}

static void derivative_check_names_own_functions(void **state) {
  (void)state;
  assert_true(checked(hand_above, "hand above") < 1e-7);
  assert_true(checked(hand_above, "my effort") < 1e-7);
  assert_true(checked(hand_above_wrong, "hand above") > 1e-3);
  assert_true(checked(hand_above_wrong, "my effort") < 1e-7);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(own_term_has_the_optima_of_the_built_in_one),
      cmocka_unit_test(own_row_binds_at_the_solution),
      cmocka_unit_test(derivative_check_names_own_functions),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
