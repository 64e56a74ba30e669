/* Problems on another grid: motions carried over, references resampled, times between nodes; the
 * start. */
#include "ambulo/tools/load.h"
#include "problem/nlp.h"
#include "support/fail_alloc.h"
#include "support/outer_fixture.h"
#include "support/problem_fixture.h"
#include "support/test.h"

/* Another grid is the same problem; knot insertion keeps the motion. */

static void transfer_to_a_finer_spline_keeps_the_motion(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  fixture_open(&f, &definition);
  ambulo_problem *fine = NULL;
  assert_int_equal(ambulo__problem_with_grid(f.problem, 30, 30, NULL, &fine), AMBULO_OK);
  int n = ambulo_problem_variable_count(fine);
  assert_int_equal(n, 2 * 33);
  double *x = calloc((size_t)n, sizeof *x);
  assert_int_equal(ambulo_problem_transfer(f.problem, f.x, fine, x), AMBULO_OK);
  ambulo_workspace *workspace = NULL;
  assert_int_equal(ambulo_workspace_create(fine, NULL, &workspace), AMBULO_OK);
  double times[7], coarse_tau[14], fine_tau[14];
  for (int i = 0; i < 7; i++) times[i] = 0.01 + 0.14 * i;
  ambulo_motion a = {.size = sizeof(ambulo_motion), .tau = coarse_tau},
                b = {.size = sizeof(ambulo_motion), .tau = fine_tau};
  assert_int_equal(ambulo_problem_motion(f.problem, f.workspace, f.x, 7, times, &a), AMBULO_OK);
  assert_int_equal(ambulo_problem_motion(fine, workspace, x, 7, times, &b), AMBULO_OK);
  for (int i = 0; i < 14; i++) assert_close(fine_tau[i], coarse_tau[i], 1e-9);
  free(x);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(fine);
  fixture_close(&f);
}

static void references_are_resampled(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  double reference[22];
  for (int k = 0; k < 11; k++) {
    reference[2 * k] = 0.1 * k;
    reference[2 * k + 1] = 1.0 - 0.2 * k;
  }
  ambulo_term term = ambulo_term_default(AMBULO_TRACKING);
  term.reference = reference;
  ambulo_problem_definition definition = arm_definition(f.model);
  definition.terms = &term;
  definition.term_count = 1;
  fixture_open(&f, &definition);
  ambulo_problem *fine = NULL;
  assert_int_equal(ambulo__problem_with_grid(f.problem, 25, 10, NULL, &fine), AMBULO_OK);
  const double *r = fine->definition.terms[0].reference;
  for (int k = 0; k <= 25; k++) {
    assert_close(r[2 * k], 0.04 * k, 1e-14);
    assert_close(r[2 * k + 1], 1.0 - 0.08 * k, 1e-14);
  }
  ambulo_problem_free(fine);
  fixture_close(&f);
}

/* from given nodes to the same number of them, which stay, and to others, which are equally spaced
 * where nothing happens */
static void references_follow_their_nodes(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  double reference[22], times[11];
  for (int k = 0; k < 11; k++) {
    times[k] = 0.01 * k * k;
    reference[2 * k] = 2.0 * times[k];
    reference[2 * k + 1] = 1.0 - times[k];
  }
  ambulo_term term = ambulo_term_default(AMBULO_TRACKING);
  term.reference = reference;
  ambulo_problem_definition definition = arm_definition(f.model);
  definition.terms = &term;
  definition.term_count = 1;
  definition.grid = AMBULO_GRID_EVENTS;
  definition.node_times = times;
  fixture_open(&f, &definition);
  for (int intervals = 10; intervals <= 30; intervals += 20) {
    ambulo_problem *other = NULL;
    assert_int_equal(ambulo__problem_with_grid(f.problem, intervals, 10, NULL, &other), AMBULO_OK);
    const double *r = other->definition.terms[0].reference;
    for (int k = 0; k <= intervals; k++) {
      double t = intervals == 10 ? times[k] : k / 30.0;
      assert_close(other->times[k], t, 1e-15);
      assert_close(r[2 * k], 2.0 * t, 1e-14);
      assert_close(r[2 * k + 1], 1.0 - t, 1e-14);
    }
    ambulo_problem_free(other);
  }
  fixture_close(&f);
}

static void times_between_nodes_are_found(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  double times[11], part;
  for (int k = 0; k < 11; k++) times[k] = 0.01 * k * k;
  ambulo_problem_definition definition = arm_definition(f.model);
  definition.grid = AMBULO_GRID_EVENTS;
  definition.node_times = times;
  fixture_open(&f, &definition);
  for (int k = 0; k < 10; k++) {
    for (int i = 0; i < 4; i++) {
      double time = times[k] + 0.25 * i * (times[k + 1] - times[k]);
      assert_int_equal(ambulo__node_at(f.problem, time, &part), k);
      assert_close(part, 0.25 * i, 1e-12);
    }
    assert_int_equal(ambulo__node_at(f.problem, times[k] - 1e-12, &part), k); /* but for rounding */
    assert_close(part, 0.0, 0.0);
  }
  assert_int_equal(ambulo__node_at(f.problem, 1.0, &part), 9);
  assert_close(part, 1.0, 0.0);
  assert_int_equal(ambulo__node_at(f.problem, -1.0, &part), 0);
  assert_close(part, 0.0, 0.0);
  fixture_close(&f);
}

/* what a user's function sums over the nodes: exact where it is linear within each phase, whatever
 * its bends at events; and the error of t^2 is that of each phase, d h^2 / 6 */
static double bent(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  (void)gradient;
  double t = state->time;
  return *(int *)user ? t * t : fabs(t - 0.3) + 2.0 * fabs(t - 0.8);
}

static void each_phase_is_integrated_by_itself(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  int square = 0;
  double times[11] = {0.0, 0.1, 0.2, 0.3, 0.425, 0.55, 0.675, 0.8, 0.85, 0.9, 1.0}, value;
  ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
  term.function = bent;
  term.user = &square;
  ambulo_problem_definition definition = arm_definition(f.model);
  definition.terms = &term;
  definition.term_count = 1;
  definition.grid = AMBULO_GRID_EVENTS;
  definition.node_times = times;
  fixture_open(&f, &definition);
  assert_int_equal(ambulo_problem_evaluate(f.problem, f.workspace, f.x, &value, NULL, NULL),
                   AMBULO_OK);
  double first = 0.5 * (0.3 * 0.3 + 0.7 * 0.7), second = 0.8 * 0.8 + 0.2 * 0.2;
  assert_close(value, first + second, 1e-14);
  square = 1;
  arm_point(f.x, f.n, 0.3); /* another point: the sum is taken anew */
  assert_int_equal(ambulo_problem_evaluate(f.problem, f.workspace, f.x, &value, NULL, NULL),
                   AMBULO_OK);
  double error = 0.3 * 0.1 * 0.1 + 0.5 * 0.125 * 0.125 + 0.1 * 0.05 * 0.05 + 0.1 * 0.1 * 0.1;
  assert_close(value, 1.0 / 3.0 + error / 6.0, 1e-14);
  fixture_close(&f);
}

static void other_models_are_refused(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  fixture_open(&f, &definition);
  definition.duration = 1.5;
  ambulo_problem *other = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &other), AMBULO_OK);
  assert_int_equal(ambulo_problem_transfer(f.problem, f.x, other, f.gradient), AMBULO_E_ARGUMENT);
  ambulo_problem_free(other);
  fixture_close(&f);
}

/* intervals of walk.yaml between the left foot's being flat and the right one's leaving */
static int intervals_of_the_short_phase(const char *setting) {
  const char *const settings[] = {"gait.phases.foot_flat=0.09", "gait.phases.toe_off=0.6", setting};
  ambulo_problem *p = NULL;
  assert_int_equal(ambulo_problem_load("models/walk.yaml", settings, 3, NULL, NULL, &p), AMBULO_OK);
  double step = p->definition.duration;
  int count = 0;
  for (int k = 0; k <= p->definition.intervals; k++) {
    double share = ambulo_problem_node_time(p, k) / (2.0 * step);
    count += share > 0.09 - 1e-9 && share < 0.1 + 1e-9;
  }
  ambulo_problem_free(p);
  return count - 1;
}

/* a fiftieth of the step: by its share one interval of 64 */
static void a_short_phase_has_four_intervals_where_there_are_enough(void **state) {
  (void)state;
  assert_int_equal(intervals_of_the_short_phase("time.intervals=64"), 4);
  assert_int_equal(intervals_of_the_short_phase("time.intervals=40"), 4);
  assert_int_equal(intervals_of_the_short_phase("time.intervals=32"), 3);
  assert_int_equal(intervals_of_the_short_phase("time.intervals=16"), 2);
}

/* The start pose is a motion at rest in every basis, and a solve begins there. */

/* a slider of 2 kg whose default is 0.75 m */
static const char text[] =
    "ambulo: 1\nkind: model\nname: m\nunits: {angle: radians}\nlinks:\n"
    "  - {name: a, parent: none, joint: prismatic, origin: {xyz: [0, 0, 0]}, axis: [1, 0, 0],\n"
    "     coordinate: {name: x, range: [-1, 1], default: 0.75},\n"
    "     body: {mass: 2, com: [0, 0, 0], gyration: [1, 1, 1]}}\n"
    "  - {name: b, parent: a, joint: revolute, origin: {xyz: [0, 0, 0]}, axis: [0, 0, 1],\n"
    "     coordinate: {name: q}, body: {mass: 2, com: [0, 0, 0], gyration: [1, 1, 1]}}\n";

static void at_rest(void **state) {
  (void)state;
  static const ambulo_discretization bases[] = {AMBULO_BSPLINE, AMBULO_CENTRAL_DIFFERENCE,
                                                AMBULO_HERMITE};
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load_text(text, sizeof text - 1, "m", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  assert_close(ambulo_model_coordinate(model, 0)->default_value, 0.75, 0);
  for (int b = 0; b < 3; b++) {
    ambulo_term term = ambulo_term_default(AMBULO_ACCELERATION);
    ambulo_problem_definition d = ambulo_problem_definition_default();
    ambulo_problem *problem = NULL;
    ambulo_result *result = NULL;
    d.model = model;
    d.discretization = bases[b];
    d.duration = 1.0;
    d.intervals = 48; /* coarser grids come first */
    d.terms = &term;
    d.term_count = 1;
    assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
    /* nothing asks for another motion: a solve ends where it began */
    assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
    const double *x = ambulo_result_x(result);
    for (int k = 0; k <= 24; k++) {
      ambulo__basis_point at;
      double q[3][2] = {{0}};
      ambulo__basis_at(problem->basis, k / 24.0, &at);
      for (int o = 0; o < 3; o++)
        for (int s = 0; s < at.span; s++)
          for (int i = 0; i < 2; i++) q[o][i] += at.weight[o][s] * x[(at.first + s) * 2 + i];
      assert_close(q[0][0], 0.75, 1e-12);
      assert_close(q[0][1], 0.0, 1e-12);
      for (int o = 1; o < 3; o++) assert_close(q[o][0], 0.0, 1e-9);
    }
    ambulo_result_free(result);
    ambulo_problem_free(problem);
  }
  ambulo_model_free(model);
}

static void out_of_range(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  char other[sizeof text];
  memcpy(other, text, sizeof text);
  memcpy(strstr(other, "0.75"), "1.75", 4);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_model_load_text(other, sizeof text - 1, "m", NULL, NULL, list, &model),
                   AMBULO_E_MODEL);
  char said[300];
  ambulo_diagnostics_format(list, 0, said, sizeof said);
  assert_non_null(strstr(
      said, "the default of coordinate 'x' is out of its range (got 1.75); expected -1 to 1"));
  ambulo_diagnostics_free(list);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_short_phase_has_four_intervals_where_there_are_enough),
      cmocka_unit_test(transfer_to_a_finer_spline_keeps_the_motion),
      cmocka_unit_test(references_are_resampled),
      cmocka_unit_test(references_follow_their_nodes),
      cmocka_unit_test(times_between_nodes_are_found),
      cmocka_unit_test(each_phase_is_integrated_by_itself),
      cmocka_unit_test(other_models_are_refused),
      cmocka_unit_test(at_rest),
      cmocka_unit_test(out_of_range)};
  return cmocka_run_group_tests_name("problem/variants_grid", tests, NULL, NULL);
}
