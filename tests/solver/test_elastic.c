/* The least violation: zero where a motion exists, balanced forces where none does. */
#include "solver/explain.h"
#include "ambulo/tools/load.h"
#include "support/engine_fixture.h"
#include "support/sliders.h"

typedef struct elastic_fixture {
  engine_fixture engine;
  ambulo__pool pool;
  ambulo__elastic elastic;
} elastic_fixture;

static void open_problem(elastic_fixture *f, const char *name) {
  ambulo_allocator allocator = ambulo__allocator_or_default(NULL);
  engine_open(&f->engine, name);
  ambulo__pool_init(&f->pool, &allocator);
  ambulo_workspace *workspace = f->engine.engine->workspace;
  assert_int_equal(ambulo__evaluate(workspace, f->engine.x), AMBULO_OK);
  assert_int_equal(
      ambulo__elastic_create(f->engine.problem, workspace, &f->engine.run, &f->pool, &f->elastic),
      AMBULO_OK);
}

static void close_problem(elastic_fixture *f) {
  ambulo__pool_clear(&f->pool);
  engine_close(&f->engine);
}

static double worst_excess(const elastic_fixture *f) {
  double worst = 0.0;
  for (int r = 0; r < f->engine.problem->rows; r++)
    worst = fmax(worst, ambulo__elastic_excess(&f->elastic, r, f->elastic.workspace->row_value[r]));
  return worst;
}

static void feasible_problems_end_at_zero(void **state) {
  (void)state;
  static const char *const names[] = {"yardstick_12", "yardstick_36", "pendulum_swing"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    elastic_fixture f;
    open_problem(&f, names[i]);
    assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 1);
    if (worst_excess(&f) > 1e-7) print_error("%s: %g left\n", names[i], worst_excess(&f));
    assert_true(worst_excess(&f) <= 1e-7);
    close_problem(&f);
  }
}

/* at the minimum sum w^2 e grad e vanishes: the gradient of the energy, by one reverse sweep */
static void forces_balance_where_rows_conflict(void **state) {
  (void)state;
  elastic_fixture f;
  open_problem(&f, "../tests/infeasible/range_excludes_posture");
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 1);
  const ambulo_problem *p = f.engine.problem;
  double *weight = calloc((size_t)p->rows, sizeof *weight), largest = 0.0, single = 0.0;
  double *gradient = calloc((size_t)f.engine.n, sizeof *gradient);
  for (int r = 0; r < p->rows; r++) {
    double value = f.elastic.workspace->row_value[r], size = f.elastic.size[r];
    if (p->table.rows[r].relation == AMBULO_EQUAL || value < 0.0) weight[r] = value / (size * size);
    single = fmax(single, fabs(weight[r]));
  }
  ambulo__gradient(f.elastic.workspace, 0.0, weight, gradient);
  for (int j = 0; j < f.engine.n; j++) largest = fmax(largest, fabs(gradient[j]));
  assert_true(worst_excess(&f) > 0.02);
  if (largest > 0.02 * single) print_error("gradient %g, forces %g\n", largest, single);
  assert_true(largest <= 0.02 * single);
  free(gradient);
  free(weight);
  close_problem(&f);
}

static void a_passed_deadline_leaves_x_alone(void **state) {
  (void)state;
  elastic_fixture f;
  open_problem(&f, "support/walker_2d_step");
  f.elastic.deadline = 0.0;
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 0);
  for (int j = 0; j < f.engine.n; j++) assert_true(f.engine.x[j] == 0.0);
  close_problem(&f);
}

static int refuse(void *user, const ambulo_progress *progress) {
  (void)progress;
  ++*(int *)user;
  return 1;
}

static void the_caller_can_stop_it(void **state) {
  (void)state;
  elastic_fixture f;
  int calls = 0;
  open_problem(&f, "support/walker_2d_step");
  f.engine.options.progress = refuse;
  f.engine.options.user = &calls;
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 0);
  assert_int_equal(calls, 1);
  assert_true(f.elastic.cancelled);
  close_problem(&f);
}

static int refuse_later(void *user, const ambulo_progress *progress) {
  (void)progress;
  return --*(int *)user < 0;
}

/* before every factorization, which takes seconds for large problems */
static void the_caller_is_asked_at_every_step(void **state) {
  (void)state;
  for (int calls = 1; calls < 8; calls++) {
    elastic_fixture f;
    int left = calls;
    open_problem(&f, "support/walker_2d_step");
    f.engine.options.progress = refuse_later;
    f.engine.options.user = &left;
    assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 0);
    assert_true(f.elastic.cancelled);
    assert_true(f.elastic.work <= (double)calls);
    close_problem(&f);
  }
}

static void stiff_rows_hold_while_others_give_way(void **state) {
  (void)state;
  elastic_fixture f;
  open_problem(&f, "../tests/infeasible/torque_too_weak");
  const ambulo_problem *p = f.engine.problem;
  for (int r = 0; r < p->rows; r++)
    f.elastic.weight[r] = strcmp(p->table.rows[r].family, "torque_limit") ? 1e3 : 1.0;
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 1);
  for (int r = 0; r < p->rows; r++) {
    if (f.elastic.weight[r] > 1.0)
      assert_close(f.elastic.workspace->row_value[r] < 0.0 ? f.elastic.workspace->row_value[r]
                                                           : 0.0,
                   0.0, 1e-4);
  }
  double weight = p->table.weight; /* torques are measured by the body weight times 1 m */
  assert_close(weight, 3.0 * 9.81, 1e-9);
  assert_true(worst_excess(&f) * weight > 1.8); /* of a limit of 6 N m */
  close_problem(&f);
}

/* a deadline counts model steps: the search ends at it, or one model (12 steps) later */
static void a_deadline_counts_model_steps(void **state) {
  (void)state;
  elastic_fixture f;
  open_problem(&f, "../tests/infeasible/torque_too_weak");
  f.elastic.deadline = 3.0;
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 0);
  assert_true(f.elastic.work >= 3.0 && f.elastic.work < 3.0 + 12.0);
  close_problem(&f);
}

/* a point that satisfies every row costs nothing; a minimum of E > 0 is recognized where E settles,
 * not where the steps run out */
static void nothing_is_done_for_nothing(void **state) {
  (void)state;
  elastic_fixture f;
  open_problem(&f, "pendulum_swing");
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 1);
  f.elastic.work = 0.0;
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 1);
  assert_true(f.elastic.work == 0.0);
  close_problem(&f);
  open_problem(&f, "../tests/infeasible/range_excludes_posture");
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 1);
  f.elastic.work = 0.0;
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 1);
  assert_true(f.elastic.work > 0.0 && f.elastic.work < 12.0);
  close_problem(&f);
}

/* gradients tell nothing about what is far away: no unknown moves by more than half a metre or
 * radian at once, though the first model asks for the whole way */
static void steps_are_capped(void **state) {
  (void)state;
  const slider_row rows[SLIDER_ROWS] = {{"far", 1.0, 1.0, 3.0, {1.0}, 0}};
  sliders *s = sliders_open(rows, INFINITY, NULL);
  double largest = 0.0;
  s->elastic.deadline = 1.0;
  assert_int_equal(ambulo__elastic_minimize(&s->elastic, s->x), 0);
  for (int j = 0; j < s->problem->variables; j++) largest = fmax(largest, fabs(s->x[j]));
  assert_close(largest, 0.5, 1e-9);
  s->elastic.deadline = HUGE_VAL;
  assert_int_equal(ambulo__elastic_minimize(&s->elastic, s->x), 1);
  assert_close(s->x[SLIDERS * (SLIDER_POINTS - 1)], 3.0, 1e-6);
  sliders_close(s);
}

static int go_on(void *user, const ambulo_progress *progress) {
  (void)progress;
  ++*(int *)user;
  return 0;
}

/* explanations come after solves that a limit has ended: the caller has not said stop by that, and
 * the run stays ended */
static void a_limit_of_the_solve_is_no_wish_of_the_caller(void **state) {
  (void)state;
  elastic_fixture f;
  int calls = 0;
  open_problem(&f, "pendulum_swing");
  f.engine.options.progress = go_on;
  f.engine.options.user = &calls;
  f.engine.run.stopped = 1;
  f.engine.run.ending = AMBULO_ENDING_EVALUATIONS;
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, f.engine.x), 1);
  assert_true(calls > 0);
  assert_false(f.elastic.cancelled);
  assert_true(f.engine.run.stopped);
  assert_int_equal(f.engine.run.ending, AMBULO_ENDING_EVALUATIONS);
  close_problem(&f);
}

/* something that has no value beyond 1 m */
static double barrier(void *user, const ambulo_node_state *s, ambulo_node_gradient *g) {
  (void)user;
  (void)g;
  return s->q[0] > 1.0 ? (double)NAN : 0.0;
}

/* what lies beyond a wall is no better, whatever the rows say there: the search ends before it */
static void walls_are_not_crossed(void **state) {
  (void)state;
  const slider_row rows[SLIDER_ROWS] = {{"far", 1.0, 1.0, 1.3, {1.0}, 0}};
  ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
  term.function = barrier;
  sliders *s = sliders_open(rows, INFINITY, &term);
  assert_int_equal(ambulo__elastic_minimize(&s->elastic, s->x), 1);
  double end = s->x[SLIDERS * (SLIDER_POINTS - 1)];
  assert_true(end > 0.9 && end <= 1.0);
  sliders_close(s);
}

/* More control points than nodes: most limits on them are on unknowns that share no node. One that
 * is missed is met at once, by a step that the limit to the other side, which holds, does not
 * stiffen. */
static void limits_that_hold_do_not_stiffen_a_step(void **state) {
  (void)state;
  static const char *const overrides[] = {"constraints.joint_limits=control_points",
                                          "constraints.torque_limits=false",
                                          "time.intervals=6",
                                          "trajectory.intervals=40",
                                          "ends.initial.swing=170",
                                          "ends.final.swing=170"};
  elastic_fixture f;
  ambulo_allocator allocator = ambulo__allocator_or_default(NULL);
  engine_open_with(&f.engine, "pendulum_swing", NULL);
  ambulo_problem *p = NULL;
  assert_int_equal(ambulo_problem_load("models/pendulum_swing.yaml", overrides, 6, NULL, NULL, &p),
                   AMBULO_OK);
  ambulo_workspace *w = NULL;
  double *x = calloc((size_t)p->variables, sizeof *x);
  assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
  const double *range = p->model->coordinates[0].range;
  for (int j = 0; j < p->variables; j++) x[j] = range[1] + 0.3;
  assert_int_equal(ambulo__evaluate(w, x), AMBULO_OK);
  ambulo__pool_init(&f.pool, &allocator);
  assert_int_equal(ambulo__elastic_create(p, w, &f.engine.run, &f.pool, &f.elastic), AMBULO_OK);
  assert_true(f.elastic.borders > 20 && isfinite(range[0]));
  f.elastic.deadline = 1.0;
  assert_int_equal(ambulo__elastic_minimize(&f.elastic, x), 0);
  for (int i = 0; i < f.elastic.borders; i++) {
    assert_true(f.elastic.workspace->row_value[f.elastic.border.row[i]] > -0.01);
  }
  ambulo__pool_clear(&f.pool);
  ambulo_workspace_free(w);
  free(x);
  ambulo_problem_free(p);
  engine_close(&f.engine);
}

/* 600 rows that couple distant unknowns are a full matrix of that size in every step */
static void too_many_border_rows_are_refused(void **state) {
  (void)state;
  static const char *const overrides[] = {"constraints.joint_limits=control_points",
                                          "time.intervals=6", "trajectory.intervals=660"};
  ambulo_allocator allocator = ambulo__allocator_or_default(NULL);
  ambulo_options options = ambulo_options_default();
  ambulo__run run;
  ambulo__run_begin(&run, &options);
  ambulo__pool pool;
  ambulo__elastic elastic;
  ambulo_problem *p = NULL;
  assert_int_equal(ambulo_problem_load("models/pendulum_swing.yaml", overrides, 3, NULL, NULL, &p),
                   AMBULO_OK);
  ambulo_workspace *w = NULL;
  double *x = calloc((size_t)p->variables, sizeof *x);
  assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(w, x), AMBULO_OK);
  ambulo__pool_init(&pool, &allocator);
  assert_int_equal(ambulo__elastic_create(p, w, &run, &pool, &elastic), AMBULO_E_LIMIT);
  assert_true(elastic.borders > 600);
  ambulo__pool_clear(&pool);
  ambulo_workspace_free(w);
  free(x);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(feasible_problems_end_at_zero),
      cmocka_unit_test(forces_balance_where_rows_conflict),
      cmocka_unit_test(a_passed_deadline_leaves_x_alone),
      cmocka_unit_test(the_caller_can_stop_it),
      cmocka_unit_test(the_caller_is_asked_at_every_step),
      cmocka_unit_test(stiff_rows_hold_while_others_give_way),
      cmocka_unit_test(a_deadline_counts_model_steps),
      cmocka_unit_test(nothing_is_done_for_nothing),
      cmocka_unit_test(steps_are_capped),
      cmocka_unit_test(a_limit_of_the_solve_is_no_wish_of_the_caller),
      cmocka_unit_test(walls_are_not_crossed),
      cmocka_unit_test(limits_that_hold_do_not_stiffen_a_step),
      cmocka_unit_test(too_many_border_rows_are_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
