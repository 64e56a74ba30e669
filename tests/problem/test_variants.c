/* Terms and rows of the caller on a problem of a file: it is the problem whose file says the same,
 * and all that the file gave stays, free parameters too. */
#include "ambulo/tools/load.h"
#include "problem/nlp.h"
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
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
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
  assert_true(ambulo_problem_pairs_too_far(base) > 0);
  assert_int_equal(ambulo_problem_pairs_too_far(extended), ambulo_problem_pairs_too_far(base));
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
      cmocka_unit_test(term_is_what_the_file_could_have_said),
      cmocka_unit_test(row_binds_at_the_solution),
      cmocka_unit_test(what_the_file_says_stays),
      cmocka_unit_test(free_parameters_are_found_with_it),
      cmocka_unit_test(advice_names_keys_of_the_file),
      cmocka_unit_test(pairs_left_out_are_still_told),
      cmocka_unit_test(what_is_no_extension_is_refused),
      cmocka_unit_test(without_memory_nothing_is_lost),
      cmocka_unit_test(a_short_phase_has_four_intervals_where_there_are_enough),
      cmocka_unit_test(transfer_to_a_finer_spline_keeps_the_motion),
      cmocka_unit_test(references_are_resampled),
      cmocka_unit_test(references_follow_their_nodes),
      cmocka_unit_test(times_between_nodes_are_found),
      cmocka_unit_test(each_phase_is_integrated_by_itself),
      cmocka_unit_test(other_models_are_refused),
      cmocka_unit_test(at_rest),
      cmocka_unit_test(out_of_range)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
