/* Terms of the caller at every scale: a solve ends where it ends with the built-in term. */
#include "problem/nlp.h"
#include "support/at_nodes.h"
#include "support/planar_walker.h"
#include "support/problem_fixture.h"

typedef struct wide {
  double factor;
  int coordinate; /* of a square */
} wide;

static double effort(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  const wide *w = user;
  double sum = 0.0;
  for (int i = 0; i < WALKER_COORDINATES; i++) {
    sum += w->factor * state->tau[i] * state->tau[i];
    if (gradient) gradient->tau[i] += 2.0 * w->factor * state->tau[i];
  }
  return sum;
}

static double torque(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  const wide *w = user;
  double root = sqrt(w->factor);
  if (gradient) gradient->tau[w->coordinate] += root;
  return root * state->tau[w->coordinate];
}

/* minus the height of the head: linear in a channel, without curvature of its own */
static double lowness(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  const wide *w = user;
  if (gradient) gradient->points[1] -= w->factor;
  return -w->factor * state->points[1];
}

/* one step of the planar walker with these terms, 12 intervals: 135 unknowns */
static ambulo_problem *step_with(const ambulo_model *model, const ambulo_term *terms, int count) {
  ambulo_problem *plain = walker_problem(model, 12), *problem = NULL;
  assert_non_null(plain);
  ambulo_problem_definition definition = plain->definition;
  definition.terms = terms;
  definition.term_count = count;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  ambulo_problem_free(plain);
  return problem;
}

static double solve(const ambulo_problem *problem, const char *what, double factor) {
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  ambulo_verdict verdict = verdict_at_nodes(result);
  double objective = ambulo_result_objective(result) / factor;
  if (verdict != AMBULO_OPTIMAL)
    print_error("%s x %g: %s at %g, %s\n", what, factor, ambulo_verdict_name(verdict), objective,
                ambulo_result_ending(result));
  assert_int_equal(verdict, AMBULO_OPTIMAL);
  ambulo_result_free(result);
  return objective;
}

static const double factors[] = {1e-8, 1e-4, 1.0, 1e4, 1e8};
enum { FACTORS = sizeof factors / sizeof *factors };

static void torque_squared_at_every_scale(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  ambulo_term built_in = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  ambulo_problem *problem = step_with(model, &built_in, 1);
  double least = solve(problem, "built-in", 1.0);
  ambulo_problem_free(problem);
  for (int i = 0; i < FACTORS; i++) {
    wide w[WALKER_COORDINATES];
    ambulo_term terms[WALKER_COORDINATES];
    for (int k = 0; k < WALKER_COORDINATES; k++) {
      w[k] = (wide){factors[i], k};
      terms[k] = ambulo_term_default(AMBULO_USER_SQUARE);
      terms[k].function = torque;
      terms[k].user = &w[k];
    }
    problem = step_with(model, terms, WALKER_COORDINATES);
    assert_close(solve(problem, "squares", factors[i]) / least, 1.0, 1e-3);
    ambulo_problem_free(problem);
    terms[0] = ambulo_term_default(AMBULO_USER_TERM);
    terms[0].function = effort;
    terms[0].user = &w[0];
    problem = step_with(model, terms, 1);
    assert_close(solve(problem, "a wide term", factors[i]) / least, 1.0, 1e-3);
    ambulo_problem_free(problem);
    built_in.weight = factors[i];
    problem = step_with(model, &built_in, 1);
    assert_close(solve(problem, "built-in", factors[i]) / least, 1.0, 1e-3);
    ambulo_problem_free(problem);
  }
  ambulo_model_free(model);
}

/* beside a little of a built-in term, so that the optimum is one point */
static void linear_terms_at_every_scale(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  double first = 0.0;
  for (int i = 0; i < FACTORS; i++) {
    wide w = {factors[i], 0};
    ambulo_term terms[2] = {ambulo_term_default(AMBULO_USER_TERM),
                            ambulo_term_default(AMBULO_TORQUE_SQUARED)};
    terms[0].function = lowness;
    terms[0].user = &w;
    terms[1].weight = 1e-4 * factors[i];
    ambulo_problem *problem = step_with(model, terms, 2);
    double objective = solve(problem, "a linear term", factors[i]);
    if (i == 0) first = objective;
    assert_close(objective / first, 1.0, 1e-3);
    ambulo_problem_free(problem);
  }
  ambulo_model_free(model);
}

/* largest where the joints accelerate most: no curvature of its own, no minimum inside the limits
 */
static double sloth(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  const wide *w = user;
  double sum = 0.0;
  for (int i = 0; i < ARM_COORDINATES; i++) {
    sum -= w->factor * state->qdd[i] * state->qdd[i];
    if (gradient) gradient->qdd[i] -= 2.0 * w->factor * state->qdd[i];
  }
  return sum;
}

/* A point between the limits that is no optimum is called none, whatever the unit. */
static void no_optimum_at_any_scale(void **state) {
  (void)state;
  static const double units[] = {1e-300, 1e-100, 1e-20, 1.0, 1e20, 1e100, 1e300};
  double kkt = 0.0;
  for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
    fixture f = {.model = arm_create()};
    ambulo_problem_definition definition = arm_definition(f.model);
    wide w = {units[i], 0};
    ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
    term.function = sloth;
    term.user = &w;
    definition.terms = &term;
    definition.term_count = 1;
    definition.end_value_count = 0;
    definition.torque_limits = definition.speed_limits = 0;
    fixture_open(&f, &definition);
    ambulo_result *result = NULL;
    assert_int_equal(ambulo_audit_point(f.problem, NULL, f.x, NULL, NULL, &result), AMBULO_OK);
    assert_int_equal(verdict_at_nodes(result), AMBULO_FEASIBLE);
    if (i == 0) kkt = ambulo_result_audit(result)->kkt;
    assert_true(kkt > 0.1);
    assert_close(ambulo_result_audit(result)->kkt, kkt, 1e-6);
    ambulo_result_free(result);
    fixture_close(&f);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(torque_squared_at_every_scale),
                                     cmocka_unit_test(linear_terms_at_every_scale),
                                     cmocka_unit_test(no_optimum_at_any_scale)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
