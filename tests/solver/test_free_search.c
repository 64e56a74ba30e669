/* Free parameters: the run finds what a search over problems solved one by one finds. */
#include "problem/nlp.h"
#include "support/at_nodes.h"
#include "support/outer_fixture.h"
#include "ambulo/tools/load.h"

/* --------------------------------------------------------------- what is found */

typedef struct search {
  const char *file, *key;
  const char *overrides[5];
  int count;
} search;

/* F at one value, times the speed of a walk, from zero, by no means of the run */
static double objective_at(const search *c, double value) {
  char text[80];
  const char *overrides[6];
  ambulo_result *result = NULL;
  for (int i = 0; i < c->count; i++) overrides[i] = c->overrides[i];
  (void)snprintf(text, sizeof text, "%s=%.17g", c->key, value);
  overrides[c->count] = text;
  ambulo_problem *problem = load(c->file, overrides, c->count + 1);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  int walks = ambulo_problem_contact_count(problem) > 0;
  double per = walks ? ambulo_problem_duration(problem) : 1.0;
  double objective = ambulo_result_objective(result) / per;
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  return objective;
}

/* golden section (Kiefer 1953) */
static double golden(const search *c, double lower, double upper, int steps) {
  const double ratio = 0.6180339887498949;
  double a = upper - ratio * (upper - lower), b = lower + ratio * (upper - lower);
  double fa = objective_at(c, a), fb = objective_at(c, b);
  for (int i = 0; i < steps; i++) {
    if (fa < fb) {
      upper = b;
      b = a;
      fb = fa;
      a = upper - ratio * (upper - lower);
      fa = objective_at(c, a);
    } else {
      lower = a;
      a = b;
      fa = fb;
      b = lower + ratio * (upper - lower);
      fb = objective_at(c, b);
    }
  }
  return 0.5 * (lower + upper);
}

/* at a given speed per distance is per time, but for a factor */
static void compare(const search *c, const char *freed, double lower, double upper, double factor) {
  const char *overrides[6];
  for (int i = 0; i < c->count; i++) overrides[i] = c->overrides[i];
  overrides[c->count] = freed;
  solved s = solve(c->file, overrides, c->count + 1, NULL);
  const ambulo_parameter_value *p = &s.outcome->items[0];
  double searched = golden(c, lower, upper, 12);
  assert_int_equal(verdict_at_nodes(s.result), AMBULO_OPTIMAL);
  assert_int_equal(s.outcome->converged, 1);
  assert_int_equal(p->bound, AMBULO_BETWEEN);
  assert_string_equal(p->name, c->key);
  assert_close(p->value, searched, 4e-3 * (upper - lower));
  assert_true(s.outcome->objective <= (1.0 + 2e-5) * objective_at(c, searched) / factor);
  assert_true(fabs(p->derivative) * (p->upper - p->lower) <= 1e-2 * s.outcome->objective);
  assert_true(s.outcome->objective < s.outcome->first);
  assert_true(s.outcome->solves <= 20);
  assert_close(s.outcome->objective, ambulo_result_objective(s.result) / s.outcome->distance,
               1e-12);
  release(&s);
}

static void a_cadence_at_a_speed(void **state) {
  (void)state;
  static const search c = {"tests/support/walk_rigid.yaml", "gait.step_time", {AT_A_SPEED}, 4};
  compare(&c, "free={gait.step_time: [0.3, 0.8]}", 0.35, 0.5, 1.26);
}

static void a_step_at_a_speed(void **state) {
  (void)state;
  static const search c = {PLANAR, "gait.step_length", {NULL}, 0};
  compare(&c, "free={gait.step_length: [0.4, 1.1]}", 0.6, 1.0, 1.1);
}

/* nothing travels: the objective itself */
static void a_duration(void **state) {
  (void)state;
  static const search c = {REACH, "time.duration", {"time.duration=1.1"}, 1};
  compare(&c, "free={time.duration: [0.9, 1.35]}", 1.15, 1.3, 1.0);
}

/* what a hand holds on to, pushed down so that the arm is carried */
static void a_push(void **state) {
  (void)state;
  static const search c = {
      REACH,
      "load.force[2]",
      {"load={hands: [hand], mass: 1.5, force: [3, 0, -30], from: 0.21, to: 0.69, ramp: 0.12}"},
      1};
  compare(&c, "free={\"load.force[2]\": [-44, -24]}", -42.0, -28.0, 1.0);
}

/* several at once are no worse than one, and every number with a sensitivity can be among them */
static void several_at_once(void **state) {
  (void)state;
  static const char *const one[] = {AT_A_SPEED, "free={gait.step_time: [0.3, 0.8]}"};
  static const char *const three[] = {
      AT_A_SPEED, ("free={gait.step_time: [0.3, 0.8], gait.step_width: [0.05, 0.18], ground.slope: "
                   "[-8, 5]}")};
  solved a = solve("tests/support/walk_rigid.yaml", one, 5, NULL);
  solved b = solve("tests/support/walk_rigid.yaml", three, 5, NULL);
  assert_true(b.outcome->objective < 0.99 * a.outcome->objective);
  assert_true(b.outcome->converged);
  /* the wider the better, with this objective: the bound is named, and F would go on beyond it */
  assert_string_equal(b.outcome->items[1].name, "gait.step_width");
  assert_int_equal(b.outcome->items[1].bound, AMBULO_AT_UPPER);
  assert_close(b.outcome->items[1].value, 0.18, 1e-9);
  assert_true(b.outcome->items[1].derivative < 0.0);
  assert_string_equal(b.outcome->items[2].unit, "rad");
  assert_close(b.outcome->items[2].lower, -8.0 * 3.14159265358979324 / 180.0, 1e-15);
  assert_int_equal(b.outcome->items[2].bound, AMBULO_BETWEEN);
  release(&a);
  release(&b);
}

#define SHARED_ON_EVENTS                                                                           \
  "ground_reaction={kind: shared, friction: 0.8, pressure: {heel: [-0.04, 0.05], flat: [-0.04, "   \
  "0.05], toe: [-0.05, 0.05], width: 0.05}}",                                                      \
      "time={grid: events, intervals: 30}",                                                        \
      "trajectory={knots: events, intervals: 15, degree: 5}",                                      \
      "constraints={contact_tolerance: 0.005, joint_limits: nodes}"

/* contacts that share the load: their weights and centres move with the phase */
static void a_phase_of_shared_contacts(void **state) {
  (void)state;
  static const char *const overrides[] = {SHARED_ON_EVENTS,
                                          "free={gait.phases.heel_off: [0.2, 0.4]}"};
  solved s = solve(PLANAR, overrides, 5, NULL);
  assert_int_equal(verdict_at_nodes(s.result), AMBULO_OPTIMAL);
  assert_int_equal(s.outcome->items[0].bound, AMBULO_AT_UPPER);
  assert_true(s.outcome->items[0].derivative < 0.0);
  assert_true(s.outcome->objective < 0.9 * s.outcome->first);
  assert_true(s.outcome->solves <= 4);
  release(&s);
}

/* at the bound the other foot strikes: there is no slope, and none is made up */
static void a_kink_is_given_up(void **state) {
  (void)state;
  static const char *const overrides[] = {SHARED_ON_EVENTS,
                                          "free={gait.phases.heel_off: [0.2, 0.44]}"};
  solved s = solve(PLANAR, overrides, 5, NULL);
  assert_int_equal(s.outcome->items[0].bound, AMBULO_BETWEEN);
  assert_true(s.outcome->items[0].derivative != 0.0);
  assert_true(s.outcome->failed >= 1);
  release(&s);
}

/* a gradient that points out of the bounds is the end, at once */
static void a_bound_ends_the_run(void **state) {
  (void)state;
  static const char *const overrides[] = {"free={gait.step_length: [0.55, 0.62]}"};
  solved s = solve(PLANAR, overrides, 1, NULL);
  assert_int_equal(s.outcome->items[0].bound, AMBULO_AT_UPPER);
  assert_true(s.outcome->solves <= 3);
  assert_int_equal(s.outcome->converged, 1);
  assert_non_null(strstr(s.outcome->ending, "points out of the bounds"));
  release(&s);
}

/* the problem that comes back is the file with the best values, and nothing else */
static void the_best_problem_is_the_file_with_its_values(void **state) {
  (void)state;
  static const char *const overrides[] = {"free={\"objective[torque_squared].scale.hip_flexion_r\":"
                                          " [0.5, 2], gait.step_length: [0.5, 1]}"};
  char scale[2][80], length[80];
  solved s = solve(PLANAR, overrides, 1, NULL);
  const ambulo_parameter_value *p = s.outcome->items;
  static const char *const sides[] = {"r", "l"};
  for (int i = 0; i < 2; i++)
    (void)snprintf(scale[i], sizeof scale[i], "objective[0].scale.hip_flexion_%s=%.17g", sides[i],
                   p[0].value);
  (void)snprintf(length, sizeof length, "gait.step_length=%.17g", p[1].value);
  assert_int_equal(p[0].bound, AMBULO_AT_LOWER); /* the other side's moved along */
  const char *const again[] = {scale[0], scale[1], length};
  ambulo_problem *problem = load(PLANAR, again, 3);
  assert_true(ambulo_problem_hash(problem) == ambulo_problem_hash(s.best));
  assert_int_equal(ambulo_problem_parameters(s.best).count, 0);
  assert_int_equal(ambulo_problem_parameters(s.problem).count, 2);
  ambulo_problem_free(problem);
  release(&s);
}

/* no walk there: the run comes back */
static void values_without_a_solution_are_given_up(void **state) {
  (void)state;
  static const char *const wide[] = {"free={gait.step_length: [0.1, 3]}"};
  static const char *const narrow[] = {"free={gait.step_length: [0.4, 1.1]}"};
  solved a = solve(PLANAR, wide, 1, NULL), b = solve(PLANAR, narrow, 1, NULL);
  assert_true(a.outcome->failed > 0);
  assert_close(a.outcome->items[0].value, b.outcome->items[0].value, 1e-3);
  release(&a);
  release(&b);
}

static void where_the_first_has_none_nothing_is_varied(void **state) {
  (void)state;
  static const char *const overrides[] = {"gait.step_length=1.9",
                                          "free={gait.step_length: [0.4, 3]}"};
  solved s = solve(PLANAR, overrides, 2, NULL);
  assert_false(ambulo_verdict_is_solution(verdict_at_nodes(s.result)));
  assert_non_null(ambulo_result_explanation(s.result));
  assert_int_equal(s.outcome->solves, 1);
  assert_int_equal(s.outcome->failed, 1);
  assert_int_equal(s.outcome->converged, 0);
  assert_true(isnan(s.outcome->objective) && isnan(s.outcome->first));
  assert_true(isnan(s.outcome->items[0].derivative));
  assert_close(s.outcome->items[0].value, 1.9, 1e-12);
  assert_non_null(strstr(s.outcome->ending, "no motion that holds"));
  release(&s);
}

/* ---------------------------------------------------------------------- from C */

typedef struct rebuilt {
  const char *name;
  int asked, fail_at;
} rebuilt;

static ambulo_status reach_at(void *user, const double *values, const ambulo_allocator *allocator,
                              ambulo_diagnostics *diagnostics, ambulo_problem **problem) {
  rebuilt *r = user;
  char text[80];
  const char *const overrides[] = {text};
  if (++r->asked == r->fail_at) return AMBULO_E_PROBLEM;
  (void)snprintf(text, sizeof text, "%s=%.17g", r->name, values[0]);
  return ambulo_problem_load(PLANAR, overrides, 1, allocator, diagnostics, problem);
}

static void a_function_says_what_the_problem_is(void **state) {
  (void)state;
  static const char *const overrides[] = {"free={gait.step_length: [0.4, 1.1]}"};
  const ambulo_parameter item = {"gait.step_length", 0.4, 1.1};
  solved of_file = solve(PLANAR, overrides, 1, NULL);
  for (int fail_at = 0; fail_at < 4; fail_at += 3) {
    solved s = {.problem = load(PLANAR, NULL, 0)};
    rebuilt r = {item.name, 0, fail_at};
    ambulo_parameters parameters = ambulo_parameters_default();
    parameters.items = &item;
    parameters.count = 1;
    parameters.problem_at = reach_at;
    parameters.user = &r;
    assert_int_equal(
        ambulo_solve_parameters(s.problem, &parameters, NULL, NULL, NULL, &s.best, &s.result),
        AMBULO_OK);
    s.outcome = ambulo_result_parameters(s.result);
    assert_int_equal(r.asked, s.outcome->solves);
    assert_int_equal(s.outcome->failed, fail_at > 0);
    assert_close(s.outcome->items[0].value, of_file.outcome->items[0].value, fail_at ? 2e-3 : 0.0);
    release(&s);
  }
  release(&of_file);
}

/* a problem without a file needs no such function: its numbers have the same names */
static void numbers_of_any_problem_may_be_free(void **state) {
  (void)state;
  static const char *const overrides[] = {"free={ends.final.shoulder: [-60, 20]}"};
  const double degree = 3.14159265358979324 / 180.0;
  const ambulo_parameter item = {"ends.final.shoulder", -60.0 * degree, 20.0 * degree};
  solved of_file = solve(REACH, overrides, 1, NULL), s = {.problem = NULL};
  ambulo_problem *like = load(REACH, NULL, 0);
  ambulo_parameters parameters = ambulo_parameters_default();
  ambulo_options options = ambulo_problem_options(like);
  parameters.items = &item;
  parameters.count = 1;
  assert_int_equal(ambulo_problem_create(&like->definition, NULL, NULL, &s.problem), AMBULO_OK);
  assert_int_equal(
      ambulo_solve_parameters(s.problem, &parameters, &options, NULL, NULL, &s.best, &s.result),
      AMBULO_OK);
  s.outcome = ambulo_result_parameters(s.result);
  assert_close(s.outcome->items[0].value, of_file.outcome->items[0].value, 1e-6);
  assert_true(s.outcome->solves > 1);
  assert_close(s.best->definition.end_values[4].value, s.outcome->items[0].value, 0.0);
  release(&s);
  release(&of_file);
  ambulo_problem_free(like);
}

static void expect_refused(const char *file, const ambulo_parameters *parameters,
                           const char *message) {
  ambulo_problem *problem = load(file, NULL, 0), *best = NULL;
  ambulo_result *result = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_solve_parameters(problem, parameters, NULL, NULL, list, &best, &result),
                   AMBULO_E_ARGUMENT);
  assert_message(list, 0, message);
  assert_null(best);
  assert_null(result);
  ambulo_diagnostics_free(list);
  ambulo_problem_free(problem);
}

static void arguments_are_checked(void **state) {
  (void)state;
  ambulo_parameter items[2] = {{"gait.step_length", 0.4, 1.1}, {"gait.step_length", 0.4, 1.1}};
  rebuilt r = {"gait.step_length", 0, 0};
  ambulo_parameters p = ambulo_parameters_default();
  expect_refused(PLANAR, NULL, "0 free parameters");
  p.items = items;
  p.count = 2;
  p.problem_at = reach_at;
  p.user = &r;
  expect_refused(PLANAR, &p, "'gait.step_length': it is there twice");
  p.count = 1;
  items[0].lower = 1.2;
  expect_refused(PLANAR, &p, "its bounds do not rise");
  items[0].upper = 1.3;
  expect_refused(PLANAR, &p, "outside of its bounds");
  items[0].name = "gait.phases.toe_off";
  expect_refused(PLANAR, &p, "it has no sensitivity in this problem");
  items[0].name = NULL;
  expect_refused(PLANAR, &p, "no name");
  items[0] = (ambulo_parameter){"time.duration", 0.5, 1.5};
  p.per = AMBULO_PER_DISTANCE;
  expect_refused(REACH, &p, "the body travels 0 m");
  p.per = (ambulo_per)7;
  expect_refused(PLANAR, &p, "expected an ambulo_per");
  p.per = AMBULO_PER_NONE;
  p.maximum_solves = 0;
  expect_refused(PLANAR, &p, "at most 0 solves");
  p.size = 0;
  expect_refused(PLANAR, &p, "ambulo_parameters_default()");
  assert_int_equal(r.asked, 0);
}

/* ----------------------------------------------------------------- cut short */

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_cadence_at_a_speed),
                                     cmocka_unit_test(a_step_at_a_speed),
                                     cmocka_unit_test(a_duration),
                                     cmocka_unit_test(a_push),
                                     cmocka_unit_test(several_at_once),
                                     cmocka_unit_test(a_phase_of_shared_contacts),
                                     cmocka_unit_test(a_kink_is_given_up),
                                     cmocka_unit_test(a_bound_ends_the_run),
                                     cmocka_unit_test(the_best_problem_is_the_file_with_its_values),
                                     cmocka_unit_test(values_without_a_solution_are_given_up),
                                     cmocka_unit_test(where_the_first_has_none_nothing_is_varied),
                                     cmocka_unit_test(a_function_says_what_the_problem_is),
                                     cmocka_unit_test(numbers_of_any_problem_may_be_free),
                                     cmocka_unit_test(arguments_are_checked)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
