/* Sensitivities against problems that are solved anew with a number moved, and what the list says.
 */
#include "ambulo/tools/tools.h"
#include "solver/result.h"
#include "support/at_nodes.h"
#include "support/fail_alloc.h"
#include "support/moved_problem.h"

static ambulo_options tight(const ambulo_problem *problem) {
  ambulo_options options = ambulo_problem_options(problem);
  options.optimality_tolerance = 1e-6;
  options.feasibility_tolerance = 1e-10;
  options.maximum_iterations = 1000;
  options.dense_samples = 1;
  if (problem->variables < 60) options.algorithm = AMBULO_SLSQP; /* to rounding */
  return options;
}

static ambulo_result *solve(const ambulo_problem *problem, const double *start,
                            const ambulo_multipliers *multipliers) {
  ambulo_options options = tight(problem);
  options.multipliers = multipliers;
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, &options, start, NULL, NULL, &result), AMBULO_OK);
  assert_true(ambulo_verdict_is_solution(verdict_at_nodes(result)));
  return result;
}

static double best_at(const char *file, const char *const *base, int count,
                      const ambulo_problem *problem, const ambulo_sensitivity *s, double by,
                      const double *start, const ambulo_multipliers *multipliers) {
  ambulo_problem *moved = moved_problem(file, base, count, problem, s, by);
  assert_non_null(moved);
  ambulo_result *result = solve(moved, start, multipliers);
  double objective = ambulo_result_objective(result);
  ambulo_result_free(result);
  ambulo_problem_free(moved);
  return objective;
}

static const ambulo_sensitivity *find(const ambulo_sensitivity_list *list, const char *name) {
  for (int i = 0; i < list->count; i++)
    if (strcmp(list->items[i].name, name) == 0) return &list->items[i];
  fail_msg("no sensitivity '%s'", name);
  return NULL;
}

/* (f*(p + d) - f*(p - d)) / 2 d of each name, to `tolerance`. A solve that ends in another valley,
 * a hundred times further off than foretold, says nothing; half of the names have to be compared */
static void compare(const char *file, const char *const *base, int count, const char *const *names,
                    double part, double tolerance) {
  ambulo_problem *problem = NULL;
  ambulo_sensitivity_list *list = NULL;
  int all = 0, compared = 0;
  assert_int_equal(ambulo_problem_load(file, base, count, NULL, NULL, &problem), AMBULO_OK);
  ambulo_result *result = solve(problem, NULL, NULL);
  const double *x = ambulo_result_x(result), best = ambulo_result_objective(result);
  ambulo_multipliers *multipliers = NULL;
  assert_int_equal(ambulo_sensitivities(problem, result, NULL, &list), AMBULO_OK);
  assert_int_equal(ambulo_multipliers_of(problem, result, NULL, &multipliers), AMBULO_OK);
  assert_string_equal(list->reason, "");
  for (; *names; names++, all++) {
    const ambulo_sensitivity *s = find(list, *names);
    double by = part * s->step, value[2];
    for (int k = 0; k < 2; k++)
      value[k] = best_at(file, base, count, problem, s, k ? by : -by, x, multipliers);
    double slope = (value[1] - value[0]) / (2.0 * by), near = 100.0 * fabs(by * s->derivative);
    if (fabs(value[0] - best) > near || fabs(value[1] - best) > near) continue;
    compared++;
    if (!(fabs(slope - s->derivative) <= tolerance * fabs(slope)))
      fail_msg("%s: %s is %.9g, solves give %.9g", file, s->name, s->derivative, slope);
  }
  assert_true(2 * compared >= all);
  ambulo_multipliers_free(multipliers);
  ambulo_sensitivities_free(list);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void an_arm_solved_anew(void **state) {
  (void)state;
  static const char *const base[] = {"objective[0].scale={shoulder: 1, elbow: 1}"};
  static const char *const names[] = {"time.duration",
                                      "ends.final.shoulder",
                                      "ends.initial_speed.elbow",
                                      "objective[torque_squared].weight",
                                      "objective[torque_squared].scale.elbow",
                                      "model.links[upper].coordinate.range[0]",
                                      NULL};
  compare("tests/support/two_link_reach.yaml", base, 1, names, 1e-3, 1e-6);
}

/* what a hand holds for a while; its times lie between nodes */
static void a_load_solved_anew(void **state) {
  (void)state;
  static const char *const base[] = {
      "load={hands: [hand], mass: 1.5, force: [3, 0, -2], from: 0.21, to: 0.69, ramp: 0.12}"};
  static const char *const names[] = {"load.mass", "load.force[0]", "load.force[2]", "load.from",
                                      "load.to",   "load.ramp",     "time.duration", NULL};
  compare("tests/support/two_link_reach.yaml", base, 1, names, 1e-3, 1e-6);
}

/* on grids on events, whose nodes go along; multipliers of the second are not known as well */
static void a_load_on_events_solved_anew(void **state) {
  (void)state;
  static const char *const arm[] = {
      "load={hands: [hand], mass: 1.5, force: [3, 0, -2], from: 0.21, to: 0.69, ramp: 0.12}",
      "time.grid=events", "trajectory.degree=5"};
  static const char *const step[] = {
      "gait=null",
      "ends=null",
      "time.duration=0.5",
      "angles=degrees",
      ("contacts=[{foot: right, mode: flat, from: 0, to: 0.4, place: [0, 0]}, {foot: left, mode: "
       "heel, from: 0.3, to: 0.5, place: [0.4, 0]}]"),
      "load={hands: [head_top], mass: 5, force: [20, 0, -30], from: 0.11, to: 0.45, ramp: 0.07}",
      "time.grid=events",
      "trajectory.degree=5"};
  static const char *const names[] = {"load.mass", "load.force[2]", NULL};
  static const char *const times[] = {"load.from", "load.to", "load.ramp", "load.mass", NULL};
  compare("tests/support/two_link_reach.yaml", arm, 3, times, 1e-3, 1e-5);
  compare("tests/support/walker_2d_step.yaml", step, 8, names, 3e-2, 1e-4);
}

static void a_planar_step_solved_anew(void **state) {
  (void)state;
  static const char *const base[] = {"angles=degrees", "constraints.zmp_margin=0.005"};
  static const char *const names[] = {"gait.step_length",
                                      "gait.speed",
                                      "subject.mass",
                                      "ground.slope",
                                      "constraints.zmp_margin",
                                      "model.links[shank_r].coordinate.range[0]",
                                      "objective[torque_squared].scale.hip_flexion_r",
                                      NULL};
  compare("tests/support/walker_2d_step.yaml", base, 2, names, 1e-3, 1e-4);
}

static void four_steps_solved_anew(void **state) {
  (void)state;
  static const char *const base[] = {"angles=degrees", "constraints.zmp_margin=0.005"};
  static const char *const names[] = {"gait.step_length", "gait.step_width",        "time.duration",
                                      "ground.slope",     "constraints.zmp_margin", NULL};
  compare("models/yardstick_12.yaml", base, 2, names, 3e-3, 1e-4);
}

/* where nodes and knots are moves along */
static void phases_solved_anew(void **state) {
  (void)state;
  static const char *const base[] = {"angles=degrees",          "constraints.zmp_margin=0.005",
                                     "time.grid=events",        "trajectory.knots=events",
                                     "trajectory.intervals=14", "trajectory.degree=5"};
  static const char *const names[] = {"gait.phases.heel_strike",
                                      "gait.phases.foot_flat",
                                      "gait.phases.heel_off",
                                      "gait.phases.toe_off",
                                      "gait.speed",
                                      NULL};
  compare("tests/support/walker_2d_step.yaml", base, 6, names, 3e-3, 1e-3);
}

#define SHARED_ON_EVENTS                                                                           \
  "angles=degrees", "constraints.zmp=off",                                                         \
      "ground_reaction={kind: shared, loading_rate: off, friction: 0.8, pressure: {heel: [-0.04, " \
      "0.05], flat: "                                                                              \
      "[-0.04, 0.05], toe: [-0.05, 0.05], width: 0.05}}",                                          \
      "time.grid=events", "trajectory.knots=events", "trajectory.intervals=15",                    \
      "trajectory.degree=5", "time.intervals=34", "constraints.foot_strike=false",                 \
      "constraints.ground_penetration=false", "constraints.contact_tolerance=0.005"

/* by other roundings multipliers of such solves differ by hundredths; tests/solver has the
 * same numbers to 1e-7 where multipliers are fixed */
static void contacts_that_share_solved_anew(void **state) {
  (void)state;
  static const char *const base[] = {SHARED_ON_EVENTS};
  static const char *const phases[] = {"gait.phases.heel_strike", "gait.phases.foot_flat", NULL};
  static const char *const names[] = {"gait.step_length",
                                      "ground_reaction.moment_arm",
                                      "ground_reaction.slant",
                                      "subject.mass",
                                      "gait.speed",
                                      NULL};
  compare("tests/support/walker_2d_step.yaml", base, 11, phases, 1e-3, 5e-2);
  compare("tests/support/walker_2d_step.yaml", base, 11, names, 2e-3, 5e-2);
}

/* on heels that sink */
static void a_heel_pad_solved_anew(void **state) {
  (void)state;
  static const char *const base[] = {SHARED_ON_EVENTS, "ground_reaction.heel_pad=0.006"};
  static const char *const names[] = {"ground_reaction.heel_pad", NULL};
  compare("tests/support/walker_2d_step.yaml", base, 12, names, 1e-1, 5e-2);
}

/* onto a slope, all of a stance at once, times that contacts of both feet share */
static void a_step_up_solved_anew(void **state) {
  (void)state;
  static const char *const base[] = {
      SHARED_ON_EVENTS,
      "gait=null",
      "ends={initial_speed: {pelvis_tx: 1.2}, final_speed: {pelvis_tx: 1.2}}",
      "time.duration=0.5",
      "objective=[{term: torque_squared, scale: {default: 0.01}}, {term: acceleration, weight: "
      "1e-3}]",
      "time.intervals=36",
      "trajectory.intervals=13",
      "contacts=[{foot: right, mode: flat, from: 0, to: 0.31, place: [0, 0, 0]}, "
      "{foot: right, mode: toe, from: 0.31, to: 0.42, place: [0, 0, 0]}, "
      "{foot: left, mode: toe, from: 0, to: 0.06, place: [-0.3, 0, -0.03]}, "
      "{foot: left, mode: heel, from: 0.36, to: 0.42, place: [0.35, 0, 0.04], normal: [-0.1, 0, "
      "1]}, "
      "{foot: left, mode: flat, from: 0.42, to: 0.5, place: [0.35, 0, 0.04], normal: [-0.1, 0, "
      "1]}]"};
  static const char *const names[] = {"contacts[3].place[0]",
                                      "contacts[3].place[2]",
                                      "contacts[0].to",
                                      "contacts[1].to",
                                      "contacts[2].to",
                                      "contacts[3].from",
                                      NULL};
  static const char *const slope[] = {"contacts[3].normal[0]", NULL};
  compare("tests/support/walker_2d_step.yaml", base, 18, names, 1e-3, 5e-2);
  compare("tests/support/walker_2d_step.yaml", base, 18, slope, 0.1, 5e-2);
}

/* --------------------------------------------------------------- what is said */

static const char step[] = "tests/support/walker_2d_step.yaml";

typedef struct solved {
  ambulo_problem *problem;
  ambulo_result *result;
} solved;

static void open_solved(solved *s, const char *file, const char *override) {
  const char *const overrides[] = {override};
  assert_int_equal(ambulo_problem_load(file, overrides, override != NULL, NULL, NULL, &s->problem),
                   AMBULO_OK);
  assert_int_equal(ambulo_solve(s->problem, NULL, NULL, NULL, NULL, &s->result), AMBULO_OK);
}

static void close_solved(solved *s) {
  ambulo_result_free(s->result);
  ambulo_problem_free(s->problem);
}

static void the_dearest_stands_first(void **state) {
  (void)state;
  solved s;
  ambulo_sensitivity_list *list = NULL;
  open_solved(&s, step, NULL);
  assert_int_equal(ambulo_sensitivities(s.problem, s.result, NULL, &list), AMBULO_OK);
  double objective = ambulo_result_objective(s.result), before = INFINITY;
  for (int i = 0; i < list->count; i++) {
    const ambulo_sensitivity *one = &list->items[i];
    double change = one->derivative * one->step;
    assert_true(fabs(change) <= before);
    before = fabs(change);
    assert_close(one->share, change / objective, 1e-12);
    const char *verb = change == 0.0 ? " costs nothing" : change > 0.0 ? " raises " : " lowers ";
    assert_non_null(strstr(one->words, verb));
    assert_non_null(strstr(one->words, one->label));
  }
  const ambulo_sensitivity *weight = find(list, "objective[torque_squared].weight");
  assert_close(weight->share, 0.01, 1e-9); /* the only term: 1 % more is 1 % more */
  assert_string_equal(weight->words,
                      "1 % more weight of torque_squared raises the objective by 1 %");
  assert_close(weight->step, 1e-4, 1e-12);
  assert_non_null(strstr(find(list, "gait.step_length")->words,
                         "1 cm more step length lowers the objective by "));
  ambulo_sensitivities_free(list);
  close_solved(&s);
}

/* a list with a reason, and nothing in it */
static void expect_reason(const solved *s, const char *want) {
  ambulo_sensitivity_list *list = NULL;
  assert_int_equal(ambulo_sensitivities(s->problem, s->result, NULL, &list), AMBULO_OK);
  assert_int_equal(list->count, 0);
  assert_string_equal(list->reason, want);
  ambulo_sensitivities_free(list);
}

static void no_optimum_has_none(void **state) {
  (void)state;
  solved s;
  open_solved(&s, step, NULL);
  s.result->verdict = AMBULO_FEASIBLE;
  expect_reason(&s, "the point is not shown to be optimal");
  close_solved(&s);
  open_solved(&s, step, "objective=none");
  expect_reason(&s, "there is no objective");
  close_solved(&s);
}

static void arguments_are_checked(void **state) {
  (void)state;
  solved s;
  ambulo_sensitivity_list *list = NULL;
  open_solved(&s, step, NULL);
  assert_int_equal(ambulo_sensitivities(NULL, s.result, NULL, &list), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_sensitivities(s.problem, NULL, NULL, &list), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_sensitivities(s.problem, s.result, NULL, NULL), AMBULO_E_ARGUMENT);
  s.result->verdict = AMBULO_OPTIMAL;
  s.result->x[0] = NAN;
  assert_int_equal(ambulo_sensitivities(s.problem, s.result, NULL, &list), AMBULO_E_NUMERIC);
  assert_null(list);
  ambulo_sensitivities_free(NULL);
  close_solved(&s);
}

static void expect_no_leak(const char *file, const char *override) {
  solved s;
  open_solved(&s, file, override);
  for (long k = 0; k < 10000000; k += 1 + k / 8) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_sensitivity_list *list = NULL;
    ambulo_status status = ambulo_sensitivities(s.problem, s.result, &allocator, &list);
    if (status == AMBULO_OK) {
      ambulo_sensitivities_free(list);
    } else {
      assert_int_equal(status, AMBULO_E_MEMORY);
      assert_null(list);
    }
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  close_solved(&s);
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  expect_no_leak("models/yardstick_12.yaml", NULL);
  expect_no_leak(step, "time.grid=events");
  expect_no_leak("tests/support/walk_rigid.yaml", "ground_reaction={kind: shared}");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(an_arm_solved_anew),
      cmocka_unit_test(a_planar_step_solved_anew),
      cmocka_unit_test(a_load_solved_anew),
      cmocka_unit_test(a_load_on_events_solved_anew),
      cmocka_unit_test(four_steps_solved_anew),
      cmocka_unit_test(phases_solved_anew),
      cmocka_unit_test(the_dearest_stands_first),
      cmocka_unit_test(no_optimum_has_none),
      cmocka_unit_test(arguments_are_checked),
      cmocka_unit_test(contacts_that_share_solved_anew),
      cmocka_unit_test(a_heel_pad_solved_anew),
      cmocka_unit_test(a_step_up_solved_anew),
      cmocka_unit_test(every_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
