/* Multipliers of one grid for another: densities over time, by the rows' labels. */
#include "method/carry.h"
#include "problem/nlp.h"
#include "support/engine_fixture.h"

static const ambulo__table_row *row_of(const ambulo__engine *e, int i) {
  return &e->setup->problem->table.rows[e->linearized.rows.inequality.row[i]];
}

/* to the same grid: as they are */
static void on_the_same_grid_nothing_changes(void **state) {
  (void)state;
  engine_fixture f;
  ambulo__carried carried = {0};
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  engine_open(&f, "support/walk_rigid");
  ambulo__engine *e = f.engine;
  double *was = calloc((size_t)e->setup->inequalities, sizeof *was);
  for (int i = 0; i < e->setup->inequalities; i++)
    e->iterate.lambda[i] = was[i] = i % 3 ? 0.0 : 0.01 * i;
  e->reached.objective = 3.0 * e->setup->objective_scale;
  assert_int_equal(ambulo__carry_from(e, &a, &carried), AMBULO_OK);
  for (int i = 0; i < e->setup->inequalities; i++) e->iterate.lambda[i] = -1.0;
  assert_true(e->iterate.carried_objective < 0.0);
  ambulo__carry_to(&carried, e);
  assert_close(e->iterate.carried_objective, 3.0, 1e-12);
  for (int i = 0; i < e->setup->inequalities; i++)
    assert_close(e->iterate.lambda[i], was[i], 1e-12);
  ambulo__carry_clear(&a, &carried);
  assert_null(carried.row);
  free(was);
  engine_close(&f);
}

/* A density that is linear in time, of one family: on a grid of twice the nodes the same density,
 * so half the multipliers. */
static void densities_are_linear_between_nodes(void **state) {
  (void)state;
  engine_fixture coarse, fine;
  ambulo__carried carried = {0};
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
  assert_int_equal(ambulo__carry_from(c, &a, &carried), AMBULO_OK);
  ambulo__carry_to(&carried, e);
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
  ambulo__carry_clear(&a, &carried);
  engine_close(&coarse);
  engine_close(&fine);
}

/* limits on control points stand for no time: the same multipliers on a grid of twice the nodes */
static void rows_on_control_points_keep_their_multipliers(void **state) {
  (void)state;
  engine_fixture coarse, fine;
  ambulo__carried carried = {0};
  const ambulo_allocator a = ambulo__allocator_or_default(NULL);
  engine_open_with(&coarse, "two_link_reach", "constraints.joint_limits=control_points");
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
  assert_int_equal(ambulo__carry_from(c, &a, &carried), AMBULO_OK);
  ambulo__carry_to(&carried, e);
  int seen = 0;
  for (int i = 0; i < e->setup->inequalities; i++) {
    if (row_of(e, i)->node >= 0) continue;
    assert_close(e->iterate.lambda[i] / e->setup->objective_scale, 2.0, 1e-9);
    seen++;
  }
  assert_true(seen > 10);
  ambulo__carry_clear(&a, &carried);
  engine_close(&fine);
  engine_close(&coarse);
}

/* beside a hole in time a density lasts for half an interval; nothing carried is nothing */
static void holes_stay_empty(void **state) {
  (void)state;
  engine_fixture coarse, fine;
  ambulo__carried carried = {0}, none = {0};
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
  assert_int_equal(ambulo__carry_from(c, &a, &carried), AMBULO_OK);
  int kept = 0; /* the rows from 5 to 10 intervals go */
  for (int k = 0; k < carried.count; k++) {
    double at = carried.row[k].time / interval;
    if (at < 4.5 || at > 10.5) carried.row[kept++] = carried.row[k];
  }
  carried.count = kept;
  ambulo__carry_to(&carried, e);
  assert_close(e->iterate.carried_objective, 3.0, 1e-12);
  for (int i = 0; i < e->setup->inequalities; i++) {
    const ambulo__table_row *row = row_of(e, i);
    if (strcmp(row->family, "joint_limit") != 0 || row->node < 0) continue;
    double scale = -e->linearized.rows.inequality.scale[i], at = row->time / interval;
    double density = e->iterate.lambda[i] * scale /
                     (e->setup->objective_scale * fine.problem->quadrature[row->node]);
    worst = fmax(worst, fabs(density - (at > 4.6 && at < 10.4 ? 0.0 : 1.0)));
  }
  assert_close(worst, 0.0, 1e-9);
  ambulo__carry_to(&none, e);
  assert_true(e->iterate.carried_objective == -1.0);
  for (int i = 0; i < e->setup->inequalities; i++) assert_true(e->iterate.lambda[i] == 0.0);
  ambulo__carry_clear(&a, &carried);
  engine_close(&coarse);
  engine_close(&fine);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(on_the_same_grid_nothing_changes),
      cmocka_unit_test(densities_are_linear_between_nodes),
      cmocka_unit_test(rows_on_control_points_keep_their_multipliers),
      cmocka_unit_test(holes_stay_empty)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
