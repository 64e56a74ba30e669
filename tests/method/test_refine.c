/* Coarse grids: which, what they carry over, and when there are none. */
#include "method/refine.h"
#include "problem/nlp.h"
#include "support/arm.h"
#include "support/engine_fixture.h"

static double refine(engine_fixture *f, int *levels) {
  assert_int_equal(ambulo__refine(f->engine, NULL, f->x, levels), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(f->engine->workspace, f->x), AMBULO_OK);
  return f->engine->workspace->objective;
}

/* 36 intervals start from 12, whose optimum is known */
static void the_next_grid_is_carried_over(void **state) {
  (void)state;
  engine_fixture f;
  int levels = -1, forces = 0;
  engine_open(&f, "yardstick_36");
  for (int i = 0; i < f.engine->setup->inequalities; i++) f.engine->iterate.lambda[i] = -1.0;
  (void)refine(&f, &levels);
  assert_int_equal(levels, 1);
  assert_close(f.engine->iterate.coarse_objective / 0.35640, 1.0, 2e-2); /* it is left early */
  for (int i = 0; i < f.engine->setup->inequalities; i++) {
    assert_true(f.engine->iterate.lambda[i] >= 0.0);
    forces += f.engine->iterate.lambda[i] > 0.0;
  }
  assert_true(forces > 10);
  engine_close(&f);
}

static void few_intervals_have_no_coarser_grid(void **state) {
  (void)state;
  engine_fixture f;
  int levels = -1;
  engine_open(&f, "yardstick_12");
  (void)refine(&f, &levels);
  assert_int_equal(levels, 0);
  for (int j = 0; j < f.n; j++) assert_true(f.x[j] == 0.0);
  assert_true(f.engine->iterate.coarse_objective < 0.0);
  assert_int_equal(f.run.evaluations, 0);
  engine_close(&f);
}

/* 25 intervals of five phases start from 12; 36 of nine do not: 12 would be fewer than two a phase.
 * A trajectory of 6 keeps the 4 that its knots on events need, not 3 */
static void grids_on_events_stop_where_phases_have_too_few(void **state) {
  (void)state;
  static const struct {
    const char *name, *override;
    int levels;
  } all[] = {{"yardstick_36", "time.grid=events", 0},
             {"support/walk_rigid", "time.grid=events", 1},
             {"support/walk_rigid", "trajectory={degree: 4, intervals: 6, knots: events}", 1}};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    engine_fixture f;
    int levels = -1;
    engine_open_with(&f, all[i].name, all[i].override);
    (void)refine(&f, &levels);
    assert_int_equal(levels, all[i].levels);
    assert_true((f.run.evaluations > 0) == all[i].levels);
    engine_close(&f);
  }
}

/* Half the nodes are two for each of 14 knot intervals: the trajectory keeps them all, and its
 * objective is near to the walk's 0.1309. With 7 it is 0.14. */
static void coarse_trajectories_keep_what_two_nodes_hold(void **state) {
  (void)state;
  engine_fixture f;
  int levels = -1;
  engine_open(&f, "walk_normal");
  (void)refine(&f, &levels);
  assert_int_equal(levels, 1);
  assert_close(f.engine->iterate.coarse_objective / 0.1309, 1.0, 0.05);
  engine_close(&f);
}

/* On 14 intervals feet on their places, head at its own and rest at both ends contradict each other
 * by 22 mm: that is left, for a start without multipliers. */
static void a_grid_without_room_is_left_early(void **state) {
  (void)state;
  engine_fixture f;
  int levels = -1;
  engine_open_with(&f, "reach_standing", "time.intervals=28");
  for (int i = 0; i < f.engine->setup->inequalities; i++) f.engine->iterate.lambda[i] = -1.0;
  (void)refine(&f, &levels);
  assert_int_equal(levels, 1);
  assert_in_range(f.run.iterations, 7, 25); /* 72 until nothing helps */
  assert_true(f.engine->iterate.coarse_objective < 0.0);
  for (int i = 0; i < f.engine->setup->inequalities; i++)
    assert_true(f.engine->iterate.lambda[i] == 0.0);
  engine_close(&f);
}

static double height(void *user, const ambulo_node_state *s, ambulo_node_gradient *g) {
  (void)user;
  if (g) g->points[1] += 1.0;
  return s->points[1];
}

/* functions of the caller may count nodes: they are asked on his grid alone */
static void callbacks_have_no_coarser_grid(void **state) {
  (void)state;
  for (int kind = 0; kind < 3; kind++) {
    engine_fixture f = {.options = ambulo_options_default()};
    int levels = -1;
    ambulo_model *model = arm_create();
    ambulo_problem_definition d = arm_definition(model);
    ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
    ambulo_user_row row = {"low", "m", AMBULO_NOT_NEGATIVE, 0.0, 1.0, height, NULL};
    term.function = height;
    d.intervals = 32;
    if (kind == 1) d.terms = &term;
    if (kind == 2) d.user_rows = &row;
    d.user_row_count = kind == 2;
    assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &f.problem), AMBULO_OK);
    f.n = ambulo_problem_variable_count(f.problem);
    f.x = calloc((size_t)f.n, sizeof *f.x);
    ambulo__run_begin(&f.run, &f.options);
    assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine),
                     AMBULO_OK);
    (void)refine(&f, &levels);
    assert_int_equal(levels, kind == 0);
    assert_int_equal(f.run.evaluations > 0, kind == 0);
    engine_close(&f);
    ambulo_model_free(model);
  }
}

/* Multipliers of one grid for another: densities over time, by the rows' labels. */

static const ambulo__table_row *row_of(const ambulo__engine *e, int i) {
  return &e->setup->problem->table.rows[e->linearized.rows.inequality.row[i]];
}

/* to the same grid: as they are */
static void on_the_same_grid_nothing_changes(void **state) {
  (void)state;
  engine_fixture f;
  ambulo__saved_multipliers saved = {0};
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  engine_open(&f, "support/walk_rigid");
  ambulo__engine *e = f.engine;
  double *was = calloc((size_t)e->setup->inequalities, sizeof *was);
  for (int i = 0; i < e->setup->inequalities; i++)
    e->iterate.lambda[i] = was[i] = i % 3 ? 0.0 : 0.01 * i;
  e->reached.objective = 3.0 * e->setup->objective_scale;
  assert_int_equal(ambulo__multipliers_save(e, &a, &saved), AMBULO_OK);
  for (int i = 0; i < e->setup->inequalities; i++) e->iterate.lambda[i] = -1.0;
  assert_true(e->iterate.coarse_objective < 0.0);
  ambulo__multipliers_transfer(&saved, e);
  assert_close(e->iterate.coarse_objective, 3.0, 1e-12);
  for (int i = 0; i < e->setup->inequalities; i++)
    assert_close(e->iterate.lambda[i], was[i], 1e-12);
  ambulo__multipliers_free(&a, &saved);
  assert_null(saved.row);
  free(was);
  engine_close(&f);
}

/* A density that is linear in time, of one family: on a grid of twice the nodes the same density,
 * so half the multipliers. */
static void densities_are_linear_between_nodes(void **state) {
  (void)state;
  engine_fixture coarse, fine;
  ambulo__saved_multipliers saved = {0};
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  engine_open_with(&coarse, "support/walk_rigid", "time.intervals=24");
  engine_open_with(&fine, "support/walk_rigid", "time.intervals=48");
  ambulo__engine *c = coarse.engine, *e = fine.engine;
  for (int i = 0; i < c->setup->inequalities; i++) {
    const ambulo__table_row *row = row_of(c, i);
    if (strcmp(row->family, "joint_limit") != 0 || row->node < 0) continue;
    double density = 2.0 + row->time, scale = -c->linearized.rows.inequality.scale[i];
    c->iterate.lambda[i] =
        density * coarse.problem->quadrature[row->node] * c->setup->objective_scale / scale;
  }
  assert_int_equal(ambulo__multipliers_save(c, &a, &saved), AMBULO_OK);
  ambulo__multipliers_transfer(&saved, e);
  int seen = 0;
  for (int i = 0; i < e->setup->inequalities; i++) {
    const ambulo__table_row *row = row_of(e, i);
    if (strcmp(row->family, "joint_limit") != 0 || row->node < 0) {
      assert_true(e->iterate.lambda[i] == 0.0);
      continue;
    }
    double scale = -e->linearized.rows.inequality.scale[i];
    double density = e->iterate.lambda[i] * scale /
                     (e->setup->objective_scale * fine.problem->quadrature[row->node]);
    assert_close(density, 2.0 + row->time, 1e-9);
    seen++;
  }
  assert_true(seen > 100);
  ambulo__multipliers_free(&a, &saved);
  engine_close(&coarse);
  engine_close(&fine);
}

/* limits on control points stand for no time: the same multipliers on a grid of twice the nodes */
static void rows_on_control_points_keep_their_multipliers(void **state) {
  (void)state;
  engine_fixture coarse, fine;
  ambulo__saved_multipliers saved = {0};
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  engine_open_with(&coarse, "support/two_link_reach", "constraints.joint_limits=control_points");
  fine.options = ambulo_options_default();
  ambulo__run_begin(&fine.run, &fine.options);
  assert_int_equal(ambulo__problem_with_grid(coarse.problem, 40, 10, NULL, &fine.problem),
                   AMBULO_OK);
  fine.x = calloc((size_t)fine.problem->variables, sizeof *fine.x);
  assert_int_equal(ambulo__engine_create(fine.problem, fine.x, NULL, &fine.run, NULL, &fine.engine),
                   AMBULO_OK);
  ambulo__engine *c = coarse.engine, *e = fine.engine;
  for (int i = 0; i < c->setup->inequalities; i++)
    c->iterate.lambda[i] = row_of(c, i)->node < 0 ? 2.0 * c->setup->objective_scale : 0.0;
  assert_int_equal(ambulo__multipliers_save(c, &a, &saved), AMBULO_OK);
  ambulo__multipliers_transfer(&saved, e);
  int seen = 0;
  for (int i = 0; i < e->setup->inequalities; i++) {
    if (row_of(e, i)->node >= 0) continue;
    assert_close(e->iterate.lambda[i] / e->setup->objective_scale, 2.0, 1e-9);
    seen++;
  }
  assert_true(seen > 10);
  ambulo__multipliers_free(&a, &saved);
  engine_close(&fine);
  engine_close(&coarse);
}

/* beside a hole in time a density lasts for half an interval; nothing carried is nothing */
static void holes_stay_empty(void **state) {
  (void)state;
  engine_fixture coarse, fine;
  ambulo__saved_multipliers saved = {0}, none = {0};
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  engine_open_with(&coarse, "support/walk_rigid", "time.intervals=24");
  engine_open_with(&fine, "support/walk_rigid", "time.intervals=96");
  ambulo__engine *c = coarse.engine, *e = fine.engine;
  double T = coarse.problem->definition.duration, interval = T / 24.0, worst = 0.0;
  for (int i = 0; i < c->setup->inequalities; i++) {
    const ambulo__table_row *row = row_of(c, i);
    double scale = -c->linearized.rows.inequality.scale[i];
    if (strcmp(row->family, "joint_limit") == 0 && row->node >= 0)
      c->iterate.lambda[i] =
          coarse.problem->quadrature[row->node] * c->setup->objective_scale / scale;
  }
  c->reached.objective = -3.0 * c->setup->objective_scale;
  assert_int_equal(ambulo__multipliers_save(c, &a, &saved), AMBULO_OK);
  int kept = 0; /* the rows from 5 to 10 intervals go */
  for (int k = 0; k < saved.count; k++) {
    double at = saved.row[k].time / interval;
    if (at < 4.5 || at > 10.5) saved.row[kept++] = saved.row[k];
  }
  saved.count = kept;
  ambulo__multipliers_transfer(&saved, e);
  assert_close(e->iterate.coarse_objective, 3.0, 1e-12);
  for (int i = 0; i < e->setup->inequalities; i++) {
    const ambulo__table_row *row = row_of(e, i);
    if (strcmp(row->family, "joint_limit") != 0 || row->node < 0) continue;
    double scale = -e->linearized.rows.inequality.scale[i], at = row->time / interval;
    double density = e->iterate.lambda[i] * scale /
                     (e->setup->objective_scale * fine.problem->quadrature[row->node]);
    worst = fmax(worst, fabs(density - (at > 4.6 && at < 10.4 ? 0.0 : 1.0)));
  }
  assert_close(worst, 0.0, 1e-9);
  ambulo__multipliers_transfer(&none, e);
  assert_true(e->iterate.coarse_objective == -1.0);
  for (int i = 0; i < e->setup->inequalities; i++) assert_true(e->iterate.lambda[i] == 0.0);
  ambulo__multipliers_free(&a, &saved);
  engine_close(&coarse);
  engine_close(&fine);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_next_grid_is_carried_over),
      cmocka_unit_test(few_intervals_have_no_coarser_grid),
      cmocka_unit_test(grids_on_events_stop_where_phases_have_too_few),
      cmocka_unit_test(coarse_trajectories_keep_what_two_nodes_hold),
      cmocka_unit_test(a_grid_without_room_is_left_early),
      cmocka_unit_test(callbacks_have_no_coarser_grid),
      cmocka_unit_test(on_the_same_grid_nothing_changes),
      cmocka_unit_test(densities_are_linear_between_nodes),
      cmocka_unit_test(rows_on_control_points_keep_their_multipliers),
      cmocka_unit_test(holes_stay_empty),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
