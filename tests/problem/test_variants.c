/* Terms and rows of the caller on a problem of a file: it is the problem whose file says the same,
 * and all that the file gave stays, free parameters too. */
#include "ambulo/tools/load.h"
#include "problem/nlp.h"
#include "support/at_nodes.h"
#include "support/fail_alloc.h"
#include "support/outer_fixture.h"
#include "support/problem_fixture.h"
#include "support/test.h"

#define DOUBLE_EFFORT "objective[0].weight=2"
#define FREE_END "free={ends.initial_speed.shoulder: [-300, 600]}"
enum { JOINTS = 2 };

/* what the file's first term is: the extension makes its weight 2 */
static double effort(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  (void)user;
  double sum = 0.0;
  for (int i = 0; i < JOINTS; i++) {
    sum += state->tau[i] * state->tau[i];
    if (gradient) gradient->tau[i] += 2.0 * state->tau[i];
  }
  return sum;
}

/* rad/s that the elbow is below the limit */
static double slower(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  if (gradient) gradient->qd[1] -= 1.0;
  return *(const double *)user - state->qd[1];
}

static ambulo_problem *extend(const ambulo_problem *base, const ambulo_user_row *row) {
  ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
  term.name = "my effort";
  term.function = effort;
  ambulo_extension extension = ambulo_extension_default();
  extension.terms = &term;
  extension.term_count = 1;
  extension.user_rows = row;
  extension.user_row_count = row != NULL;
  ambulo_problem *extended = NULL;
  assert_int_equal(ambulo_problem_extend(base, &extension, NULL, NULL, &extended), AMBULO_OK);
  return extended;
}

static ambulo_result *solution(const ambulo_problem *problem) {
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
  return result;
}

static void term_is_what_the_file_could_have_said(void **state) {
  (void)state;
  static const char *const twice[] = {DOUBLE_EFFORT};
  ambulo_problem *base = load(REACH, NULL, 0), *file = load(REACH, twice, 1);
  ambulo_problem *extended = extend(base, NULL);
  assert_int_equal(ambulo_problem_term_count(extended), 3);
  assert_string_equal(ambulo_problem_term_name(extended, 2), "my effort");
  int n = ambulo_problem_variable_count(file);
  assert_int_equal(ambulo_problem_variable_count(extended), n);
  assert_int_equal(ambulo_problem_row_count(extended), ambulo_problem_row_count(file));
  assert_true(ambulo_problem_hash(extended) != ambulo_problem_hash(base));

  ambulo_workspace *one = NULL, *other = NULL;
  assert_int_equal(ambulo_workspace_create(extended, NULL, &one), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(file, NULL, &other), AMBULO_OK);
  double x[64], f[2], terms[3], slope[2][64];
  assert_true(n <= 64);
  for (int i = 0; i < n; i++) x[i] = 0.4 * sin(1.0 + 1.7 * i);
  assert_int_equal(ambulo_problem_evaluate(extended, one, x, &f[0], terms, NULL), AMBULO_OK);
  assert_int_equal(ambulo_problem_evaluate(file, other, x, &f[1], NULL, NULL), AMBULO_OK);
  assert_true(fabs(f[0] - f[1]) <= 1e-13 * f[1]);
  assert_true(fabs(terms[2] - terms[0]) <= 1e-13 * terms[0]);
  assert_int_equal(ambulo_problem_gradient(extended, one, x, 1.0, NULL, slope[0]), AMBULO_OK);
  assert_int_equal(ambulo_problem_gradient(file, other, x, 1.0, NULL, slope[1]), AMBULO_OK);
  for (int i = 0; i < n; i++) assert_true(fabs(slope[0][i] - slope[1][i]) <= 1e-12 * f[1]);
  ambulo_workspace_free(one);
  ambulo_workspace_free(other);
  ambulo_problem_free(extended);
  ambulo_problem_free(base);
  ambulo_problem_free(file);
}

static void row_binds_at_the_solution(void **state) {
  (void)state;
  static double limit = 2.0;
  const ambulo_user_row row = {"slow elbow", "rad/s", AMBULO_NOT_NEGATIVE, 0.0, 0.8,
                               slower,       &limit};
  ambulo_problem *base = load(REACH, NULL, 0), *extended = extend(base, &row);
  int rows = ambulo_problem_row_count(base);
  assert_int_equal(ambulo_problem_row_count(extended), rows + ambulo_problem_node_count(base));
  ambulo_row told;
  assert_int_equal(ambulo_problem_row(extended, rows, &told), AMBULO_OK);
  assert_string_equal(told.family, "slow elbow");
  ambulo_result *result = solution(extended);
  double least = INFINITY;
  for (int r = rows; r < ambulo_problem_row_count(extended); r++)
    least = fmin(least, ambulo_result_rows(result)[r]);
  assert_true(fabs(least) < 1e-5);

  /* without it the elbow is faster */
  ambulo_result *fast = solution(base);
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(base, NULL, &workspace), AMBULO_OK);
  double most = 0.0, qd[2], half = 0.4;
  const ambulo_motion motion = {.size = sizeof(ambulo_motion), .qd = qd};
  for (half = 0.0; half <= 0.8; half += 0.04) {
    assert_int_equal(
        ambulo_problem_motion(base, workspace, ambulo_result_x(fast), 1, &half, &motion),
        AMBULO_OK);
    most = fmax(most, qd[1]);
  }
  assert_true(most > limit + 0.1);
  ambulo_workspace_free(workspace);
  ambulo_result_free(fast);
  ambulo_result_free(result);
  ambulo_problem_free(extended);
  ambulo_problem_free(base);
}

static void what_the_file_says_stays(void **state) {
  (void)state;
  static const char *const overrides[] = {"solver={feasibility_tolerance: 1e-5}", FREE_END};
  ambulo_problem *base = load(REACH, overrides, 2), *extended = extend(base, NULL);
  assert_true(ambulo_problem_options(extended).feasibility_tolerance == 1e-5);
  ambulo_parameters free = ambulo_problem_parameters(extended);
  assert_int_equal(free.count, 1);
  assert_string_equal(free.items[0].name, "ends.initial_speed.shoulder");

  /* an extension of the extension, and the problem at another value of the free one */
  static double limit = 9.0;
  const ambulo_user_row row = {"slow elbow", "rad/s", AMBULO_NOT_NEGATIVE, 0.0, 0.8,
                               slower,       &limit};
  ambulo_problem *twice = extend(extended, &row), *at = NULL;
  double value = -1.0;
  assert_int_equal(ambulo_problem_at(twice, &value, NULL, NULL, &at), AMBULO_OK);
  assert_int_equal(ambulo_problem_term_count(at), 4);
  assert_int_equal(ambulo_problem_row_count(at), ambulo_problem_row_count(twice));
  assert_string_equal(ambulo_problem_term_name(at, 3), "my effort");
  ambulo_problem_free(at);
  ambulo_problem_free(twice);
  ambulo_problem_free(extended);
  ambulo_problem_free(base);
}

static void free_parameters_are_found_with_it(void **state) {
  (void)state;
  static const char *const alone[] = {FREE_END}, *const both[] = {FREE_END, DOUBLE_EFFORT};
  solved file = solve(REACH, both, 2, NULL), own = {.problem = NULL};
  ambulo_problem *base = load(REACH, alone, 1);
  own.problem = extend(base, NULL);
  assert_int_equal(
      ambulo_solve_parameters(own.problem, NULL, NULL, NULL, NULL, &own.best, &own.result),
      AMBULO_OK);
  own.outcome = ambulo_result_parameters(own.result);
  assert_int_equal(ambulo_problem_term_count(own.best), 3);
  const ambulo_parameter_value *a = &file.outcome->items[0], *b = &own.outcome->items[0];
  assert_true(a->value > a->lower + 1e-3 && a->value < a->upper - 1e-3);
  assert_true(fabs(a->value - b->value) < 5e-3);
  assert_true(fabs(file.outcome->objective - own.outcome->objective) <
              1e-3 * file.outcome->objective);
  release(&file);
  release(&own);
  ambulo_problem_free(base);
}

/* advice on a reach that is too fast is in the words of the file */
static void advice_names_keys_of_the_file(void **state) {
  (void)state;
  static const char *const fast[] = {"time.duration=0.05"};
  ambulo_problem *base = load(REACH, fast, 1), *extended = NULL;
  ambulo_extension nothing = ambulo_extension_default();
  assert_int_equal(ambulo_problem_extend(base, &nothing, NULL, NULL, &extended), AMBULO_OK);
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(extended, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  const ambulo_explanation *why = ambulo_result_explanation(result);
  assert_non_null(why);
  assert_int_equal(why->setting_count, 1);
  assert_non_null(strstr(why->settings[0], "="));
  ambulo_result_free(result);
  ambulo_problem_free(extended);
  ambulo_problem_free(base);
}

/* pairs of capsules are those that the first problem chose */
static void pairs_left_out_are_still_told(void **state) {
  (void)state;
  ambulo_problem *base = load("models/doorway.yaml", NULL, 0), *extended = NULL;
  ambulo_extension nothing = ambulo_extension_default();
  assert_int_equal(ambulo_problem_extend(base, &nothing, NULL, NULL, &extended), AMBULO_OK);
  assert_int_equal(ambulo_problem_pairs(extended, 0, NULL), ambulo_problem_pairs(base, 0, NULL));
  assert_int_equal(ambulo_problem_pairs_left_out(extended, 0, NULL),
                   ambulo_problem_pairs_left_out(base, 0, NULL));
  assert_int_equal(ambulo_problem_hash(extended), ambulo_problem_hash(base));
  ambulo_problem_free(extended);
  ambulo_problem_free(base);
}

static void what_is_no_extension_is_refused(void **state) {
  (void)state;
  ambulo_problem *base = load(REACH, NULL, 0), *out = NULL;
  ambulo_extension good = ambulo_extension_default(), zero = {0}, bad = good;
  ambulo_term term = ambulo_term_default(AMBULO_USER_TERM); /* without its function */
  assert_int_equal(ambulo_problem_extend(NULL, &good, NULL, NULL, &out), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_extend(base, NULL, NULL, NULL, &out), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_extend(base, &good, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_extend(base, &zero, NULL, NULL, &out), AMBULO_E_ARGUMENT);
  bad.term_count = 1;
  assert_int_equal(ambulo_problem_extend(base, &bad, NULL, NULL, &out), AMBULO_E_ARGUMENT);
  bad = good;
  bad.user_row_count = -1;
  assert_int_equal(ambulo_problem_extend(base, &bad, NULL, NULL, &out), AMBULO_E_ARGUMENT);
  bad = good;
  bad.terms = &term;
  bad.term_count = 1;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_problem_extend(base, &bad, NULL, list, &out), AMBULO_E_PROBLEM);
  assert_int_equal(ambulo_diagnostics_error_count(list), 1);
  assert_null(out);
  ambulo_diagnostics_free(list);
  ambulo_problem_free(base);
}

/* at most `limit` requests are let through; 1: it took no more than that */
static int within(long limit, const ambulo_problem *base,
                  ambulo_status (*make)(const ambulo_problem *, const ambulo_allocator *,
                                        ambulo_problem **)) {
  fail_alloc memory = fail_alloc_at(limit);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  ambulo_problem *out = NULL;
  ambulo_status status = make(base, &allocator, &out);
  assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
  ambulo_problem_free(out);
  assert_int_equal(memory.live, 0);
  return !memory.failed;
}
static ambulo_status make_extended(const ambulo_problem *base, const ambulo_allocator *allocator,
                                   ambulo_problem **out) {
  ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
  term.function = effort;
  ambulo_extension extension = ambulo_extension_default();
  extension.terms = &term;
  extension.term_count = 1;
  return ambulo_problem_extend(base, &extension, allocator, NULL, out);
}
static ambulo_status make_at(const ambulo_problem *extended, const ambulo_allocator *allocator,
                             ambulo_problem **out) {
  double value = -1.0;
  return ambulo_problem_at(extended, &value, allocator, NULL, out);
}
static void without_memory_nothing_is_lost(void **state) {
  (void)state;
  static const char *const overrides[] = {FREE_END};
  ambulo_problem *base = load(REACH, overrides, 1), *extended = extend(base, NULL);
  long k = 0;
  while (!within(k, base, make_extended)) k++;
  assert_true(k > 20);
  /* reading the file again takes many requests: every seventh, and all that make the extension */
  for (k = 0; !within(k, extended, make_at); k += 7) continue;
  for (long end = k - 60; end < k; end++) (void)within(end, extended, make_at);
  ambulo_problem_free(extended);
  ambulo_problem_free(base);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(term_is_what_the_file_could_have_said),
                                     cmocka_unit_test(row_binds_at_the_solution),
                                     cmocka_unit_test(what_the_file_says_stays),
                                     cmocka_unit_test(free_parameters_are_found_with_it),
                                     cmocka_unit_test(advice_names_keys_of_the_file),
                                     cmocka_unit_test(pairs_left_out_are_still_told),
                                     cmocka_unit_test(what_is_no_extension_is_refused),
                                     cmocka_unit_test(without_memory_nothing_is_lost)};
  return cmocka_run_group_tests_name("problem/variants", tests, NULL, NULL);
}
